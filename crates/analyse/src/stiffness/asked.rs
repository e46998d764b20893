//! What is asked of a bearing, read from the words of a command.

use catalogue::Bearing;
use model::spatial::statics::RaceControl;
use physics::groove::{centre_distance, free_contact_angle};
use physics::materials::{BEARING_STEEL, Material, SILICON_NITRIDE};
use problem::{Code, Problem, Result, did_you_mean};
use units::parse_quantity;

/// The words, each as typed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Texts<'a> {
    /// Force along the axis on the inner ring.
    pub axial: Option<&'a str>,
    /// Force across the axis.
    pub radial: Option<&'a str>,
    /// Moment about the axis across that force.
    pub moment: Option<&'a str>,
    /// Speed of the inner ring.
    pub speed: Option<&'a str>,
    /// Free contact angle.
    pub contact_angle: Option<&'a str>,
    /// Diametral clearance, from which the free contact angle follows.
    pub clearance: Option<&'a str>,
    /// Arrangement of a pair.
    pub arrangement: Option<&'a str>,
    /// Preload of a pair, a force.
    pub preload: Option<&'a str>,
    /// Preload of a pair, the distance by which it is closed.
    pub offset: Option<&'a str>,
    /// Distance of the rows of a pair.
    pub spacing: Option<&'a str>,
    /// Hypothesis of the balls' spin.
    pub race_control: Option<&'a str>,
}

/// How rows stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// One row.
    Single,
    /// DB.
    BackToBack,
    /// DF.
    FaceToFace,
    /// DT.
    Tandem,
}

const ARRANGEMENTS: [(&str, Arrangement); 4] = [
    ("single", Arrangement::Single),
    ("DB", Arrangement::BackToBack),
    ("DF", Arrangement::FaceToFace),
    ("DT", Arrangement::Tandem),
];
const CONTROLS: [(&str, RaceControl); 4] = [
    ("half", RaceControl::Half),
    ("outer", RaceControl::Outer),
    ("inner", RaceControl::Inner),
    ("outer_half", RaceControl::OuterHalf),
];

/// A bearing, its loads and its speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    /// Name of the bearing.
    pub name: String,
    /// Number of balls of a row.
    pub balls: usize,
    /// m.
    pub ball_diameter: f64,
    /// m.
    pub pitch_diameter: f64,
    /// Groove radius over ball diameter, inner and outer.
    pub curvatures: [f64; 2],
    /// Of the balls.
    pub ball_material: Material,
    /// Free contact angle, rad.
    pub free_angle: f64,
    /// Whether the grooves of a single row stand opposite each other, for thrust from both sides.
    pub opposite: bool,
    /// Height of the inner shoulder above the groove's bottom, m.
    pub shoulder: Option<f64>,
    /// How rows stand.
    pub arrangement: Arrangement,
    /// Distance of the rows, m.
    pub spacing: f64,
    /// Preload, N.
    pub preload: Option<f64>,
    /// Distance by which a pair is closed, m.
    pub offset: Option<f64>,
    /// N.
    pub axial: f64,
    /// N.
    pub radial: f64,
    /// N m.
    pub moment: f64,
    /// rad/s.
    pub speed: f64,
    /// Hypothesis of the balls' spin.
    pub control: RaceControl,
}

/// Reads words under one place that stands for the file.
struct Reader<'a>(&'a str);

