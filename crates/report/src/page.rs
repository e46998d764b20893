//! The report of one run, or of several side by side, as a single HTML file that needs no network.
//!
//! Rust only packs the data: each column becomes base64 text inside a JSON block of the page, and the scripts of
//! `page/` draw it. Long histories are thinned to [`ROW_LIMIT`] rows, the same rows for every column, in a way that keeps
//! the extremes and every row of the close-ups; peaks that must be exact come from the summary, not from these columns.
//! Several runs share the room of one page: they have fewer rows, and many of them leave their single balls to their own pages.

use super::closely;
use super::page_summary::for_page;
use outcome::limits::UNFINISHED;
pub use outcome::table::Column as PageColumn;
use recording::file::parquet::arrow_schema::push_base64;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Largest number of rows of a history that the page carries.
pub const ROW_LIMIT: usize = 4000;

/// Largest size of the histories of several runs in one page, bytes of text.
const SHARED_ROOM: usize = 3_300_000;
/// Rows of each of several runs below which their single balls are left out instead.
const LEAST_SHARED_ROWS: usize = 1500;

/// One run as the page needs it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PageRun {
    /// Name shown in legends.
    pub name: String,
    /// Run directory, shown as text.
    pub directory: String,
    /// The text of `summary.json`.
    pub summary_json: String,
    /// The text of the resolved scenario.
    pub scenario_toml: String,
    /// The time histories; the column `time` is the common axis.
    pub columns: Vec<PageColumn>,
}

const TEMPLATE: &str = include_str!("page/page.html");
pub(super) const STYLE: &[&str] = &[
    include_str!("page/vendor/uPlot.min.css"),
    include_str!("page/page.css"),
];
const PLOT_LIBRARY: &str = include_str!("page/vendor/uPlot.iife.min.js");
/// Licence of the plot library, which travels with every copy of it.
const PLOT_LICENCE: &str = include_str!("page/vendor/uPlot.LICENSE");
const SCRIPTS: &[&str] = &[
    include_str!("page/elements.js"),
    include_str!("page/format.js"),
    include_str!("page/colour.js"),
    include_str!("page/run.js"),
    include_str!("page/limits.js"),
    include_str!("page/severity.js"),
    include_str!("page/header.js"),
    include_str!("page/timeline.js"),
    include_str!("page/curves.js"),
    include_str!("page/histories.js"),
    include_str!("page/closely.js"),
    include_str!("page/measured.js"),
    include_str!("page/orbit.js"),
    include_str!("page/orders.js"),
    include_str!("page/maps.js"),
    include_str!("page/space.js"),
    include_str!("page/space_view.js"),
    include_str!("page/energy.js"),
    include_str!("page/spin_up.js"),
    include_str!("page/torque.js"),
    include_str!("page/signals.js"),
    include_str!("page/rig.js"),
    include_str!("page/identify.js"),
    include_str!("page/rotor_drawing.js"),
    include_str!("page/rotor.js"),
    include_str!("page/whirl.js"),
    include_str!("page/rolling.js"),
    include_str!("page/mount.js"),
    include_str!("page/machine.js"),
    include_str!("page/heat_flow.js"),
    include_str!("page/coast_down.js"),
    include_str!("page/tables.js"),
];
/// What puts the page of runs together, and what draws the rotor of a document.
const START: &str = include_str!("page/start.js");
const DRAWING: &str = include_str!("page/document.js");

/// The report page of one run, or of several side by side, as one self-contained HTML text.
pub fn html(runs: &[PageRun]) -> String {
    let title = match runs {
        [] => "auxbear report".to_string(),
        [only] => format!("{} · auxbear report", only.name),
        several => format!("{} runs · auxbear report", several.len()),
    };
    let script = script(START);
    let (limit, with_balls) = room(runs);
    let mut data = String::new();
    for run in runs {
        data.push_str("<script type=\"application/json\" class=\"run\">");
        push_run(&mut data, run, limit, with_balls);
        data.push_str("</script>\n");
    }
    let library = format!("/*\n{PLOT_LICENCE}\n*/\n{PLOT_LIBRARY}");
    fill(
        TEMPLATE,
        &[
            ("title", &escape_text(&title)),
            ("style", &STYLE.concat()),
            ("data", &data),
            ("library", &library),
            ("script", &script),
        ],
    )
}

/// All scripts of the page of runs in one scope, with what begins them: another page may draw with them what this one draws.
pub fn script(start: &str) -> String {
    let too_soon = UNFINISHED.map(|(code, _)| code);
    format!(
        "\"use strict\";\n(() => {{\nconst TOO_SOON = {too_soon:?};\n{}{start}}})();\n",
        SCRIPTS.concat()
    )
}

