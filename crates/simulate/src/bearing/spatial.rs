//! From a bearing of a scenario to one in space.

use crate::bearing::build::shared_moment;
use crate::bearing::contacts::BallContacts;
use crate::bearing::traction::traction;
use model::contact::JournalContact;
use model::spatial::ball::SpatialBall;
use model::spatial::face::Face;
use model::spatial::face_heat::FaceSurfaces;
use model::spatial::mount::SpatialMount;
use model::spatial::part::SpatialBearing;
use model::spatial::pocket::SpatialPocket;
use model::spatial::rigid_body::Inertia;
use model::spatial::{
    CageConstants, CageGuide, LandingConstants, PreloadSpring, RowConstants, RowGeometry,
    SpatialLand,
};
use number::Vec3;
use physics::contact_nodes::{ContactNode, legendre, matched, middle};
use physics::groove::{centre_distance, free_contact_angle};
use physics::hertz::PointContact;
use physics::rolling::RollingSet;
use problem::{Code, Problem};
use scenario::{
    AuxiliaryBearing, Bearing, BearingType, Cage, ContactNodes, Guidance, Land, Separation,
    Spatial, problem_at,
};
use std::f64::consts::TAU;
use thermal::layer::Layer;

/// Transverse over axial inertia of a cage: a thin ring has 0.5, its width adds a little.
const CAGE_TRANSVERSE: f64 = 0.55;
/// Half the distance of the stations of a land, m.
const HALF_LAND: f64 = 2e-3;
/// Width of a row over its ball diameter where the bearing's is not known.
const WIDTH: f64 = 1.6;
/// Stiffness, N/m, and damping, s/m, of a spring that is solid: assumed, those of a shoulder on a face.
const SOLID: [f64; 2] = [2e8, 0.5];
/// Nodes of a face: tilt stiffness and friction torque of a ring of contact need eight.
const FACE_NODES: usize = 12;

/// A bearing in space at no node yet, with gravity in the frame of the machine.
pub(crate) fn bearing(
    part: &AuxiliaryBearing,
    (given, own): (&Bearing, &Spatial),
    contacts: &BallContacts,
    gravity: Vec3<f64>,
) -> Result<SpatialBearing, Box<Problem>> {
    let geometry = geometry(given, own, contacts);
    let ends = own.shoulder_height.map(|height| {
        geometry
            .curvatures
            .map(|f| (1.0 - height / (f * given.ball_diameter)).acos())
    });
    if let Some(end) =
        ends.and_then(|ends| ends.into_iter().find(|end| geometry.free_angle >= *end))
    {
        let found = format!(
            "a contact angle of {:.1} deg at rest",
            geometry.free_angle.to_degrees()
        );
        let allowed = format!(
            "a higher shoulder is needed: with bearing.shoulder_height the groove ends at {:.1} deg",
            end.to_degrees()
        );
        return Err(problem_at(
            Code::OutOfRange,
            "bearing.shoulder_height",
            found,
            allowed,
        ));
    }
    let rows = rows((given, own), contacts, gravity)?;
    let count = rows.len() as f64;
    let width = (own.row_width).unwrap_or(WIDTH * given.ball_diameter);
    let whole = (count - 1.0) * own.row_spacing + width;
    let [mass, inertia] = given.inner_race();
    let (zero, tilt) = (0.0, part.mount.tilt);
    Ok(SpatialBearing {
        set: RollingSet {
            balls_mass: count * given.rolling_set().balls_mass,
            ..given.rolling_set()
        },
        spring: spring(given),
        rotation: vec![0.0],
        lever: 0.0,
        inner_transverse: 0.5 * inertia + mass * whole * whole / 12.0,
        outer_inertias: tilt.map(|own| {
            let radius = 0.5 * (given.pitch_diameter + 1.5 * given.ball_diameter);
            let across =
                (own.tilt_inertia).unwrap_or(0.5 * part.mount.moving_mass * radius * radius);
            [2.0 * across, across]
        }),
        mount: SpatialMount {
            radial_stiffness: zero,
            axial_stiffness: part.mount.axial_stiffness,
            radial_damping: zero,
            axial_damping: part.mount.axial_damping,
            tilt_stiffness: tilt.map_or(zero, |own| own.tilt_stiffness),
            turn_damping: tilt.map_or(zero, |own| own.tilt_damping),
            torsion_stiffness: tilt.map_or(zero, |own| own.torsion_stiffness),
            free_position: Vec3::zero(),
        },
        first_ball_angle: given.first_ball_angle,
        landing: landing(part, given, whole),
        groove_ends: ends,
        face_surfaces: face_surfaces(part, given),
        races: Some(contacts.races(given)),
        rows,
    })
}

