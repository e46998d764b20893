//! Every named result of a measurement with law, source and valid range.

use crate::analyse::signals::asked::{Asked, median};
use crate::analyse::signals::found::Found;
use crate::analyse::signals::shaft::Seen;
use crate::analyse::signals::torque;
use crate::result::list::{List, Origin};
use crate::result::outcome::{Quantity, Value};
use measure::pulse::{Gap, Pulses};

/// Names the results; what no channel was given for has none.
pub(crate) fn quantities(asked: &Asked, found: &Found) -> Vec<Quantity> {
    let mut list = List::default();
    listing(&mut list, asked);
    if asked.speed.is_some() {
        speed(&mut list, found);
    }
    if asked.torque.is_some() {
        torque(&mut list, asked, found);
    }
    if asked.cage.is_some() {
        cage(&mut list, found);
    }
    crate::analyse::signals::answer_analysis::name(&mut list, asked, found);
    list.quantities
}

fn listing(list: &mut List, asked: &Asked) {
    let texts = asked.listed.iter().map(|channel| {
        let unit = match channel.unit.as_str() {
            "" => "without a unit".to_string(),
            unit => format!("in {unit}"),
        };
        let rate = channel.rate.map_or("no even clock".to_string(), |rate| {
            format!(
                "{} values a second",
                units::number_text((rate * 1e6).round() / 1e6)
            )
        });
        format!(
            "{} ({unit}, {} values, {rate})",
            channel.name, channel.count
        )
    });
    let texts: Vec<String> = texts.collect();
    list.push("channels", "", Value::Text(texts.join("; ")), &FILE);
    let notes = match asked.notes.as_slice() {
        [] => "none".to_string(),
        notes => notes.join("; "),
    };
    list.push("file_notes", "", Value::Text(notes), &FILE);
}

