//! Every named result of a measurement with law, source and valid range.

use crate::signals::answer_analysis;
use crate::signals::estimate::Estimate;
use crate::signals::request::{Request, median};
use crate::signals::torque::{Faulty, faulty};
use outcome::Quantity;
use outcome::list::results;
use outcome::list::{List, origins};
use problem::note::Note;
use scenario::PickupKind;

/// Names the results, of what was not asked for none; without a second argument those of any such measurement.
pub(crate) fn name(asked: &Request, found: Option<&Estimate>) -> Vec<Quantity> {
    let mut list = List::default();
    file(&mut list, asked, found);
    if asked.speed.is_some() {
        speed(&mut list, asked, found);
    }
    if let Some(series) = &asked.torque {
        let faults = found.map(|_| faulty(series));
        reading(&mut list, asked, faults.as_ref());
        torque(&mut list, asked, found);
    }
    if asked.cage.is_some() {
        cage(&mut list, asked, found);
    }
    answer_analysis::name(&mut list, asked, found);
    list.quantities
}

results! {
    fn file(asked: &Request, run: &Estimate) {
        "channels": text "" headline, FILE, "channels of the file with unit, number of values and rate" in channels "channels" => asked.channels();
        "file_notes": text "", FILE, "what to know of the file" => match asked.notes.as_slice() {
            [] => "none".to_string(),
            notes => notes.iter().map(Note::to_string).collect::<Vec<_>>().join("; "),
        };
    }

    fn speed(asked: &Request, run: &Estimate) {
        "speed_noise": number "rad/s", CHANNEL, "noise of one value of the channel" when asked.holds_speed() => run.channel().map(|c| c.noise);
        "speed_step": number "rad/s", CHANNEL, "smallest step of the channel" when asked.holds_speed() => run.channel().map(|c| c.step);
        "pulse_count": number "" headline, PULSES, "number of pulses" => run.pulses().map(|pulses| pulses.times.len() as f64);
        "pulses_repaired_share": number "1" headline, PULSES, "share of pulses that were missing or double" in repairs "pulses that were missing or too many, share" => run.pulses().map(|pulses| pulses.repaired);
        "pickup_silent_from": list "s", SILENT, "beginnings of the gaps in the signal" => run.over_gaps(|gap| gap.from);
        "pickup_silent_to": list "s", SILENT, "ends of the gaps in the signal" => run.over_gaps(|gap| gap.to);
        "pulse_timing_factor": number "1", SPEED, "scatter of the pulses over that stated" in repairs "scatter of the pulses over what their flanks promise" => {
            run.pulses().and_then(|_| run.shaft().map(|s| s.speed.timing_factor))
        };
        "largest_mark_error_share_of_pitch": number "1", PITCH, "largest error of a mark over the pitch" in repairs "largest error of a mark, share of the pitch (taken out)" => run.shaft().and_then(|s| s.largest_mark_error());
        "mean_speed": number "rad/s", SPEED, "mean speed of the record" => run.shaft().map(|s| s.mean_speed());
        "peak_speed": number "rad/s" headline, SPEED, "largest speed" in tile "Largest speed" in shaft_speed "speed" => run.shaft().map(|s| s.fastest.speed);
        "peak_speed_deviation": number "rad/s", SPEED, "its standard deviation" => run.shaft().map(|s| s.fastest.speed_uncertainty());
        "peak_acceleration": number "rad/s^2" headline, PEAK_ACCELERATION, "largest acceleration" in tile "Largest acceleration" => run.shaft().map(|s| s.peak.acceleration);
        "peak_acceleration_deviation": number "rad/s^2" headline, SPEED, "its standard deviation" => run.shaft().map(|s| s.peak.acceleration_uncertainty());
        "time_of_peak_acceleration": number "s", SPEED, "when the acceleration is largest" => run.shaft().map(|s| s.peak.time);
        "engagement_time": number "s" headline, CHANGE, "when the quick change of speed begins" in tile "Engagement" in instants "engaged" in change "engaged" => run.change().map(|c| c.engagement.0);
        "engagement_time_deviation": number "s", CHANGE, "its standard deviation" => run.change().map(|c| c.engagement.1);
        "change_end_time": number "s", CHANGE, "when the quick change of speed ends" in instants "end of the change" in change "end of the change" => run.change_end().map(|end| end.0);
        "change_end_time_deviation": number "s", CHANGE, "its standard deviation" => run.change_end().map(|end| end.1);
        "pulses_in_change": number "", CHANGE, "number of pulses in it" in pulses "in the change" => run.change().and_then(|c| run.pulses().map(|_| c.pulses as f64));
        "change_from_rest": text "", CHANGE, "whether the shaft rested before it" => run.change().map(|c| if c.from_rest { "yes" } else { "no" });
    }

    fn reading(asked: &Request, run: &Faulty) {
        "torque_clipped_values": number "", FAULTS, "values at the limit of the converter" in repairs "torque: values at the limit of the converter" => run.clipped as f64;
        "torque_stuck_values": number "", FAULTS, "values held without noise" in repairs "torque: values held without noise" => run.stuck as f64;
        "torque_missing_values": number "", FAULTS, "values that are no numbers" in repairs "torque: values that are no numbers" => run.missing as f64;
    }

    fn torque(asked: &Request, run: &Estimate) {
        "sensor_frequency": number "Hz" headline, SENSOR, "natural frequency of the sensor" in sensor "sensor" => run.sensor().map(|s| s.frequency.value);
        "sensor_frequency_deviation": number "Hz", SENSOR, "its standard deviation" => run.sensor().map(|s| s.frequency.deviation);
        "sensor_damping_ratio": number "1", SENSOR, "damping ratio of the sensor" => run.sensor().map(|s| s.damping_ratio.value);
        "sensor_damping_ratio_deviation": number "1", SENSOR, "its standard deviation" => run.sensor().map(|s| s.damping_ratio.deviation);
        "peak_torque": number "N m" headline, TORQUE, "largest torque" in tile "Largest torque" in sensor_torque "the torque without the sensor's swing" => run.whole_torque().map(|t| at_largest(&t.torque, &t.torque));
        "peak_torque_deviation": number "N m", TORQUE, "its standard deviation" => run.whole_torque().map(|t| at_largest(&t.torque, &t.deviation));
        "time_of_peak_torque": number "s", TORQUE, "when the torque is largest" => run.whole_torque().map(|t| at_largest(&t.torque, &t.time));
        "median_torque_deviation": number "N m" headline, TORQUE, "median of the standard deviation of the torque" => run.whole_torque().map(|t| median(&t.deviation));
        "largest_synchronous_disturbance": number "N m" headline, TORQUE, "largest disturbance once a turn" => {
            run.whole_torque().map(|t| at_largest(&t.disturbance, &t.disturbance))
        };
        "disturbance_power": number "1", TORQUE, "power of the speed with which the disturbance grows" => run.inverted().map(|t| t.disturbance_power);
        "torque_zero": number "N m", TORQUE, "zero of the reading" => run.inverted().map(|t| t.zero.value);
        "torque_zero_deviation": number "N m", TORQUE, "its standard deviation" => run.inverted().map(|t| t.zero.deviation);
        "torque_noise": number "N m", TORQUE, "noise of the reading" => run.inverted().map(|t| t.noise);
        "torque_spectrum_frequencies": list "Hz", SPECTRUM, "frequencies in the reading" in spectrum "frequency [Hz]" => run.torque(|t| &t.spectrum).map(|s| s.frequency.clone());
        "torque_spectrum_amplitudes": list "N m", SPECTRUM, "amplitudes of the reading at these" in spectrum "amplitude" => run.torque(|t| &t.spectrum).map(|s| s.amplitude.clone());
        "sensor_design_frequencies": list "Hz", DESIGN, "frequencies of other sensors" in sensor_design "frequency of the sensor [Hz]" => run.designs(|e| e.frequency);
        "sensor_design_raw_errors": list "N m", DESIGN, "error of the reading of each of them" in sensor_design "reading as it is" => run.designs(|e| e.raw);
        "sensor_design_inverted_errors": list "N m", DESIGN, "error of the torque from each of them" in sensor_design "inverted" => run.designs(|e| e.inverted);
    }

    fn cage(asked: &Request, run: &Estimate) {
        "median_cage_slip": number "1" headline, CAGE, "median of the slip of the cage" in tile "Median slip of the cage [%]" => run.cage(|c| median(&c.slip));
        "median_cage_slip_deviation": number "1" headline, CAGE, "median of its standard deviation" => run.cage(|c| median(&c.slip_deviation));
        "cage_slip_at_end": number "1", CAGE, "slip of the cage at the end" => run.cage(|c| last(&c.slip));
        "cage_slip_at_end_deviation": number "1", CAGE, "its standard deviation" => run.cage(|c| last(&c.slip_deviation));
        "cage_speed_at_end": number "rad/s", CAGE, "speed of the cage at the end" in cage_speed "the cage" => run.cage(|c| last(&c.speed));
        "cage_angle_noise": number "rad", CAGE, "noise of the angle of the cage" => run.cage(|c| c.noise);
    }
}

