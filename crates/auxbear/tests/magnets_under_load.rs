//! Magnets that carry a weight: stability, limits, margins and biases about the loaded position, in a rotor and in a machine.

use auxbear::outcome::Outcome;
use auxbear::run::{Options, run};
use nalgebra::Complex;
use std::sync::atomic::AtomicBool;

use crate::machine::{near, number, parsed, ran};

type C64 = Complex<f64>;

/// 51.7 kg on two pairs of 2.5 A of bias, 2.24 A of static current on each axis; with a light disk 29.6 kg.
fn heavy(system: &str, [mass, proportional, integral]: [&str; 3]) -> String {
    let magnet = |name: &str, at: &str| {
        format!(
            "[[levitation.magnet]]\nname = \"{name}\"\nat = \"{at}\"\ncurrent_stiffness = \"80 N/A\"\nposition_stiffness = \"4e5 N/m\"\n\
             gap = \"0.5 mm\"\nlargest_current = \"10 A\"\n[[levitation.sensor]]\nmagnet = \"{name}\"\nat = \"{at}\"\nbandwidth = \"8 kHz\"\n"
        )
    };
    format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"{system}\"\n[rotor]\nspeed = \"500 rad/s\"\ndamping_of_stiffness = \"3 us\"\n\
         [[rotor.section]]\nlength = \"600 mm\"\nouter_diameter = \"80 mm\"\nmaterial = \"steel\"\nelements = 6\n\
         [[rotor.disk]]\nname = \"d\"\nat = \"300 mm\"\nmass = \"{mass}\"\npolar_inertia = \"0.4 kg m^2\"\ndiametral_inertia = \"0.3 kg m^2\"\n\
         [[rotor.unbalance]]\nname = \"u\"\nat = \"300 mm\"\namount = \"60 g mm\"\n\
         [levitation.controller]\nproportional = \"{proportional}\"\nintegral = \"{integral}\"\nderivative = \"60 A s/m\"\n\
         derivative_time = \"50 us\"\n{}{}",
        magnet("A", "100 mm"),
        magnet("B", "500 mm")
    )
}

/// Auxiliary bearings at both ends of a shaft of 600 mm.
const BUSHINGS: &str = r#"
[contact]
radial_air_clearance = "0.2 mm"
bore_diameter = "79 mm"
friction_coefficient = 0.15
[mount]
stiffness = "2e7 N/m"
damping = "2000 N s/m"
moving_mass = "1 kg"
[bearing]
type = "bushing"
[[rotor.node]]
name = "na"
at = "0 mm"
[[rotor.node]]
name = "nb"
at = "600 mm"
[[auxiliary_bearing]]
name = "a"
[auxiliary_bearing.contact]
node = "na"
[[auxiliary_bearing]]
name = "b"
[auxiliary_bearing.contact]
node = "nb"
[run]
duration = "10 ms"
"#;

fn refused(text: &str, sets: &[&str]) -> String {
    let scenario = match parsed(text, sets) {
        Ok(scenario) => scenario,
        Err(problem) => return problem,
    };
    let never = AtomicBool::new(false);
    match run(&scenario, &Options::unwatched(&never)) {
        Ok(_) => panic!("it ran: {sets:?}"),
        Err(problem) => problem.to_string(),
    }
}

fn warned<'a>(outcome: &'a Outcome, code: &str) -> Option<&'a str> {
    let found = outcome.warnings.iter().find(|own| own.code == code);
    found.map(|own| own.text.as_str())
}

