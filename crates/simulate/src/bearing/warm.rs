//! Temperatures of a bearing: named results, columns, and what is too hot.

use crate::bearing::columns::Table;
use crate::bearing::feedback::{Follows, State};
use crate::bearing::warning_table::HeatWarning;
use crate::coast_down::build::ICE_POINT;
use crate::coast_down::warnings::{away, beyond_data, first_loose, loose_ring, to_take};
use model::bearing_heat::{OfNodes, WarmBearing, Warmth, kinds};
use outcome::Warning;
use outcome::columns::columns;
use outcome::list::results;
use outcome::list::{List, origins, relative};
use scenario::{Bearing, Feedback, Warm};
use thermal::bearing_network::{GROUNDS, NODES, PASSES};

/// A bearing whose temperatures are followed, before a run.
#[derive(Clone, Copy)]
pub(crate) struct Heated<'a> {
    /// What is given of it.
    pub given: &'a Warm,
    /// It at the start.
    pub bearing: &'a Bearing,
    /// Its network.
    pub part: &'a WarmBearing,
}

impl<'a> Heated<'a> {
    /// None where its temperatures are not followed.
    pub fn of(
        given: Option<&'a Warm>,
        bearing: &'a Bearing,
        part: Option<&'a WarmBearing>,
    ) -> Option<Self> {
        Some(Heated {
            given: given?,
            bearing,
            part: part?,
        })
    }
    fn follows(&self) -> Option<Follows> {
        Follows::of(self.given, self.bearing)
    }
    /// Whether its clearance follows.
    fn closes(&self) -> bool {
        (self.follows().iter()).any(|follows| follows.closes(self.bearing))
    }
    /// Whether springs keep its preload as its angle follows.
    fn tilts(&self) -> bool {
        (self.follows().iter()).any(|follows| follows.tilts(self.bearing))
    }
    /// Whether its rows press on each other by a distance.
    pub fn presses(&self) -> bool {
        (self.follows().iter())
            .any(|follows| follows.swells(self.bearing) && self.bearing.axial_preload > 0.0)
    }
    /// Smallest and largest preload at rest of rows that press on each other by a distance, N, over temperatures of their nodes, °C.
    pub fn preloads<'b>(&self, nodes: impl Iterator<Item = &'b [f64]>) -> Option<[f64; 2]> {
        let follows = self.follows().filter(|_| self.presses())?;
        let each = nodes.filter_map(|nodes| follows.preload(nodes));
        let none = [f64::INFINITY, f64::NEG_INFINITY];
        Some(each.fold(none, |[least, most], now| [least.min(now), most.max(now)]))
    }
    /// Whether contact films keep heat.
    fn has_films(&self) -> bool {
        let state = self.bearing.lubricant_state.as_ref();
        state.is_some_and(|state| state.films.is_some())
    }
    /// The nodes that are there: a full complement has no cage.
    fn nodes(&self) -> impl Iterator<Item = (usize, &'static str)> {
        (NODES.into_iter().enumerate()).filter(|(node, _)| self.part.network.has(*node))
    }
}

/// A bearing whose temperatures were followed.
pub(crate) struct Followed<'a> {
    /// It before the run.
    pub heated: Heated<'a>,
    /// What became of it.
    pub warmth: &'a Warmth,
    /// As which it was made last; none where nothing has moved.
    pub state: Option<State>,
    /// Why it went on without following, and from when on, s.
    pub broken: Option<&'a (f64, String)>,
}

