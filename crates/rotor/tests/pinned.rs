//! Rotors on supports so stiff that they are pinned, and on such that do not hold, against closed forms.

use rotor::{
    Analysis, Annulus, Basis, Block, Coefficients, Disk, Layer, Material, Matrices, Place,
    Responder, Rotor, Support, Unbalance, Whirl,
};

const STEEL: [f64; 3] = [2.06e11, 0.3, 7850.0];

/// A uniform shaft from 0 to `length`.
fn shaft(length: f64, outer: f64, elements: i32, damping_of_stiffness: f64) -> Rotor {
    let section = Annulus { outer, inner: 0.0 };
    let layer = Layer {
        from: 0.0,
        to: length,
        start: section,
        end: section,
        material: Material::new(STEEL[0], STEEL[1], STEEL[2]),
        longest: length / f64::from(elements),
        carries: true,
        damping_of_mass: 0.0,
        damping_of_stiffness,
        damping_rotating: 0.0,
    };
    let mesh = rotor::mesh(&[layer], &[0.5 * length]).unwrap();
    Rotor {
        nodes: mesh.nodes,
        elements: mesh.elements,
        ..Rotor::default()
    }
}

fn support(node: usize, stiffness: f64, damping: f64) -> Support {
    Support {
        at: Place::Node(node),
        on: None,
        coefficients: Coefficients::constant(Block::equal(stiffness, damping)),
        seal: false,
    }
}

/// On supports at both ends.
fn supported(mut rotor: Rotor, stiffness: f64, damping: f64) -> Rotor {
    let last = rotor.nodes.len() - 1;
    rotor.supports = [0, last]
        .map(|node| support(node, stiffness, damping))
        .to_vec();
    rotor
}

fn reduced(rotor: &Rotor, top: f64) -> Analysis {
    let matrices = Matrices::new(rotor);
    let full = Basis::full(rotor, &matrices).unwrap();
    let basis = full.for_analysis(rotor, &matrices, 6.0 * top, top).unwrap();
    Analysis::new(rotor, &matrices, basis)
}

/// First critical speed of a pinned uniform shaft, rad/s: w = W sin(πz/L), ψ = P cos(πz/L) of Timoshenko's beam with the rotary
/// inertia ρI(ω² - 2Ωω), which is -ρIΩ² forward and 3ρIΩ² backward.
fn pinned_beam(length: f64, outer: f64, forward: bool) -> f64 {
    let material = Material::new(STEEL[0], STEEL[1], STEEL[2]);
    let (area, second) = (
        std::f64::consts::PI / 4.0 * outer.powi(2),
        std::f64::consts::PI / 64.0 * outer.powi(4),
    );
    let nu = STEEL[1];
    let shear = 6.0 * (1.0 + nu) / (7.0 + 6.0 * nu) * material.shear * area;
    let k2 = (std::f64::consts::PI / length).powi(2);
    let mut square = 0.0;
    for _ in 0..200 {
        let share = if forward { -1.0 } else { 3.0 };
        let bending = STEEL[0] * second * k2 - STEEL[2] * second * share * square;
        square = shear * k2 * bending / ((shear + bending) * STEEL[2] * area);
    }
    square.sqrt()
}

#[test]
fn a_pinned_beam_has_its_critical_speeds() {
    let (length, outer) = (1.0, 0.05);
    let exact = [false, true].map(|forward| pinned_beam(length, outer, forward));
    for (elements, count) in [(20, 201), (50, 41), (51, 12)] {
        for damping in [0.0, 1e-5] {
            for power in 9..=15 {
                let stiffness = 10_f64.powi(power);
                let rotor = supported(shaft(length, outer, elements, damping), stiffness, 1e3);
                let analysis = reduced(&rotor, 2000.0);
                let speeds: Vec<f64> = (0..count)
                    .map(|k| 2000.0 * f64::from(k) / f64::from(count - 1))
                    .collect();
                let diagram = analysis.campbell(&speeds, 2000.0).unwrap();
                let found = analysis.criticals(&diagram).unwrap();
                let case =
                    format!("{stiffness:e} N/m, {elements} elements, {count} speeds, {damping}");
                assert_eq!(found.len(), 2, "{case}: {found:?}");
                assert!(
                    found[0].mode.whirl == Whirl::Backward && found[1].mode.whirl == Whirl::Forward
                );
                for (one, exact) in found.iter().zip(exact) {
                    // ζ = βω/2 takes ζ²/2 from the frequency
                    let exact = exact * (1.0 - (damping * exact).powi(2) / 8.0);
                    // the supports give way by π⁴EI/(4 k L³) of the modal deflection, the mesh costs (πh/L)⁴/120, the basis 1e-6
                    let mesh = (std::f64::consts::PI / f64::from(elements)).powi(4) / 120.0;
                    let tolerance = 4e6 / stiffness + 1.1 * mesh + 1e-6;
                    assert!(
                        (one.speed / exact - 1.0).abs() < tolerance,
                        "{case}: {} {exact}",
                        one.speed
                    );
                }
                assert!(analysis.unstable(&diagram).unwrap().is_empty(), "{case}");
            }
        }
    }
}

