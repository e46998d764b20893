//! Every named result of a test on a rig with its law, source and valid range: what happened, not what was measured of it.

use crate::bearing::quantities::{BearingSetup, ball_loads, races_and_lubricant};
use crate::rig::run::{RigModel, name_temperatures};
use crate::rig::{Context, given};
use crate::static_safety::{AT_THE_LOAD, no_safety, safety_under};
use model::system::rig::layout::{
    CAGE_SPEED, DRIVE_HEAT, FLYWHEEL, INNER_MOMENT, OUTER_MOMENT, SHAFT, STEADY_MOMENT,
};
use outcome::Quantity;
use outcome::list::results;
use outcome::list::{List, origins, relative};
use scenario::{Fidelity, Rig, RigProgram};
use thermal::bearing_network::OUTER_RACE;

const EQUATIONS: &str = "equations of motion, crates/model/src/system/rig/fixture.rs";
const LEDGER: &str = "energy ledger, crates/model/src/system/machine/ledger.rs";

/// Names the results; without a run those of any.
pub(crate) fn name(rig: &Rig, built: &RigModel, run: Option<&Context>) -> Vec<Quantity> {
    let mut list = List::default();
    motion(&mut list, rig, run);
    name_temperatures(&mut list, given(rig).heated(built), run.map(|run| &**run));
    let bearing = BearingSetup {
        given: &rig.bearing,
        constants: &built.machine.constants.bearings[0].bearing,
        factors: &built.pressure_factors,
    };
    let balls = run.map(|run| run.bearing());
    ball_loads(&mut list, &bearing, balls.as_ref());
    races_and_lubricant(&mut list, &bearing, balls.as_ref());
    energies(&mut list, rig, run);
    list.ended_at(run.map(|run| run.ending.time))
}

results! {
    fn motion(rig: &Rig, run: &Context) {
        "engagement_time": number "s" headline, ENGAGEMENT, "instant at which the clutch engages" in instants "engaged" in change "engaged" in note "Clutch locked: engaged at" => engages_at(run.rig);
        "clutch_torque_rate": number "N m/s" headline, RATE, "rate of the torque that the clutch can carry" in note "Peak acceleration: rate of the clutch" => run.built.torque_rate.ok_or_else(no_clutch);
        "clutch_lock_time": number "s" headline, ENGAGEMENT, "instant at which the clutch locks" in instants "locked" in change "locked" in tile "Clutch locked" => {
            let slips = || "the clutch still slips at the end".to_string();
            engages_at(rig).and_then(|_| run.rig().locked_at().ok_or_else(slips))
        };
        "peak_acceleration": number "rad/s^2" headline, PEAK_ACCELERATION, "largest acceleration of the shaft" in tile "Peak acceleration" => match rig.program {
            RigProgram::CoastDown { .. } => 0.0 - run.rig().deceleration.value,
            _ => run.rig().acceleration.value,
        };
        "peak_deceleration": number "rad/s^2", PEAK_DECELERATION, "largest deceleration of the shaft, below 0" => 0.0 - run.rig().deceleration.value;
        "shaft_time_to_50_percent": instant "s", RISE, "time to half of rig.speed" => run.record.bearings[0].inner_race_time_to_50_percent().ok_or_else(|| never(50.0));
        "shaft_time_to_95_percent": instant "s", RISE, "time to 95 % of rig.speed" => run.record.bearings[0].inner_race_time_to_95_percent().ok_or_else(|| never(95.0));
        "cage_time_to_95_percent_of_rolling": instant "s", RISE, "time of the cage to 95 % of its rolling speed" => {
            run.record.bearings[0].cage_time_to_95_percent().ok_or_else(|| never(95.0))
        };
        "shaft_final_speed": number "rad/s" headline, SPEED, "speed of the shaft at the end" => run.ending.state[SHAFT.spin()];
        "flywheel_final_speed": number "rad/s", SPEED, "speed of the flywheel at the end" => run.ending.state[FLYWHEEL.spin()];
        "cage_final_speed": number "rad/s", SPEED, "speed of the cage at the end" => run.probe(CAGE_SPEED);
        "peak_clutch_torque": number "N m" headline, PEAK_MOMENT, "largest torque of the clutch" => run.rig().drive_moment.value;
        "peak_inner_race_moment": number "N m", PEAK_MOMENT, "largest moment on the inner race" => run.rig().inner_moment.value;
        "peak_outer_race_moment": number "N m" headline, PEAK_MOMENT, "largest moment on the outer race" in tile "Largest moment t_O" => run.rig().outer_moment.value;
        "inner_race_moment_at_end": number "N m", AT_END, "moment that resists the inner race at the end" => run.probe(INNER_MOMENT);
        "outer_race_moment_at_end": number "N m", AT_END, "moment on the outer race at the end" => run.probe(OUTER_MOMENT);
        "law_moment_at_end": number "N m", AT_END, "moment of the friction law at the end" => run.probe(STEADY_MOMENT);
        "cage_slip_at_end": number "1" headline, SLIP, "mean cage slip over the last cage turn" in tile "Cage slip at the end [%]" => run.slip_at_end();
        "peak_temperature_rise": number "K" headline, TEMPERATURE, "largest rise of the outer race" => {
            run.followed().map_or(run.rig().temperature.value, |of| of.warmth.peaks[OUTER_RACE].0 - of.heated.part.start)
        };
    }
    fn energies(rig: &Rig, run: &Context) {
        "static_safety": number "1", AT_THE_LOAD, "static load rating over equivalent static load", unless no_safety(&rig.bearing) => {
            safety_under(run.rig.load.radial_load, &rig.bearing)
        };
        "dissipated_energy": number "J", ENERGY, "heat of all losses" => run.whole_balance().heat();
        "clutch_heat": number "J", ENERGY, "friction heat of the clutch" => run.heat(DRIVE_HEAT);
        "bearing_dissipated_energy": number "J" headline, ENERGY, "heat of the losses in the bearing" => (0..DRIVE_HEAT).map(|kind| run.heat(kind)).sum::<f64>();
        "energy_residual": number "1" headline, RESIDUAL, "residual of the energy ledger over what is turned over" in tile "Energy residual" in bound "AB1006" => {
            let balance = run.whole_balance();
            relative(balance.energy_residual(), balance.heat().max(balance.work_size()))
        };
        "angular_momentum_residual": number "N m s" headline, MOMENTUM, "residual of the angular momentum of balls and cage" in tile "Angular momentum residual" in bound "1e-8" => {
            run.built.machine.bearing_momentum_residual(&run.start, &run.ending.state)
        };
        "clipped_channels": text "" headline, CLIPPED, "channels with values beyond the converter" => run.clipped_channels().as_str();
    }
}