impl Reader<'_> {
    fn problem(&self, code: Code, option: &str, found: String, allowed: &str) -> Box<Problem> {
        Problem::new(code, self.0, found, allowed).on_key(option)
    }
    /// A quantity of a unit whose value is allowed.
    fn quantity(
        &self,
        (option, text): (&str, Option<&str>),
        unit: &str,
        (allowed, needed): (impl Fn(f64) -> bool, &str),
    ) -> Result<Option<f64>> {
        let Some(text) = text else { return Ok(None) };
        let read = parse_quantity(text).ok();
        let read = read.filter(|own| own.dimension.si_unit() == unit && allowed(own.value_si));
        match read {
            Some(own) => Ok(Some(own.value_si)),
            None => Err(self.problem(Code::OutOfRange, option, format!("\"{text}\""), needed)),
        }
    }
    fn word<T: Copy>(
        &self,
        (option, text): (&str, Option<&str>),
        words: &[(&str, T)],
    ) -> Result<T> {
        let Some(text) = text else {
            return Ok(words[0].1);
        };
        let same = words
            .iter()
            .find(|(word, _)| word.eq_ignore_ascii_case(text.trim()));
        same.map(|(_, value)| *value).ok_or_else(|| {
            let all: Vec<&str> = words.iter().map(|(word, _)| *word).collect();
            let needed = format!("one of {} is needed", all.join(", "));
            let hint = did_you_mean(text, all.iter().copied());
            self.problem(Code::UnknownWord, option, format!("\"{text}\""), &needed)
                .with_hint(hint)
        })
    }
}

/// Larger than any load, moment or speed of a ball bearing.
const MOST: f64 = 1e9;

fn any(value: f64) -> bool {
    value.abs() < MOST
}

