//! Where balls slide on their races, found after a run from its rows.

use crate::bearing::run::BearingRun;
use model::bearing::{BearingConstants, PlanarConstants};
use outcome::list::origins;
use outcome::list::results;

/// Slip from which a loaded contact skids, as a share of the rolling speed of its race's surface.
const SKIDS: f64 = 0.05;
/// Speed of the race, over its largest in the rows, below which nothing is judged.
const HARDLY_TURNS: f64 = 0.05;

/// The ball contacts of a run.
pub(crate) struct Skids<'a> {
    run: &'a BearingRun<'a>,
    bearing: &'a PlanarConstants,
}

/// What the rows show: of the inner race, then of the outer one.
pub(crate) struct Skidding {
    judged: usize,
    skids: [usize; 2],
    /// Sliding power summed over time by ball, J: trapezoids between the rows.
    work: [Vec<f64>; 2],
    /// The sliding heats of the ledger at both races, J.
    heats: [f64; 2],
}

impl<'a> Skids<'a> {
    /// None where balls roll always.
    pub fn of(run: &'a BearingRun<'a>) -> Option<Skids<'a>> {
        match run.bearing {
            BearingConstants::Planar(bearing) => Some(Skids { run, bearing }),
            BearingConstants::Rolling(_) | BearingConstants::Spatial(_) => None,
        }
    }

    /// What all rows came to.
    pub fn summary(&self) -> Skidding {
        let least = HARDLY_TURNS * self.run.fastest();
        let mut found = Skidding {
            judged: 0,
            skids: [0; 2],
            work: [(); 2].map(|()| vec![0.0; self.bearing.balls]),
            heats: self.run.slips(),
        };
        let balls = self.bearing.balls;
        let mut before = None;
        let (mut then, mut now) = (vec![[0.0; 2]; balls], vec![[0.0; 2]; balls]);
        for row in &self.run.rows {
            let speed = self.run.speed(row);
            let detail = &row.probe[self.run.at.detail..];
            let of = |list: usize, ball: usize| detail[list * balls + ball];
            for (ball, power) in now.iter_mut().enumerate() {
                let slips = [2, 3].map(|list| of(list, ball));
                *power = [of(5, ball) * slips[0], of(6, ball) * slips[1]];
                if speed > least && of(0, ball) > 0.0 && of(1, ball) > 0.0 {
                    // what rolling balls carry past the contact: half the speed of the race's surface
                    let surface = 0.5 * speed * self.bearing.ball.inner_track;
                    found.judged += 1;
                    for (skids, slip) in found.skids.iter_mut().zip(slips) {
                        *skids += usize::from(slip.abs() > SKIDS * surface);
                    }
                }
            }
            if let Some(time) = before {
                let half = 0.5 * (row.time - time);
                for race in 0..2 {
                    for (work, (then, now)) in
                        found.work[race].iter_mut().zip(then.iter().zip(&now))
                    {
                        *work += half * (then[race] + now[race]);
                    }
                }
            }
            before = Some(row.time);
            std::mem::swap(&mut then, &mut now);
        }
        found
    }
}

impl BearingRun<'_> {
    /// Where the balls slide, where they may.
    pub fn skids(&self) -> Option<Skidding> {
        Skids::of(self).map(|skids| skids.summary())
    }
}

impl Skidding {
    /// Share of the loaded contacts of a race that skid.
    fn share(&self, race: usize) -> Result<f64, String> {
        let none = || "no ball carried load at both races while the race turned".to_string();
        let share = self.skids[race] as f64 / self.judged as f64;
        (self.judged > 0).then_some(share).ok_or_else(none)
    }
    /// The ledger's heat of a race shared among the balls as in the rows, J.
    fn by_ball(&self, race: usize) -> Vec<f64> {
        let sum: f64 = self.work[race].iter().sum();
        let scale = if sum > 0.0 {
            self.heats[race] / sum
        } else {
            0.0
        };
        self.work[race].iter().map(|work| scale * work).collect()
    }
}

results! {
    /// Where the balls slide.
    pub(crate) fn skids(setup: &(), run: &Skidding) {
        "inner_skid_share": number "1", SHARE, "share of loaded contacts at the inner race that skid" => run.share(0);
        "inner_sliding_work_by_ball": list "J", WORK, "sliding work of each ball at the inner race" => run.by_ball(0);
        "outer_skid_share": number "1", SHARE, "share of loaded contacts at the outer race that skid" => run.share(1);
        "outer_sliding_work_by_ball": list "J", WORK, "sliding work of each ball at the outer race" => run.by_ball(1);
    }
}

origins! {
    SHARE: law "share of the contacts of loaded balls, in the rows of the history with a turning race, whose slip exceeds 5 % of the \
          rolling speed Ω R/2",
        source "definition; slips of crates/model/src/bearing/ball.rs",
        valid "as fine as run.output_interval";
    WORK: law "time integral of traction times slip at each ball: the ledger's heat of the race, shared as in the rows",
        source "energy ledger, and crates/model/src/bearing/ball.rs in the rows",
        valid "the sum is exact, its split as fine as run.output_interval";
}
