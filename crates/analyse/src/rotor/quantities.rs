//! The named results of the analysis of a rotor.

use crate::rotor::request::{Analyses, Motion, Request, gravity, sense, support_label};
use crate::rotor::{levitated, rolling, whirl};
use outcome::Quantity;
use outcome::list::results;
use outcome::list::{List, origins};
use rotor::{C64, Critical, Mode, Response, Whirl};
use simulate::drawing::{self, GIVEN};

/// Names the results, in the order of the report; without a second argument those of any such analysis.
pub(crate) fn name(asked: &Request, found: Option<&Analyses>) -> Vec<Quantity> {
    let mut list = List::default();
    body(&mut list, asked, found);
    on_supports(&mut list, asked, found, true);
    if asked.responds() {
        let all = found.map(|found| &found.deflections[..]);
        list.numbered(all, |list, one| deflection(list, asked, one));
    }
    sag(&mut list, asked, found);
    let supports = asked.model.supports.iter();
    for (index, (given, support)) in supports.zip(&asked.rotor().supports).enumerate() {
        if !support.seal {
            list.named(&[&support_label(&given.name, support)], |list| {
                support_load(list, &(asked, index), found);
            });
        }
    }
    map(&mut list, asked, found);
    for forward in [true, false] {
        let curves = found.map(|found| found.mapped(forward));
        if asked.held {
            list.numbered(curves.as_deref(), |list, one| mapped(list, &forward, one));
        }
    }
    reduction(&mut list, asked, found);
    drawing::name(&mut list, &asked.model, &[]);
    let own = found.and(asked.levitated.as_ref());
    levitated::name(&mut list, &asked.model, own);
    if let Some(model) = &asked.whirl {
        whirl::results::name(&mut list, model, found.map(|found| &found.whirl[..]));
    }
    if let Some(Ok(model)) = &asked.rolling {
        let own = found.map(|found| found.rolling.as_deref());
        rolling::results::name(&mut list, model, own.flatten());
    }
    list.quantities
}

/// Motion of the rotor on its supports; `whole` with the modes of the free rotor.
pub(crate) fn on_supports(list: &mut List, asked: &Request, found: Option<&Analyses>, whole: bool) {
    criticals(list, asked, found);
    let all = found.map(|found| &found.criticals[..]);
    list.numbered(all, |list, one| critical(list, asked, one));
    stability(list, asked, found);
    if whole {
        bending(list, asked, found);
        for (number, mode) in (1..).zip(asked.bending()) {
            list.named(&[&format!("{number}")], |list| {
                bending_mode(list, &(asked, mode), found);
            });
        }
    }
    let all = found.map(|found| &found.modes[..]);
    list.numbered(all, |list, one| mode(list, asked, one));
    branches(list, asked, found);
    for (k, watched) in asked.watched().into_iter().enumerate() {
        let motion = watched.motion;
        let shown = Shown { asked, motion, k };
        list.named(&[&watched.name], |list| response(list, &shown, found));
    }
}

/// Why a response at a speed has no bound: a mode without damping whirls once a turn there.
pub(crate) fn undamped(found: &Analyses, speed: f64) -> Option<String> {
    let undamped = found.criticals.iter().find(|critical| {
        let near = (critical.speed / speed - 1.0).abs() < 1e-6;
        near && critical.amplification() == Some(f64::INFINITY)
    });
    undamped.map(|Critical { speed, .. }| {
        format!("at {speed:.2} rad/s a mode has no damping: the response has no bound")
    })
}

