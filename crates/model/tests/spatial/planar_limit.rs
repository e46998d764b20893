//! In the plane, with a tied cage and one node, the bearing in space is the planar one: the reference's planar points.

use super::setup::*;
use model::spatial::{Assembly, AssemblyConstants};
use number::Vec3;
use physics::contact_nodes::middle;
use physics::traction::{FourParameterTraction, TanhTraction, Traction};
use serde_json::Value;

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key}"))
}
fn list(value: &Value) -> Vec<f64> {
    let list = value.as_array().unwrap();
    list.iter().map(|number| number.as_f64().unwrap()).collect()
}

/// The machine of the planar files with grooves of any curvature.
fn assembly(p: &Value) -> AssemblyConstants {
    let n = |key: &str| number(p, key);
    let traction = if n("tr_kind") == 0.0 {
        Traction::Tanh(TanhTraction {
            maximum: n("mu_max"),
            inverse_reference_speed: 1.0 / n("u0"),
        })
    } else {
        Traction::FourParameter(FourParameterTraction {
            a: n("trA"),
            b: n("trB"),
            c: n("trC"),
            d: n("trD"),
        })
    };
    let mut machine = machine(bearing(SINGLE, traction, &middle(), Guide::Tied), false);
    let gravity = Vec3::new(0.0, -n("g"), 0.0);
    machine.gravity = gravity;
    machine.inner.inertia.mass = n("m_i");
    machine.inner.inertia.axial = n("I_i");
    machine.inner.held = n("fix_i") == 1.0;
    machine.inner.torque = n("tau_i");
    machine.inner.force = Vec3::zero();
    machine.inner.moment = Vec3::zero();
    (machine.inner.settling, machine.inner.tilt_settling) = (0.0, 0.0);
    machine.outer.inertia.mass = n("m_o");
    machine.outer.mount.radial_stiffness = n("ks");
    machine.outer.mount.radial_damping = n("cs");
    let row = &mut machine.rows[0];
    row.balls = n("N") as usize;
    row.cage.inertia.mass = n("m_c");
    row.cage.inertia.axial = n("I_c");
    row.cage.drag = n("cc");
    let ball = &mut row.ball;
    ball.radius = n("r");
    ball.mass = n("m_b");
    ball.gravity = gravity;
    ball.damping_time = n("beta");
    (ball.orbit_drag, ball.spin_drag) = (n("cd"), n("cw"));
    ball.inner_growth = 0.0;
    ball.inner.stiffness = n("Ki");
    ball.outer.stiffness = n("Ko");
    let groove = 0.52 * 2.0 * ball.radius;
    (ball.inner.slack, ball.outer.slack) = (groove - ball.radius, groove - ball.radius);
    ball.inner.centre_radius = n("Ri") + groove;
    ball.outer.centre_radius = n("Ro") - groove;
    (ball.inner.place, ball.outer.place) = (0.0, 0.0);
    ball.pocket.circle = n("Rp");
    ball.pocket.gap = n("gp");
    ball.pocket.stiffness = n("kp");
    ball.pocket.damping = n("ap");
    ball.pocket.friction = n("mu_c");
    ball.pocket.inverse_reference_speed = 1.0 / n("u0c");
    let rotor = machine.rotor.as_mut().unwrap();
    rotor.landing.faces.clear();
    rotor.inertia.mass = n("m_r");
    rotor.inertia.axial = n("I_r");
    rotor.eccentricity = n("e_u");
    let contact = &mut rotor.landing.contact;
    contact.radial_clearance = n("c0");
    contact.bore_radius = n("R0");
    contact.stiffness = n("kr");
    contact.exponent = n("nr");
    contact.damping = n("ar");
    contact.friction = n("mur");
    contact.inverse_reference_speed = 1.0 / n("u0r");
    let (levitation, stations) = rotor.levitation.as_mut().unwrap();
    *stations = vec![0.0];
    levitation.stiffness = n("ka");
    levitation.damping = n("ca");
    levitation.carries = n("ka") != 0.0;
    levitation.carries_axially = false;
    machine.outer.mount.free_position = machine.balanced_free_position();
    machine
}

