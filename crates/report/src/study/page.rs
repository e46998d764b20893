//! The page of a study: inputs and verdicts first, then what each result does, and which input matters.

use super::bars::{Bars, WIDTH, bars, picture, room};
use super::cells::{amount, bound, known, marked, rows, scaled, short};
use super::{estimate, parallel, ranking};
use crate::page::{STYLE, escape_text as plain};
use crate::picture::{Panel, dot, line, text};
use outcome::Severity;
use run::study::Study;
use run::study::answer::{Answer, Sensitivity};
use run::study::table::{self, Column, Table, Warned};
use scenario::{Limit, Side};
use statistics::design::Design;
use std::fmt::Write;

const BAR: &str = "#9db8d6";
const DOT: &str = "#1f5fa8";
const BOUND: &str = "#b3261e";
const TOTAL: &str = "#c2571a";
/// Look of a line at a limit.
const DASHED: &str = "stroke-width=\"1.5\" stroke-dasharray=\"5 3\"";
/// Dots of a picture, at most: every so-manieth member is drawn.
const MOST_DOTS: usize = 1500;

/// The page as one self-contained text.
pub(super) fn html(study: &Study, table: &Table, answer: &Answer) -> String {
    let title = study.file.title.as_deref().unwrap_or("Study");
    let mut body = format!(
        "<h1>{}</h1>\n<p class=\"subtitle\">{}</p>\n",
        plain(title),
        plain(&subtitle(study, table, answer))
    );
    body.push_str(&warned(table));
    body.push_str(&inputs(study));
    body.push_str(&estimate::html(answer));
    body.push_str(&ranking::html(study, answer));
    body.push_str(&ranking::cases(study, answer));
    body.push_str(&verdicts(answer));
    body.push_str(&spreads(study, answer));
    body.push_str(&parallel::html(study, table));
    for name in study.shown() {
        body.push_str(&result(study, table, answer, &name));
    }
    body.push_str(&failed(table));
    format!(
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:\">\n\
         <title>{} · auxbear study</title>\n<style>\n{}\nfigure svg {{ max-width: 100%; height: auto; }}\n</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
        plain(title),
        STYLE.concat()
    )
}

fn subtitle(study: &Study, table: &Table, answer: &Answer) -> String {
    let mut text = format!(
        "{} design, seed {}: {} members",
        study.file.kind, study.file.seed, answer.members
    );
    if answer.members < answer.asked {
        let asked = answer.asked;
        let _ = write!(text, " of {asked}, the others are not computed yet");
    }
    if !table.failed.is_empty() {
        let failed = table.failed.len();
        let _ = write!(text, "; {failed} failed and are left out of every number");
    }
    text
}

/// What the members warn of, before any of their numbers.
fn warned(table: &Table) -> String {
    let all = table.members.len();
    let row = |warned: &Warned| {
        let class = match warned.severity() <= Severity::Invalid {
            true => " class=\"grave\"",
            false => "",
        };
        format!(
            "<li{class}><code>{}</code> {}: {}</li>\n",
            plain(&warned.code),
            plain(&warned.title),
            warned.share(all)
        )
    };
    let list: String = table::warned(table).iter().map(row).collect();
    match list.is_empty() {
        true => list,
        false => format!(
            "<div class=\"warnings\"><strong>What the runs warn of, the most severe first; run a member alone for its text</strong><ul>\n{list}</ul></div>\n"
        ),
    }
}

fn inputs(study: &Study) -> String {
    let row = |input: &scenario::StudyInput| {
        let resolved = study.file.scenario.resolved.get(&input.vary.path);
        let given = resolved.and_then(|value| value.text.clone());
        // parts of a rotor have paths of their own
        let given = given.or_else(|| input.vary.given_text());
        vec![
            format!("<code>{}</code>", plain(&input.vary.path)),
            plain(&input.written),
            plain(&given.unwrap_or_default()),
        ]
    };
    let body: Vec<Vec<String>> = study.file.inputs.iter().map(row).collect();
    let table = rows(&["input", "distribution", "as given"], &body);
    let mut out = format!("<h2>Inputs</h2>\n{table}");
    for (a, b, coefficient) in &study.file.pairs {
        let name = |k: &usize| plain(&study.file.inputs[*k].vary.path);
        let _ = writeln!(
            out,
            "<p class=\"small\">Correlation of {} and {}: {coefficient}</p>",
            name(a),
            name(b)
        );
    }
    out
}