impl Followed<'_> {
    /// Smallest diametral clearance, m.
    fn smallest_clearance(&self) -> f64 {
        let at_start = self.heated.bearing.operating_diametral_clearance;
        let (nodes, speed) = (&self.warmth.temperatures, self.warmth.spin());
        let follows = self.heated.follows();
        let at_end = follows.map(|follows| follows.clearance(nodes, speed));
        let least = self.state.map_or(at_start, |state| state.least);
        at_end.into_iter().fold(least.min(at_start), f64::min)
    }
    /// Smallest and largest preload at rest of a pair in space, N.
    fn preload(&self) -> [f64; 2] {
        let at_start = [self.heated.bearing.axial_preload; 2];
        let follows = self.heated.follows();
        let at_end = follows.and_then(|follows| follows.preload(&self.warmth.temperatures));
        let [least, most] = (self.state.and_then(|state| state.preload)).unwrap_or(at_start);
        let all = [at_start[0], at_end.unwrap_or(least)];
        [
            all.into_iter().fold(least, f64::min),
            all.into_iter().fold(most, f64::max),
        ]
    }
    /// When the clearance closed, s.
    fn closing_time(&self) -> Result<f64, String> {
        let why = match self.heated.bearing.operating_diametral_clearance < 0.0 {
            true => "the balls are preloaded from the start",
            false => "the bearing stays open",
        };
        (self.state.and_then(|state| state.closed)).ok_or_else(|| why.to_string())
    }
    /// The largest rate at which a disturbance of the temperatures grows, 1/s.
    fn peak_growth(&self) -> Result<f64, String> {
        let why = match self.heated.part.losses {
            Some(_) => "the balls are not preloaded",
            None => "only Palmgren's law says how a preload brakes",
        };
        let largest = self.warmth.growth.largest.map(|largest| largest.value);
        largest.ok_or_else(|| why.to_string())
    }
    /// Heat that the bodies and the contact films keep, J.
    fn stored(&self) -> f64 {
        let bodies = self.heated.part.stored(&self.warmth.temperatures);
        bodies.iter().sum::<f64>() + self.warmth.in_films
    }
    /// Heat made and not found again, over the heat made.
    fn residual(&self) -> Result<f64, String> {
        let left = self.warmth.made - self.stored() - self.warmth.given;
        relative(left.abs(), self.warmth.made)
    }
    /// Heats made in, kept in and given to the surroundings by a node, J.
    fn heats(&self, node: usize) -> [f64; 3] {
        let made = self.warmth.flows.iter().map(|kind| kind[node]).sum();
        let kept = self.heated.part.stored(&self.warmth.temperatures)[node];
        [made, kept, self.warmth.given_from[node]]
    }
    /// What the bearing made over the nodes, by kinds, J: those of which it made any.
    fn flows(&self) -> Vec<(&'static str, Vec<f64>)> {
        let all = kinds().zip(&self.warmth.flows);
        let made = all.filter(|(_, flow)| flow.iter().any(|heat| *heat != 0.0));
        made.map(|(kind, flow)| (kind, flow.to_vec())).collect()
    }
    /// Of a node with a limit, °C.
    fn limited(&self, node: usize, limit: f64) -> Limited {
        let held = self.warmth.held.as_deref();
        let held = held.filter(|held| held.taken[node] > 0.0);
        Limited {
            start: self.heated.part.start,
            peak: self.warmth.peaks[node].0,
            limit,
            passed: self.warmth.passed[node],
            taken: held.map(|held| [held.most[node], held.taken[node]]),
        }
    }
    /// Ends of the spans in which nodes are held, s, and the powers that are taken from each then, W.
    fn held_course(&self) -> &[(f64, OfNodes)] {
        self.warmth.held.as_ref().map_or(&[], |held| &held.course)
    }
    /// Powers to take over these spans from nodes that must be held, W.
    fn powers_to_take(&self) -> Vec<(&'static str, Vec<f64>)> {
        let held = self.warmth.held.as_deref();
        let nodes = self.heated.nodes();
        let needy = nodes.filter(|(node, _)| held.is_some_and(|held| held.taken[*node] > 0.0));
        let course = self.held_course().iter();
        let powers = |node: usize| course.clone().map(|(_, all)| all[node]).collect();
        needy.map(|(node, name)| (name, powers(node))).collect()
    }
}

