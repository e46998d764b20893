//! Checks between values: each refuses what no simulation could mean.

use super::drop::{Drop, Moment, Traction};
use super::resolve::Values;
use crate::problem::{Code, Problem};
use physics::traction::FourParameterTraction;
use physics::unbalance::whirl;

/// Most values of a history, in memory at the end of a run: 1.6 GB.
const MOST_VALUES: f64 = 2e8;
/// Values of a row that do not depend on the balls, kept twice: as states and as columns.
const VALUES_PER_ROW: f64 = 100.0;
/// Values of a row for each ball, likewise.
const VALUES_PER_BALL: f64 = 20.0;
/// Standard deviations within which every perturbed start is taken to lie.
const SPREAD: f64 = 6.0;

/// How far D may be from -A: the sum of two decimals of four digits.
const NO_TRACTION_AT_REST: f64 = 1e-9;

/// Tightest internal clearance, as a share of the ball diameter: beyond, the balls are pressed past any elastic law.
const MOST_PRELOAD: f64 = -0.01;
/// Widest internal clearance, as a share of the ball diameter.
const MOST_CLEARANCE: f64 = 0.1;

type Check = Result<(), Box<Problem>>;

/// Refuses values that contradict each other.
pub(super) fn check(drop: &Drop, values: &Values, file: &str) -> Check {
    let context = Context { drop, values, file };
    context.bearing_diameters()?;
    context.balls_fit()?;
    context.internal_clearance()?;
    context.air_clearance()?;
    context.traction()?;
    context.moment()?;
    context.output()?;
    context.perturbed_balls()?;
    context.levitated_orbit()
}

struct Context<'a> {
    drop: &'a Drop,
    values: &'a Values,
    file: &'a str,
}

