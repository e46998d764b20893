//! A bearing that its own warmth has closed so far that its inner race stops against the turning rotor.
//!
//! ```text
//!   I_race Ω̇ = μ N r - M(P_d, ν, Ω)      below 0 as soon as preloaded balls brake harder than friction of the rotor drives
//! ```
//! Both sides are those of the equations of motion: nothing is put in here. What is looked for is where they lead: balls that are
//! preloaded, and an inner race that had come to the rotor's speed, is pressed by it, and has less than a tenth of its speed. A race that
//! is left alone for a flight through the clearance, some 10 ms, keeps more than that; one that comes to speed for the first time does not
//! count.
//!
//! The run ends there: from then on the rotor slides at full speed on one place of a race that stands.
//!
//! Not modelled: films that break down and balls that smear before, rings that creep on their seats or crack, what a race that stands does
//! to rotor and bore.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::result::list::{List, Origin};
use crate::result::outcome::{Warning, warning};
use crate::simulate::coast_down::build::ICE_POINT;
use crate::simulate::drop::feedback::{Following, Warmed};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use solve::Step;
use thermal::bearing_network::{BALLS, INNER_RACE, OUTER_RACE};

/// Speeds of the race over that of the rotor: from the one on it has followed it, below the other it stands.
const FOLLOWED: f64 = 0.9;
const STANDS: f64 = 0.1;

/// A bearing that has seized.
#[derive(Clone, Debug)]
pub(crate) struct Seizure {
    /// Which one.
    pub bearing: usize,
    /// s.
    pub time: f64,
    /// Speed of the rotor, rad/s.
    pub speed: f64,
    /// Diametral clearance, m; below 0.
    pub clearance: f64,
    /// Load of every ball by it, N.
    pub preload: f64,
    /// Of the nodes, °C.
    pub temperatures: Vec<f64>,
}

/// Looks for it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Look {
    /// Of each bearing: whether the race has followed the rotor while its balls are preloaded.
    followed: Vec<bool>,
}

impl Look {
    /// The first bearing that has seized at the end of a step.
    pub fn at(
        &mut self,
        step: &mut Step<RotorMachine>,
        record: &Record,
        (following, warmed): (&Following, &Warmed),
    ) -> Option<Seizure> {
        let machine = step.machine;
        let bearings = machine.layout().bearings.len();
        self.followed.resize(bearings, false);
        for k in 0..bearings {
            let Some(clearance) = warmed.state(k).map(|state| state.clearance) else {
                continue;
            };
            if clearance >= 0.0 {
                continue;
            }
            let (time, layout) = (step.end, machine.layout());
            let state = step.state(1.0);
            let speed = state[layout.rotor.spin()].abs();
            let share = state[layout.bearings[k].inner + 5].abs() / speed;
            self.followed[k] |= share > FOLLOWED;
            let kept = &record.bearings[k];
            let pressed = (kept.contacts.last()).is_some_and(|contact| contact.end.is_none());
            if self.followed[k] && pressed && share < STANDS {
                return Some(Seizure {
                    bearing: k,
                    time,
                    speed,
                    clearance,
                    preload: following.preload(k, clearance)?,
                    temperatures: kept.warmth.as_ref()?.temperatures.clone(),
                });
            }
        }
        None
    }
}

/// Names it; none where the bearing turns to the end.
pub(crate) fn name(found: Option<&Seizure>, list: &mut List) {
    let turns = || "the bearing turns to the end".to_string();
    let found = found.ok_or_else(turns);
    let of =
        |value: &dyn Fn(&Seizure) -> f64| found.as_ref().map(|of| value(of)).map_err(String::clone);
    list.awaited("seizure_time", of(&|of| of.time), &SEIZURE);
    list.number("seizure_rotor_speed", "rad/s", of(&|of| of.speed), &SEIZURE);
    list.number("seizure_clearance", "m", of(&|of| of.clearance), &SEIZURE);
    list.number("seizure_preload", "N", of(&|of| of.preload), &SEIZURE);
    for (node, words) in [
        (INNER_RACE, "inner_race"),
        (BALLS, "balls"),
        (OUTER_RACE, "outer_race"),
    ] {
        let kelvin = of(&|of| of.temperatures[node] + ICE_POINT);
        list.number(
            &format!("seizure_{words}_temperature"),
            "K",
            kelvin,
            &SEIZURE,
        );
    }
}

/// Says it.
pub(crate) fn told(found: &Seizure, closed: Option<f64>) -> (f64, Warning) {
    let [inner, balls, outer] =
        [INNER_RACE, BALLS, OUTER_RACE].map(|node| found.temperatures[node]);
    let before = closed.map_or(String::new(), |closed| {
        format!(", {:.3} s after its clearance closed", found.time - closed)
    });
    let text = format!(
        "The bearing seizes after {:.3} s{before}: its rings press every ball with {:.0} N ({:.1} µm; inner ring {inner:.0} °C, balls \
         {balls:.0} °C, outer ring {outer:.0} °C), which brakes the inner race harder than friction of the rotor drives it, and it stands \
         against the rotor at {:.0} rad/s. The run ends there.",
        found.time,
        found.preload,
        1e6 * found.clearance,
        found.speed
    );
    (1.0 / found.time, warning("AB2322", text))
}

const SEIZURE: Origin = Origin {
    law: "P_d < 0, and the inner race, which had come to the rotor's speed and is pressed by it, has less than a tenth of that: M(P_d) > μ N r \
          has stopped it",
    source: "crates/auxbear/src/simulate/drop/seizure.rs; book/src/theory/heat.md",
    valid: "as smallest_clearance, within a factor of two of its temperatures; films that break down, smearing and creeping rings come before and are not \
            modelled",
};
