//! What is asked of a rotor, ready to be computed, and what is found.

use crate::evaluate::rotor::levitated::{self, Levitated};
use crate::problem::{Code, Problem};
use crate::scenario::RotorAnalysis;
use crate::scenario::UNNAMED;
use rotor::{
    Analysis, Basis, Campbell, Critical, MapPoint, Matrices, Mode, Place, Responder, Response,
    Rotor, RotorError, Sag, Whirl,
};
use std::sync::OnceLock;
use std::time::Instant;

/// A rotor of at most so many coordinates keeps all of them.
const SMALL: usize = 40;
/// Up to so many coordinates a reduction is held against all of them, beyond against a basis of three times the cut.
const MEDIUM: usize = 240;
/// Critical speeds of each sense in the stiffness map.
const MAPPED: usize = 5;
/// Largest number of criticals at which the deflection is shown.
const DEFLECTIONS: usize = 4;

/// A rotor with what its analyses need.
pub(crate) struct Asked<'a> {
    pub(crate) analysis: &'a RotorAnalysis,
    /// All modes of the free rotor.
    pub(crate) full: Basis,
    pub(crate) matrices: Matrices,
    /// The rotor in the coordinates of the diagrams.
    pub(crate) within: Analysis,
    /// Whether supports or magnets hold it at rest.
    pub(crate) held: bool,
    /// The closed loop with its magnets.
    pub(crate) levitated: Option<Levitated>,
    /// What was found, and how long it took, s.
    found: OnceLock<(Result<Found, RotorError>, f64)>,
}

/// What was found.
pub(crate) struct Found {
    pub(crate) diagram: Campbell,
    pub(crate) criticals: Vec<Critical>,
    /// Modes at the rated speed.
    pub(crate) modes: Vec<Mode>,
    /// Speeds of the diagram, and of responses close to critical speeds between them.
    pub(crate) speeds: Vec<f64>,
    /// Response at each of these speeds; empty without unbalance.
    pub(crate) responses: Vec<Option<Response>>,
    /// Responses at the rated speed and at the most amplified critical speeds, whose shapes are shown.
    pub(crate) deflections: Vec<Response>,
    /// The largest response of each watched place; none without unbalance.
    pub(crate) peaks: Vec<Option<Response>>,
    pub(crate) sag: Option<Sag>,
    pub(crate) map: Vec<MapPoint>,
    /// Error of the eigenvalues at the highest speed against all coordinates; `None` where all are kept.
    pub(crate) reduction_error: Option<f64>,
    pub(crate) receptance_error: Option<f64>,
}

impl<'a> Asked<'a> {
    /// Everything wrong with what is asked is told here.
    pub(crate) fn of(analysis: &'a RotorAnalysis) -> Result<Self, Box<Problem>> {
        let rotor = &analysis.model.rotor;
        let matrices = Matrices::new(rotor);
        let full = Basis::full(rotor, &matrices).map_err(|error| no_answer(error, "rotor"))?;
        let followed = analysis.frequency_to.max(analysis.speed_to);
        let magnets = analysis.model.levitation.as_ref();
        let basis = match (full.len(), magnets) {
            (small, _) if small <= SMALL => full.clone(),
            (_, Some(model)) => levitated::basis(analysis, model, &full, &matrices)?,
            _ => (full.for_analysis(rotor, &matrices, analysis.cutoff, followed))
                .map_err(|error| no_answer(error, "rotor"))?,
        };
        let within = Analysis::new(rotor, &matrices, basis);
        let levitated = magnets
            .map(|model| levitated::find(analysis, model, &within))
            .transpose()?;
        let within = levitated::on_magnets(within, &analysis.model, levitated.as_ref())?;
        let held = levitated.is_some() || rotor::held(rotor, analysis.speed).is_ok();
        let supported = rotor.bearings().count() > 0;
        let needs = if supported {
            Some("a rotor on supports that leave a motion free")
        } else if !rotor.unbalance.is_empty() {
            Some("unbalance, but no [[rotor.support]]")
        } else if analysis.separation_margin.is_some() {
            Some("a separation margin, but no [[rotor.support]]")
        } else {
            None
        };
        if let Some(found) = needs.filter(|_| !held) {
            let allowed = "supports with stiffness in x and y at two nodes at least are needed; without support, unbalance and margin the free rotor is analysed";
            let problem = Problem::new(Code::NotHeld, UNNAMED, found, allowed);
            return Err(Box::new(problem.on_key("rotor.support")));
        }
        let this = Self {
            analysis,
            full,
            matrices,
            within,
            held,
            levitated,
            found: OnceLock::new(),
        };
        this.modes().map_err(|error| match error {
            RotorError::TooManyModes { asked, there } => {
                let found = format!("{asked} modes at {} rad/s", units::number_text(analysis.speed));
                let allowed = format!("at most {there} are needed: so many oscillate in the coordinates kept; analysis.cutoff and more elements give more");
                let problem = Problem::new(Code::TooManyModes, UNNAMED, found, allowed);
                Box::new(problem.on_key("analysis.modes"))
            }
            other => no_answer(other, "rotor"),
        })?;
        Ok(this)
    }