fn speed(list: &mut List, found: &Found) {
    let shaft = found.shaft.as_ref().ok_or_else(|| found.why("speed"));
    let change = || {
        let shaft = shaft.as_ref().map_err(|why| why.to_string())?;
        shaft
            .speed
            .change
            .ok_or_else(|| "there is no quick change of speed in the record".to_string())
    };
    let of = |value: &dyn Fn(&crate::analyse::signals::shaft::Found) -> f64| {
        shaft
            .as_ref()
            .map(|s| value(s))
            .map_err(|why| why.to_string())
    };
    let channel = shaft.as_ref().ok().and_then(|shaft| match &shaft.seen {
        Seen::Channel(channel) => Some(channel),
        Seen::Marks { .. } => None,
    });
    if let Some(channel) = channel {
        list.number("speed_noise", "rad/s", Ok(channel.noise), &CHANNEL);
        list.number("speed_step", "rad/s", Ok(channel.step), &CHANNEL);
    }
    let of_pulses = |value: &dyn Fn(&Pulses) -> f64| {
        let shaft = shaft.as_ref().map_err(|why| why.to_string())?;
        shaft.pulses().map(value)
    };
    list.number(
        "pulse_count",
        "",
        of_pulses(&|pulses| pulses.times.len() as f64),
        &PULSES,
    );
    list.number(
        "pulses_repaired_share",
        "1",
        of_pulses(&|pulses| pulses.repaired),
        &PULSES,
    );
    for (name, end) in [
        ("pickup_silent_from", (|gap| gap.from) as fn(&Gap) -> f64),
        ("pickup_silent_to", |gap| gap.to),
    ] {
        let value = match &shaft {
            Ok(shaft) => Value::List(shaft.speed.gaps().map(end).collect()),
            Err(why) => Value::None {
                why: why.to_string(),
            },
        };
        list.push(name, "s", value, &SILENT);
    }
    list.number(
        "pulse_timing_factor",
        "1",
        of_pulses(&|_| shaft.as_ref().map_or(f64::NAN, |s| s.speed.timing_factor)),
        &SPEED,
    );
    let pitch = shaft
        .as_ref()
        .map_err(|why| why.to_string())
        .and_then(|s| match &s.seen {
            Seen::Marks {
                pulses,
                pitch: Some(p),
            } => {
                let worst = p.errors.iter().fold(0.0_f64, |most, e| most.max(e.abs()));
                Ok(worst / pulses.pitch())
            }
            _ => Err(s
                .pulses()
                .err()
                .unwrap_or_else(|| "the marks were not calibrated".to_string())),
        });
    list.number("largest_mark_error_share_of_pitch", "1", pitch, &PITCH);
    list.number(
        "mean_speed",
        "rad/s",
        of(&|s| {
            let (from, to) = s.speed.range();
            (s.speed.at(to).angle - s.speed.at(from).angle) / (to - from)
        }),
        &SPEED,
    );
    list.number("peak_speed", "rad/s", of(&|s| s.fastest.speed), &SPEED);
    list.number(
        "peak_speed_deviation",
        "rad/s",
        of(&|s| s.fastest.speed_uncertainty()),
        &SPEED,
    );
    list.number(
        "peak_acceleration",
        "rad/s^2",
        of(&|s| s.peak.acceleration),
        &PEAK_ACCELERATION,
    );
    list.number(
        "peak_acceleration_deviation",
        "rad/s^2",
        of(&|s| s.peak.acceleration_uncertainty()),
        &SPEED,
    );
    list.number(
        "time_of_peak_acceleration",
        "s",
        of(&|s| s.peak.time),
        &SPEED,
    );
    list.number(
        "engagement_time",
        "s",
        change().map(|c| c.engagement.0),
        &CHANGE,
    );
    list.number(
        "engagement_time_deviation",
        "s",
        change().map(|c| c.engagement.1),
        &CHANGE,
    );
    let end = || {
        change()?
            .end
            .ok_or_else(|| "the record ends before the change does".to_string())
    };
    list.number("change_end_time", "s", end().map(|end| end.0), &CHANGE);
    list.number(
        "change_end_time_deviation",
        "s",
        end().map(|end| end.1),
        &CHANGE,
    );
    list.number(
        "pulses_in_change",
        "",
        change().and_then(|c| match channel {
            None => Ok(c.pulses as f64),
            Some(_) => Err("signals.speed.channel holds a speed, not marks".to_string()),
        }),
        &CHANGE,
    );
    let rest = change().map(|c| if c.from_rest { "yes" } else { "no" });
    let rest = rest.map_or_else(
        |why| Value::None { why },
        |word| Value::Text(word.to_string()),
    );
    list.push("change_from_rest", "", rest, &CHANGE);
}

