//! The test that this predicts: its plan, its signals with bands, what is watched in service, close clearances.

use super::{Document, FEW_DRAWS, figure, note, paragraph, words};
use crate::page::escape_text as plain;
use crate::picture::Panel;
use crate::study::bars::{WIDTH, picture, room};
use crate::study::cells::{amount, cell, percent, scaled, short, table};
use outcome::Spread;
use run::study::failure_modes::CloseClearances;
use run::study::predicted::{BAND, BANDWIDTH};
use run::study::table::Column;
use std::f64::consts::TAU;
use std::fmt::Write;

/// Signals that are drawn.
const DRAWN: usize = 12;
/// Ends of the signals that are drawn before others.
const DRAWN_FIRST: [&str; 6] = [
    "rotor.z",
    "rotor.x",
    "rotor.y",
    "axial_force",
    "mount.force",
    "speed",
];
/// Points of a line, at most.
const POINTS: usize = 500;
const HEIGHT: f64 = 230.0;
const LINE: &str = "#1f5fa8";

impl Document<'_> {
    fn tested(&self) -> (String, usize) {
        let member = self.study.tested();
        (self.case_words(member), member)
    }

    pub(super) fn test_plan(&self) -> String {
        let (case, member) = self.tested();
        let name = self.study.case_of(member);
        let said = name
            .as_ref()
            .and_then(|name| self.study.file.document.case(name));
        let drops = match said.map_or(1, |own| own.drops) {
            1 => "one drop".to_string(),
            several => format!("{several} drops"),
        };
        let bends = self
            .results_of("bending")
            .flat_map(|own| self.values_of(own));
        let bends = bends.fold(0.0, f64::max);
        let fastest = (BANDWIDTH * self.predicted_speed()).max(3.0 * bends) / TAU;
        let interval = self.interval();
        let coarse = match interval * 2.0 * fastest > 1.01 {
            true => format!(
                "; the predicted signals, a row every {}, show less",
                plain(&amount(interval, "s"))
            ),
            false => String::new(),
        };
        let bandwidth = match fastest > 0.0 {
            true => format!(
                " of {} Hz or more (ten times the speed, three times the first bending mode{coarse})",
                short(fastest)
            ),
            false => String::new(),
        };
        let limits = self.study.file.limits.iter().enumerate();
        // a warning of the program is nothing that a test shows
        let shown = limits.filter(|(_, limit)| limit.forbids.is_none());
        let here = shown.filter(|(_, limit)| limit.case.is_none() || limit.case == name);
        let abort: Vec<String> = here.map(|(k, _)| format!("R{}", k + 1)).collect();
        let items = [
            ("condition", format!("{case}: {drops}, with speed, temperature and clearance noted before each")),
            ("before", "clearance check (lift the rotor, read the sensors), run-down by hand, zero of every sensor with the rotor levitated".to_string()),
            ("displacement", format!("x and y at each auxiliary bearing and close clearance, with a bandwidth{bandwidth}")),
            ("speeds", "rotor: one mark a turn or more; inner races and cages where they can be seen: section 9 tells how quickly they come to speed".to_string()),
            ("forces, heat", "force on a mount or strain of its seat where a requirement bounds it; temperature of each outer ring".to_string()),
            ("braking", "as in service; a drop from speed without brake shows the spin-down".to_string()),
            ("stop when", format!("a bound that is measured is passed (of {}), a signal leaves its band of section 9 for good, or backward whirl lasts", abort.join(", "))),
            ("between drops", "clearance check against section 12 (drops in a row); turn by hand; look at both landing surfaces after the first and the last drop".to_string()),
        ];
        table(
            &["", "planned test"],
            items.map(|(head, text)| vec![head.to_string(), text]),
        )
    }

    /// Largest speed of the rotor in the test, rad/s; 0 before the signals were computed.
    fn predicted_speed(&self) -> f64 {
        let spin =
            |own: &&Column| own.name.starts_with("rotor.speed") && own.name.ends_with(BAND[1]);
        let values = self
            .predicted
            .iter()
            .find(spin)
            .map_or(&[][..], |own| &own.values);
        values.iter().map(|speed| speed.abs()).fold(0.0, f64::max)
    }

    /// Interval of the rows of the predicted signals, s; 0 before they were computed.
    fn interval(&self) -> f64 {
        let time = self.predicted.first();
        time.and_then(|time| time.values.get(1).copied())
            .unwrap_or(0.0)
    }

    pub(super) fn predicted_signals(&self) -> String {
        let (case, _) = self.tested();
        let Some((time, signals)) = self.predicted.split_first() else {
            return paragraph("<b class=\"open\">Not computed yet.</b>");
        };
        let mut out = paragraph(&format!(
            "{case}, over its draws. All signals stand in <code>predicted.csv</code> beside this document, a row every {}.",
            plain(&amount(self.interval(), "s"))
        ));
        out.push_str("<div class=\"pair\">\n");
        // of what a test measures first what its requirements are of: the rotor in each bearing, forces, speeds
        let rank = |band: &&[Column]| {
            let name = band[0].name.trim_end_matches(BAND[0]);
            let first = DRAWN_FIRST.iter().position(|end| name.ends_with(end));
            first.unwrap_or(DRAWN_FIRST.len())
        };
        let mut bands: Vec<&[Column]> = signals.chunks(BAND.len()).collect();
        bands.sort_by_key(rank);
        for band in bands.into_iter().take(DRAWN) {
            out.push_str(&figure(&band_figure(time, band)));
        }
        out.push_str("</div>\n");
        out.push_str(&self.band_of_few());
        out.push_str(&note("Line: median of the draws; band: 90 % of them. A band of chaotic motion is where it goes, not how: lay the measured signal over it, and compare instants, peaks and spreads."));
        out
    }

    /// What 5 % and 95 % of a few draws are worth.
    fn band_of_few(&self) -> String {
        let draws = self.least_draws();
        if draws >= FEW_DRAWS {
            return String::new();
        }
        let outside = percent(2.0 / (draws as f64 + 1.0));
        paragraph(&format!(
            "<b class=\"open\">{draws} draws have no 5 % and 95 %</b>: these are interpolated between them, and one more drop lies outside even their extremes with a probability of {outside}."
        ))
    }

    /// What the first drop of the test shows, to be noted in service and compared drop by drop.
    pub(super) fn monitoring(&self) -> String {
        let (case, first) = self.tested();
        let tested = first..first + self.study.draws();
        let rows = self.table.members.iter().enumerate();
        let own: Vec<usize> = rows
            .filter(|(_, member)| tested.contains(member))
            .map(|(row, _)| row)
            .collect();
        let body = self
            .study
            .known
            .iter()
            .filter(|known| known.headline)
            .filter_map(|result| {
                let values = self.table.values(&result.name);
                let values: Vec<f64> = own.iter().filter_map(|row| values[*row]).collect();
                // the others have it later, or not at all
                let of = match values.len() < own.len() {
                    true => format!(
                        " <b class=\"open\">(the {} of {} draws that have it)</b>",
                        values.len(),
                        own.len()
                    ),
                    false => String::new(),
                };
                let spread = Spread::of(values)?
                    .quantiles
                    .map(|value| cell(Some(value), result.unit));
                Some(
                    [
                        vec![format!("{}{of}", words(&result.name))],
                        spread.to_vec(),
                    ]
                    .concat(),
                )
            });
        format!(
            "{}{}{}",
            paragraph(
                "Of each contact event keep: speed, duration, number of contacts, largest displacement, time of the inner races to speed, spin-down time, temperature, and the cause. \
                 Compare drop n with drop 1: a longer spin-up or spin-down, a larger clearance or a band that is left means another bearing than the one of this document. \
                 Replace the bearings when the sum of a result of section 12 comes to its bound, or the clearance check leaves what a requirement needs."
            ),
            table(
                &[&format!("drop 1 of: {case}"), "5 %", "median", "95 %"],
                body
            ) + &self.band_of_few(),
            note(
                "Results of the first drop of the test over its draws; each has its law, source and range of validity in the page of a run."
            )
        )
    }

    pub(super) fn close_clearances(&self) -> String {
        let Some(asked) = self.rotor.and_then(|(rotor, _)| CloseClearances::of(rotor)) else {
            return paragraph("<b class=\"open\">Not shown</b>: the rotor was not analysed.");
        };
        // where it lands is no close clearance
        let resolved = &self.study.file.scenario.resolved.values;
        let landing = resolved
            .iter()
            .filter(|value| value.path == "contact.node")
            .filter_map(|value| value.text.as_deref());
        let landing: Vec<&str> = landing.collect();
        let nodes = self
            .results_of("clearance")
            .filter(|own| !own.name.split('.').any(|part| landing.contains(&part)));
        let body: Vec<Vec<String>> = nodes
            .map(|own| {
                let least = self.values_of(own).reduce(f64::min);
                let shown = cell(least, own.unit);
                vec![
                    words(&own.name),
                    match least.is_some_and(|own| own <= 0.0) {
                        true => format!("<b class=\"failed\">{shown}</b>"),
                        false => shown,
                    },
                ]
            })
            .collect();
        let close = match body.is_empty() {
            true => paragraph(
                "No node has a <code>clearance</code>: distances to seals and stators are not shown.",
            ),
            false => table(&["close clearance", "least over all runs"], body),
        };
        format!(
            "{}{close}{}",
            paragraph(&format!(
                "At the rated speed of {} API 617 (9th edition) allows a vibration of {} peak to peak; clearances are checked with an unbalance of {}.",
                cell(Some(asked.speed), "rad/s"),
                cell(Some(asked.vibration), "m"),
                cell(Some(asked.unbalance), "kg m")
            )),
            note(
                "These numbers were quoted second hand; the text of the standard was not at hand. Which share of a clearance vibration may take, and the vibration of the levitated rotor \
                 against the number above, are not evaluated here: see the responses of <code>auxbear rotor</code>."
            )
        )
    }
}

