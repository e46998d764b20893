//! The document of a qualification: what is required, what was found, what was assumed, how it is tested; one HTML text that prints to pages.
//!
//! | page | sections |
//! |---|---|
//! | here | the first page: verdict of each requirement; frame of the document |
//! | [`requirement`](self::requirement) | a requirement over all runs and over drops in a row |
//! | [`machine`] | architecture, rotordynamics, environment, events |
//! | [`findings`] | failure modes, simulation, assumptions and what verdicts owe to them, drops in a row, verdicts of the cases |
//! | [`test`] | plan of a test, its signals with bands, monitoring, close clearances |
//!
//! A requirement is met, not met or not shown; nothing is said of the machine as a whole.

mod findings;
mod machine;
mod requirement;
mod test;

use self::requirement::Requirement;
use super::cells::{cell, percent, rows};
use super::ranking::requirement;
pub(super) use super::ranking::{of_values, words};
use super::summary::values_json;
use crate::page::{self, PageRun, escape_text as plain};
use outcome::{Judged, Outcome, Severity, Verdict, limits};
use run::study::Study;
use run::study::answer::Answer;
use run::study::in_a_row::InARow;
use run::study::little_known::{LittleKnown, Owed};
use run::study::selection::Candidate;
use run::study::table::{Column, Table, warned};
use scenario::{CASE, Limit};
use serde_json::{Value, json};
use std::fmt::Write;

/// Severe warnings that the first page names.
const NAMED: usize = 6;
/// Fewer draws have no value that 5 % of them fall below.
const FEW_DRAWS: usize = 20;
/// Warnings of what no run can show, which a verdict must not hide.
const UNSEEN: [&str; 2] = ["AB2415", "AB2417"];

/// What a document is made of.
pub(super) struct Document<'a> {
    pub study: &'a Study,
    pub table: &'a Table,
    pub answer: &'a Answer,
    /// Inputs that are known least, with what limits owe to them.
    pub known: &'a [LittleKnown],
    pub owed: &'a [Owed],
    /// Drops in a row.
    pub rows: &'a [InARow],
    pub drops: &'a Table,
    /// Signals of the test; none before they were computed.
    pub predicted: &'a [Column],
    /// The rotor on its magnets and on its auxiliary bearings.
    pub rotor: Option<(&'a Outcome, &'a PageRun)>,
    /// The day on which it was made.
    pub date: &'a str,
    /// Hash of study and scenario.
    pub hash: &'a str,
    /// The run nearest to a requirement.
    pub worst_run: Option<(usize, &'a PageRun)>,
    /// Whether every member has run, and all that is computed besides.
    pub complete: bool,
}

/// The verdict of a requirement.
fn verdict_word(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "met",
        Verdict::Fail => "not met",
        Verdict::Undecided => "not shown",
    }
}

/// The verdict of a requirement in its colour.
pub(super) fn shown(verdict: Verdict) -> String {
    let class = match verdict {
        Verdict::Pass => "met",
        Verdict::Fail => "failed",
        Verdict::Undecided => "open",
    };
    format!("<b class=\"{class}\">{}</b>", verdict_word(verdict))
}

fn section(number: usize, title: &str, body: &str) -> String {
    format!("<section>\n<h2>{number} {title}</h2>\n{body}</section>\n")
}

pub(super) fn paragraph(text: &str) -> String {
    format!("<p>{text}</p>\n")
}

pub(super) fn note(text: &str) -> String {
    format!("<p class=\"small\">{text}</p>\n")
}

/// A figure of two a line.
pub(super) fn figure(svg: &str) -> String {
    format!("<figure>{svg}</figure>\n")
}

