//! Temperatures of a bearing: named results, columns, and what is too hot.

use crate::result::list::{List, Origin, relative};
use crate::result::outcome::{Value, Warning, warning};
use crate::scenario::{Bearing, Feedback, Warm};
use crate::simulate::bearing::columns::Table;
use crate::simulate::bearing::feedback::{Follows, State};
use crate::simulate::coast_down::build::ICE_POINT;
use crate::simulate::coast_down::warnings::{away, beyond_data, first_loose, loose_ring, to_take};
use model::bearing_heat::{WarmBearing, Warmth, kinds};
use model::system::layout::of_part;
use thermal::bearing_network::{GROUNDS, NODES, PASSES};

/// A bearing whose temperatures were followed.
pub(crate) struct Followed<'a> {
    /// What is given of it.
    pub given: &'a Warm,
    /// It at the start.
    pub bearing: &'a Bearing,
    /// Its network.
    pub part: &'a WarmBearing,
    /// What became of it.
    pub warmth: &'a Warmth,
    /// As which it was made last; none where nothing has moved.
    pub state: Option<State>,
    /// Why it went on without following, and from when on, s.
    pub broken: Option<&'a (f64, String)>,
}

impl<'a> Followed<'a> {
    fn follows(&self) -> Option<Follows> {
        Follows::of(self.given, self.bearing)
    }

    /// Whether its clearance follows.
    fn closes(&self) -> bool {
        (self.follows().iter()).any(|follows| follows.closes(self.bearing))
    }

    /// The nodes that are there: a full complement has no cage.
    fn nodes(&self) -> impl Iterator<Item = (usize, &'static str)> {
        (NODES.into_iter().enumerate()).filter(|(node, _)| self.part.network.has(*node))
    }
}

/// Names the results of a bearing.
pub(crate) fn name(followed: &Followed, list: &mut List) {
    let warmth = followed.warmth;
    for (node, name) in followed.nodes() {
        let (peak, _) = warmth.peaks[node];
        let name = format!("peak_{name}_temperature");
        list.number(&name, "K", Ok(peak + ICE_POINT), &PEAK);
    }
    limits(followed, list);
    let stored_in = followed.part.stored(&warmth.temperatures);
    let stored: f64 = stored_in.iter().sum::<f64>() + warmth.in_films;
    if followed.closes() {
        let at_start = followed.bearing.operating_diametral_clearance;
        let at_end = followed.follows();
        let at_end =
            (at_end.iter()).map(|follows| follows.clearance(&warmth.temperatures, warmth.spin()));
        let least = followed.state.map_or(at_start, |state| state.least);
        let least = at_end.fold(least.min(at_start), f64::min);
        list.number("smallest_clearance", "m", Ok(least), &CLEARANCE);
        let closed = followed.state.and_then(|state| state.closed);
        let why = match at_start < 0.0 {
            true => "the balls are preloaded from the start",
            false => "the bearing stays open",
        };
        list.awaited(
            "closing_time",
            closed.ok_or_else(|| why.to_string()),
            &CLEARANCE,
        );
        let growth = warmth.growth.largest.map(|largest| largest.value);
        let growth = growth.ok_or_else(|| {
            match followed.part.losses {
                Some(_) => "the balls are not preloaded",
                None => "only Palmgren's law says how a preload brakes",
            }
            .to_string()
        });
        list.peak_growth(growth);
    }
    list.number("heat_made", "J", Ok(warmth.made), &HEAT);
    list.number("stored_heat", "J", Ok(stored), &HEAT);
    if warmth.in_films != 0.0 {
        list.number("stored_heat_in_films", "J", Ok(warmth.in_films), &FILMS);
    }
    list.number("heat_to_surroundings", "J", Ok(warmth.given), &HEAT);
    let left = warmth.made - stored - warmth.given;
    list.number(
        "relative_heat_residual",
        "1",
        relative(left.abs(), warmth.made),
        &RESIDUAL,
    );
    let made_in = |node: usize| warmth.flows.iter().map(|kind| kind[node]).sum();
    for (node, _) in followed.nodes() {
        list.node_heats(
            "",
            node,
            [made_in(node), stored_in[node], warmth.given_from[node]],
        );
    }
    list.conductances("", warmth.passes);
    // what this bearing never makes is not listed
    for (kind, flow) in kinds().zip(&warmth.flows) {
        if flow.iter().any(|heat| *heat != 0.0) {
            list.heat_by_node("", kind, flow);
        }
    }
}

