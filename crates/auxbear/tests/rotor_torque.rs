//! What drives and brakes a rotor besides its bearings, as files say it.

use crate::machine::{STIFF, near, number, parsed, ran};
use auxbear::scenario::template;

#[test]
fn drag_and_drive_act_on_the_spin() {
    let final_speed = |sets: &[&str]| {
        let mut all = vec!["run.duration=5 ms"];
        all.extend(sets);
        number(&ran(STIFF, &all), "rotor_final_speed")
    };
    let free = final_speed(&[]);
    let inertia = {
        let braked = final_speed(&["rotor.spin=braked", "rotor.brake_torque=1 N m"]);
        5e-3 / (free - braked)
    };
    let change = |torque: f64| torque * 5e-3 / inertia;
    let drag = final_speed(&["rotor.drag=1e-3 N m s"]);
    near(free - drag, change(1e-3 * free), 0.02);
    let windage = final_speed(&["rotor.windage=1e-6 N m s^2"]);
    near(free - windage, change(1e-6 * free * free), 0.02);
    let driven = final_speed(&["rotor.drive_torque=2 N m", "rotor.drive_slope=1e-3 N m s"]);
    near(driven - free, change(2.0 - 1e-3 * free), 0.02);
    let fast = format!("{} rad/s", 1.5 * free);
    let rows =
        format!("rotor.torque_over_speed=[[\"0 rpm\", \"0 N m\"], [\"{fast}\", \"-3 N m\"]]");
    near(final_speed(&[&rows]) - free, change(-2.0), 0.02);
    let share = "rotor.torque_share_over_time=[[\"0 s\", 1.0], [\"5 ms\", 0.0]]";
    near(final_speed(&[&rows, share]) - free, change(-1.0), 0.02);
}

#[test]
fn torques_by_tables_that_cannot_be_followed_are_refused() {
    let refused = |sets: &[&str]| parsed(STIFF, sets).unwrap_err();
    let rows = "rotor.torque_over_speed=[[\"0 rpm\", \"0 N m\"], [\"90000 rpm\", \"-3 N m\"]]";
    let share = "rotor.torque_share_over_time=[[\"0 s\", 1.0], [\"5 ms\", 0.0]]";
    let alone = refused(&[share]);
    assert!(
        alone.contains("rotor.torque_over_speed beside it is needed"),
        "{alone}"
    );
    let slow = "rotor.torque_over_speed=[[\"0 rpm\", \"0 N m\"], [\"3 rpm\", \"-3 N m\"]]";
    assert!(refused(&[slow]).contains("a last row at the size of rotor.speed"));
    let drives = "rotor.torque_over_speed=[[\"0 rpm\", \"1 N m\"], [\"90000 rpm\", \"-3 N m\"]]";
    for torque in [
        drives,
        "rotor.drive_torque=1 N m",
        "rotor.drive_slope=1e-3 N m s",
    ] {
        let until = refused(&[torque, "run.until=standstill", "heat.network=on"]);
        assert!(
            until.contains("beside run.until = \"standstill\""),
            "{until}"
        );
    }
    let held = refused(&[rows, "rotor.spin=held"]);
    assert!(
        held.contains("a spin that is held feels no other torque"),
        "{held}"
    );
}

/// Of equal planes one is computed with its share of rotor and torque: -1 N m at half the table's speed on 0.01 kg m², until 4 ms.
#[test]
fn planes_share_the_torque() {
    let text = template("drop").unwrap();
    for planes in ["rotor.planes=1", "rotor.planes=2"] {
        let speed = |sets: &[&str]| {
            let all = [&[planes, "run.duration=4 ms"], sets].concat();
            number(&ran(&text, &all), "rotor_final_speed")
        };
        let rows = "rotor.torque_over_speed=[[\"0 rpm\", \"0 N m\"], [\"24000 rpm\", \"-2 N m\"]]";
        near(speed(&[]) - speed(&[rows]), 1.0 * 4e-3 / 0.01, 1e-3);
    }
}
