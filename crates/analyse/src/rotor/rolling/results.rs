//! The named results of a rotor that rolls on its auxiliary bearings, and what they warn of.

use super::{BearingFound, Peak, RollingBearing, RollingFound, RollingModel};
use crate::rotor::quantities;
use crate::rotor::warnings::RotorWarning;
use outcome::Warning;
use outcome::list::{List, origins, results};
use units::number_text;

/// What begins the names of its results and columns.
pub(crate) const ON: &str = "on_auxiliary_bearings";

/// Names the results; without a second argument those of any such analysis.
pub(crate) fn name(list: &mut List, model: &RollingModel, found: Option<&RollingFound>) {
    list.of_part(ON, |list| {
        for (k, bearing) in model.bearings.iter().enumerate() {
            let own = found.map(|own| &own.bearings[k]);
            let label = bearing.constants.label();
            list.named(&[&label], |list| rolling_bearing(list, bearing, own));
        }
        distances(list, model, found);
        for (k, (name, ..)) in model.places().enumerate() {
            let own = found.map(|own| &own.distances[k]);
            list.named(&[name], |list| distance(list, &(), own));
        }
        let first = list.quantities.len();
        quantities::on_supports(list, &model.asked, found.map(|own| &own.found), false);
        for quantity in &mut list.quantities[first..] {
            // of the rest there is a summary
            quantity.headline &= quantity.name.contains("critical") && quantity.unit == "rad/s";
        }
    });
}

results! {
    fn rolling_bearing(bearing: &RollingBearing, run: &BearingFound) {
        "*.static_load": number "N" headline, REST, "weight of the rotor on one row while it rests in the bearing" in rolling_bearings "static load" => bearing.springs.load;
        "*.contact_stiffness": number "N/m", CONTACT, "stiffness of the contact about the static load" in rolling_bearings "contact stiffness" => bearing.springs.contact;
        "*.ball_stiffness": number "N/m", BALLS, "stiffness of the balls about the static load" in rolling_bearings "ball stiffness" => bearing.springs.balls.ok_or_else(|| "no load goes through balls".to_string());
        "*.stiffness_along": number "N/m", ALONG, "stiffness along the weight of contact, balls and mount in series at rest" in rolling_bearings "stiffness along the weight" => bearing.springs.along;
        "*.tilt_stiffness": number "N m/rad", TILT, "stiffness against tilt along the weight of both edges of the landing surface, balls and mount in series at the rated speed" in rolling_bearings "stiffness against tilt" when bearing.tilt().is_some() => bearing.tilt().ok_or_else(String::new);
        "*.stiffness_across": number "N/m", ACROSS, "stiffness across the weight of the rotor that rolls as a pendulum" in rolling_bearings "stiffness across it" => bearing.springs.across;
        "*.largest_force": number "N" headline, FORCE, "largest amplitude of the contact force along the weight during the coast-down, of one row" in rolling_bearings "largest force" => value(&run.largest[0]);
        "*.largest_force_speed": number "rad/s", FORCE, "speed at which it is largest" in rolling_bearings "at" => speed(&run.largest[0]);
        "*.largest_swing": number "m", FORCE, "largest amplitude across the weight during the coast-down" in rolling_bearings "largest amplitude across" => value(&run.largest[1]);
        "*.largest_swing_speed": number "rad/s", FORCE, "speed at which it is largest" in rolling_bearings "at" => speed(&run.largest[1]);
    }

    fn distances(model: &RollingModel, run: &RollingFound) {
        "rest_displacements": list "m", REST, "displacement of each node along the weight at rest, from the line of levitation" in rolling_rest "displacement" => model.asked.over_nodes(|at| (model.rest[at] * model.down.conj()).re);
        "least_distance": number "m" headline, DISTANCE, "least distance left of a clearance along the rotor during the coast-down" => run.least(model).map(|(_, own)| own.value);
        "least_distance_place": text "", DISTANCE, "where that is" => run.least(model).map_or_else(|why| why, |(name, _)| name.to_string());
        "least_distance_speed": number "rad/s", DISTANCE, "speed at which it is" => run.least(model).map(|(_, own)| own.speed);
        "left_out_from": list "rad/s", DISTANCE, "lower ends of the ranges of speed at which the linear answer does not hold" in rolling_left_out "from" => run.left_out.iter().map(|own| own[0]).collect::<Vec<_>>();
        "left_out_to": list "rad/s", DISTANCE, "upper ends of these ranges" in rolling_left_out "to" => run.left_out.iter().map(|own| own[1]).collect::<Vec<_>>();
    }

    fn distance(of: &(), run: &Peak) {
        "node.*.least_distance": number "m", DISTANCE, "least distance left of the clearance at this place during the coast-down" in rolling_distances "least distance" => run.value;
        "node.*.least_distance_speed": number "rad/s", DISTANCE, "speed at which it is" in rolling_distances "at" => run.speed;
    }
}

