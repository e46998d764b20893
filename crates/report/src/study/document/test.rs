//! The test that this predicts: its plan, its signals with bands, what is watched in service, close clearances.

use super::{Document, figure, note, paragraph, words};
use crate::page::escape_text as plain;
use crate::picture::Panel;
use crate::study::bars::{WIDTH, picture, room};
use crate::study::cells::{amount, known, rows, scaled, short};
use outcome::Spread;
use run::study::failure_modes::CloseClearances;
use run::study::predicted::BAND;
use run::study::table::Column;
use std::f64::consts::TAU;
use std::fmt::Write;

/// Signals that are drawn.
const DRAWN: usize = 12;
const HEIGHT: f64 = 230.0;
const LINE: &str = "#1f5fa8";

impl Document<'_> {
    fn tested(&self) -> (String, usize) {
        let member = self.study.tested();
        (self.case_words(member), member)
    }

    pub(super) fn test_plan(&self) -> String {
        let (case, member) = self.tested();
        let document = &self.study.file.document;
        let name = self.study.case_of(member).unwrap_or_default();
        let drops = document.case(&name).map_or(1, |own| own.drops);
        let bends = self
            .results_of("bending")
            .flat_map(|own| self.values_of(own))
            .reduce(f64::max);
        let speed = self.predicted_speed();
        let fastest = (10.0 * speed).max(3.0 * bends.unwrap_or(0.0)) / TAU;
        let bandwidth = match fastest > 0.0 {
            true => format!(
                " of {} Hz or more (ten times the speed, three times the first bending mode)",
                short(fastest)
            ),
            false => String::new(),
        };
        let shown = self.requirements();
        let abort: Vec<String> = shown
            .iter()
            .enumerate()
            .map(|(k, one)| {
                format!("R{}", k + 1)
                    + if one.limit.forbids.is_some() {
                        " (by its signals)"
                    } else {
                        ""
                    }
            })
            .collect();
        let items = [
            ("condition", format!("{}: {drops} drops, each with speed, temperature and clearance noted before it", case)),
            ("before", "clearance check (lift the rotor, read the sensors), run-down by hand, zero of every sensor with the rotor levitated".to_string()),
            ("displacement", format!("x and y at each auxiliary bearing and close clearance, with a bandwidth{bandwidth}")),
            ("speeds", "rotor: one mark a turn or more; inner races and cages where they can be seen: section 9 tells how quickly they come to speed".to_string()),
            ("forces, heat", "force on a mount or strain of its seat where a requirement bounds it; temperature of each outer ring".to_string()),
            ("braking", "as in service; a drop from speed without brake shows the spin-down".to_string()),
            ("stop when", format!("a bound is passed ({}), a signal leaves its band of section 9 for good, or backward whirl lasts", abort.join(", "))),
            ("between drops", "clearance check against section 12 (drops in a row); turn by hand; look at both landing surfaces after the first and the last drop".to_string()),
        ];
        let body: Vec<Vec<String>> = items
            .iter()
            .map(|(head, text)| vec![head.to_string(), text.clone()])
            .collect();
        rows(&["", "planned test"], &body)
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

    pub(super) fn predicted_signals(&self) -> String {
        let (case, _) = self.tested();
        let Some((time, signals)) = self.predicted.split_first() else {
            return paragraph("<b class=\"open\">Not computed yet.</b>");
        };
        let mut out = paragraph(&format!(
            "{case}, over its draws. All signals stand in <code>predicted.csv</code> beside this document, a row every {}.",
            plain(&amount(time.values.get(1).copied().unwrap_or(0.0), "s"))
        ));
        out.push_str("<div class=\"pair\">\n");
        for band in signals.chunks(BAND.len()).take(DRAWN) {
            out.push_str(&figure(&band_figure(time, band)));
        }
        out.push_str("</div>\n");
        out.push_str(&note("Line: median of the draws; band: 90 % of them. A band of chaotic motion is where it goes, not how: lay the measured signal over it, and compare instants, peaks and spreads."));
        out
    }

    /// What the first drop of the test shows, to be noted in service and compared drop by drop.
    pub(super) fn monitoring(&self) -> String {
        let (case, first) = self.tested();
        let tested = first..first + self.study.draws();
        let own: Vec<usize> = (self.table.members.iter().enumerate())
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
                let known = values.len();
                let spread = Spread::of(values)?;
                // the others have it later, or not at all
                let of = match known < own.len() {
                    true => format!(
                        " <b class=\"open\">(the {known} of {} draws that have it)</b>",
                        own.len()
                    ),
                    false => String::new(),
                };
                let mut row = vec![format!("{}{of}", words(&result.name))];
                row.extend(
                    spread
                        .quantiles
                        .map(|value| plain(&amount(value, result.unit)).replace(' ', "\u{a0}")),
                );
                Some(row)
            });
        let body: Vec<Vec<String>> = body.collect();
        format!(
            "{}{}{}",
            paragraph(
                "Of each contact event keep: speed, duration, number of contacts, largest displacement, time of the inner races to speed, spin-down time, temperature, and the cause. \
                 Compare drop n with drop 1: a longer spin-up or spin-down, a larger clearance or a band that is left means another bearing than the one of this document. \
                 Replace the bearings when the sum of a result of section 12 comes to its bound, or the clearance check leaves what a requirement needs."
            ),
            rows(
                &[&format!("drop 1 of: {case}"), "5 %", "median", "95 %"],
                &body
            ),
            note(
                "Results of the first drop of the test over its draws; each has its law, source and range of validity in the page of a run."
            )
        )
    }

    pub(super) fn close_clearances(&self) -> String {
        let Some(asked) = self.rotor.and_then(|(rotor, _)| CloseClearances::of(rotor)) else {
            return paragraph("<b class=\"open\">Not shown</b>: the rotor was not analysed.");
        };
        let rpm = |speed: f64| known(Some(speed), "rad/s");
        let body = self.results_of("clearance").map(|own| {
            let least = self.values_of(own).reduce(f64::min);
            vec![
                words(&own.name),
                plain(&known(least, own.unit)).replace(' ', "\u{a0}"),
            ]
        });
        let body: Vec<Vec<String>> = body.collect();
        let table = match body.is_empty() {
            true => paragraph(
                "No node has a <code>clearance</code>: distances to seals and stators are not shown.",
            ),
            false => rows(&["close clearance", "least over all runs"], &body),
        };
        format!(
            "{}{table}{}",
            paragraph(&format!(
                "At the rated speed of {} API 617 (9th edition) allows a vibration of {} peak to peak; clearances are checked with an unbalance of {}.",
                plain(&rpm(asked.speed)),
                plain(&amount(asked.vibration, "m")),
                plain(&amount(asked.unbalance, "kg m"))
            )),
            note(
                "These numbers were quoted second hand; the text of the standard was not at hand."
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
    let points = |column: &Column| -> Vec<String> {
        let both = time.values.iter().zip(&column.values);
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
