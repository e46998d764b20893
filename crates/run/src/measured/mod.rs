//! Measured channels beside predicted columns, at the samples of the file: `[[measured]]`.
//!
//! ```text
//!   file ──recording::over_time──▶ Curve ──predicted at its samples──▶ Compared ──▶ differences
//!                                    └──before the release──▶ noise ─────┴────────▶ features of both curves by one estimator each
//! ```
//! | page | subject |
//! |---|---|
//! | here | channels of files on the run's clock; columns `measured.*`; differences with what the noise of a channel explains |
//! | [`before`] | the stretch before the release: mean, synchronous orbit, noise |
//! | [`features`] | contact, rebound, spin-up, orbit: of the measured and of the predicted curve, with their uncertainty |
//! | [`samples`] | samples that no motion makes, and what a straight line explains |
//! | [`warnings`] | what the comparison does not show |
//!
//! Not modelled: errors of the clock, drift and offset of a sensor; noise is taken as that of one standard deviation throughout.

mod before;
mod features;
mod samples;
pub(crate) mod warnings;

use before::{Before, Turning};
use outcome::limits::is_of;
use outcome::list::{List, origins, results};
use outcome::{Column, Outcome, Quantity, counted_from};
use problem::{Code, Result, did_you_mean};
use recording::over_time::{Unread, Wanted, over_time};
use scenario::{Measured, Scenario};
use statistics::interpolation::between;
use statistics::noise::Noise;
use units::{Unit, number_text};

/// Samples further apart than this times the median interval have a gap between them.
const GAP: f64 = 3.5;
/// Standard deviations of the band whose share is told.
const BAND: f64 = 2.0;
/// Values of a file within the run, at least.
const FEWEST: usize = 2;
/// What names of results and columns begin with.
const MEASURED: &str = "measured";

/// A measured channel on the clock of the run.
#[derive(Debug)]
pub(crate) struct Curve {
    given: Measured,
    /// What results and columns call it.
    pub name: String,
    unit: &'static str,
    times: Vec<f64>,
    values: Vec<f64>,
    /// Between samples further apart than this it has no value, s.
    longest: f64,
}

/// A measured and a predicted curve at the samples of a file that lie within the run.
#[derive(Debug, Default)]
pub(crate) struct Compared {
    /// From the release on, s.
    pub time: Vec<f64>,
    pub measured: Vec<f64>,
    pub predicted: Vec<f64>,
    before: Before,
    /// Where its first gap after the release begins, s from the release.
    gap: Option<f64>,
    /// Share of the run from its first contact on in which the file has values.
    covered: f64,
}

/// Reads the channels that a scenario names, and checks that the run has such columns.
///
/// # Errors
/// What is wrong with a table or its file.
pub(crate) fn read(scenario: &Scenario, columns: &[Column]) -> Result<Vec<Curve>> {
    let end = (scenario.resolved.get("run.duration")).and_then(|value| value.value_si);
    let until = scenario.resolved.get("run.until");
    let ends = until.is_none_or(|until| until.text.as_deref() == Some("duration"));
    let end = end.filter(|_| ends).unwrap_or(f64::INFINITY);
    let curve = |given: &Measured| Curve::read(given, columns, end);
    scenario.measured.iter().map(curve).collect()
}