/// Own finite elements with the slopes of the loaded pair give these eigenvalues; about the centres the loops are stable (-16.9, -10.8
/// and -3.3 1/s). One digit of the reference is the tolerance.
#[test]
fn a_loop_that_its_load_makes_unstable_is_refused_in_a_rotor_and_in_a_machine() {
    for (proportional, integral, re, im) in [
        ("8500 A/m", "5e4 A/(m s)", 9.9, 23.5),
        ("8800 A/m", "2e5 A/(m s)", 15.9, 49.0),
        ("6500 A/m", "5e4 A/(m s)", 19.0, 18.3),
    ] {
        let gains = ["28 kg", proportional, integral];
        for text in [heavy("rotor", gains), heavy("machine", gains) + BUSHINGS] {
            let found = refused(&text, &[]);
            assert!(
                found.contains("AB2074") && found.contains("k_s of axis"),
                "{found}"
            );
            let (_, value) = found.split_once("eigenvalue ").unwrap();
            let mut words = value.split_whitespace();
            let mut next = || -> f64 {
                let word = words.next().unwrap();
                word.trim_end_matches('j').parse().unwrap()
            };
            let (ours, imaginary) = (next(), next().abs());
            assert!(
                (ours - re).abs() < 0.1 && (imaginary - im).abs() < 0.1,
                "{found}"
            );
        }
    }
    // without weight nothing raises k_s
    let text = heavy("rotor", ["28 kg", "8500 A/m", "5e4 A/(m s)"]);
    let free = ran(&text, &["analysis.gravity=0 m/s^2"]);
    near(
        number(&free, "levitation.slowest_eigenvalue"),
        -16.885,
        1e-3,
    );
    assert_eq!(number(&free, "levitation.A_1.position_stiffness_rise"), 0.0);
}

/// i_s = M g/(4 √½ k_i), k_s rises by (i_s/i₀)² = 0.26. A rigid rotor on two equal magnets moves by translation and tilt, each as a
/// mass m on one magnet: M/2, and J/(2a²) with a half the distance. S of an axis is ½(S_T + S_R), S = 1/(1 + k_i C/((m s² - k_s))).
#[test]
fn sensitivity_and_zone_are_those_of_the_loaded_pair() {
    let text = heavy("rotor", ["6 kg", "8000 A/m", "1e5 A/(m s)"]);
    let loaded = ran(&text, &[]);
    let current = number(&loaded, "levitation.A_1.static_current");
    let rise = number(&loaded, "levitation.A_1.position_stiffness_rise");
    near(rise, (current / 2.5).powi(2), 1e-4);
    let shaft = 7810.0 * std::f64::consts::PI * 0.04 * 0.04 * 0.6;
    near(
        current,
        (shaft + 6.0) * 9.81 / (4.0 * 0.5_f64.sqrt() * 80.0),
        0.01,
    );
    let tilt = 0.3 + shaft * (3.0 * 0.04 * 0.04 + 0.36) / 12.0;
    let masses = [0.5 * (shaft + 6.0), tilt / (2.0 * 0.04)];
    let sensitivity = |rise: f64, omega: f64| {
        let s = C64::new(0.0, omega);
        let control = 8000.0 + 1e5 / s + 60.0 * s / (1.0 + 5e-5 * s);
        let open = control * 80.0 / (1.0 + s / (std::f64::consts::TAU * 8e3));
        let of = |mass: f64| {
            let plant = mass * s * s - 4e5 * (1.0 + rise);
            (1.0 + open / plant).inv()
        };
        (0.5 * (of(masses[0]) + of(masses[1]))).norm()
    };
    let peak = |rise: f64| {
        let grid = (0..20_000).map(|k| 6.3 * 10.0_f64.powf(3.3 * f64::from(k) / 2e4));
        grid.map(|omega| sensitivity(rise, omega))
            .fold(0.0, f64::max)
    };
    let name = "levitation.A_1.standstill.sensitivity_peak";
    // the shaft bends beyond 3000 rad/s, peaks are at some 50
    near(number(&loaded, name), peak(rise), 0.01);
    let unloaded = ran(&text, &["analysis.gravity=0 m/s^2"]);
    near(number(&unloaded, name), peak(0.0), 0.03);
    // turning, the integrators of the tilting rotor are nearly lost; without load they were not
    let worst = |outcome: &Outcome| number(outcome, "levitation.largest_sensitivity");
    assert!(worst(&loaded) > 5.0 && worst(&unloaded) < 2.6);
}

