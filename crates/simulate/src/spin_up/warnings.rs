//! What the user should know before trusting the numbers of a spin-up.

use crate::assumptions::speed_rating;
use crate::bearing::warm;
use crate::bearing::warnings as shared;
use crate::spin_up::quantities::rolling_start_to_end;
use crate::spin_up::{Context, asked};
use model::auxiliary_bearing::probe::NORMAL_FORCE;
use model::system::rig::layout::INNER;
use outcome::{Quantity, Warning};
use physics::palmgren::FADING_SPEED;
use scenario::{Bearing, Moment, Scenario};

/// A radial load beyond what the axial preload holds. Where the inner race is held no load reaches the balls.
pub fn preload_of_spin_up(bearing: &Bearing, load: f64) -> Option<Warning> {
    if bearing.inner_race_centre_held {
        return None;
    }
    shared::preload_left(bearing, ("radial load", load), None)
}

problem::warnings! {
    /// Of a spin-up.
    pub enum SpinUpWarning {
        CentreHeld "AB1020" Note
            ("The centre of the inner race is held (the concentric rig): the radial load reaches the rotor's friction and the friction law, not the balls, which carry their preload alone.");
        CorrectedForm { why: words } "AB1026" Uncertain
            ("The corrected form of (21) does not hold in this run: {why}. The exact form does; the bounds of the path term are left out.");
        Creeps { speed: "rad/s" } "AB1098" Uncertain
            ("The inner race creeps with {speed:.2e} rad/s at most. The friction law fades below {TURNS} rad/s, so what drives the race is less than the moment that it needs: a real bearing stands still under it.");
    }
}

/// Speed from which on friction acts in full, rad/s.
const TURNS: f64 = 10.0 * FADING_SPEED;

/// A race that does not come to the speed at which its friction acts in full.
fn creeps(bearing: &Bearing, speed: f64) -> Option<Warning> {
    (bearing.moment != Moment::None && speed > 0.0 && speed < TURNS)
        .then(|| SpinUpWarning::Creeps { speed }.into())
}

/// All warnings of a run, the most severe first.
pub(crate) fn of(scenario: &Scenario, context: &Context, quantities: &[Quantity]) -> Vec<Warning> {
    let bearing = &context.spin_up.bearing;
    let mut list = Vec::new();
    let largest = |value: &dyn Fn(&model::system::sampling::Row) -> f64| {
        let rows = context.record.rows();
        rows.map(|row| value(&row).abs()).fold(0.0, f64::max)
    };
    let speed = largest(&|row| row.state[INNER.spin()]);
    let load = largest(&|row| row.probe[NORMAL_FORCE]);
    list.extend(creeps(bearing, speed));
    list.extend(shared::skids(context.built.steady.as_ref()));
    if let Some(followed) = context.followed() {
        list.extend(
            warm::judged(&followed)
                .into_iter()
                .map(|(_, warning)| warning),
        );
    }
    list.extend(context.bearing().hot_skid().map(|(_, warning)| warning));
    list.extend(speed_rating(bearing, speed));
    list.extend(shared::lift_off(bearing, speed));
    let run = context.bearing();
    let pressures = shared::pressure(bearing, &run.pressures()).into_iter();
    list.extend(pressures.map(|(_, warning)| warning));
    list.extend(shared::films(&run, bearing));
    list.extend(preload_of_spin_up(bearing, load));
    list.extend(shared::law_range(bearing, speed, load));
    list.extend(shared::film_rise(&run));
    let asked = asked(context.spin_up, context.built);
    let most = asked.largest_residual(shared::LARGEST_RESIDUAL);
    list.extend(shared::residual(quantities, most));
    list.extend(asked.warnings(asked.stepping(|| 0.0).steps));
    if bearing.inner_race_centre_held && load > 0.0 {
        list.push(SpinUpWarning::CentreHeld.into());
    }
    if context.ending.time > 0.0
        && let Err(why) = rolling_start_to_end(context)
    {
        list.push(SpinUpWarning::CorrectedForm { why }.into());
    }
    list.extend(shared::cage_inertia(bearing));
    list.extend(shared::rolling(bearing));
    list.extend(shared::no_moment(bearing));
    list.extend(shared::moment(scenario, "", bearing));
    list.extend(shared::kind(bearing));
    list.extend(shared::assumed(scenario, None, Some(bearing)));
    list
}