/// What presses the rows of one side, where a spring does.
pub(crate) fn spring(given: &Bearing) -> Option<PreloadSpring<f64>> {
    let own = given.spatial?.spring?;
    let [stop_stiffness, stop_damping] = SOLID;
    Some(PreloadSpring {
        side: own.side.sign(),
        preload: given.axial_preload,
        stiffness: own.stiffness,
        travel: own.travel.unwrap_or(f64::INFINITY),
        stop_stiffness,
        stop_damping,
        mass: own.mass,
    })
}

/// Its rows at the temperature of the start, with gravity in the frame of the machine.
pub(crate) fn rows(
    (given, own): (&Bearing, &Spatial),
    contacts: &BallContacts,
    gravity: Vec3<f64>,
) -> Result<Vec<RowConstants>, Box<Problem>> {
    let geometry = geometry(given, own, contacts);
    let closed = match given.axial_preload > 0.0 {
        true => geometry.closed_by(given.axial_preload).ok_or_else(|| {
            let found = format!("{} N, which no contact angle carries", given.axial_preload);
            let allowed = "a smaller preload is needed";
            problem_at(Code::Impossible, "bearing.axial_preload", found, allowed)
        })?,
        false => [0.0; 2],
    };
    let Separation::Cage(cage) = &given.separation else {
        let allowed = "\"cage\" is needed of a bearing in space";
        return Err(problem_at(
            Code::NotModelled,
            "bearing.separation",
            "none",
            allowed,
        ));
    };
    let law = traction(given, contacts)?;
    let moment = shared_moment(given)?;
    let nodes = nodes(own.nodes, contacts);
    Ok(geometry
        .grooves(closed)
        .into_iter()
        .map(|(place, [inner, outer])| RowConstants {
            balls: given.ball_count,
            ball: SpatialBall {
                radius: 0.5 * given.ball_diameter,
                mass: contacts.ball_mass,
                inner,
                inner_growth: given.inner_track_growth(),
                outer,
                damping_time: given.contact_damping_time,
                orbit_drag: given.drag.orbit,
                spin_drag: given.drag.spin,
                gravity,
                pocket: pocket(given, cage),
            },
            nodes: nodes.clone(),
            traction: law,
            moment: moment.clone(),
            cage: CageConstants {
                inertia: Inertia {
                    mass: cage.mass,
                    axial: cage.inertia,
                    transverse: CAGE_TRANSVERSE * cage.inertia,
                },
                drag: given.drag.cage,
                guide: guide(&cage.guidance, place),
            },
        })
        .collect())
}

fn geometry(given: &Bearing, own: &Spatial, contacts: &BallContacts) -> RowGeometry {
    let curvatures = [given.inner_groove_curvature, given.outer_groove_curvature];
    let angular = given.kind == BearingType::AngularContact;
    let distance = centre_distance(curvatures, given.ball_diameter);
    RowGeometry {
        signs: match angular {
            true => own.signs(),
            false => vec![0.0],
        },
        spacing: own.row_spacing,
        balls: given.ball_count,
        ball_diameter: given.ball_diameter,
        pitch_diameter: given.pitch_diameter,
        curvatures,
        free_angle: match angular {
            true => given.contact_angle,
            false => free_contact_angle(given.operating_diametral_clearance, distance),
        },
        contacts: [
            PointContact {
                stiffness: contacts.inner_stiffness,
                ..contacts.inner
            },
            PointContact {
                stiffness: contacts.outer_stiffness,
                ..contacts.outer
            },
        ],
    }
}

fn nodes(asked: ContactNodes, contacts: &BallContacts) -> Vec<ContactNode<f64>> {
    match asked {
        ContactNodes::Matched => {
            matched(0.5 * (contacts.inner.ellipticity + contacts.outer.ellipticity))
        }
        ContactNodes::One => middle(),
        ContactNodes::Three => legendre(3),
        ContactNodes::Five => legendre(5),
        ContactNodes::Nine => legendre(9),
    }
}

