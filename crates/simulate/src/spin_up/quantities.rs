//! Every named result of a spin-up with its law, source and valid range.

use crate::bearing::quantities::{BearingSetup, balls};
use crate::rig::run::{RigModel, name_temperatures};
use crate::spin_up::{Context, given};
use crate::static_safety::{AT_THE_LOAD, no_safety, safety_under};
use catalogue::geometry::digits;
use model::system::cage_turns::LateMeans;
use model::system::outer_race::OuterRaceEnergy;
use model::system::rig::layout::{
    CAGE_SLIP, CAGE_SPEED, INNER, INNER_MOMENT, OUTER_MOMENT, ROTOR, STEADY_MOMENT,
};
use outcome::list::results;
use outcome::list::{List, origins, relative};
use outcome::{Quantity, Value};
use scenario::{Drive, Fidelity, SpinUp};

const EQUATIONS: &str =
    "equations of motion, crates/model/src/system/rig/fixture.rs and crates/model/src/bearing/";
const LEDGER: &str = "energy ledger, crates/model/src/system/machine/ledger.rs";

/// Cage slip from which balls are said to skid.
const SKIDDING: f64 = 0.02;
/// Share of the final speed that a race may lose on its way and still count as gaining speed only.
const LOST_SPEED: f64 = 0.01;
/// Share of the full speed below which a slip means nothing.
const LEAST_SPEED: f64 = 0.05;

/// Names the results; without a run those of any.
pub(crate) fn name(spin_up: &SpinUp, built: &RigModel, run: Option<&Context>) -> Vec<Quantity> {
    let mut list = List::default();
    motion(&mut list, spin_up, run);
    let bearing = BearingSetup {
        given: &spin_up.bearing,
        constants: &built.machine.constants.bearings[0].bearing,
        factors: &built.pressure_factors,
    };
    balls(&mut list, &bearing, run.map(|run| run.bearing()).as_ref());
    load(&mut list, spin_up, run);
    let heated = given(spin_up).heated(built);
    name_temperatures(&mut list, heated, run.map(|run| &**run));
    energies(&mut list, spin_up, run);
    list.ended_at(run.map(|run| run.ending.time))
}

