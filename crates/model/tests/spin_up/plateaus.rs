//! Plateaus of speed, one after the other, and the moments of a bearing on each.

use super::rig::{observe, race};
use crate::machines::{settings, vec2};
use model::auxiliary_bearing::RaceConstants;
use model::bearing::{BearingConstants, PlanarConstants};
use model::system::machine::RotorMachine;
use model::system::machine::record::Record;
use model::system::rig::capacity::traction_capacity;
use model::system::rig::layout::{INNER, INNER_LOAD_SUM};
use model::system::rig::{Drive, RigConstants};
use model::table::Table;

/// Means over the late cage turns of a plateau.
#[derive(Clone, Copy, Debug)]
#[allow(dead_code)] // the speed is for messages
pub struct Plateau {
    pub speed: f64,
    /// t_I/M.
    pub inner: f64,
    /// t_O/M.
    pub outer: f64,
    pub cage_slip: f64,
    /// Traction capacity at the end.
    pub capacity: f64,
}

/// Ramps, rad/s²: those of the source paper's spin-ups are 1300 to 11 500.
const ACCELERATION: f64 = 1e4;

/// Cage turns of a plateau, of which the later half counts.
const TURNS: f64 = 3.0;

/// Runs through speeds, one after the other, from rest.
pub fn plateaus(bearing: &PlanarConstants, load: f64, speeds: &[f64]) -> Vec<Plateau> {
    let mut from = 0.0;
    let mut state: Option<Vec<f64>> = None;
    let mut list = Vec::new();
    for &speed in speeds {
        let ramp = f64::abs(speed - from) / ACCELERATION;
        let constants = RigConstants {
            housing: None,
            warm: None,
            race: RaceConstants {
                centre_held: false,
                ..race()
            },
            load_direction: vec2(0.0, -1.0),
            gravity: vec2(0.0, 0.0),
            bearing: BearingConstants::Planar(bearing.clone()),
            drive: Drive::Speed(Table::through(vec![(0.0, from), (ramp, speed)]).expect("rises")),
            load: Table::constant(load),
            target_speed: speed,
        };
        let turn = 2.0 * std::f64::consts::PI / (constants.bearing.rolling_cage_ratio() * speed);
        let end = ramp + TURNS * turn.abs();
        let machine = RotorMachine::on_rig(constants).expect("the machine can be built");
        let start = state.take().unwrap_or_else(|| machine.start());
        let mut record = Record::new(&machine, end, end, false);
        let ending = observe(&machine, &start, &settings(end, 1e-4), &mut record);
        let means = record
            .rig()
            .turns
            .late_means(speed)
            .expect("turns at the speed");
        let (_, probe) = machine.inspect_at(ending.time, &ending.state);
        let capacity = traction_capacity(
            &bearing.traction,
            &machine.constants.bearings[0].bearing,
            speed,
            probe[INNER_LOAD_SUM],
        );
        list.push(Plateau {
            speed,
            inner: means.inner_moment / means.steady_moment,
            outer: means.outer_moment / means.steady_moment,
            cage_slip: means.cage_slip,
            capacity: capacity / means.steady_moment.abs(),
        });
        state = Some(ending.state);
        from = state.as_ref().expect("just set")[INNER.spin()];
    }
    list
}