impl Curve {
    fn read(given: &Measured, columns: &[Column], end: f64) -> Result<Curve> {
        let names = || columns.iter().map(|column| column.name.as_str());
        let known = columns.iter().find(|column| column.name == given.column);
        let Some(column) = known.filter(|column| column.name != "time") else {
            let found = format!("\"{}\", which is no column of this run", given.column);
            let last = |name: &str| name.rsplit('.').next().map(str::to_string);
            // those that end like it first
            let (alike, others): (Vec<&str>, Vec<&str>) =
                (names().skip(1)).partition(|name| last(name) == last(&given.column));
            let few: Vec<&str> = alike.into_iter().chain(others).take(8).collect();
            let needed = format!(
                "a column of its history is needed, such as {}; without this table auxbear results FILE lists all",
                few.join(", ")
            );
            let problem = given.problem(Code::UnknownQuantity, "column", found, needed);
            return Err(problem.with_hint(did_you_mean(&given.column, names())));
        };
        let refused = |why: Unread| {
            let (key, needed) = match why.code {
                Code::MeasurementUnreadable => ("file", why.needed),
                _ if why.of_clock => ("channel", why.needed),
                Code::ChannelUnit if given.unit.is_some() => ("unit", why.needed),
                Code::ChannelUnit => ("channel", format!("{}, or measured.unit", why.needed)),
                _ => ("channel", why.needed),
            };
            (given.problem(why.code, key, why.found, needed)).with_hint(why.hint)
        };
        if let Some((_, dimension, text)) = &given.deviation
            && Unit::parse(column.unit).is_ok_and(|unit| unit.dimension() != *dimension)
        {
            let needed = format!("a quantity of the kind of {} is needed", column.unit);
            return Err(given.problem(Code::WrongDimension, "deviation", text.clone(), needed));
        }
        let mut recording = recording::open(&given.file).map_err(|why| refused(why.into()))?;
        let wanted = Wanted {
            unit: column.unit,
            own: given.unit.as_deref(),
            scale: given.scale,
        };
        let rows = over_time(recording.as_mut(), &given.channel, wanted).map_err(refused)?;
        let (times, values): (Vec<f64>, Vec<f64>) = (rows.iter())
            .map(|[time, value]| (time + given.clock_offset, *value))
            .unzip();
        let mut intervals: Vec<f64> = times.windows(2).map(|two| two[1] - two[0]).collect();
        intervals.sort_by(f64::total_cmp);
        let curve = Curve {
            longest: GAP * intervals[intervals.len() / 2],
            name: given.name(),
            given: given.clone(),
            unit: column.unit,
            times,
            values,
        };
        let [first, last] = curve.span();
        let inside = curve
            .times
            .iter()
            .filter(|time| (0.0..=end).contains(*time));
        if inside.count() >= FEWEST {
            return Ok(curve);
        }
        let [first, last] = [first, last].map(|time| number_text((1e6 * time).round() / 1e6));
        let apart = number_text((1e6 * curve.interval()).round() / 1e6);
        let found = format!(
            "a file from {first} s to {last} s on the clock of the run, a value every {apart} s"
        );
        let end = number_text(end);
        let needed = format!(
            "one with {FEWEST} values at least within the run, from 0 s to {end} s, is needed: clock_offset is the instant of the run at which time 0 of the file lies, and the unit of its times is in the file"
        );
        Err(given.problem(Code::ChannelClock, "clock_offset", found, needed))
    }

    /// First and last instant, s.
    fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.times.len() - 1]]
    }

    /// Its value at an instant, straight between its samples; not a number outside and in a gap.
    fn at(&self, time: f64) -> f64 {
        let next = self.times.partition_point(|own| *own < time);
        // a row at a sample but for rounding has its value
        let rounding = 1e-6 * self.longest;
        let gap = |two: &[f64]| {
            let inside = time - two[0] > rounding && two[1] - time > rounding;
            inside && two[1] - two[0] > self.longest
        };
        match self.times.get(next.saturating_sub(1)..=next) {
            Some(two) if next > 0 && gap(two) => f64::NAN,
            _ => between(&self.times, &self.values, time).unwrap_or(f64::NAN),
        }
    }

    /// Median interval of its samples, s.
    fn interval(&self) -> f64 {
        self.longest / GAP
    }

    /// Its gaps within a run, from and to, s.
    fn gaps(&self, begin: f64, end: f64) -> impl Iterator<Item = [f64; 2]> {
        let inside = move |two: &&[f64]| two[1] > begin && two[0] < end;
        let wide = |two: &&[f64]| two[1] - two[0] > self.longest;
        let gaps = self.times.windows(2).filter(inside).filter(wide);
        gaps.map(|two| [two[0], two[1]])
    }

    /// The column of its name, at some instants.
    fn column(&self, times: &[f64]) -> Column {
        let file = self.given.file.file_name().unwrap_or_default();
        Column {
            name: format!("{MEASURED}.{}", self.name),
            unit: self.unit,
            meaning: format!(
                "measured: {} of {}, straight between its samples",
                self.given.channel,
                file.to_string_lossy()
            ),
            optional: false,
            values: times.iter().map(|time| self.at(*time)).collect(),
        }
    }

    /// Root mean square of this drop less the first.
    fn less_first(&self, run: &Run) -> Result<f64, String> {
        let is_first = |own: &&Curve| own.given.drop == 1 && own.given.column == self.given.column;
        let first = (run.curves.iter().find(is_first))
            .ok_or("no first drop of this column was measured")?;
        let apart = self
            .within(run.outcome)
            .map(|(time, own)| own - first.at(time));
        root_mean_square(apart.filter(|own| own.is_finite()), NOTHING_COMMON)
    }

    /// Its samples, instant and value, within a run.
    fn within(&self, outcome: &Outcome) -> impl Iterator<Item = (f64, f64)> {
        let time = outcome.column("time").map(|time| &time.values);
        let ends = time.and_then(|time| Some([*time.first()?, *time.last()?]));
        // a sample at the first or the last row but for rounding is inside
        let rounding = 1e-6 * self.longest;
        let both = self.times.iter().copied().zip(self.values.iter().copied());
        both.filter_map(move |(time, value)| {
            let [begin, end] = ends?;
            let inside = time >= begin - rounding && time <= end + rounding;
            inside.then_some((time.clamp(begin, end), value))
        })
    }

    /// Share of the run in which it has values: from the first contact that is predicted, or the release, to the end.
    fn covered(&self, outcome: &Outcome, release: f64) -> f64 {
        let from = release + first_contact(outcome).unwrap_or(0.0);
        let time = outcome.column("time");
        let end = time.and_then(|time| time.values.last().copied());
        let Some(end) = end.filter(|end| *end > from) else {
            return 1.0;
        };
        let within = self.times.windows(2);
        let within = within.filter(|two| two[1] - two[0] <= self.longest);
        let length = within.map(|two| (two[1].min(end) - two[0].max(from)).max(0.0));
        length.sum::<f64>() / (end - from)
    }

    fn compared(&self, outcome: &Outcome, release: f64, turning: Option<&Turning>) -> Compared {
        let mut compared = Compared {
            before: self.before(release, turning),
            gap: self
                .gaps(release, f64::INFINITY)
                .next()
                .map(|gap| gap[0] - release),
            covered: self.covered(outcome, release),
            ..Compared::default()
        };
        let [times, values] = ["time", &self.given.column]
            .map(|name| (outcome.column(name)).map_or(&[][..], |column| column.values.as_slice()));
        for (time, measured) in self.within(outcome) {
            let predicted = between(times, values, time).filter(|own| own.is_finite());
            if let Some(predicted) = predicted {
                compared.time.push(time - release);
                compared.measured.push(measured);
                compared.predicted.push(predicted);
            }
        }
        compared
    }
}

