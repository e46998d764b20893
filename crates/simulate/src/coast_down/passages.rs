//! The ways of heat from a bearing to rotor, housing and surroundings; the seats of its rings; the limits of its parts.

use physics::ring::PressFit;
use scenario::heat::{HOUSING_SIZE, Heat, ICE_POINT, STEEL_EXPANSION, Warm};
use thermal::bearing_network::{
    BALLS, CAGE, HOUSING, INNER_RACE, LUBRICANT, NODES, OUTER_RACE, ROTOR,
};
use thermal::clearance::Seat;
use thermal::passage::{Medium, Open, Passage, Pressed};

/// Limits of the nodes of the network that have one, °C.
pub(crate) fn limits(warm: &Warm) -> [Option<f64>; NODES.len()] {
    let heat = &warm.heat;
    let of = |limit: f64| Some(limit - ICE_POINT);
    let mut limits = [None; NODES.len()];
    for node in [INNER_RACE, BALLS, OUTER_RACE] {
        limits[node] = of(heat.race_limit);
    }
    if warm.cage_mass > 0.0 {
        limits[CAGE] = of(heat.cage_limit);
    }
    limits[LUBRICANT] = of(heat.lubricant_limit);
    limits
}

/// Seats of the rings whose fits are given; the inner one on the rotor, or on a sleeve that is one body with the ring.
pub(crate) fn seats(warm: &Warm) -> [Option<Seat>; 2] {
    let (heat, [shaft, housing]) = (&warm.heat, warm.fits);
    let seat = |fit: PressFit, nodes, expansions, growth: fn(&PressFit) -> f64| {
        let unit = PressFit {
            interference: 1.0,
            ..fit
        };
        Seat {
            interference: fit.interference,
            diameter: 2.0 * fit.joint_radius,
            nodes,
            expansions,
            closes: 2.0 * growth(&unit),
            presses: unit.pressure(),
            spins: fit.lost_by_spin(),
        }
    };
    let under = if warm.on_rotor { ROTOR } else { INNER_RACE };
    let shaft = shaft.map(|fit| {
        let expansions = [heat.shaft_expansion, STEEL_EXPANSION];
        seat(
            fit,
            [under, INNER_RACE],
            expansions,
            PressFit::outside_growth,
        )
    });
    let housing = housing.map(|fit| {
        let expansions = [STEEL_EXPANSION, heat.housing_expansion];
        seat(
            fit,
            [OUTER_RACE, HOUSING],
            expansions,
            PressFit::bore_shrinking,
        )
    });
    [shaft, housing]
}

/// Emissivity of a seat that is loose, where none is given. Source: bright steel, 0.1 to 0.3 (from memory).
const BRIGHT_STEEL: f64 = 0.2;

/// The way of the rotor's heat to its surroundings.
pub(crate) fn open_rotor(heat: &Heat) -> Passage {
    let given = Passage::Given(heat.rotor_surroundings.unwrap_or(0.0));
    let size = heat.rotor_diameter.zip(heat.rotor_area);
    match (heat.rotor_surroundings, size) {
        (None, Some(size)) => open(heat, size, heat.emissivity).unwrap_or(given),
        _ => given,
    }
}

/// The way of the housing's heat to its surroundings.
pub(crate) fn open_housing(heat: &Heat) -> Passage {
    let size = (HOUSING_SIZE * heat.outer_diameter, heat.housing_area);
    let given = heat.surroundings.map(Passage::Given);
    let open = given.or_else(|| open(heat, size, heat.housing_emissivity));
    open.unwrap_or(Passage::Given(0.0))
}

/// Gas and radiation around a cylinder of a diameter, m, and a surface, m²; none where there is neither.
fn open(heat: &Heat, (diameter, area): (f64, f64), emissivity: f64) -> Option<Passage> {
    heat.is_open(emissivity).then(|| {
        Passage::Open(Open {
            diameter,
            area,
            emissivity,
            pressure: heat.gas_pressure.unwrap_or(0.0),
        })
    })
}

/// What fills the gap of rotor and inner race.
pub(crate) fn medium(heat: &Heat) -> Medium {
    Medium {
        pressure: heat.gas_pressure.unwrap_or(0.0),
        emissivities: [heat.emissivity; 2],
    }
}

/// A ring on a seat whose fit is known; air where nothing is said of it, bright steel where no emissivity is.
pub(crate) fn pressed(heat: &Heat, seat: Seat) -> Passage {
    let emissivity = match heat.emissivity > 0.0 {
        true => heat.emissivity,
        false => BRIGHT_STEEL,
    };
    Passage::Pressed(Pressed {
        seat,
        reference: heat.start_temperature - ICE_POINT,
        length: heat.width,
        medium: Medium {
            pressure: heat.pressure(),
            emissivities: [emissivity; 2],
        },
    })
}