/// Names the results of a bearing.
pub(crate) fn name(list: &mut List, setup: &Heated, run: Option<&Followed>) {
    for (node, name) in setup.nodes() {
        let peak = run.map(|run| run.warmth.peaks[node].0 + ICE_POINT);
        list.named(&[name], |list| peaks(list, &(), peak.as_ref()));
    }
    for (node, name) in setup.nodes() {
        if let Some(at) = setup.part.limits[node] {
            let limited = run.map(|run| run.limited(node, at));
            list.named(&[name], |list| limit(list, &(), limited.as_ref()));
        }
    }
    let times = run.map(|run| run.held_course().iter().map(|(time, _)| *time).collect());
    held_times(list, &(), times.as_ref());
    list.each_found(run.map(Followed::powers_to_take), powers_to_take);
    totals(list, setup, run);
    for (node, name) in setup.nodes() {
        let heats = run.map(|run| run.heats(node));
        list.named(&[name], |list| node_heats(list, &node, heats.as_ref()));
    }
    conductances(list, run.map(|run| run.warmth.passes));
    list.each_found(run.map(Followed::flows), heat_by_node);
}

/// A node with a limit, °C.
pub(crate) struct Limited {
    pub start: f64,
    pub peak: f64,
    pub limit: f64,
    /// When it passes the limit, s.
    pub passed: Option<f64>,
    /// The largest power, W, and all the heat, J, to be taken to hold it.
    pub taken: Option<[f64; 2]>,
}

impl Limited {
    fn passed(&self) -> Result<f64, String> {
        let left = self.limit - self.peak;
        (self.passed).ok_or_else(|| format!("it stays {left:.1} K below its limit"))
    }
    fn to_take(&self, which: usize) -> Result<f64, String> {
        let cooled = || "bodies beside it that are held keep it below its limit".to_string();
        let taken = self.taken.map(|taken| taken[which]);
        taken.ok_or_else(|| self.passed().err().unwrap_or_else(cooled))
    }
}

results! {
    fn peaks(setup: &(), peak: &f64) {
        "peak_*_temperature": number "K", PEAK, "highest temperature of this body" => *peak;
    }
    /// How near a node comes to its limit, and what holds it there.
    pub(crate) fn limit(setup: &(), run: &Limited) {
        "*_temperature_index": number "1", NEAR, "rise over that of the limit" in worst "* too hot" => (run.peak - run.start) / (run.limit - run.start);
        "*_limit_time": instant "s" headline, LIMIT, "first time above the limit" in instants "* at its limit" => run.passed();
        "*_heat_to_take": number "W" headline, TAKE, "largest power to be taken to hold the limit" => run.to_take(0);
        "*_energy_to_take": number "J", TAKE, "heat to be taken to hold the limit" => run.to_take(1);
    }
    /// Instants of the powers that are taken from held nodes.
    pub(crate) fn held_times(setup: &(), times: &Vec<f64>) {
        "held_times": list "s", TAKE, "instants of the powers to take" in held "time" => times.clone();
    }
    /// Power that is taken from a held node.
    pub(crate) fn powers_to_take(setup: &(), powers: &Vec<f64>) {
        "*_powers_to_take": list "W", TAKE, "power to be taken to hold the limit, over held_times" => powers.clone();
    }
    fn totals(setup: &Heated, run: &Followed) {
        "smallest_clearance": number "m", CLEARANCE, "smallest diametral clearance" when setup.closes() => run.smallest_clearance();
        "closing_time": instant "s", CLEARANCE, "first time without clearance" in instants "clearance closed" when setup.closes() => run.closing_time();
        "smallest_preload": number "N", PRELOAD, "smallest preload at rest that the temperatures leave" when setup.presses() => run.preload()[0];
        "largest_preload": number "N", PRELOAD, "largest preload at rest that the temperatures give" when setup.presses() => run.preload()[1];
        "peak_growth_rate": number "1/s", GROWTH, "largest growth rate of a disturbance of the temperatures" when setup.closes() => run.peak_growth();
        "heat_made": number "J", HEAT, "heat that losses make" => run.warmth.made;
        "stored_heat": number "J", HEAT, "heat stored in all bodies" in heat_balance "stored" => run.stored();
        "stored_heat_in_films": number "J", FILMS, "part of it in the contact films" when setup.has_films() => run.warmth.in_films;
        "heat_to_surroundings": number "J", HEAT, "heat given to the surroundings" in heat_balance "to the surroundings" => run.warmth.given;
        "relative_heat_residual": number "1", RESIDUAL, "residual of the heat balance over the heat made" => run.residual();
    }
    /// Heats made in, kept in and given to the surroundings by a node, J.
    pub(crate) fn node_heats(node: &usize, run: &[f64; 3]) {
        "heat_made_in_*": number "J", AT_NODE, "heat that losses make in this body" => run[0];
        "stored_heat_in_*": number "J", AT_NODE, "heat stored in this body" => run[1];
        "heat_to_surroundings_from_*": number "J", AT_NODE, "heat that this body gives to the surroundings" when GROUNDS.contains(node) => run[2];
    }
}