impl Compared {
    fn differences(&self) -> impl Iterator<Item = f64> {
        let both = self.measured.iter().zip(&self.predicted);
        both.map(|(measured, predicted)| measured - predicted)
    }

    /// Standard deviation of a measured value.
    fn deviation(&self) -> Option<f64> {
        self.before.noise.as_ref().map(|noise| noise.deviation)
    }

    /// Differences over the standard deviation; none where it is not known.
    pub fn residuals(&self) -> Option<Vec<f64>> {
        let deviation = self.deviation()?;
        Some(self.differences().map(|own| own / deviation).collect())
    }

    fn rms(&self) -> Result<f64, String> {
        root_mean_square(self.differences(), NOTHING_COMMON)
    }

    /// The largest difference, and its instant after the release.
    fn largest(&self) -> Result<(f64, f64), String> {
        let all = self.differences().zip(self.time.iter().copied());
        let largest = all.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
        largest.ok_or_else(|| NOTHING_COMMON.to_string())
    }

    /// Range of the predicted curve.
    fn range(&self) -> f64 {
        let (low, high) = ends(&self.predicted);
        high - low
    }

    fn relative(&self) -> Result<f64, String> {
        let noise = self.deviation().unwrap_or(0.0);
        let range = Some(self.range()).filter(|range| *range > noise);
        Ok(self.rms()? / range.ok_or("the predicted column does not move beyond noise")?)
    }

    fn misfit(&self) -> Result<f64, String> {
        let residuals = self.residuals().ok_or(NO_DEVIATION)?;
        root_mean_square(residuals.into_iter(), NOTHING_COMMON)
    }

    fn share(&self) -> Result<f64, String> {
        let residuals = self.residuals().ok_or(NO_DEVIATION)?;
        let within = residuals.iter().filter(|own| own.abs() <= BAND).count();
        let share = within as f64 / residuals.len() as f64;
        (share.is_finite().then_some(share)).ok_or_else(|| NOTHING_COMMON.to_string())
    }
}

/// The first contact of a run at any bearing, s from the release.
fn first_contact(outcome: &Outcome) -> Option<f64> {
    let contacts = outcome.quantities.iter();
    let contacts = contacts.filter(|own| is_of(&own.name, "time_to_first_contact"));
    let contacts = contacts.filter_map(|own| outcome.number(&own.name));
    contacts.reduce(f64::min)
}

/// Least and largest value.
fn ends(values: &[f64]) -> (f64, f64) {
    let empty = (f64::INFINITY, f64::NEG_INFINITY);
    (values.iter()).fold(empty, |(low, high), own| (low.min(*own), high.max(*own)))
}

