//! An unbalance that comes on the way: nothing of the axis jumps, and the rotor goes on as one that has it.

use crate::machines::bent::{NODES, Shaft, bent, shaft};
use crate::machines::{observe, settings};
use model::rotor::Unbalance;
use model::schedule::Schedule;
use model::system::machine::{Event, MachineConstants, Mode, RotorMachine};
use solve::{Flow, Observer, Step};

const COMES: f64 = 0.004;
/// Until then nothing is touched: impacts double what is different.
const FLIES: f64 = 0.0065;
const END: f64 = 0.012;

/// The machine whose rotor bends, to which an unbalance comes in two halves at one instant, its start, and that unbalance.
fn losing() -> (MachineConstants, Vec<f64>, Unbalance) {
    let (mut constants, start) = bent(3e4);
    let plane = Unbalance {
        node: constants.bearings[1].node.clone(),
        product: 4e-4,
        phase: 1.1,
    };
    let half = Unbalance {
        product: 0.5 * plane.product,
        ..plane.clone()
    };
    constants.unbalances = vec![half.clone(), half];
    constants.schedule = Schedule::of([0, 1].map(|plane| (COMES, Event::Unbalance(plane))));
    let machine = RotorMachine::new(constants.clone());
    let old = RotorMachine::new(bent(3e4).0);
    let mut state = vec![0.0; solve::Machine::dimension(&machine)];
    let before = old.layout().ledger();
    state[..before].copy_from_slice(&start[..before]);
    (constants, state, plane)
}

/// The machine that goes on, and the state on either side of the event.
#[derive(Default)]
struct Sides {
    before: Vec<f64>,
    after: Vec<f64>,
    machine: Option<RotorMachine>,
}

impl Observer<RotorMachine> for Sides {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        if step.end == COMES {
            let channels = solve::Machine::dimension(step.machine);
            self.before = (0..channels)
                .map(|channel| step.end_state(channel))
                .collect();
        }
        Flow::Continue
    }
    fn switched(
        &mut self,
        machine: &RotorMachine,
        _mode: &Mode<f64>,
        _time: f64,
        state: &[f64],
    ) -> Flow {
        self.after = state.to_vec();
        self.machine = Some(machine.clone());
        Flow::Continue
    }
}

#[test]
fn axis_and_spin_do_not_jump_and_the_rotor_goes_on_as_one_with_that_unbalance() {
    let (constants, start, plane) = losing();
    let machine = RotorMachine::new(constants.clone());
    let mut sides = Sides::default();
    let ending = observe(&machine, &start, &settings(FLIES, 1e-7), &mut sides);
    let after = sides.machine.expect("it came");
    for bearing in 0..NODES.len() {
        let [old, new] = [
            machine.node(bearing, &sides.before),
            after.node(bearing, &sides.after),
        ];
        let moved = (old.position - new.position).length_squared().sqrt();
        let faster = (old.velocity - new.velocity).length_squared().sqrt();
        assert!(moved < 1e-16 && faster < 1e-13, "{moved:e} {faster:e}");
        assert!((old.arm - new.arm).length_squared().sqrt() > 1e-6);
    }
    let spin = machine.layout().rotor.spin();
    assert_eq!(sides.before[spin], sides.after[spin]);

    // the rotor as it is built with all three planes
    let mut rotor = shaft();
    rotor.unbalance.push(rotor::Unbalance {
        node: NODES[1],
        amount: plane.product,
        phase: plane.phase,
    });
    let built = Shaft::reduced(rotor, 3e4, &[NODES[0], NODES[1], 4, 6]).constants();
    let inertia = after.constants.rotor.polar_inertia;
    assert!((inertia - built.polar_inertia).abs() < 1e-13 * inertia);
    assert!(inertia < machine.constants.rotor.polar_inertia);
    let mut unbalanced = constants;
    unbalanced.rotor = after.constants.rotor.clone();
    (unbalanced.unbalances, unbalanced.schedule) = (Vec::new(), Schedule::default());
    let unbalanced = RotorMachine::new(unbalanced);
    let count = unbalanced.layout().ledger();
    let mut state = vec![0.0; solve::Machine::dimension(&unbalanced)];
    state[..count].copy_from_slice(&sides.after[..count]);
    let other = observe(
        &unbalanced,
        &state,
        &solve::Settings {
            start: COMES,
            ..settings(FLIES, 1e-7)
        },
        &mut crate::machines::Blind,
    );
    for (channel, (ours, other)) in ending.state[..count].iter().zip(&other.state).enumerate() {
        let scale = solve::Machine::error_scale(&machine, channel);
        assert!(
            (ours - other).abs() < 1e-4 * scale,
            "{channel}: {ours} {other}"
        );
    }
}

#[test]
fn what_leaves_with_it_is_booked() {
    let (constants, start, _) = losing();
    let machine = RotorMachine::new(constants);
    let mut sides = Sides::default();
    let ending = observe(&machine, &start, &settings(END, 1e-6), &mut sides);
    let after = sides.machine.expect("it came");
    let (begun, ended) = (machine.content(&start), after.content(&ending.state));
    let flows = machine.flows(&ending.state);
    let energy = |content: &model::system::energy::Content| {
        content.translation + content.spin + content.potential
    };
    let source = machine.layout().of_rotor.unbalance.unwrap();
    let booked = ending.state[machine.layout().source(source)];
    assert!(booked.abs() > 1e-3, "{booked}");
    let residual = energy(&ended) - energy(&begun) + flows.heat - flows.work;
    assert!(
        residual.abs() < 1e-6 * flows.heat.max(flows.work_size),
        "{residual:e}"
    );
    let impulse = ending.state[machine.layout().angular_impulse()]
        - start[machine.layout().angular_impulse()];
    let missing = ended.angular_momentum - begun.angular_momentum - impulse;
    assert!(
        missing.abs() < 1e-8 * ended.angular_momentum.abs(),
        "{missing:e}"
    );
}