/// When nodes passed their limits, and what had to be taken from them to hold those.
fn limits(followed: &Followed, list: &mut List) {
    let warmth = followed.warmth;
    let held = warmth.held.as_deref();
    for (node, name) in followed.nodes() {
        let Some(limit) = followed.part.limits[node] else {
            continue;
        };
        let taken = held.filter(|held| held.taken[node] > 0.0);
        let taken = taken.map(|held| [held.most[node], held.taken[node]]);
        let warmed = Warmed {
            start: followed.part.start,
            peak: warmth.peaks[node].0,
            limit,
        };
        list.limit("", name, &warmed, warmth.passed[node], taken);
    }
    let spans = || held.iter().flat_map(|held| &held.course);
    list.held_times(spans().map(|(time, _)| *time).collect());
    for (node, name) in followed.nodes() {
        if held.is_some_and(|held| held.taken[node] > 0.0) {
            let powers = spans().map(|(_, powers)| powers[node]).collect();
            list.powers_to_take("", name, powers);
        }
    }
}

/// How warm a node with a limit became, °C.
pub(crate) struct Warmed {
    pub start: f64,
    pub peak: f64,
    pub limit: f64,
}

impl List {
    /// Of a node with a limit: how near it comes, and when it passes it, s; the largest power, W, and all the heat, J, to be taken to
    /// hold it.
    pub(crate) fn limit(
        &mut self,
        bearing: &str,
        node: &str,
        warmed: &Warmed,
        passed: Option<f64>,
        taken: Option<[f64; 2]>,
    ) {
        let Warmed { start, peak, limit } = warmed;
        let of = |words: &str| of_part(bearing, &format!("{node}_{words}"));
        let index = (peak - start) / (limit - start);
        self.number(&of("temperature_index"), "1", Ok(index), &NEAR);
        let never = || format!("it stays {:.1} K below its limit", limit - peak);
        let passed = passed.ok_or_else(never);
        let cooled = || "bodies beside it that are held keep it below its limit".to_string();
        let why = passed.clone().err().unwrap_or_else(cooled);
        let part = |which: usize| taken.map(|taken| taken[which]).ok_or_else(|| why.clone());
        self.awaited(&of("limit_time"), passed, &LIMIT);
        self.number(&of("heat_to_take"), "W", part(0), &TAKE);
        self.number(&of("energy_to_take"), "J", part(1), &TAKE);
    }
    /// The largest rate at which a disturbance of the temperatures grows, 1/s.
    pub(crate) fn peak_growth(&mut self, rate: Result<f64, String>) {
        self.number("peak_growth_rate", "1/s", rate, &GROWTH);
    }
    /// The instants of those powers, s.
    pub(crate) fn held_times(&mut self, times: Vec<f64>) {
        self.push("held_times", "s", Value::List(times), &TAKE);
    }
    /// Power that must be taken from a node over these instants, W.
    pub(crate) fn powers_to_take(&mut self, bearing: &str, node: &str, powers: Vec<f64>) {
        let name = of_part(bearing, &format!("{node}_powers_to_take"));
        self.push(&name, "W", Value::List(powers), &TAKE);
    }
    /// Heats made in, kept in and given to the surroundings by a node of a bearing, J.
    pub(crate) fn node_heats(&mut self, bearing: &str, node: usize, [made, kept, given]: [f64; 3]) {
        let mut add = |words: &str, heat: f64| {
            let name = format!("{words}_{}", NODES[node]);
            self.number(&of_part(bearing, &name), "J", Ok(heat), &AT_NODE);
        };
        add("heat_made_in", made);
        add("stored_heat_in", kept);
        if GROUNDS.contains(&node) {
            add("heat_to_surroundings_from", given);
        }
    }
    /// Least and largest conductance of each pass of a network, W/K.
    pub(crate) fn conductances(&mut self, bearing: &str, passes: [[f64; 2]; PASSES.len()]) {
        for (name, both) in PASSES.into_iter().zip(passes) {
            let name = of_part(bearing, &format!("{name}_conductances"));
            self.push(&name, "W/K", Value::List(both.to_vec()), &PASSED);
        }
    }
    /// Heat of a kind over the nodes, J.
    pub(crate) fn heat_by_node(&mut self, bearing: &str, kind: &str, flow: &[f64]) {
        let name = of_part(bearing, &format!("{kind}_heat_by_node"));
        self.push(&name, "J", Value::List(flow.to_vec()), &BY_NODE);
    }
}

/// Names the work of rings that close on their balls, J.
pub(crate) fn work_of_rings(work: f64, list: &mut List) {
    list.number("work_of_warm_rings", "J", Ok(work), &RINGS);
}