results! {
    fn motion(spin_up: &SpinUp, run: &Context) {
        "inner_race_time_to_50_percent": instant "s", RISE, "time to half of the full speed" in instants "race 50 %" => {
            run.reached(run.record.bearings[0].inner_race_time_to_50_percent(), "half of the full speed", 0.5 * spin_up.target_speed())
        };
        "inner_race_time_to_95_percent": instant "s" headline, RISE, "time to 95 % of the full speed" in instants "race 95 %" in tile "Inner race at 95 % speed" => {
            run.reached(run.record.bearings[0].inner_race_time_to_95_percent(), "95 % of the full speed", 0.95 * spin_up.target_speed())
        };
        "cage_time_to_95_percent_of_rolling": instant "s" headline, RISE, "time of the cage to 95 % of its rolling speed" in instants "cage 95 % of rolling" in note "Inner race at 95 % speed: the cage at 95 % of rolling at" => {
            let rolling = spin_up.target_speed() * run.built.machine.constants.bearings[0].bearing.rolling_cage_ratio();
            run.reached(run.record.bearings[0].cage_time_to_95_percent(), "95 % of the rolling cage speed", 0.95 * rolling)
        };
        "inner_race_final_speed": number "rad/s", SPEED, "speed of the inner race at the end" => run.ending.state[INNER.spin()];
        "cage_final_speed": number "rad/s", SPEED, "speed of the cage at the end" => run.probe(CAGE_SPEED);
        "rotor_final_speed": number "rad/s", SPEED, "speed of the sliding rotor at the end" => match spin_up.drive {
            Drive::SlidingRotor { .. } => Ok(run.ending.state[ROTOR.spin()]),
            Drive::Torque { .. } | Drive::Speed(_) => Err("no rotor slides here".to_string()),
        };
        "peak_inner_race_moment": number "N m" headline, PEAK_MOMENT, "largest moment on the inner race" in tile "Largest moment t_I" => run.rig().inner_moment.value;
        "peak_outer_race_moment": number "N m" headline, PEAK_MOMENT, "largest moment on the outer race" in tile "Largest moment t_O" => run.rig().outer_moment.value;
        "peak_drive_moment": number "N m", PEAK_MOMENT, "largest moment of the drive" => run.rig().drive_moment.value;
        "inner_race_moment_at_end": number "N m", INNER_RACE, "moment that resists the inner race at the end" => run.probe(INNER_MOMENT);
        "outer_race_moment_at_end": number "N m", OUTER_RACE, "moment on the outer race at the end" => run.probe(OUTER_MOMENT);
        "law_moment_at_end": number "N m" headline, LAW, "moment of the friction law at the end" => run.by_law(run.probe(STEADY_MOMENT));
        "inner_race_mean_moment": number "N m", MEAN_MOMENT, "mean moment that resists the inner race" in note "Largest moment t_I: mean of the last cage turns" => run.late_means().map(|means| means.inner_moment);
        "outer_race_mean_moment": number "N m", MEAN_MOMENT, "mean moment on the outer race" in note "Largest moment t_O: mean of the last cage turns" => run.late_means().map(|means| means.outer_moment);
        "law_mean_moment": number "N m", LAW, "mean moment of the friction law" => {
            run.by_law(()).and_then(|()| run.late_means()).map(|means| means.steady_moment)
        };
        "traction_capacity": number "1" headline, CAPACITY, "largest traction moment over the steady moment" in note "Balls skid: traction over the steady moment, 1.2 needed:" => {
            run.by_law(run.built.steady.as_ref().map_or(f64::NAN, |steady| steady.capacity))
        };
        "cage_slip_at_end": number "1", SLIP, "cage slip at the end" => run.if_balls_slide().map(|()| run.probe(CAGE_SLIP));
        "cage_mean_slip": number "1", SLIP, "mean cage slip at the final speed" => {
            run.if_balls_slide().and_then(|()| run.late_means()).map(|means| means.cage_slip)
        };
        "balls_skid": text "" headline, SKID, "whether and when the balls skid" in tile "Balls skid" in bound "still at the end / no" => run.skid();
    }
    fn load(spin_up: &SpinUp, run: &Context) {
        "static_safety": number "1", AT_THE_LOAD, "static load rating over equivalent static load", unless no_safety(&spin_up.bearing) => {
            safety_under(run.spin_up.radial_load.largest_until(run.spin_up.run.duration), &spin_up.bearing)
        };
    }
    fn energies(spin_up: &SpinUp, run: &Context) {
        "rotor_race_friction_energy": number "J", ENERGY, "friction heat of rotor and inner race" => run.bearing().heat("rotor_race_friction");
        "ball_slip_energy": number "J", ENERGY, "sliding heat of the balls at both races" => run.bearing().ball_slip();
        "dissipated_energy": number "J", ENERGY, "heat of all losses" => run.whole_balance().heat();
        "bearing_dissipated_energy": number "J" headline, ENERGY, "heat of the losses in the bearing" in outer_race_energy "true: sum of all heats in the bearing" => run.outer_race_energy().dissipated;
        "outer_race_energy_printed": number "J" headline, PRINTED, "dissipation by the outer race's moment, as printed" in outer_race_energy "(21) as printed: (1 + 2s) ∫ t_O Ω dt + ½ J Ω₀²" => run.outer_race_energy().printed;
        "outer_race_energy_corrected": number "J" headline, CORRECTED, "dissipation by the outer race's moment, corrected" in outer_race_energy "(21) corrected, for balls that roll: ∫ t_O Ω dt + ½ J Ω₀²" => run.outer_race_energy().corrected;
        "outer_race_energy_exact": number "J" headline, EXACT, "dissipation by the outer race's moment, exact" in outer_race_energy "exact: ∫ t_O Ω dt + ∫ Ω dL − Δ(KE + U)" => run.outer_race_energy().exact;
        "path_term": number "J", PATH, "path term of balls and cage" in path_terms "this run: ∫ Ω dL" => run.outer_race_energy().path;
        "path_term_if_rolling": number "J", PATH, "path term if the balls roll all the way" in path_terms "balls that roll all the way: ½ L₀ Ω₀" => run.if_rolling(|forms| forms.least_path);
        "path_term_if_spun_up_after": number "J", PATH, "path term if the balls are spun up after the race" in path_terms "balls spun up after the race: L₀ Ω₀" => {
            run.if_rolling(|forms| forms.path_behind_the_race)
        };
        "path_term_largest": number "J", PATH, "largest path term" in path_terms "the largest: balls spin with the race, and orbit last" => run.if_rolling(|forms| forms.largest_path);
        "energy_residual": number "1" headline, RESIDUAL, "residual of the energy ledger over what is turned over" in tile "Energy residual" in bound "AB1006" => {
            let balance = run.whole_balance();
            relative(balance.energy_residual(), balance.heat().max(balance.work_size()))
        };
        "angular_momentum_residual": number "1", RESIDUAL, "residual of the angular momentum over that at full speed" => {
            let constants = &run.built.machine.constants;
            let part = &constants.bearings[0];
            let inertia = part.inner_race.inertia + part.bearing.set().inner_inertia();
            relative(run.whole_balance().angular_momentum_residual(), inertia * constants.speed.abs())
        };
    }
}

