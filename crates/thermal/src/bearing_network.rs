//! The thermal network of an auxiliary bearing, the rotor that lies in it and the housing around it.
//!
//! ```text
//!   rotor ── inner race ══ balls ══ outer race ── housing ── surroundings
//!     │          │        │     │        │
//!     │          └──── lubricant ── cage ┘            ══ contacts that roll: more with speed and load
//!     └── surroundings
//!   rotor (its surface layer) ── rotor core,  housing ── mount, where they are nodes of their own
//! ```
//!
//! Every ball conducts through the ellipses that it touches the races with, each in series with a film; a ball without load
//! conducts to the outer race alone, which its centrifugal force presses it on. The lubricant streams past rings, balls and
//! cage at a third of the cage's speed. Rotor and inner race roll on each other along a line of rough surfaces.
//!
//! The conductances are those of an instant: a run takes them anew at each of its steps.
//!
//! Source: derived; book/src/theory/heat.md.

use crate::network::{self, Ground, Link, Network};
use crate::passage::Passage;
use physics::heat_conduction::{STEEL_HEAT, ThermalMaterial};
use physics::heat_exchange::{ContactConductance, stream_transfer};
use physics::hertz::PointContact;
use std::f64::consts::PI;

/// The nodes, in their order.
pub const NODES: [&str; 9] = [
    "rotor",
    "inner_race",
    "balls",
    "cage",
    "lubricant",
    "outer_race",
    "housing",
    "rotor_core",
    "mount",
];
/// The part of the rotor that warms with this bearing; its surface layer where its core is a node.
pub const ROTOR: usize = 0;
/// Sleeve and inner ring.
pub const INNER_RACE: usize = 1;
/// All balls.
pub const BALLS: usize = 2;
/// Cage.
pub const CAGE: usize = 3;
/// Oil or grease.
pub const LUBRICANT: usize = 4;
/// Outer ring.
pub const OUTER_RACE: usize = 5;
/// What the outer ring sits in.
pub const HOUSING: usize = 6;
/// What of the rotor is deeper than its surface layer, where that is a node of its own.
pub const ROTOR_CORE: usize = 7;
/// What the housing stands on, where that is a node of its own.
pub const MOUNT: usize = 8;

/// What heat passes outside of the bearing, as the keys call it: rotor to inner race, outer race to housing, housing and rotor to their
/// surroundings.
pub const PASSES: [&str; 4] = [
    "rotor_contact",
    "outer_seat",
    "surroundings",
    "rotor_surroundings",
];

/// What gives heat to the surroundings.
pub const GROUNDS: [usize; 4] = [HOUSING, ROTOR, ROTOR_CORE, MOUNT];

/// Conductivity of oil, W/(m K), and its ρc, J/(m³ K). Source: mineral oils.
const OIL: (f64, f64) = (0.14, 1.67e6);
/// Between a ball and its pocket, W/K. Source: assumed; small beside the lubricant's.
const POCKET: f64 = 5e-3;

/// Constants of the network of one bearing.
#[derive(Clone, Debug, PartialEq)]
pub struct BearingNetwork {
    /// Heat capacities of the nodes, J/K; 0 of one that is not there.
    pub capacities: [f64; NODES.len()],
    /// Number of balls.
    pub balls: f64,
    /// Mass of a ball, kg.
    pub ball_mass: f64,
    /// Diameter of a ball, m.
    pub ball_diameter: f64,
    /// Pitch diameter, m.
    pub pitch_diameter: f64,
    /// Width of the bearing, m.
    pub width: f64,
    /// Contacts of a ball with inner and outer race.
    pub contacts: [PointContact; 2],
    /// Metal of the balls; the races are of steel.
    pub ball: ThermalMaterial,
    /// Film between balls and races, m.
    pub film: f64,
    /// Rotor on inner race.
    pub landing: Passage,
    /// Outer race to housing.
    pub outer_seat: Passage,
    /// Housing to its surroundings.
    pub surroundings: Passage,
    /// Rotor to its surroundings.
    pub rotor_surroundings: Passage,
    /// Rotor's surface layer to its core, W/K.
    pub to_core: f64,
    /// Mount to housing and to its surroundings, W/K.
    pub mount: [f64; 2],
    /// Temperature of the surroundings, °C.
    pub ambient: f64,
}

/// How the rotor lies in the race, mean over a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Landing {
    /// Its radial force on the race, N.
    pub force: f64,
    /// Share of that force under which it slides: the rough line of one that rolls conducts by the rest.
    pub slides: f64,
    /// What the patch conducts meanwhile, W/K; 0 where surface layers conduct it.
    pub conductance: f64,
}

