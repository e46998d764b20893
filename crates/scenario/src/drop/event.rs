//! What happens to a machine, and when: `[[event]]`.

use crate::drop::case::Cases;
use crate::drop::event_checks::{
    axial_magnet_lost, check, check_loss, keys_of, relevitated, until_standstill,
};
use crate::key::quoted;
use crate::rotor::FlexibleRotor;
use crate::rotor::keys::EVENT;
use crate::rotor::levitation::Magnets;
use crate::rotor::tables::Part;
use crate::values::Values;
use physics::magnet::{Amplifier, Magnet, Timing};
use problem::words::Words;
use problem::{Code, Result, did_you_mean, words};
use units::number_text;

words! {
    /// What happens, as a word.
    pub enum Happening {
        /// All magnets lose their power.
        PowerLost = "power lost",
        /// A magnet loses its power.
        MagnetLost = "magnet lost",
        /// An axis of a magnet loses its power.
        AxisLost = "axis lost",
        /// A sensor keeps showing what it shows.
        SensorStuck = "sensor stuck",
        /// A sensor shows nothing.
        SensorDead = "sensor dead",
        /// A sensor shows more.
        SensorOffset = "sensor offset",
        /// A sensor shows random values besides.
        SensorNoise = "sensor noise",
        /// A command keeps its value.
        ControllerFrozen = "controller frozen",
        /// The limits of an amplifier change.
        AmplifierLimit = "amplifier limit",
        /// The axial magnet loses its power.
        AxialMagnetLost = "axial magnet lost",
        /// All magnets hold the rotor again.
        Relevitate = "re-levitate",
        /// The rotor is braked.
        Brake = "brake",
        /// The drive has another torque.
        Drive = "drive",
        /// A force acts at a node.
        Load = "load",
        /// An unbalance comes, as where a blade is lost.
        Unbalance = "unbalance",
    }
}

impl Happening {
    /// Whether it is of magnets, sensors or controllers.
    pub(super) fn is_of_magnets(self) -> bool {
        !matches!(
            self,
            Happening::Brake | Happening::Drive | Happening::Load | Happening::Unbalance
        )
    }
}

/// Something that happens during a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Event {
    /// Its name, else its number.
    pub name: String,
    /// When.
    pub when: When,
    /// What.
    pub what: Happens,
    /// Whether `levitation.power_lost_at`, or its default, says so.
    pub by_key: bool,
}

/// When something happens.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub enum When {
    /// At an instant of the run, s.
    At(f64),
    /// So long, s, after the size of the spin reaches a value.
    Speed {
        /// The value, rad/s.
        speed: f64,
        /// Whether the spin rises to it; else it falls to it.
        rising: bool,
        /// How long after, s.
        delay: f64,
    },
}

/// What happens.
#[derive(Clone, Debug, PartialEq)]
pub enum Happens {
    /// Something happens to axes of magnets, two of each in turn.
    Magnets(Vec<usize>, MagnetEvent),
    /// The axial magnet loses its power.
    AxialMagnetLost,
    /// A torque of this size brakes the rotor, N m.
    Brake(f64),
    /// The drive has this torque, N m, in the place of `rotor.drive_torque`.
    Drive(f64),
    /// A force acts from then on, in the place of that of an earlier load at its node.
    Load {
        /// The place of its node among those of the rotor.
        node: usize,
        /// Along x and along y, N.
        force: [f64; 2],
    },
    /// An unbalance comes.
    Unbalance {
        /// The place of its plane among those of the rotor.
        plane: usize,
        /// Mass times distance from the axis, kg m.
        amount: f64,
        /// Angle on the rotor, rad.
        phase: f64,
    },
}

/// What happens to axes of magnets, their sensors and their controllers.
#[derive(Clone, Debug, PartialEq)]
pub enum MagnetEvent {
    /// They lose their power; their currents decay to 1/e in this time, s.
    Lost(f64),
    /// Sensors keep showing what they show.
    SensorStuck,
    /// Sensors show nothing.
    SensorDead,
    /// Sensors show so much more, m.
    SensorOffset(f64),
    /// Sensors show normal values besides, each for a while.
    SensorNoise {
        /// Standard deviation, m.
        deviation: f64,
        /// Time from a value to the next, s.
        period: f64,
        /// Seed of the values.
        seed: u64,
    },
    /// Commands keep their value.
    ControllerFrozen,
    /// Limits of amplifiers, where they change.
    AmplifierLimit {
        /// Largest current of a coil, A.
        largest_current: Option<f64>,
        /// Largest rate of a current, A/s.
        slew: Option<f64>,
    },
    /// They hold the rotor again, all of them.
    Relevitated(Relevitation),
}