    pub(crate) fn rotor(&self) -> &Rotor {
        &self.analysis.model.rotor
    }

    fn modes(&self) -> Result<Vec<Mode>, RotorError> {
        self.within.modes(self.analysis.speed, self.analysis.modes)
    }

    /// Places whose response is shown: named nodes, magnets, sensors, disks, supports, unbalances, a node once, by its first name; parts without
    /// a name where nothing has one.
    pub(crate) fn watched(&self) -> Vec<(String, usize)> {
        let all = self.places();
        let named: Vec<(String, usize)> = all
            .iter()
            .filter(|(_, _, named)| *named)
            .map(|(label, node, _)| (label.clone(), *node))
            .collect();
        match named.is_empty() {
            true => all
                .into_iter()
                .map(|(label, node, _)| (label, node))
                .collect(),
            false => named,
        }
    }

    /// Label, node and whether it has a name.
    fn places(&self) -> Vec<(String, usize, bool)> {
        let (model, rotor) = (&self.analysis.model, self.rotor());
        let mut out: Vec<(String, usize, bool)> = Vec::new();
        let mut add = |kind: &str, name: &str, node: usize| {
            let (label, named) = (word(kind, name), name.parse::<usize>().is_err());
            let known = out.iter().any(|(known, _, _)| *known == label);
            match out.iter_mut().find(|(_, at, _)| *at == node) {
                // a name is better than a number
                Some(other) if named && !other.2 && !known => *other = (label, node, true),
                None if !known => out.push((label, node, named)),
                _ => {}
            }
        };
        for (name, node) in &model.nodes {
            add("node", name, *node);
        }
        for (name, magnet, sensor) in model.levitation.iter().flat_map(|own| &own.magnets) {
            add("", &format!("magnet_{name}"), *magnet);
            add("", &format!("sensor_{name}"), *sensor);
        }
        for (name, disk) in model.disks.iter().zip(&rotor.disks) {
            add("disk", name, disk.node);
        }
        for (name, support) in model.supports.iter().zip(&rotor.supports) {
            if let Place::Node(node) = support.at {
                add(if support.seal { "seal" } else { "support" }, name, node);
            }
        }
        for (name, unbalance) in model.unbalance.iter().zip(&rotor.unbalance) {
            add("unbalance", name, unbalance.node);
        }
        out
    }

    /// Everything, computed once: limits ask for the names of the results before they are printed.
    pub(crate) fn found(&self) -> &Result<Found, RotorError> {
        &self.timed().0
    }

    /// How long that took, s.
    pub(crate) fn seconds(&self) -> f64 {
        self.timed().1
    }

    fn timed(&self) -> &(Result<Found, RotorError>, f64) {
        self.found.get_or_init(|| {
            let clock = Instant::now();
            (self.find(), clock.elapsed().as_secs_f64())
        })
    }

    fn find(&self) -> Result<Found, RotorError> {
        let (asked, rotor) = (self.analysis, self.rotor());
        let diagram = self.within.campbell(&asked.speeds(), asked.frequency_to)?;
        let criticals = self.within.criticals(&diagram);
        let speeds = match rotor.unbalance.is_empty() {
            true => diagram.speeds.clone(),
            false => refined(&diagram, &criticals),
        };
        let responder = Responder::within(&self.within);
        let respond = |speed: f64| responder.unbalance(&rotor.unbalance, speed).ok();
        let (mut responses, mut deflections, mut peaks) = (Vec::new(), Vec::new(), Vec::new());
        if !rotor.unbalance.is_empty() && self.held {
            responses = speeds.iter().map(|speed| respond(*speed)).collect();
            let shown = std::iter::once(asked.speed).chain(most_amplified(&criticals));
            deflections = shown.filter_map(respond).collect();
            let at = |node: usize| rotor.displacement(node);
            let watched = self.watched().into_iter();
            peaks = watched
                .map(|(_, node)| peak(&speeds, &responses, at(node), &respond))
                .collect();
        }
        let (from, to, count) = (asked.map_from, asked.map_to, asked.map_count);
        let stiffnesses: Vec<f64> = (0..count)
            .map(|k| from * (to / from).powf(k as f64 / (count - 1) as f64))
            .collect();
        let map = match self.held {
            true => {
                let standing = levitated::on_springs(&asked.model);
                rotor::stiffness_map(&standing, &self.within.basis, &stiffnesses, MAPPED)?
            }
            false => Vec::new(),
        };
        let kept = rotor.kept();
        let reduced = self.within.basis.len() < self.full.len();
        let error_of_reduction = || -> Result<f64, RotorError> {
            let reference = match self.full.len() {
                few if few <= MEDIUM => self.full.clone(),
                _ => {
                    let cutoff = 3.0 * asked.cutoff;
                    let followed = asked.frequency_to.max(asked.speed_to);
                    (self.full).for_analysis(rotor, &self.matrices, cutoff, followed)?
                }
            };
            let whole = Analysis::new(rotor, &self.matrices, reference);
            // magnets that held the rotor in other coordinates hold it in these
            let whole = levitated::on_magnets(whole, &asked.model, self.levitated.as_ref())
                .map_err(|_| RotorError::NotConverged)?;
            whole.error_of(&diagram, diagram.speeds.len() - 1, asked.frequency_to)
        };
        let reduction_error = reduced.then(error_of_reduction);
        let top = asked.frequency_to.max(asked.speed_to);
        let receptance_error = (reduced && !kept.is_empty())
            .then(|| (self.within.basis).receptance_error(&self.full, &kept, 0.01 * top, top));
        Ok(Found {
            modes: self.modes()?,
            sag: match &self.levitated {
                Some(levitated) => Some(Sag {
                    shape: levitated.sag.clone(),
                    loads: rotor::loads(rotor, asked.speed, &levitated.sag),
                }),
                None => (self.held)
                    .then(|| rotor::sag(rotor, asked.speed, asked.weight()))
                    .transpose()?,
            },
            reduction_error: reduction_error.transpose()?,
            receptance_error,
            criticals,
            speeds,
            responses,
            deflections,
            peaks,
            map,
            diagram,
        })
    }
}