fn verdicts(answer: &Answer) -> String {
    let row = |limit: &run::study::answer::StudyLimit| {
        let judged = &limit.judged;
        let beyond = |(share, [low, high]): (f64, [f64; 2])| {
            let [share, low, high] = [share, low, high].map(|own| short(100.0 * own));
            format!("{share} % ({low} to {high} %)")
        };
        vec![
            marked(judged.verdict),
            plain(&judged.limit.quantity),
            bound(judged),
            known(judged.value, judged.unit),
            limit.beyond.map_or("–".to_string(), beyond),
            plain(&judged.why),
        ]
    };
    if answer.limits.is_empty() {
        return String::new();
    }
    let body: Vec<Vec<String>> = answer.limits.iter().map(row).collect();
    let beyond = "beyond it, with 95 % interval";
    let head = ["verdict", "result", "limit", "decides", beyond, "why"];
    format!("<h2>Limits</h2>\n{}", rows(&head, &body))
}

fn spreads(study: &Study, answer: &Answer) -> String {
    let shown = study.shown();
    let row = |(name, unit, spread): &(String, &'static str, Option<outcome::Spread>)| {
        let spread = spread.as_ref()?;
        // one unit for a row
        let (factor, label) = scaled("", unit, [spread.smallest, spread.largest].into_iter());
        let unit = label.trim_start_matches(", ").to_string();
        let number = |value: f64| {
            let text = format!("{}\u{a0}{unit}", short(factor * value));
            text.trim().to_string()
        };
        let mut cells = vec![
            plain(name),
            spread.members.to_string(),
            number(spread.mean),
            number(spread.standard_deviation),
        ];
        cells.extend(spread.quantiles.map(number));
        cells.extend([number(spread.smallest), number(spread.largest)]);
        Some(cells)
    };
    let head = [
        "result",
        "members",
        "mean",
        "deviation",
        "5 %",
        "median",
        "95 %",
        "smallest",
        "largest",
    ];
    // levels of a sweep were chosen: a mean of them says nothing
    let shown_cells: &[usize] = match study.file.design {
        Design::Sweep(_) => &[0, 1, 7, 8],
        _ => &[0, 1, 2, 3, 4, 5, 6, 7, 8],
    };
    let head: Vec<&str> = shown_cells.iter().map(|at| head[*at]).collect();
    let row = |spread: &_| {
        let cells: Vec<String> = row(spread)?;
        Some(shown_cells.iter().map(|at| cells[*at].clone()).collect())
    };
    let of = |own: bool| -> Vec<Vec<String>> {
        let of = answer.spreads.iter();
        let of = of.filter(|spread| shown.contains(&spread.0) == own);
        of.filter_map(row).collect()
    };
    let wider = match study.file.design {
        Design::Widened(..) => {
            "<p><b>Members are drawn from wider distributions than those given: means and spreads are not those of the machine. \
             The probabilities of the limits are.</b></p>\n"
        }
        _ => "",
    };
    format!(
        "<h2>Results</h2>\n{wider}{}<details><summary>All other results</summary>\n{}</details>\n",
        rows(&head, &of(true)),
        rows(&head, &of(false))
    )
}

fn failed(table: &Table) -> String {
    if table.failed.is_empty() {
        return String::new();
    }
    let first = table.failed.iter().take(100);
    let body = first.map(|(k, why)| vec![k.to_string(), plain(why)]);
    let table = rows(&["member", "why"], &body.collect::<Vec<_>>());
    format!("<h2>Failed members</h2>\n{table}")
}

