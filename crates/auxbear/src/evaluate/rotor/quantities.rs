//! The named results of the analysis of a rotor.

use crate::evaluate::rotor::asked::{Asked, Found, sense, support_label};
use crate::evaluate::rotor::levitated;
use crate::result::drawing::{self, GIVEN};
use crate::result::list::{List, Origin};
use crate::result::outcome::{Quantity, Value};
use rotor::{C64, Critical, Mode, Whirl};

/// All named results, in the order of the report.
pub(crate) fn name(asked: &Asked, found: &Found) -> Vec<Quantity> {
    let mut list = List::default();
    body(&mut list, asked);
    criticals(&mut list, asked, found);
    modes(&mut list, asked, found);
    responses(&mut list, asked, found);
    sag(&mut list, asked, found);
    map(&mut list, found);
    reduction(&mut list, asked, found);
    drawing::name(&mut list, &asked.analysis.model);
    if let Some(levitated) = &asked.levitated {
        levitated::name(&mut list, &asked.analysis, levitated);
    }
    list.quantities
}

fn body(list: &mut List, asked: &Asked) {
    let body = rotor::properties(asked.rotor());
    let nodes = &asked.rotor().nodes;
    let length =
        nodes.last().copied().unwrap_or_default() - nodes.first().copied().unwrap_or_default();
    for (name, unit, value) in [
        ("mass", "kg", body.mass),
        ("mass_centre", "m", body.centre),
        ("polar_inertia", "kg m^2", body.polar),
        ("transverse_inertia", "kg m^2", body.transverse),
        ("length", "m", length),
    ] {
        list.number(name, unit, Ok(value), &BODY);
    }
    list.push(
        "rated_speed",
        "rad/s",
        Value::Number(asked.analysis.speed),
        &GIVEN,
    );
    list.push(
        "node_count",
        "",
        Value::Number(nodes.len() as f64),
        &ELEMENT,
    );
}

/// A word for a sense of whirl.
pub(crate) fn whirl_word(whirl: Whirl) -> &'static str {
    match whirl {
        Whirl::Forward => "forward",
        Whirl::Backward => "backward",
        Whirl::Planar => "planar",
    }
}

fn criticals(list: &mut List, asked: &Asked, found: &Found) {
    let analysis = &asked.analysis;
    let all = &found.criticals;
    let none = "no mode whirls once a turn up to analysis.speed_to".to_string();
    let first = all.iter().find(|one| one.mode.whirl != Whirl::Backward);
    let first = first.map(|one| one.speed).ok_or(none);
    list.number("first_critical_speed", "rad/s", first, &CRITICAL);
    list.push(
        "critical_speeds",
        "rad/s",
        Value::List(all.iter().map(|one| one.speed).collect()),
        &CRITICAL,
    );
    let senses = all.iter().map(|one| whirl_word(one.mode.whirl));
    let senses: Vec<&str> = senses.collect();
    list.push(
        "critical_whirls",
        "",
        Value::Text(senses.join("\n")),
        &CRITICAL,
    );
    let mut verdict = None;
    for (number, one) in (1..).zip(all) {
        let begin = format!("critical_{number}");
        let separation = one.separation(analysis.operating_from, analysis.operating_to);
        list.number(&format!("{begin}.speed"), "rad/s", Ok(one.speed), &CRITICAL);
        list.number(
            &format!("{begin}.damping_ratio"),
            "",
            Ok(one.mode.damping_ratio()),
            &MODE,
        );
        let amplification = match one.amplification() {
            Some(finite) if finite.is_finite() => Ok(finite),
            Some(_) => Err("the mode has no damping".to_string()),
            None => Err("the mode grows".to_string()),
        };
        list.number(
            &format!("{begin}.amplification"),
            "",
            amplification,
            &AMPLIFICATION,
        );
        let standstill = || "the operating speeds are standstill".to_string();
        let separation_known = Some(separation).filter(|share| share.is_finite());
        list.number(
            &format!("{begin}.separation"),
            "",
            separation_known.ok_or_else(standstill),
            &SEPARATION,
        );
        if let Some(margin) = analysis.separation_margin {
            let word = judged(one, separation, asked, margin);
            if word != "no excitation" {
                let failed = verdict == Some("fail") || word == "fail" || word == "grows";
                verdict = Some(if failed { "fail" } else { "pass" });
            }
            list.push(
                &format!("{begin}.verdict"),
                "",
                Value::Text(word.to_string()),
                &SEPARATION,
            );
        }
    }
    let operated =
        |(from, to): &(f64, f64)| *from <= analysis.operating_to && *to >= analysis.operating_from;
    if found.growing.is_some() || found.unstable.iter().any(operated) {
        verdict = Some("fail");
    } else if verdict != Some("fail")
        && (!found.unlisted.is_empty() || analysis.not_looked_at().is_some())
    {
        verdict = Some("undecided");
    }
    let text = match (analysis.separation_margin, verdict) {
        (None, _) => Value::None {
            why: "analysis.separation_margin is not given".to_string(),
        },
        (Some(_), verdict) => Value::Text(verdict.unwrap_or("pass").to_string()),
    };
    list.push("separation_verdict", "", text, &SEPARATION);
    list.number(
        "first_unstable_speed",
        "rad/s",
        first_unstable(asked, found),
        &STABILITY,
    );
}