fn last(values: &[f64]) -> f64 {
    values.last().copied().unwrap_or(f64::NAN)
}

/// What stands where the size of some values is largest.
fn at_largest(sizes: &[f64], values: &[f64]) -> f64 {
    let known = (0..sizes.len()).filter(|place| sizes[*place].is_finite());
    let place = known.max_by(|a, b| sizes[*a].abs().total_cmp(&sizes[*b].abs()));
    let value = values.get(place.unwrap_or(0));
    value.copied().unwrap_or(f64::NAN)
}

impl Request {
    /// The channels in words.
    fn channels(&self) -> String {
        let texts = self.listed.iter().map(|channel| {
            let unit = match channel.unit.as_str() {
                "" => "without a unit".to_string(),
                unit => format!("in {unit}"),
            };
            let rate = channel.rate.map_or("no even clock".to_string(), |rate| {
                let rate = units::number_text((rate * 1e6).round() / 1e6);
                format!("{rate} values a second")
            });
            let (name, count) = (&channel.name, channel.count);
            format!("{name} ({unit}, {count} values, {rate})")
        });
        texts.collect::<Vec<_>>().join("; ")
    }

    /// Whether the channel of the speed holds a speed, not marks.
    fn holds_speed(&self) -> bool {
        let kind = self.signals.speed.as_ref().map(|speed| speed.kind);
        matches!(kind, Some(PickupKind::Speed { .. }))
    }
}

