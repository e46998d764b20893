//! The answer turns with the machine.

use super::setup::*;
use model::spatial::{Assembly, Frame};
use number::Vec3;
use physics::contact_nodes::matched;

/// A quaternion (w, v) times another.
fn product((w, v): (f64, Vec3<f64>), (u, p): (f64, Vec3<f64>)) -> (f64, Vec3<f64>) {
    (w * u - v.dot(p), p * w + v * u + v.cross(p))
}
fn read(list: &[f64]) -> Vec3<f64> {
    Vec3::new(list[0], list[1], list[2])
}
fn write(list: &mut [f64], v: Vec3<f64>) {
    list[..3].copy_from_slice(&[v.x, v.y, v.z]);
}

#[test]
fn turning_everything_about_the_axis_turns_the_answer() {
    let mut random = Random(11);
    for (signs, guide) in [(O, Guide::Outer), (X, Guide::Inner), (SINGLE, Guide::Tied)] {
        let mut machine = machine(bearing(signs, TANH, &matched(8.0), guide), true);
        machine.outer.mount.torsion_stiffness = 0.0;
        let angle = 1.234_f64;
        let (sine, cosine) = angle.sin_cos();
        let turned =
            |v: Vec3<f64>| Vec3::new(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z);
        let q = (
            (0.5 * angle).cos(),
            Vec3::new(0.0, 0.0, (0.5 * angle).sin()),
        );
        let mut other = machine.clone();
        other.gravity = turned(machine.gravity);
        for row in &mut other.rows {
            row.ball.gravity = turned(row.ball.gravity);
        }
        other.inner.force = turned(machine.inner.force);
        other.inner.moment = turned(machine.inner.moment);
        other.outer.mount.free_position = turned(machine.outer.mount.free_position);
        let bodies = 3 + machine.rows.len();
        let turn = |list: &[f64], azimuth: f64| {
            let mut out = list.to_vec();
            for body in 0..bodies {
                let at = machine.body(body);
                for k in [0, 3, 10] {
                    write(&mut out[at + k..], turned(read(&list[at + k..])));
                }
                // of an outer ring that keeps its orientation the frame is another: its axis alone is seen
                let (w, v) = product(q, (list[at + 6], read(&list[at + 7..])));
                out[at + 6] = w;
                write(&mut out[at + 7..], v);
            }
            for (row, constants) in machine.rows.iter().enumerate() {
                for j in 0..constants.balls {
                    out[ball_state(&machine, row, j, 2)] += azimuth;
                }
            }
            out
        };
        let state = random_state(&machine, &mut random, 1.0);
        let rate = |machine: &_, state: &[f64]| {
            let mut rate = vec![0.0; state.len()];
            let probe = Assembly::<f64>::gather(&|_| machine).rate(state, &mut rate);
            (rate, probe)
        };
        let (plain, probe) = rate(&machine, &state);
        let (answer, turned_probe) = rate(&other, &turn(&state, angle));
        let expected = turn(&plain, 0.0);
        for (k, (ours, expected)) in answer.iter().zip(&expected).enumerate() {
            // accelerations of balls reach 1e7, of their spins 1e9
            let scale = expected.abs().max(1e-4 * largest_near(&plain, k));
            assert!(
                (ours - expected).abs() <= 1e-9 * scale,
                "state {k}: {ours} {expected}"
            );
        }
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * b.abs().max(1e-9);
        assert!(close(
            turned_probe.bore_normal_force,
            probe.bore_normal_force
        ));
        assert!(close(turned_probe.inner_torque, probe.inner_torque));
    }
}

/// The largest rate among the states around one.
fn largest_near(rates: &[f64], at: usize) -> f64 {
    let near = at.saturating_sub(9)..(at + 10).min(rates.len());
    rates[near]
        .iter()
        .fold(0.0, |most, rate| most.max(rate.abs()))
}

#[test]
fn a_frame_turns_vectors_and_orientations_alike() {
    let mut random = Random(12);
    for _ in 0..100 {
        let axis = random.vector(1.0);
        let axis = axis * axis.length_squared().sqrt().recip();
        let frame = Frame::along(axis);
        let [d1, d2, a] = frame.axes;
        assert!((a - axis).length_squared() < 1e-30);
        assert!((d1.cross(d2) - a).length_squared() < 1e-28);
        // the smallest rotation leaves what is across both axes
        let kept = Vec3::new(-axis.y, axis.x, 0.0);
        assert!((frame.outward(kept) - kept).length_squared() < 1e-28);
        let v = random.vector(2.0);
        assert!((frame.outward(frame.inward(v)) - v).length_squared() < 1e-28);
        let q = (random.next(), random.vector(1.0));
        let (w, p) = frame.orientation_inward(q);
        let length = |(w, p): (f64, Vec3<f64>)| w * w + p.length_squared();
        assert!((length((w, p)) - length(q)).abs() < 1e-14);
        // the body's axis, turned by the body and seen in the frame
        let along = |(w, p): (f64, Vec3<f64>)| {
            let s = 2.0 / length((w, p));
            Vec3::new(
                s * (p.x * p.z + w * p.y),
                s * (p.y * p.z - w * p.x),
                1.0 - s * (p.x * p.x + p.y * p.y),
            )
        };
        assert!((along((w, p)) - frame.inward(along(q))).length_squared() < 1e-27);
        let back = frame.orientation_outward((w, p));
        assert!((back.0 - q.0).abs() + (back.1 - q.1).length_squared() < 1e-14);
    }
    let down = Frame::along(Vec3::new(0.0, 0.0, -1.0));
    assert_eq!(
        down.inward(Vec3::new(0.0, 0.0, 2.0)),
        Vec3::new(0.0, 0.0, -2.0)
    );
    let (w, p) = down.orientation_inward((1.0, Vec3::zero()));
    assert!(w.abs() < 1e-15 && (p.x.abs() - 1.0).abs() < 1e-15);
}
