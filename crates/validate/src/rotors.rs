//! Files of rotors: a model element by element with matrices, eigenvalues, critical speeds, response to unbalance, sag.
//!
//! Matrices are those of M q̈ + (C + ΩG)q̇ + Kq = F with the coordinates (x, y, z, α, β, θ) of each node, β = Re ψ, α = -Im ψ;
//! only the bending planes are compared. Whirl labels are not: eigenvalues are.

use super::compare::{Refusal, Worst, told};
use super::report::{Row, Tolerance};
use auxbear::import::draft::Draft;
use auxbear::import::{case, ross};
use rotor::{
    Analysis, Annulus, C64, Element, Material, Place, Responder, Rotor, Unbalance, properties, sag,
};
use serde_json::Value;

/// Of entries of matrices, relative to the diagonal: sums in another order.
const MATRIX: f64 = 1e-12;
/// Of eigenvalues and critical speeds of rotors whose elements have like stiffness.
const EIGENVALUE: f64 = 1e-8;
/// Of eigenvalues where short stiff elements (frequencies to 1e7 rad/s) cost dense solvers digits, or pairs nearly fall together.
const HARD_EIGENVALUE: f64 = 1e-6;
/// Of responses to unbalance.
const RESPONSE: f64 = 1e-9;
/// Of static loads and sag: the files hold the rotor in supports of 1e20 N/m with 9.8065 m/s².
const STATIC: f64 = 1e-5;
/// Highest frequency of the free rotor, rad/s, from which dense solvers lose digits on the lowest ones.
const STIFF: f64 = 1e6;

/// Rows of a whole rotor.
pub(super) fn rows(file: &Value) -> Result<Vec<Row>, Refusal> {
    let draft = modelled(file)?;
    let rotor = draft.rotor();
    let mut worst = Worst::default();
    body(file, &rotor, &mut worst)?;
    matrices(file, &rotor, &mut worst)?;
    let analysis = Analysis::full(&rotor).map_err(told)?;
    let (tolerance, why) = match hard(&rotor, &analysis) {
        true => (
            HARD_EIGENVALUE,
            "short stiff elements, or pairs that nearly fall together: dense solvers lose digits",
        ),
        false => (EIGENVALUE, "double precision on both sides"),
    };
    for (speed, stated) in &draft.stated {
        eigenvalues(&analysis, *speed, stated, tolerance, why, &mut worst)?;
    }
    for why in &draft.nulls {
        worst.add(Row::not_run(why).of("eigenvalue_modulus", "1/s"));
    }
    criticals(file, &analysis, tolerance, why, &mut worst)?;
    unbalance(file, &rotor, &mut worst)?;
    standing(file, &rotor, &mut worst)?;
    Ok(worst.into_rows())
}

/// The rotor of a file, where all that the file says of it is modelled.
pub(super) fn modelled(file: &Value) -> Result<Draft, Refusal> {
    let draft = case::draft(file)?;
    match draft.notes.is_empty() {
        true => Ok(draft),
        false => Err(Refusal::NotModelled(draft.notes.join("; "))),
    }
}

