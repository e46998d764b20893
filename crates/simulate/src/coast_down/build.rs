//! Bearings that warm, and the machine that coasts down on them: networks, losses, and the loads of the balls.

use crate::coast_down::passages;
use crate::coast_down::rows::{BallsSeen, End, Row};
use catalogue::Ring;
use model::bearing_heat::sliding;
use model::rotor::TorqueTables;
use physics::angular_contact::preload_interference;
use physics::heat_conduction::STEEL_HEAT;
use physics::hertz::{BallRace, PointContact, Race, maximum_pressure};
use physics::load_zone::{cosines, joint_stiffness};
use physics::materials::{BEARING_STEEL, contact_modulus};
use physics::palmgren::Palmgren;
use physics::viscosity::Viscosity;
use problem::{Code, Problem};
pub(crate) use scenario::heat::ICE_POINT;
use scenario::heat::{SHOULDER, STEEL_EXPANSION};
use scenario::{CoastDown, CoastDownEnd, CoastingBearing, Feedback, Moment, Warm, problem_at};
use std::f64::consts::PI;
use std::sync::Arc;
use thermal::bearing_network::{
    BALLS, BearingNetwork, INNER_RACE, LUBRICANT, NODES, OUTER_RACE, ROTOR,
};
use thermal::clearance::ThermalClearance;
use thermal::coast_down::AtNodes;
use thermal::held::Held;
use thermal::load_zone::LoadZone;
use thermal::oil_range::BeyondData;
use thermal::passage::{Line, Passage};
use thermal::warm_bearing::{BearingLoad, WarmBearings};
use thermal::warm_machine::{Between, OF_BEARING, RotorDrag, WarmMachine};

/// Expansion of silicon nitride, 1/K. Source: derived; book/src/theory/heat.md.
const CERAMIC_EXPANSION: f64 = 3.2e-6;
/// Specific heat of oil and grease, J/(kg K). Source: mineral oils, 1800 to 2000.
const OIL_SPECIFIC_HEAT: f64 = 1900.0;
/// Pressure that dents where none is given, Pa. Source: ISO 76 (ball bearings, 4200 MPa).
const DENTS: f64 = 4.2e9;

/// A bearing of a coast-down.
#[derive(Clone, Debug)]
pub(crate) struct Part {
    /// Its name; empty for an only bearing.
    pub name: String,
    /// What it was built from.
    pub warm: Warm,
    pub network: BearingNetwork,
    pub losses: WarmBearings,
    pub zone: LoadZone,
    /// Direction of its radial load from the frame's x axis, rad; 0 where there is no frame.
    pub load_direction: f64,
    /// Whether the clearance follows the temperatures.
    pub closes: bool,
    /// The line of the lubricant, and where it is known.
    pub viscosity: Viscosity,
    /// Pressure that dents, Pa.
    pub pressure_limit: f64,
    /// Whether laws know its losses; else ball-by-ball intervals alone measure them.
    pub by_laws: bool,
}

impl Part {
    /// Pressure of a ball under its loads at the inner and at the outer race where it is larger, Pa.
    pub fn largest_pressure(&self, loads: [f64; 2]) -> f64 {
        let contacts = self.network.contacts.iter().zip(loads);
        let each = contacts.map(|(contact, load)| maximum_pressure(contact.pressure_factor, load));
        each.fold(0.0, f64::max)
    }
}

/// The machine of a coast-down.
#[derive(Clone, Debug)]
pub struct CoastDownModel {
    /// Bearings that differ, each with the number of those that are equal to it.
    pub(crate) parts: Vec<Part>,
    /// What turns, kg m².
    pub inertia: f64,
    /// What brakes the rotor besides.
    pub rotor: RotorDrag,
    /// Torques that brake it from a time or a speed on.
    pub(crate) brakes: Vec<Brake>,
    /// A load over speed and time that brakes it.
    pub load: Option<TorqueTables>,
    /// How it ends.
    pub end: CoastDownEnd,
    /// Weight along the shaft that a face carries, N.
    pub thrust: f64,
    /// Kinetic energy of what turns at its beginning, J.
    pub energy: f64,
    /// Temperatures at its beginning, °C.
    pub warm_from: Vec<f64>,
    /// Where the coast-down by laws starts.
    pub(crate) start: Start,
    /// How its motion differs from rolling, between two intervals; none where it rolls.
    pub(crate) motion: Option<Motion>,
}