impl Context<'_> {
    /// The instant at which a speed is reached, s.
    fn reached(&self, time: Option<f64>, what: &str, speed: f64) -> Result<f64, String> {
        let never = || {
            let instant = digits(1e3 * self.ending.time);
            format!("{what} ({speed:.1} rad/s) was not reached in {instant} ms")
        };
        time.ok_or_else(never)
    }
    /// What exists where the bearing has a friction law.
    fn by_law<T>(&self, value: T) -> Result<T, String> {
        let steady = self.built.steady.as_ref().map(|_| value);
        steady.ok_or_else(|| "bearing.moment.law is none".to_string())
    }
    /// Means over the last turns of the cage at the final speed, or why there are none.
    fn late_means(&self) -> Result<LateMeans, String> {
        if self.ending.stop != solve::Stop::Finished {
            return Err("the run ended early".to_string());
        }
        let speed = self.ending.state[INNER.spin()];
        self.rig().turns.late_means(speed).ok_or_else(|| {
            let ratio = self.built.machine.constants.bearings[0].bearing.rolling_cage_ratio();
            let turn = 2.0 * std::f64::consts::PI / (ratio * self.spin_up.target_speed()).abs();
            format!(
                "the race was at its final speed for less than a turn of the cage ({:.4} ms at full speed)",
                1e3 * turn
            )
        })
    }
    /// Whether a speed is one that slip may be compared with: a race at rest has none.
    fn is_fast(&self, speed: f64) -> bool {
        speed.abs() > LEAST_SPEED * self.spin_up.target_speed().abs()
    }
    /// Why balls have no slip at the end.
    fn if_balls_slide(&self) -> Result<(), String> {
        match self.spin_up.bearing.fidelity {
            Fidelity::Rolling | Fidelity::Spatial => {
                Err("the rolling fidelity takes the balls to roll".to_string())
            }
            Fidelity::Planar if self.is_fast(self.ending.state[INNER.spin()]) => Ok(()),
            Fidelity::Planar => Err("the inner race hardly turns at the end".to_string()),
        }
    }
    /// Whether the balls skid, in words.
    fn skid(&self) -> Value {
        let slides = self.if_balls_slide();
        if let (Fidelity::Rolling, Err(why)) = (self.spin_up.bearing.fidelity, &slides) {
            return Value::None { why: why.clone() };
        }
        let rows = self.record.rows();
        let fast = rows.filter(|row| self.is_fast(row.state[INNER.spin()]));
        // a cage that runs ahead of rolling skids as well
        let largest = fast
            .map(|row| row.probe[CAGE_SLIP].abs())
            .fold(0.0, f64::max);
        if slides.is_ok() && self.late_slip().abs() > SKIDDING {
            "still at the end".into()
        } else if largest > SKIDDING {
            "while the race speeds up".into()
        } else {
            "no".into()
        }
    }
    /// A bound of the path term, J, or why it does not hold.
    fn if_rolling(&self, bound: fn(&OuterRaceEnergy) -> f64) -> Result<f64, String> {
        rolling_start_to_end(self).map(|()| bound(&self.outer_race_energy()))
    }
}