/// Least and largest conductance of each pass of a network, W/K.
pub(crate) fn conductances(list: &mut List, passes: Option<[[f64; 2]; PASSES.len()]>) {
    for (k, name) in PASSES.into_iter().enumerate() {
        let both = passes.map(|passes| passes[k]);
        list.named(&[name], |list| conductance(list, &(), both.as_ref()));
    }
}

results! {
    fn conductance(setup: &(), both: &[f64; 2]) {
        "*_conductances": list "W/K", PASSED, "least and largest conductance of this path" => both.to_vec();
    }
    /// Heat of one loss.
    pub(crate) fn heat_by_node(setup: &(), flow: &Vec<f64>) {
        "*_heat_by_node": list "J", BY_NODE, "heat of this loss in each body" => flow.clone();
    }
    /// Work of rings that close on their balls.
    pub(crate) fn work_of_rings(setup: &(), work: &f64) {
        "work_of_warm_rings": number "J", RINGS, "work of rings that close on loaded balls" in sources "work of warm rings" => *work;
    }
}

/// Temperatures over time of a bearing where they are followed; without a run they are not known yet.
pub(crate) fn columns<'a>(
    heated: Option<Heated<'a>>,
    warmth: Option<&'a Warmth>,
    table: &mut Table<'a>,
) {
    let Some(heated) = heated else { return };
    let (part, bearing, run) = (heated.part, heated.bearing, table.run);
    let at = |node, time| warmth.map_or(f64::NAN, |warmth| warmth.at(part, node, time));
    for (node, name) in heated.nodes() {
        let words = name.replace('_', " ");
        columns! { table.columns, |row|
            "{name}.temperature": "K", "temperature of the {words}, of one temperature throughout" => at(node, row.time) + ICE_POINT;
        }
    }
    let Some(follows) = heated.follows() else {
        return;
    };
    let nodes_at =
        |time: f64| -> Vec<f64> { (0..NODES.len()).map(|node| at(node, time)).collect() };
    columns! { table.columns, |row|
        "bearing.contact_angle": "rad", "contact angle of a pair that springs press" when follows.tilts(bearing)
            => follows.contact_angle(bearing, &nodes_at(row.time));
        "bearing.clearance": "m", "diametral clearance; negative is preload" when heated.closes()
            => follows.clearance(&nodes_at(row.time), run.speed(row));
        "bearing.preload": "N", "preload at rest of both rows at these temperatures" when heated.presses()
            => follows.preload(&nodes_at(row.time)).unwrap_or(f64::NAN);
    }
    if heated.closes() && part.losses.is_some() {
        let there = warmth.map(|warmth| warmth.growth.largest.is_some());
        table.columns.optional(there, |columns| {
            columns! { columns, |row|
                "heat.growth_rate": "1/s", "rate at which a disturbance of the temperatures grows while the balls are preloaded; above 0 they run away"
                    => warmth.map_or(f64::NAN, |warmth| warmth.growth.at(row.time));
            }
        });
    }
}

