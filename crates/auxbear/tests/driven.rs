//! A machine without its controllers, driven by the same controllers from outside: the run that it has with them.

use crate::machine::parsed;
use auxbear::outcome::Outcome;
use auxbear::run::{Commands, Driven, Driving};
use auxbear::scenario::Scenario;
use auxbear::{Machine, Options, Reached, build, run};
use levitation::StateSpace;
use std::sync::atomic::AtomicBool;

const PERIOD: f64 = 50e-6;
const COMPUTING: f64 = 20e-6;

/// The rig with samples, which loses its magnets after 4 ms and lands soon after.
pub fn rig(more: &[&str]) -> Scenario {
    let text = include_str!("../../../scenarios/amb_rig_drop.toml");
    let own = [
        "levitation.controller.sampling_period=50 us",
        "levitation.controller.computing_time=20 us",
        "levitation.controller.delay=0 s",
        "levitation.power_lost_at=4 ms",
        "auxiliary_bearing.drive_end.contact.radial_air_clearance=30 um",
        "run.duration=12 ms",
    ];
    parsed(text, &[&own[..], more].concat()).unwrap()
}

const USUAL: Driving = Driving {
    commands: Commands::Current,
    keep_history: true,
    stops_at_contacts: false,
};

/// The controllers of the rig, as a user would write them.
struct Controllers {
    filter: StateSpace,
    states: Vec<[f64; 2]>,
    signals: Vec<usize>,
}

fn place(driven: &Driven, name: &str) -> usize {
    let outputs = driven.outputs();
    let found = outputs.iter().position(|own| own.name == name);
    found.unwrap_or_else(|| panic!("{name}"))
}

impl Controllers {
    fn of(machine: &Machine, driven: &Driven) -> Self {
        let pid = StateSpace::pid(8000.0, 8e4, 22.0, 45.47284088339867e-6).unwrap();
        // the states of the start, from the machine that has them
        let whole = machine.simulation().unwrap();
        let all = |end: &str| -> Vec<f64> {
            let names = whole.names().iter().filter(|name| name.ends_with(end));
            names.map(|name| whole.value(name).unwrap()).collect()
        };
        let (filter, _) = pid.stepped(PERIOD).unwrap();
        let [integral, derivative] = ["integral", "derivative"].map(all);
        let axes = ["drive_end", "other_end"]
            .map(|end| [1, 2].map(|k| format!("sensor.{end}.signal_{k}")));
        let states = integral.into_iter().zip(derivative).map(|(a, b)| [a, b]);
        assert_eq!(states.len(), 4, "{:?}", whole.names());
        Controllers {
            filter,
            // the sample of the start has been taken: these are the states behind it
            states: states.collect(),
            signals: axes
                .iter()
                .flatten()
                .map(|name| place(driven, name))
                .collect(),
        }
    }
    /// A sample: the commands.
    fn sample(&mut self, driven: &mut Driven) -> Vec<f64> {
        let axes = self.signals.iter().zip(&mut self.states);
        axes.map(|(signal, states)| {
            let error = [0.0 - driven.read(*signal)];
            let mut command = [0.0];
            self.filter.output(&states[..], &error, &mut command);
            let before = *states;
            self.filter.rates(&before, &error, states);
            command[0]
        })
        .collect()
    }
}

/// Drives it at every sample until its magnets have lost their power, then to its end.
fn drive(driven: &mut Driven, controllers: &mut Controllers, first: Vec<f64>) {
    let never = AtomicBool::new(false);
    let powered = place(driven, "magnets.powered");
    let mut commands = first;
    for k in 1.. {
        let at = f64::from(k - 1) * PERIOD + COMPUTING;
        driven.advance(at, &never);
        for (axis, command) in commands.iter().enumerate() {
            driven.change(axis, *command).unwrap();
        }
        let next = f64::from(k) * PERIOD;
        if driven.read(powered) == 0.0 || next >= 4e-3 {
            break;
        }
        assert_eq!(driven.advance(next, &never), Reached::Time);
        commands = controllers.sample(driven);
    }
    let reached = driven.advance(f64::INFINITY, &never);
    assert!(matches!(reached, Reached::End(stop) if stop.complete()));
}

fn bits(outcome: &Outcome) -> Vec<(String, Vec<u64>)> {
    let columns = outcome.history.iter();
    columns
        .map(|own| {
            let values = own.values.iter().map(|value| value.to_bits());
            (own.name.clone(), values.collect())
        })
        .collect()
}