fn torque(list: &mut List, asked: &Asked, found: &Found) {
    let part = found.torque.as_ref().ok_or_else(|| found.why("torque"));
    let series = asked.torque.as_ref().ok_or_else(|| found.why("torque"));
    let faults = series
        .as_ref()
        .map(|series| torque::faulty(series))
        .map_err(|why| why.to_string());
    let count = |value: fn(&torque::Faulty) -> usize| {
        faults
            .as_ref()
            .map(|f| value(f) as f64)
            .map_err(|why| why.to_string())
    };
    list.number("torque_clipped_values", "", count(|f| f.clipped), &FAULTS);
    list.number("torque_stuck_values", "", count(|f| f.stuck), &FAULTS);
    list.number("torque_missing_values", "", count(|f| f.missing), &FAULTS);
    let sensor = || match &part {
        Ok(part) => part.sensor.ok_or_else(|| "no sensor is given".to_string()),
        Err(why) => Err(why.clone()),
    };
    list.number(
        "sensor_frequency",
        "Hz",
        sensor().map(|s| s.frequency.value),
        &SENSOR,
    );
    list.number(
        "sensor_frequency_deviation",
        "Hz",
        sensor().map(|s| s.frequency.deviation),
        &SENSOR,
    );
    list.number(
        "sensor_damping_ratio",
        "1",
        sensor().map(|s| s.damping_ratio.value),
        &SENSOR,
    );
    list.number(
        "sensor_damping_ratio_deviation",
        "1",
        sensor().map(|s| s.damping_ratio.deviation),
        &SENSOR,
    );
    let inverted = || match &part {
        Ok(part) => part
            .torque
            .as_ref()
            .ok_or_else(|| "no sensor is given".to_string()),
        Err(why) => Err(why.clone()),
    };
    let largest = |values: &[f64]| {
        let known = (0..values.len()).filter(|place| values[*place].is_finite());
        let place = known.max_by(|a, b| values[*a].abs().total_cmp(&values[*b].abs()));
        place.unwrap_or(0)
    };
    let pick = |values: &[f64], place: usize| values.get(place).copied().unwrap_or(f64::NAN);
    // the largest may be where a clipped reading hides it
    let whole = || {
        let hidden = part.as_ref().ok().and_then(|part| part.hidden.clone());
        hidden.map_or_else(&inverted, Err)
    };
    list.number(
        "peak_torque",
        "N m",
        whole().map(|t| pick(&t.torque, largest(&t.torque))),
        &TORQUE,
    );
    list.number(
        "peak_torque_deviation",
        "N m",
        whole().map(|t| pick(&t.deviation, largest(&t.torque))),
        &TORQUE,
    );
    list.number(
        "time_of_peak_torque",
        "s",
        whole().map(|t| pick(&t.time, largest(&t.torque))),
        &TORQUE,
    );
    list.number(
        "median_torque_deviation",
        "N m",
        whole().map(|t| median(&t.deviation)),
        &TORQUE,
    );
    list.number(
        "largest_synchronous_disturbance",
        "N m",
        whole().map(|t| pick(&t.disturbance, largest(&t.disturbance))),
        &TORQUE,
    );
    list.number(
        "disturbance_power",
        "1",
        inverted().map(|t| t.disturbance_power),
        &TORQUE,
    );
    list.number(
        "torque_zero",
        "N m",
        inverted().map(|t| t.zero.value),
        &TORQUE,
    );
    list.number(
        "torque_zero_deviation",
        "N m",
        inverted().map(|t| t.zero.deviation),
        &TORQUE,
    );
    list.number("torque_noise", "N m", inverted().map(|t| t.noise), &TORQUE);
    let lines = |value: fn(&measure::spectrum::Spectrum) -> &[f64]| match &part {
        Ok(part) => match &part.spectrum {
            Ok(spectrum) => Value::List(value(spectrum).to_vec()),
            Err(why) => Value::None { why: why.clone() },
        },
        Err(why) => Value::None { why: why.clone() },
    };
    list.push(
        "torque_spectrum_frequencies",
        "Hz",
        lines(|s| &s.frequency),
        &SPECTRUM,
    );
    list.push(
        "torque_spectrum_amplitudes",
        "N m",
        lines(|s| &s.amplitude),
        &SPECTRUM,
    );
    for (name, unit, pick) in [
        (
            "sensor_design_frequencies",
            "Hz",
            (|e| e.frequency) as fn(&measure::torque_sensor::DesignError) -> f64,
        ),
        ("sensor_design_raw_errors", "N m", |e| e.raw),
        ("sensor_design_inverted_errors", "N m", |e| e.inverted),
    ] {
        let value = match &part {
            Ok(part) => match &part.design {
                Ok(errors) => Value::List(errors.iter().map(pick).collect()),
                Err(why) => Value::None { why: why.clone() },
            },
            Err(why) => Value::None { why: why.clone() },
        };
        list.push(name, unit, value, &DESIGN);
    }
}

fn cage(list: &mut List, found: &Found) {
    let cage = found.cage.as_ref().ok_or_else(|| found.why("cage"));
    let of = |value: &dyn Fn(&measure::cage_speed::CageSpeed) -> f64| {
        cage.as_ref()
            .map(|found| value(&found.told))
            .map_err(|why| why.to_string())
            .and_then(|value| match value.is_nan() {
                true => Err("the cage speed has no value there: the warnings say why".to_string()),
                false => Ok(value),
            })
    };
    let last = |values: &[f64]| values.last().copied().unwrap_or(f64::NAN);
    list.number("median_cage_slip", "1", of(&|c| median(&c.slip)), &CAGE);
    list.number(
        "median_cage_slip_deviation",
        "1",
        of(&|c| median(&c.slip_deviation)),
        &CAGE,
    );
    list.number("cage_slip_at_end", "1", of(&|c| last(&c.slip)), &CAGE);
    list.number(
        "cage_slip_at_end_deviation",
        "1",
        of(&|c| last(&c.slip_deviation)),
        &CAGE,
    );
    list.number("cage_speed_at_end", "rad/s", of(&|c| last(&c.speed)), &CAGE);
    list.number("cage_angle_noise", "rad", of(&|c| c.noise), &CAGE);
}