/// A torque that brakes a rotor besides, or takes from what does.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Brake {
    /// From when on, s.
    pub from: f64,
    /// From which speed on downwards, rad/s.
    pub below: f64,
    /// N m.
    pub torque: f64,
}

/// Between two intervals that followed the motion.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    pub between: Between,
    /// Of the balls of each bearing, at both.
    pub balls: [Vec<Option<Arc<BallsSeen>>>; 2],
    /// Whether a step is a prediction, which is repeated: how disturbances grow is not asked.
    pub predicts: bool,
}

impl Motion {
    /// The balls of a bearing as the interval nearest to a speed has seen them.
    pub fn balls(&self, speed: f64, bearing: usize) -> Option<&Arc<BallsSeen>> {
        let nearest = usize::from(self.between.way(speed) > 0.5);
        self.balls[nearest][bearing].as_ref()
    }
}

/// Where a coast-down starts.
#[derive(Clone, Debug)]
pub(crate) struct Start {
    /// s.
    pub time: f64,
    /// rad/s, 0 or more.
    pub speed: f64,
    /// Of the nodes of all bearings, °C.
    pub temperatures: Vec<f64>,
    /// Heat of each loss before it, J.
    pub heats: Vec<f64>,
    /// Heat given to the surroundings before it, J.
    pub given: f64,
    /// Heats of the nodes before it.
    pub at_nodes: AtNodes,
    /// What is known of the way to there.
    pub rows: Vec<Row>,
    /// Of each bearing: whether its lubricant has been hotter or colder than its viscosity is known near.
    pub beyond_data: Vec<Option<BeyondData>>,
    /// Why it ended on that way.
    pub ended: Option<End>,
    /// The same way with the nodes held at their limits, where there was one.
    pub on_limits: Option<OnLimits>,
}

/// A way on which nodes are held at their limits.
#[derive(Clone, Debug)]
pub(crate) struct OnLimits {
    pub held: Held,
    /// Of the nodes of all bearings, °C.
    pub temperatures: Vec<f64>,
    /// Heat taken from each on the way, J, all bearings.
    pub taken: Vec<f64>,
    /// The same over the last step, W.
    pub powers: Vec<f64>,
    /// What is known of it.
    pub rows: Vec<Row>,
    /// How much later it comes to the same speed, s.
    pub delay: f64,
}

impl OnLimits {
    /// Nothing taken yet.
    pub fn from(held: Held, temperatures: Vec<f64>, rows: Vec<Row>) -> Self {
        let nothing = vec![0.0; temperatures.len()];
        OnLimits {
            held,
            temperatures,
            taken: nothing.clone(),
            powers: nothing,
            rows,
            delay: 0.0,
        }
    }
}

impl Start {
    /// A start at a time (s), speed (rad/s) and temperatures of the nodes of so many bearings (°C).
    pub fn at(time: f64, speed: f64, temperatures: Vec<f64>, bearings: usize) -> Self {
        Start {
            time,
            speed,
            at_nodes: AtNodes::none(temperatures.len()),
            temperatures,
            heats: vec![0.0; OF_BEARING * bearings + 1],
            given: 0.0,
            rows: Vec::new(),
            beyond_data: vec![None; bearings],
            ended: None,
            on_limits: None,
        }
    }
    /// The same, with nodes that are held at these temperatures, °C.
    pub fn holding(self, held: Held, temperatures: Vec<f64>) -> Self {
        Start {
            on_limits: Some(OnLimits::from(held, temperatures, Vec::new())),
            ..self
        }
    }
    /// The same, with lubricants that have been beyond their data before.
    pub fn beyond(self, beyond_data: Vec<Option<BeyondData>>) -> Self {
        Start {
            beyond_data,
            ..self
        }
    }
}