impl Landing {
    /// One that rolls under a force, N.
    pub fn rolls(force: f64) -> Self {
        Landing {
            force,
            ..Landing::default()
        }
    }
    /// Between this and another, a share of the way on.
    pub fn along(self, to: Self, way: f64) -> Self {
        let along = |from: f64, to: f64| from + way * (to - from);
        Landing {
            force: along(self.force, to.force),
            slides: along(self.slides, to.slides),
            conductance: along(self.conductance, to.conductance),
        }
    }
}

/// The state that the conductances follow.
#[derive(Clone, Copy, Debug)]
pub struct Operation<'a> {
    /// Speed of rotor and inner race, rad/s.
    pub speed: f64,
    /// How the rotor lies in the inner race.
    pub landing: Landing,
    /// Load of each ball on the inner race, N.
    pub loads: &'a [f64],
    /// Kinematic viscosity of the lubricant, m²/s.
    pub viscosity: f64,
    /// Temperatures of the nodes, °C.
    pub temperatures: &'a [f64],
}

impl BearingNetwork {
    /// γ = D/d_m.
    fn gamma(&self) -> f64 {
        self.ball_diameter / self.pitch_diameter
    }

    /// Whether a node is there.
    pub fn has(&self, node: usize) -> bool {
        self.capacities[node] > 0.0
    }

    /// The same rotor as a surface layer of so much of its capacity, J/K, and its core, with a conductance between their means, W/K.
    pub fn with_layer(&mut self, capacity: f64, to_core: f64) {
        self.capacities[ROTOR_CORE] = self.capacities[ROTOR] - capacity;
        self.capacities[ROTOR] = capacity;
        self.to_core = to_core;
    }

    /// The network at an instant.
    ///
    /// # Errors
    /// A capacity or conductance that is none.
    pub fn at(&self, operation: Operation<'_>) -> Result<Network, String> {
        together(&[(self, operation)], &[])
    }

    /// Its links and grounds, with nodes counted from a first one.
    fn links(&self, operation: Operation<'_>, from: usize) -> (Vec<Link>, Vec<Ground>) {
        let link = |a: usize, b: usize, conductance: f64| Link {
            nodes: [from + a, from + b],
            conductance,
        };
        let [inner, outer] = self.races(operation);
        let [to_inner, to_balls, to_cage, to_outer] = self.lubricant(operation);
        let ground = |node: usize, conductance: f64| Ground {
            node: from + node,
            conductance,
            temperature: self.ambient,
        };
        let passes = self.passes(operation.landing, operation.speed, operation.temperatures);
        let mut links = vec![
            link(ROTOR, INNER_RACE, passes[0]),
            link(INNER_RACE, BALLS, inner),
            link(BALLS, OUTER_RACE, outer),
            link(BALLS, CAGE, POCKET * self.balls),
            link(INNER_RACE, LUBRICANT, to_inner),
            link(BALLS, LUBRICANT, to_balls),
            link(CAGE, LUBRICANT, to_cage),
            link(OUTER_RACE, LUBRICANT, to_outer),
            link(OUTER_RACE, HOUSING, passes[1]),
            link(ROTOR, ROTOR_CORE, self.to_core),
            link(HOUSING, MOUNT, self.mount[0]),
        ];
        links.retain(|link| link.nodes.iter().all(|node| self.has(node - from)));
        let mut grounds = vec![
            ground(HOUSING, passes[2]),
            ground(self.open_rotor(), passes[3]),
        ];
        if self.has(MOUNT) {
            grounds.push(ground(MOUNT, self.mount[1]));
        }
        (links, grounds)
    }

    /// Force of a ball on the outer race by its orbit, at a speed of the inner race, rad/s: N.
    ///
    /// Formula: F = m_b (d_m/2) ω_c², ω_c = Ω (1 − γ)/2
    pub fn centrifugal(&self, speed: f64) -> f64 {
        let cage = 0.5 * speed * (1.0 - self.gamma());
        0.5 * self.ball_mass * self.pitch_diameter * cage * cage
    }

    /// All balls to the inner and to the outer race, W/K.
    pub fn races(&self, operation: Operation<'_>) -> [f64; 2] {
        let gamma = self.gamma();
        let cage = 0.5 * operation.speed.abs() * (1.0 - gamma);
        // both tracks pass the balls at one speed where they roll
        let passing = 0.5 * cage * self.pitch_diameter * (1.0 + gamma);
        let centrifugal = self.centrifugal(operation.speed);
        let one = |contact: &PointContact, load: f64| match load > 0.0 {
            true => {
                let axes = [contact.semi_major(load), contact.semi_minor(load)];
                ContactConductance::of_ellipse(axes[0], axes[1], passing, STEEL_HEAT, self.ball)
                    .with_film(self.film, OIL.0, axes)
            }
            false => 0.0,
        };
        let loads = operation.loads.iter();
        loads.fold([0.0; 2], |[inner, outer], &load| {
            [
                inner + one(&self.contacts[0], load),
                outer + one(&self.contacts[1], load + centrifugal),
            ]
        })
    }

