//! The skid of a rotor on a race under constant load: surface layers, flash, shares, energies.

use super::tally::Tally;
use crate::json::{list, number, numbers, positive, within};
use physics::heat_conduction::ThermalMaterial;
use physics::heat_exchange::line_half_width;
use serde_json::Value;
use thermal::layer::{Layer, LayerState};
use thermal::rubbing_contact::Touch;

/// Steps while it slides, fine at the start.
const STEPS: usize = 400;
/// Inputs lie between its inverse and it.
const LARGEST: f64 = 1e14;

/// Compares a file.
pub(super) fn compare(_: &Value, tally: &mut Tally) -> Result<(), String> {
    tally.cases(one)
}

/// The inputs of a case.
struct Skid {
    force: f64,
    friction: f64,
    bore: f64,
    clearance: f64,
    length: f64,
    inertia: f64,
    rotor_speed: f64,
    race_speed: f64,
    half_width: f64,
    layers: [Layer; 2],
    tracks: [f64; 2],
}

fn usual(value: &Value, key: &str) -> Result<f64, String> {
    within(value, key, 1.0 / LARGEST, LARGEST)
}

fn body(inputs: &Value, key: &str) -> Result<(Layer, f64), String> {
    let of = &inputs[key];
    let named = |error| format!("{key}: {error}");
    let material = ThermalMaterial {
        conductivity: usual(of, "k").map_err(named)?,
        density: usual(of, "rho").map_err(named)?,
        specific_heat: usual(of, "c").map_err(named)?,
    };
    let thickness = within(of, "thickness", 1e-6, 1.0).map_err(named)?;
    let area = within(of, "area", 1e-12, 1e3).map_err(named)?;
    Ok((Layer::new(material, thickness), area))
}

impl Skid {
    fn of(inputs: &Value) -> Result<Self, String> {
        let force = usual(inputs, "N")?;
        let bore = usual(inputs, "R0")?;
        let clearance = within(inputs, "c0", 1e-6 * bore, 0.5 * bore)?;
        let length = usual(inputs, "length")?;
        let (rotor, rotor_track) = body(inputs, "rotor")?;
        let (race, race_track) = body(inputs, "race")?;
        let modulus = usual(inputs, "Estar")?;
        Ok(Skid {
            force,
            friction: usual(inputs, "mu")?,
            bore,
            clearance,
            length,
            inertia: usual(inputs, "inertia")?,
            rotor_speed: within(inputs, "rotor_speed", 0.0, 1e6)?,
            race_speed: within(inputs, "race_speed0", 0.0, 1e6)?,
            half_width: line_half_width(force, bore, clearance, length, modulus),
            layers: [rotor, race],
            tracks: [rotor_track, race_track],
        })
    }

    /// dω/dt of the race, rad/s².
    fn acceleration(&self) -> f64 {
        self.friction * self.force * self.bore / self.inertia
    }

    fn race_speed_at(&self, time: f64) -> f64 {
        self.race_speed + self.acceleration() * time
    }

    /// Friction power while it slides, W.
    fn power(&self, time: f64) -> f64 {
        let rotor = (self.bore - self.clearance) * self.rotor_speed;
        self.friction * self.force * (rotor - self.bore * self.race_speed_at(time))
    }

    /// When so much friction heat has been made, or both surfaces run together, s.
    fn end(&self, heat: f64) -> f64 {
        // heat = P₀t − ½ fall t², and the smaller root
        let power = self.power(0.0);
        let fall = self.friction * self.force * self.bore * self.acceleration();
        let rest = power * power - 2.0 * fall * heat;
        match rest > 0.0 {
            true => 2.0 * heat / (power + rest.sqrt()),
            false => power / fall,
        }
    }

    fn touch(&self, time: f64) -> Touch {
        let rotor = (self.bore - self.clearance) * self.rotor_speed;
        Touch {
            power: self.power(time),
            half_width: self.half_width,
            length: self.length,
            passing: [rotor, self.bore * self.race_speed_at(time)],
            since: time,
            tracks: self.tracks,
            metals: [0.0; 2],
        }
    }
}

/// The state of both bodies at an instant.
struct At {
    time: f64,
    states: [LayerState; 2],
}