/// Ends a step of nodes that are held, in which so much heat reached each, J of one of so many equal bearings: adds what was taken from
/// all of them, J, and returns it over the step, W.
pub(crate) fn hold(
    (held, temperatures): (&mut Held, &mut [f64]),
    capacities: &[f64],
    reached: &[f64],
    (planes, time): (&[f64], f64),
    taken: &mut [f64],
) -> Vec<f64> {
    let mut powers = held.end(capacities, temperatures, reached);
    for ((power, planes), taken) in powers.iter_mut().zip(planes).zip(taken) {
        *power *= planes;
        *taken += *power;
        *power /= time;
    }
    powers
}

impl CoastDownModel {
    /// Whether laws know the losses of all its bearings.
    pub(crate) fn by_laws(&self) -> bool {
        self.parts.iter().all(|part| part.by_laws)
    }
    /// The next time after this one, s, at which what brakes the rotor changes its law, or a load will have changed by a twentieth of all that
    /// brakes, N m; the last one there is at the latest.
    pub(crate) fn until(&self, time: f64, speed: f64, braking: f64) -> f64 {
        let knots = (self.load.iter()).flat_map(|load| load.share_over_time.points());
        let instants = knots
            .map(|knot| knot.0)
            .chain(self.brakes.iter().map(|own| own.from));
        let later = instants.filter(|instant| *instant > time);
        let next = later.fold(self.end.longest, f64::min);
        let changes = (self.load.as_ref()).map_or(0.0, |load| {
            let share = load.share_over_time.piece(time).slope;
            (load.over_speed.value(speed) * share).abs()
        });
        match changes > 0.0 {
            true => next.min(time + 0.05 * braking / changes),
            false => next,
        }
    }
    /// The next speed below this one, rad/s, at which it does; 0 where there is none.
    pub(crate) fn knot_below(&self, speed: f64) -> f64 {
        let knots = (self.load.iter()).flat_map(|load| load.over_speed.points());
        let lower = knots.map(|knot| knot.0).filter(|knot| *knot < speed);
        lower.fold(self.brake_below(speed), f64::max)
    }
    /// The next speed below this one, rad/s, at which a brake comes; 0 where none does.
    pub(crate) fn brake_below(&self, speed: f64) -> f64 {
        let brakes = self.brakes.iter().map(|own| own.below);
        brakes.filter(|below| *below < speed).fold(0.0, f64::max)
    }

    /// Equal bearings that each node stands for.
    pub(crate) fn planes(&self) -> Vec<f64> {
        let of = |part: &Part| [part.losses.count; NODES.len()];
        self.parts.iter().flat_map(of).collect()
    }

    /// Whether a ring on a seat follows the temperatures.
    pub(crate) fn seats_follow(&self) -> bool {
        let mut networks = self.parts.iter().map(|part| &part.network);
        networks.any(|own| own.landing.is_pressed() || own.outer_seat.is_pressed())
    }

    /// Capacities of the nodes of all bearings, J/K.
    pub fn capacities(&self) -> Vec<f64> {
        let parts = self.parts.iter();
        parts.flat_map(|part| part.network.capacities).collect()
    }
    /// The losses of the machine at a time; of a load by tables the line that holds down from a speed, rad/s.
    pub fn losses(&self, time: f64, speed: f64) -> WarmMachine {
        let mut rotor = self.rotor;
        let acts = |own: &&Brake| time >= own.from && speed <= own.below;
        let brakes = self.brakes.iter().filter(acts);
        rotor.torque += brakes.map(|own| own.torque).sum::<f64>();
        if let Some(load) = &self.load {
            let line = load.over_speed.piece(speed.next_down());
            let share = load.share_over_time.value(time);
            rotor.torque -= share * line.at(0.0);
            rotor.drag -= share * line.slope;
        }
        WarmMachine {
            bearings: self.parts.iter().map(|part| part.losses.clone()).collect(),
            rotor,
            motion: self.motion.as_ref().map(|motion| motion.between.clone()),
        }
    }
}