const VALID: &str = "small motion of a rotor that stays on its races; no friction, no acceleration through a critical speed; speeds of the diagram and points close to critical ones";
origins! {
    REST: law "K w = weight with the whole contact law, balls and mounts at rest, each bearing at its own clearance and misalignment",
        source "crates/analyse/src/rotor/rolling/mod.rs; book/src/theory/rolling.md",
        valid "magnets without power; seals at the rated speed";
    CONTACT: law "n N/d, N = k dⁿ",
        source "crates/physics/src/rolling_rotor.rs",
        valid VALID;
    BALLS: law "slope of the load over the displacement of the inner race, Σ K(δ cos φ - P_d/2)^1.5 cos φ, one ball on the load line; of a preloaded set in space by its equilibrium",
        source "crates/physics/src/load_zone.rs, crates/model/src/spatial/statics/ring.rs",
        valid "no centrifugal load; rings that do not tilt against each other; balls that pass change it";
    ALONG: law "1/(1/k_contact + 1/k_balls + 1/k_mount)",
        source "crates/analyse/src/rotor/rolling/mod.rs",
        valid "at rest; the race has its mass between link and mount in all other results";
    TILT: law "4/(k b²) of the edges, (K⁻¹)_θθ of the balls (5 × 5, axis free), 1/k_mount: two springs along the weight have it, with the shift at each speed",
        source "crates/analyse/src/rotor/rolling/in_space.rs; book/src/theory/rolling.md",
        valid "a preloaded bearing in space; contact.width is given; springs within the shaft";
    ACROSS: law "N/(c0 + d)",
        source "crates/physics/src/rolling_rotor.rs; book/src/theory/rolling.md",
        valid "small angles; a race that turns with the rotor";
    FORCE: law "response to unbalance of the rotor on these supports, from the rated speed down",
        source "crates/rotor/src/response.rs",
        valid VALID;
    DISTANCE: law "clearance less the largest distance of the orbit about the position at rest from the line of levitation",
        source "crates/analyse/src/rotor/rolling/mod.rs",
        valid "speeds outside left_out_from to left_out_to alone";
}

fn value(peak: &Result<Peak, String>) -> Result<f64, String> {
    peak.as_ref().map(|own| own.value).map_err(String::clone)
}

fn speed(peak: &Result<Peak, String>) -> Result<f64, String> {
    peak.as_ref().map(|own| own.speed).map_err(String::clone)
}

impl RollingFound {
    /// The least of all distances with its place.
    fn least<'a>(&'a self, model: &'a RollingModel) -> Result<(&'a str, &'a Peak), String> {
        let all = model.places().map(|(name, ..)| name).zip(&self.distances);
        let least = all.min_by(|a, b| a.1.value.total_cmp(&b.1.value));
        least.ok_or_else(|| "no [[rotor.node]] has a clearance, and no magnet a gap".to_string())
    }
}

/// What the user should know of it.
pub(crate) fn warned(
    model: &Result<RollingModel, String>,
    found: Option<&RollingFound>,
) -> Vec<Warning> {
    let (model, found) = match (model, found) {
        (Ok(model), Some(found)) => (model, found),
        (Err(why), _) => return vec![RotorWarning::NotRolling { why: why.clone() }.into()],
        (Ok(_), None) => return Vec::new(),
    };
    let mut out = Vec::new();
    for (bearing, own) in model.bearings.iter().zip(&found.bearings) {
        let mut add = |warning: RotorWarning| {
            out.push(Warning::from(warning).of_part(&bearing.constants.label()));
        };
        let [lifts, swings] = own.beyond.each_ref().map(|own| texts(own));
        if !lifts.is_empty() {
            let (load, speeds) = (bearing.springs.load, lifts);
            add(RotorWarning::LiftsOff { load, speeds });
        }
        if !swings.is_empty() {
            add(RotorWarning::SwingsFar { speeds: swings });
        }
    }
    for ((name, ..), own) in model.places().zip(&found.distances) {
        let (distance, speed) = (own.value, own.speed);
        if distance <= 0.0 {
            let warning = RotorWarning::RollingRub { distance, speed };
            out.push(Warning::from(warning).of_part(name));
        }
    }
    if let Some((from, to)) = found.found.unstable.first() {
        let (from, to) = (*from, *to);
        out.push(RotorWarning::RollingGrows { from, to }.into());
    }
    out.push(RotorWarning::RollingLimits.into());
    out
}

/// Ranges of speed in words.
fn texts(ranges: &[[f64; 2]]) -> String {
    let all = ranges.iter().map(|own| {
        let [from, to] = own.map(|speed| number_text(speed.round()));
        format!("{from} to {to}")
    });
    all.collect::<Vec<_>>().join(", ")
}