    /// Lubricant to inner race, balls, cage and outer race, W/K.
    fn lubricant(&self, operation: Operation<'_>) -> [f64; 4] {
        let (ball, pitch) = (self.ball_diameter, self.pitch_diameter);
        let cage = 0.25 * operation.speed.abs() * (1.0 - self.gamma()) * pitch;
        let transfer = stream_transfer(cage / 3.0, pitch, OIL.0, operation.viscosity, OIL.1);
        let track = |diameter: f64| PI * diameter * self.width;
        [
            track(pitch - ball),
            self.balls * PI * ball * ball,
            track(pitch),
            track(pitch + ball),
        ]
        .map(|area| transfer * area)
    }

    /// The node of the rotor that is behind its surface, and gives heat to its surroundings.
    pub fn open_rotor(&self) -> usize {
        match self.has(ROTOR_CORE) {
            true => ROTOR_CORE,
            false => ROTOR,
        }
    }

    /// Conductances of the [`PASSES`] with the rotor on its race, at a speed of the inner race, rad/s, and at temperatures of the nodes,
    /// °C: W/K.
    pub fn passes(
        &self,
        landing: Landing,
        speed: f64,
        temperatures: &[f64],
    ) -> [f64; PASSES.len()] {
        let force = landing.force;
        let rolling = (1.0 - landing.slides) * force;
        let at = |node: usize| temperatures[node];
        let room = self.ambient;
        [
            landing.conductance
                + (self.landing).conductance(rolling, speed, [at(ROTOR), at(INNER_RACE)]),
            (self.outer_seat).conductance(force, 0.0, [at(OUTER_RACE), at(HOUSING)]),
            (self.surroundings).conductance(force, 0.0, [at(HOUSING), room]),
            (self.rotor_surroundings).conductance(force, speed, [at(self.open_rotor()), room]),
        ]
    }

    /// Whether the inner ring on the rotor and the outer ring in its housing have lost the interference that they had, at a speed and at
    /// temperatures as those of [`BearingNetwork::passes`].
    pub fn loose(&self, speed: f64, temperatures: &[f64]) -> [bool; 2] {
        let at = |node: usize| temperatures[node];
        [
            (self.landing).is_loose(speed, [at(ROTOR), at(INNER_RACE)]),
            (self.outer_seat).is_loose(0.0, [at(OUTER_RACE), at(HOUSING)]),
        ]
    }
}

