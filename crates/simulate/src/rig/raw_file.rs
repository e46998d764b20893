//! The raw file of a test, as a laboratory's logger leaves it, and the file that describes it to `auxbear signals`.

use crate::rig::chain::RawChannel;
use outcome::{Attached, Attachment};
use recording::{Channel, Clock};
use scenario::{RawFormat, Rig, RigPickupKind, RigProgram};

/// Name of the file that describes the channels.
const SIGNALS: &str = "signals.toml";

/// What a laboratory would state of a sensor that it has calibrated.
const SCALE_DEVIATION: f64 = 0.005;
/// How well it would have set the zero before a test, N m.
const ZERO_DEVIATION: f64 = 5e-4;

/// Name of the raw file.
fn name(format: RawFormat) -> &'static str {
    match format {
        RawFormat::Tdms => "raw.tdms",
        RawFormat::Csv => "raw.csv",
        RawFormat::Parquet => "raw.parquet",
    }
}

/// The raw file and its description.
pub(crate) fn files(
    rig: &Rig,
    title: &str,
    raw: Vec<RawChannel>,
    rolling_ratio: f64,
    rested: Option<f64>,
) -> Vec<Attachment> {
    let name = name(rig.logger.format);
    let signals = signals(rig, title, name, &raw, rolling_ratio, rested);
    let channels = raw.into_iter().map(|channel| {
        let described = Channel {
            unit: channel.unit.to_string(),
            description: channel.description,
            clock: match channel.interval {
                Some(interval) => Clock::Uniform {
                    first: 0.0,
                    interval,
                },
                None => Clock::Unknown,
            },
            ..Channel::new(channel.name, channel.values.len() as u64)
        };
        (described, channel.values)
    });
    vec![
        Attachment {
            name: name.to_string(),
            content: Attached::Recording(channels.collect()),
        },
        Attachment {
            name: SIGNALS.to_string(),
            content: Attached::Text(signals),
        },
    ]
}

/// Which part of the record is looked at: of two spin-ups the second one, with some of the rest before it. Over a rest the turns
/// of the shaft cannot be counted.
///
/// - `rested`: time at rest before the second spin-up, s
fn part(rig: &Rig, rested: Option<f64>) -> String {
    match rig.program {
        RigProgram::RepeatAfterRest {
            release_at,
            engage_again_at,
            ..
        } => {
            let from = engage_again_at - (0.2 * (engage_again_at - release_at)).min(1.0);
            let rest = rested.map_or_else(String::new, |rest| {
                format!("rest_before = \"{rest:.3} s\"\n")
            });
            format!(
                "# The second of two spin-ups; take these lines away and say to = \"{from} s\" for the first.\nfrom = \"{from} s\"\n{rest}"
            )
        }
        _ => String::new(),
    }
}

/// What a laboratory would know of the channels.
fn signals(
    rig: &Rig,
    title: &str,
    file: &str,
    raw: &[RawChannel],
    rolling_ratio: f64,
    rested: Option<f64>,
) -> String {
    let delay = 1.0 / rig.logger.total_rate;
    let title = scenario::quoted(&format!("Signals of: {title}"));
    let has = |name: &str| raw.iter().any(|channel| channel.name == name);
    let mut text = format!(
        "# What the channels of {file} are, as a laboratory would know it.\n\n\
         format = \"{}\"\nsystem = \"signals\"\ntitle = {title}\n\n\
         [signals]\nfile = \"{file}\"\nchannel_delay = \"{delay} s\"\nradial_load = \"{} N\"\n{}\n\
         [signals.speed]\nchannel = \"rig/tacho\"\n",
        scenario::FORMAT,
        rig.load.radial_load,
        part(rig, rested),
    );
    match rig.pickup.kind {
        RigPickupKind::Analog { .. } => text.push_str("kind = \"analog\"\n"),
        RigPickupKind::Edges { stamp_deviation } => {
            text.push_str(&format!(
                "kind = \"edges\"\nstamp_deviation = \"{stamp_deviation} s\"\n"
            ));
        }
    }
    text.push_str(&format!(
        "marks_per_revolution = {}\n\n\
         [signals.torque]\nchannel = \"rig/torque\"\nsensor_frequency = \"{} Hz\"\ndamping_ratio = {}\nscale_deviation = {SCALE_DEVIATION}\nzero_deviation = \"{ZERO_DEVIATION} N m\"\n",
        rig.pickup.marks, rig.arm.natural_frequency, rig.arm.damping_ratio,
    ));
    if has("rig/ball_pass") {
        text.push_str(&format!(
            "\n[signals.cage]\nchannel = \"rig/ball_pass\"\nkind = \"passings\"\nball_count = {}\nrolling_ratio = {rolling_ratio}\n",
            rig.bearing.ball_count,
        ));
    }
    text.push_str("\n[signals.temperature]\nchannel = \"rig/temperature\"\n");
    text
}
