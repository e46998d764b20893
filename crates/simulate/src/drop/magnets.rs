//! What a run shows of magnets whose controllers act in time, or whose currents decay.

use crate::bearing::columns::Table;
use crate::bearing::run::BearingRun;
use crate::drop::Shaft;
use crate::drop::context::{Context, Setup};
use crate::drop::warning_table::ShaftWarning;
use crate::ending;
use levitation::{Actuator, Amplifier};
use model::system::machine::record::{AT_POLE, AtLimit, CurrentPeak};
use outcome::columns::columns;
use outcome::list::results;
use outcome::list::{List, origins};
use outcome::{Column, Stop, Warning};

/// Share of the time with power at a limit from which on it is reported.
const LONG_AT_LIMIT: f64 = 1e-4;

/// An axis of a magnet by the name of that and its number: both axes of each stand in turn.
fn of_axis(given: &Shaft, axis: usize) -> [String; 2] {
    let magnets = given.model.levitation.iter().flat_map(|own| &own.magnets);
    let name = magnets.map(|(name, ..)| name.clone()).nth(axis / 2);
    [name.unwrap_or_default(), (axis % 2 + 1).to_string()]
}

/// The axes of all magnets.
fn own_axes(given: &Shaft) -> &[Actuator] {
    let model = given.model.levitation.as_ref();
    model.map_or(&[], |own| own.levitation.actuators())
}

/// Name of a value of an axis of a magnet.
pub(super) fn value_of(given: &Shaft, axis: usize, what: &str) -> String {
    let [name, number] = of_axis(given, axis);
    format!("magnet.{name}.{what}_{number}")
}

/// Share of its gap from which on a run that diverges does so at a magnet's pole.
const NEAR_POLE: f64 = 0.8;

/// How a run ended; where it diverged because the rotor came to a pole, which.
pub(crate) fn stop(context: &Context) -> Stop {
    let ending = &context.finished.ending;
    let mut stop = ending::stop(ending);
    let shares = context.setup.machine.towards_poles(&ending.state);
    let nearest = (shares.iter().enumerate()).max_by(|a, b| a.1.total_cmp(b.1));
    let halted = ending.stop == solve::Stop::Halted(AT_POLE);
    let diverged = halted || matches!(ending.stop, solve::Stop::Diverged { .. });
    if let (Some((axis, share)), Some(given), true) =
        (nearest, &context.setup.drop().shaft, diverged)
        && *share > NEAR_POLE
    {
        stop.text = format!(
            "{} at {:.4} ms: the rotor has come {:.0} % of the way to a pole along {}, where the pull grows without bound. What should \
             hold it before, auxiliary bearings and their mounts, lets it come so far: it needs a smaller clearance, or a mount \
             that is stiffer or has a stop.",
            if halted { "Stopped" } else { "Diverged" },
            1e3 * ending.time,
            100.0 * share,
            value_of(given, axis, "axis")
        );
    }
    stop
}

/// Why nothing is released.
pub(crate) fn kept() -> String {
    "the magnets had power to the end".to_string()
}

/// Names what the controllers did.
pub(crate) fn name(list: &mut List, setup: Setup, run: Option<&Context>) {
    let Some(given) = setup.controlled() else {
        return;
    };
    loss(list, given, run);
    for (k, _) in setup.machine.axes().enumerate() {
        let [name, number] = of_axis(given, k);
        let own = run.map(|run| &run.finished.record.currents[k]);
        let pair = own_axes(given)[k].magnet.gap().is_finite();
        list.named(&[&name, &number], |list| current(list, &pair, own));
    }
}

results! {
    /// When the magnets lose their power.
    fn loss(given: &Shaft, run: &Context) {
        "power_lost_at": number "s", LOST, "instant at which the magnets lose their power" => {
            run.finished.record.lost.map(|(time, _)| time).ok_or_else(kept)
        };
        "speed_at_power_loss": number "rad/s", LOST, "speed of the rotor at this instant" => run.finished.record.lost.map(|(_, spin)| spin).ok_or_else(kept);
    }
    fn current(pair: &bool, run: &CurrentPeak) {
        "magnet.*.largest_current_*": number "A", CURRENT, "largest control current of this axis" => run.largest.value;
        "magnet.*.largest_coil_current_*": number "A", COIL, "largest current of a coil of this axis" when *pair => run.coil.value;
    }
}