fn pocket(given: &Bearing, cage: &Cage) -> SpatialPocket<f64> {
    SpatialPocket {
        circle: 0.5 * given.pitch_diameter,
        gap: cage.pocket_gap,
        stiffness: match cage.pocket_contact {
            true => cage.pocket_stiffness,
            false => 0.0,
        },
        damping: cage.pocket_damping,
        friction: cage.pocket_friction_coefficient,
        inverse_reference_speed: 1.0 / cage.pocket_friction_reference_speed,
    }
}

/// What guides the cage of a row at a place along the axis, m.
fn guide(guidance: &Guidance, place: f64) -> CageGuide<f64> {
    let on = |land: &Land, bore: f64, middle: f64| SpatialLand {
        contact: JournalContact {
            radial_clearance: land.radial_clearance,
            bore_radius: bore,
            stiffness: 0.5 * land.stiffness,
            exponent: 1.0,
            damping: land.damping,
            friction: land.friction_coefficient,
            inverse_reference_speed: 1.0 / land.friction_reference_speed,
        },
        middle,
        half_width: HALF_LAND,
    };
    match guidance {
        Guidance::Centred => CageGuide::Tied,
        Guidance::Balls => CageGuide::Balls,
        // the cage has the bore
        Guidance::InnerLand(land) => {
            CageGuide::InnerLand(on(land, 0.5 * land.diameter + land.radial_clearance, 0.0))
        }
        Guidance::OuterLand(land) => CageGuide::OuterLand(on(land, 0.5 * land.diameter, place)),
    }
}

/// Stations at the edges of the landing surface, or one in the middle; faces at both sides of the inner ring.
fn landing(part: &AuxiliaryBearing, given: &Bearing, width: f64) -> LandingConstants {
    let contact = &part.contact;
    let stations = match contact.width {
        Some(width) => vec![-0.5 * width, 0.5 * width],
        None => vec![0.0],
    };
    let bore = 0.5 * contact.bore_diameter;
    let faces = &contact.faces;
    let half = 0.5 * width;
    let face = |side: f64, gap: f64| Face {
        side,
        shoulder: side * (half + gap),
        place: side * half,
        radius: face_radius(part, given),
        stiffness: faces.stiffness,
        damping: contact.damping,
        friction: contact.friction_coefficient,
        inverse_reference_speed: 1.0 / contact.friction_reference_speed,
    };
    // a rotor that moves to the end brings the shoulder below the ring to it
    let both = [(-1.0, faces.gap_to_end), (1.0, faces.gap_to_start)];
    let angle = |k: usize| TAU * k as f64 / FACE_NODES as f64;
    LandingConstants {
        contact: JournalContact {
            radial_clearance: contact.radial_air_clearance,
            bore_radius: bore,
            stiffness: contact.stiffness / stations.len() as f64,
            exponent: contact.exponent,
            damping: contact.damping,
            friction: contact.friction_coefficient,
            inverse_reference_speed: 1.0 / contact.friction_reference_speed,
        },
        stations,
        faces: both
            .into_iter()
            .filter_map(|(side, gap)| Some(face(side, gap?)))
            .collect(),
        face_nodes: (0..FACE_NODES)
            .map(|k| [angle(k).cos(), angle(k).sin()])
            .collect(),
    }
}

/// Mean radius of the faces, m: in the middle between bore and inner track where it is not given.
fn face_radius(part: &AuxiliaryBearing, given: &Bearing) -> f64 {
    let bore = 0.5 * part.contact.bore_diameter;
    let middle = 0.5 * (bore + given.inner_track_radius());
    part.contact.faces.radius.unwrap_or(middle)
}

/// Shoulder and face as layers that heat.
fn face_surfaces(part: &AuxiliaryBearing, given: &Bearing) -> Option<FaceSurfaces> {
    let contact = &part.contact;
    if !contact.faces.any() {
        return None;
    }
    let radius = face_radius(part, given);
    let whole = 2.0 * (radius - 0.5 * contact.bore_diameter).abs();
    let depth = contact.rotor_layer_depth();
    Some(FaceSurfaces {
        layers: (contact.metals.each_ref()).map(|metal| Layer::new(metal.material, depth)),
        area: TAU * radius * contact.faces.width.unwrap_or(whole),
    })
}