/// A label for results: the name, or the kind with the number.
pub(crate) fn word(kind: &str, name: &str) -> String {
    match name.parse::<usize>() {
        Ok(number) => format!("{kind}_{number}"),
        Err(_) => name.replace(['.', ' '], "_"),
    }
}

/// Whirl as a number: forward 1, backward -1, planar 0.
pub(crate) fn sense(whirl: Whirl) -> f64 {
    match whirl {
        Whirl::Forward => 1.0,
        Whirl::Backward => -1.0,
        Whirl::Planar => 0.0,
    }
}

/// Speeds of the criticals that amplify most, rising; without those that grow.
fn most_amplified(criticals: &[Critical]) -> Vec<f64> {
    let mut list: Vec<(f64, f64)> = criticals
        .iter()
        .filter_map(|one| Some((one.amplification()?, one.speed)))
        .collect();
    list.sort_by(|a, b| b.0.total_cmp(&a.0));
    list.truncate(DEFLECTIONS);
    let mut speeds: Vec<f64> = list.into_iter().map(|(_, speed)| speed).collect();
    speeds.sort_by(f64::total_cmp);
    speeds
}

/// Speeds close to criticals, where responses peak, between those of the diagram.
fn refined(diagram: &Campbell, criticals: &[Critical]) -> Vec<f64> {
    let mut speeds = diagram.speeds.clone();
    let (Some(first), Some(last)) = (speeds.first().copied(), speeds.last().copied()) else {
        return speeds;
    };
    for critical in criticals {
        // A peak is as wide as its damping; without damping it has no width.
        let width = critical.mode.damping_ratio().abs().clamp(1e-5, 0.05);
        for steps in [-4.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 4.0] {
            speeds.push(critical.speed * (1.0 + steps * width));
        }
    }
    speeds.retain(|speed| (first..=last).contains(speed));
    speeds.sort_by(f64::total_cmp);
    speeds.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * b.abs());
    speeds
}

/// The largest response at a coordinate: from the largest at these speeds by the golden ratio between its neighbours, 40 times, to
/// 1e-8 of their distance.
fn peak(
    speeds: &[f64],
    responses: &[Option<Response>],
    at: usize,
    respond: &dyn Fn(f64) -> Option<Response>,
) -> Option<Response> {
    let of = |one: &Option<Response>| one.as_ref().map_or(-1.0, |one| one.amplitude(at));
    let largest =
        (0..speeds.len()).max_by(|a, b| of(&responses[*a]).total_cmp(&of(&responses[*b])));
    let k = largest?;
    let mut best = responses[k].clone();
    let mut low = speeds[k.saturating_sub(1)];
    let mut high = speeds[(k + 1).min(speeds.len() - 1)];
    let ratio = 0.5 * (5f64.sqrt() - 1.0);
    let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
    let mut found = inner.map(respond);
    for _ in 0..40 {
        let falls = of(&found[0]) > of(&found[1]);
        let better = &found[usize::from(!falls)];
        if of(better) > of(&best) {
            best.clone_from(better);
        }
        if falls {
            (high, inner[1]) = (inner[1], inner[0]);
            inner[0] = high - ratio * (high - low);
            found.swap(0, 1);
            found[0] = respond(inner[0]);
        } else {
            (low, inner[0]) = (inner[0], inner[1]);
            inner[1] = low + ratio * (high - low);
            found.swap(0, 1);
            found[1] = respond(inner[1]);
        }
    }
    best
}

fn no_answer(error: RotorError, key: &str) -> Box<Problem> {
    let needed = "a rotor with mass everywhere is needed";
    let problem = Problem::new(Code::Impossible, UNNAMED, error.to_string(), needed);
    Box::new(problem.on_key(key))
}
