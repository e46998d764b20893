//! What is asked of a rotor, ready to be computed, and what is found.

use crate::rotor::levitated::{self, Levitated};
use crate::rotor::rolling::{RollingFound, RollingModel};
use crate::rotor::whirl::{BearingWhirl, WhirlModel};
use problem::{Code, Problem};
use rotor::{
    Analysis, Basis, C64, Campbell, Critical, MapPoint, Matrices, Mode, ModeCount, Place,
    Responder, Response, Rotor, RotorError, Sag, Whirl,
};
use scenario::{RotorAnalysis, problem_at};
use simulate::rotor::RotorModel;

/// A rotor of at most so many coordinates keeps all of them.
pub(crate) const SMALL: usize = 40;
/// Up to so many coordinates a reduction is held against all of them, beyond against a basis of three times the cut.
const MEDIUM: usize = 240;
/// The cut over the highest frequency that is looked at.
const BEYOND: f64 = 6.0;
/// Critical speeds of each sense in the stiffness map.
const MAPPED: usize = 5;
/// Largest number of criticals at which the deflection is shown.
const DEFLECTIONS: usize = 4;

/// A rotor with what its analyses need.
pub struct Request {
    pub(crate) analysis: RotorAnalysis,
    /// The model of the rotor.
    pub(crate) model: RotorModel,
    /// All modes of the free rotor.
    pub(crate) full: Basis,
    pub(crate) matrices: Matrices,
    /// The rotor in the coordinates of the diagrams.
    pub(crate) within: Analysis,
    /// Modes of the free rotor up to this frequency are kept, rad/s.
    cut: f64,
    /// Whether supports or magnets hold it at rest.
    pub(crate) held: bool,
    /// The closed loop with its magnets.
    pub(crate) levitated: Option<Levitated>,
    /// The machine's auxiliary bearings, in which the rotor may whirl.
    pub(crate) whirl: Option<WhirlModel>,
    /// The rotor as it rolls on them, or why it is not analysed so; none of a rotor alone.
    pub(crate) rolling: Option<Result<RollingModel, String>>,
}

/// What was found.
pub(crate) struct Analyses {
    pub(crate) diagram: Campbell,
    pub(crate) criticals: Vec<Critical>,
    /// Modes at the rated speed.
    pub(crate) modes: Vec<Mode>,
    /// The eigenvalue that grows fastest at the rated speed.
    pub(crate) growing: Option<C64>,
    /// Ranges of speed in which a motion grows.
    pub(crate) unstable: Vec<(f64, f64)>,
    /// Whether a motion leaves its place without whirling, so that the rotor has no position at rest.
    pub(crate) pulled_over: bool,
    /// Speeds of narrow peaks of the response at no listed critical speed.
    pub(crate) unlisted: Vec<f64>,
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
    /// Dry whirl in each auxiliary bearing.
    pub(crate) whirl: Vec<BearingWhirl>,
    /// The rotor as it rolls on them.
    pub(crate) rolling: Option<Box<RollingFound>>,
}

/// Gravity x + jy, m/s².
pub(crate) fn gravity(analysis: &RotorAnalysis) -> C64 {
    C64::from_polar(analysis.gravity, analysis.gravity_angle)
}