/// Builds a coast-down by itself.
pub fn alone(run: &CoastDown) -> Result<CoastDownModel, Box<Problem>> {
    let of = |own: &CoastingBearing| {
        let mut part = part(&own.warm, own.name.clone(), own.planes)?;
        let heat = &part.warm.heat;
        let clearance = heat.radial_air_clearance.unwrap_or(0.0);
        part.losses.ratio = 1.0 - clearance / (0.5 * heat.bore_diameter);
        Ok(part)
    };
    let parts = (run.bearings.iter().map(of)).collect::<Result<Vec<_>, Box<Problem>>>()?;
    let starts = parts
        .iter()
        .map(|part| part.warm.heat.start_temperature - ICE_POINT);
    let start: Vec<f64> = starts.flat_map(|start| [start; NODES.len()]).collect();
    Ok(CoastDownModel {
        inertia: run.polar_inertia,
        rotor: RotorDrag {
            drag_square: run.windage,
            ..RotorDrag::default()
        },
        brakes: Vec::new(),
        load: None,
        end: run.end,
        thrust: 0.0,
        energy: 0.5 * run.polar_inertia * run.speed * run.speed,
        warm_from: start.clone(),
        start: Start::at(0.0, run.speed.abs(), start, parts.len()),
        motion: None,
        parts,
    })
}

/// A bearing of a coast-down, of which there are so many.
pub(crate) fn part(warm: &Warm, name: String, planes: f64) -> Result<Part, Box<Problem>> {
    let (network, zone) = network(warm)?;
    let points = &warm.viscosity_points;
    let [one, other] = [points[0], points[1]];
    let viscosity = Viscosity::through((one[0], one[1]), (other[0], other[1])).map_err(|why| {
        problem(
            "bearing.moment.viscosity_points",
            why.to_string(),
            "two points of one oil are needed",
        )
    })?;
    let losses = losses(warm, &zone, Some(viscosity), planes)?;
    Ok(of_losses(warm, name, (network, zone), (losses, viscosity)))
}

pub(super) fn of_losses(
    warm: &Warm,
    name: String,
    (network, zone): (BearingNetwork, LoadZone),
    (losses, viscosity): (WarmBearings, Viscosity),
) -> Part {
    Part {
        name,
        losses,
        network,
        zone,
        load_direction: 0.0,
        // at an angle springs keep the preload
        closes: warm.heat.feedback == Feedback::Full && warm.contact_angle == 0.0,
        viscosity,
        pressure_limit: DENTS,
        warm: warm.clone(),
        by_laws: true,
    }
}

fn problem(key: &str, found: String, needed: &str) -> Box<Problem> {
    problem_at(Code::Impossible, key, found, needed)
}

