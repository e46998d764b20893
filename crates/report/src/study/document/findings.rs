//! What was found: how each failure mode is excluded, what the simulation holds for, what verdicts owe to assumptions, drops in a row, and the
//! verdicts of the cases.

use super::{Document, note, of_values, paragraph, words};
use crate::page::escape_text as plain;
use crate::study::cells::{amount, known, marked, rows, short};
use outcome::{Severity, Verdict};
use run::study::Study;
use run::study::failure_modes::{FAILURE_MODES, FailureMode};
use run::study::little_known::Owed;
use statistics::share::wilson;

/// Values of assumptions that were not tried, at most.
const MOST_ASSUMED: usize = 40;

impl Document<'_> {
    /// How each failure mode is excluded: the worst of its results, the requirement that bounds it, and runs that warn of it.
    pub(super) fn failure_modes(&self) -> String {
        let requirements = self.requirements();
        let row = |mode: &FailureMode| {
            let worst = self.study.worst_of(mode, self.table);
            let bounded = requirements.iter().enumerate().filter(|(_, one)| {
                let forbidden = mode
                    .warnings
                    .iter()
                    .any(|code| one.limit.quantity.ends_with(code));
                forbidden
                    || worst
                        .iter()
                        .any(|own| same_result(&one.limit.quantity, &own.result.name))
            });
            let bounded: Vec<String> = bounded
                .map(|(k, one)| format!("R{} {}", k + 1, super::shown(one.verdict)))
                .collect();
            let values = worst.iter().map(|own| {
                let value = plain(&known(own.value, own.result.unit)).replace(' ', "\u{a0}");
                let member = own
                    .member
                    .map_or(String::new(), |member| format!(" (run {member})"));
                format!("{} {value}{member}", words(&own.result.name))
            });
            let values: Vec<String> = values.collect();
            vec![
                mode.name.to_string(),
                if values.is_empty() {
                    "no result".to_string()
                } else {
                    values.join("<br>")
                },
                match bounded.is_empty() {
                    true => "<b class=\"open\">no requirement</b>".to_string(),
                    false => bounded.join("<br>"),
                },
                self.share_of(mode),
            ]
        };
        let body: Vec<Vec<String>> = FAILURE_MODES.iter().map(row).collect();
        format!(
            "{}{}",
            rows(
                &[
                    "failure mode",
                    "worst value of all runs",
                    "bounded by",
                    "runs that warn of it"
                ],
                &body
            ),
            note(
                "A failure mode that no requirement bounds is not excluded by this document, whatever its value. The list is not complete by any standard."
            )
        )
    }

    /// Shares of the runs that warn of a failure mode, with their 95 % interval.
    fn share_of(&self, mode: &FailureMode) -> String {
        let all = self.table.members.len();
        let warned = self.table.warned();
        let own = mode.warnings.iter().filter_map(|code| {
            let found = warned.iter().find(|own| own.code == *code)?;
            let [low, high] = wilson(found.members, all).map(|share| short(100.0 * share));
            let share = short(100.0 * found.members as f64 / all.max(1) as f64);
            Some(format!(
                "<code>{code}</code> {}: {share}\u{a0}% ({low} to {high}\u{a0}%)",
                plain(&found.title)
            ))
        });
        let mut told: Vec<String> = own.collect();
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
            true => "none".to_string(),
            false => told.join("<br>"),
        }
    }

    pub(super) fn simulation(&self) -> String {
        let file = &self.study.file;
        let resolved = &file.scenario.resolved;
        let of = |path: &str| {
            resolved
                .get(path)
                .and_then(|value| value.text.clone())
                .unwrap_or_default()
        };
        let design = file.confirm > 0;
        let residual = self
            .results_of("residual")
            .flat_map(|own| self.values_of(own));
        let residual = residual.map(f64::abs).reduce(f64::max);
        let mut out = paragraph(&format!(
            "{} runs of {} each at {} accuracy{}, seed {}. Every ball, the races, the cage, the mounts and the bending rotor are integrated together; laws, sources and ranges \
             of validity stand with each result in the page of a run. {}",
            self.answer.members,
            plain(&of("run.duration")),
            plain(&of("run.accuracy")),
            if design {
                format!(
                    ", of which the {} nearest to each limit were run again at design accuracy, which decides",
                    file.confirm
                )
            } else {
                String::new()
            },
            file.seed,
            residual.map_or(String::new(), |value| format!(
                "Largest residual of the energy ledger: {} of what is turned over.",
                short(value)
            ))
        ));
        out.push_str(&paragraph(
            "Impacts are chaotic: a single late value of a single run means little, so requirements are judged over draws, and by the worst of them. Limits of the model: \
             motion is planar (no axial drop, no tilt of the rings); dents do not change later motion; lubricant and surface are those of the inputs.",
        ));
        out.push_str("<h3>What the runs warn of</h3>\n");
        let all = self.table.members.len();
        let warned = self
            .table
            .warned()
            .into_iter()
            .filter(|own| own.severity() < Severity::Note);
        let body: Vec<Vec<String>> = warned
            .map(|own| {
                vec![
                    own.severity().word().to_string(),
                    format!("<code>{}</code> {}", plain(&own.code), plain(&own.title)),
                    own.share(all),
                ]
            })
            .collect();
        match body.is_empty() {
            true => out.push_str(&paragraph("Nothing.")),
            false => out.push_str(&rows(&["severity", "warning", "runs"], &body)),
        }
        out.push_str(&self.assumptions());
        out
    }

    /// Inputs that are little known by their effect on the requirements, then what is assumed and was not tried.
    fn assumptions(&self) -> String {
        let limits = &self.study.file.limits;
        let effect = |owed: &Owed, input: usize| -> Option<f64> {
            let value = owed.value?;
            let apart = owed.ends[input]
                .iter()
                .flatten()
                .map(|end| (end - value).abs());
            // of a bound of 0 as a share of the value
            let size = Some(limits[owed.limit].bound.abs()).filter(|bound| *bound > 0.0);
            let size = size.unwrap_or(value.abs());
            Some(apart.reduce(f64::max)? / size).filter(|effect| effect.is_finite())
        };
        let mut ranked: Vec<(usize, f64)> = (0..self.known.len())
            .map(|input| {
                (
                    input,
                    self.owed
                        .iter()
                        .filter_map(|owed| effect(owed, input))
                        .fold(0.0, f64::max),
                )
            })
            .collect();
        ranked.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut out = "<h3>Assumptions by their effect, and what each verdict owes to them</h3>\n"
            .to_string();
        if self.known.is_empty() {
            out.push_str(&paragraph(
                "Nothing is drawn or assumed that could be tried at a low and a high value.",
            ));
        } else if self.owed.is_empty() {
            out.push_str(&paragraph(
                "Not computed yet: every member has to run first.",
            ));
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
                    own.ends
                        .map(|end| plain(&amount(end, &own.unit)).replace(' ', "\u{a0}"))
                        .join(" / "),
                    format!("{kind}{}", plain(&own.origin)),
                    format!("{}\u{a0}%", short(100.0 * effect)),
                ]
            });
            let head = [
                "input",
                "as given",
                "low / high",
                "origin",
                "largest effect on a requirement",
            ];
            out.push_str(&rows(&head, &body.collect::<Vec<_>>()));
            out.push_str(&self.owed_table(&ranked));
        }
        let tried = |path: &str| self.known.iter().any(|own| own.path == path);
        let assumed = self.study.assumed();
        let rest: Vec<_> = assumed.iter().filter(|(path, ..)| !tried(path)).collect();
        if !rest.is_empty() {
            let named = rest.iter().take(MOST_ASSUMED);
            let body = named.map(|(path, value, why)| {
                vec![
                    format!("<code>{}</code>", plain(path)),
                    plain(value),
                    plain(why),
                ]
            });
            let body: Vec<Vec<String>> = body.collect();
            out.push_str(&format!(
                "<h3>Assumed, and their effect not tried: {}</h3>\n",
                rest.len()
            ));
            out.push_str(&format!(
                "<div class=\"fine\">{}</div>",
                rows(&["input", "value", "why"], &body)
            ));
        }
        out
    }

    /// The worst value of each requirement with each input at its low and at its high value.
    fn owed_table(&self, ranked: &[(usize, f64)]) -> String {
        let limits = &self.study.file.limits;
        let unit = |limit: usize| {
            let judged = self.answer.ranking.iter().flat_map(|one| &one.limits);
            judged
                .clone()
                .find(|judged| judged.limit == limits[limit])
                .map_or("", |judged| judged.unit)
        };
        let body = self.owed.iter().map(|owed| {
            let limit = &limits[owed.limit];
            let value = |value: Option<f64>| match value {
                None => "failed".to_string(),
                Some(value) => {
                    let text = plain(&amount(value, unit(owed.limit))).replace(' ', "\u{a0}");
                    match limit.side.holds(value, limit.bound) {
                        true => text,
                        false => format!("<b class=\"failed\">{text}</b>"),
                    }
                }
            };
            let mut row = vec![
                format!("R{} (run {})", owed.limit + 1, owed.member),
                value(owed.value),
            ];
            row.extend(
                ranked
                    .iter()
                    .map(|(input, _)| owed.ends[*input].map(value).join(" / ")),
            );
            row
        });
        let mut head = vec!["worst run".to_string(), "as drawn".to_string()];
        let inputs = ranked.iter().map(|(input, _)| &self.known[*input].path);
        head.extend(inputs.map(|path| path.replace(['_', '.'], " ")));
        let head: Vec<&str> = head.iter().map(String::as_str).collect();
        format!(
            "{}{}",
            rows(&head, &body.collect::<Vec<_>>()),
            note(
                "The run nearest to a requirement, or the farthest beyond it, again with one input at its low / high value and all others as it drew them; what breaks the bound is \
                 red. Of what is drawn these are the values that 5 % of the draws fall below and exceed, of what is merely assumed half and double."
            )
        )
    }

    /// Drops in a row: what wear leaves, and what requirements say of each.
    pub(super) fn in_a_row(&self) -> String {
        if self.rows.is_empty() {
            return paragraph(
                "No case asks for drops in a row (<code>[[case]] drops = 10</code>): every run begins as new.",
            );
        }
        let mut out = String::new();
        for (k, row) in self.rows.iter().enumerate() {
            let places: Vec<Option<usize>> = (0..row.drops)
                .map(|drop| {
                    self.drops
                        .members
                        .binary_search(&Study::drop_of_row(k, drop))
                        .ok()
                })
                .collect();
            let done = places.iter().flatten().count();
            let case = row
                .values
                .iter()
                .find(|(path, _)| path == scenario::CASE)
                .map(|(_, name)| name);
            let limits = self.study.file.limits.iter();
            let limits: Vec<_> = limits
                .filter(|limit| limit.case.is_none() || limit.case.as_ref() == case)
                .collect();
            let names = self
                .study
                .known
                .iter()
                .filter(|own| own.words_in("added_up").is_some());
            let sums = names.map(|own| {
                let values = self.drops.values(&own.name);
                let own_values: Vec<Option<f64>> =
                    places.iter().map(|place| values[(*place)?]).collect();
                (own, own_values)
            });
            let number =
                |value: Option<f64>, unit: &str| plain(&known(value, unit)).replace(' ', "\u{a0}");
            let mut body: Vec<Vec<String>> = limits
                .iter()
                .map(|limit| {
                    let unit = self
                        .study
                        .known
                        .iter()
                        .find(|own| own.name == limit.quantity)
                        .map_or("", |own| own.unit);
                    let values = self.study.limited(self.drops, limit);
                    let of = |place: &Option<usize>| place.and_then(|place| values[place]);
                    let all: Vec<Option<f64>> = places.iter().map(of).collect();
                    let broken = all
                        .iter()
                        .flatten()
                        .filter(|value| !limit.side.holds(**value, limit.bound))
                        .count();
                    let known = all.iter().flatten().count();
                    let verdict = match (broken, known == row.drops) {
                        (0, true) => Verdict::Pass,
                        (0, false) => Verdict::Undecided,
                        _ => Verdict::Fail,
                    };
                    let end = |value: Option<&Option<f64>>| number(value.copied().flatten(), unit);
                    vec![
                        self.requirement_words(limit, None),
                        end(all.first()),
                        end(all.last()),
                        format!("{} ({broken} of {known} beyond)", marked(verdict)),
                    ]
                })
                .collect();
            body.extend(sums.map(|(own, values)| {
                let first = number(values.first().copied().flatten(), own.unit);
                let last = number(values.last().copied().flatten(), own.unit);
                let sum = values.iter().copied().sum::<Option<f64>>();
                vec![
                    words(&own.name),
                    first,
                    last,
                    format!("sum {}", number(sum, own.unit)),
                ]
            }));
            out.push_str(&format!(
                "<h3>{}: {done} of {} drops</h3>\n",
                of_values(&row.values),
                row.drops
            ));
            out.push_str(&rows(&["result", "drop 1", "last drop", "of all"], &body));
        }
        out.push_str(&note(
            "Drop 1 is the run nearest to a requirement. Each later one has the radial clearance widened by the wear of those before (where <code>contact.surface.wear_coefficient</code> is given), \
             the grease as they left it, and another angle of the unbalance. Dents do not change later motion in this model.",
        ));
        out
    }

    /// Each case at each level with its verdict.
    pub(super) fn verdicts(&self) -> String {
        let all = &self.answer.ranking;
        let body = all.iter().map(|one| {
            let broken: Vec<String> = (one.broken())
                .map(|judged| {
                    format!(
                        "{} {}",
                        marked(judged.verdict),
                        self.requirement_words(&judged.limit, Some(judged))
                    )
                })
                .collect();
            let mut why = broken.join("<br>");
            for text in one
                .open
                .iter()
                .chain(one.why.iter().filter(|_| one.draws[1] > 0))
            {
                why.push_str(&format!("<br>{}", plain(text)));
            }
            let nearest = one.limits.iter().zip(&one.worst);
            let nearest =
                nearest.filter_map(|(judged, worst)| Some((judged.margin()?, judged, (*worst)?)));
            let nearest = nearest.min_by(|a, b| a.0.total_cmp(&b.0));
            vec![
                of_values(&one.values),
                marked(one.verdict),
                one.draws[0].to_string(),
                nearest.map_or("–".to_string(), |(margin, judged, member)| {
                    format!(
                        "{}: {}\u{a0}% (run {member})",
                        words(&judged.limit.quantity),
                        short(100.0 * margin)
                    )
                }),
                why.trim_start_matches("<br>").to_string(),
            ]
        });
        let body: Vec<Vec<String>> = body.collect();
        let draws = all.iter().map(|one| one.draws[0]).min().unwrap_or(0).max(1);
        let rare = short(100.0 * (1.0 - 0.05f64.powf(1.0 / draws as f64)));
        format!(
            "{}{}<h3>Drops in a row</h3>\n{}",
            rows(
                &[
                    "case",
                    "verdict",
                    "runs",
                    "nearest limit and its margin",
                    "not held, or not decided"
                ],
                &body
            ),
            note(&format!(
                "That {draws} draws hold a limit leaves room for up to {rare} % that do not (95 % confidence). A run is shown in full by <code>auxbear study FILE --member N</code>."
            )),
            self.in_a_row()
        )
    }
}

/// Whether a limit is of a result, whichever bearing or node has it.
fn same_result(limit: &str, name: &str) -> bool {
    limit.rsplit('.').next() == name.rsplit('.').next()
}