/// Temperatures over time.
pub(crate) fn columns<'a>(followed: &Followed<'a>, table: &mut Table<'a>) {
    let (part, warmth) = (followed.part, followed.warmth);
    for (node, name) in followed.nodes() {
        let words = name.replace('_', " ");
        table.add(
            &format!("{name}.temperature"),
            "K",
            &format!("temperature of the {words}, of one temperature throughout"),
            move |row| warmth.at(part, node, row.time) + ICE_POINT,
        );
    }
    let nodes_at = move |time: f64| -> Vec<f64> {
        let nodes = 0..NODES.len();
        nodes.map(|node| warmth.at(part, node, time)).collect()
    };
    let bearing = followed.bearing;
    let tilts = (followed.follows()).filter(|follows| follows.tilts(bearing));
    if let Some(follows) = tilts {
        table.add(
            "bearing.contact_angle",
            "rad",
            "contact angle of a pair that springs press",
            move |row| follows.contact_angle(bearing, &nodes_at(row.time)),
        );
    }
    if let (true, Some(follows)) = (followed.closes(), followed.follows()) {
        let run = table.run;
        table.add(
            "bearing.clearance",
            "m",
            "diametral clearance; negative is preload",
            move |row| follows.clearance(&nodes_at(row.time), run.speed(row)),
        );
        if warmth.growth.largest.is_some() {
            table.add(
                "heat.growth_rate",
                "1/s",
                "rate at which a disturbance of the temperatures grows while the balls are preloaded; above 0 they run away",
                move |row| warmth.growth.at(row.time),
            );
        }
    }
}

/// What became hotter than it may, closed, or does not follow.
pub(crate) fn judged(followed: &Followed) -> Vec<(f64, Warning)> {
    let mut list: Vec<(f64, Warning)> = too_hot(followed).into_iter().collect();
    list.extend(runs_away(followed).or_else(|| closed(followed)));
    list.extend(loose(followed));
    list.extend(not_followed(followed).map(|warning| (0.0, warning)));
    let oil = followed.part.oil.zip(followed.warmth.beyond_data);
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
    let changes = followed.follows()?.changes(&nodes);
    Some((largest.value, away([first, largest], growth.calm, changes)))
}

/// A clearance that closes.
fn closed(followed: &Followed) -> Option<(f64, Warning)> {
    let State { least, closed, .. } = followed.state?;
    let text = format!(
        "The clearance closes after {:.3} s: rings that warm unequally press on the balls, by {:.1} µm at most. The difference of the rings' \
         temperatures is known within a factor of two; so is the clearance that is needed.",
        closed?,
        -1e6 * least
    );
    Some((-least, warning("AB2312", text)))
}

/// A ring that loses its fit.
fn loose(followed: &Followed) -> Option<(f64, Warning)> {
    let of_clearance = followed.state.map_or([None; 2], |state| state.loose);
    let times = [0, 1].map(|seat| of_clearance[seat].or(followed.warmth.loose[seat]));
    let (time, seat) = first_loose(times)?;
    let when = format!("{time:.3} s");
    Some((1.0 / (1.0 + time), loose_ring(&when, seat)))
}

/// What of a bearing does not follow its temperatures, though it is asked to.
fn not_followed(followed: &Followed) -> Option<Warning> {
    let feedback = followed.given.heat.feedback;
    let text = match followed.broken {
        Some((time, why)) => format!(
            "From {time:.3} s on nothing of the bearing follows its temperatures, since no law holds there: {why}."
        ),
        None if feedback == Feedback::Full && !followed.closes() => "The contact angle follows the temperatures, and the preload does not: it \
             is that of springs. A rigid one rises as the inner ring warms."
            .to_string(),
        None if feedback != Feedback::None
            && !(followed.follows().iter()).any(|follows| follows.thins(followed.bearing)) =>
        {
            "No friction of the bearing follows the temperature of its lubricant: bearing.moment.viscosity_points, two temperatures with their \
             viscosities, are not given, or its law knows no viscosity."
                .to_string()
        }
        None => return None,
    };
    Some(warning("AB2320", text))
}

fn too_hot(followed: &Followed) -> Option<(f64, Warning)> {
    let hottest = followed.nodes().filter_map(|(node, name)| {
        let (peak, time) = followed.warmth.peaks[node];
        let above = peak - followed.part.limits[node]?;
        (above > 0.0).then_some((above, name, peak, time))
    });
    let hottest = hottest.max_by(|a, b| a.0.total_cmp(&b.0));
    let told = |(above, name, peak, time): (f64, &str, f64, f64)| {
        let held = followed.warmth.held.as_deref();
        let taken =
            held.map(|held| to_take("this bearing", held.most_of_all, held.taken.iter().sum()));
        let text = format!(
            "Too hot: {} at {peak:.0} °C after {time:.2} s, {above:.0} K above its limit, and warmer still where the heat comes in. \
             Hardness, cage and lubricant may change there; this run does not follow that.{}",
            name.replace('_', " "),
            taken.unwrap_or_default()
        );
        (above, warning("AB2310", text))
    };
    hottest.map(told)
}

