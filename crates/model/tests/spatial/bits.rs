//! An assembly has the same rates whatever computes them: a ball at a time, balls in lanes, machines in lanes.

use super::setup::*;
use model::spatial::{Assembly, AssemblyConstants};
use number::{Level, Real, Task};
use physics::contact_nodes::{legendre, matched};

/// Rates of the machine in each lane.
struct Rates<'a>(&'a [AssemblyConstants], &'a [Vec<f64>]);

impl Task for Rates<'_> {
    type Output = Vec<Vec<f64>>;
    fn run<R: Real>(self) -> Vec<Vec<f64>> {
        let assembly = Assembly::<R>::gather(&|lane| &self.0[lane % self.0.len()]);
        let value = |k: usize| R::from_lanes(|lane| self.1[lane % self.1.len()][k]);
        let state: Vec<R> = (0..self.1[0].len()).map(value).collect();
        let mut rate = state.clone();
        assembly.rate(&state, &mut rate);
        let lanes = 0..R::LANES;
        lanes
            .map(|lane| rate.iter().map(|rate| rate.lane(lane)).collect())
            .collect()
    }
}

#[test]
fn every_level_and_every_lane_gives_the_same_rates() {
    let mut random = Random(21);
    for (signs, guide, law, nodes) in [
        (O, Guide::Outer, TANH, matched(8.0)),
        (X, Guide::Inner, FOUR, legendre(5)),
        (SINGLE, Guide::Tied, ALGEBRAIC, matched(8.0)),
    ] {
        let machines: Vec<AssemblyConstants> = (0..8)
            .map(|k| {
                let mut machine = machine(bearing(signs, law, &nodes, guide), true);
                machine.rows[0].ball.inner.stiffness *= 1.0 + 0.01 * f64::from(k);
                machine.outer.mount.tilt_stiffness *= 1.0 + 0.1 * f64::from(k);
                machine
            })
            .collect();
        let states: Vec<_> = machines
            .iter()
            .map(|machine| random_state(machine, &mut random, 1.0))
            .collect();
        let alone: Vec<_> = (0..8)
            .flat_map(|k| Level::Baseline.run_one(Rates(&machines[k..=k], &states[k..=k])))
            .collect();
        for level in Level::available() {
            for k in 0..8 {
                let own = level.run_one(Rates(&machines[k..=k], &states[k..=k]));
                assert!(own[0] == alone[k], "{level:?}, machine {k}");
            }
            let lanes = level.run_many(Rates(&machines, &states));
            for (lane, rates) in lanes.iter().enumerate() {
                assert!(*rates == alone[lane], "{level:?}, lane {lane}");
            }
        }
    }
}