impl Request {
    /// Everything wrong with what is asked is told here.
    pub fn of(analysis: &RotorAnalysis) -> Result<Self, Box<Problem>> {
        let model = RotorModel::new(&analysis.rotor, analysis.speed)?;
        let rotor = &model.rotor;
        let matrices = Matrices::new(rotor);
        let full = Basis::full(rotor, &matrices).map_err(|error| no_answer(error, "rotor"))?;
        let magnets = model.levitation.as_ref();
        let mut cut = analysis.cutoff;
        let (levitated, within) = loop {
            let followed = analysis
                .frequency_to
                .max(analysis.speed_to)
                .max(cut / BEYOND);
            let basis = match (full.len(), magnets) {
                (small, _) if small <= SMALL => full.clone(),
                (_, Some(magnets)) => {
                    let limits = (analysis.speed, cut);
                    levitated::basis(rotor, magnets, &full, &matrices, limits)?
                }
                _ => (full.for_analysis(rotor, &matrices, cut, followed))
                    .map_err(|error| no_answer(error, "rotor"))?,
            };
            let within = Analysis::new(rotor, &matrices, basis);
            let levitated = magnets
                .map(|magnets| levitated::find(analysis, rotor, magnets, &within))
                .transpose()?;
            let within = levitated::on_magnets(within, &model, levitated.as_ref())?;
            if analysis.cutoff_given || within.basis.len() == full.len() {
                break (levitated, within);
            }
            // as far above the modes shown as above the frequencies looked at
            let most = ModeCount::AtMost(analysis.modes);
            let shown = (within.modes(analysis.speed, most)).map_err(|e| no_answer(e, "rotor"))?;
            let highest = shown.last().map_or(0.0, Mode::frequency);
            if shown.len() == most.most() && BEYOND * highest <= cut {
                break (levitated, within);
            }
            cut = (1.01 * BEYOND * highest).max(2.0 * cut);
        };
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
            return Err(problem_at(Code::NotHeld, "rotor.support", found, allowed));
        }
        let whirl = WhirlModel::of(analysis, &model, &full, cut)?;
        let this = Self {
            rolling: RollingModel::of(analysis)?,
            whirl,
            analysis: analysis.clone(),
            model,
            full,
            matrices,
            within,
            cut,
            held,
            levitated,
        };
        this.modes().map_err(|error| match error {
            RotorError::TooManyModes { asked, there } => {
                let found = format!("{asked} modes at {} rad/s", units::number_text(analysis.speed));
                let allowed = format!("at most {there} are needed: so many oscillate in the coordinates kept; analysis.cutoff and more elements give more");
                problem_at(Code::TooManyModes, "analysis.modes", found, allowed)
            }
            other => no_answer(other, "rotor"),
        })?;
        Ok(this)
    }

    pub(crate) fn rotor(&self) -> &Rotor {
        &self.model.rotor
    }

    fn modes(&self) -> Result<Vec<Mode>, RotorError> {
        let count = match self.analysis.modes_given {
            true => ModeCount::Exactly(self.analysis.modes),
            false => ModeCount::AtMost(self.analysis.modes),
        };
        self.within.modes(self.analysis.speed, count)
    }

    /// What is shown of the response: displacements of places and housings, of shafts in their housings, forces of supports.
    pub(crate) fn watched(&self) -> Vec<Watched> {
        let (model, rotor) = (&self.model, self.rotor());
        let watched = |name: String, motion| Watched { name, motion };
        let displacement = |(label, node): (String, usize)| {
            let at = Motion::Of(rotor.displacement(node));
            watched(format!("response.{label}"), at)
        };
        let mut out: Vec<Watched> = self.watched_nodes().into_iter().map(displacement).collect();
        for (index, (given, support)) in model.supports.iter().zip(&rotor.supports).enumerate() {
            let label = support_label(&given.name, support);
            if let Place::Housing(_) = support.at {
                let name = format!("response.{label}");
                let taken = out.iter().any(|own| own.name == name);
                let name = if taken {
                    format!("response.housing_{label}")
                } else {
                    name
                };
                out.push(watched(name, Motion::Of(rotor.coordinate(support.at))));
            }
            if support.on.is_some() && !support.seal {
                out.push(watched(format!("relative.{label}"), Motion::Across(index)));
            }
            if !support.seal {
                out.push(watched(format!("force.{label}"), Motion::Force(index)));
            }
        }
        out
    }

    /// Places whose response is shown: named nodes, magnets, sensors, disks, supports, unbalances, a node once, by its first name; parts without
    /// a name where nothing has one.
    fn watched_nodes(&self) -> Vec<(String, usize)> {
        let all = self.places();
        let any = all.iter().any(|(_, _, named)| *named);
        let shown = all.into_iter().filter(|(_, _, named)| *named || !any);
        shown.map(|(label, node, _)| (label, node)).collect()
    }

    /// Label, node and whether it has a name.
    fn places(&self) -> Vec<(String, usize, bool)> {
        let (model, rotor) = (&self.model, self.rotor());
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
        for (name, node) in model.named_nodes() {
            add("node", name, node);
        }
        for (name, magnet, sensor) in model.levitation.iter().flat_map(|own| &own.magnets) {
            add("", &format!("magnet_{name}"), *magnet);
            add("", &format!("sensor_{name}"), *sensor);
        }
        for (given, disk) in model.disks.iter().zip(&rotor.disks) {
            add("disk", &given.name, disk.node);
        }
        for (given, support) in model.supports.iter().zip(&rotor.supports) {
            if let Place::Node(node) = support.at {
                let word = if support.seal { "seal" } else { "support" };
                add(word, &given.name, node);
            }
        }
        for (given, unbalance) in model.unbalance.iter().zip(&rotor.unbalance) {
            add("unbalance", &given.name, unbalance.node);
        }
        out
    }

    /// Computes everything.
    pub(crate) fn find(&self) -> Result<Analyses, RotorError> {
        let (asked, rotor) = (&self.analysis, self.rotor());
        let followed = asked.frequency_to.max(asked.speed_to);
        let diagram = self.within.campbell(&asked.speeds(), followed)?;
        let criticals = self.within.criticals(&diagram)?;
        let unstable = self.within.unstable(&diagram)?;
        let growing = self.within.growing(asked.speed)?;
        let pulled = |value: Option<C64>| value.is_some_and(|z| z.im.abs() <= 0.1 * z.norm());
        let pulled_over = self.levitated.is_none()
            && self.held
            && (pulled(growing) || pulled(self.within.growing(0.0)?));
        let speeds = match rotor.unbalance.is_empty() {
            true => diagram.speeds.clone(),
            false => refined(&diagram, &criticals),
        };
        let responder = Responder::within(&self.within);
        // where a motion grows there is no steady response
        let grows = |speed: f64| {
            let within = |(from, to): &(f64, f64)| (*from..=*to).contains(&speed);
            unstable.iter().any(within) || (speed == asked.speed && growing.is_some())
        };
        let respond = |speed: f64| match grows(speed) {
            true => None,
            false => responder.unbalance(&rotor.unbalance, speed).ok(),
        };
        let (mut responses, mut deflections, mut peaks) = (Vec::new(), Vec::new(), Vec::new());
        let mut unlisted: Vec<f64> = Vec::new();
        if self.responds() {
            responses = speeds.iter().map(|speed| respond(*speed)).collect();
            let shown = std::iter::once(asked.speed).chain(most_amplified(&criticals));
            deflections = shown.filter_map(respond).collect();
            for watched in self.watched() {
                let curve = Curve {
                    speeds: &speeds,
                    responses: &responses,
                    motion: watched.motion,
                    respond: &respond,
                };
                peaks.push(curve.largest());
                if let Motion::Of(_) = watched.motion {
                    unlisted.extend(curve.unlisted(&criticals));
                }
            }
            unlisted.sort_by(f64::total_cmp);
            unlisted.dedup_by(|a, b| *a - *b <= 1e-3 * *a);
        }
        let (from, to, count) = (asked.map_from, asked.map_to, asked.map_count);
        let stiffnesses: Vec<f64> = (0..count)
            .map(|k| from * (to / from).powf(k as f64 / (count - 1) as f64))
            .collect();
        let map = match self.held {
            true => {
                let standing = levitated::on_springs(&self.model);
                rotor::stiffness_map(&standing, &self.within.basis, &stiffnesses, MAPPED)?
            }
            false => Vec::new(),
        };
        let kept = rotor.kept();
        let modes = self.modes()?;
        let reduced = self.within.basis.len() < self.full.len();
        let error_of_reduction = || -> Result<f64, RotorError> {
            let reference = match self.full.len() {
                few if few <= MEDIUM => self.full.clone(),
                _ => {
                    let cutoff = 3.0 * self.cut;
                    (self.full).for_analysis(
                        rotor,
                        &self.matrices,
                        cutoff,
                        followed.max(self.cut),
                    )?
                }
            };
            let whole = Analysis::new(rotor, &self.matrices, reference);
            // magnets that held the rotor in other coordinates hold it in these
            let whole = levitated::on_magnets(whole, &self.model, self.levitated.as_ref())
                .map_err(|_| RotorError::NotConverged)?;
            let highest = diagram.speeds.len() - 1;
            let followed = whole.error_of(&diagram, highest, asked.frequency_to)?;
            Ok(followed.max(whole.error_of_modes(&modes, asked.speed)?))
        };
        let reduction_error = reduced.then(error_of_reduction);
        let receptance_error = (reduced && !kept.is_empty()).then(|| {
            (self.within.basis).receptance_error(&self.full, &kept, 0.01 * followed, followed)
        });
        let whirl = self
            .whirl
            .iter()
            .flat_map(|own| own.bearings.iter().map(|one| own.find(one)));
        let rolling = self.rolling.as_ref().and_then(|own| own.as_ref().ok());
        Ok(Analyses {
            rolling: rolling.map(|own| own.find().map(Box::new)).transpose()?,
            whirl: whirl.collect::<Result<_, _>>()?,
            sag: match &self.levitated {
                Some(levitated) => Some(Sag {
                    shape: levitated.sag.clone(),
                    loads: rotor::loads(rotor, asked.speed, &levitated.sag),
                }),
                None => (self.held && !pulled_over)
                    .then(|| rotor::sag(rotor, asked.speed, gravity(asked)))
                    .transpose()?,
            },
            reduction_error: reduction_error.transpose()?,
            receptance_error,
            modes,
            growing,
            unstable,
            pulled_over,
            unlisted,
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

/// What is shown of the response.
pub(crate) struct Watched {
    /// Where its results and columns begin.
    pub(crate) name: String,
    pub(crate) motion: Motion,
}

/// A part of a response.
#[derive(Clone, Copy)]
pub(crate) enum Motion {
    /// The displacement of a coordinate, m.
    Of(usize),
    /// The motion across a support, m.
    Across(usize),
    /// The force of a support, N.
    Force(usize),
}

impl Motion {
    /// Half the longer axis of the ellipse.
    pub(crate) fn amplitude(self, response: &Response) -> f64 {
        match self {
            Self::Of(coordinate) => response.amplitude(coordinate),
            Self::Across(support) => response.across[support].map(|z| z.norm()).iter().sum(),
            Self::Force(support) => response.forces[support].map(|z| z.norm()).iter().sum(),
        }
    }

    pub(crate) fn unit(self) -> &'static str {
        match self {
            Self::Force(_) => "N",
            _ => "m",
        }
    }
}

/// The label of a support, or of a housing, for results.
pub(crate) fn support_label(name: &str, support: &rotor::Support) -> String {
    word(
        match support.at {
            Place::Node(_) => "support",
            Place::Housing(_) => "housing",
        },
        name,
    )
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
    let known = criticals.iter();
    let known = known.filter_map(|one| Some((one.amplification()?, one.speed)));
    let mut list: Vec<(f64, f64)> = known.collect();
    list.sort_by(|a, b| b.0.total_cmp(&a.0));
    let most = list.into_iter().take(DEFLECTIONS);
    let mut speeds: Vec<f64> = most.map(|(_, speed)| speed).collect();
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

/// A part of the response over speed.
struct Curve<'a> {
    speeds: &'a [f64],
    responses: &'a [Option<Response>],
    motion: Motion,
    respond: &'a dyn Fn(f64) -> Option<Response>,
}

impl Curve<'_> {
    fn of(&self, one: &Option<Response>) -> f64 {
        one.as_ref().map_or(-1.0, |one| self.motion.amplitude(one))
    }

    /// The largest response.
    fn largest(&self) -> Option<Response> {
        let of = |k: &usize| self.of(&self.responses[*k]);
        let k = (0..self.speeds.len()).max_by(|a, b| of(a).total_cmp(&of(b)))?;
        self.peak(k)
    }

    /// Speeds of peaks narrower than ζ = 0.1 that have no critical speed within their half width.
    fn unlisted(&self, criticals: &[Critical]) -> Vec<f64> {
        let mut out = Vec::new();
        for k in 1..self.speeds.len().saturating_sub(1) {
            let [before, here, after] = [k - 1, k, k + 1].map(|at| self.of(&self.responses[at]));
            if before < 0.0 || after < 0.0 || here <= before || here < after {
                continue;
            }
            // speeds lie within half a width of each critical speed: one between the neighbours is that of the peak
            let near = self.speeds[k - 1]..=self.speeds[k + 1];
            if criticals.iter().any(|one| near.contains(&one.speed)) {
                continue;
            }
            let Some(peak) = self.peak(k) else { continue };
            let power = self.motion.amplitude(&peak) * std::f64::consts::FRAC_1_SQRT_2;
            let at = |speed: f64| self.of(&(self.respond)(speed));
            let beside = [0.9, 1.1].map(|share| at(share * peak.speed));
            let narrow = beside.iter().all(|there| (0.0..power).contains(there));
            let listed = |one: &Critical| {
                let share = (one.speed / peak.speed - 1.0).abs();
                share < 1e-6 || (share < 0.1 && at(one.speed) >= power)
            };
            if narrow && !criticals.iter().any(listed) {
                out.push(peak.speed);
            }
        }
        out
    }

    /// The largest response between the neighbours of a speed by the golden ratio, 40 times, to 1e-8 of their distance.
    fn peak(&self, k: usize) -> Option<Response> {
        let (speeds, of) = (self.speeds, |one: &Option<Response>| self.of(one));
        let mut best = self.responses[k].clone();
        let mut low = speeds[k.saturating_sub(1)];
        let mut high = speeds[(k + 1).min(speeds.len() - 1)];
        let ratio = 0.5 * (5f64.sqrt() - 1.0);
        let mut inner = [high - ratio * (high - low), low + ratio * (high - low)];
        let mut found = inner.map(self.respond);
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
                found[0] = (self.respond)(inner[0]);
            } else {
                (low, inner[0]) = (inner[0], inner[1]);
                inner[1] = low + ratio * (high - low);
                found.swap(0, 1);
                found[1] = (self.respond)(inner[1]);
            }
        }
        best
    }
}

fn no_answer(error: RotorError, key: &str) -> Box<Problem> {
    let needed = "a rotor with mass everywhere is needed";
    problem_at(Code::Impossible, key, error.to_string(), needed)
}
