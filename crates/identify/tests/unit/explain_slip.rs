use super::super::record::LeastWidth;
use super::super::steady::{Continued, known};
use super::*;

fn set() -> RollingSet<f64> {
    RollingSet {
        inner_track_radius: 14.8e-3,
        ball_ratio: 0.214,
        balls_mass: 10.5e-3,
        cage_mass: 8e-3,
    }
}

/// M = 3 + 22 (Ω/150)^(2/3) N mm.
fn table() -> Table {
    let speed: Vec<f64> = (1..=150).map(f64::from).collect();
    let moment = (speed.iter())
        .map(|w| 3e-3 + 22e-3 * (w / 150.0).powf(2.0 / 3.0))
        .collect();
    Continued(&known(speed, moment)).table(150.0)
}

fn slip(traction_limit: f64) -> Slip {
    Slip {
        traction_limit,
        slip_speed: 0.05,
        load_moment: 3e-3,
        orbit_share: 0.5,
        traction_softening: 0.0,
        drag_softening: 0.0,
        film_time: 1.0,
    }
}

/// A ramp to 150 rad/s, held for a second.
fn test(acceleration: f64, table: &Table) -> Trial {
    let ramp = 150.0 / acceleration;
    let speed = move |t: f64| 150.0 * (t / ramp).clamp(0.0, 1.0);
    Trial::planned(
        &speed,
        ramp + 1.0,
        &LeastWidth::even(0.02),
        table,
        set().outer_inertia(),
    )
}

#[test]
fn with_grip_the_balls_roll() {
    let (table, set) = (table(), set());
    let test = test(500.0, &table);
    let gripping = Slip {
        slip_speed: 1e-3,
        ..slip(1.0)
    };
    let course = gripping.course(&test, &table, &set);
    let mut checked = 0;
    for (i, step) in test.steps.iter().enumerate() {
        // the first steps find the quasi-steady state; the one across the end of the ramp mixes two
        let inside = (0.05..0.29).contains(&step.elapsed) || step.elapsed > 0.32;
        if !inside {
            continue;
        }
        checked += 1;
        // creep u0 T/C at both races, traction 4 % of its limit: 2·1e-3·0.04/0.37 at the lowest speed, 25 rad/s
        assert!((course.cage[i] / set.cage_speed(step.speed) - 1.0).abs() < 3e-4);
        let acceleration = step.acceleration;
        let steady = table.at(step.speed).0;
        let (inner, _, heat) = course.balance[i];
        // M at 2(1+s)ω_c and 2sω_b instead of Ω: within the creep
        let outer = steady - set.outer_inertia() * acceleration;
        assert!((course.outer_moment[i] / outer - 1.0).abs() < 2e-3, "{i}");
        assert!((inner / (steady + set.inner_inertia() * acceleration) - 1.0).abs() < 2e-3);
        // rolling: all heat is M Ω
        assert!((heat / (steady * step.speed) - 1.0).abs() < 5e-3);
    }
    assert!(checked > 50);
}

#[test]
fn angular_momentum_closes_and_no_heat_is_negative() {
    let (table, set) = (table(), set());
    for (limit, acceleration) in [(12e-3, 11_500.0), (24e-3, 7200.0), (60e-3, 1300.0)] {
        let test = test(acceleration, &table);
        let hot = Slip {
            traction_softening: 0.8,
            drag_softening: 0.2,
            film_time: 0.3,
            ..slip(limit)
        };
        let course = hot.course(&test, &table, &set);
        let mut last = 0.0;
        for (i, step) in test.steps.iter().enumerate() {
            let (inner, momentum, heat) = course.balance[i];
            let change = (momentum - last) / step.duration;
            last = momentum;
            // Newton's method stops at 1e-5 of the limit in each balance of forces
            assert!((inner - course.outer_moment[i] - change).abs() < 5e-5 * limit);
            assert!(heat >= 0.0, "{i} {heat}");
        }
    }
}

#[test]
fn below_m_the_torque_is_what_traction_transmits() {
    let (table, set) = (table(), set());
    let test = test(1300.0, &table);
    let course = slip(18e-3).course(&test, &table, &set);
    let end = course.cage.len() - 1;
    // steady: t_O = t_I = C + m_i, m_i = s/(1+s)·3 N mm; the orbit is as slow as M0 needs, χ = ½ on orbit and spin:
    // by hand R T_I = M0 + M1/(1+s) = 18 → M0 = 15.53 N mm, x = (15.53/22)^1.5 = 0.593 of rolling
    let expected = 18e-3 + 0.214 / 1.214 * 3e-3;
    assert!((course.outer_moment[end] / expected - 1.0).abs() < 2e-3);
    let slow = course.cage[end] / set.cage_speed(150.0);
    assert!((slow - 0.593).abs() < 0.006, "{slow}");
}

#[test]
fn a_film_that_softens_makes_the_torque_fall() {
    let (table, set) = (table(), set());
    let test = test(1300.0, &table);
    let hot = Slip {
        traction_softening: 0.5,
        film_time: 0.3,
        ..slip(25e-3)
    };
    let course = hot.course(&test, &table, &set);
    let at = |time: f64| {
        let place = test
            .steps
            .iter()
            .position(|s| s.elapsed > time)
            .unwrap_or(0);
        course.outer_moment[place]
    };
    assert!(at(0.3) > at(0.6) && at(0.6) > at(1.0));
    assert!(at(1.0) < 0.85 * at(0.15));
}