/// The networks of several bearings at an instant as one, the nodes of each behind those before; they exchange nothing. Nodes that are
/// marked are held.
///
/// # Errors
/// A capacity or conductance that is none.
pub fn together(
    parts: &[(&BearingNetwork, Operation<'_>)],
    held: &[bool],
) -> Result<Network, String> {
    let (capacities, links, grounds) = joined(parts);
    Network::holding(&capacities, &links, &grounds, held)
}

/// C⁻¹ (grounds − G T) of the same with the conductances of these instants, at temperatures of the nodes in °C: K/s.
pub fn relaxing(parts: &[(&BearingNetwork, Operation<'_>)], temperatures: &[f64]) -> Vec<f64> {
    let (capacities, links, grounds) = joined(parts);
    network::relaxing(&capacities, &links, &grounds, temperatures)
}

fn joined(parts: &[(&BearingNetwork, Operation<'_>)]) -> (Vec<f64>, Vec<Link>, Vec<Ground>) {
    let (mut capacities, mut links, mut grounds) = (Vec::new(), Vec::new(), Vec::new());
    for (part, operation) in parts {
        let (own, to_surroundings) = part.links(*operation, capacities.len());
        // what is not there exchanges nothing, whatever it could hold
        let there = |capacity: f64| if capacity > 0.0 { capacity } else { 1.0 };
        capacities.extend(part.capacities.map(there));
        links.extend(own);
        grounds.extend(to_surroundings);
    }
    (capacities, links, grounds)
}

#[cfg(test)]
mod tests {
    use super::*;
    use physics::hertz::{BallRace, Race};
    use physics::materials::{BEARING_STEEL, contact_modulus};

    /// A 6005.
    fn bearing() -> BearingNetwork {
        let modulus = contact_modulus(BEARING_STEEL, BEARING_STEEL);
        let contact = |race, groove_curvature| {
            let shape = BallRace {
                ball_diameter: 6.35e-3,
                pitch_diameter: 36e-3,
                groove_curvature,
                contact_angle: 0.0,
                race,
            };
            PointContact::new(shape.curvature(), modulus).unwrap()
        };
        BearingNetwork {
            capacities: [100.0, 12.0, 4.8, 3.0, 5.0, 17.0, 200.0, 1700.0, 50.0],
            balls: 10.0,
            ball_mass: 1.05e-3,
            ball_diameter: 6.35e-3,
            pitch_diameter: 36e-3,
            width: 12e-3,
            contacts: [contact(Race::Inner, 0.515), contact(Race::Outer, 0.525)],
            ball: STEEL_HEAT,
            film: 0.3e-6,
            landing: Passage::Given(0.1),
            outer_seat: Passage::Given(6.0),
            surroundings: Passage::Given(0.9),
            rotor_surroundings: Passage::Given(0.0),
            to_core: 40.0,
            mount: [1.0, 0.0],
            ambient: 25.0,
        }
    }

    fn at(speed: f64, loads: &[f64]) -> Operation<'_> {
        Operation {
            speed,
            landing: Landing::rolls(0.0),
            loads,
            viscosity: 2e-5,
            temperatures: &[25.0; NODES.len()],
        }
    }

    #[test]
    fn a_loaded_ball_conducts_as_the_printed_example_and_an_unloaded_one_not_at_all() {
        // 100 N at 8.7 m/s with 0.3 µm of oil: 0.045 to 0.08 W/K
        let bearing = bearing();
        let gamma = 6.35f64 / 36.0;
        let speed = 8.7 / (0.25 * 36e-3 * (1.0 - gamma * gamma));
        let [inner, outer] = bearing.races(at(speed, &[100.0]));
        assert!((0.045..0.08).contains(&inner), "{inner}");
        assert!((0.045..0.09).contains(&outer), "{outer}");
        let [none, pressed] = bearing.races(at(speed, &[0.0]));
        assert!(none == 0.0 && pressed > 0.0);
        assert_eq!(bearing.races(at(0.0, &[0.0])), [0.0; 2]);
        // turning conducts better than standing
        assert!(inner > bearing.races(at(0.0, &[100.0]))[0]);
    }

    #[test]
    fn a_layer_and_its_core_come_to_one_temperature_with_their_conductance() {
        let mut network = BearingNetwork {
            landing: Passage::Given(0.0),
            ..bearing()
        };
        network.capacities[ROTOR] = 1800.0;
        network.with_layer(100.0, 40.0);
        assert_eq!(network.capacities[ROTOR_CORE], 1700.0);
        let standing = network.at(at(0.0, &[0.0])).unwrap();
        let mut nodes = [25.0; NODES.len()];
        nodes[ROTOR] = 43.0;
        standing.advance(&mut nodes, &[0.0; NODES.len()], 1.5);
        // the difference decays with G (1/C + 1/C'), and nothing leaves
        let left = 18.0 * f64::exp(-1.5 * 40.0 * (1.0 / 100.0 + 1.0 / 1700.0));
        assert!((nodes[ROTOR] - nodes[ROTOR_CORE] - left).abs() < 1e-9);
        let held = 100.0 * (nodes[ROTOR] - 25.0) + 1700.0 * (nodes[ROTOR_CORE] - 25.0);
        assert!((held / 1800.0 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_jacobian_of_closing_rings_is_the_slope_of_what_the_temperatures_do() {
        use crate::clearance::ThermalClearance;
        use crate::load_zone::LoadZone;
        use crate::steady_speed::SteadySpeed;
        use crate::warm_bearing::{BearingLoad, WarmBearings};
        use physics::load_zone::cosines;
        use physics::palmgren::Palmgren;
        use physics::viscosity::Viscosity;
        let network = bearing();
        let zone = LoadZone {
            load: 118.0,
            stiffness: 8.35e9,
            radial: 1.0,
            cosines: cosines(10),
            clearance: ThermalClearance {
                at_reference: 12.9e-6,
                reference: 25.0,
                tracks: [29.65e-3, 42.35e-3],
                ball: 6.35e-3,
                expansions: [11.5e-6; 3],
            },
            nodes: [INNER_RACE, BALLS, OUTER_RACE],
            seats: [None; 2],
            growth: 0.0,
        };
        let share = |node: usize| (0..NODES.len()).map(|k| f64::from(k == node)).collect();
        let losses = WarmBearings {
            count: 1.0,
            ratio: 1.0,
            moment: Palmgren {
                viscous_factor: 1.1,
                viscosity: 1e-4,
                pitch_diameter: 36e-3,
                load_factor: 0.0007,
                load_exponent: 0.5,
                static_load_rating: 6550.0,
                preload: 0.0,
            },
            oil: Viscosity::through((313.15, 100e-6), (373.15, 11e-6)).unwrap(),
            load: BearingLoad::Zone {
                unpreloaded: zone.loads(0.0).iter().sum(),
                zone: zone.clone(),
            },
            windage: 0.0,
            lubricant: LUBRICANT,
            shares: [share(LUBRICANT), share(BALLS)],
        };
        let there = [92.0, 92.0, 80.0, 75.0, 85.0, 40.0, 30.0, 90.0, 25.0];
        assert!(zone.clearance_at(&there, 2094.0) < -5e-6);
        let with = |temperatures: &[f64], act: &dyn Fn(Operation<'_>) -> Vec<f64>| {
            act(Operation {
                speed: 2094.0,
                landing: Landing::rolls(118.0),
                loads: &zone.loads(zone.clearance_at(temperatures, 2094.0)),
                viscosity: losses
                    .oil
                    .held(temperatures[LUBRICANT] + physics::viscosity::ICE_POINT),
                temperatures,
            })
        };
        let machine = |network: Network| SteadySpeed {
            network,
            losses: losses.clone(),
            speed: 2094.0,
            tolerance: 1.0,
        };
        // what the machine does in a short time, from anywhere, with the conductances of there
        const SHORT: f64 = 1e-5;
        let change = |from: &[f64]| {
            with(from, &|operation| {
                let machine = machine(network.at(operation).unwrap());
                let mut to = from.to_vec();
                machine
                    .network
                    .advance(&mut to, &machine.powers(from), SHORT);
                to.iter().zip(from).map(|(a, b)| (a - b) / SHORT).collect()
            })
        };
        let now = with(&there, &|operation| {
            let machine = machine(network.at(operation).unwrap());
            let passes =
                |moved: &[f64]| with(moved, &|moved| relaxing(&[(&network, moved)], &there));
            let jacobian = machine.jacobian(&there, &passes);
            let largest = jacobian.amax();
            for column in 0..NODES.len() {
                let moved = |by: f64| {
                    let mut moved = there;
                    moved[column] += by;
                    change(&moved)
                };
                for (row, (above, below)) in moved(0.05).iter().zip(moved(-0.05)).enumerate() {
                    let slope = (above - below) / 0.1;
                    // rounding of temperatures over the short time, 1e-14 · 100 K/(1e-5 s · 0.1 K), and what decays in it, 1e-5 of the rates
                    let off = jacobian[(row, column)] - slope;
                    assert!(
                        off.abs() < 1e-4 * largest,
                        "{row} {column}: {off} of {slope}"
                    );
                }
            }
            vec![machine.growth(&there), machine.growth_of(&there, &passes)]
        });
        // balls that are pressed harder conduct more: it is further from running away than with constant conductances
        assert!(now[1] < now[0], "{now:?}");
    }

    #[test]
    fn what_is_not_there_exchanges_nothing() {
        let mut network = bearing();
        for node in [CAGE, ROTOR_CORE, MOUNT] {
            network.capacities[node] = 0.0;
        }
        let mut nodes = [90.0, 80.0, 70.0, 10.0, 60.0, 50.0, 40.0, 10.0, 10.0];
        let turning = network.at(at(1000.0, &[20.0; 10])).unwrap();
        turning.advance(&mut nodes, &[0.0; NODES.len()], 100.0);
        for node in [CAGE, ROTOR_CORE, MOUNT] {
            assert!((nodes[node] - 10.0).abs() < 1e-9, "{node}");
        }
        assert!(nodes[INNER_RACE] < 79.0);
    }

    #[test]
    fn heat_runs_from_the_races_to_the_surroundings_and_never_uphill() {
        let network = bearing().at(at(1000.0, &[20.0; 10])).unwrap();
        let mut powers = [0.0; NODES.len()];
        powers[LUBRICANT] = 5.0;
        let steady = network.steady(&powers).unwrap();
        assert!(steady[LUBRICANT] > steady[OUTER_RACE]);
        assert!(steady[OUTER_RACE] > steady[HOUSING]);
        // all of it leaves through the housing
        assert!((0.9 * (steady[HOUSING] - 25.0) - 5.0).abs() < 1e-9);
        // nothing is colder than where the heat goes
        assert!(steady.iter().all(|node| *node > 25.0));
    }
}