/// What became hotter than it may, closed, or does not follow.
pub(crate) fn judged(followed: &Followed) -> Vec<(f64, Warning)> {
    let mut list: Vec<(f64, Warning)> = too_hot(followed).into_iter().collect();
    list.extend(runs_away(followed).or_else(|| closed(followed)));
    list.extend(preload(followed));
    list.extend(loose(followed));
    list.extend(not_followed(followed).map(|warning| (0.0, warning)));
    let oil = followed.heated.part.oil.zip(followed.warmth.beyond_data);
    list.extend(oil.map(|(oil, found)| {
        let error = oil.error_at(found.farthest + ICE_POINT);
        (error, beyond_data(&oil, &found))
    }));
    list
}

/// A bearing that its own warmth closes further and further.
fn runs_away(followed: &Followed) -> Option<(f64, Warning)> {
    let growth = &followed.warmth.growth;
    let ((first, nodes), largest) = (growth.runs_away?, growth.largest?);
    let changes = followed.heated.follows()?.changes(&nodes);
    Some((largest.value, away([first, largest], growth.calm, changes)))
}

/// A clearance that closes.
fn closed(followed: &Followed) -> Option<(f64, Warning)> {
    let State { least, closed, .. } = followed.state?;
    let (time, closed) = (closed?, -least);
    Some((closed, HeatWarning::Closes { time, closed }.into()))
}

/// A preload that unequal temperatures change by more than a fifth.
fn preload(followed: &Followed) -> Option<(f64, Warning)> {
    if !followed.heated.presses() {
        return None;
    }
    let (mounted, [least, most]) = (followed.heated.bearing.axial_preload, followed.preload());
    let change = (most / mounted).max(mounted / least.max(f64::MIN_POSITIVE));
    let warning = HeatWarning::PreloadChanges {
        mounted,
        least,
        most,
    };
    (change > 1.2).then(|| (change, warning.into()))
}

/// A ring that loses its fit.
fn loose(followed: &Followed) -> Option<(f64, Warning)> {
    let of_clearance = followed.state.map_or([None; 2], |state| state.loose);
    let times = [0, 1].map(|seat| of_clearance[seat].or(followed.warmth.loose[seat]));
    let (time, seat) = first_loose(times)?;
    let when = format!("{time:.3} s");
    Some((1.0 / (1.0 + time), loose_ring(time, when, seat)))
}

/// What of a bearing does not follow its temperatures, though it is asked to.
fn not_followed(followed: &Followed) -> Option<Warning> {
    let feedback = followed.heated.given.heat.feedback;
    let warning = match followed.broken {
        Some((time, why)) => {
            let (time, why) = (*time, why.clone());
            HeatWarning::FollowsNoMore { time, why }
        }
        None if followed.heated.tilts() => HeatWarning::PreloadOfSprings,
        None if feedback != Feedback::None
            && !(followed.heated.follows().iter())
                .any(|follows| follows.thins(followed.heated.bearing)) =>
        {
            HeatWarning::FrictionStaysAlike
        }
        None => return None,
    };
    Some(warning.into())
}

fn too_hot(followed: &Followed) -> Option<(f64, Warning)> {
    let hottest = followed.heated.nodes().filter_map(|(node, name)| {
        let (peak, time) = followed.warmth.peaks[node];
        let above = peak - followed.heated.part.limits[node]?;
        (above > 0.0).then_some((above, name, peak, time))
    });
    let hottest = hottest.max_by(|a, b| a.0.total_cmp(&b.0));
    let told = |(above, name, peak, time): (f64, &str, f64, f64)| {
        let held = followed.warmth.held.as_deref();
        let taken =
            held.map(|held| to_take("this bearing", held.most_of_all, held.taken.iter().sum()));
        let warning = HeatWarning::TooHot {
            node: name.to_string(),
            peak: peak + ICE_POINT,
            time,
            above,
            taken: taken.unwrap_or_default(),
        };
        (above, warning.into())
    };
    hottest.map(told)
}