/// One result: its histogram, what it owes to each input, and its members over each input.
fn result(study: &Study, table: &Table, answer: &Answer, name: &str) -> String {
    let Some(column) = table.column(name) else {
        return String::new();
    };
    let words = plain(&name.replace(['_', '.'], " "));
    let mut out = format!("<h2>{words}</h2>\n<div class=\"pair\">\n");
    let limits = study.file.limits.iter();
    let limits: Vec<&Limit> = limits.filter(|limit| limit.quantity == name).collect();
    out.push_str(&figure(&histogram(column, &limits)));
    if let Some((.., of)) = answer.sensitivity.iter().find(|(known, ..)| known == name) {
        out.push_str(&figure(&sensitivity(study, column, of)));
    }
    for (at, input) in table.columns[..table.inputs].iter().enumerate() {
        let path = &study.file.inputs[at].vary.path;
        out.push_str(&figure(&scatter(input, column, &limits, path)));
    }
    out.push_str("</div>\n");
    out
}

fn figure(svg: &str) -> String {
    format!("<figure>{svg}</figure>\n")
}

const HEIGHT: f64 = 300.0;

pub(super) fn panel(x: (f64, f64), y: (f64, f64)) -> Panel {
    Panel {
        left: 78.0,
        top: 32.0,
        width: WIDTH - 100.0,
        height: HEIGHT - 84.0,
        x,
        y,
    }
}

fn label(column: &Column) -> (f64, String) {
    let name = column.name.replace(['_', '.'], " ");
    scaled(&name, &column.unit, column.values.iter().copied())
}

/// Where words begin beside the title of a histogram, px.
const BESIDE_TITLE: f64 = 80.0;

fn histogram(column: &Column, limits: &[&Limit]) -> String {
    let (factor, label) = label(column);
    let values = column.values.iter().filter(|v| v.is_finite());
    let values: Vec<f64> = values.map(|v| v * factor).collect();
    let (low, high) = room(values.iter().copied());
    let bins = ((values.len() as f64).sqrt().ceil() as usize).clamp(5, 40);
    let mut counts = vec![0.0; bins];
    for value in &values {
        counts[(((value - low) / (high - low) * bins as f64) as usize).min(bins - 1)] += 1.0;
    }
    let most = counts.iter().copied().fold(1.0, f64::max);
    // a limit far beyond would press all members into a line: it is told at the edge
    let width = high - low;
    let near = |bound: f64| (low - 2.0 * width..=high + 2.0 * width).contains(&bound);
    let bounds = limits.iter().map(|limit| limit.bound * factor);
    let bounds = bounds.filter(|bound| near(*bound));
    let axes = panel(room(bounds.chain([low, high])), (0.0, 1.08 * most));
    picture(HEIGHT, |svg| {
        axes.axes(svg, "Histogram", &label, "members");
        for (k, count) in counts.iter().enumerate() {
            let edge = |k: usize| low + (high - low) * k as f64 / bins as f64;
            let ((left, top), (right, bottom)) =
                (axes.place(edge(k), *count), axes.place(edge(k + 1), 0.0));
            let _ = writeln!(
                svg,
                "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{:.1}\" fill=\"{BAR}\" stroke=\"#ffffff\"/>",
                right - left,
                bottom - top
            );
        }
        // several stand in one line
        for beyond in [false, true] {
            let far = limits.iter().map(|limit| (limit, limit.bound * factor));
            let far = far.filter(|(_, bound)| !near(*bound) && (*bound > high) == beyond);
            let words = far.map(|(limit, _)| {
                format!(
                    "{} {}",
                    bound_word(limit),
                    amount(limit.bound, &column.unit)
                )
            });
            let words = words.collect::<Vec<_>>().join(", ");
            let (x, anchor, words) = match beyond {
                _ if words.is_empty() => continue,
                true => (axes.left + axes.width, "end", format!("{words} →")),
                false => (axes.left + BESIDE_TITLE, "start", format!("← {words}")),
            };
            text(svg, x, axes.top - 12.0, anchor, &words);
        }
        for limit in limits {
            let bound = limit.bound * factor;
            if !near(bound) {
                continue;
            }
            let at = axes.place(bound, axes.y.0);
            line(svg, at, (at.0, axes.top), BOUND, DASHED);
            let (anchor, shift) = beside(at.0, 0.5, 5.0);
            let words = bound_word(limit);
            text(svg, at.0 + shift, axes.top + 14.0, anchor, words);
        }
    })
}

/// Where words stand beside a place, away from the nearer edge.
fn beside(x: f64, share: f64, gap: f64) -> (&'static str, f64) {
    match x > share * WIDTH {
        true => ("end", -gap),
        false => ("start", gap),
    }
}