/// The verdict on one critical speed. One at which the mode grows has no margin: nothing but time limits it. What whirls backward is not excited by unbalance where x and y are alike.
fn judged(one: &Critical, separation: f64, asked: &Asked, margin: f64) -> &'static str {
    let exempt = asked.analysis.exempt_amplification;
    if one.amplification().is_none() {
        "grows"
    } else if one.mode.whirl == Whirl::Backward && asked.within.turns() {
        "no excitation"
    } else if separation >= margin {
        "pass"
    } else if exempt.is_some_and(|most| one.amplification().is_some_and(|own| own < most)) {
        "damped"
    } else {
        "fail"
    }
}

/// The lowest speed at which a motion grows.
fn first_unstable(asked: &Asked, found: &Found) -> Result<f64, String> {
    let rated = found.growing.map(|_| asked.analysis.speed.abs());
    let first = found.unstable.first().map(|(from, _)| *from);
    let none = || "no motion grows up to analysis.speed_to".to_string();
    (first.into_iter().chain(rated))
        .reduce(f64::min)
        .ok_or_else(none)
}

/// The larger of both senses of a mode, turned so that its largest displacement is real.
fn shape(part: &rotor::Mode, nodes: usize) -> Vec<f64> {
    let power = |v: &[C64]| -> f64 { v.iter().map(|z| z.norm_sqr()).sum() };
    let pick = |v: &dyn Fn(usize) -> C64| -> Vec<C64> { (0..nodes).map(v).collect() };
    let forward = pick(&|node| part.forward[2 * node]);
    let backward = pick(&|node| part.backward[2 * node]);
    let own = if power(&forward) >= power(&backward) {
        forward
    } else {
        backward
    };
    let largest = own.iter().copied().fold(C64::default(), |most, z| {
        if z.norm() > most.norm() { z } else { most }
    });
    let turn = match largest.norm() {
        0.0 => C64::default(),
        size => largest.conj() / (size * size),
    };
    own.iter().map(|z| (z * turn).re).collect()
}

fn modes(list: &mut List, asked: &Asked, found: &Found) {
    let nodes = asked.rotor().nodes.len();
    let free = &asked.full;
    let housings = asked.rotor().housings.len();
    let bending: Vec<usize> = (housings + 2..free.len())
        .take(asked.analysis.modes.most())
        .collect();
    list.push(
        "free_bending_frequencies",
        "rad/s",
        Value::List(bending.iter().map(|k| free.frequencies[*k]).collect()),
        &MODE,
    );
    let first = bending.first().map(|k| free.frequencies[*k]);
    let none = "a rotor without elements does not bend".to_string();
    list.number("first_bending_frequency", "rad/s", first.ok_or(none), &MODE);
    for (number, k) in (1..).zip(&bending) {
        let values: Vec<f64> = (0..nodes).map(|node| free.shapes[(2 * node, *k)]).collect();
        let most = values
            .iter()
            .fold(0.0_f64, |a, b| if b.abs() > a.abs() { *b } else { a });
        let scaled = values.iter().map(|v| v / most).collect();
        list.push(
            &format!("free_mode_{number}.shape"),
            "",
            Value::List(scaled),
            &MODE,
        );
    }
    for (number, mode) in (1..).zip(&found.modes) {
        let begin = format!("mode_{number}");
        let frequency = Ok(mode.frequency());
        list.number(&format!("{begin}.frequency"), "rad/s", frequency, &MODE);
        let ratio = Ok(mode.damping_ratio());
        list.number(&format!("{begin}.damping_ratio"), "", ratio, &MODE);
        let word = whirl_word(mode.whirl).to_string();
        list.push(&format!("{begin}.whirl"), "", Value::Text(word), &MODE);
        list.push(
            &format!("{begin}.shape"),
            "",
            Value::List(shape(mode, nodes)),
            &MODE,
        );
    }
    let branches = found.diagram.branches.iter().map(|branch| {
        let senses = branch
            .modes
            .iter()
            .flatten()
            .map(|mode: &Mode| sense(mode.whirl));
        senses.sum::<f64>().signum()
    });
    list.push("branch_senses", "", Value::List(branches.collect()), &MODE);
}

