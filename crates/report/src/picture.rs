//! One static picture of a drop: orbit, contact force and speeds as a self-contained SVG.

use super::page::{PageRun, escape_text};
use super::per_bearing::per_bearing;
use serde_json::Value;
use std::f64::consts::PI;
use std::fmt::Write;

const WIDTH: f64 = 1200.0;
const HEIGHT: f64 = 420.0;
const INK: &str = "#22303c";
const RULE: &str = "#dfe4e8";
const ROTOR: &str = "#1f5fa8";
const RACE: &str = "#c2571a";
const CAGE: &str = "#2f8f5b";
/// Rows further than this from an instant, in seconds, are too coarse to mark it on the orbit.
const COARSE_ROWS: f64 = 0.5e-3;

/// The picture of one run, 1200 × 420 pixels for each auxiliary bearing: the orbit of the rotor centre relative to the inner race
/// in its clearance circle, the contact force, and the speeds of rotor, inner race and cage. What the run lacks is said in its
/// place.
pub fn orbit_svg(run: &PageRun) -> String {
    let bearings = per_bearing(run);
    let height = HEIGHT * bearings.len() as f64;
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" \
         font-family=\"system-ui, 'Segoe UI', Roboto, 'Helvetica Neue', Arial, sans-serif\" font-size=\"12\" fill=\"{INK}\">\n\
         <rect width=\"{WIDTH}\" height=\"{height}\" fill=\"#ffffff\"/>\n"
    );
    for (k, bearing) in bearings.iter().enumerate() {
        let _ = writeln!(svg, "<g transform=\"translate(0 {})\">", HEIGHT * k as f64);
        text(&mut svg, 62.0, 14.0, "start", &escape_text(&bearing.name));
        draw_orbit(&mut svg, bearing);
        draw_force(&mut svg, bearing);
        draw_speeds(&mut svg, bearing);
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

/// A panel and the values its edges stand for.
pub(super) struct Panel {
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    pub x: (f64, f64),
    pub y: (f64, f64),
}

impl Panel {
    /// A panel of the picture of a run.
    fn of_run(left: f64, width: f64, x: (f64, f64), y: (f64, f64)) -> Panel {
        let (top, height) = (40.0, 325.0);
        Panel {
            left,
            top,
            width,
            height,
            x,
            y,
        }
    }

    pub(super) fn place(&self, x: f64, y: f64) -> (f64, f64) {
        (
            self.left + self.width * (x - self.x.0) / (self.x.1 - self.x.0),
            self.top + self.height * (self.y.1 - y) / (self.y.1 - self.y.0),
        )
    }

    pub(super) fn axes(&self, svg: &mut String, title: &str, x_label: &str, y_label: &str) {
        let (right, bottom) = (self.left + self.width, self.top + self.height);
        let title = format!("<tspan font-weight=\"600\">{title}</tspan>");
        text(svg, self.left, self.top - 12.0, "start", &title);
        for value in ticks(self.x, self.width / 60.0) {
            let (x, _) = self.place(value, self.y.0);
            line(svg, (x, self.top), (x, bottom), RULE, "");
            text(svg, x, bottom + 17.0, "middle", &number(value));
        }
        let mut widest = 0;
        for value in ticks(self.y, self.height / 45.0) {
            let (_, y) = self.place(self.x.0, value);
            line(svg, (self.left, y), (right, y), RULE, "");
            let words = number(value);
            text(svg, self.left - 7.0, y + 4.0, "end", &words);
            widest = widest.max(words.chars().count());
        }
        let _ = writeln!(
            svg,
            "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"none\" stroke=\"#8995a0\"/>",
            self.left, self.top, self.width, self.height
        );
        let (x, y) = (self.left + self.width / 2.0, self.top + self.height / 2.0);
        text(svg, x, bottom + 36.0, "middle", x_label);
        // Digits of 12 px are at most 7.7 px wide in the usual fonts; the label stands left of the longest number.
        let x = self.left - 14.0 - 7.7 * widest as f64;
        let _ = writeln!(
            svg,
            "<text transform=\"translate({x:.1} {y:.1}) rotate(-90)\" text-anchor=\"middle\">{y_label}</text>"
        );
    }

    fn curve(&self, svg: &mut String, points: &[(f64, f64)], colour: &str, style: &str) {
        let mut path = String::new();
        let mut last = (f64::NAN, f64::NAN);
        for &(x, y) in points {
            let (x, y) = self.place(x, y);
            // A step below a fifth of a pixel is not seen, and would only make the file larger.
            if (x - last.0).hypot(y - last.1) < 0.2 {
                continue;
            }
            let step = if path.is_empty() { 'M' } else { 'L' };
            let _ = write!(path, "{step}{x:.1} {y:.1}");
            last = (x, y);
        }
        let _ = writeln!(
            svg,
            "<path d=\"{path}\" fill=\"none\" stroke=\"{colour}\" stroke-linejoin=\"round\" {style}/>"
        );
    }
}

fn draw_orbit(svg: &mut String, run: &PageRun) {
    let names = [
        "rotor.x",
        "rotor.y",
        "bearing.inner_race.x",
        "bearing.inner_race.y",
    ];
    let Some([x, y, race_x, race_y]) = columns(run, names) else {
        absent(svg, 60.0, "orbit");
        return;
    };
    let micro = 1e6;
    let points: Vec<(f64, f64)> = x
        .iter()
        .zip(y)
        .zip(race_x.iter().zip(race_y))
        .map(|((x, y), (race_x, race_y))| (micro * (x - race_x), micro * (y - race_y)))
        .filter(|(x, y)| x.is_finite() && y.is_finite())
        .collect();
    let clearance = summary_number(run, "clearance_radius_m").map(|radius| micro * radius);
    let reach = points
        .iter()
        .map(|(x, y)| x.abs().max(y.abs()))
        .fold(clearance.unwrap_or(0.0), f64::max);
    let reach = if reach > 0.0 { 1.08 * reach } else { 1.0 };
    let panel = Panel::of_run(62.0, 325.0, (-reach, reach), (-reach, reach));
    let title = "Rotor centre relative to the inner race";
    panel.axes(svg, title, "x, to the right [µm]", "y, up [µm]");
    // Colour by time: the orbit in stretches, pale green to dark violet.
    let stretches = 48;
    for stretch in 0..stretches {
        let begin = points.len() * stretch / stretches;
        let end = (points.len() * (stretch + 1) / stretches + 1).min(points.len());
        let share = stretch as f64 / (stretches - 1) as f64;
        let part = &points[begin..end];
        panel.curve(svg, part, &colour(share), "stroke-width=\"1\"");
    }
    let centre = panel.place(0.0, 0.0);
    if let Some(radius) = clearance {
        let pixels = radius * panel.width / (2.0 * reach);
        let _ = writeln!(
            svg,
            "<circle cx=\"{:.1}\" cy=\"{:.1}\" r=\"{pixels:.1}\" fill=\"none\" stroke=\"{INK}\" stroke-dasharray=\"5 4\"/>",
            centre.0, centre.1
        );
        let (x, y) = (panel.left + 8.0, panel.top + 14.0);
        let dashes = "stroke-dasharray=\"5 4\"";
        line(svg, (x, y), (x + 22.0, y), INK, dashes);
        text(svg, x + 28.0, y + 4.0, "start", "clearance");
    }
    if let Some(instant) = peak_contact(run) {
        // The words stand in the lower corner, which an orbit inside its clearance circle leaves free.
        let (left, bottom) = (panel.left + 12.0, panel.top + panel.height - 12.0);
        match place_at(run, &names, instant) {
            Some((x, y)) => {
                let at = panel.place(micro * x, micro * y);
                for place in [at, (left, bottom)] {
                    dot(svg, place, 4.5, "#b3261e", "stroke=\"#ffffff\"");
                }
                text(svg, left + 9.0, bottom + 4.0, "start", "peak force");
            }
            None => {
                let right = panel.left + panel.width;
                text(svg, right, HEIGHT - 5.0, "end", "rows too coarse for marks");
            }
        }
    }
}

/// Whether a run is one of a system that has this picture: a drop, or one that does not say.
pub(super) fn shows(run: &PageRun) -> bool {
    let summary: Option<Value> = serde_json::from_str(&run.summary_json).ok();
    let system = summary.as_ref().and_then(|summary| summary.get("system"));
    let system = system.and_then(Value::as_str);
    system.is_none_or(|system| ["drop", "machine"].contains(&system))
}

/// Instant of the largest contact force, from the contacts of the summary.
fn peak_contact(run: &PageRun) -> Option<f64> {
    let summary: Value = serde_json::from_str(&run.summary_json).ok()?;
    let contacts = summary.get("contacts")?.as_array()?;
    let known = contacts.iter().filter_map(|contact| {
        let force = contact.get("peak_force_N")?.as_f64()?;
        let instant = contact.get("peak_time_s")?.as_f64()?;
        Some((force, instant))
    });
    let (_, instant) = known.max_by(|left, right| left.0.total_cmp(&right.0))?;
    Some(instant)
}

/// Rotor centre relative to the inner race at an instant, between the rows around it; none where these are further
/// than [`COARSE_ROWS`] from the instant.
fn place_at(run: &PageRun, names: &[&str; 4], instant: f64) -> Option<(f64, f64)> {
    let time = column(run, "time")?;
    let [x, y, race_x, race_y] = columns(run, *names)?;
    let after = time.partition_point(|&row| row <= instant);
    let after = after.clamp(1, time.len() - 1);
    let before = after - 1;
    let (begin, end) = (*time.get(before)?, *time.get(after)?);
    let around = begin <= instant && instant <= end && end > begin;
    if !around || instant - begin > COARSE_ROWS || end - instant > COARSE_ROWS {
        return None;
    }
    let share = (instant - begin) / (end - begin);
    let between = |part: &[f64], race: &[f64]| {
        let at = |row: usize| Some(part.get(row)? - race.get(row)?);
        Some(at(before)? + share * (at(after)? - at(before)?))
    };
    let (x, y) = (between(x, race_x)?, between(y, race_y)?);
    (x.is_finite() && y.is_finite()).then_some((x, y))
}

fn draw_force(svg: &mut String, run: &PageRun) {
    let Some([time, force]) = columns(run, ["time", "bearing.contact.force"]) else {
        absent(svg, 470.0, "contact force");
        return;
    };
    let points = curve_points(time, force, 1.0);
    let top = 1.06 * highest(&points);
    let top = if top > 0.0 { top } else { 1.0 };
    let panel = Panel::of_run(470.0, 310.0, span(&points), (0.0, top));
    panel.axes(svg, "Contact force", "time [ms]", "force [N]");
    panel.curve(svg, &points, ROTOR, "stroke-width=\"1.1\"");
}

fn draw_speeds(svg: &mut String, run: &PageRun) {
    let rpm = 30.0 / PI;
    let names = [
        "time",
        "rotor.speed",
        "bearing.inner_race.speed",
        "bearing.cage.speed",
    ];
    let Some([time, rotor, race, cage]) = columns(run, names) else {
        absent(svg, 865.0, "speeds");
        return;
    };
    let curves = [
        ("rotor", ROTOR, rotor),
        ("inner race", RACE, race),
        ("cage", CAGE, cage),
    ]
    .map(|(name, colour, values)| (name, colour, curve_points(time, values, rpm)));
    let points = || curves.iter().flat_map(|(_, _, points)| points);
    let high = 1.08 * points().map(|point| point.1).fold(0.0, f64::max);
    let low = 1.08 * points().map(|point| point.1).fold(0.0, f64::min);
    let y = if high > low { (low, high) } else { (0.0, 1.0) };
    let panel = Panel::of_run(870.0, 310.0, span(&curves[0].2), y);
    panel.axes(svg, "Speeds", "time [ms]", "speed [rpm]");
    if let Some(ratio) = summary_number(run, "rolling_cage_ratio") {
        let rolling: Vec<(f64, f64)> = curves[1].2.iter().map(|&(x, y)| (x, ratio * y)).collect();
        let dotted = "stroke-width=\"1\" stroke-dasharray=\"2 3\"";
        panel.curve(svg, &rolling, CAGE, dotted);
    }
    for (name, colour, points) in &curves {
        panel.curve(svg, points, colour, "stroke-width=\"1.5\"");
        // The name stands at nine tenths of the run, rotor above its line and race below, so that they never meet.
        if let Some(&(x, y)) = points.get(points.len() * 9 / 10) {
            let (x, y) = panel.place(x, y);
            let shift = if *name == "inner race" { 17.0 } else { -7.0 };
            let words = format!("<tspan fill=\"{colour}\">{name}</tspan>");
            text(svg, x, y + shift, "end", &words);
        }
    }
}

fn column<'a>(run: &'a PageRun, name: &str) -> Option<&'a [f64]> {
    let column = run.columns.iter().find(|column| column.name == name)?;
    (column.values.len() > 1).then_some(column.values.as_slice())
}