results! {
    fn body(asked: &Request, run: &Analyses) {
        "mass": number "kg" headline, BODY, "mass of the rotor" in properties "mass" in rotor_line "mass" => rotor::properties(asked.rotor()).mass;
        "mass_centre": number "m" headline, BODY, "position of its centre of mass" in properties "mass centre" => rotor::properties(asked.rotor()).centre;
        "polar_inertia": number "kg m^2", BODY, "polar moment of inertia" in properties "polar inertia" => rotor::properties(asked.rotor()).polar;
        "transverse_inertia": number "kg m^2", BODY, "transverse moment of inertia" in properties "transverse inertia" => rotor::properties(asked.rotor()).transverse;
        "length": number "m", BODY, "length from the first node to the last" in properties "length" in rotor_line "length" => asked.length();
        "rated_speed": number "rad/s", GIVEN, "rated speed" in rated "rated" in rotor_line "rated" => asked.analysis.speed;
        "node_count": number "", ELEMENT, "number of nodes" in properties "nodes" => asked.rotor().nodes.len() as f64;
    }

    fn criticals(asked: &Request, run: &Analyses) {
        "first_critical_speed": number "rad/s" headline, CRITICAL, "lowest critical speed that is not of backward whirl" in tile "First critical speed" => run.first_critical();
        "critical_speeds": list "rad/s", CRITICAL, "critical speeds" => run.criticals.iter().map(|one| one.speed).collect::<Vec<_>>();
        "critical_whirls": text "", CRITICAL, "sense of whirl at each of them" in criticals_whirl "whirl" => run.whirls();
    }

    fn critical(asked: &Request, run: &Critical) {
        "critical_*.speed": number "rad/s" headline, CRITICAL, "critical speed" in criticals "speed" => run.speed;
        "critical_*.damping_ratio": number "", MODE, "damping ratio of the mode there" => run.mode.damping_ratio();
        "critical_*.amplification": number "" headline, AMPLIFICATION, "amplification factor of the mode there" in criticals "amplification" => amplification(run);
        "critical_*.separation": number "" headline, SEPARATION, "separation margin to the operating speeds" in criticals "separation [%]" => {
            Some(asked.separation(run)).filter(|share| share.is_finite()).ok_or_else(|| "the operating speeds are standstill".to_string())
        };
        "critical_*.verdict": text "" headline, SEPARATION, "verdict on its margin" in criticals "verdict" when asked.analysis.separation_margin.is_some() => asked.verdict(run);
    }

    fn stability(asked: &Request, run: &Analyses) {
        "separation_verdict": text "" headline, SEPARATION, "verdict on all critical speeds" in tile "Separation" in bound "fail / pass", unless asked.no_margin() => asked.whole_verdict(run);
        "first_unstable_speed": number "rad/s" headline, STABILITY, "lowest speed at which a motion grows" => asked.first_unstable(run);
    }

    fn bending(asked: &Request, run: &Analyses) {
        "free_bending_frequencies": list "rad/s", MODE, "natural frequencies of bending of the free rotor at rest" in free_bending "frequency" => {
            asked.bending().map(|k| asked.full.frequencies[k]).collect::<Vec<_>>()
        };
        "first_bending_frequency": number "rad/s" headline, MODE, "lowest of them" in tile "First free bending mode [Hz]" => {
            asked.bending().next().map(|k| asked.full.frequencies[k]).ok_or_else(|| "a rotor without elements does not bend".to_string())
        };
    }

    fn bending_mode(of: &(&Request, usize), run: &Analyses) {
        "free_mode_*.shape": list "", MODE, "shape of a bending mode of the free rotor at its nodes" in free_mode_shapes "shape" => of.0.bending_shape(of.1);
    }

    fn mode(asked: &Request, run: &Mode) {
        "mode_*.frequency": number "rad/s", MODE, "damped natural frequency at the rated speed" in modes "frequency" => run.frequency();
        "mode_*.damping_ratio": number "", MODE, "damping ratio at the rated speed" in modes "ζ [%]" => run.damping_ratio();
        "mode_*.whirl": text "", MODE, "sense of whirl at the rated speed" in modes "whirl" => whirl_word(run.whirl);
        "mode_*.shape": list "", MODE, "shape at the nodes, of its larger sense of whirl" in mode_shapes "shape" => shape(run, asked.rotor().nodes.len());
    }

    fn branches(asked: &Request, run: &Analyses) {
        "branch_senses": list "", MODE, "whirl of each branch of the diagram: 1 forward, -1 backward, 0 planar" in branches "sense" => run.branch_senses();
    }

    fn response(of: &Shown, run: &Analyses) {
        "*.peak_amplitude": number "m" headline, RESPONSE, "largest response to unbalance, half the longer axis" in responses "largest amplitude" when !of.is_force() => of.amplitude(run, of.peak(run));
        "*.peak_amplitude": number "N" headline, RESPONSE, "largest force under unbalance, half the longer axis" in responses "largest amplitude" when of.is_force() => of.amplitude(run, of.peak(run));
        "*.peak_speed": number "rad/s" headline, RESPONSE, "speed at which it is largest" in responses "at" => of.peak(run).map(|one| one.speed).ok_or_else(|| no_response(run));
        "*.rated_amplitude": number "m" headline, RESPONSE, "response to unbalance at the rated speed" in responses "at the rated speed" when !of.is_force() => of.amplitude(run, of.rated(run));
        "*.rated_amplitude": number "N" headline, RESPONSE, "force under unbalance at the rated speed" in responses "at the rated speed" when of.is_force() => of.amplitude(run, of.rated(run));
    }

    fn deflection(asked: &Request, run: &Response) {
        "deflection_*.speed": number "rad/s", RESPONSE, "speed of a deflected shape" in deflections "speed" => run.speed;
        "deflection_*.x": list "m", RESPONSE, "x of each node when the mark passes" => asked.over_nodes(|node| run.planes(node).0.re);
        "deflection_*.y": list "m", RESPONSE, "y of each node when the mark passes" => asked.over_nodes(|node| run.planes(node).1.re);
        "deflection_*.amplitude": list "m", RESPONSE, "half the longer axis of the orbit of each node" in deflections "amplitude" => asked.over_nodes(|node| run.amplitude(node));
    }

    fn sag(asked: &Request, run: &Analyses) {
        "largest_sag": number "m" headline, SAG, "largest sag under weight" in tile "Largest sag" => asked.sag(run).map(|all| all.into_iter().fold(0.0, f64::max));
        "sag": list "m", SAG, "sag of each node under weight" in sag "sag" => asked.sag(run);
    }

    fn support_load(of: &(&Request, usize), run: &Analyses) {
        "load.*": number "N" headline, SAG, "weight that a support carries" in support_loads "*" => of.0.support_load(run, of.1);
    }

    fn map(asked: &Request, run: &Analyses) {
        "map_stiffnesses": list "N/m", MAP, "stiffnesses of the supports in the map" in stiffness_map "stiffness" => run.map.iter().map(|point| point.stiffness).collect::<Vec<_>>();
    }

    fn mapped(forward: &bool, run: &Vec<f64>) {
        "map_forward_*": list "rad/s", MAP, "critical speed of forward whirl at each of them" in stiffness_map "forward" when *forward => run.clone();
        "map_backward_*": list "rad/s", MAP, "critical speed of backward whirl at each of them" in stiffness_map "backward" when !*forward => run.clone();
    }

    fn reduction(asked: &Request, run: &Analyses) {
        "coordinates": number "" headline, REDUCTION, "number of coordinates kept" in properties "coordinates of the diagrams" => asked.within.basis.len() as f64;
        "reduction_error": number "" headline, REDUCTION, "largest relative error of eigenvalues that this makes" in tile "Error of the reduction" => {
            run.reduction_error.ok_or_else(|| "all coordinates are kept".to_string())
        };
        "receptance_error": number "", REDUCTION, "largest relative error of receptances that this makes" => {
            run.receptance_error.ok_or_else(|| "all coordinates are kept, or none carries a support, seal or unbalance".to_string())
        };
    }
}