/// How a rotor is levitated again.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Relevitation {
    /// Time in which the bias rises, s.
    pub bias_time: f64,
    /// Time in which the references lead to the middle, s.
    pub reference_time: f64,
    /// Share of the clearance within which the rotor must stay.
    pub within: f64,
    /// How long before the end it must have, s.
    pub hold: f64,
}

/// Name of the event of `levitation.power_lost_at`.
const POWER_LOST: &str = "power_lost";
/// Name of the event of `rotor.brake_start`.
const BRAKE: &str = "brake";
pub(crate) const LOST_AT: &str = "levitation.power_lost_at";

/// Most values that a sensor with noise shows in a run.
const MOST_VALUES: f64 = 2e5;

impl Happens {
    /// The axes of the magnets that it is of; none of what is not of magnets.
    pub fn axes(&self) -> Option<&[usize]> {
        match self {
            Happens::Magnets(axes, _) => Some(axes),
            _ => None,
        }
    }
    /// Whether both change the same thing; unbalances add up.
    pub(super) fn conflicts(&self, other: &Happens) -> bool {
        use MagnetEvent::{Lost, Relevitated, SensorDead, SensorStuck};
        let kind = |of: &MagnetEvent| match of {
            Relevitated(_) => std::mem::discriminant(&Lost(0.0)),
            SensorDead => std::mem::discriminant(&SensorStuck),
            own => std::mem::discriminant(own),
        };
        match (self, other) {
            (Happens::Magnets(a, one), Happens::Magnets(b, two)) => {
                kind(one) == kind(two) && a.iter().any(|axis| b.contains(axis))
            }
            (Happens::Load { node, .. }, Happens::Load { node: other, .. }) => node == other,
            (Happens::AxialMagnetLost, own) => *own == Happens::AxialMagnetLost,
            (Happens::Brake(_), Happens::Brake(_)) | (Happens::Drive(_), Happens::Drive(_)) => true,
            _ => false,
        }
    }
}

/// The cases of a machine, the one that happens first, and the events of this; the loss of power that the file gives by its key, or by its default, is one of them.
pub fn events(
    parts: &[Part],
    rotor: &FlexibleRotor,
    values: &Values,
) -> Result<(Cases, Vec<Event>)> {
    let cases = Cases::of(parts, values)?;
    let of = |case: Option<&str>| of_case(parts, (rotor, case), values);
    check_loss(&cases, parts, rotor, values)?;
    // the others have to be right as well
    for other in cases.others() {
        of(Some(other))?;
    }
    let (own, events) = of(cases.chosen())?;
    let axes = rotor.levitation.as_ref();
    let axes = axes.map_or(0, |own| 2 * own.magnets.len());
    until_standstill(&own.parts, &events, axes, values)?;
    Ok((cases, events))
}

/// The events of a case, as tables.
struct InCase<'a> {
    parts: Vec<&'a Part>,
    /// Those of all cases.
    all: Vec<&'a Part>,
    values: &'a Values,
    /// Whether any of them is of magnets: by events alone the power is lost then, in all cases.
    of_magnets: bool,
}