impl Asked {
    /// Reads what is asked of a bearing of the catalogue; `place` stands for the file in messages.
    ///
    /// # Errors
    /// Words that are none of the allowed ones, and bearings or arrangements that cannot be computed.
    pub fn read(bearing: &Bearing, texts: &Texts<'_>, place: &str) -> Result<Asked> {
        let reader = Reader(place);
        let force = (any, "a force is needed, e.g. \"200 N\"");
        let turning = (any, "a moment is needed, e.g. \"2 N m\"");
        let speed = (any, "a speed is needed, e.g. \"20000 rpm\"");
        let angle = (
            |value: f64| (0.0..=std::f64::consts::FRAC_PI_3).contains(&value),
            "an angle from 0 to 60 deg is needed, e.g. \"15 deg\"",
        );
        let length = (
            |value: f64| value > 0.0 && value < 1.0,
            "a length above 0 is needed, e.g. \"12 mm\"",
        );
        let closing = (
            |value: f64| (0.0..1e-3).contains(&value),
            "a distance from 0 to 1 mm by which the pair is closed is needed, e.g. \"8 um\": a pair that is opened is unloaded at rest",
        );
        let preload = (
            |value: f64| value > 0.0 && value < MOST,
            "a force above 0 N is needed, e.g. \"65 N\": without it the pair is unloaded at rest",
        );
        let play = (
            |value: f64| (0.0..1e-3).contains(&value),
            "a diametral clearance from 0 to 1 mm is needed, e.g. \"10 um\"",
        );
        let needed = |key: &str| {
            let value = bearing.number(key);
            value.ok_or_else(|| {
                let found = format!("{} without {key}", bearing.name);
                reader.problem(
                    Code::MissingKey,
                    "NAME",
                    found,
                    "a bearing of the catalogue with it, or a file by --catalogue, is needed",
                )
            })
        };
        let (ball_diameter, pitch_diameter) = (needed("ball_diameter")?, needed("pitch_diameter")?);
        let curvatures = [
            needed("inner_groove_curvature")?,
            needed("outer_groove_curvature")?,
        ];
        let arrangement = reader.word(("--arrangement", texts.arrangement), &ARRANGEMENTS)?;
        let offset = reader.quantity(("--offset", texts.offset), "m", closing)?;
        let preload = reader.quantity(("--preload", texts.preload), "N", preload)?;
        let paired = matches!(
            arrangement,
            Arrangement::BackToBack | Arrangement::FaceToFace
        );
        let given = [("--preload", texts.preload), ("--offset", texts.offset)];
        if let (false, Some((option, Some(text)))) =
            (paired, given.into_iter().find(|own| own.1.is_some()))
        {
            let found = match arrangement {
                Arrangement::Tandem => {
                    format!("\"{text}\" of a tandem pair, whose rows do not press on each other")
                }
                _ => format!("\"{text}\" of a single bearing"),
            };
            return Err(reader.problem(
                Code::Conflict,
                option,
                found,
                "--arrangement DB or DF is needed; preload by a spring is an --axial load",
            ));
        }
        if texts.preload.is_some() && texts.offset.is_some() {
            let found = "both --preload and --offset".to_string();
            return Err(reader.problem(Code::Conflict, "--offset", found, "one of them is needed"));
        }
        let distance = centre_distance(curvatures, ball_diameter);
        let clearance = reader.quantity(("--clearance", texts.clearance), "m", play)?;
        let typed = reader.quantity(("--contact-angle", texts.contact_angle), "rad", angle)?;
        if texts.clearance.is_some() && texts.contact_angle.is_some() {
            let found = "both --contact-angle and --clearance".to_string();
            return Err(reader.problem(
                Code::Conflict,
                "--clearance",
                found,
                "one of them is needed: the angle follows from the clearance",
            ));
        }
        if let Some(clearance) = clearance.filter(|own| *own >= 2.0 * distance) {
            let found = format!("{:.3} mm", clearance * 1e3);
            let needed = format!(
                "less than {:.3} mm is needed: the grooves let the ball through",
                2e3 * distance
            );
            return Err(reader.problem(Code::ClearanceTooLarge, "--clearance", found, &needed));
        }
        let nominal = typed.or(bearing
            .number("contact_angle")
            .filter(|_| clearance.is_none()));
        let free_angle =
            nominal.unwrap_or_else(|| free_contact_angle(clearance.unwrap_or(0.0), distance));
        let shoulder = bearing.number("inner_shoulder_diameter");
        let shoulder = shoulder.map(|own| 0.5 * (own - pitch_diameter + ball_diameter));
        if let Some(height) = shoulder {
            let end = (1.0 - height / (curvatures[0] * ball_diameter)).acos();
            if free_angle >= end {
                let found = format!(
                    "a contact angle of {:.1} deg at rest",
                    free_angle.to_degrees()
                );
                let needed = format!(
                    "less than {:.1} deg is needed: there the groove of the inner ring ends",
                    end.to_degrees()
                );
                return Err(reader.problem(Code::OutOfRange, "--contact-angle", found, &needed));
            }
        }
        let zero = |value: Option<f64>| value.unwrap_or(0.0);
        let asked = Asked {
            name: bearing.name.clone(),
            balls: needed("ball_count")? as usize,
            ball_diameter,
            pitch_diameter,
            curvatures,
            ball_material: match bearing.word("ball_material") {
                Some("silicon nitride") => SILICON_NITRIDE,
                _ => BEARING_STEEL,
            },
            free_angle,
            opposite: nominal.is_none() && arrangement == Arrangement::Single,
            shoulder,
            arrangement,
            spacing: match reader.quantity(("--spacing", texts.spacing), "m", length)? {
                Some(spacing) => spacing,
                None if arrangement == Arrangement::Single => 0.0,
                None => needed("width")?,
            },
            preload,
            offset,
            axial: zero(reader.quantity(("--axial", texts.axial), "N", force)?),
            radial: zero(reader.quantity(("--radial", texts.radial), "N", force)?),
            moment: zero(reader.quantity(("--moment", texts.moment), "N m", turning)?),
            speed: zero(reader.quantity(("--speed", texts.speed), "rad/s", speed)?),
            control: reader.word(("--race-control", texts.race_control), &CONTROLS)?,
        };
        let preloaded = preload.is_some() || offset.is_some_and(|offset| offset > 0.0);
        if asked.axial == 0.0 && asked.radial == 0.0 && asked.moment == 0.0 && !preloaded {
            let found = "no load and no preload".to_string();
            return Err(reader.problem(
                Code::MissingKey,
                "--axial",
                found,
                "a load is needed, e.g. --axial \"200 N\", or the preload of a pair",
            ));
        }
        Ok(asked)
    }
    /// Word of the arrangement.
    pub fn arrangement_word(&self) -> &'static str {
        let all = ARRANGEMENTS.iter();
        all.clone()
            .find(|own| own.1 == self.arrangement)
            .map_or("", |own| own.0)
    }
    /// Word of the hypothesis.
    pub fn control_word(&self) -> &'static str {
        CONTROLS
            .iter()
            .find(|own| own.1 == self.control)
            .map_or("", |own| own.0)
    }
}