fn columns<'a, const COUNT: usize>(
    run: &'a PageRun,
    names: [&str; COUNT],
) -> Option<[&'a [f64]; COUNT]> {
    let found = names.into_iter().map_while(|name| column(run, name));
    found.collect::<Vec<_>>().try_into().ok()
}

/// A plain number at a key of the summary that occurs once.
fn summary_number(run: &PageRun, key: &str) -> Option<f64> {
    let (_, after) = run.summary_json.split_once(&format!("\"{key}\""))?;
    let value = after.trim_start().strip_prefix(':')?.trim_start();
    let end = value.find([',', '}', '\n', ' ']).unwrap_or(value.len());
    let number: f64 = value[..end].parse().ok()?;
    (number.is_finite() && number > 0.0).then_some(number)
}

fn curve_points(time: &[f64], values: &[f64], scale: f64) -> Vec<(f64, f64)> {
    time.iter()
        .zip(values)
        .map(|(time, value)| (1e3 * time, scale * value))
        .filter(|(time, value)| time.is_finite() && value.is_finite())
        .collect()
}

fn highest(points: &[(f64, f64)]) -> f64 {
    points.iter().map(|point| point.1).fold(0.0, f64::max)
}

fn span(points: &[(f64, f64)]) -> (f64, f64) {
    match (points.first(), points.last()) {
        (Some(first), Some(last)) if last.0 > first.0 => (first.0, last.0),
        _ => (0.0, 1.0),
    }
}