/// A rotor of 600 mm with a disk at three quarters; magnet A is driven by volts, B by amperes.
fn uneven() -> String {
    let sensor = |name: &str, at: &str| {
        format!(
            "[[levitation.sensor]]\nmagnet = \"{name}\"\nat = \"{at}\"\n[[levitation.controller]]\nmagnet = \"{name}\"\n\
             proportional = \"15000 A/m\"\nintegral = \"1e5 A/(m s)\"\nderivative = \"40 A s/m\"\nderivative_time = \"60 us\"\ndelay = \"40 us\"\n"
        )
    };
    format!(
        "format = \"auxbear.scenario/1\"\nsystem = \"SYSTEM\"\n[rotor]\nspeed = \"1500 rad/s\"\ndamping_of_stiffness = \"3 us\"\n\
         [[rotor.section]]\nlength = \"600 mm\"\nouter_diameter = \"50 mm\"\nmaterial = \"steel\"\nelements = 12\n\
         [[rotor.disk]]\nname = \"d\"\nat = \"450 mm\"\nmass = \"6 kg\"\npolar_inertia = \"0.06 kg m^2\"\ndiametral_inertia = \"0.035 kg m^2\"\n\
         [[rotor.unbalance]]\nname = \"u\"\nat = \"450 mm\"\namount = \"300 g mm\"\n\
         [[levitation.magnet]]\nname = \"A\"\nat = \"100 mm\"\ncurrent_stiffness = \"80 N/A\"\nposition_stiffness = \"4e5 N/m\"\n\
         inductance = \"20 mH\"\nresistance = \"1.5 ohm\"\namplifier_gain = \"200 ohm\"\n\
         [[levitation.magnet]]\nname = \"B\"\nat = \"500 mm\"\ncurrent_stiffness = \"60 N/A\"\nposition_stiffness = \"3e5 N/m\"\n\
         amplifier_bandwidth = \"2 kHz\"\n{}{}",
        sensor("A", "50 mm"),
        sensor("B", "550 mm")
    )
}

/// Static current and amplitude are results of the rotor; a limit between the larger of them and their sum is passed, one above is not.
#[test]
fn a_start_beyond_a_limit_of_current_or_voltage_is_refused_with_its_numbers() {
    let rotor = uneven().replace("SYSTEM", "rotor");
    let machine = uneven().replace("SYSTEM", "machine")
        + &BUSHINGS
            .replace("\"0.2 mm\"", "\"1.5 mm\"")
            .replace("\"79 mm\"", "\"53 mm\"");
    // gravity of a machine; a rotor's default has more digits
    let free = ran(&rotor, &["analysis.gravity=9.81 m/s^2"]);
    assert!(warned(&free, "AB2079").is_none());
    let fixed = number(&free, "levitation.B_1.static_current").abs();
    let amplitude = number(&free, "levitation.B_1.unbalance_current");
    assert!(fixed > 0.5 && amplitude > 1.0, "{fixed} {amplitude}");
    let limit =
        |key: &str, value: f64, unit: &str| format!("levitation.magnet.{key}={value} {unit}");
    let below = limit("B.largest_current", 0.99 * (fixed + amplitude), "A");
    let found = refused(&machine, &[&below]);
    for part in [
        "AB2078",
        "axis B ",
        // four digits each: a machine has other coordinates
        &format!("{fixed:.6}")[..5],
        &format!("{amplitude:.6}")[..5],
        &format!("{:.6}", 0.99 * (fixed + amplitude))[..5],
    ] {
        assert!(found.contains(part), "{part}: {found}");
    }
    let text = ran(&rotor, &[&below]);
    assert!(warned(&text, "AB2079").is_some_and(|text| text.contains("axis B ")));
    let above = limit("B.largest_current", 1.02 * (fixed + amplitude), "A");
    assert!(warned(&ran(&rotor, &[&above]), "AB2079").is_none());
    assert!(parsed(&machine, &[&above]).is_ok_and(|own| auxbear::run::build(&own).is_ok()));
    // the static current alone is within 0.9 of its own size no more: too weak for the weight
    let weak = limit("B.largest_current", 0.9 * fixed, "A");
    assert!(refused(&machine, &[&weak]).contains("AB2076"));
    let volts = limit("A.largest_voltage", 15.0, "V");
    let found = refused(&machine, &[&volts]);
    assert!(
        found.contains("AB2078") && found.contains("V of static voltage"),
        "{found}"
    );
}

