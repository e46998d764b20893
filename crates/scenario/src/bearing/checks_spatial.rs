//! Checks of bearings in space, and of a thrust that no bearing carries.

use crate::bearing::Bearing;
use crate::bearing::kind::BearingType;
use crate::bearing::moment::Moment;
use crate::bearing::separation::{Guidance, Separation};
use crate::bearing::spatial::Arrangement;
use crate::checks::{Check, Context};
use crate::drop::{AuxiliaryBearing, Body, Drop};
use problem::Code;

const FIDELITY: &str = "bearing.fidelity";

/// Keys outside `[bearing]` that only a bearing in space has.
const OF_SPACE: [&str; 8] = [
    "contact.gap_to_end",
    "contact.gap_to_start",
    "contact.face_radius",
    "contact.face_width",
    "contact.face_stiffness",
    "mount.axial_stiffness",
    "mount.axial_damping",
    "mount.tilt_stiffness",
];

/// Gravity that no inclination makes, m/s²: 3 % above that of the Earth.
const MOST_GRAVITY: f64 = 10.1;
/// Keys that only a preload spring has.
const OF_SPRING: [&str; 3] = [
    "bearing.preload_spring_side",
    "bearing.preload_spring_travel",
    "bearing.preload_spring_mass",
];

impl Context<'_> {
    /// What is not computed of a bearing in space, and what its rows need.
    pub fn spatial(&self, bearing: &Bearing) -> Check {
        let Some(own) = &bearing.spatial else {
            return Ok(());
        };
        let (refuse, kept) = (
            |path: &str, needed: &str| self.refuse_value(Code::Conflict, path, needed),
            "is needed beside bearing.fidelity = \"spatial\"",
        );
        if !self.values.system().bends() {
            let needed = "\"spatial\" is computed where system = \"machine\": there the rotor moves along its axis and tilts; \"planar\" is needed here";
            return self.refuse_value(Code::NotModelled, FIDELITY, needed);
        }
        if matches!(bearing.separation, Separation::FullComplement(_)) {
            return refuse("bearing.separation", &format!("\"cage\" {kept}"));
        }
        if matches!(bearing.moment, Moment::Palmgren { printed: true, .. }) {
            let needed = format!("\"palmgren\" {kept}: the printed form knows no axial load");
            return refuse("bearing.moment.law", &needed);
        }
        if bearing.lubricant_state.is_some() {
            let needed = format!("no [bearing.lubricant_state] {kept}");
            return refuse("bearing.lubricant_state.kind", &needed);
        }
        let angular = bearing.kind == BearingType::AngularContact;
        let clearance = "bearing.operating_diametral_clearance";
        if angular && bearing.operating_diametral_clearance != 0.0 {
            let needed = "0 m is needed: of an angular contact bearing in space bearing.contact_angle says how its grooves stand, and bearing.axial_preload how they are pressed";
            return refuse(clearance, needed);
        }
        if !angular && bearing.operating_diametral_clearance < 0.0 {
            let needed = "0 m or more is needed: grooves of a deep groove bearing in space that are pressed radially have no contact angle";
            return refuse(clearance, needed);
        }
        if (own.shoulder_height).is_some_and(|height| height >= 0.5 * bearing.ball_diameter) {
            let needed =
                "less than the radius of a ball is needed: no ball comes into a deeper groove";
            return refuse("bearing.shoulder_height", needed);
        }
        if let (None, Some(key)) = (
            own.spring,
            OF_SPRING.into_iter().find(|key| self.values.is_given(key)),
        ) {
            let found = "a key that has no effect";
            let needed = "bearing.preload_spring_stiffness is needed beside it: without a spring rows are pressed by a distance";
            return self.refuse(Code::UnusedKey, key, found, needed);
        }
        let arrangement = "bearing.arrangement";
        let named = self
            .values
            .record
            .as_ref()
            .and_then(|own| own.arrangement());
        if let Some(named) = named.filter(|own| self.text(arrangement) != *own) {
            let needed = format!(
                "\"{named}\" is needed, as bearing.name = {} says",
                self.text("bearing.name")
            );
            return refuse(arrangement, &needed);
        }
        if own.arrangement == Arrangement::Single {
            if bearing.axial_preload > 0.0 {
                let needed = "bearing.arrangement = \"DB\" or \"DF\" is needed: nothing presses a single row but the rotor's thrust";
                return refuse("bearing.axial_preload", needed);
            }
            return Ok(());
        }
        if !angular {
            let needed = "\"single\" is needed of bearings without a contact angle (bearing.type = \"angular contact\" has one)";
            return refuse(arrangement, needed);
        }
        if own.row_spacing > 0.0 && own.row_spacing < bearing.ball_diameter {
            let needed = "the diameter of a ball at least is needed: rows stand side by side";
            return refuse("bearing.row_spacing", needed);
        }
        if own.row_spacing <= 0.0 {
            let found = format!("{} without bearing.row_spacing", self.text(arrangement));
            let needed = "the distance of the rows is needed, which is their width where they stand side by side";
            return self.refuse(Code::MissingKey, arrangement, found, needed);
        }
        match (own.arrangement.preloads(), bearing.axial_preload > 0.0) {
            (false, true) => refuse(
                "bearing.axial_preload",
                "none is needed of a tandem, whose rows do not press on each other",
            ),
            (true, false) => {
                let found = format!("{} without bearing.axial_preload", self.text(arrangement));
                let needed =
                    "a preload above 0 N is needed: without it the rows are unloaded at rest";
                self.refuse(Code::MissingKey, arrangement, found, needed)
            }
            _ => Ok(()),
        }
    }

    /// What is not computed of a machine whose rotor moves along its axis.
    pub(crate) fn part_in_space(&self, part: &AuxiliaryBearing) -> Check {
        let in_space = |part: &AuxiliaryBearing| {
            (part.bearing.as_ref()).is_some_and(|own| own.spatial.is_some())
        };
        if !in_space(part) {
            let given = |path: &&str| self.values.number(path).is_some();
            return match OF_SPACE.into_iter().find(given) {
                Some(path) => {
                    let found = "a key that has no effect";
                    let needed = "it is used only with bearing.fidelity = \"spatial\": only a bearing in space moves along its axis";
                    self.refuse(Code::UnusedKey, path, found, needed)
                }
                None => Ok(()),
            };
        }
        let refuse = |path: &str, needed: &str| self.refuse_value(Code::Conflict, path, needed);
        let centred = part.bearing.as_ref().is_some_and(|own| {
            matches!(&own.separation, Separation::Cage(cage) if cage.guidance == Guidance::Centred)
        });
        if part.mount.tilt.is_some() && centred {
            let needed = "\"balls\", \"inner land\" or \"outer land\" is needed beside mount.tilt_stiffness: a cage that is centred on the outer ring keeps its orientation";
            return refuse("bearing.cage.guidance", needed);
        }
        // between the bore and the balls: the face of the inner ring
        let pitch = part
            .bearing
            .as_ref()
            .map_or(f64::INFINITY, |own| own.pitch_diameter);
        let ring = 0.5 * part.contact.bore_diameter..0.5 * pitch;
        if let Some(radius) = part.contact.faces.radius.filter(|own| !ring.contains(own)) {
            let found = format!(
                "{:.2} mm, where no shoulder meets a face of the inner ring",
                1e3 * radius
            );
            let needed = format!(
                "{:.2} to {:.2} mm is needed, between the bore and the balls",
                1e3 * ring.start,
                1e3 * ring.end
            );
            return self.refuse(Code::OutOfRange, "contact.face_radius", found, needed);
        }
        let ball = (part.bearing.as_ref()).map_or(f64::INFINITY, |own| own.ball_diameter);
        let faces = &part.contact.faces;
        let gaps = OF_SPACE
            .into_iter()
            .zip([faces.gap_to_end, faces.gap_to_start]);
        if let Some((gap, _)) = gaps
            .into_iter()
            .find(|(_, gap)| gap.is_some_and(|gap| gap >= ball))
        {
            let needed = "less than the diameter of a ball is needed: a rotor that moves farther along its axis leaves its bearings";
            return refuse(gap, needed);
        }
        let spring = (part.bearing.as_ref()).and_then(|own| own.spatial?.spring);
        if let Some(spring) = spring {
            const STIFFNESS: &str = "bearing.preload_spring_stiffness";
            if part.mount.tilt.is_some() {
                let needed = "none is needed beside mount.tilt_stiffness: outer rings that slide against a spring keep their orientation";
                return refuse(STIFFNESS, needed);
            }
            if spring.mass >= part.mount.moving_mass {
                let found = format!("{} kg of outer rings that slide", spring.mass);
                let needed = format!(
                    "less than mount.moving_mass = {} kg is needed: they are a part of it (without bearing.preload_spring_mass they have that of the inner rings)",
                    part.mount.moving_mass
                );
                return self.refuse(Code::Conflict, STIFFNESS, found, needed);
            }
        }
        if self.values.text("mount.on").is_some() {
            let needed = "a mount on ground is needed beside bearing.fidelity = \"spatial\"";
            return refuse("mount.on", needed);
        }
        Ok(())
    }

    /// A thrust that something carries: the weight along the shaft by a bearing with a face in its way.
    pub(crate) fn thrust(&self, drop: &Drop) -> Check {
        const AXIAL: &str = "gravity.axial";
        let bearings = || drop.auxiliary_bearings.iter();
        let in_space = |part: &&AuxiliaryBearing| {
            (part.bearing.as_ref()).is_some_and(|own| own.spatial.is_some())
        };
        let any = bearings().any(|part| in_space(&part));
        if !any {
            let keys = [
                AXIAL,
                "levitation.axial_stiffness",
                "levitation.axial_damping",
                "rotor.axial_clearance",
            ];
            let given = |path: &&str| self.values.number(path).is_some_and(|value| value != 0.0);
            let forces = match &drop.body {
                Body::Flexible(shaft) => &shaft.rotor.forces[..],
                _ => &[],
            };
            if let Some(force) = forces.iter().find(|force| force.has_thrust()) {
                let path = match &force.record {
                    Some(_) => format!("{}.channel_z", force.path),
                    None => format!("{}.z", force.path),
                };
                let needed = "a bearing with bearing.fidelity = \"spatial\" is needed beside it: planar ones carry no thrust";
                return self.refuse_value(Code::Conflict, &path, needed);
            }
            return match keys.into_iter().find(given) {
                Some(path) => {
                    let needed = "a bearing with bearing.fidelity = \"spatial\" is needed beside it: planar ones carry no thrust";
                    self.refuse_value(Code::Conflict, path, needed)
                }
                None => Ok(()),
            };
        }
        let axial = drop.gravity.axial;
        let both = drop.gravity.acceleration.hypot(axial);
        if both > MOST_GRAVITY && !self.values.is_given("gravity.acceleration") {
            let found = format!("{} without gravity.acceleration", self.text(AXIAL));
            let needed = format!(
                "what is left of gravity across the shaft is needed, 0 m/s^2 of an upright one: with its default of 9.81 m/s^2 the rotor has {both:.1} m/s^2"
            );
            return self.refuse(Code::MissingKey, AXIAL, found, needed);
        }
        let key = match axial < 0.0 {
            true => "contact.gap_to_start",
            false => "contact.gap_to_end",
        };
        let stops = |part: &AuxiliaryBearing| match axial < 0.0 {
            true => part.contact.faces.gap_to_start,
            false => part.contact.faces.gap_to_end,
        };
        if axial != 0.0
            && !bearings()
                .filter(in_space)
                .any(|part| stops(part).is_some())
        {
            let found = format!("{} without {key} of a bearing in space", self.text(AXIAL));
            let needed = "a shoulder that meets a face is needed: nothing else holds the rotor along its axis, and it would fall through its bearings";
            return self.refuse(Code::MissingKey, AXIAL, found, needed);
        }
        Ok(())
    }
}
