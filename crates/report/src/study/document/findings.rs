//! What was found: how each failure mode is excluded, what the simulation holds for, what verdicts owe to assumptions, drops in a row, and the
//! verdicts of the cases.

use super::{Document, note, of_values, paragraph, words};
use crate::page::escape_text as plain;
use crate::picture::orbit_svg;
use crate::study::cells::{cell, percent, short, table};
use crate::study::ranking::of_each;
use outcome::{Judged, Severity};
use run::study::Study;
use run::study::failure_modes::{FAILURE_MODES, FailureMode};
use run::study::in_a_row::InARow;
use run::study::little_known::Owed;
use run::study::selection::Candidate;
use run::study::table::{CONFIRMED, warned};
use scenario::{Limit, Side};
use statistics::share::wilson;

/// Values of assumptions that were not tried, at most.
const MOST_ASSUMED: usize = 40;

impl Document<'_> {
    /// That the runs were computed at screening accuracy.
    pub(super) fn at_screening(&self) -> Option<String> {
        let accuracy = self.study.file.scenario.resolved.get("run.accuracy")?;
        let columns = self.table.columns.iter();
        let mut confirmed = columns.filter(|column| column.name.starts_with(CONFIRMED));
        let confirmed = confirmed.any(|column| column.values.iter().any(|own| own.is_finite()));
        (accuracy.text.as_deref() == Some("screening")).then(|| {
            let confirmed = match confirmed {
                true => ": those near a limit were confirmed at design accuracy",
                false => ": a margin of a few per cent is none, as no run was confirmed at design accuracy",
            };
            format!("Runs at screening accuracy{confirmed}")
        })
    }

    /// How many runs hold a requirement that a share of them must hold, and the worst value of all.
    pub(super) fn of_share(&self, judged: &Judged) -> String {
        let side = |value: f64| match judged.limit.side {
            Side::Most => value,
            Side::Least => -value,
        };
        let values = self.study.limited(self.table, &judged.limit).into_iter();
        let worst = values
            .flatten()
            .max_by(|a, b| side(*a).total_cmp(&side(*b)));
        format!(
            ": {} of {} runs hold it, the worst of all runs is {}",
            judged.hold,
            judged.members,
            cell(worst, self.unit_of(&judged.limit))
        )
    }

    /// How each failure mode is excluded: the worst of its results, the requirements that bound it in every case, and runs that warn of it.
    pub(super) fn failure_modes(&self) -> String {
        let requirements = self.requirements();
        let row = |mode: &FailureMode| {
            let worst = self.study.worst_of(mode, self.table);
            let bounds = |limit: &Limit| {
                let forbids = mode
                    .warnings
                    .iter()
                    .any(|code| limit.quantity.ends_with(code));
                limit.case.is_none()
                    && (forbids || worst.iter().any(|own| own.result.name == limit.quantity))
            };
            let bounded = requirements
                .iter()
                .enumerate()
                .filter(|(_, one)| bounds(one.limit));
            let bounded: Vec<String> = bounded
                .map(|(k, one)| format!("R{} {}", k + 1, super::shown(one.verdict)))
                .collect();
            let values = worst.iter().map(|own| {
                let member = own
                    .member
                    .map_or(String::new(), |member| format!(" (run {member})"));
                let why = match (own.value, own.result.value.why_absent()) {
                    (None, Some(why)) => format!(" ({})", plain(why)),
                    _ => String::new(),
                };
                format!(
                    "{} {}{member}{why}",
                    words(&own.result.name),
                    cell(own.value, own.result.unit)
                )
            });
            let values: Vec<String> = values.collect();
            let warned = match values.is_empty() {
                true => "–".to_string(),
                false => self.share_of(mode),
            };
            let or = |list: Vec<String>, none: &str| match list.is_empty() {
                true => none.to_string(),
                false => list.join("<br>"),
            };
            vec![
                mode.name.to_string(),
                or(values, "<b class=\"open\">not in this model</b>"),
                or(bounded, "<b class=\"open\">no requirement</b>"),
                warned,
            ]
        };
        format!(
            "{}{}",
            table(
                &[
                    "failure mode",
                    "worst value of all runs",
                    "bounded in every case by",
                    "warnings: most often in a case at a level"
                ],
                FAILURE_MODES.iter().map(row)
            ),
            note(
                "A failure mode that no requirement bounds is not excluded by this document, whatever its value. Shares have their 95 % interval. The list is not complete by any standard."
            )
        )
    }

    /// Where a failure mode is warned of most often, with the 95 % interval of that share.
    fn share_of(&self, mode: &FailureMode) -> String {
        let warned = warned(self.table);
        let of = |code: &str, one: &Candidate| {
            let rows = self.table.members.iter().enumerate();
            let own = rows.filter(|(_, member)| {
                (one.member..one.member + self.study.draws()).contains(member)
            });
            let column = self.table.column(&format!("warning.{code}"));
            own.filter(|(row, _)| column.is_some_and(|column| !column.values[*row].is_nan()))
                .count()
        };
        let mut told: Vec<String> = Vec::new();
        for code in mode.warnings {
            let Some(found) = warned.iter().find(|own| own.code == **code) else {
                continue;
            };
            let most = self.answer.ranking.iter().max_by_key(|one| of(code, one));
            let Some(one) = most else { continue };
            let (count, all) = (of(code, one), one.draws[0]);
            let [low, high] = wilson(count, all).map(percent);
            told.push(format!(
                "<code>{code}</code> {}: {count} of {all} runs ({low} to {high}) of {}",
                plain(&found.title),
                of_values(&one.values)
            ));
        }
        let rotor = self
            .rotor
            .into_iter()
            .flat_map(|(rotor, _)| &rotor.warnings);
        let rotor = rotor.filter(|own| mode.warnings.contains(&own.code));
        told.extend(rotor.map(|own| {
            format!(
                "<code>{}</code> analysis of the rotor: {}",
                own.code,
                plain(&own.part)
            )
        }));
        match told.is_empty() {
            true => format!("none of {} runs", self.table.members.len()),
            false => told.join("<br>"),
        }
    }

    pub(super) fn simulation(&self) -> String {
        let file = &self.study.file;
        let resolved = &file.scenario.resolved;
        let of = |path: &str| resolved.get(path).and_then(|value| value.text.clone());
        let of = |path: &str| plain(&of(path).unwrap_or_default());
        let residual = self
            .results_of("residual")
            .flat_map(|own| self.values_of(own));
        let residual = residual.map(f64::abs).reduce(f64::max);
        let confirmed = match file.confirm {
            0 => String::new(),
            count => format!(
                "The {count} nearest to each limit were run again at design accuracy, which decides; what verdicts owe to inputs, drops in a row and predicted signals are at {}. ",
                of("run.accuracy")
            ),
        };
        let mut out = paragraph(&format!(
            "{} runs of {} each at {} accuracy, seed {}. {confirmed}Every ball, the races, the cage, the mounts and the bending rotor are integrated together; laws, sources and \
             ranges of validity stand with each result in the page of a run, and what the program was compared with in its book (Validation, Published tests). {}",
            self.answer.members,
            of("run.duration"),
            of("run.accuracy"),
            file.seed,
            residual.map_or(String::new(), |value| format!(
                "Largest residual of the energy ledger: {} of what is turned over.",
                short(value)
            ))
        ));
        out.push_str(&paragraph(&format!(
            "Impacts are chaotic: a single late value of a single run means little, so requirements are judged over draws, and by the worst of them. Limits of the model: \
             {}dents do not change later motion; lubricant and surface are those of the inputs.",
            if self.is_planar() { "motion is planar (no axial drop, no tilt of the rings); " } else { "" }
        )));
        let all = self.table.members.len();
        let warned = warned(self.table).into_iter();
        let warned = warned.filter(|own| own.severity() < Severity::Note);
        let body = warned.map(|own| {
            let code = format!("<code>{}</code> {}", plain(&own.code), plain(&own.title));
            vec![own.severity().word().to_string(), code, own.share(all)]
        });
        out.push_str("<h3>What the runs warn of</h3>\n");
        out.push_str(&table(&["severity", "warning", "runs"], body));
        out.push_str(&self.assumptions());
        out
    }

    /// Inputs that are little known by their effect on the requirements, then what is assumed and was not tried.
    fn assumptions(&self) -> String {
        let limits = &self.study.file.limits;
        // what an input takes of the margin; where a run failed all of it
        let effect = |owed: &Owed, input: usize| -> Option<f64> {
            let limit = &limits[owed.limit];
            let value = owed.value?;
            let margin = (limit.bound - value).abs();
            let towards = |end: f64| match limit.side {
                Side::Most => end - value,
                Side::Least => value - end,
            };
            let ends = owed.ends[input].iter();
            let most = ends
                .map(|end| end.map_or(margin, towards))
                .fold(0.0, f64::max);
            Some(most / margin).filter(|share| share.is_finite() && limit.bound != 0.0)
        };
        let of = |input: usize| {
            let all = self.owed.iter().filter_map(|owed| effect(owed, input));
            (input, all.fold(0.0, f64::max))
        };
        let mut ranked: Vec<(usize, f64)> = (0..self.known.len()).map(of).collect();
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut out = "<h3>Assumptions by their effect, and what each verdict owes to them</h3>\n"
            .to_string();
        if self.owed.is_empty() {
            out.push_str(&paragraph("Not computed yet, or nothing is drawn or assumed that could be tried at a low and a high value."));
        } else {
            let body = ranked.iter().map(|(input, effect)| {
                let own = &self.known[*input];
                let kind = if own.drawn {
                    "drawn: "
                } else {
                    "<span class=\"assumed\">assumed</span>: "
                };
                vec![
                    format!("<code>{}</code>", plain(&own.path)),
                    plain(&own.given),
                    own.ends.map(|end| cell(Some(end), &own.unit)).join(" / "),
                    format!("{kind}{}", plain(&own.origin)),
                    percent(*effect),
                ]
            });
            out.push_str(&table(
                &[
                    "input",
                    "as given",
                    "low / high",
                    "origin",
                    "most that it takes of a margin",
                ],
                body,
            ));
            out.push_str(&self.owed_table(&ranked));
        }
        let tried = |path: &str| self.known.iter().any(|own| own.path == path);
        let assumed = self.study.assumed();
        let rest: Vec<_> = assumed.iter().filter(|(path, ..)| !tried(path)).collect();
        if !rest.is_empty() {
            let body = rest.iter().take(MOST_ASSUMED).map(|(path, value, why)| {
                vec![
                    format!("<code>{}</code>", plain(path)),
                    plain(value),
                    plain(why),
                ]
            });
            let listed = table(&["input", "value", "why"], body);
            let count = rest.len();
            out.push_str(&format!("<h3>Assumed, and their effect not tried: {count}</h3>\n<div class=\"fine\">{listed}</div>"));
        }
        out
    }

    /// The worst value of each requirement with each input at its low and at its high value.
    fn owed_table(&self, ranked: &[(usize, f64)]) -> String {
        let body = self.owed.iter().map(|owed| {
            let limit = &self.study.file.limits[owed.limit];
            let value = |value: Option<f64>| match value {
                Some(value) if limit.side.holds(value, limit.bound) => {
                    cell(Some(value), self.unit_of(limit))
                }
                Some(value) => format!(
                    "<b class=\"failed\">{}</b>",
                    cell(Some(value), self.unit_of(limit))
                ),
                None => "<b class=\"failed\">does not run</b>".to_string(),
            };
            let first = format!("R{} (run {})", owed.limit + 1, owed.member);
            let ends = ranked.iter().map(|(input, _)| {
                let both = owed.ends[*input].into_iter().zip(owed.slips[*input]);
                let both = both.map(|(end, slips)| {
                    let mark = if slips {
                        " <b class=\"open\">slips</b>"
                    } else {
                        ""
                    };
                    format!("{}{mark}", value(end))
                });
                both.collect::<Vec<_>>().join(" / ")
            });
            [first, value(owed.value)].into_iter().chain(ends).collect()
        });
        let inputs = ranked
            .iter()
            .map(|(input, _)| self.known[*input].path.replace(['_', '.'], " "));
        let head: Vec<String> = ["worst run", "as drawn"]
            .map(str::to_string)
            .into_iter()
            .chain(inputs)
            .collect();
        let head: Vec<&str> = head.iter().map(String::as_str).collect();
        format!(
            "{}{}",
            table(&head, body),
            note(
                "The run nearest to a requirement, or the farthest beyond it, again with one input at its low / high value and all others as it drew them; what breaks the bound is \
                 red; a run that ends while a race slips, so that more may follow, is marked. Of what is drawn these are the values that 5 % of the draws fall below and exceed, of what is merely assumed half and double."
            )
        )
    }

    /// Values of a limit in the drops of a row, in their order; none of those that did not run.
    pub(super) fn of_row(&self, k: usize, row: &InARow, limit: &Limit) -> Vec<Option<f64>> {
        let values = self.study.limited(self.drops, limit);
        let place = |drop| {
            self.drops
                .members
                .binary_search(&Study::drop_of_row(k, drop))
                .ok()
        };
        (0..row.drops)
            .map(|drop| place(drop).and_then(|at| values[at]))
            .collect()
    }

    /// What a limit holds after each drop of a row: of results that add up, such as wear and life, the sum so far.
    pub(super) fn after_each(&self, values: Vec<Option<f64>>, limit: &Limit) -> Vec<Option<f64>> {
        if !self.adds_up(limit) {
            return values;
        }
        let mut sum = Some(0.0);
        let so_far = values.into_iter().map(|own| {
            sum = Some(sum? + own?);
            sum
        });
        so_far.collect()
    }

    /// Whether what a limit bounds from above adds up over drops.
    pub(super) fn adds_up(&self, limit: &Limit) -> bool {
        let mut known = self.study.known.iter();
        let own = known.find(|own| own.name == limit.quantity);
        limit.side == Side::Most && own.is_some_and(|own| own.words_in("added_up").is_some())
    }

    /// Drops in a row: what wear leaves, and what requirements say of each.
    fn in_a_row(&self) -> String {
        let asked = self
            .study
            .file
            .document
            .cases
            .iter()
            .any(|case| case.drops > 1);
        if self.rows.is_empty() {
            return paragraph(match asked {
                true => "<b class=\"open\">Not computed yet.</b>",
                false => {
                    "No case asks for drops in a row (<code>[[case]] drops = 10</code>): every run begins as new."
                }
            });
        }
        let mut out = String::new();
        for (k, row) in self.rows.iter().enumerate() {
            let limits = self.study.file.limits.iter();
            let limits = limits.filter(|limit| {
                limit.case.is_none() || limit.case == self.study.case_of(row.member)
            });
            let ends = |values: &[Option<f64>], unit: &str| {
                [values.first(), values.last()].map(|end| cell(end.copied().flatten(), unit))
            };
            let bounded = limits.map(|limit| {
                let values = self.of_row(k, row, limit);
                let [first, last] = ends(&values, self.unit_of(limit));
                let after = self.after_each(values, limit);
                let beyond = |value: &f64| !limit.side.holds(*value, limit.bound);
                let broken = after.iter().flatten().filter(|own| beyond(own)).count();
                let told = match (self.adds_up(limit), after.iter().flatten().last()) {
                    (true, Some(sum)) => format!("sum {}", cell(Some(*sum), self.unit_of(limit))),
                    _ => format!("{broken} of {} beyond", after.iter().flatten().count()),
                };
                let told = if broken > 0 {
                    format!("<b class=\"failed\">{told}</b>")
                } else {
                    told
                };
                vec![self.requirement_words(limit), first, last, told]
            });
            let added = self
                .study
                .known
                .iter()
                .filter(|own| own.words_in("added_up").is_some());
            let added = added.map(|own| {
                let values = self.drops.values(&own.name);
                let place = |drop| {
                    self.drops
                        .members
                        .binary_search(&Study::drop_of_row(k, drop))
                        .ok()
                };
                let own_values: Vec<Option<f64>> =
                    (0..row.drops).map(|drop| values[place(drop)?]).collect();
                let [first, last] = ends(&own_values, own.unit);
                let sum = own_values.iter().copied().sum::<Option<f64>>();
                vec![
                    words(&own.name),
                    first,
                    last,
                    format!("sum {}", cell(sum, own.unit)),
                ]
            });
            out.push_str(&format!(
                "<h3>{}: {} drops</h3>\n",
                of_values(&row.values),
                row.drops
            ));
            out.push_str(&table(
                &["result", "drop 1", "last drop", "of all"],
                bounded.chain(added),
            ));
        }
        out.push_str(&note(
            "Drop 1 is the run nearest to a requirement. Each later one has the radial clearance widened by the wear of those before (where <code>contact.surface.wear_coefficient</code> is given), \
             the grease as they left it, and another angle of the unbalance. Dents do not change later motion in this model. Wear and life add up: a requirement on them is met while the sum of the drops so far holds it. That no drop is beyond a bound shows nothing more than that.",
        ));
        out
    }

    /// Each case at each level with its verdict.
    pub(super) fn verdicts(&self) -> String {
        let figure = self.worst_run.map_or(String::new(), |(member, run)| {
            let told =
                format!("Run {member}, the nearest to a requirement or the farthest beyond.");
            format!(
                "<figure>{}<figcaption><span>{told}</span></figcaption></figure>\n",
                orbit_svg(run)
            )
        });
        format!(
            "{}{}{figure}<h3>Drops in a row</h3>\n{}",
            of_each(self.answer),
            note(
                "A run is shown in full by <code>auxbear study FILE --member N</code>, at the accuracy of the study."
            ),
            self.in_a_row()
        )
    }
}