fn responses(list: &mut List, asked: &Asked, found: &Found) {
    let rated = (found.deflections.iter()).find(|one| one.speed == asked.analysis.speed);
    for (k, watched) in asked.watched().into_iter().enumerate() {
        let (begin, motion) = (watched.name, watched.motion);
        let peak = found.peaks.get(k).and_then(Option::as_ref);
        let none = || match found.responses.is_empty() {
            true => "no [[rotor.unbalance]] is given".to_string(),
            false => "a motion grows there: there is no steady response".to_string(),
        };
        let amplitude = |one: Option<&rotor::Response>| match one {
            Some(one) => match undamped(found, one.speed) {
                Some(speed) => Err(format!(
                    "at {speed:.2} rad/s a mode has no damping: the response has no bound"
                )),
                None => Ok(motion.amplitude(one)),
            },
            None => Err(none()),
        };
        let unit = motion.unit();
        let name = format!("{begin}.peak_amplitude");
        list.number(&name, unit, amplitude(peak), &RESPONSE);
        let speed = peak.map(|one| one.speed).ok_or_else(none);
        list.number(&format!("{begin}.peak_speed"), "rad/s", speed, &RESPONSE);
        let name = format!("{begin}.rated_amplitude");
        list.number(&name, unit, amplitude(rated), &RESPONSE);
    }
    for (number, response) in (1..).zip(&found.deflections) {
        let begin = format!("deflection_{number}");
        list.number(
            &format!("{begin}.speed"),
            "rad/s",
            Ok(response.speed),
            &RESPONSE,
        );
        let nodes = 0..asked.rotor().nodes.len();
        let planes = nodes.map(|node| response.planes(2 * node));
        let (mut x, mut y, mut largest) = (Vec::new(), Vec::new(), Vec::new());
        for (node, (re, im)) in planes.enumerate() {
            x.push(re.re);
            y.push(im.re);
            largest.push(response.amplitude(2 * node));
        }
        for (name, values) in [("x", x), ("y", y), ("amplitude", largest)] {
            list.push(
                &format!("{begin}.{name}"),
                "m",
                Value::List(values),
                &RESPONSE,
            );
        }
    }
}

/// The critical speed without damping at which a peak stands.
fn undamped(found: &Found, peak: f64) -> Option<f64> {
    let mut all = found.criticals.iter();
    let there = all.find(|one| {
        one.amplification() == Some(f64::INFINITY) && (one.speed / peak - 1.0).abs() < 1e-6
    });
    there.map(|one| one.speed)
}

fn sag(list: &mut List, asked: &Asked, found: &Found) {
    let none = || match found.pulled_over {
        true => "a motion on the supports and seals is pulled over: there is no position at rest"
            .to_string(),
        false => "the rotor has no support".to_string(),
    };
    let nodes = asked.rotor().nodes.len();
    let down = asked.analysis.weight();
    let along = |z: C64| match down.norm() {
        0.0 => 0.0,
        size => (z * down.conj()).re / size,
    };
    let of_nodes = found
        .sag
        .as_ref()
        .map(|sag| -> Vec<f64> { (0..nodes).map(|node| along(sag.shape[2 * node])).collect() });
    let largest = of_nodes
        .as_ref()
        .map(|all| all.iter().copied().fold(0.0, f64::max));
    list.number("largest_sag", "m", largest.ok_or_else(none), &SAG);
    let value = of_nodes.map_or_else(|| Value::None { why: none() }, Value::List);
    list.push("sag", "m", value, &SAG);
    let all = asked
        .analysis
        .model
        .supports
        .iter()
        .zip(&asked.rotor().supports);
    for (index, (name, support)) in all.enumerate() {
        if support.seal {
            continue;
        }
        // against gravity: what it carries; below zero it holds down
        let load = found.sag.as_ref().map(|sag| -along(sag.loads[index]));
        let label = format!("load.{}", support_label(name, support));
        list.number(&label, "N", load.ok_or_else(none), &SAG);
    }
}