/// A word for a sense of whirl.
fn whirl_word(whirl: Whirl) -> &'static str {
    match whirl {
        Whirl::Forward => "forward",
        Whirl::Backward => "backward",
        Whirl::Planar => "planar",
    }
}

fn amplification(one: &Critical) -> Result<f64, String> {
    match one.amplification() {
        Some(finite) if finite.is_finite() => Ok(finite),
        Some(_) => Err("the mode has no damping".to_string()),
        None => Err("the mode grows".to_string()),
    }
}

/// The larger of both senses of a mode, turned so that its largest displacement is real.
fn shape(part: &Mode, nodes: usize) -> Vec<f64> {
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

/// Why there is no response at a speed.
fn no_response(found: &Analyses) -> String {
    match found.responses.is_empty() {
        true => "no [[rotor.unbalance]] is given".to_string(),
        false => "a motion grows there: there is no steady response".to_string(),
    }
}

/// A part of the response, by its number among those watched.
struct Shown<'a> {
    asked: &'a Request,
    motion: Motion,
    k: usize,
}

impl Shown<'_> {
    fn is_force(&self) -> bool {
        matches!(self.motion, Motion::Force(_))
    }

    fn peak<'a>(&self, found: &'a Analyses) -> Option<&'a Response> {
        found.peaks.get(self.k).and_then(Option::as_ref)
    }

    fn rated<'a>(&self, found: &'a Analyses) -> Option<&'a Response> {
        let mut all = found.deflections.iter();
        all.find(|one| one.speed == self.asked.analysis.speed)
    }

    fn amplitude(&self, found: &Analyses, one: Option<&Response>) -> Result<f64, String> {
        let one = one.ok_or_else(|| no_response(found))?;
        match undamped(found, one.speed) {
            Some(why) => Err(why),
            None => Ok(self.motion.amplitude(one)),
        }
    }
}