const NOTHING_COMMON: &str = "file and run have no instant in common";
const NO_DEVIATION: &str = "the standard deviation of the channel is not known: measured.deviation, or 16 values that scatter, are needed";

fn root_mean_square(values: impl Iterator<Item = f64>, why: &str) -> Result<f64, String> {
    let (count, sum) = values.fold((0, 0.0), |(count, sum), own| (count + 1, sum + own * own));
    let mean = (count > 0).then(|| sum / f64::from(count));
    mean.map(f64::sqrt).ok_or_else(|| why.to_string())
}

/// Adds columns, results and warnings of the comparison to a run.
pub(crate) fn add(curves: &[Curve], outcome: &mut Outcome) {
    if curves.is_empty() {
        return;
    }
    let release = counted_from(&outcome.quantities).unwrap_or(0.0);
    let turning = before::turning(outcome, release);
    let compared = |curve: &Curve| curve.compared(outcome, release, turning.as_ref());
    let all: Vec<Compared> = curves.iter().map(compared).collect();
    let run = Run {
        outcome,
        release,
        curves,
        all: &all,
    };
    let (quantities, warnings) = (name(curves, Some(&run)), warnings::of(curves, &run));
    let times = outcome.column("time").map(|time| time.values.as_slice());
    let columns: Vec<Column> = times.map_or_else(Vec::new, |times| columns(curves, times));
    outcome.quantities.extend(quantities);
    outcome.warnings.extend(warnings);
    outcome.history.extend(columns);
}

/// Columns of the channels at some instants.
pub(crate) fn columns(curves: &[Curve], times: &[f64]) -> Vec<Column> {
    curves.iter().map(|curve| curve.column(times)).collect()
}

/// Differences over their deviations of each channel of the first drop whose deviation is known: what is predicted is that drop.
pub(crate) fn residuals(curves: &[Curve], outcome: &Outcome) -> Vec<Residuals> {
    let release = counted_from(&outcome.quantities).unwrap_or(0.0);
    let first = curves.iter().filter(|curve| curve.given.drop == 1);
    let turning = before::turning(outcome, release);
    let each = first.map(|curve| curve.compared(outcome, release, turning.as_ref()));
    let of = |own: Compared| {
        Some(Residuals {
            values: own.residuals()?,
            repetition: own
                .before
                .scatter
                .and(own.before.noise.as_ref())
                .map(Noise::repetition),
            known_by: own.before.known_by,
        })
    };
    each.filter_map(of).collect()
}

/// A channel of the first drop beside its prediction, for a picture.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// What results call it.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Instants after the release, s.
    pub time: Vec<f64>,
    /// Measured values.
    pub measured: Vec<f64>,
    /// Predicted values.
    pub predicted: Vec<f64>,
    /// Standard deviation of a measured value, where it is known.
    pub deviation: Option<f64>,
}

/// The channels of the first drop beside a run.
pub(crate) fn fitted(curves: &[Curve], outcome: &Outcome) -> Vec<Fitted> {
    let release = counted_from(&outcome.quantities).unwrap_or(0.0);
    let turning = before::turning(outcome, release);
    let first = curves.iter().filter(|curve| curve.given.drop == 1);
    let of = |curve: &Curve| {
        let own = curve.compared(outcome, release, turning.as_ref());
        Fitted {
            name: curve.name.clone(),
            unit: curve.unit,
            deviation: own.deviation(),
            time: own.time,
            measured: own.measured,
            predicted: own.predicted,
        }
    };
    first.map(of).collect()
}

/// Residuals of a channel.
#[derive(Clone, Debug, Default)]
pub(crate) struct Residuals {
    /// Differences over the deviation.
    pub values: Vec<f64>,
    /// How many neighbouring values of its noise before the release say the same, where that is known.
    pub repetition: Option<f64>,
    /// Independent values that the deviation is known by.
    pub known_by: f64,
}

/// A run with its channels.
pub(crate) struct Run<'a> {
    outcome: &'a Outcome,
    /// From which instants count, s.
    release: f64,
    curves: &'a [Curve],
    all: &'a [Compared],
}

impl Run<'_> {
    /// A column at an instant.
    fn at(&self, column: &str, time: f64) -> Option<f64> {
        let [times, values] = ["time", column].map(|name| self.outcome.column(name));
        between(&times?.values, &values?.values, time)
    }

    /// Misfit of all channels of the first drop.
    fn misfit(&self) -> Result<f64, String> {
        let both = self.curves.iter().zip(self.all);
        let first = both.filter(|(curve, _)| curve.given.drop == 1);
        let all = first.filter_map(|(_, own)| own.residuals());
        root_mean_square(all.flatten(), NO_DEVIATION)
    }

    /// Speed of the rotor at the release, rad/s; 0 without one.
    fn spin(&self) -> f64 {
        self.at("rotor.speed", self.release).map_or(0.0, f64::abs)
    }
}

