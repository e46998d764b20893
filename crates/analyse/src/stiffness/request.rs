//! What is asked of a bearing, read from the words of a command.

use catalogue::Meant;
use model::spatial::statics::RaceControl;
use physics::groove::{centre_distance, free_contact_angle};
use physics::materials::{BEARING_STEEL, Material, SILICON_NITRIDE};
use problem::words::Words;
use problem::{Code, Problem, Result, did_you_mean};
use scenario::Arrangement;
use std::f64::consts::FRAC_PI_3;
use units::parse_quantity;

const CONTROLS: [(&str, RaceControl); 4] = [
    ("half", RaceControl::Half),
    ("outer", RaceControl::Outer),
    ("inner", RaceControl::Inner),
    ("outer_half", RaceControl::OuterHalf),
];

/// Arrangements by their words.
fn words() -> impl Iterator<Item = (&'static str, Arrangement)> {
    let both = Arrangement::WORDS.iter().zip(Arrangement::ALL);
    both.map(|(word, own)| (*word, *own))
}

/// A bearing, its loads and its speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
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
    /// Distance of the middles of neighbouring rows, m.
    pub spacing: f64,
    /// Preload, N.
    pub preload: Option<f64>,
    /// Distance by which the rows are closed, m.
    pub offset: Option<f64>,
    /// Stiffness of the spring that keeps the preload of the rows that carry thrust towards -z, N/m, and its travel, m.
    pub spring: Option<[f64; 2]>,
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

/// Options that are quantities: unit, smallest and largest value, what is needed.
#[rustfmt::skip]
const QUANTITIES: [(&str, &str, [f64; 2], &str); 11] = [
    ("--axial", "N", ANY, "a force is needed, e.g. \"200 N\""),
    ("--radial", "N", ANY, "a force is needed, e.g. \"200 N\""),
    ("--moment", "N m", ANY, "a moment is needed, e.g. \"2 N m\""),
    ("--speed", "rad/s", ANY, "a speed is needed, e.g. \"20000 rpm\""),
    ("--contact-angle", "rad", [0.0, FRAC_PI_3], "an angle from 0 to 60 deg is needed, e.g. \"15 deg\""),
    ("--clearance", "m", [0.0, 1e-3], "a diametral clearance from 0 to 1 mm is needed, e.g. \"10 um\""),
    ("--spacing", "m", [1e-6, 1.0], "a distance of rows above 0 is needed, e.g. \"12 mm\""),
    ("--preload", "N", [1e-9, MOST], "a force above 0 N is needed, e.g. \"65 N\": without it the pair is unloaded at rest"),
    ("--preload-spring", "N/m", [1e-9, STIFFEST], "a stiffness above 0 N/m is needed, e.g. \"1e6 N/m\""),
    ("--spring-travel", "m", [1e-9, 1.0], "a compression above 0 m at which the spring is solid is needed, e.g. \"0.2 mm\""),
    ("--offset", "m", [0.0, 1e-3], "a distance from 0 to 1 mm by which the pair is closed is needed, e.g. \"8 um\": a pair that is opened is unloaded at rest"),
];
/// Larger than any load, moment or speed of a ball bearing.
const MOST: f64 = 1e9;
/// Stiffer than any spring.
const STIFFEST: f64 = 1e21;
const ANY: [f64; 2] = [-MOST, MOST];

/// Options as typed, under a place that stands for the file in messages.
pub struct Typed<'a> {
    /// Each option with its text, where it is given.
    pub texts: &'a [(&'static str, Option<&'a str>)],
    /// Place.
    pub place: &'a str,
}

impl Typed<'_> {
    fn refuse<T>(
        &self,
        code: Code,
        option: &str,
        found: impl Into<String>,
        needed: impl Into<String>,
    ) -> Result<T> {
        Err(Problem::new(code, self.place, found, needed).on_key(option))
    }
    fn text(&self, option: &str) -> Option<&str> {
        self.texts.iter().find(|own| own.0 == option)?.1
    }
    fn quantity(&self, option: &str) -> Result<Option<f64>> {
        let row = QUANTITIES.iter().find(|row| row.0 == option);
        let (Some(text), Some((_, unit, [least, most], needed))) = (self.text(option), row) else {
            return Ok(None);
        };
        let read = parse_quantity(text)
            .ok()
            .filter(|own| own.dimension.si_unit() == *unit);
        match read
            .map(|own| own.value_si)
            .filter(|own| (*least..=*most).contains(own))
        {
            Some(value) => Ok(Some(value)),
            None => self.refuse(Code::OutOfRange, option, format!("\"{text}\""), *needed),
        }
    }
    fn word<T: Copy>(&self, option: &str, words: &[(&str, T)]) -> Result<T> {
        let text = self.text(option).unwrap_or(words[0].0);
        match words
            .iter()
            .find(|own| own.0.eq_ignore_ascii_case(text.trim()))
        {
            Some((_, value)) => Ok(*value),
            None => {
                let all: Vec<&str> = words.iter().map(|own| own.0).collect();
                let needed = format!("one of {} is needed", all.join(", "));
                let refused = self.refuse(Code::UnknownWord, option, format!("\"{text}\""), needed);
                refused.map_err(|own| own.with_hint(did_you_mean(text, all.iter().copied())))
            }
        }
    }
    /// How rows stand, by the option or by the bearing's designation.
    fn arrangement(&self, meant: &Meant<'_>) -> Result<Arrangement> {
        let option = "--arrangement";
        let words: Vec<_> = words().collect();
        let typed = self.word(option, &words)?;
        let named = words
            .into_iter()
            .find(|own| Some(own.0) == meant.arrangement);
        match (named, self.text(option)) {
            (Some((word, named)), Some(text)) if typed != named => {
                let needed = format!("{word} is needed, as the name of the bearing says, or none");
                self.refuse(Code::Conflict, option, format!("\"{text}\""), needed)
            }
            (named, _) => Ok(named.map_or(typed, |own| own.1)),
        }
    }
    /// Refuses two options that say the same.
    fn either(&self, [first, second]: [&str; 2]) -> Result<()> {
        if self.text(first).is_none() || self.text(second).is_none() {
            return Ok(());
        }
        let found = format!("both {first} and {second}");
        self.refuse(
            Code::Conflict,
            second,
            found,
            "one of them is needed: the other follows from it",
        )
    }
}