/// A signal with its band over time.
fn band_figure(time: &Column, band: &[Column]) -> String {
    let name = band[0].name.trim_end_matches(BAND[0]);
    let all = band.iter().flat_map(|column| column.values.iter().copied());
    let (factor, label) = scaled("", &band[0].unit, all.clone());
    let (seconds, along) = scaled("time", "s", time.values.iter().copied());
    let axes = Panel {
        left: 78.0,
        top: 32.0,
        width: WIDTH - 100.0,
        height: HEIGHT - 84.0,
        x: room(time.values.iter().map(|t| t * seconds)),
        y: room(all.map(|value| value * factor)),
    };
    let thinned = time.values.len().div_ceil(POINTS).max(1);
    let points = |column: &Column| -> Vec<String> {
        let both = time.values.iter().zip(&column.values).step_by(thinned);
        let known = both.filter(|(_, value)| value.is_finite());
        let placed = known.map(|(t, value)| axes.place(t * seconds, value * factor));
        placed.map(|(x, y)| format!("{x:.1},{y:.1}")).collect()
    };
    picture(HEIGHT, |svg| {
        axes.axes(svg, &words(name), &along, label.trim_start_matches(", "));
        let mut edge = points(&band[0]);
        edge.extend(points(&band[2]).into_iter().rev());
        let _ = writeln!(
            svg,
            "<polygon points=\"{}\" fill=\"{LINE}\" fill-opacity=\"0.22\"/>",
            edge.join(" ")
        );
        let _ = writeln!(
            svg,
            "<polyline points=\"{}\" fill=\"none\" stroke=\"{LINE}\" stroke-width=\"1.4\"/>",
            points(&band[1]).join(" ")
        );
    })
}