/// What (21) and the bounds of the path term take for granted: from rest the race only gains speed, and the balls roll
/// at the end. The reason where it does not hold.
pub(crate) fn rolling_start_to_end(context: &Context) -> Result<(), String> {
    let end = context.ending.state[INNER.spin()];
    let mut fastest = 0.0_f64;
    for row in context.record.rows() {
        let speed = row.state[INNER.spin()] * end.signum();
        if speed < fastest - LOST_SPEED * end.abs() {
            return Err("the inner race loses speed on the way".to_string());
        }
        fastest = fastest.max(speed);
    }
    let slip = context.late_slip();
    if slip.abs() > SKIDDING {
        return Err(format!(
            "the balls do not roll at the end: cage slip {:.1} %",
            1e2 * slip
        ));
    }
    Ok(())
}

origins! {
    RISE: law "first instant at which the speed reaches the level; full speed is that of the rotor, the final one of the drive, or drive.reference_speed",
        source EQUATIONS,
        valid "constant friction coefficient between rotor and race";
    SPEED: law "angular momentum of each body about its axis",
        source EQUATIONS,
        valid "the outer race stands";
    PEAK_MOMENT: law "largest size of the moment at the ends of the steps",
        source EQUATIONS,
        valid "moments on the inner race t_I, on the outer race t_O, of the drive; a step of speed needs an impulse besides";
    INNER_RACE: law "t_I = Σ(R T_I + m_i), what the inner race feels against its rotation",
        source EQUATIONS,
        valid "a single instant; balls passing the load make it ripple";
    OUTER_RACE: law "t_O: everything the outer race receives; t_I - t_O = dL/dt of balls and cage on a concentric rig",
        source EQUATIONS,
        valid "a single instant; the reaction that a torque arm measures";
    LAW: law "M(Ω, W) of bearing.moment.law, unscaled",
        source "crates/physics/src/friction.rs and the law's own page",
        valid "the law's own range; leaving it is a warning of the run";
    MEAN_MOMENT: law "mean of t_I or t_O over cage turns: the later half of those at the end in which the speed stayed within 1 %",
        source EQUATIONS,
        valid "free of the ripple of passing balls; a steady moment once t_I and t_O agree";
    CAPACITY: law "μ_max R ΣQ_i / M at full speed under the last load",
        source "crates/model/src/system/rig/capacity.rs",
        valid "above 1.2 the balls roll in a steady run and t_I = t_O = M within 2 %; below they must skid";
    SLIP: law "S = 1 - 2(1+s)ω_c/Ω, at the last instant, or as the mean over the later half of the cage turns at the final speed",
        source "Harris 2001, section 8: kinematics of a rolling ball, crates/physics/src/kinematics.rs",
        valid "pockets let the cage lead and lag a little from instant to instant";
    SKID: law "cage slip above 2 % in the mean of the last cage turn, or at any row above 5 % of the full speed",
        source "definition",
        valid "rows of the history";
    ENERGY: law "time integral of friction force times sliding speed, and of every other loss",
        source LEDGER,
        valid "nothing is cooled or warmed by it";
    PRINTED: law "D = (1+2s)∫t_O Ω dt + ½(1+2s)(3/20 N m_b + ¼ m_c)R²Ω0²",
        source "the source paper, (21) as printed",
        valid "nowhere: its integral must not bear the factor 1+2s; shown for comparison";
    CORRECTED: law "D = ∫t_O Ω dt + ½(1+2s)(3/20 N m_b + ¼ m_c)R²Ω0²",
        source "the source paper, (21), corrected; crates/model/src/system/outer_race.rs",
        valid "from rest, balls that roll all the way; wrong by up to half of L0 Ω0 where they skid";
    EXACT: law "D = ∫(t_O + t_g)Ω dt + ∫Ω dL - Δ(KE + U)",
        source "balance of energy and angular momentum of balls and cage, crates/model/src/system/outer_race.rs",
        valid "any skidding; needs the speed of the cage, or the path term as an uncertainty";
    PATH: law "∫Ω dL of balls and cage: ½ L0 Ω0 where they roll all the way, L0 Ω0 where they are spun up after the race, \
          ½ (1+s)(N m_b + m_c) R² Ω0² where they spin with the race and orbit last",
        source "crates/physics/src/spin_up_energy.rs",
        valid "the bounds: from rest, a race that only gains speed and leads its balls, balls that roll at the end";
    RESIDUAL: law "what the ledger misses at the end, over max(heat, works); momentum over that of race, balls and cage at full speed",
        source LEDGER,
        valid "a measure of the integration error; it falls with run.tolerance";
}