impl Context<'_> {
    fn problem(&self, code: Code, path: &str, found: String, allowed: String) -> Problem {
        Problem::new(code, self.file, found, allowed)
            .at(self.values.place(path))
            .on_key(path)
    }

    /// The value as the file or catalogue writes it.
    fn text(&self, path: &str) -> String {
        self.values.text(path).unwrap_or_default()
    }

    fn bearing_diameters(&self) -> Check {
        let bearing = &self.drop.bearing;
        let (ball, pitch) = (bearing.ball_diameter, bearing.pitch_diameter);
        if pitch <= ball {
            return Err(Box::new(self.problem(
                Code::BearingGeometry,
                "bearing.pitch_diameter",
                self.text("bearing.pitch_diameter"),
                format!(
                    "more than bearing.ball_diameter = {} is needed",
                    self.text("bearing.ball_diameter")
                ),
            )));
        }
        let bore = self.drop.contact.bore_diameter;
        if bore >= pitch - ball {
            return Err(Box::new(self.problem(
                Code::BearingGeometry,
                "contact.bore_diameter",
                self.text("contact.bore_diameter"),
                format!(
                    "less than the track of the inner race is needed: pitch_diameter - ball_diameter = {}",
                    millimetres(pitch - ball)
                ),
            )));
        }
        Ok(())
    }

    fn balls_fit(&self) -> Check {
        let bearing = &self.drop.bearing;
        if bearing.ball_count < 2 {
            return Ok(());
        }
        let half_angle = std::f64::consts::PI / bearing.ball_count as f64;
        let spacing = bearing.pitch_diameter * half_angle.sin();
        if spacing >= bearing.ball_diameter {
            return Ok(());
        }
        let most = std::f64::consts::PI / (bearing.ball_diameter / bearing.pitch_diameter).asin();
        Err(Box::new(self.problem(
            Code::BallsDoNotFit,
            "bearing.ball_count",
            format!(
                "{} balls of {} on a pitch circle of {}, whose centres are only {} apart",
                bearing.ball_count,
                self.text("bearing.ball_diameter"),
                self.text("bearing.pitch_diameter"),
                millimetres(spacing)
            ),
            format!("at most {most:.0} balls fit", most = most.floor()),
        )))
    }

    /// Fits and clearances are micrometres: a value of the ball's own size is a slip of the unit.
    fn internal_clearance(&self) -> Check {
        let bearing = &self.drop.bearing;
        let share = bearing.operating_diametral_clearance / bearing.ball_diameter;
        if (MOST_PRELOAD..=MOST_CLEARANCE).contains(&share) {
            return Ok(());
        }
        let path = "bearing.operating_diametral_clearance";
        Err(Box::new(
            self.problem(
                Code::ClearanceTooLarge,
                path,
                self.text(path),
                format!(
                    "between {} and {} is needed, {:.0} % to {:.0} % of the ball diameter",
                    millimetres(MOST_PRELOAD * bearing.ball_diameter),
                    millimetres(MOST_CLEARANCE * bearing.ball_diameter),
                    100.0 * MOST_PRELOAD,
                    100.0 * MOST_CLEARANCE
                ),
            )
            .with_hint(Some(
                "bearing clearances are a few um, and diametral".to_string(),
            )),
        ))
    }

    fn air_clearance(&self) -> Check {
        let contact = &self.drop.contact;
        if contact.radial_air_clearance < 0.5 * contact.bore_diameter {
            return Ok(());
        }
        Err(Box::new(self.problem(
            Code::ClearanceTooLarge,
            "contact.radial_air_clearance",
            self.text("contact.radial_air_clearance"),
            format!(
                "less than half of contact.bore_diameter = {} is needed",
                self.text("contact.bore_diameter")
            ),
        )))
    }

    fn traction(&self) -> Check {
        match self.drop.bearing.traction {
            Traction::FourParameter { a, d, .. } if (a + d).abs() > NO_TRACTION_AT_REST => {
                Err(Box::new(self.problem(
                    Code::Conflict,
                    "bearing.traction.d",
                    units::number_text(d),
                    format!(
                        "d = -a = {} is needed, so that there is no traction without slip",
                        units::number_text(-a)
                    ),
                )))
            }
            Traction::FourParameter { a, b, c, d } => {
                let smallest = FourParameterTraction { a, b, c, d }.smallest();
                if smallest >= -NO_TRACTION_AT_REST {
                    return Ok(());
                }
                Err(Box::new(self.problem(
                    Code::Conflict,
                    "bearing.traction.law",
                    format!(
                        "four parameters whose coefficient falls to {smallest:.3e} at some slip, which would make energy"
                    ),
                    "a coefficient that is nowhere negative is needed: d >= 0, and b not below c·d".to_string(),
                )))
            }
            _ => Ok(()),
        }
    }

    fn moment(&self) -> Check {
        let bearing = &self.drop.bearing;
        if matches!(bearing.moment, Moment::Palmgren { .. }) && bearing.static_load_rating.is_none()
        {
            return Err(Box::new(self.problem(
                Code::MissingKey,
                "bearing.static_load_rating",
                "no value".to_string(),
                "bearing.moment.law = \"palmgren\" needs it, e.g. \"6.55 kN\"".to_string(),
            )));
        }
        Ok(())
    }

    fn output(&self) -> Check {
        let run = &self.drop.run;
        if run.output_interval > run.duration {
            return Err(Box::new(self.problem(
                Code::OutputInterval,
                "run.output_interval",
                self.text("run.output_interval"),
                format!(
                    "at most run.duration = {} is needed",
                    self.text("run.duration")
                ),
            )));
        }
        let rows = run.duration / run.output_interval;
        let most =
            MOST_VALUES / (VALUES_PER_ROW + VALUES_PER_BALL * self.drop.bearing.ball_count as f64);
        if rows > most {
            return Err(Box::new(self.problem(
                Code::TooManyRows,
                "run.output_interval",
                format!(
                    "{}, which gives {rows:.3e} rows in {}",
                    self.text("run.output_interval"),
                    self.text("run.duration")
                ),
                format!(
                    "at most {most:.2e} rows are kept with {} balls",
                    self.drop.bearing.ball_count
                ),
            )));
        }
        Ok(())
    }

    /// A perturbed ball must stay in its pocket.
    fn perturbed_balls(&self) -> Check {
        let (repeat, bearing) = (&self.drop.repeat, &self.drop.bearing);
        let shift = SPREAD * repeat.ball_angle_deviation * 0.5 * bearing.pitch_diameter;
        if repeat.count < 2 || shift <= bearing.cage.pocket_gap {
            return Ok(());
        }
        Err(Box::new(self.problem(
            Code::OutOfRange,
            "repeat.ball_angle_deviation",
            self.text("repeat.ball_angle_deviation"),
            format!(
                "at most a sixth of bearing.cage.pocket_gap = {} along the pitch circle is needed",
                self.text("bearing.cage.pocket_gap")
            ),
        )))
    }

    /// The geometric centre of the levitated rotor circles the centre of levitation; it must not touch before the release.
    fn levitated_orbit(&self) -> Check {
        let levitation = &self.drop.levitation;
        let clearance = self.drop.contact.radial_air_clearance;
        let offset = levitation.offset_x.hypot(levitation.offset_y);
        let whirl = levitated_whirl_radius(self.drop);
        let repeat = &self.drop.repeat;
        let spread = if repeat.count > 1 {
            SPREAD * repeat.rotor_position_deviation
        } else {
            0.0
        };
        if offset + whirl < clearance && offset + whirl + spread >= clearance {
            return Err(Box::new(self.problem(
                Code::ContactAtStart,
                "repeat.rotor_position_deviation",
                self.text("repeat.rotor_position_deviation"),
                format!(
                    "less than a sixth of the {} that the levitated rotor leaves free is needed, so that no perturbed \
                     start touches",
                    millimetres(clearance - offset - whirl)
                ),
            )));
        }
        if offset + whirl < clearance {
            return Ok(());
        }
        let rotor = &self.drop.rotor;
        let share = rotor.mass / f64::from(rotor.planes);
        let resonance = (levitation.stiffness / share).sqrt();
        let near = (0.7..1.4).contains(&(rotor.speed.abs() / resonance));
        let hint = near.then(|| {
            format!(
                "The levitation is near resonance: its natural frequency is {:.4e} rad/s and the speed {:.4e} rad/s",
                resonance,
                rotor.speed.abs()
            )
        });
        Err(Box::new(
            self.problem(
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
            .with_hint(hint),
        ))
    }
}

/// Radius of the whirl of the levitated rotor's geometric centre at one plane, m.
fn levitated_whirl_radius(drop: &Drop) -> f64 {
    let (rotor, levitation) = (&drop.rotor, &drop.levitation);
    let (along, ahead) = whirl(
        levitation.stiffness,
        levitation.damping,
        rotor.mass / f64::from(rotor.planes),
        rotor.speed,
        rotor.unbalance_eccentricity,
    );
    along.hypot(ahead)
}

/// A length for a message, to four digits.
fn millimetres(length: f64) -> String {
    let rounded: f64 = format!("{:.3e}", length * 1e3)
        .parse()
        .unwrap_or(length * 1e3);
    format!("{} mm", units::number_text(rounded))
}