/// Rows of a single element.
pub(super) fn element(file: &Value) -> Result<Vec<Row>, Refusal> {
    let own = file["input"].as_object().ok_or("input is no table")?;
    let notes = ross::not_modelled(own, "element");
    if !notes.is_empty() {
        return Err(Refusal::NotModelled(notes.join("; ")));
    }
    let input = |key: &str| {
        let value = file["input"][key].as_f64();
        value.ok_or(format!("input without {key}"))
    };
    let element = Element {
        left: 0,
        length: input("L")?,
        start: Annulus {
            outer: input("odl")?,
            inner: input("idl")?,
        },
        end: Annulus {
            outer: input("odr")?,
            inner: input("idr")?,
        },
        material: Material {
            young: input("E")?,
            shear: input("G")?,
            density: input("rho")?,
        },
        carries: true,
        damping_of_mass: 0.0,
        damping_of_stiffness: 0.0,
        damping_rotating: 0.0,
    };
    let rotor = Rotor {
        nodes: vec![0.0, element.length],
        elements: vec![element],
        ..Rotor::default()
    };
    let mut worst = Worst::default();
    let (still, turning) = (rotor.real_dynamics(0.0), rotor.real_dynamics(1.0));
    for (name, unit, matrix) in [
        ("M", "kg, kg m, kg m^2", &still.mass),
        ("K", "N/m, N, N m", &still.stiffness),
        ("G", "kg, kg m, kg m^2", &turning.damping),
    ] {
        let rows = file[name].as_array().ok_or(format!("no {name}"))?;
        let entry = |i: usize, j: usize| rows.get(i).and_then(|row| row[j].as_f64()).unwrap_or(0.0);
        compare(name, unit, matrix, &entry, rows.len(), 2, &mut worst);
    }
    Ok(worst.into_rows())
}

/// The entries of a list: `null` is no number.
fn numbers(list: &Value) -> Vec<f64> {
    let list = list.as_array().into_iter().flatten();
    list.map(|value| value.as_f64().unwrap_or(f64::NAN))
        .collect()
}

/// Whether dense solvers lose digits on the lowest modes.
fn hard(rotor: &Rotor, analysis: &Analysis) -> bool {
    let highest = analysis.basis.frequencies.last().copied();
    let stiff = highest.is_some_and(|highest| highest > STIFF);
    // k_xy without its counterpart makes defective pairs of isotropic rotors
    let lone = rotor.supports.iter().any(|support| {
        let k = support.coefficients.at(0.0).stiffness;
        k[0][0] == k[1][1] && (k[0][1] == 0.0) != (k[1][0] == 0.0)
    });
    stiff || lone
}

fn body(file: &Value, rotor: &Rotor, worst: &mut Worst) -> Result<(), String> {
    let ours = properties(rotor);
    for (key, name, unit, value) in [
        ("total_mass_kg", "mass", "kg", ours.mass),
        ("cg_m", "mass_centre", "m", ours.centre),
        ("Ip_total", "polar_inertia", "kg m^2", ours.polar),
    ] {
        let Some(reference) = file["model"][key].as_f64() else {
            continue;
        };
        let mut sums = worst.under(Tolerance::Relative(MATRIX), "sums over elements and disks");
        sums.add(name, unit, [reference, value]);
    }
    Ok(())
}

/// Which real coordinate of ours (x-plane, then y-plane) and with which sign a coordinate of a file is.
fn coordinate(dof: usize, nodes: usize, size: usize) -> Option<(usize, f64)> {
    if dof >= 6 * nodes {
        let (housing, axis) = ((dof - 6 * nodes) / 3, (dof - 6 * nodes) % 3);
        return (axis < 2).then_some((axis * size + 2 * nodes + housing, 1.0));
    }
    let node = dof / 6;
    match dof % 6 {
        0 => Some((2 * node, 1.0)),
        1 => Some((size + 2 * node, 1.0)),
        3 => Some((size + 2 * node + 1, -1.0)),
        4 => Some((2 * node + 1, 1.0)),
        _ => None,
    }
}

/// Largest deviation of an entry over the diagonal of its row and column, as one row.
fn compare(
    name: &str,
    unit: &str,
    ours: &rotor::RealMatrix,
    reference: &dyn Fn(usize, usize) -> f64,
    dofs: usize,
    nodes: usize,
    worst: &mut Worst,
) {
    let size = ours.nrows() / 2;
    let (mut most, mut found) = (-1.0, (0.0, 0.0));
    for i in 0..dofs {
        for j in 0..dofs {
            let (Some((p, a)), Some((q, b))) =
                (coordinate(i, nodes, size), coordinate(j, nodes, size))
            else {
                continue;
            };
            let diagonal = (ours[(p, p)] * ours[(q, q)]).abs().sqrt();
            // a skew matrix has no diagonal: its own largest entry
            let scale = if diagonal > 0.0 {
                diagonal
            } else {
                ours.amax().max(1.0)
            };
            let (own, other) = (a * b * ours[(p, q)], reference(i, j));
            let deviation = (own - other).abs() / scale;
            if deviation > most {
                (most, found) = (deviation, (own, other));
            }
        }
    }
    let (own, other) = found;
    let row = Row::compared(
        format!("entries_of_{name}"),
        unit,
        other,
        own,
        Tolerance::Relative(MATRIX),
        "relative to the diagonal of row and column; the entry that deviates most",
    );
    worst.add(row.by(most));
}