/// The network of a bearing, and its balls under their load.
pub(crate) fn network(run: &Warm) -> Result<(BearingNetwork, LoadZone), Box<Problem>> {
    let heat = &run.heat;
    let celsius = |kelvin: f64| kelvin - ICE_POINT;
    let material = run.ball_material.data();
    let modulus = contact_modulus(material, BEARING_STEEL);
    let contact = |race, groove_curvature| {
        let shape = BallRace {
            ball_diameter: run.ball_diameter,
            pitch_diameter: run.pitch_diameter,
            groove_curvature,
            contact_angle: run.contact_angle,
            race,
        };
        PointContact::new(shape.curvature(), modulus)
            .map_err(|why| problem("bearing", why.to_string(), "another groove is needed"))
    };
    let contacts = [
        contact(Race::Inner, run.inner_groove_curvature)?,
        contact(Race::Outer, run.outer_groove_curvature)?,
    ];
    let stiffness = joint_stiffness(contacts[0].stiffness, contacts[1].stiffness);
    let is_hybrid = run.ball_material == scenario::BallMaterial::SiliconNitride;
    let ball_mass =
        (run.ball_mass).unwrap_or_else(|| run.ball_material.ball_mass(run.ball_diameter));
    let rows = run.rows as f64;
    let balls = rows * run.ball_count as f64;
    let gap = run.ball_diameter;
    let seats = passages::seats(run);
    let (angle, radial) = (run.contact_angle, run.contact_angle.cos());
    let pressed = match run.axial_preload > 0.0 {
        true => preload_interference(run.axial_preload, run.ball_count, stiffness, angle),
        false => 0.0,
    };
    let zone = LoadZone {
        load: run.radial_load,
        stiffness: stiffness * radial.powf(1.5),
        radial,
        cosines: cosines(run.rows * run.ball_count),
        clearance: ThermalClearance {
            at_reference: run.operating_diametral_clearance - 2.0 * pressed,
            reference: celsius(heat.start_temperature),
            tracks: [run.pitch_diameter - gap, run.pitch_diameter + gap],
            ball: run.ball_diameter,
            expansions: [
                STEEL_EXPANSION,
                if is_hybrid {
                    CERAMIC_EXPANSION
                } else {
                    STEEL_EXPANSION
                },
                STEEL_EXPANSION,
            ],
        },
        nodes: [INNER_RACE, BALLS, OUTER_RACE],
        seats,
        // springs that keep a preload give way to it
        growth: if angle > 0.0 { 0.0 } else { run.growth },
    };
    // rings share the annulus between bore and outside at the pitch circle's shoulders
    let shoulder = |side: f64| run.pitch_diameter + side * 2.0 * SHOULDER * run.ball_diameter;
    let annulus = |outer: f64, inner: f64| outer * outer - inner * inner;
    // of the inner race's mass the ring has no more than the steel between bore and shoulder; the rest is sleeve
    let ring = Ring {
        smooth_radius: 0.5 * heat.bore_diameter,
        shoulder_radius: 0.5 * shoulder(-1.0),
        track_radius: 0.5 * (run.pitch_diameter - gap),
        groove_radius: run.inner_groove_curvature * gap,
        width: heat.width,
    };
    let ring_mass = (BEARING_STEEL.density * ring.volume_moments().0).min(run.inner_race_mass);
    let outer_mass = rows * ring_mass * annulus(heat.outer_diameter, shoulder(1.0))
        / annulus(shoulder(-1.0), heat.bore_diameter);
    if outer_mass.partial_cmp(&0.0) != Some(std::cmp::Ordering::Greater) {
        return Err(problem(
            "heat.outer_diameter",
            "rings that leave no room for the balls".to_string(),
            "a bore and an outer diameter of this bearing are needed",
        ));
    }
    let steel = STEEL_HEAT.specific_heat;
    let ball = run.ball_material.heat();
    let cage = rows * run.cage_mass * heat.cage_material.heat().specific_heat;
    let on_rotor = seats[0].filter(|seat| seat.nodes[0] == ROTOR);
    let network = BearingNetwork {
        capacities: [
            heat.rotor_capacity.unwrap_or(f64::INFINITY),
            rows * run.inner_race_mass * steel,
            balls * ball_mass * ball.specific_heat,
            cage,
            rows * heat.lubricant_mass * OIL_SPECIFIC_HEAT,
            outer_mass * steel,
            heat.housing_capacity,
            0.0,
            heat.mount_capacity.unwrap_or(0.0),
        ],
        balls,
        ball_mass,
        ball_diameter: run.ball_diameter,
        pitch_diameter: run.pitch_diameter,
        width: rows * heat.width,
        contacts,
        ball,
        film: heat.film_thickness,
        landing: match (heat.rotor_contact, on_rotor) {
            (Some(conductance), _) => Passage::Given(conductance),
            (None, Some(seat)) => passages::pressed(heat, seat),
            (None, None) => Passage::Line(Line {
                bore: 0.5 * heat.bore_diameter,
                clearance: heat
                    .radial_air_clearance
                    .unwrap_or(0.01 * heat.bore_diameter),
                length: rows * heat.width,
                modulus: contact_modulus(BEARING_STEEL, BEARING_STEEL),
                medium: passages::medium(heat),
            }),
        },
        outer_seat: match (heat.outer_seat, seats[1]) {
            (None, Some(seat)) => passages::pressed(heat, seat),
            (given, _) => Passage::Given(given.unwrap_or(0.0)),
        },
        surroundings: passages::open_housing(heat),
        rotor_surroundings: passages::open_rotor(heat),
        to_core: 0.0,
        mount: [heat.mount_contact, heat.mount_surroundings],
        ambient: celsius(heat.ambient_temperature),
    };
    Ok((network, zone))
}