impl Document<'_> {
    /// The document as one self-contained text.
    pub(super) fn html(&self) -> String {
        let (title, front) = self.front();
        let sections = [
            ("Architecture", self.architecture()),
            ("Requirements", self.requirements_table()),
            ("Rotordynamics", self.rotordynamics()),
            ("Environment", self.environment()),
            ("Events", self.events()),
            ("Failure modes", self.failure_modes()),
            ("Simulation", self.simulation()),
            ("Test plan", self.test_plan()),
            ("Predicted signals of the test", self.predicted_signals()),
            ("Monitoring in service", self.monitoring()),
            ("Close clearances", self.close_clearances()),
            ("Verdicts of the cases", self.verdicts()),
        ];
        let mut body = front;
        for (k, (title, text)) in sections.iter().enumerate() {
            body.push_str(&section(k + 1, title, text));
        }
        // of a run the drawing has its auxiliary bearings too
        let drawn = self.worst_run.map(|(_, run)| run);
        let drawn = drawn.or(self.rotor.map(|(_, run)| run));
        let drawing = drawn.map_or(String::new(), page::drawing);
        format!(
            "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
             <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data:\">\n\
             <title>{}</title>\n<style>\n{}\n{}\n</style>\n</head>\n<body class=\"document\">\n<main>\n{body}</main>\n{drawing}</body>\n</html>\n",
            plain(&title),
            page::STYLE.concat(),
            include_str!("document.css"),
        )
    }

    fn count(&self, requirements: &[Requirement], verdict: Verdict) -> usize {
        let own = requirements
            .iter()
            .filter(|one| one.verdict == verdict)
            .count();
        match verdict {
            Verdict::Undecided => own + self.study.file.document.requirements.len(),
            _ => own,
        }
    }

    /// Requirements met, not met, not shown.
    pub(super) fn tally(&self) -> [usize; 3] {
        let requirements = self.requirements();
        [Verdict::Pass, Verdict::Fail, Verdict::Undecided]
            .map(|verdict| self.count(&requirements, verdict))
    }

    /// Title and first page.
    fn front(&self) -> (String, String) {
        let file = &self.study.file;
        let document = &file.document;
        let machine = document.machine.as_deref().or(file.title.as_deref());
        let machine = machine.unwrap_or("Machine without a name");
        let title = format!("Qualification of the auxiliary bearings: {machine}");
        let requirements = self.requirements();
        let [met, not, open] = self.tally();
        let mut out = format!("<h1>{}</h1>\n", plain(&title));
        if let (Some(title), Some(_)) = (&file.title, &document.machine) {
            let _ = writeln!(out, "<p class=\"subtitle\">{}</p>", plain(title));
        }
        let missing = "<span class=\"blank\"></span>".to_string();
        let given =
            |text: &Option<String>| text.as_ref().map_or(missing.clone(), |text| plain(text));
        let facts = [
            ("Author", given(&document.author)),
            ("Revision", given(&document.revision)),
            ("Date", plain(self.date)),
            ("Program", format!("auxbear {}", env!("CARGO_PKG_VERSION"))),
            (
                "Inputs",
                format!(
                    "SHA-256 of <code>study.toml</code> and <code>scenario.toml</code> beside this document: <code>{}</code>",
                    self.hash
                ),
            ),
            ("Reviewed, date", missing.clone()),
            ("Approved, date", missing.clone()),
        ];
        let facts: String = facts
            .iter()
            .map(|(head, text)| format!("<tr><th>{head}</th><td>{text}</td></tr>\n"))
            .collect();
        let _ = writeln!(out, "<table class=\"facts\">{facts}</table>");
        let weak = (0..requirements.len()).filter(|k| {
            requirements[*k].verdict != Verdict::Fail && !self.breaks_with(*k).is_empty()
        });
        let weak = match weak.count() {
            0 => String::new(),
            count => {
                format!(
                    " {count} of those not failed are broken with an input at its low or high value."
                )
            }
        };
        let draws = self.least_draws();
        let rare = percent(1.0 - 0.05f64.powf(1.0 / draws as f64));
        let few = draws < FEW_DRAWS;
        let interim = match self.complete {
            true => String::new(),
            false => format!(
                "<br><b>Interim: {} of {} runs, and not all that is computed besides.</b>",
                self.answer.members, self.answer.asked
            ),
        };
        let _ = writeln!(
            out,
            "<div class=\"tally {}\"><b>{met} of {} requirements met, {not} not met, {open} not shown.</b>{weak} {}{draws} draws of each case at each level that all hold leave room for up to \
             {rare} of such runs that do not (95 % confidence).{}{interim}</div>",
            if not > 0 || few || !self.complete {
                "bad"
            } else {
                ""
            },
            met + not + open,
            if few { "<b>Few draws:</b> " } else { "" },
            if few { " 59 leave room for 5 %." } else { "" },
        );
        out.push_str(&self.without_limit());
        out.push_str(&self.ends_turning());
        out.push_str(&self.gravest());
        let verdicts = self.first_table(&requirements);
        let _ = writeln!(out, "<div class=\"verdicts\">{verdicts}</div>");
        out.push_str(&note(
            "Met: every run of every case in which it is required holds the bound; of a requirement with a share so many do, and the value is the one that just they hold. Not shown: the runs do not decide, or no result answers it. The margin is the distance to the bound as a \
             share of the bound. Verdicts hold for the inputs of this hash alone: when one of them changes, run again.",
        ));
        out.push_str(&note(if self.is_planar() {
            "Motion is planar: forces and motion along the shaft are not in any result, so no requirement on them is met by this document."
        } else {
            "Bearings in space: motion and forces along the shaft, and the tilt of the rings, are in the results."
        }));
        (title, out)
    }

    /// Whether all bearings move in the plane across the shaft alone.
    pub(super) fn is_planar(&self) -> bool {
        let values = self.study.file.scenario.resolved.values.iter();
        let mut fidelities = values.filter(|value| value.path == "bearing.fidelity");
        fidelities.all(|value| value.text.as_deref() != Some("spatial"))
    }

    /// Draws of each case at each level, at least.
    pub(super) fn least_draws(&self) -> usize {
        let ranking = self.answer.ranking.iter();
        ranking.map(|one| one.draws[0]).min().unwrap_or(0).max(1)
    }

    /// The gravest of what the runs warn of.
    fn gravest(&self) -> String {
        let all = self.table.members.len();
        let warned = warned(self.table);
        let severe: Vec<_> = warned
            .iter()
            .filter(|own| {
                own.severity() <= Severity::Invalid || UNSEEN.contains(&own.code.as_str())
            })
            .collect();
        let row = |own: &&run::study::table::Warned| {
            let (code, title, share) = (plain(&own.code), plain(&own.title), own.share(all));
            format!("<li class=\"grave\"><code>{code}</code> {title}: {share}</li>\n")
        };
        let mut list: String = severe.iter().take(NAMED).map(row).collect();
        let own = [
            self.critical_between_levels(),
            self.slower_than_given(),
            self.whirl_by_analysis(),
            self.at_screening(),
        ];
        for own in own.into_iter().flatten() {
            let _ = writeln!(list, "<li class=\"grave\">{own}</li>");
        }
        let more = match severe.len().saturating_sub(NAMED) {
            0 => String::new(),
            more => format!("<li>{more} more in section 7</li>\n"),
        };
        match list.is_empty() {
            true => list,
            false => format!(
                "<div class=\"warnings\"><strong>What counts against these results</strong><ul>\n{list}{more}</ul></div>\n"
            ),
        }
    }

    fn first_table(&self, requirements: &[Requirement]) -> String {
        let row = |(k, one): (usize, &Requirement)| {
            let judged = one.judged();
            // of what the runs do not decide no distance is known
            let decided = (judged.as_ref()).filter(|_| one.verdict != Verdict::Undecided);
            let margin = decided
                .and_then(Judged::margin)
                .map_or("–".to_string(), percent);
            let place = one
                .worst
                .map_or("–".to_string(), |(candidate, judged, member)| {
                    // of a share the run farthest beyond is not the one that decides
                    let member = member.filter(|_| judged.limit.share >= 1.0);
                    let more = match (member, judged.limit.share >= 1.0) {
                        (Some(member), _) => format!(", run {member}"),
                        (None, true) => String::new(),
                        (None, false) => self.of_share(judged),
                    };
                    format!("{}{more}", of_values(&candidate.values))
                });
            let place = (one.in_a_row.as_ref()).map_or(place, |(_, place)| place.clone());
            let why = match one.verdict {
                Verdict::Undecided if one.worst.is_none() => one.why.clone(),
                Verdict::Undecided => {
                    format!("{}; worst value: {place}{}", one.why, self.breaks_with(k))
                }
                Verdict::Fail => place,
                Verdict::Pass => format!("{place}{}", self.breaks_with(k)),
            };
            vec![
                format!("R{}", k + 1),
                self.requirement_words(one.limit),
                shown(one.verdict),
                cell(
                    judged.and_then(|judged| judged.value),
                    self.unit_of(one.limit),
                ),
                margin,
                why,
            ]
        };
        let mut body: Vec<Vec<String>> = requirements.iter().enumerate().map(row).collect();
        let own = self.study.file.document.requirements.iter().enumerate();
        body.extend(own.map(|(k, own)| {
            let dash = "–".to_string();
            vec![
                format!("R{}", requirements.len() + k + 1),
                plain(&own.text),
                shown(Verdict::Undecided),
                dash.clone(),
                dash,
                plain(&own.why),
            ]
        }));
        rows(
            &[
                "",
                "requirement",
                "verdict",
                "worst value",
                "margin",
                "where, or why not shown",
            ],
            &body,
        )
    }

    /// The requirements as `qualification.json` has them.
    pub(super) fn json(&self) -> String {
        let of = |(k, one): (usize, &Requirement)| {
            let judged = one.judged();
            let judged = judged.as_ref();
            let owed = self.owed.iter().find(|owed| owed.limit == k);
            let breaks = |input: usize| {
                let ends = owed.map_or([None; 2], |owed| owed.ends[input]);
                let known = &self.known[input];
                let both = ends.into_iter().zip(known.ends);
                let broken = both.filter(|(value, _)| {
                    owed.is_some()
                        && value.is_none_or(|value| !one.limit.side.holds(value, one.limit.bound))
                });
                let at: Vec<f64> = broken.map(|(_, end)| end).collect();
                (!at.is_empty()).then(|| json!({"input": known.path, "at": at, "unit": known.unit}))
            };
            json!({
                "number": k + 1,
                "quantity": one.limit.quantity,
                "side": one.limit.side.word(),
                "bound": one.limit.bound,
                "unit": judged.map(|judged| judged.unit),
                "case": one.limit.case,
                "share": one.limit.share,
                "source": one.limit.source,
                "verdict": verdict_word(one.verdict),
                "worst_value": judged.and_then(|judged| judged.value),
                "margin": judged.and_then(Judged::margin),
                "worst_case": one.worst.map(|(candidate, ..)| values_json(&candidate.values)),
                "in_a_row": one.in_a_row.as_ref().map(|(_, place)| place),
                "member": one.worst.and_then(|(.., member)| member).filter(|_| one.limit.share >= 1.0),
                "why": one.why,
                "broken_with": (0..self.known.len()).filter_map(breaks).collect::<Vec<_>>(),
            })
        };
        let requirements = self.requirements();
        let mut all: Vec<Value> = requirements.iter().enumerate().map(of).collect();
        let others = self.study.file.document.requirements.iter().enumerate();
        all.extend(others.map(|(k, own)| {
            json!({"number": requirements.len() + k + 1, "text": own.text, "source": own.source, "verdict": verdict_word(Verdict::Undecided), "why": own.why})
        }));
        let all = json!({
            "format": "auxbear.qualification/1",
            "version": env!("CARGO_PKG_VERSION"),
            "date": self.date,
            "inputs_sha256": self.hash,
            "complete": self.complete,
            "requirements": all,
        });
        format!("{all:#}\n")
    }

    /// The little known inputs that break a requirement at their low or high value, or with which its run does not run, though every run holds it.
    fn breaks_with(&self, limit: usize) -> String {
        let owed = self.owed.iter().find(|owed| owed.limit == limit);
        let of = &self.study.file.limits[limit];
        let ends = owed
            .into_iter()
            .flat_map(|owed| owed.ends.iter().zip(self.known));
        let ends = ends
            .flat_map(|(values, known)| values.iter().zip(known.ends).map(move |own| (own, known)));
        let broken = ends.filter_map(|((value, end), known)| {
            let told = match value {
                Some(value) if of.side.holds(*value, of.bound) => return None,
                Some(_) => "broken",
                None => "does not run",
            };
            Some(format!(
                "<br><b class=\"failed\">{told} with {} of {}</b>",
                words(&known.path),
                cell(Some(end), &known.unit)
            ))
        });
        broken.collect()
    }

    /// A requirement in words.
    pub(super) fn requirement_words(&self, limit: &Limit) -> String {
        let unit = self.unit_of(limit);
        requirement(&limits::judge(limit, unit, &[], ""))
    }

    fn requirements_table(&self) -> String {
        let none = "<b class=\"open\">no source is given</b>".to_string();
        let source = |text: &Option<String>| text.as_ref().map_or(none.clone(), |text| plain(text));
        let limits = self
            .study
            .file
            .limits
            .iter()
            .map(|limit| (self.requirement_words(limit), source(&limit.source)));
        let others = self.study.file.document.requirements.iter();
        let others = others.map(|own| (plain(&own.text), source(&own.source)));
        let all = limits.chain(others).enumerate();
        let body: Vec<Vec<String>> = all
            .map(|(k, (text, source))| vec![format!("R{}", k + 1), text, source])
            .collect();
        rows(&["", "requirement", "source of its number"], &body)
    }

    /// SI unit of what a limit bounds.
    pub(super) fn unit_of(&self, limit: &Limit) -> &'static str {
        let known = self
            .study
            .known
            .iter()
            .find(|own| own.name == limit.quantity);
        known.map_or("", |own| own.unit)
    }

    /// The values of a case and its levels, those of the tested case where they are asked for.
    pub(super) fn case_words(&self, member: usize) -> String {
        let of = |one: &&Candidate| (one.member..one.member + self.study.draws()).contains(&member);
        let candidate = self.answer.ranking.iter().find(of);
        candidate.map_or(String::new(), |one| of_values(&one.values))
    }

    /// The results that the document asks for by a word, such as the highest frequency of the model.
    pub(super) fn results_of(&self, word: &str) -> impl Iterator<Item = &outcome::Quantity> {
        let known = self.study.known.iter();
        known.filter(move |own| own.words_in("document") == Some(word))
    }

    /// The values of a result over all runs, those that stopped before their end as they were then.
    pub(super) fn values_of(&self, result: &outcome::Quantity) -> impl Iterator<Item = f64> {
        self.table.reached(&result.name).into_iter().flatten()
    }

    /// Names of the cases that run.
    pub(super) fn cases(&self) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for one in &self.answer.ranking {
            let case = one.values.iter().find(|(path, _)| path == CASE);
            names.extend(
                case.map(|(_, name)| name.clone())
                    .filter(|name| !names.contains(name))
                    .into_iter()
                    .collect::<Vec<_>>(),
            );
        }
        names
    }
}