fn no_clutch() -> String {
    "the clutch does not engage in this test".to_string()
}

fn never(share: f64) -> String {
    format!("{share} % of rig.speed was not reached")
}

/// When the clutch engages, s.
fn engages_at(rig: &Rig) -> Result<f64, String> {
    match rig.program {
        RigProgram::SpinUp { engage_at, .. } | RigProgram::RepeatAfterRest { engage_at, .. } => {
            Ok(engage_at)
        }
        RigProgram::CoastDown { .. } | RigProgram::RampAndHold { .. } => Err(no_clutch()),
    }
}

impl Context<'_> {
    /// Cage slip over the last turn of the cage, or at the last instant where there was none.
    fn slip_at_end(&self) -> Result<f64, String> {
        let turns = self.ending.state[SHAFT.spin()].abs() > 0.05 * self.rig.speed;
        match (self.rig.bearing.fidelity, turns) {
            (Fidelity::Rolling | Fidelity::Spatial, _) => {
                Err("the rolling fidelity takes the balls to roll".to_string())
            }
            (Fidelity::Planar, false) => Err("the shaft hardly turns at the end".to_string()),
            (Fidelity::Planar, true) => Ok(self.late_slip()),
        }
    }
    /// Channels of which values were clipped, with their number.
    fn clipped_channels(&self) -> String {
        let each = self.clipped.iter();
        let told: Vec<String> = each
            .map(|(name, count)| format!("{name}: {count} values"))
            .collect();
        match told.is_empty() {
            true => "none".to_string(),
            false => told.join(", "),
        }
    }
}

origins! {
    ENGAGEMENT: law "engaged as the program says; locked where flywheel and shaft first turn at the same speed",
        source "crates/model/src/system/rig/clutch.rs",
        valid "the instant of locking is found on the dense output of the step";
    RATE: law "rise of the torque that the clutch can carry: as given, or found for the wanted peak acceleration",
        source "crates/model/src/system/rig/ramp.rs",
        valid "found with balls that roll; balls that skid take a little less of the shaft";
    PEAK_ACCELERATION: law "largest acceleration of the shaft in the direction of its turning while the test brings it up; of a coast-down, that of its slowing; as peak_acceleration of measured signals",
        source EQUATIONS,
        valid "at the ends of the steps, which include the locking";
    PEAK_DECELERATION: law "largest acceleration of the shaft against its turning, below 0: the release, the running out",
        source EQUATIONS,
        valid "at the ends of the steps, which include the release";
    RISE: law "first instant at which the speed reaches the level of rig.speed",
        source EQUATIONS,
        valid "time counts from the start of the test";
    SPEED: law "angular momentum of each body about its axis",
        source EQUATIONS,
        valid "stiff shaft and clutch";
    PEAK_MOMENT: law "largest size of the moment at the ends of the steps",
        source EQUATIONS,
        valid "what happened; the arm swings and the logger adds noise";
    AT_END: law "t_I on the shaft, t_O on the outer race, and M(Ω, W) of the law, at the last instant",
        source EQUATIONS,
        valid "a single instant";
    SLIP: law "S = 1 - 2(1+s)ω_c/Ω, mean over the last cage turn",
        source "Harris 2001, section 8: kinematics of a rolling ball, crates/physics/src/kinematics.rs",
        valid "as it happened; what a sensor measures has its own band";
    TEMPERATURE: law "of the outer race: C Ṫ = heats of the bearing - G T of one node, or of the network where heat.network = \"on\"",
        source EQUATIONS,
        valid "one node: the moment does not depend on it unless bearing.lubricant_state says so; network: heat.feedback";
    ENERGY: law "time integral of every loss: force or couple times the relative speed",
        source LEDGER,
        valid "from the start of the test to its end";
    RESIDUAL: law "what the ledger misses at the end, over max(heat, works)",
        source LEDGER,
        valid "a measure of the integration error; it falls with run.tolerance";
    MOMENTUM: law "∫(t_I - t_O - t_g + moments of weights and of forces off the centre) dt - ΔL of balls and cage",
        source LEDGER,
        valid "zero but for errors: t_I - t_O = dL/dt on the concentric rig";
    CLIPPED: law "values beyond the range of the converter",
        source "crates/simulate/src/rig/chain.rs",
        valid "the raw file holds the end of the range there";
}