origins! {
    PEAK: law "C Ṫ = P + Σ G (T_other − T), P the heats of the ledger over the nodes",
        source "crates/model/src/bearing_heat.rs, crates/thermal/src/bearing_network.rs; book/src/theory/heat.md",
        valid "bodies of one temperature: from about 0.1 s on; in whirl and first contact the surfaces are hotter. Conductances within a \
            factor of two. What of the motion follows: heat.feedback";
    LIMIT: law "first time at which the node is above heat.race_limit, heat.cage_limit or heat.lubricant_limit",
        source "makers' catalogues",
        valid "as the temperatures";
    NEAR: law "(T_peak − T_start)/(T_limit − T_start) of the node, T_start = heat.start_temperature",
        source "makers' catalogues",
        valid "1 is the limit; bodies of one temperature each, whose rises are right within a factor of two where conductances were not given";
    TAKE: law "every node stays at its limit once it is there: largest power that must be taken from it for that, all other heats into it, and the \
          sum. By the heats of this run, or by a second coast-down",
        source "crates/thermal/src/held.rs; book/src/theory/heat.md",
        valid "cooling that acts on the node itself, of which friction and clearance know nothing in a run ball by ball; as heat_made of one bearing, \
            of a coast-down all bearings together";
    pub(crate) GROWTH: law "largest real part of the eigenvalues of C⁻¹(∂P/∂T − G − (∂G/∂T) T); above 0 a disturbance grows, 1/it is the time",
        source "crates/thermal/src/steady_speed.rs; book/src/theory/heat.md",
        valid "the speed of that instant held, under the weight; ball by ball only of balls that are preloaded. A whirl presses them harder, and its rate is larger";
    pub(crate) RINGS: law "change of the elastic energy of balls and rings when their clearance follows the temperatures",
        source "content of the ledger before and after, crates/simulate/src/bearing/feedback.rs",
        valid "a source of the ledger; the heat that expands the rings is not made smaller by it";
    CLEARANCE: law "P_d = P_d0 + α_o d_o ΔT_o − α_i d_i ΔT_i − 2 α_b D ΔT_b",
        source "crates/thermal/src/clearance.rs, crates/simulate/src/bearing/feedback.rs; book/src/theory/heat.md",
        valid "rings free to grow, each of one temperature: from about 0.1 s on";
    PRELOAD: law "thrust of a row between concentric rings at rest: N K δ^1.5 sin α of grooves and balls that have grown by α ΔT about their own \
          centres",
        source "crates/model/src/spatial/ball.rs, crates/simulate/src/bearing/feedback.rs; book/src/theory/spatial.md",
        valid "rings and spacers free to grow, each of one temperature: from about 0.1 s on; what turns and carries presses otherwise";
    HEAT: law "heats of the ledger that reach the bearing, rotor and housing; C ΔT of all nodes, with what contact films keep; ∫G (T − T_ambient) dt",
        source "crates/model/src/bearing_heat.rs",
        valid "of one of equal bearings";
    FILMS: law "C Θ of the contact films: what of their heat balls and races have not received yet; a part of stored_heat",
        source "crates/model/src/bearing/lubricant_state.rs, crates/model/src/bearing_heat.rs; book/src/theory/heat.md",
        valid "as heat_made";
    AT_NODE: law "heat that losses make in the body; C ΔT; ∫G (T − T_ambient) dt. Made − stored − given is what it has passed on to other bodies",
        source "crates/model/src/bearing_heat.rs, crates/thermal/src/network.rs; book/src/theory/heat.md",
        valid "as heat_made, or all bearings together where the coast-down says so; below 0 heat came from where it else goes";
    PASSED: law "least and largest conductance of the way: as given, or a rough line, gas between surfaces and in the open, radiation",
        source "crates/thermal/src/passage.rs, crates/physics/src/air.rs; book/src/theory/heat.md",
        valid "at the ends of spans or steps, by the mean force of the rotor on the race in them; within a factor of two";
    BY_NODE: law "heat of one loss of the ledger in rotor, inner race, balls, cage, lubricant, outer race, housing, rotor core and mount, in this order",
        source "shares of crates/model/src/bearing_heat.rs; book/src/theory/heat.md",
        valid "as heat_made: of each loss the sum is the ledger's, less what contact films keep of it, the shares are constants or follow the state";
    RESIDUAL: law "|heat made − stored − given away| over the heat made",
        source "energy balance",
        valid "rounding";
}