fn of_case<'a>(
    parts: &'a [Part],
    (rotor, case): (&FlexibleRotor, Option<&str>),
    values: &'a Values,
) -> Result<(InCase<'a>, Vec<Event>)> {
    let magnets = rotor.levitation.as_ref();
    let all: Vec<&Part> = parts.iter().filter(|own| own.kind.word == EVENT).collect();
    let happens_here = |part: &&Part| part.text("case").is_none_or(|own| Some(own) == case);
    let own = InCase {
        parts: all.iter().copied().filter(happens_here).collect(),
        of_magnets: all.iter().any(|part| {
            let what = part.word("do").and_then(Happening::of_word);
            what.is_some_and(Happening::is_of_magnets)
        }),
        all,
        values,
    };
    let parts = &own.parts;
    let mut events = Vec::new();
    for part in parts {
        events.push(Event {
            name: part.label.clone(),
            when: own.when(part, 0)?,
            what: happens(part, rotor, values)?,
            by_key: false,
        });
    }
    check(parts, &events, values)?;
    if let Some(held) = magnets.filter(|_| own.lost_by_key()) {
        events.push(Event {
            name: POWER_LOST.to_string(),
            when: When::At(values.number(LOST_AT).unwrap_or_default()),
            what: Happens::Magnets(
                (0..2 * held.magnets.len()).collect(),
                MagnetEvent::Lost(values.number("levitation.decay_time").unwrap_or_default()),
            ),
            by_key: true,
        });
    }
    relevitated(parts, &events, magnets)?;
    let end = values.number("run.duration").unwrap_or(f64::INFINITY);
    for (part, event) in parts.iter().zip(&events) {
        if let (Happens::Magnets(_, MagnetEvent::Relevitated(again)), When::At(time)) =
            (&event.what, event.when)
            && time < end
            && again.hold >= end - time
        {
            let found = format!(
                "{} s, and the run ends {} s after it",
                number_text(again.hold),
                number_text(end - time)
            );
            let allowed = "less than what is left of run.duration is needed";
            return part.refuse(Code::OutOfRange, "hold", found, allowed);
        }
    }
    Ok((own, events))
}

/// What happens.
fn happens(part: &Part, rotor: &FlexibleRotor, values: &Values) -> Result<Happens> {
    let word = part.word("do").unwrap_or_default();
    let Some(what) = Happening::of_word(word) else {
        unreachable!("a key of words has one of them");
    };
    let (needed, possible) = keys_of(what);
    for key in needed {
        if !part.known.contains_key(key) {
            let found = format!("do = {} without it", quoted(word));
            let allowed = format!("{key} is needed");
            return part.refuse(Code::MissingKey, key, found, allowed);
        }
    }
    let others = [
        "name",
        "do",
        "case",
        "at",
        "below_speed",
        "above_speed",
        "after",
        "delay",
    ];
    let useless = part.known.keys().find(|key| {
        let of = [needed, possible, &others[..]];
        !of.iter().any(|list| list.contains(key))
    });
    if let Some(key) = useless {
        let found = "a key that has no effect";
        let allowed = format!("do = {} takes no {key}", quoted(word));
        return part.refuse(Code::UnusedKey, key, found, allowed);
    }
    let torque = || part.needed("torque");
    match what {
        Happening::Brake => return Ok(Happens::Brake(torque())),
        Happening::Drive => return Ok(Happens::Drive(torque())),
        Happening::Load => return load(part, rotor),
        Happening::Unbalance => return unbalance(part, rotor),
        Happening::AxialMagnetLost => {
            return axial_magnet_lost(part, rotor.levitation.as_ref(), values);
        }
        _ => {}
    }
    let Some(magnets) = &rotor.levitation else {
        let found = format!("do = {} without magnets", quoted(word));
        let allowed = "[[levitation.magnet]] with sensor and controller is needed";
        return part.refuse(Code::LevitationParts, "do", found, allowed);
    };
    let axes = axes(part, magnets)?;
    let what = match what {
        Happening::PowerLost | Happening::MagnetLost | Happening::AxisLost => {
            let usual = values.number("levitation.decay_time").unwrap_or_default();
            MagnetEvent::Lost(part.number("decay_time").unwrap_or(usual))
        }
        Happening::SensorStuck => MagnetEvent::SensorStuck,
        Happening::SensorDead => MagnetEvent::SensorDead,
        Happening::SensorOffset => MagnetEvent::SensorOffset(part.needed("offset")),
        Happening::SensorNoise => {
            // a sampled controller sees one value a sample
            let sampled = match magnets.timing {
                Timing::Sampled { period, .. } => Some(period),
                Timing::Continuous { .. } | Timing::Held => None,
            };
            let Some(period) = part.number("period").or(sampled) else {
                let found = "noise without it, and controllers that take no samples";
                return part.refuse(Code::MissingKey, "period", found, "period is needed");
            };
            let values = values.number("run.duration").unwrap_or_default() / period;
            if values > MOST_VALUES {
                let found = format!("{} s, {values:.0} values in the run", number_text(period));
                let allowed =
                    format!("a period is needed of which a run has at most {MOST_VALUES:.0}");
                return part.refuse(Code::OutOfRange, "period", found, allowed);
            }
            MagnetEvent::SensorNoise {
                deviation: part.needed("deviation"),
                period,
                seed: part.count("seed").unwrap_or(1) as u64,
            }
        }
        Happening::ControllerFrozen => MagnetEvent::ControllerFrozen,
        Happening::AmplifierLimit => {
            let [largest_current, slew] =
                ["largest_current", "slew_rate"].map(|key| part.number(key));
            for axis in &axes {
                let magnet = &magnets.magnets[axis / 2];
                let own = matches!(magnet.amplifier, Amplifier::Current { .. });
                let pair = matches!(magnet.axes[axis % 2].law, Magnet::Pair(_));
                let useless = match (slew, largest_current) {
                    (Some(_), _) if !own => "slew_rate",
                    (_, Some(_)) if pair && !own => "largest_current",
                    _ => continue,
                };
                let found = format!(
                    "the limit of coils that magnet {} does not follow one by one",
                    quoted(&magnet.name)
                );
                let allowed = "levitation.magnet.amplifier_bandwidth is needed beside it: a current amplifier of each coil";
                return part.refuse(Code::UnusedKey, useless, found, allowed);
            }
            if largest_current.or(slew).is_none() {
                let found = "an amplifier limit without a limit";
                let allowed = "largest_current or slew_rate is needed";
                return part.refuse(Code::MissingKey, "largest_current", found, allowed);
            }
            MagnetEvent::AmplifierLimit {
                largest_current,
                slew,
            }
        }
        Happening::Relevitate => MagnetEvent::Relevitated(Relevitation {
            bias_time: part.needed("bias_time"),
            reference_time: part.number("reference_time").unwrap_or(0.0),
            within: part.number("within").unwrap_or(0.5),
            hold: part.number("hold").unwrap_or(0.1),
        }),
        _ => unreachable!("it is of no radial magnet"),
    };
    Ok(Happens::Magnets(axes, what))
}