/// A run as the scripts read it: the text of a JSON object, without single balls and with few rows.
pub fn brief(run: &PageRun) -> String {
    let mut data = String::new();
    push_run(&mut data, run, LEAST_ROWS, false);
    data
}

/// What draws the rotor of a run wherever a page has a place for it.
pub(super) fn drawing(run: &PageRun) -> String {
    let data = brief(run);
    format!(
        "<script type=\"application/json\" class=\"run\">{data}</script>\n<script>\n{}</script>\n",
        script(DRAWING)
    )
}

/// Replaces each `{{name}}` of the template once; the inserted text itself is never searched.
pub(super) fn fill(template: &str, parts: &[(&str, &str)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some((before, after)) = rest.split_once("{{") {
        let (name, behind) = after.split_once("}}").unwrap_or((after, ""));
        page.push_str(before);
        if let Some((_, text)) = parts.iter().find(|(part, _)| *part == name) {
            page.push_str(text);
        }
        rest = behind;
    }
    page.push_str(rest);
    page
}

/// Rows that each run may have, and whether the columns of single balls are among them.
fn room(runs: &[PageRun]) -> (usize, bool) {
    if runs.len() < 2 {
        return (ROW_LIMIT, true);
    }
    let rows = |with_balls: bool| {
        let of = |run: &PageRun| {
            let columns = (run.columns.iter()).filter(|column| with_balls || !of_a_ball(column));
            // base64 of four bytes a value, of eight for the few that need them
            columns
                .map(|column| 16.0 / 3.0 * if column.name == "time" { 2.0 } else { 1.0 })
                .sum::<f64>()
        };
        let row: f64 = runs.iter().map(of).sum();
        ((SHARED_ROOM as f64 / row.max(1.0)) as usize).min(ROW_LIMIT)
    };
    match rows(true) {
        enough if enough >= LEAST_SHARED_ROWS => (enough, true),
        _ => (rows(false).max(LEAST_ROWS), false),
    }
}

/// Rows without which a history shows nothing, however many runs share a page.
const LEAST_ROWS: usize = 100;

/// Whether a column is that of a single ball.
fn of_a_ball(column: &PageColumn) -> bool {
    let mut parts = column.name.split('.');
    parts.any(|part| {
        let number = part.strip_prefix("ball_");
        number.is_some_and(|number| number.parse::<u32>().is_ok())
    })
}

fn longest(columns: &[PageColumn]) -> usize {
    let lengths = columns.iter().map(|column| column.values.len());
    lengths.max().unwrap_or(0)
}

/// Adds a run as JSON.
fn push_run(json: &mut String, run: &PageRun, limit: usize, with_balls: bool) {
    let total = longest(&run.columns);
    let windows = closely::windows(&run.summary_json);
    let close: Vec<[f64; 2]> = windows.values().copied().collect();
    let rows = kept_rows(&run.columns, limit, &close);
    // The summary travels as text: should it not be JSON, only its own part of the page is missing.
    let summary = for_page(&run.summary_json);
    let head = json!({
        "name": run.name,
        "directory": run.directory,
        "summary": summary,
        "scenario": run.scenario_toml,
        "rows": rows.len(),
        "rows_total": total,
        "balls": with_balls,
        "closely": windows,
    });
    json.push_str(&in_script(&head));
    json.pop(); // goes on
    json.push_str(",\"columns\":[");
    let columns = run.columns.iter();
    let shown = columns.filter(|column| with_balls || !of_a_ball(column));
    for (k, column) in shown.enumerate() {
        json.push_str(if k > 0 { ",\n" } else { "" });
        push_column(json, column, &rows);
    }
    json.push_str("]}");
}

/// Adds a column as JSON.
fn push_column(json: &mut String, column: &PageColumn, rows: &[usize]) {
    let value = |&row: &usize| column.values.get(row).copied().unwrap_or(f64::NAN);
    let mut values: Vec<f64> = rows.iter().map(value).collect();
    let mut pairs = values.windows(2);
    if pairs.all(|pair| pair[0].to_bits() == pair[1].to_bits()) {
        // what never changes is written once
        values.truncate(1);
    }
    let wide = column.name == "time" || single_precision_is_coarse(&values);
    let values = values.iter();
    let bytes: Vec<u8> = match wide {
        true => values.flat_map(|value| value.to_le_bytes()).collect(),
        false => (values.flat_map(|&value| (value as f32).to_le_bytes())).collect(),
    };
    let mut data = String::new();
    push_base64(&mut data, &bytes);
    let kind = if wide { "f64" } else { "f32" };
    let column = json!({
        "name": column.name,
        "unit": column.unit,
        "meaning": column.meaning,
        "type": kind,
        "data": data,
    });
    json.push_str(&in_script(&column));
}

/// True when rounding to single precision would be visible in a picture of these values: more than 1e-5 of their
/// range, a hundredth of a pixel in a plot of 1000.
fn single_precision_is_coarse(values: &[f64]) -> bool {
    let finite = || values.iter().copied().filter(|value| value.is_finite());
    let low = finite().fold(f64::INFINITY, f64::min);
    let high = finite().fold(f64::NEG_INFINITY, f64::max);
    let error = finite()
        .map(|value| (value - f64::from(value as f32)).abs())
        .fold(0.0, f64::max);
    error > 1e-5 * (high - low)
}

/// The rows of a history that the page carries, in order: all of them up to `limit`, else first and last, the
/// extremes of each column, those of the close-ups, and in equal stretches the first row and those where the contact and the
/// balls peak.
fn kept_rows(columns: &[PageColumn], limit: usize, windows: &[[f64; 2]]) -> Vec<usize> {
    let total = longest(columns);
    if total <= limit {
        return (0..total).collect();
    }
    let mut kept = BTreeSet::from([0, total - 1]);
    for column in columns {
        if kept.len() + 2 > limit / 2 {
            break;
        }
        kept.extend(extreme(column, 0, total, 1.0));
        kept.extend(extreme(column, 0, total, -1.0));
    }
    let time = columns.iter().find(|column| column.name == "time");
    for [begin, end] in windows {
        let inside = |instant: &f64| (*begin..=*end).contains(instant);
        let instants = time.into_iter().flat_map(|time| &time.values).enumerate();
        let close = instants.filter(|(_, instant)| inside(instant));
        let close: Vec<usize> = close.map(|(row, _)| row).collect();
        // of more than fit into half of the room every so many
        let room = (limit / 2).saturating_sub(kept.len());
        let every = close.len().div_ceil(room.max(1)).max(1);
        kept.extend(close.iter().step_by(every));
    }
    let watched: Vec<(&PageColumn, f64)> = [
        ("bearing.contact.force", 1.0),
        ("bearing.contact.penetration", 1.0),
        ("bearing.contact.penetration", -1.0),
        ("bearing.inner_pressure", 1.0),
        ("bearing.inner_race.resisting_moment", 1.0),
        ("bearing.outer_race.moment", 1.0),
    ]
    .into_iter()
    .filter_map(|(name, sign)| Some((columns.iter().find(|column| column.name == name)?, sign)))
    .collect();
    let stretches = (limit - kept.len()) / (1 + watched.len());
    for stretch in 0..stretches {
        let begin = total * stretch / stretches;
        let end = total * (stretch + 1) / stretches;
        kept.insert(begin);
        for (column, sign) in &watched {
            kept.extend(extreme(column, begin, end, *sign));
        }
    }
    let room = limit.saturating_sub(kept.len());
    kept.extend((0..room).map(|index| total * index / room));
    kept.into_iter().collect()
}

/// Row of the largest `sign * value` in `begin..end`; none where no value is a number.
fn extreme(column: &PageColumn, begin: usize, end: usize, sign: f64) -> Option<usize> {
    let end = end.min(column.values.len());
    (begin..end)
        .filter(|&row| !column.values[row].is_nan())
        .max_by(|&left, &right| {
            (sign * column.values[left]).total_cmp(&(sign * column.values[right]))
        })
}

/// JSON inside a script: "<" is an escape, so that no text can close the element.
fn in_script(value: &Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

pub(super) fn escape_text(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, values: Vec<f64>) -> PageColumn {
        PageColumn {
            name: name.to_string(),
            values,
            ..PageColumn::default()
        }
    }

    /// A long quiet history with a few sharp events.
    fn eventful(rows: usize) -> Vec<PageColumn> {
        let mut force = vec![0.0; rows];
        force[rows / 3 + 1] = 675.5;
        force[rows - 7] = 12.0;
        let mut friction = vec![0.0; rows];
        friction[rows / 5] = -80.0;
        let penetration = (0..rows)
            .map(|row| -1e-4 + 1e-6 * (row as f64 * 0.37).sin())
            .collect();
        vec![
            column("time", (0..rows).map(|row| row as f64 * 1e-5).collect()),
            column("bearing.contact.force", force),
            column("bearing.contact.friction_force", friction),
            column("bearing.contact.penetration", penetration),
        ]
    }

    /// The scripts share one scope: of two functions of one name the later one would win without a word.
    #[test]
    fn no_two_functions_of_the_scripts_have_one_name() {
        let mut names: Vec<&str> = SCRIPTS
            .iter()
            .flat_map(|script| script.lines())
            .filter_map(|line| line.strip_prefix("function ")?.split('(').next())
            .collect();
        assert!(names.len() > 100);
        names.sort_unstable();
        let twice: Vec<_> = names.windows(2).filter(|pair| pair[0] == pair[1]).collect();
        assert!(twice.is_empty(), "{twice:?}");
    }

    #[test]
    fn every_system_registers_what_its_page_shows() {
        for system in scenario::KINDS.iter().filter(|kind| **kind != "study") {
            let call = format!("register(\"{system}\", {{");
            let scripts = SCRIPTS.iter().filter(|script| script.contains(&call));
            assert_eq!(scripts.count(), 1, "{call}");
        }
    }

    /// A tile is red where bearing or laws are beyond their range: the warning of each is then severe in the list too.
    #[test]
    fn warnings_behind_red_tiles_are_severe() {
        let ranges = |script: &&'static str| Some(script.split_once("const RANGES = [")?.1);
        let lines = SCRIPTS.iter().find_map(ranges).unwrap().lines().skip(1);
        let lines = lines.take_while(|line| line.starts_with("  "));
        let codes: Vec<&str> = lines.filter_map(|line| line.get(4..10)).collect();
        assert!(codes.contains(&"AB1015") && codes.contains(&"AB1096"));
        for code in codes.into_iter().chain(["AB2030"]) {
            assert!(
                run::warnings::rank(code).0 <= run::outcome::Severity::Invalid,
                "{code}"
            );
        }
    }

    fn column_json(column: &PageColumn, rows: &[usize]) -> String {
        let mut json = String::new();
        push_column(&mut json, column, rows);
        json
    }

    #[test]
    fn values_are_little_endian_single_precision_unless_that_is_coarse() {
        // 1.0f32 is 00 00 80 3f and 2.0f32 is 00 00 00 40 in memory order.
        let json = column_json(&column("force", vec![1.0, 2.0]), &[0, 1]);
        assert!(json.contains("\"type\":\"f32\""), "{json}");
        assert!(json.contains("\"data\":\"AACAPwAAAEA=\""), "{json}");
        // A change of 4 J on top of 6321 J: single precision steps are 5e-4 J there, 1e-4 of the change.
        let energy = column("energy.kinetic", vec![6321.3, 6320.123456, 6317.234567]);
        assert!(column_json(&energy, &[0, 1, 2]).contains("\"type\":\"f64\""));
        assert!(column_json(&column("time", vec![0.0, 1.0]), &[0, 1]).contains("\"type\":\"f64\""));
    }

    #[test]
    fn short_histories_keep_every_row() {
        assert_eq!(
            kept_rows(&eventful(50), 50, &[]),
            (0..50).collect::<Vec<_>>()
        );
        assert!(kept_rows(&[], 50, &[]).is_empty());
    }

    #[test]
    fn thinning_keeps_peaks_ends_and_the_bound() {
        for rows in [ROW_LIMIT + 1, 10 * ROW_LIMIT + 3, 200_000] {
            let kept = kept_rows(&eventful(rows), ROW_LIMIT, &[]);
            assert!(kept.len() <= ROW_LIMIT, "{} rows of {rows}", kept.len());
            // Three watched values and one uniform row a stretch: even if they coincide, a quarter of the limit is used.
            assert!(
                kept.len() >= ROW_LIMIT / 4 - 10,
                "{} rows of {rows}",
                kept.len()
            );
            for row in [0, rows / 5, rows / 3 + 1, rows - 7, rows - 1] {
                assert!(kept.contains(&row), "row {row} of {rows} was dropped");
            }
            assert!(kept.windows(2).all(|pair| pair[0] < pair[1]));
        }
    }

    #[test]
    fn thinning_keeps_every_row_of_a_close_up() {
        // rows every 10 µs: 4 to 9 ms are the rows 400 to 900
        let kept = kept_rows(&eventful(100_000), ROW_LIMIT, &[[4e-3, 9e-3]]);
        assert!(kept.len() <= ROW_LIMIT);
        assert!((401..900).all(|row| kept.binary_search(&row).is_ok()));
        // a close-up of everything leaves room for the peaks
        let kept = kept_rows(&eventful(100_000), ROW_LIMIT, &[[0.0, 1.0]]);
        assert!(kept.len() <= ROW_LIMIT && kept.contains(&33_334));
    }

    #[test]
    fn what_never_changes_is_written_once() {
        let json = column_json(
            &column("load", vec![23.6; 1000]),
            &(0..1000).collect::<Vec<_>>(),
        );
        assert!(json.len() < 100, "{json}");
    }

    /// The largest shipped drop has 17 balls of seven columns and 30 columns besides.
    #[test]
    fn five_runs_side_by_side_stay_below_four_megabytes() {
        let rows = 5001;
        let wave = |phase: usize| {
            (0..rows)
                .map(|row| ((row * (phase + 3)) as f64).sin())
                .collect()
        };
        let mut columns = vec![column(
            "time",
            (0..rows).map(|row| row as f64 * 1e-4).collect(),
        )];
        columns.extend((0..30).map(|index| column(&format!("bearing.c{index}"), wave(index))));
        for ball in 1..=17 {
            let parts =
                (0..7).map(|part| column(&format!("bearing.ball_{ball}.p{part}"), wave(part)));
            columns.extend(parts);
        }
        let run = PageRun {
            columns,
            ..PageRun::default()
        };
        let five: Vec<PageRun> = std::iter::repeat_n(run.clone(), 5).collect();
        let page = html(&five);
        assert!(page.len() < 4_000_000, "{} bytes", page.len());
        assert!(page.contains("\"balls\":false") && !page.contains("ball_17"));
        assert!(html(&[run]).contains("ball_17"));
    }

    #[test]
    fn thinning_leaves_no_long_gap() {
        let kept = kept_rows(&eventful(100_000), ROW_LIMIT, &[]);
        let gap = kept.windows(2).map(|pair| pair[1] - pair[0]).max().unwrap();
        // 100 000 rows in (4000 - 12) / 4 stretches: at most one stretch of 101 rows between kept rows.
        assert!(gap <= 101, "gap of {gap} rows");
    }

    #[test]
    fn thinning_survives_many_columns_and_missing_numbers() {
        let mut columns: Vec<PageColumn> = (0..200)
            .map(|index| column(&format!("c{index}"), vec![f64::NAN; 300]))
            .collect();
        for (index, column) in columns.iter_mut().enumerate() {
            column.values[index] = 1.0;
        }
        let kept = kept_rows(&columns, 100, &[]);
        assert!(kept.len() <= 100);
        assert!(kept.len() > 50);
    }

    #[test]
    fn columns_of_unequal_length_are_filled_with_not_a_number() {
        let run = PageRun {
            columns: vec![column("time", vec![0.0, 1.0]), column("force", vec![1.0])],
            ..PageRun::default()
        };
        // 1.0f32 then the quiet NaN 7fc00000.
        let mut json = String::new();
        push_run(&mut json, &run, ROW_LIMIT, true);
        assert!(json.contains("\"data\":\"AACAPwAAwH8=\""), "{json}");
    }

    #[test]
    fn no_text_can_leave_its_place() {
        let run = PageRun {
            name: "</script><b>\"quoted\" & {{script}}".to_string(),
            summary_json: "{\"title\": \"</script>\"}".to_string(),
            scenario_toml: "title = '</SCRIPT>'\t\\ \u{1}".to_string(),
            ..PageRun::default()
        };
        let page = html(std::slice::from_ref(&run));
        let empty = html(&[PageRun::default()]);
        let closings = |text: &str| text.to_lowercase().matches("</script").count();
        assert_eq!(closings(&page), closings(&empty));
        assert!(page.contains("<title>&lt;/script&gt;&lt;b&gt;&quot;quoted&quot; &amp; {{script}} · auxbear report</title>"));
        assert!(page.contains("\\u003c/SCRIPT>'\\t\\\\ \\u0001\""));
    }

    #[test]
    fn the_page_needs_no_network() {
        let page = html(&[PageRun::default()]);
        for remote in [
            "src=\"http",
            "href=\"http",
            "src='http",
            "@import",
            "url(http",
            "fetch(",
            "XMLHttpRequest",
        ] {
            assert!(!page.contains(remote), "{remote}");
        }
        assert!(page.contains("default-src 'none'"));
        assert!(page.contains("Permission is hereby granted"));
    }

    #[test]
    fn every_place_of_the_template_is_filled() {
        let page = html(&[]);
        for part in ["title", "style", "data", "library", "script"] {
            assert!(TEMPLATE.contains(&format!("{{{{{part}}}}}")));
            assert!(!page.contains(&format!("{{{{{part}}}}}")), "{part}");
        }
    }
}