/// Follows the skid to its end and to these times; states at each of them, and the hottest patch.
fn followed(skid: &Skid, end: f64, times: &[f64]) -> (Vec<At>, f64) {
    let grid = (1..=STEPS).map(|k| end * (k as f64 / STEPS as f64).powi(2));
    let mut instants: Vec<f64> = grid.chain(times.iter().copied()).collect();
    instants.sort_by(f64::total_cmp);
    instants.dedup();
    let mut states = [LayerState::default(); 2];
    let (mut now, mut hottest, mut seen) = (0.0, 0.0, Vec::new());
    for next in instants {
        let step = next - now;
        let halves = [0, 1].map(|body: usize| skid.layers[body].half_step(step));
        if next <= end {
            let touch = skid.touch(now + 0.5 * step);
            touch.advance(&skid.layers, &mut states, &halves);
            let reached = skid.touch(next).at_once(&skid.layers, &states);
            hottest = f64::max(hottest, reached.contact);
        } else {
            for body in 0..2 {
                skid.layers[body].advance(&mut states[body], &halves[body], 0.0);
            }
        }
        now = next;
        if times.contains(&now) || now == end {
            seen.push(At { time: now, states });
        }
    }
    (seen, hottest)
}

fn one(case: &Value, tally: &mut Tally) -> Result<(), String> {
    let (inputs, results) = (&case["inputs"], &case["results"]);
    let skid = Skid::of(inputs)?;
    if skid.power(0.0) <= 0.0 {
        return Err("the surfaces do not slide".to_string());
    }
    let heat = usual(inputs, "E_stop")?;
    let last = positive(inputs, "t_end")?;
    let end = skid.end(heat);
    let mut times = numbers(inputs, "times")?;
    times.retain(|time| *time > 0.0 && *time <= last);
    if end > last {
        return Err("sliding does not end within t_end".to_string());
    }
    let (seen, hottest) = followed(&skid, end, &times);

    let surface = tally.both("surface_temperatures")?;
    let contact = tally.relative("contact_temperatures")?;
    let energy = tally.relative("energies")?;
    let exact = tally.relative("contact_time")?;
    let width = tally.relative("half_width")?;
    let place = tally.place.clone();
    let touch = skid.touch(end);
    tally.add_number((results, "half_width"), "m", skid.half_width, width)?;
    tally.add_number((results, "patch_area"), "m^2", touch.patch(), width)?;
    tally.add_number((results, "contact_time"), "s", end, exact)?;
    let faster = skid.race_speed_at(end);
    tally.add_number((results, "race_speed_end"), "rad/s", faster, exact)?;
    let turned = end * 0.5 * (skid.race_speed + faster);
    tally.add_number((results, "race_angle"), "rad", turned, exact)?;
    tally.add_number((results, "peak_contact_temperature"), "K", hottest, contact)?;
    let stop = seen.iter().find(|at| at.time == end);
    let stop = stop.ok_or("sliding does not end")?.states;
    tally.add_number((results, "rotor_energy"), "J", stop[0].energy, energy)?;
    tally.add_number((results, "race_energy"), "J", stop[1].energy, energy)?;
    for row in list(results, "rows")? {
        tally.row(&place, row, |tally| {
            let time = number(row, "t")?;
            let at = seen.iter().find(|at| at.time == time);
            let at = at.ok_or_else(|| format!("row at {time} s, which is none of the times"))?;
            let slides = time < end;
            let surfaces = if slides {
                let shared = skid.touch(time).at_once(&skid.layers, &at.states);
                let power = skid.power(time);
                tally.add_number((row, "power"), "W", power, exact)?;
                tally.add_number((row, "rotor_share"), "1", shared.powers[0] / power, energy)?;
                tally.add_number((row, "contact"), "K", shared.contact, contact)?;
                shared.surfaces
            } else {
                [0, 1]
                    .map(|body| skid.layers[body].surface(&at.states[body], 0.0, skid.tracks[body]))
            };
            tally.add_number((row, "rotor_surface"), "K", surfaces[0], surface)?;
            tally.add_number((row, "race_surface"), "K", surfaces[1], surface)?;
            let speed = skid.race_speed_at(time.min(end));
            tally.add_number((row, "race_speed"), "rad/s", speed, exact)?;
            tally.add_number((row, "rotor_energy"), "J", at.states[0].energy, energy)?;
            tally.add_number((row, "race_energy"), "J", at.states[1].energy, energy)
        })?;
    }
    Ok(())
}