/// The place of what a key names among the parts of a table.
fn place<'a>(
    part: &Part,
    key: &'static str,
    table: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Result<usize> {
    let named = part.text(key).unwrap_or_default();
    names.clone().position(|name| name == named).ok_or_else(|| {
        let allowed = match names.clone().collect::<Vec<_>>().join(", ").as_str() {
            "" => format!("a {table} of this name is needed where it comes"),
            names => format!("one of the names of {table} is needed: {names}"),
        };
        let problem = part.problem(Code::NoSuchNode, key, quoted(named), allowed);
        problem.with_hint(did_you_mean(named, names))
    })
}

/// A force that acts from then on.
fn load(part: &Part, rotor: &FlexibleRotor) -> Result<Happens> {
    let names = rotor.nodes.iter().map(|node| node.name.as_str());
    let node = place(part, "node", "[[rotor.node]]", names)?;
    let force = ["force_x", "force_y"].map(|key| part.number(key));
    if force == [None; 2] {
        let found = "a load without a force";
        return part.refuse(
            Code::MissingKey,
            "force_x",
            found,
            "force_x or force_y is needed",
        );
    }
    Ok(Happens::Load {
        node,
        force: force.map(Option::unwrap_or_default),
    })
}

/// An unbalance that comes.
fn unbalance(part: &Part, rotor: &FlexibleRotor) -> Result<Happens> {
    let names = rotor.unbalance.iter().map(|plane| plane.name.as_str());
    let plane = place(part, "plane", "[[rotor.unbalance]]", names)?;
    if part.number("at") == Some(0.0) {
        let found = "an unbalance that comes at the start";
        let allowed =
            "a later instant is needed: what is there from the start is a [[rotor.unbalance]]";
        return part.refuse(Code::OutOfRange, "at", found, allowed);
    }
    Ok(Happens::Unbalance {
        plane,
        amount: part.needed("amount"),
        phase: part.number("phase").unwrap_or(0.0),
    })
}