#[test]
fn a_pinned_rotor_with_a_disk_has_the_critical_speeds_of_k_x_is_omega_squared_m_x() {
    // 60 mm, 30 kg in the middle: backward 390.782, forward 391.237 rad/s by own finite elements on 1e11 N/m
    for power in 10..=15 {
        let stiffness = 10_f64.powi(power);
        let mut rotor = supported(shaft(1.0, 0.06, 40, 0.0), stiffness, 1e4);
        rotor.disks.push(Disk {
            node: 20,
            mass: 30.0,
            polar: 0.3,
            diametral: 0.2,
        });
        let analysis = reduced(&rotor, 1500.0);
        let speeds: Vec<f64> = (0..=200).map(|k| 942.477 * f64::from(k) / 200.0).collect();
        let diagram = analysis.campbell(&speeds, 1413.7).unwrap();
        let found: Vec<f64> = analysis
            .criticals(&diagram)
            .unwrap()
            .iter()
            .map(|one| one.speed)
            .collect();
        let matched = rotor::stiffness_map(&rotor, &analysis.basis, &[stiffness], 2).unwrap();
        let exact = [matched[0].backward[0], matched[0].forward[0]];
        assert_eq!(found.len(), 2, "{stiffness:e}: {found:?}");
        for (ours, exact) in found.iter().zip(exact) {
            // the map has no damping; that of the supports moves Im λ by less
            assert!(
                (ours / exact - 1.0).abs() < 1e-6,
                "{stiffness:e}: {ours} {exact}"
            );
        }
        if power == 11 {
            assert!(
                (found[0] - 390.782).abs() < 2e-2 && (found[1] - 391.237).abs() < 2e-2,
                "{found:?}"
            );
        }
    }
}

#[test]
fn round_off_of_stiff_supports_does_not_grow() {
    for stiffness in [1e9, 1e13, 1e15, 1e18] {
        let mut rotor = supported(shaft(2.0, 0.1, 40, 0.0), stiffness, 0.0);
        rotor.supports.push(support(20, stiffness, 0.0));
        rotor.disks.push(Disk {
            node: 10,
            mass: 100.0,
            polar: 2.0,
            diametral: 1.0,
        });
        let analysis = reduced(&rotor, 700.0);
        for speed in [0.0, 50.0, 104.7, 157.0] {
            assert_eq!(
                analysis.growing(speed).unwrap(),
                None,
                "{stiffness:e} {speed}"
            );
            assert!(analysis.round_off(speed) < 1e-2);
        }
        let first = analysis.modes(104.7, 1).unwrap()[0].frequency();
        if stiffness > 1e12 {
            assert!((first / 696.2 - 1.0).abs() < 1e-3, "{stiffness:e}: {first}");
        }
    }
}

#[test]
fn a_rotor_that_is_pulled_over_is_unstable_from_standstill() {
    // midspan stiffness of shaft and bearings less 20e6 N/m: +108.44 1/s; with -15e6 it is stable
    let core = |pull: f64| {
        let mut rotor = shaft(1.4, 0.09, 42, 0.0);
        rotor.supports = [3, 39].map(|node| support(node, 1e8, 1e4)).to_vec();
        rotor.supports.push(Support {
            seal: true,
            ..support(21, pull, 0.0)
        });
        rotor.disks.push(Disk {
            node: 21,
            mass: 250.0,
            polar: 8.0,
            diametral: 10.0,
        });
        let analysis = reduced(&rotor, 700.0);
        let diagram = analysis
            .campbell(&[0.0, 100.0, 200.0, 314.0], 471.0)
            .unwrap();
        (
            analysis.unstable(&diagram).unwrap(),
            analysis.growing(157.0).unwrap(),
        )
    };
    let (ranges, growing) = core(-20e6);
    assert_eq!(ranges, [(0.0, 314.0)]);
    // nodes lie at 33 mm; the steel of the audit's file may differ by 1e-3 in E
    assert!(
        (growing.unwrap().re / 108.44 - 1.0).abs() < 2e-2,
        "{growing:?}"
    );
    assert!(core(-15e6).0.is_empty());
}

#[test]
fn a_jeffcott_rotor_loads_its_bearings_with_half_its_spring_force() {
    // nearly massless shaft: the force of the unbalance in the disk is U Ω²/(1 - (Ω/ω)²), half of it in each bearing
    let mut rotor = shaft(0.5, 0.02, 10, 0.0);
    for element in &mut rotor.elements {
        element.material.density = 1e-3;
    }
    let mut rotor = supported(rotor, 1e12, 1.0);
    rotor.disks.push(Disk {
        node: 5,
        mass: 10.0,
        polar: 1e-6,
        diametral: 1e-6,
    });
    let unbalance = [Unbalance {
        node: 5,
        amount: 1e-3,
        phase: 0.0,
    }];
    let analysis = Analysis::full(&rotor).unwrap();
    let own = analysis.modes(0.0, 1).unwrap()[0].frequency();
    let (speed, omega) = (0.6 * own, own);
    let answer = Responder::within(&analysis)
        .unbalance(&unbalance, speed)
        .unwrap();
    let exact = 0.5 * 1e-3 * speed * speed / (1.0 - (speed / omega).powi(2));
    for [f, b] in &answer.forces {
        assert!(
            (f.norm() / exact - 1.0).abs() < 1e-5 && b.norm() < 1e-12,
            "{f} {exact}"
        );
    }
    for ([f, _], [own, _]) in answer.forces.iter().zip(&answer.across) {
        assert!(((f / own).norm() / 1e12 - 1.0).abs() < 1e-6);
    }
}