impl Request {
    /// Reads what is asked of a bearing of the catalogue; its designation may say how its rows stand.
    ///
    /// # Errors
    /// Words that are none of the allowed ones, and bearings or arrangements that cannot be computed.
    pub fn read(meant: &Meant<'_>, typed: &Typed<'_>) -> Result<Request> {
        let bearing = meant.bearing;
        let needed = |key: &str| match bearing.number(key) {
            Some(value) => Ok(value),
            None => {
                let found = format!("{} without {key}", bearing.name);
                let allowed =
                    "a bearing of the catalogue with it, or a file by --catalogue, is needed";
                typed.refuse(Code::MissingKey, "NAME", found, allowed)
            }
        };
        let (ball_diameter, pitch_diameter) = (needed("ball_diameter")?, needed("pitch_diameter")?);
        let curvatures = [
            needed("inner_groove_curvature")?,
            needed("outer_groove_curvature")?,
        ];
        let arrangement = typed.arrangement(meant)?;
        typed.either(["--preload", "--offset"])?;
        typed.either(["--contact-angle", "--clearance"])?;
        for option in ["--preload", "--offset"] {
            let Some(text) = typed.text(option) else {
                continue;
            };
            let what = match arrangement {
                Arrangement::Single => "a single bearing",
                _ if arrangement.preloads() => continue,
                _ => "a tandem, whose rows do not press on each other",
            };
            let allowed = "--arrangement DB or DF, or a set with rows on both sides, is needed; what presses others is an --axial load";
            return typed.refuse(
                Code::Conflict,
                option,
                format!("\"{text}\" of {what}"),
                allowed,
            );
        }
        for (option, beside) in [
            ("--preload-spring", "--preload"),
            ("--spring-travel", "--preload-spring"),
        ] {
            if let (Some(text), None) = (typed.text(option), typed.text(beside)) {
                let found = format!("\"{text}\" without {beside}");
                let allowed = format!("{beside} is needed beside it");
                return typed.refuse(Code::MissingKey, option, found, allowed);
            }
        }
        let distance = centre_distance(curvatures, ball_diameter);
        let clearance = typed.quantity("--clearance")?;
        if let Some(clearance) = clearance.filter(|own| *own >= 2.0 * distance) {
            let found = format!("{:.3} mm", clearance * 1e3);
            let allowed = format!(
                "less than {:.3} mm is needed: the grooves let the ball through",
                2e3 * distance
            );
            return typed.refuse(Code::ClearanceTooLarge, "--clearance", found, allowed);
        }
        let nominal = bearing
            .number("contact_angle")
            .filter(|_| clearance.is_none());
        let nominal = typed.quantity("--contact-angle")?.or(nominal);
        let by_clearance = free_contact_angle(clearance.unwrap_or(0.0), distance);
        let free_angle = nominal.unwrap_or(by_clearance);
        let shoulder = bearing.number("inner_shoulder_diameter");
        let shoulder = shoulder.map(|own| 0.5 * (own - pitch_diameter + ball_diameter));
        let end = shoulder.map(|height| (1.0 - height / (curvatures[0] * ball_diameter)).acos());
        if let Some(end) = end.filter(|end| free_angle >= *end) {
            let found = format!(
                "a contact angle of {:.1} deg at rest",
                free_angle.to_degrees()
            );
            let allowed = format!(
                "less than {:.1} deg is needed: there the groove of the inner ring ends",
                end.to_degrees()
            );
            return typed.refuse(Code::OutOfRange, "--contact-angle", found, allowed);
        }
        let load = |option: &str| Ok::<_, Box<Problem>>(typed.quantity(option)?.unwrap_or(0.0));
        let (preload, offset) = (typed.quantity("--preload")?, typed.quantity("--offset")?);
        let [axial, radial, moment] = [load("--axial")?, load("--radial")?, load("--moment")?];
        if [axial, radial, moment, preload.or(offset).unwrap_or(0.0)] == [0.0; 4] {
            let allowed = "a load is needed, e.g. --axial \"200 N\", or the preload of a pair";
            return typed.refuse(
                Code::MissingKey,
                "--axial",
                "no load and no preload",
                allowed,
            );
        }
        Ok(Request {
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
            spacing: match typed.quantity("--spacing")? {
                Some(spacing) => spacing,
                None if arrangement == Arrangement::Single => 0.0,
                None => needed("width")?,
            },
            preload,
            offset,
            spring: match typed.quantity("--preload-spring")? {
                Some(stiffness) => {
                    let travel = typed.quantity("--spring-travel")?;
                    Some([stiffness, travel.unwrap_or(f64::INFINITY)])
                }
                None => None,
            },
            axial,
            radial,
            moment,
            speed: load("--speed")?,
            control: typed.word("--race-control", &CONTROLS)?,
        })
    }
    /// Words of the arrangement and of the hypothesis.
    pub fn words(&self) -> [&'static str; 2] {
        let arrangement = words().find(|own| own.1 == self.arrangement);
        let control = CONTROLS.iter().find(|own| own.1 == self.control);
        [
            arrangement.map_or("", |own| own.0),
            control.map_or("", |own| own.0),
        ]
    }
}
