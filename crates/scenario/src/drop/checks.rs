//! Checks of a drop.

use crate::bearing::Bearing;
use crate::bearing::separation::Separation;
use crate::checks::{Check, Context};
use crate::drop::{AuxiliaryBearing, Body, Drop, RigidBody, Spin};
use crate::heat::RotorBodies;
use crate::values::Values;
use catalogue::geometry::millimetres;
use physics::unbalance::whirl;
use problem::Code;

/// Standard deviations within which every perturbed start is taken to lie.
const SPREAD: f64 = 6.0;

impl Context<'_> {
    pub(crate) fn drop(&self, drop: &Drop, all: &[Values]) -> Check {
        self.planes()?;
        self.torques(drop)?;
        for (part, values) in drop.auxiliary_bearings.iter().zip(all) {
            let own = Context {
                values,
                file: self.file,
            };
            if let Some(bearing) = &part.bearing {
                own.one_row(bearing)?;
                let bore = part.contact.bore_diameter;
                own.bearing(bearing, Some(("contact.bore_diameter", bore)), true)?;
            }
            own.air_clearance(part)?;
            own.part_in_space(part)?;
            own.warms(drop, part)?;
            own.mount(part)?;
            if let Some(bearing) = &part.bearing {
                own.perturbed_balls(drop, bearing)?;
            }
            // what a flexible rotor does on its magnets is known when they are computed
            if let Body::Rigid(body) = &drop.body {
                own.levitated_orbit(drop, part, body)?;
            }
        }
        self.thrust(drop)?;
        let bearings = drop.auxiliary_bearings.iter();
        let bearings = bearings.filter_map(|part| part.bearing.as_ref());
        self.output(&drop.run, bearings.map(|bearing| bearing.ball_count).sum())
    }

    /// What temperatures need, and what a coast-down needs that follows the drop.
    fn warms(&self, drop: &Drop, part: &AuxiliaryBearing) -> Check {
        let refuse = |path: &str, needed: &str| self.refuse_value(Code::Conflict, path, needed);
        if let Some(warm) = &part.warm {
            if part.bearing.is_none() {
                let needed = "\"off\" is needed beside bearing.type = \"bushing\": the network is one of balls and races";
                return refuse("heat.network", needed);
            }
            self.warm(warm)?;
            if warm.heat.rotor_bodies == RotorBodies::LayerAndCore && part.contact.width.is_none() {
                let needed = "contact.width is needed beside it: without a landing surface there is no layer";
                return refuse("heat.rotor_bodies", needed);
            }
            if let Some(needed) = part.without_core() {
                return refuse("heat.rotor_capacity", &needed);
            }
            for (path, given) in [
                ("heat.mount_contact", warm.heat.mount_contact),
                ("heat.mount_surroundings", warm.heat.mount_surroundings),
            ] {
                if given > 0.0 && warm.heat.mount_capacity.is_none() {
                    let needed = "heat.mount_capacity is needed beside it: without one the mount is no body of its own";
                    return refuse(path, needed);
                }
            }
        }
        let known = part.warm.is_some() && part.contact.width.is_some();
        if !known && !part.contact.friction_over_temperature.is_empty() {
            let needed = "contact.width and heat.network = \"on\" are needed beside it: without them the temperature of the contact is not known";
            return refuse("contact.friction_over_temperature", needed);
        }
        if part.contact.wear_coefficient.is_some() && part.contact.width.is_none() {
            let needed =
                "contact.width is needed beside it: without a landing surface nothing is worn";
            return refuse("contact.surface.wear_coefficient", needed);
        }
        let Some(end) = &drop.coast_down else {
            return Ok(());
        };
        if drop.rotor.spin == Spin::Held {
            let needed = "run.until = \"duration\", or a rotor whose spin is not held: this one never stands";
            return refuse("run.until", needed);
        }
        if end.stop_speed >= drop.rotor.speed.abs() {
            let needed = "less than rotor.speed is needed";
            return refuse("coast_down.stop_speed", needed);
        }
        if drop.gravity.acceleration == 0.0 && drop.gravity.axial == 0.0 {
            let needed = "more than 0 is needed beside run.until = \"standstill\", or a gravity.axial other than 0 with a bearing in space: a rotor that no weight holds on its races or faces does not roll";
            return refuse("gravity.acceleration", needed);
        }
        let bearing = part.bearing.as_ref();
        if bearing.is_some_and(|bearing| bearing.lubricant_state.is_some()) {
            let needed = "no [bearing.lubricant_state] is needed beside run.until = \"standstill\": its grease does not age in quasi-steady steps";
            return refuse("bearing.lubricant_state.kind", needed);
        }
        match &part.warm {
            // what brakes a bearing in space is measured in its motion
            Some(_) if bearing.is_some_and(|own| own.spatial.is_some()) => Ok(()),
            Some(warm) => self.brakes(warm),
            None => {
                let needed = "heat.network = \"on\" is needed of every bearing that the rotor coasts down on: what brakes it depends on their temperatures";
                refuse("run.until", needed)
            }
        }
    }

    /// A share has something to be a share of; what drives a rotor leaves it no standstill.
    fn torques(&self, drop: &Drop) -> Check {
        const OVER_SPEED: &str = "rotor.torque_over_speed";
        const SHARE: &str = "rotor.torque_share_over_time";
        let rotor = &drop.rotor;
        if rotor.torque_over_speed.is_empty() && !rotor.torque_share_over_time.is_empty() {
            let needed = format!("{OVER_SPEED} beside it is needed");
            return self.refuse(Code::MissingKey, SHARE, "this alone", needed);
        }
        if let Some([fastest, _]) = rotor.torque_over_speed.last()
            && *fastest < rotor.speed.abs()
        {
            let needed = "a last row at the size of rotor.speed or above is needed: beyond it the torque is not known";
            return self.refuse_value(Code::Conflict, OVER_SPEED, needed);
        }
        if drop.coast_down.is_none() {
            return Ok(());
        }
        let drive = match &drop.body {
            Body::Flexible(shaft) => [shaft.drive_torque, shaft.drive_slope],
            Body::Rigid(_) => [0.0; 2],
        };
        let path = match drive {
            _ if rotor
                .torque_over_speed
                .iter()
                .any(|[_, torque]| *torque > 0.0) =>
            {
                OVER_SPEED
            }
            [torque, _] if torque > 0.0 => "rotor.drive_torque",
            [_, slope] if slope > 0.0 => "rotor.drive_slope",
            _ => return Ok(()),
        };
        let needed = "torques that brake are needed beside run.until = \"standstill\": a rotor that something drives may never stand";
        self.refuse_value(Code::Conflict, path, needed)
    }

    /// Planes count bearings that are alike; bearings with names are counted by their names and by planes of their own.
    pub fn planes(&self) -> Check {
        let planes = self.values.number("rotor.planes").unwrap_or(1.0);
        let bearings = self.values.rows / planes;
        if planes == 1.0 || bearings == 1.0 {
            return Ok(());
        }
        self.refuse(
            Code::Conflict,
            "rotor.planes",
            format!("{planes} beside {bearings} bearings in [[auxiliary_bearing]]"),
            "one of the two is needed: equal bearings by their number, others by their names",
        )
    }

    /// Keys that make one part of a mount stand together; a squeeze film is kept from closing by a stop.
    fn mount(&self, part: &AuxiliaryBearing) -> Check {
        const TOGETHER: [&[&str]; 5] = [
            &["mount.branch_stiffness", "mount.branch_time"],
            &["mount.ring_stiffness", "mount.ring_travel"],
            &[
                "mount.film_viscosity",
                "mount.film_radius",
                "mount.film_length",
                "mount.film_clearance",
            ],
            &["mount.stop_gap", "mount.stop_stiffness"],
            &["mount.housing_mass", "mount.housing_stiffness"],
        ];
        let there = |path: &str| {
            self.values.number(path).is_some() || !self.values.numbers(path).is_empty()
        };
        for paths in TOGETHER {
            let lacking = paths.iter().find(|path| !there(path));
            let given = paths.iter().find(|path| there(path));
            if let (Some(lacking), Some(given)) = (lacking, given) {
                return self.refuse(
                    Code::MissingKey,
                    given,
                    "this alone",
                    format!("{lacking} beside it is needed"),
                );
            }
        }
        let [stiffnesses, times] = ["mount.branch_stiffness", "mount.branch_time"]
            .map(|path| self.values.numbers(path).len());
        if stiffnesses != times {
            return self.refuse(
                Code::Conflict,
                "mount.branch_time",
                format!("{times} times for {stiffnesses} stiffnesses"),
                "one time for each Maxwell branch is needed",
            );
        }
        let parts = &part.mount.parts;
        let Some(clearance) = parts.film_clearance else {
            return Ok(());
        };
        if parts.stop_gap.is_some_and(|gap| gap < clearance) {
            return Ok(());
        }
        let allowed = "a hard stop with a smaller mount.stop_gap is needed: the film cannot carry a race that reaches its wall";
        self.refuse(
            Code::Conflict,
            "mount.film_clearance",
            millimetres(clearance),
            allowed,
        )
    }

    fn air_clearance(&self, part: &AuxiliaryBearing) -> Check {
        let contact = &part.contact;
        if contact.radial_air_clearance < 0.5 * contact.bore_diameter {
            return Ok(());
        }
        self.refuse_value(
            Code::ClearanceTooLarge,
            "contact.radial_air_clearance",
            format!(
                "less than half of contact.bore_diameter = {} is needed",
                self.text("contact.bore_diameter")
            ),
        )
    }

    /// A perturbed ball must stay in its pocket.
    fn perturbed_balls(&self, drop: &Drop, bearing: &Bearing) -> Check {
        let repeat = &drop.repeat;
        let shift = SPREAD * repeat.ball_angle_deviation * 0.5 * bearing.pitch_diameter;
        let (free, path) = match &bearing.separation {
            Separation::Cage(cage) => (cage.pocket_gap, "bearing.cage.pocket_gap"),
            Separation::FullComplement(_) => {
                (0.5 * bearing.gap_between_balls(), "bearing.ball_count")
            }
        };
        if repeat.count < 2 || shift <= free {
            return Ok(());
        }
        self.refuse_value(
            Code::OutOfRange,
            "repeat.ball_angle_deviation",
            format!(
                "at most a sixth of the {} that {path} = {} leaves a ball along the pitch circle is needed",
                millimetres(free),
                self.text(path)
            ),
        )
    }

    /// The geometric centre of the levitated rotor circles the centre of levitation; it must not touch before the release.
    fn levitated_orbit(&self, drop: &Drop, part: &AuxiliaryBearing, body: &RigidBody) -> Check {
        let (rotor, levitation) = (&drop.rotor, &drop.levitation);
        let mass = body.mass / drop.rows();
        let clearance = part.contact.radial_air_clearance;
        let offset = levitation.offset_x.hypot(levitation.offset_y);
        let (stiffness, damping) = (levitation.stiffness, levitation.damping);
        let eccentricity = body.unbalance_eccentricity;
        let (along, ahead) = whirl(stiffness, damping, mass, rotor.speed, eccentricity);
        let whirl = along.hypot(ahead);
        let [x, y] = rotor.start_displacement;
        let start = (levitation.offset_x + x).hypot(levitation.offset_y + y) + whirl;
        if start >= clearance && [x, y] != [0.0; 2] {
            return Err(self.problem(
                Code::ContactAtStart,
                "rotor.start_x",
                format!(
                    "a rotor that starts {} from the bearing centre, its whirl with it",
                    millimetres(start)
                ),
                format!(
                    "less than the radial air clearance {} is needed",
                    self.text("contact.radial_air_clearance")
                ),
            ));
        }
        let repeat = &drop.repeat;
        let (spread, narrowest) = if repeat.count > 1 {
            let narrowing = (-SPREAD * repeat.radial_air_clearance_deviation).exp();
            (
                SPREAD * repeat.rotor_position_deviation,
                narrowing * clearance,
            )
        } else {
            (0.0, clearance)
        };
        if offset + whirl < clearance && offset + whirl >= narrowest {
            let path = "repeat.radial_air_clearance_deviation";
            return self.refuse_value(
                Code::ContactAtStart,
                path,
                format!(
                    "less is needed: six deviations leave {}, and the levitated rotor takes {} of it",
                    millimetres(narrowest),
                    millimetres(offset + whirl)
                ),
            );
        }
        if offset + whirl < clearance && offset + whirl + spread >= clearance {
            return self.refuse_value(
                Code::ContactAtStart,
                "repeat.rotor_position_deviation",
                format!(
                    "less than a sixth of the {} that the levitated rotor leaves free is needed, so that no perturbed \
                     start touches",
                    millimetres(clearance - offset - whirl)
                ),
            );
        }
        if offset + whirl < clearance {
            return Ok(());
        }
        let resonance = (stiffness / mass).sqrt();
        let near = (0.7..1.4).contains(&(rotor.speed.abs() / resonance));
        let hint = near.then(|| {
            format!(
                "The levitation is near resonance: its natural frequency is {:.4e} rad/s and the speed {:.4e} rad/s",
                resonance,
                rotor.speed.abs()
            )
        });
        Err(self.problem(
                Code::ContactAtStart,
                "contact.radial_air_clearance",
                format!(
                    "a levitated rotor that reaches {} from the bearing centre (offset {}, whirl by unbalance {})",
                    millimetres(offset + whirl),
                    millimetres(offset),
                    millimetres(whirl)
                ),
                format!(
                    "less than the radial air clearance {} is needed, so that nothing touches before the drop",
                    self.text("contact.radial_air_clearance")
                ),
            )
            .with_hint(hint))
    }
}