/// A coil whose current the control takes away for a part of each turn: said in both, as the linear slopes do not hold there.
#[test]
fn a_coil_without_current_is_said() {
    let sets = ["levitation.magnet.B.gap=0.5 mm"];
    let rotor = uneven().replace("SYSTEM", "rotor");
    let text = ran(&rotor, &sets);
    assert!(warned(&text, "AB2080").is_some_and(|text| text.contains("2.5000 A of bias")));
    assert!(warned(&ran(&rotor, &[]), "AB2080").is_none());
}

/// The gain margin at ω = 0: one axis of a controller by matrices without integrator is lost between 0.3 and 0.2 of its gain (own
/// closed loop: -66 and +77 1/s).
#[test]
fn a_controller_without_integrator_has_a_lower_gain_margin() {
    let text = uneven()
        .replace("SYSTEM", "rotor")
        .replace("integral = \"1e5 A/(m s)\"\n", "");
    let sets = ["analysis.gravity=0 m/s^2"];
    let found = ran(&text, &sets);
    for axis in ["A_1", "B_2"] {
        for at in ["standstill", "rated"] {
            let margin = number(&found, &format!("levitation.{axis}.{at}.gain_margin_down"));
            assert!(margin > 0.05 && margin < 1.0, "{axis} {margin}");
        }
    }
}

#[test]
fn keys_of_magnets_and_controllers_without_effect_are_refused() {
    let text = heavy("rotor", ["6 kg", "12000 A/m", "1e5 A/(m s)"]);
    assert!(parsed(&text, &["levitation.controller.sampling_period=50 us"]).is_ok());
    for (sets, key, word) in [
        (
            &[
                "levitation.controller.sampling_period=50 us",
                "levitation.controller.delay=1 ms",
            ][..],
            "controller.1.delay",
            "without sampling_period",
        ),
        (
            &["levitation.magnet.A.largest_voltage=100 V"],
            "magnet.A.largest_voltage",
            "beside inductance",
        ),
        (
            &["levitation.magnet.A.resistance=1 ohm"],
            "magnet.A.resistance",
            "beside inductance",
        ),
        (
            &["levitation.magnet.A.amplifier_gain=100 ohm"],
            "magnet.A.amplifier_gain",
            "beside inductance",
        ),
        (
            &["levitation.controller.computing_time=20 us"],
            "computing_time",
            "beside sampling_period",
        ),
        (
            &["levitation.controller.c=1 0"],
            "controller.1.c",
            "beside a",
        ),
    ] {
        let found = parsed(&text, sets).expect_err(key);
        assert!(
            found.contains("AB0110") && found.contains(key) && found.contains(word),
            "{found}"
        );
    }
    for (from, to, word) in [
        ("derivative = \"60 A s/m\"\n", "", "beside derivative"),
        (
            "derivative = ",
            "d = \"1 0 0 0; 0 1 0 0; 0 0 1 0; 0 0 0 1\"\nderivative = ",
            "without d",
        ),
        (
            "gap = \"0.5 mm\"\n",
            "bias_current = \"2.5 A\"\n",
            "beside gap",
        ),
        (
            "gap = \"0.5 mm\"\n",
            "bias_difference_1 = \"1 A\"\n",
            "beside gap",
        ),
    ] {
        let found = parsed(&text.replace(from, to), &[]).expect_err(to);
        assert!(found.contains("AB0110") && found.contains(word), "{found}");
    }
    // a resolved file says nothing that has no effect, and is read again
    let scenario = parsed(&text, &["levitation.controller.sampling_period=50 us"]).unwrap();
    let resolved = scenario.resolved.toml();
    assert!(!resolved.contains("delay =") && !resolved.contains("largest_voltage"));
    assert!(parsed(&resolved, &[]).is_ok());
}