fn bound_word(limit: &Limit) -> &'static str {
    match limit.side {
        Side::Most => "at most",
        Side::Least => "at least",
    }
}

fn scatter(input: &Column, result: &Column, limits: &[&Limit], path: &str) -> String {
    let named = Column {
        name: path.to_string(),
        ..input.clone()
    };
    let ((fx, lx), (fy, ly)) = (label(&named), label(result));
    let both = input.values.iter().zip(&result.values);
    let both = both.map(|(x, y)| (x * fx, y * fy));
    let both = both.filter(|(x, y)| x.is_finite() && y.is_finite());
    let points: Vec<(f64, f64)> = both.collect();
    let across = room(points.iter().map(|p| p.0));
    let axes = panel(across, room(points.iter().map(|p| p.1)));
    let lx = match input.meaning.as_str() {
        "drawn" => lx,
        words => format!("{lx} ({})", plain(words)),
    };
    picture(HEIGHT, |svg| {
        axes.axes(svg, "", &lx, &ly);
        for limit in limits {
            let bound = limit.bound * fy;
            if axes.y.0 < bound && bound < axes.y.1 {
                let [from, to] = [axes.x.0, axes.x.1].map(|x| axes.place(x, bound));
                line(svg, from, to, BOUND, DASHED);
            }
        }
        let every = points.len().div_ceil(MOST_DOTS).max(1);
        for (x, y) in points.iter().step_by(every) {
            dot(svg, axes.place(*x, *y), 2.0, DOT, "fill-opacity=\"0.55\"");
        }
    })
}

fn sensitivity(study: &Study, column: &Column, of: &Sensitivity) -> String {
    let paths = study.file.inputs.iter();
    let paths: Vec<&str> = paths.map(|input| input.vary.path.as_str()).collect();
    match of {
        Sensitivity::Effects(effects) => {
            let known = paths.iter().zip(effects);
            let known = known.filter_map(|(path, effect)| Some((path, (*effect)?)));
            let sizes = known.clone().map(|(_, e)| e.mean_size.max(e.deviation));
            let largest = sizes.fold(0.0, f64::max);
            let (factor, _) = scaled("", &column.unit, [largest].into_iter());
            let range = room([0.0, factor * largest].into_iter());
            let axes = panel(range, range);
            let name = |what: &str| scaled(what, &column.unit, [largest].into_iter()).1;
            picture(HEIGHT, |svg| {
                let title = "Elementary effects, over the whole range of an input";
                axes.axes(svg, title, &name("mean size μ*"), &name("deviation σ"));
                for (path, effect) in known {
                    let (x, y) = axes.place(factor * effect.mean_size, factor * effect.deviation);
                    dot(svg, (x, y), 4.0, DOT, "");
                    let (anchor, shift) = beside(x, 0.6, 7.0);
                    text(svg, x + shift, y - 5.0, anchor, &plain(path));
                }
            })
        }
        Sensitivity::Indices(indices) => {
            let rows: Vec<Bars> = (paths.iter().zip(indices))
                .map(|(path, index)| Bars {
                    name: format!("{path} {:.2}, {:.2}", index.first.value, index.total.value),
                    bars: vec![
                        (0.0, index.first.value, Some(index.first.band), DOT),
                        (0.0, index.total.value, Some(index.total.band), TOTAL),
                    ],
                })
                .collect();
            let title = "Sobol indices, 95 % bands: first order blue, total orange";
            bars(&rows, title, "share of the variance")
        }
        Sensitivity::Sweep(given, ranges) => {
            let (factor, label) = label(column);
            let rows: Vec<Bars> = (paths.iter().zip(ranges))
                .filter_map(|(path, range)| {
                    range.map(|[low, high]| Bars {
                        name: path.to_string(),
                        bars: vec![(factor * low, factor * high, None, DOT)],
                    })
                })
                .collect();
            let given = given.map(|value| amount(value, &column.unit));
            let given = given.map_or(String::new(), |value| format!("; {value} as given"));
            let title = format!("Range over each input alone{given}");
            bars(&rows, &title, &label)
        }
    }
}