impl Analyses {
    fn first_critical(&self) -> Result<f64, String> {
        let mut all = self.criticals.iter();
        let first = all.find(|one| one.mode.whirl != Whirl::Backward);
        let none = || "no mode whirls once a turn up to analysis.speed_to".to_string();
        first.map(|one| one.speed).ok_or_else(none)
    }

    fn whirls(&self) -> String {
        let all = self.criticals.iter();
        let words: Vec<&str> = all.map(|one| whirl_word(one.mode.whirl)).collect();
        words.join("\n")
    }

    /// The rotor at rest under its weight.
    fn at_rest(&self) -> Result<&rotor::Sag, String> {
        let none = || match self.pulled_over {
            true => {
                "a motion on the supports and seals is pulled over: there is no position at rest"
            }
            false => "the rotor has no support",
        };
        self.sag.as_ref().ok_or_else(|| none().to_string())
    }

    fn branch_senses(&self) -> Vec<f64> {
        let branches = self.diagram.branches.iter().map(|branch| {
            let modes = branch.modes.iter().flatten();
            modes.map(|mode| sense(mode.whirl)).sum::<f64>().signum()
        });
        branches.collect()
    }

    /// Critical speeds of one sense that are there at every stiffness of the map, over these.
    fn mapped(&self, forward: bool) -> Vec<Vec<f64>> {
        let part = |point: &'_ rotor::MapPoint| match forward {
            true => point.forward.clone(),
            false => point.backward.clone(),
        };
        let all: Vec<Vec<f64>> = self.map.iter().map(part).collect();
        let count = all.iter().map(Vec::len).min().unwrap_or_default();
        let curve = |number: usize| all.iter().map(|speeds| speeds[number]).collect();
        (0..count).map(curve).collect()
    }
}

impl Request {
    /// Whether a response to unbalance is sought.
    pub(crate) fn responds(&self) -> bool {
        self.held && !self.rotor().unbalance.is_empty()
    }

    fn length(&self) -> f64 {
        let nodes = &self.rotor().nodes;
        nodes.last().copied().unwrap_or_default() - nodes.first().copied().unwrap_or_default()
    }

    /// A value of the displacement of each node.
    pub(crate) fn over_nodes(&self, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let nodes = 0..self.rotor().nodes.len();
        nodes.map(|node| value(2 * node)).collect()
    }

    /// The modes of the free rotor that bend it and are shown.
    fn bending(&self) -> impl Iterator<Item = usize> {
        (self.rotor().housings.len() + 2..self.full.len()).take(self.analysis.modes)
    }

    fn bending_shape(&self, mode: usize) -> Vec<f64> {
        let values = self.over_nodes(|displacement| self.full.shapes[(displacement, mode)]);
        let larger = |a: f64, b: &f64| if b.abs() > a.abs() { *b } else { a };
        let most = values.iter().fold(0.0, larger);
        values.iter().map(|v| v / most).collect()
    }

    fn separation(&self, one: &Critical) -> f64 {
        one.separation(self.analysis.operating_from, self.analysis.operating_to)
    }

    /// Why critical speeds get no verdict.
    fn no_margin(&self) -> Option<String> {
        let given = self.analysis.separation_margin.is_some();
        (!given).then(|| "analysis.separation_margin is not given".to_string())
    }