fn matrices(file: &Value, rotor: &Rotor, worst: &mut Worst) -> Result<(), String> {
    let Some(given) = file.get("matrices").filter(|given| !given.is_null()) else {
        return Ok(());
    };
    let speed = given["speed_rad_s"]
        .as_f64()
        .ok_or("matrices without speed")?;
    let dofs = file["model"]["ndof"]
        .as_u64()
        .ok_or("a model without ndof")? as usize;
    let nodes = rotor.nodes.len();
    let (still, turning) = (rotor.real_dynamics(0.0), rotor.real_dynamics(speed));
    let gyroscopic = (&turning.damping - &still.damping) / speed;
    for (name, unit, ours) in [
        ("M", "kg, kg m, kg m^2", &turning.mass),
        ("K", "N/m, N, N m", &turning.stiffness),
        ("C", "N s/m, N s, N m s", &still.damping),
        ("G", "kg, kg m, kg m^2", &gyroscopic),
    ] {
        let sparse = &given[name];
        worst.row(name, sparse, |worst| {
            let list = |key: &str| {
                sparse[key]
                    .as_array()
                    .ok_or(format!("{name} without {key}"))
            };
            let mut dense = vec![0.0; dofs * dofs];
            for ((i, j), value) in list("rows")?.iter().zip(list("cols")?).zip(list("vals")?) {
                let at = i.as_u64().zip(j.as_u64()).zip(value.as_f64());
                let ((i, j), value) = at.ok_or(format!("a bad entry of {name}"))?;
                let cell = dense.get_mut(i as usize * dofs + j as usize);
                *cell.ok_or(format!("an entry of {name} outside it"))? += value;
            }
            compare(
                name,
                unit,
                ours,
                &|i, j| dense[i * dofs + j],
                dofs,
                nodes,
                worst,
            );
            Ok(())
        })?;
    }
    Ok(())
}

fn eigenvalues(
    analysis: &Analysis,
    speed: f64,
    stated: &[C64],
    tolerance: f64,
    why: &str,
    worst: &mut Worst,
) -> Result<(), String> {
    let mut ours = analysis.oscillations(speed).map_err(told)?;
    for reference in stated {
        // the files list each pair once, without the sense in the sign
        let distance = |z: &C64| (C64::new(z.re, z.im.abs()) - reference).norm();
        let nearest =
            (0..ours.len()).min_by(|a, b| distance(&ours[*a]).total_cmp(&distance(&ours[*b])));
        let own = nearest
            .map(|at| ours.remove(at))
            .ok_or("fewer modes than the file has")?;
        let row = Row::compared(
            "eigenvalue_modulus",
            "1/s",
            reference.norm(),
            own.norm(),
            Tolerance::Relative(tolerance),
            format!("|Δλ|/|λ| at {speed:.6} rad/s; {why}"),
        );
        worst.add(row.by(distance(&own) / reference.norm()));
    }
    Ok(())
}