/// Palmgren's two moments, the second by the loads of the balls where the rings may close.
pub(crate) fn losses(
    run: &Warm,
    zone: &LoadZone,
    viscosity: Option<Viscosity>,
    planes: f64,
) -> Result<WarmBearings, Box<Problem>> {
    let missing = |key: &str, needed: &str| problem_at(Code::NoLawData, key, "no value", needed);
    let (
        Moment::Palmgren {
            f0,
            f1_factor,
            f1_exponent,
            viscosity: at_start,
            ..
        },
        Some(rating),
    ) = (&run.moment, run.static_load_rating)
    else {
        return Err(missing(
            "bearing.static_load_rating",
            "the static load rating C0 is needed by Palmgren's law",
        ));
    };
    let moment = Palmgren {
        // the flow in each row
        viscous_factor: run.moment_scale * f0 * run.rows as f64,
        viscosity: *at_start,
        pitch_diameter: run.pitch_diameter,
        load_factor: run.moment_scale * f1_factor,
        load_exponent: *f1_exponent,
        static_load_rating: rating,
        preload: 0.0,
    };
    let load = match run.heat.feedback {
        _ if run.contact_angle > 0.0 || run.moment.axial_load() != 0.0 => {
            BearingLoad::Moment(at_angle(run)?)
        }
        Feedback::Full => BearingLoad::Zone {
            unpreloaded: unpreloaded(zone),
            zone: zone.clone(),
        },
        Feedback::Viscosity | Feedback::None => BearingLoad::Radial(run.radial_load),
    };
    let oil = match (run.heat.feedback, viscosity) {
        (Feedback::Full | Feedback::Viscosity, Some(viscosity)) => viscosity,
        _ => Viscosity::constant(*at_start),
    };
    let mut viscous = vec![0.0; NODES.len()];
    viscous[LUBRICANT] = 1.0;
    Ok(WarmBearings {
        count: planes,
        ratio: 1.0,
        moment,
        oil,
        load,
        windage: 0.0,
        lubricant: LUBRICANT,
        shares: [viscous, sliding(run.ball_material.heat()).to_vec()],
    })
}

/// M1 under the radial load and the axial one of its law, N m.
fn at_angle(run: &Warm) -> Result<f64, Box<Problem>> {
    let law = (run.moment.law(&run.rated())).map_err(|why| {
        problem(
            "bearing.moment",
            why,
            "a law that knows the contact angle is needed",
        )
    })?;
    // far above the speed at which it fades
    let moments = law.parts(1.0, run.radial_load, run.moment.axial_load());
    Ok(run.moment_scale * moments.load_dependent)
}

/// Sum of the loads of the balls at the start, as if no ring pressed on them, N.
pub(crate) fn unpreloaded(zone: &LoadZone) -> f64 {
    zone.loads(zone.clearance.at_reference.max(0.0))
        .iter()
        .sum()
}

/// Turns of a speed over a time.
pub(super) fn turns(speed: f64, time: f64) -> f64 {
    speed * time / (2.0 * PI)
}