/// The axes that a part names: of all magnets, of one, or one.
fn axes(part: &Part, magnets: &Magnets) -> Result<Vec<usize>> {
    let Some(named) = part.text("magnet") else {
        return Ok((0..2 * magnets.magnets.len()).collect());
    };
    let names = || magnets.magnets.iter().map(|magnet| magnet.name.as_str());
    let Some(magnet) = names().position(|name| name == named) else {
        let allowed = names().collect::<Vec<_>>().join(", ");
        let allowed = format!("one of the magnets {allowed} is needed");
        let problem = part.problem(Code::LevitationParts, "magnet", quoted(named), allowed);
        return Err(problem.with_hint(did_you_mean(named, names())));
    };
    Ok(match part.number("axis") {
        Some(axis) => vec![2 * magnet + axis as usize - 1],
        None => vec![2 * magnet, 2 * magnet + 1],
    })
}

impl InCase<'_> {
    /// Whether all power is lost by its key, or by the default of that.
    fn lost_by_key(&self) -> bool {
        self.values.is_own(LOST_AT) || !self.of_magnets
    }

    /// When an event happens, by what it follows; `steps` are those on the way.
    fn when(&self, part: &Part, steps: usize) -> Result<When> {
        let words = ["at", "below_speed", "above_speed", "after"];
        let given: Vec<&str> = words
            .into_iter()
            .filter(|key| part.known.contains_key(key))
            .collect();
        let speed = |rising, speed| When::Speed {
            speed,
            rising,
            delay: 0.0,
        };
        let allowed = "exactly one of at, below_speed, above_speed and after is needed";
        match given[..] {
            ["at"] => Ok(When::At(part.needed("at"))),
            ["below_speed"] => Ok(speed(false, part.needed("below_speed"))),
            ["above_speed"] => Ok(speed(true, part.needed("above_speed"))),
            ["after"] => {
                let named = part.text("after").unwrap_or_default();
                let delay = part.number("delay").unwrap_or(0.0);
                if steps > self.parts.len() {
                    let found = format!("{}, which follows it in turn", quoted(named));
                    let allowed = "events that do not wait for each other are needed";
                    return part.refuse(Code::Conflict, "after", found, allowed);
                }
                let mut others = self.parts.iter();
                let base = match others.find(|other| other.label == named) {
                    Some(other) => self.when(other, steps + 1)?,
                    None => self.of_key(part, named)?,
                };
                Ok(match base {
                    When::At(time) => When::At(time + delay),
                    When::Speed {
                        speed,
                        rising,
                        delay: before,
                    } => When::Speed {
                        speed,
                        rising,
                        delay: before + delay,
                    },
                })
            }
            [] => part.refuse(
                Code::MissingKey,
                "at",
                "an event that never happens",
                allowed,
            ),
            [_, second, ..] => part.refuse(
                Code::Conflict,
                second,
                format!("{} beside it", given[0]),
                allowed,
            ),
            [other] => unreachable!("{other} is none of the words"),
        }
    }

    /// When the event of a key happens that another one follows.
    fn of_key(&self, part: &Part, named: &str) -> Result<When> {
        let lost = self.values.number(LOST_AT).unwrap_or_default();
        // the brake of the keys follows what they say
        let start = self.values.number("rotor.brake_start");
        match (named, start) {
            _ if !self.lost_by_key() => {}
            (POWER_LOST, _) => return Ok(When::At(lost)),
            (BRAKE, Some(start)) => return Ok(When::At(lost + start)),
            _ => {}
        }
        let own = self.parts.iter().map(|part| part.label.as_str());
        let mut names: Vec<&str> = own.filter(|name| *name != part.label).collect();
        names.extend(self.lost_by_key().then_some(POWER_LOST));
        let other = self.all.iter().find(|other| other.label == named);
        let found = match other.and_then(|other| other.text("case")) {
            Some(case) => format!(
                "{}, which happens in the case {} alone",
                quoted(named),
                quoted(case)
            ),
            None => quoted(named),
        };
        let others = match names.as_slice() {
            [] => "; there is none".to_string(),
            names => format!(": {}", names.join(", ")),
        };
        let allowed = format!("the name of another event of the same case is needed{others}");
        let problem = part.problem(Code::UnknownWord, "after", found, allowed);
        Err(problem.with_hint(did_you_mean(named, names)))
    }
}