fn map(list: &mut List, found: &Found) {
    let stiffness = found.map.iter().map(|point| point.stiffness);
    list.push(
        "map_stiffnesses",
        "N/m",
        Value::List(stiffness.collect()),
        &MAP,
    );
    for (name, part) in [
        (
            "forward",
            (|point| &point.forward) as fn(&rotor::MapPoint) -> &Vec<f64>,
        ),
        ("backward", |point| &point.backward),
    ] {
        // a critical speed that is there at every stiffness
        let count = found.map.iter().map(|point| part(point).len()).min();
        for number in 0..count.unwrap_or_default() {
            let speeds = found.map.iter().map(|point| part(point)[number]);
            let values = Value::List(speeds.collect());
            list.push(&format!("map_{name}_{}", number + 1), "rad/s", values, &MAP);
        }
    }
}

fn reduction(list: &mut List, asked: &Asked, found: &Found) {
    let coordinates = asked.within.basis.len() as f64;
    list.push("coordinates", "", Value::Number(coordinates), &REDUCTION);
    let all = || "all coordinates are kept".to_string();
    let error = found.reduction_error.ok_or_else(all);
    list.number("reduction_error", "", error, &REDUCTION);
    let none =
        || "all coordinates are kept, or none carries a support, seal or unbalance".to_string();
    let error = found.receptance_error.ok_or_else(none);
    list.number("receptance_error", "", error, &REDUCTION);
}

const RANGE: &str =
    "small motion of a round shaft; no torsion, no axial motion, no stress stiffening";
const BODY: Origin = Origin {
    law: "sums over elements and disks of their mass matrices in rigid motion",
    source: "crates/rotor/src/properties.rs",
    valid: "supports and housings do not count; inertias about the mass centre",
};
const ELEMENT: Origin = Origin {
    law: "two-node Timoshenko elements with consistent mass, Cowper's shear coefficient",
    source: "crates/rotor/src/element.rs; Cowper 1966",
    valid: RANGE,
};
const MODE: Origin = Origin {
    law: "λ of λ²M + λ(D_e + D_i - jΩG) + K - jΩD_i with supports; damping ratio -Re λ/|λ|",
    source: "crates/rotor/src/modes.rs",
    valid: RANGE,
};
const CRITICAL: Origin = Origin {
    law: "|Im λ(Ω)| = Ω, searched between the speeds of the diagram",
    source: "crates/rotor/src/campbell.rs",
    valid: RANGE,
};
const AMPLIFICATION: Origin = Origin {
    law: "1/(2ζ) of the mode at its critical speed",
    source: "a single mode; the width of a peak of the response gives nearly the same",
    valid: "modes that stand apart, ζ below 0.3",
};
const SEPARATION: Origin = Origin {
    law: "distance from the operating speeds over the nearer one; 0 within them; verdict against analysis.separation_margin",
    source: "the user's limits, in the manner of API 617",
    valid: "backward ones get no verdict where every support treats all directions alike: unbalance does not drive them",
};
const STABILITY: Origin = Origin {
    law: "the lowest speed at which an eigenvalue, whirling or not, has Re λ above round-off; between two speeds of the diagram to 1e-9",
    source: "crates/rotor/src/campbell.rs",
    valid: "linear supports and seals",
};
const RESPONSE: Origin = Origin {
    law: "(K - jΩD_i - Ω²M + jΩ(D_e + D_i - jΩG)) Q = Σ u Ω² e^{jδ}; half the longer axis of the orbit",
    source: "crates/rotor/src/response.rs",
    valid: "speeds of the diagram and points close to critical speeds, peaks by search between them; linear supports",
};
const SAG: Origin = Origin {
    law: "K q = weight, with the stiffness of the supports at the rated speed",
    source: "crates/rotor/src/response.rs",
    valid: "a rotor at rest; seals do not carry",
};
const MAP: Origin = Origin {
    law: "K x = Ω²(M ∓ G)x with one stiffness for all supports",
    source: "crates/rotor/src/stiffness_map.rs",
    valid: "undamped; seals left out, mounts of housings as they are",
};
const REDUCTION: Origin = Origin {
    law: "free modes up to analysis.cutoff, residual flexibility at supports, seals, unbalances and of gyroscopic moments",
    source: "crates/rotor/src/basis.rs; Rubin 1975 (from memory)",
    valid: "modes shown and eigenvalues at the highest speed against all coordinates; receptances of the free rotor at rest",
};