/// Names the results of the comparison, without a run those of any.
pub(crate) fn name(curves: &[Curve], run: Option<&Run>) -> Vec<Quantity> {
    let mut list = List::default();
    if !curves.is_empty() {
        overall(&mut list, &(), run);
    }
    for (k, curve) in curves.iter().enumerate() {
        let own = run.map(|run| (&run.all[k], run));
        let first = list.quantities.len();
        list.named(&[&curve.name], |list| difference(list, curve, own.as_ref()));
        for quantity in &mut list.quantities[first..] {
            if quantity.unit == OF_COLUMN {
                quantity.unit = curve.unit;
            }
        }
        features::of_curve(&mut list, curve, own);
    }
    features::of_orbits(&mut list, curves, run);
    list.quantities
}

results! {
    fn overall(setup: &(), run: &Run) {
        "measured.misfit": number "1" headline, MISFIT, "root mean square of the misfits of all channels of the first drop" in tile "Measured less predicted, over noise" in bound "3" => {
run.misfit()
        };
    }
    fn difference(curve: &Curve, run: &(&Compared, &Run)) {
        "measured.*.deviation": number "of the column", DEVIATION, "standard deviation of the channel" in measured_difference "deviation of the channel" => run.0.deviation().ok_or_else(|| NO_DEVIATION.to_string());
        "measured.*.rms_difference": number "of the column", RMS, "root mean square of measured less predicted" in measured_difference "rms difference" => run.0.rms();
        "measured.*.largest_difference": number "of the column", LARGEST, "largest difference of measured less predicted" in measured_difference "largest difference" => run.0.largest().map(|(value, _)| value);
        "measured.*.largest_difference_at": number "s", LARGEST, "instant of the largest difference" in measured_difference "at" => run.0.largest().map(|(_, time)| time + run.1.release);
        "measured.*.relative_difference": number "1" headline, RELATIVE, "rms difference over the range of the prediction" in measured_difference "over the range [%]" => run.0.relative();
        "measured.*.misfit": number "1", MISFIT, "rms difference over the standard deviation of the channel" in measured_difference "over the deviation" => run.0.misfit();
        "measured.*.share_within_band": number "1", SHARE, "share of the samples within two standard deviations" in measured_difference "within two deviations [%]" => run.0.share();
        "measured.*.share_compared": number "1", COVERED, "share of the run from its first contact on that is compared" in measured_difference "of the run compared [%]" => run.0.covered;
        "measured.*.rms_difference_from_drop_1": number "of the column", RMS, "root mean square of this drop less the first" in measured_difference "rms difference from drop 1" when curve.given.drop > 1 => curve.less_first(run.1);
    }
}

/// The unit of what has that of its column.
const OF_COLUMN: &str = "of the column";
const HERE: &str = "crates/run/src/measured/mod.rs";

origins! {
    DEVIATION: law "measured.deviation, or sqrt(sum r^2/(n - p tau)) over the values before the release, r less mean and synchronous orbit, p their coefficients, tau the repetition by the autocorrelation; the rounding of the file at least; without a stretch before the release the median second difference",
        source "crates/run/src/measured/before.rs",
        valid "a steady speed before the release; without such a stretch noise that is independent from value to value";
    RMS: law "sqrt(mean (measured - predicted)^2) over the samples of the file within the run",
        source HERE,
        valid "noise of the channel is in it; after the first impacts two drops of one machine differ as well";
    LARGEST: law "measured - predicted where its size is largest, and that instant from the start of the run",
        source HERE,
        valid "at the samples of the file, the prediction straight between its rows; at steep flanks a small error of the clock makes it";
    RELATIVE: law "rms_difference over largest less smallest predicted value at these samples",
        source HERE,
        valid "as rms_difference";
    MISFIT: law "rms_difference over deviation; of all channels of the first drop that of all their samples",
        source HERE,
        valid "1 where noise alone explains the difference; larger where the model, an input or the clock is off";
    COVERED: law "time between samples of the file, without its gaps, over the time of the run; both from the first contact that is predicted, or from the release",
        source HERE,
        valid "below one half nothing is said of the motion after the contact: AB2352";
    SHARE: law "share of the samples with |measured - predicted| of two deviations at most",
        source HERE,
        valid "0.95 where normal noise alone explains the difference";
}

#[cfg(test)]
#[path = "../../tests/unit/measured.rs"]
mod tests;