/// About `count` round values inside a range.
fn ticks(range: (f64, f64), count: f64) -> Vec<f64> {
    let rough = (range.1 - range.0) / count.max(1.0);
    let power = 10f64.powf(rough.log10().floor());
    let factor = [1.0, 2.0, 5.0]
        .into_iter()
        .find(|factor| factor * power >= rough * (1.0 - 1e-9))
        .unwrap_or(10.0);
    let step = factor * power;
    let first = (range.0 / step - 1e-9).ceil() as i64;
    let last = (range.1 / step + 1e-9).floor() as i64;
    (first..=last).map(|index| index as f64 * step).collect()
}

fn number(value: f64) -> String {
    let rounded: f64 = format!("{value:.6e}").parse().unwrap_or(value);
    format!("{rounded}").replace('-', "−")
}

/// From pale green over blue to dark violet.
fn colour(share: f64) -> String {
    let stops = [
        [147.0, 200.0, 120.0],
        [42.0, 143.0, 143.0],
        [48.0, 84.0, 160.0],
        [66.0, 25.0, 95.0],
    ];
    let place = share.clamp(0.0, 1.0) * 3.0;
    let index = (place as usize).min(2);
    let rest = place - index as f64;
    let (from, to): ([f64; 3], [f64; 3]) = (stops[index], stops[index + 1]);
    let mix = |k: usize| (from[k] + rest * (to[k] - from[k])).round() as u8;
    let [red, green, blue] = [0, 1, 2].map(mix);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

pub(super) fn text(svg: &mut String, x: f64, y: f64, anchor: &str, words: &str) {
    let _ = writeln!(
        svg,
        "<text x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{words}</text>"
    );
}

pub(super) fn line(svg: &mut String, from: (f64, f64), to: (f64, f64), colour: &str, style: &str) {
    let _ = writeln!(
        svg,
        "<line x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\" stroke=\"{colour}\" {style}/>",
        from.0, from.1, to.0, to.1
    );
}

pub(super) fn dot(svg: &mut String, (x, y): (f64, f64), radius: f64, colour: &str, style: &str) {
    let _ = writeln!(
        svg,
        "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" fill=\"{colour}\" {style}/>"
    );
}

fn absent(svg: &mut String, left: f64, what: &str) {
    let words = format!("not in this run: {what}");
    text(svg, left, 60.0, "start", &words);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::page::PageColumn;

    fn run() -> PageRun {
        let rows = 1000;
        let make = |name: &str, value: &dyn Fn(f64) -> f64| PageColumn {
            name: name.to_string(),
            values: (0..rows).map(|row| value(row as f64 * 1e-4)).collect(),
            ..PageColumn::default()
        };
        PageRun {
            summary_json: "{\"clearance_radius_m\": 0.00025, \"rolling_cage_ratio\":0.4118, \
                \"contacts\": [{\"start_s\": 0.029, \"peak_force_N\": 1.0, \"peak_time_s\": 0.0291}, \
                {\"start_s\": 0.0295, \"peak_force_N\": 600.0, \"peak_time_s\": 0.03005}]}"
                .to_string(),
            columns: vec![
                make("time", &|t| t),
                make("rotor.x", &|t| 2e-4 * (300.0 * t).cos()),
                make("rotor.y", &|t| 2e-4 * (300.0 * t).sin()),
                make("bearing.inner_race.x", &|_| 0.0),
                make("bearing.inner_race.y", &|_| 0.0),
                make("bearing.contact.force", &|t| {
                    600.0 * (-((t - 0.03) / 1e-3).powi(2)).exp()
                }),
                make("rotor.speed", &|_| -1256.6),
                make("bearing.inner_race.speed", &|t| {
                    -1256.6 * (1.0 - (-t / 0.02).exp())
                }),
                make("bearing.cage.speed", &|t| {
                    -517.0 * (1.0 - (-t / 0.02).exp())
                }),
            ],
            ..PageRun::default()
        }
    }

    #[test]
    fn the_picture_holds_three_panels_and_no_broken_number() {
        let svg = orbit_svg(&run());
        for words in [
            "Rotor centre",
            "Contact force",
            "Speeds",
            "clearance",
            "peak force",
            "inner race",
        ] {
            assert!(svg.contains(words), "{words}");
        }
        assert!(!svg.contains("NaN") && !svg.contains("inf"));
        assert!(svg.len() < 200_000, "{} bytes", svg.len());
    }

    #[test]
    fn each_bearing_of_a_machine_has_its_own_panels() {
        let mut machine = run();
        for column in &mut machine.columns {
            if !["time", "rotor.speed"].contains(&column.name.as_str()) {
                column.name = format!("drive_end.{}", column.name);
            }
        }
        machine.summary_json = "{\"auxiliary_bearings\": [{\"name\": \"drive_end\", \"clearance_radius_m\": 0.00025}, {\"name\": \
             \"other_end\"}]}"
            .to_string();
        let svg = orbit_svg(&machine);
        for words in ["height=\"840\"", "drive_end", "other_end", "clearance"] {
            assert!(svg.contains(words), "{words}");
        }
        assert_eq!(svg.matches("Rotor centre relative").count(), 1);
        assert_eq!(svg.matches("not in this run").count(), 3);
    }

    #[test]
    fn the_peak_is_marked_where_the_summary_says_between_its_rows() {
        // Angle 300 × 0.03005 = 9.015 rad on a circle of 200 µm; the panel spans ±1.08 × 250 µm over 325 px.
        let (sin, cos) = 9.015f64.sin_cos();
        let x = 62.0 + 325.0 * (200.0 * cos + 270.0) / 540.0;
        let y = 40.0 + 325.0 * (270.0 - 200.0 * sin) / 540.0;
        let mark = format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"4.5\"");
        assert!(orbit_svg(&run()).contains(&mark), "{mark}");
    }

    #[test]
    fn coarse_rows_bear_no_mark() {
        let mut run = run();
        for column in &mut run.columns {
            // Every hundredth row: 10 ms apart, and the peak at 30.05 ms has its next row at 40 ms.
            column.values = column.values.iter().copied().step_by(100).collect();
        }
        let svg = orbit_svg(&run);
        assert!(svg.contains("rows too coarse for marks"));
        assert!(!svg.contains("peak force") && !svg.contains("r=\"4.5\""));
    }

    #[test]
    fn what_is_absent_is_said() {
        let svg = orbit_svg(&PageRun::default());
        for what in ["orbit", "contact force", "speeds"] {
            assert!(svg.contains(&format!("not in this run: {what}")));
        }
    }

    #[test]
    fn a_history_of_gaps_and_constants_still_draws() {
        let mut run = run();
        for column in &mut run.columns {
            column.values = vec![0.0, f64::NAN, 0.0];
        }
        let svg = orbit_svg(&run);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
    }

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks((0.0, 500.0), 4.0), vec![0.0, 200.0, 400.0]);
        assert_eq!(ticks((-10.0, 10.0), 4.0), vec![-10.0, -5.0, 0.0, 5.0, 10.0]);
    }

    #[test]
    fn the_clearance_circle_has_the_scale_of_the_axes() {
        // Reach is 1.08 times the clearance, so the circle fills 1/1.08 of half the panel: 325 / 2 / 1.08 = 150.46.
        assert!(orbit_svg(&run()).contains("r=\"150.5\""));
    }

    #[test]
    fn summary_numbers_are_found_or_left_out() {
        assert_eq!(summary_number(&run(), "clearance_radius_m"), Some(0.00025));
        let absent = PageRun {
            summary_json: "{\"clearance_radius_m\": null}".to_string(),
            ..PageRun::default()
        };
        assert_eq!(summary_number(&absent, "clearance_radius_m"), None);
    }
}