origins! {
    FILE: law "as stated in the file",
        source "the measurement file, crates/recording/src/file",
        valid "as far as the file could be read";
    PULSES: law "crossings of the middle between the two levels of the signal; gaps are counted, doubles are left out",
        source "crates/measure/src/pulse",
        valid "pulses of one wheel that turns forward";
    CHANNEL: law "noise of one value by likelihood, or as stated; the smallest step between values",
        source "crates/measure/src/speed/channel",
        valid "noise that changes from value to value";
    SILENT: law "intervals in which six marks or more passed unseen, or the signal is missing; speeds in between follow from both sides, and no extreme is taken there",
        source "crates/measure/src/pulse/gap.rs",
        valid "a shaft that does not brake and speed up again unseen";
    PITCH: law "largest error of a mark, from revolutions at even speed, over the pitch",
        source "crates/measure/src/pulse/pitch.rs",
        valid "an error of the wheel that does not change; a ripple once a turn is taken for one";
    SPEED: law "smoothing spline of the seventh degree through the pulses, or of a speed through what its instrument makes of it, as stiff as their likelihood asks for; deviation: standard",
        source "Bierman 1977 (filter and smoother), crates/measure/src/speed; bands compared with 400 synthetic records in crates/measure/tests/speed_coverage.rs",
        valid "one quick change in the record; no ripple quicker than two marks can show";
    PEAK_ACCELERATION: law "largest acceleration within the quick change in the direction in which it changes the speed; where there is none, the largest of the record by size; with its sign",
        source SPEED.source,
        valid SPEED.valid;
    CHANGE: law "knots of the spline at which acceleration or its rate may jump, by likelihood",
        source "Bierman 1977 (filter and smoother), crates/measure/src/speed",
        valid "one quick change in the record";
    FAULTS: law "values held at the highest or lowest value, held longer than the noise allows, or not there",
        source "Bennett 1948 (rounding), crates/measure/src/converter.rs",
        valid "a channel with noise of its own";
    SENSOR: law "ÿ + 2ζω ẏ + ω² y = ω² (T + d), as given or from its free response",
        source "Golub and Pereyra 1973, Newey and West 1987, crates/measure/src/torque_sensor/response.rs",
        valid "one degree of freedom, small swings";
    TORQUE: law "torque, zero and disturbance once a turn jointly, by smoothing of an unknown input; deviation: standard",
        source "crates/measure/src/torque_sensor/inversion.rs",
        valid "a sensor of one degree of freedom with frequency and damping known to their deviations";
    DESIGN: law "root mean square error of the torque after the engagement, of the reading and of its inversion, by simulated tests",
        source "crates/measure/src/torque_sensor/design.rs",
        valid "a linear sensor that is known exactly, with the decay, noise and disturbance of the one there is";
    SPECTRUM: law "mean of overlapping Hann segments; amplitude of a sine, peak",
        source "Welch 1967, crates/measure/src/spectrum",
        valid "lines that stand still for a segment; a changing speed smears them";
    CAGE: law "slip = 1 - cage speed/(rolling ratio times shaft speed); the deviation from rolling is smoothed; deviation: standard",
        source "Viterbi 1967, Baum et al. 1970, crates/measure/src/cage_speed",
        valid "a cage that does not turn backwards; the ratio as given";
}