    /// The verdict on one critical speed. One at which the mode grows has no margin: nothing but time limits it. What whirls backward is not excited by unbalance where x and y are alike.
    fn verdict(&self, one: &Critical) -> &'static str {
        let margin = self.analysis.separation_margin.unwrap_or_default();
        let exempt = self.analysis.exempt_amplification;
        if one.amplification().is_none() {
            "grows"
        } else if one.mode.whirl == Whirl::Backward && self.within.turns() {
            "no excitation"
        } else if self.separation(one) >= margin {
            "pass"
        } else if exempt.is_some_and(|most| one.amplification().is_some_and(|own| own < most)) {
            "damped"
        } else {
            "fail"
        }
    }

    /// The verdict on all critical speeds.
    fn whole_verdict(&self, found: &Analyses) -> &'static str {
        let (from, to) = (self.analysis.operating_from, self.analysis.operating_to);
        let operated = |range: &(f64, f64)| range.0 <= to && range.1 >= from;
        let fails = |one: &Critical| ["fail", "grows"].contains(&self.verdict(one));
        if found.growing.is_some()
            || found.unstable.iter().any(operated)
            || found.criticals.iter().any(fails)
        {
            "fail"
        } else if !found.unlisted.is_empty() || self.analysis.not_looked_at().is_some() {
            "undecided"
        } else {
            "pass"
        }
    }

    /// The lowest speed at which a motion grows.
    fn first_unstable(&self, found: &Analyses) -> Result<f64, String> {
        let rated = found.growing.map(|_| self.analysis.speed.abs());
        let first = found.unstable.first().map(|(from, _)| *from);
        let none = || "no motion grows up to analysis.speed_to".to_string();
        (first.into_iter().chain(rated))
            .reduce(f64::min)
            .ok_or_else(none)
    }

    /// A displacement along the weight.
    fn along_weight(&self, z: C64) -> f64 {
        let down = gravity(&self.analysis);
        match down.norm() {
            0.0 => 0.0,
            size => (z * down.conj()).re / size,
        }
    }

    fn sag(&self, found: &Analyses) -> Result<Vec<f64>, String> {
        let sag = found.at_rest()?;
        Ok(self.over_nodes(|displacement| self.along_weight(sag.shape[displacement])))
    }

    /// Against gravity: what a support carries; below zero it holds down.
    fn support_load(&self, found: &Analyses, support: usize) -> Result<f64, String> {
        Ok(-self.along_weight(found.at_rest()?.loads[support]))
    }
}

const RANGE: &str =
    "small motion of a round shaft; no torsion, no axial motion, no stress stiffening";
origins! {
    BODY: law "sums over elements and disks of their mass matrices in rigid motion",
        source "crates/rotor/src/properties.rs",
        valid "supports and housings do not count; inertias about the mass centre";
    ELEMENT: law "two-node Timoshenko elements with consistent mass, Cowper's shear coefficient",
        source "crates/rotor/src/element.rs; Cowper 1966",
        valid RANGE;
    MODE: law "λ of λ²M + λ(D_e + D_i - jΩG) + K - jΩD_i with supports; damping ratio -Re λ/|λ|",
        source "crates/rotor/src/modes.rs",
        valid RANGE;
    CRITICAL: law "|Im λ(Ω)| = Ω, searched between the speeds of the diagram",
        source "crates/rotor/src/campbell.rs",
        valid RANGE;
    AMPLIFICATION: law "1/(2ζ) of the mode at its critical speed",
        source "a single mode; the width of a peak of the response gives nearly the same",
        valid "modes that stand apart, ζ below 0.3";
    SEPARATION: law "distance from the operating speeds over the nearer one; 0 within them; verdict against analysis.separation_margin",
        source "the user's limits, in the manner of API 617",
        valid "backward ones get no verdict where every support treats all directions alike: unbalance does not drive them";
    STABILITY: law "the lowest speed at which an eigenvalue, whirling or not, has Re λ above round-off; between two speeds of the diagram to 1e-9",
        source "crates/rotor/src/campbell.rs",
        valid "linear supports and seals";
    RESPONSE: law "(K - jΩD_i - Ω²M + jΩ(D_e + D_i - jΩG)) Q = Σ u Ω² e^{jδ}; half the longer axis of the orbit",
        source "crates/rotor/src/response.rs",
        valid "speeds of the diagram and points close to critical speeds, peaks by search between them; linear supports";
    SAG: law "K q = weight, with the stiffness of the supports at the rated speed",
        source "crates/rotor/src/response.rs",
        valid "a rotor at rest; seals do not carry";
    MAP: law "K x = Ω²(M ∓ G)x with one stiffness for all supports",
        source "crates/rotor/src/stiffness_map.rs",
        valid "undamped; seals left out, mounts of housings as they are";
    REDUCTION: law "free modes up to analysis.cutoff, residual flexibility at supports, seals, unbalances and of gyroscopic moments",
        source "crates/rotor/src/basis.rs; Rubin 1975 (from memory)",
        valid "modes shown and eigenvalues at the highest speed against all coordinates; receptances of the free rotor at rest";
}