#[test]
fn driven_by_its_own_controllers_it_has_the_bits_of_its_run() {
    let scenario = rig(&[]);
    let machine = build(&scenario).unwrap();
    let whole = run(&scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap();
    let mut driven = machine.driven(USUAL).unwrap();
    let mut controllers = Controllers::of(&machine, &driven);
    // computed at the start, held from the computing time on
    let whole_start = machine.simulation().unwrap();
    let computed: Vec<f64> = whole_start
        .names()
        .iter()
        .filter(|name| name.ends_with("command computed"))
        .map(|name| whole_start.value(name).unwrap())
        .collect();
    drive(&mut driven, &mut controllers, computed);
    let outcome = driven.outcome();
    assert_eq!(outcome.work.steps, whole.work.steps);
    let contacts = |own: &Outcome| {
        own.contacts
            .iter()
            .map(|c| c.start.to_bits())
            .collect::<Vec<_>>()
    };
    assert!(whole.contacts.len() > 3);
    assert_eq!(contacts(&outcome), contacts(&whole));
    for (ours, theirs) in bits(&outcome).iter().zip(&bits(&whole)) {
        assert_eq!(ours.0, theirs.0);
        assert!(ours.1 == theirs.1, "{}", ours.0);
    }
}

/// The rig whose amplifiers are replaced.
fn with_amplifiers(lines: &str) -> Scenario {
    let text = include_str!("../../../scenarios/amb_rig_drop.toml");
    let text = text.replace("amplifier_bandwidth = \"2 kHz\"", lines);
    parsed(
        &text,
        &["levitation.power_lost_at=1 s", "run.duration=2 ms"],
    )
    .unwrap()
}

#[test]
fn outputs_show_inputs_at_once_where_that_is_declared_and_nowhere_else() {
    for lines in ["", "amplifier_bandwidth = \"2 kHz\""] {
        let scenario = with_amplifiers(lines);
        let mut driven = build(&scenario).unwrap().driven(USUAL).unwrap();
        driven.advance(1e-3, &AtomicBool::new(false));
        let outputs = driven.outputs();
        let read = |driven: &mut Driven| -> Vec<u64> {
            let all = (0..outputs.len()).rev();
            all.map(|output| driven.read(output).to_bits()).collect()
        };
        let inputs = driven.inputs().count();
        let mut shown = 0;
        for input in 0..inputs {
            let before = read(&mut driven);
            let value = driven.input(input);
            driven.change(input, value + 0.25).unwrap();
            let after = read(&mut driven);
            for (output, column) in outputs.iter().enumerate() {
                let at = outputs.len() - 1 - output;
                let moves = before[at] != after[at];
                let feeds = driven.feeds(column).contains(&input);
                assert_eq!(moves, feeds, "{lines} {input} {}", column.name);
                shown += usize::from(moves);
            }
            driven.change(input, value).unwrap();
        }
        assert_eq!((inputs, shown), (5, if lines.is_empty() { 4 } else { 0 }));
    }
}

/// For so short a time the force of a magnet changes little: commands of each kind hold the rotor as its controllers did.
#[test]
fn commands_of_each_kind_begin_with_what_holds_the_rotor() {
    let coil = "inductance = \"15 mH\"\nresistance = \"1 ohm\"\namplifier_gain = \"300 ohm\"";
    let current = "amplifier_bandwidth = \"2 kHz\"";
    for (lines, commands) in [(coil, Commands::Voltage), (current, Commands::Force)] {
        let scenario = with_amplifiers(lines);
        let machine = build(&scenario).unwrap();
        let after = |commands| {
            let mut driven = machine.driven(Driving { commands, ..USUAL }).unwrap();
            driven.advance(2e-4, &AtomicBool::new(false));
            let y = place(&driven, "sensor.drive_end.displacement_2");
            driven.read(y)
        };
        let (held, other) = (after(Commands::Current), after(commands));
        // one without any force has fallen by 2e-7 m
        assert!(
            (held - other).abs() < 2e-8,
            "{commands:?} {held:e} {other:e}"
        );
        let loose = {
            let mut driven = machine.driven(Driving { commands, ..USUAL }).unwrap();
            for axis in 0..4 {
                driven.change(axis, 0.0).unwrap();
            }
            driven.advance(2e-4, &AtomicBool::new(false));
            let y = place(&driven, "sensor.drive_end.displacement_2");
            driven.read(y)
        };
        let moved = (held - loose).abs();
        assert!(
            moved
                > if commands == Commands::Force {
                    5e-8
                } else {
                    1e-10
                },
            "{moved:e}"
        );
    }
}

/// Temperatures that act on the motion, linearly implicit steps, faults of magnets: what is not an input is as in the run.
#[test]
fn without_inputs_it_has_the_bits_of_any_run() {
    let warm = include_str!("../../../scenarios/drop_until_standstill.toml");
    let warm = parsed(warm, &["run.until=duration", "run.duration=0.1 s"]).unwrap();
    let stiff = [
        "run.duration=15 ms",
        "bearing.traction.reference_speed=0.001 m/s",
    ];
    let stiff = parsed(&auxbear::template("drop").unwrap(), &stiff).unwrap();
    let lost = include_str!("../../../scenarios/amb_rig_drop.toml");
    let lost = parsed(lost, &["run.duration=15 ms"]).unwrap();
    for scenario in [warm, stiff, lost] {
        let whole = run(&scenario, &Options::unwatched(&AtomicBool::new(false))).unwrap();
        let mut driven = build(&scenario).unwrap().driven(USUAL).unwrap();
        driven.advance(f64::INFINITY, &AtomicBool::new(false));
        let outcome = driven.outcome();
        assert_eq!(
            (outcome.work.steps, outcome.work.method),
            (whole.work.steps, whole.work.method)
        );
        // a rotor that does not bend has a source more, of forces from outside
        let ours = bits(&outcome);
        for theirs in bits(&whole) {
            assert!(ours.contains(&theirs), "{:?}: {}", scenario.title, theirs.0);
        }
    }
}