/// Control currents of all axes.
pub(crate) fn columns(setup: Setup, run: &BearingRun) -> Vec<Column> {
    let machine = setup.machine;
    let Some(given) = &setup.drop().shaft else {
        return Vec::new();
    };
    let mut table = Table::over(run);
    for (axis, own) in machine.axes().enumerate() {
        let angle = own.direction.y.atan2(own.direction.x).to_degrees();
        let name = value_of(given, axis, "current");
        columns! { table.columns, |row|
            "{name}": "A", "control current of the magnet's axis at {angle:.0} degrees from x" => machine.currents(row.time, row.state)[axis].0;
        }
    }
    table.columns.list
}

/// The axis whose current was longest at the limit of its coil.
pub(crate) fn limited(context: &Context) -> Option<(f64, Warning)> {
    let currents = &context.finished.record.currents;
    let (axis, share, time) = longest(context, currents.iter().map(|peak| peak.limited))?;
    let given = context.setup.controlled()?;
    let limit = format!("{:.3}", currents[axis].limit);
    let channel = value_of(given, axis, "current");
    let reached = currents.iter().filter(|peak| peak.limited.first.is_some());
    let others = match reached.count() {
        0 | 1 => String::new(),
        axes => format!(
            ", and {} more of {} axes reach theirs",
            axes - 1,
            currents.len()
        ),
    };
    let warning = ShaftWarning::CurrentLimit {
        channel,
        others,
        limit,
        share,
        time,
    };
    Some((share, warning.into()))
}

/// The axis whose amplifier was longest at its largest voltage.
pub(crate) fn voltage_limited(context: &Context) -> Option<(f64, Warning)> {
    let given = context.setup.controlled()?;
    let voltages = context.finished.record.voltages.iter();
    let (axis, share, time) = longest(context, voltages.copied())?;
    let limit = largest_voltage(given, axis).map_or(String::new(), |volts| format!("{volts} V, "));
    let channel = value_of(given, axis, "voltage");
    let warning = ShaftWarning::VoltageLimit {
        channel,
        limit,
        share,
        time,
    };
    Some((share, warning.into()))
}

/// The axis that was longest at a limit, the share of the time with power, and since when, s.
fn longest(context: &Context, limits: impl Iterator<Item = AtLimit>) -> Option<(usize, f64, f64)> {
    context.setup.controlled()?;
    let powered = context.finished.record.powered;
    let longest = limits.enumerate();
    let (axis, own) = longest.max_by(|a, b| a.1.duration.total_cmp(&b.1.duration))?;
    let share = own.duration / powered;
    (share > LONG_AT_LIMIT).then_some((axis, share, own.first?))
}

/// Largest voltage of the amplifier of an axis, V.
fn largest_voltage(given: &Shaft, axis: usize) -> Option<f64> {
    match own_axes(given).get(axis)?.amplifier {
        Amplifier::Voltage {
            largest_voltage, ..
        } => Some(largest_voltage),
        _ => None,
    }
}

/// A rotor that touches its auxiliary bearings while it has its magnets.
pub(crate) fn touched(context: &Context, k: usize) -> Option<(f64, Warning)> {
    context.setup.controlled()?;
    let lost = context.release_time().unwrap_or(f64::INFINITY);
    let record = context.record(k);
    let bore = record.contacts.first().map(|first| first.start);
    let face = record
        .spatial
        .as_deref()
        .and_then(|own| own.first_axial_contact);
    let first = bore.into_iter().chain(face).reduce(f64::min);
    let time = first.filter(|first| *first < lost)?;
    let warning = ShaftWarning::TouchesWithPower { time };
    Some((lost - time, warning.into()))
}

origins! {
    LOST: law "levitation.power_lost_at, or the event that takes the last power, and the spin of the rotor then; speeds of inner races are compared with it",
        source "crates/model/src/system/machine/record.rs",
        valid "sensors and controllers of magnets that all have no power stand still";
    COIL: law "largest current of one of the two coils of the pair, its bias in it, at the end of each step",
        source "crates/levitation/src/levitation.rs: di±/dt = clip(ω (clip(e b± ± u, 0, i_max) - i±), ±s)",
        valid "current amplifiers: each coil lags and is limited by itself; else both follow one control current";
    CURRENT: law "largest size of the control current, at the end of each step while the magnets have power and after",
        source "crates/model/src/magnets/mod.rs, crates/levitation/src/levitation.rs",
        valid "force law, limits, delay or samples as given; no saturation of iron, no eddy currents, no noise";
}