const FILE: Origin = Origin {
    law: "as stated in the file",
    source: "the measurement file, crates/recording/src/file",
    valid: "as far as the file could be read",
};
const PULSES: Origin = Origin {
    law: "crossings of the middle between the two levels of the signal; gaps are counted, doubles are left out",
    source: "crates/measure/src/pulse",
    valid: "pulses of one wheel that turns forward",
};
const CHANNEL: Origin = Origin {
    law: "noise of one value by likelihood, or as stated; the smallest step between values",
    source: "crates/measure/src/speed/channel",
    valid: "noise that changes from value to value",
};
const SILENT: Origin = Origin {
    law: "intervals in which six marks or more passed unseen, or the signal is missing; speeds in between follow from both sides, and no extreme is taken there",
    source: "crates/measure/src/pulse/gap.rs",
    valid: "a shaft that does not brake and speed up again unseen",
};
const PITCH: Origin = Origin {
    law: "largest error of a mark, from revolutions at even speed, over the pitch",
    source: "crates/measure/src/pulse/pitch.rs",
    valid: "an error of the wheel that does not change; a ripple once a turn is taken for one",
};
const SPEED: Origin = Origin {
    law: "smoothing spline of the seventh degree through the pulses, or of a speed through what its instrument makes of it, as stiff as their likelihood asks for; deviation: standard",
    source: "Bierman 1977 (filter and smoother), crates/measure/src/speed; bands compared with 400 synthetic records in crates/measure/tests/speed_coverage.rs",
    valid: "one quick change in the record; no ripple quicker than two marks can show",
};
const PEAK_ACCELERATION: Origin = Origin {
    law: "largest acceleration within the quick change in the direction in which it changes the speed; where there is none, the largest of the record by size; with its sign",
    source: SPEED.source,
    valid: SPEED.valid,
};
const CHANGE: Origin = Origin {
    law: "knots of the spline at which acceleration or its rate may jump, by likelihood",
    source: "Bierman 1977 (filter and smoother), crates/measure/src/speed",
    valid: "one quick change in the record",
};
const FAULTS: Origin = Origin {
    law: "values held at the highest or lowest value, held longer than the noise allows, or not there",
    source: "Bennett 1948 (rounding), crates/measure/src/converter.rs",
    valid: "a channel with noise of its own",
};
const SENSOR: Origin = Origin {
    law: "ÿ + 2ζω ẏ + ω² y = ω² (T + d), as given or from its free response",
    source: "Golub and Pereyra 1973, Newey and West 1987, crates/measure/src/torque_sensor/response.rs",
    valid: "one degree of freedom, small swings",
};
const TORQUE: Origin = Origin {
    law: "torque, zero and disturbance once a turn jointly, by smoothing of an unknown input; deviation: standard",
    source: "crates/measure/src/torque_sensor/inversion.rs",
    valid: "a sensor of one degree of freedom with frequency and damping known to their deviations",
};
const DESIGN: Origin = Origin {
    law: "root mean square error of the torque after the engagement, of the reading and of its inversion, by simulated tests",
    source: "crates/measure/src/torque_sensor/design.rs",
    valid: "a linear sensor that is known exactly, with the decay, noise and disturbance of the one there is",
};
const SPECTRUM: Origin = Origin {
    law: "mean of overlapping Hann segments; amplitude of a sine, peak",
    source: "Welch 1967, crates/measure/src/spectrum",
    valid: "lines that stand still for a segment; a changing speed smears them",
};
const CAGE: Origin = Origin {
    law: "slip = 1 - cage speed/(rolling ratio times shaft speed); the deviation from rolling is smoothed; deviation: standard",
    source: "Viterbi 1967, Baum et al. 1970, crates/measure/src/cage_speed",
    valid: "a cage that does not turn backwards; the ratio as given",
};
