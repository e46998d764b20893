//! Pictures of a study, and the horizontal bars of its inputs.

use crate::page::escape_text as plain;
use crate::picture::{Panel, line, text};
use std::fmt::Write;

pub(super) const WIDTH: f64 = 620.0;

pub(super) fn picture(height: f64, draw: impl FnOnce(&mut String)) -> String {
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {WIDTH} {height}\" width=\"{WIDTH}\" height=\"{height}\" font-size=\"12\" fill=\"#22303c\">\n"
    );
    draw(&mut svg);
    svg.push_str("</svg>");
    svg
}

/// Range of values with room on both sides.
pub(super) fn room(values: impl Iterator<Item = f64>) -> (f64, f64) {
    let (low, high) = values
        .filter(|v| v.is_finite())
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| {
            (low.min(v), high.max(v))
        });
    let size = low.abs().max(high.abs());
    match high - low {
        width if width > 1e-9 * size => (low - 0.04 * width, high + 0.04 * width),
        _ if size > 0.0 && size.is_finite() => (low - 0.05 * size, high + 0.05 * size),
        _ => (-1.0, 1.0),
    }
}

/// Bars of one input: from, to, band, colour.
pub(super) struct Bars {
    pub name: String,
    pub bars: Vec<(f64, f64, Option<[f64; 2]>, &'static str)>,
}

pub(super) fn bars(rows: &[Bars], title: &str, label: &str) -> String {
    let ends = rows.iter().flat_map(|row| {
        row.bars.iter().flat_map(|(from, to, band, _)| {
            [*from, *to]
                .into_iter()
                .chain(band.iter().flatten().copied())
        })
    });
    let row_height = 34.0;
    let height = 96.0 + row_height * rows.len() as f64;
    let axes = Panel {
        left: 230.0,
        top: 32.0,
        width: WIDTH - 250.0,
        height: height - 84.0,
        x: room(ends),
        y: (0.0, 1e9),
    };
    picture(height, |svg| {
        let (top, bottom) = (axes.top, axes.top + axes.height);
        // ticks of the values alone: the rows have names
        let mut own = String::new();
        axes.axes(&mut own, title, label, "");
        let lines = own.lines();
        let kept = lines.filter(|line| !line.contains("text-anchor=\"end\""));
        svg.extend(kept.flat_map(|line| [line, "\n"]));
        for (k, row) in rows.iter().enumerate() {
            let y = top + (bottom - top) * (k as f64 + 0.5) / rows.len() as f64;
            text(svg, axes.left - 8.0, y + 4.0, "end", &plain(&row.name));
            let thick = 18.0 / row.bars.len() as f64;
            for (at, (from, to, band, colour)) in row.bars.iter().enumerate() {
                let (a, b) = (axes.place(*from, 0.0).0, axes.place(*to, 0.0).0);
                let y = y - 9.0 + thick * at as f64;
                let _ = writeln!(
                    svg,
                    "<rect x=\"{:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{colour}\" fill-opacity=\"0.6\"/>",
                    a.min(b),
                    (b - a).abs().max(1.0),
                    thick - 1.0
                );
                if let Some([low, high]) = band {
                    let middle = y + thick / 2.0 - 0.5;
                    let [from, to] = [low, high].map(|x| (axes.place(*x, 0.0).0, middle));
                    line(svg, from, to, "#22303c", "stroke-width=\"1.2\"");
                }
            }
        }
    })
}