const PEAK: Origin = Origin {
    law: "C Ṫ = P + Σ G (T_other − T), P the heats of the ledger over the nodes",
    source: "crates/model/src/bearing_heat.rs, crates/thermal/src/bearing_network.rs; book/src/theory/heat.md",
    valid: "bodies of one temperature: from about 0.1 s on; in whirl and first contact the surfaces are hotter. Conductances within a \
            factor of two. What of the motion follows: heat.feedback",
};
const LIMIT: Origin = Origin {
    law: "first time at which the node is above heat.race_limit, heat.cage_limit or heat.lubricant_limit",
    source: "makers' catalogues",
    valid: "as the temperatures",
};
const NEAR: Origin = Origin {
    law: "(T_peak − T_start)/(T_limit − T_start) of the node, T_start = heat.start_temperature",
    source: "makers' catalogues",
    valid: "1 is the limit; bodies of one temperature each, whose rises are right within a factor of two where conductances were not given",
};
const TAKE: Origin = Origin {
    law: "every node stays at its limit once it is there: largest power that must be taken from it for that, all other heats into it, and the \
          sum. By the heats of this run, or by a second run-out",
    source: "crates/thermal/src/held.rs; book/src/theory/heat.md",
    valid: "cooling that acts on the node itself, of which friction and clearance know nothing in a run ball by ball; as heat_made of one bearing, \
            of a run-out all bearings together",
};
const GROWTH: Origin = Origin {
    law: "largest real part of the eigenvalues of C⁻¹(∂P/∂T − G − (∂G/∂T) T); above 0 a disturbance grows, 1/it is the time",
    source: "crates/thermal/src/steady_speed.rs; book/src/theory/heat.md",
    valid: "the speed of that instant held, under the weight; ball by ball only of balls that are preloaded. A whirl presses them harder, and its rate is larger",
};
const RINGS: Origin = Origin {
    law: "change of the elastic energy of balls and rings when their clearance follows the temperatures",
    source: "content of the ledger before and after, crates/auxbear/src/simulate/bearing/feedback.rs",
    valid: "a source of the ledger; the heat that expands the rings is not made smaller by it",
};
const CLEARANCE: Origin = Origin {
    law: "P_d = P_d0 + α_o d_o ΔT_o − α_i d_i ΔT_i − 2 α_b D ΔT_b",
    source: "crates/thermal/src/clearance.rs, crates/auxbear/src/simulate/bearing/feedback.rs; book/src/theory/heat.md",
    valid: "rings free to grow, each of one temperature: from about 0.1 s on",
};
const HEAT: Origin = Origin {
    law: "heats of the ledger that reach the bearing, rotor and housing; C ΔT of all nodes, with what contact films keep; ∫G (T − T_ambient) dt",
    source: "crates/model/src/bearing_heat.rs",
    valid: "of one of equal bearings",
};
const FILMS: Origin = Origin {
    law: "C Θ of the contact films: what of their heat balls and races have not received yet; a part of stored_heat",
    source: "crates/model/src/bearing/lubricant_state.rs, crates/model/src/bearing_heat.rs; book/src/theory/heat.md",
    valid: "as heat_made",
};
const AT_NODE: Origin = Origin {
    law: "heat that losses make in the body; C ΔT; ∫G (T − T_ambient) dt. Made − stored − given is what it has passed on to other bodies",
    source: "crates/model/src/bearing_heat.rs, crates/thermal/src/network.rs; book/src/theory/heat.md",
    valid: "as heat_made, or all bearings together where the run-out says so; below 0 heat came from where it else goes",
};
const PASSED: Origin = Origin {
    law: "least and largest conductance of the way: as given, or a rough line, gas between surfaces and in the open, radiation",
    source: "crates/thermal/src/passage.rs, crates/physics/src/air.rs; book/src/theory/heat.md",
    valid: "at the ends of spans or steps, by the mean force of the rotor on the race in them; within a factor of two",
};
const BY_NODE: Origin = Origin {
    law: "heat of one loss of the ledger in rotor, inner race, balls, cage, lubricant, outer race, housing, rotor core and mount, in this order",
    source: "shares of crates/model/src/bearing_heat.rs; book/src/theory/heat.md",
    valid: "as heat_made: of each loss the sum is the ledger's, less what contact films keep of it, the shares are constants or follow the state",
};
const RESIDUAL: Origin = Origin {
    law: "|heat made − stored − given away| over the heat made",
    source: "energy balance",
    valid: "rounding",
};