fn criticals(
    file: &Value,
    analysis: &Analysis,
    tolerance: f64,
    why: &str,
    worst: &mut Worst,
) -> Result<(), String> {
    const SPEEDS: usize = 101;
    let reference = numbers(&file["critical_speeds"]["rad_s"]);
    let top = 1.02 * reference.iter().copied().fold(0.0, f64::max);
    // a rotor that is not said to have any is not searched
    if reference.is_empty() {
        return Ok(());
    }
    let speeds: Vec<f64> = (0..SPEEDS)
        .map(|k| top * k as f64 / (SPEEDS - 1) as f64)
        .collect();
    let diagram = analysis.campbell(&speeds, top).map_err(told)?;
    let ours: Vec<f64> = analysis
        .criticals(&diagram)
        .map_err(told)?
        .iter()
        .map(|one| one.speed)
        .collect();
    for speed in reference {
        let own = ours
            .iter()
            .copied()
            .min_by(|a, b| (a - speed).abs().total_cmp(&(b - speed).abs()));
        let own = own.unwrap_or(f64::NAN);
        let mut criticals = worst.under(Tolerance::Relative(tolerance), why);
        criticals.add("critical_speed", "rad/s", [speed, own]);
    }
    Ok(())
}

fn unbalance(file: &Value, rotor: &Rotor, worst: &mut Worst) -> Result<(), String> {
    let Some(given) = file.get("unbalance").filter(|given| !given.is_null()) else {
        return Ok(());
    };
    let (nodes, amounts, phases) = (
        numbers(&given["node"]),
        numbers(&given["magnitude_kg_m"]),
        numbers(&given["phase_rad"]),
    );
    let planes = nodes.iter().zip(&amounts).zip(&phases);
    let planes: Vec<Unbalance> = planes
        .map(|((node, amount), phase)| Unbalance {
            node: *node as usize,
            amount: *amount,
            phase: *phase,
        })
        .collect();
    if planes.is_empty() || planes.iter().any(|plane| plane.node >= rotor.nodes.len()) {
        return Err("an unbalance without a node of the shaft".to_string());
    }
    let responder = Responder::new(rotor);
    for (k, speed) in numbers(&given["speeds_rad_s"]).into_iter().enumerate() {
        let ours = responder.unbalance(&planes, speed).map_err(told)?;
        for entry in given["response"].as_array().into_iter().flatten() {
            let node = entry["node"]
                .as_u64()
                .filter(|n| (*n as usize) < rotor.nodes.len());
            let node = node.ok_or("a response without a node of the shaft")? as usize;
            let part = |key: &str| numbers(&entry[key]).get(k).copied().unwrap_or(f64::NAN);
            let (x, y) = ours.planes(rotor.coordinate(Place::Node(node)));
            let (rx, ry) = (
                C64::new(part("x_re"), part("x_im")),
                C64::new(part("y_re"), part("y_im")),
            );
            // of a null nothing is compared
            let scale = match (rx + ry).norm() {
                nan if nan.is_nan() => nan,
                _ => rx.norm().max(ry.norm()),
            };
            let deviation = (x - rx).norm().max((y - ry).norm()) / scale;
            let row = Row::compared(
                "response_to_unbalance",
                "m",
                scale,
                x.norm().max(y.norm()),
                Tolerance::Relative(RESPONSE),
                format!(
                    "complex, of x and y, at {speed} rad/s; linear equations in double precision"
                ),
            );
            worst.add(row.by(deviation));
        }
    }
    Ok(())
}

fn standing(file: &Value, rotor: &Rotor, worst: &mut Worst) -> Result<(), String> {
    let Some(forces) = file["static"]["bearing_forces"].as_object() else {
        return Ok(());
    };
    let ours = sag(rotor, 0.0, C64::new(0.0, -9.8065)).map_err(told)?;
    for (support, load) in rotor.supports.iter().zip(&ours.loads) {
        let Place::Node(node) = support.at else {
            continue;
        };
        let Some(reference) = forces.get(&format!("node_{node}")) else {
            continue;
        };
        let reference = reference.as_f64().unwrap_or(f64::NAN);
        let why = "the file holds the rotor in rigid supports";
        let mut loads = worst.under(Tolerance::Relative(STATIC), why);
        loads.add("support_load", "N", [reference, load.norm()]);
    }
    Ok(())
}