/// Where a planar state stands: of each of the file's, index of ours.
fn places(machine: &AssemblyConstants) -> Vec<(usize, usize)> {
    let mut places = Vec::new();
    for body in 0..2 {
        let at = machine.body(body);
        // x y vx vy ω; the angle stands in a quaternion
        places.extend(
            [(0, 0), (1, 1), (2, 3), (3, 4), (5, 12)].map(|(k, own)| (6 * body + k, at + own)),
        );
    }
    let outer = machine.body(2);
    places.extend([
        (12, outer),
        (13, outer + 1),
        (14, outer + 3),
        (15, outer + 4),
    ]);
    places.push((17, machine.body(3) + 12));
    for ball in 0..machine.rows[0].balls {
        for (k, own) in [(0, 0), (1, 1), (2, 2), (3, 3), (4, 8)] {
            places.push((18 + 5 * ball + k, ball_state(machine, 0, ball, own)));
        }
    }
    places
}

#[test]
fn planar_reference_points_are_those_of_the_bearing_in_space() {
    for name in ["derivative_points", "derivative_points_rotor_contact"] {
        let path = format!(
            "{}/../../validation/cases/reference/{name}.json",
            env!("CARGO_MANIFEST_DIR")
        );
        let file: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        for (index, point) in file["points"].as_array().unwrap().iter().enumerate() {
            let machine = assembly(&point["params"]);
            let (y, dy) = (list(&point["y"]), list(&point["dy"]));
            let places = places(&machine);
            let mut state = vec![0.0; machine.states()];
            for (theirs, ours) in &places {
                state[*ours] = y[*theirs];
            }
            for (body, angle) in [(0, y[4]), (1, y[10]), (2, 0.0), (3, y[16])] {
                let q = machine.body(body) + 6;
                (state[q], state[q + 3]) = ((0.5 * angle).cos(), (0.5 * angle).sin());
            }
            let (outer, cage) = (machine.body(2), machine.body(3));
            for k in [0, 1, 3, 4] {
                state[cage + k] = state[outer + k];
            }
            let mut rate = vec![0.0; state.len()];
            let assembly = Assembly::<f64>::gather(&|_| &machine);
            assembly.rate(&state, &mut rate);
            let first = dy.len() - 12;
            let accounts = (0..11).map(|k| (k, k)).chain([(11, 16)]);
            let accounts = accounts.map(|(k, own)| (first + k, machine.first_account() + own));
            for (theirs, ours) in places.iter().copied().chain(accounts) {
                let class = |k: usize| {
                    if k >= first {
                        100
                    } else if k < 18 {
                        k % 6 / 2
                    } else {
                        10 + (k - 18) % 5
                    }
                };
                let of_class = (0..dy.len()).filter(|k| class(*k) == class(theirs));
                let largest = of_class.fold(0.0_f64, |most, k| most.max(dy[k].abs()));
                let allowed = 1e-9 * dy[theirs].abs().max(1e-3 * largest);
                let miss = (rate[ours] - dy[theirs]).abs();
                assert!(
                    miss <= allowed,
                    "{name} {index} state {theirs}: {} {}",
                    rate[ours],
                    dy[theirs]
                );
            }
            let content = machine.content(&state);
            assert!((content.kinetic / number(point, "kinetic") - 1.0).abs() < 1e-11);
            for (ball, theirs) in point["per_ball"].as_array().unwrap().iter().enumerate() {
                let ours = machine.ball(0, ball, &state);
                let loads = [0, 1].map(|k| ours.races.touch[k].load.force);
                let theirs = list(theirs);
                for k in 0..2 {
                    assert!((loads[k] - theirs[k]).abs() <= 1e-9 * theirs[k].max(1.0));
                }
            }
            // nothing leaves the plane
            let across = [
                machine.body(0) + 5,
                machine.body(1) + 5,
                machine.body(2) + 5,
            ];
            assert!(across.iter().all(|k| rate[*k].abs() < 1e-9));
        }
    }
}