/// The rig on pairs with 1.6 A of bias: biases that differ by d take ½ d off the control current; its orbit stays.
#[test]
fn biases_that_differ_carry_weight_in_the_linear_analysis_and_in_time() {
    let rig = include_str!("../../../scenarios/amb_rig_drop.toml");
    let of = |difference: &str, more: &[&str]| {
        let pair = format!("current_stiffness = \"40 N/A\"\ngap = \"0.4 mm\"\n{difference}");
        let run = [
            "run.duration=20 ms",
            "rotor.spin=held",
            "levitation.power_lost_at=1 s",
        ];
        ran(
            &rig.replace("current_stiffness = \"40 N/A\"", &pair),
            &[&run[..], more].concat(),
        )
    };
    let both = "bias_difference_1 = \"0.4 A\"\nbias_difference_2 = \"0.4 A\"";
    let (equal, unequal) = (of("", &[]), of(both, &[]));
    let mean = |outcome: &Outcome| {
        let found = outcome.history.iter();
        let column = found
            .clone()
            .find(|own| own.name == "magnet.drive_end.current_1");
        // 20 ms are four turns
        let values = &column.unwrap().values;
        values[..values.len() - 1].iter().sum::<f64>() / (values.len() - 1) as f64
    };
    assert!(
        (mean(&equal) - mean(&unequal) - 0.2).abs() < 1e-6,
        "{} {}",
        mean(&equal),
        mean(&unequal)
    );
    // the same coil currents turn the same rotor: 1e-3 of the orbit is left to steps
    let place = |outcome: &Outcome| {
        let mut found = outcome.history.iter();
        found
            .find(|own| own.name == "shape.9.x")
            .unwrap()
            .values
            .clone()
    };
    let moved = place(&equal).into_iter().zip(place(&unequal));
    let moved = moved.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(moved < 1e-8, "{moved:e} m");
    // members in lanes have the bits of one alone
    let beside = of(both, &["repeat.count=3"]);
    let largest = "magnet.drive_end.largest_current_2";
    assert_eq!(number(&beside, largest), number(&unequal, largest));
    let rotor = heavy("rotor", ["6 kg", "12000 A/m", "1e5 A/(m s)"]);
    let sets = ["1", "2"].map(|axis| format!("levitation.magnet.A.bias_difference_{axis}=1 A"));
    let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
    let (plain, biased) = (ran(&rotor, &[]), ran(&rotor, &sets));
    let current = |outcome: &Outcome| number(outcome, "levitation.A_1.static_current");
    near(current(&biased), current(&plain) - 0.5, 1e-9);
    // about the same force the slopes are the same
    for name in [
        "slowest_eigenvalue",
        "largest_sensitivity",
        "A_1.position_stiffness_rise",
    ] {
        let name = format!("levitation.{name}");
        near(number(&biased, &name), number(&plain, &name), 1e-6);
    }
    let found =
        parsed(&rotor, &["levitation.magnet.A.bias_difference_1=5 A"]).expect_err("too much");
    assert!(
        found.contains("AB2073") && found.contains("bias_difference_1"),
        "{found}"
    );
}

/// Sensors and controllers are addressed by the name of their magnet, and by their number.
#[test]
fn parts_of_a_magnet_have_its_name() {
    let text = uneven().replace("SYSTEM", "rotor");
    let set = |name: &str| format!("levitation.sensor.{name}.offset_1=10 um");
    let displaced = |name: &str| {
        let found = ran(&text, &[&set(name)]);
        number(&found, "levitation.B_1.static_displacement")
    };
    assert_eq!(displaced("B"), displaced("2"));
    assert!((displaced("B") - displaced("A")).abs() > 1e-6);
    assert!(parsed(&text, &["levitation.controller.B.proportional=16000 A/m"]).is_ok());
    let found = parsed(&text, &["levitation.controller.B.proportional=16 A"]).expect_err("a unit");
    assert!(
        found.contains("levitation.controller.B.proportional"),
        "{found}"
    );
}

/// Mounts or contacts harder than those that the default number of modes was compared for.
#[test]
fn hard_mounts_and_contacts_warn_of_the_default_cutoff() {
    let text = heavy("machine", ["6 kg", "12000 A/m", "1e5 A/(m s)"]) + BUSHINGS;
    assert!(warned(&ran(&text, &[]), "AB2081").is_none());
    for sets in [
        &["mount.stiffness=2e9 N/m"][..],
        &["contact.stiffness=8e9 N/m^(10/9)"],
    ] {
        assert!(warned(&ran(&text, sets), "AB2081").is_some(), "{sets:?}");
    }
    let sets = ["mount.stiffness=2e9 N/m", "rotor.cutoff=150000 rad/s"];
    assert!(warned(&ran(&text, &sets), "AB2081").is_none());
}
