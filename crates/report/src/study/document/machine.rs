//! What the machine is: architecture, rotordynamics, environment, and the events that let its rotor touch.

use super::{Document, note, paragraph, words};
use crate::page::escape_text as plain;
use crate::study::cells::{amount, cell, rows};
use outcome::{Severity, Value, Verdict, limits};
use problem::explain;
use scenario::Limit;

/// Warnings of the linear analysis that whirl is possible.
const WHIRL: [&str; 2] = ["AB2044", "AB2047"];
/// A run at a level is one at a critical speed that differs by this share at most.
const AT_LEVEL: f64 = 0.02;

/// What a table of the bearings says of each, by the paths of the keys.
const OF_BEARINGS: [(&str, &str); 9] = [
    ("bearing", "bearing.name"),
    ("model", "bearing.fidelity"),
    ("type", "bearing.type"),
    ("bore", "contact.bore_diameter"),
    ("radial air clearance", "contact.radial_air_clearance"),
    ("friction of the landing", "contact.friction_coefficient"),
    ("mount stiffness", "mount.stiffness"),
    ("mount damping", "mount.damping"),
    ("stands on", "mount.on"),
];

impl Document<'_> {
    pub(super) fn architecture(&self) -> String {
        let resolved = &self.study.file.scenario.resolved;
        let mut names: Vec<String> = Vec::new();
        for value in &resolved.values {
            names.extend(
                value
                    .bearing
                    .iter()
                    .filter(|name| !names.contains(name))
                    .cloned()
                    .collect::<Vec<_>>(),
            );
        }
        if names.is_empty() {
            names.push(String::new());
        }
        let cell = |name: &String, path: &str| {
            let value = resolved.of_bearing(name, path);
            let text = value.and_then(|value| value.text.clone());
            let mark =
                value.filter(|value| value.provenance.mark() == "assumed" && value.text.is_some());
            let mark = mark.map_or("", |_| " <span class=\"assumed\">assumed</span>");
            format!(
                "{}{mark}",
                text.map_or("–".to_string(), |text| plain(&text))
            )
        };
        let mut head = vec![""];
        head.extend(names.iter().map(String::as_str));
        let body = OF_BEARINGS.iter().map(|(words, path)| {
            let mut row = vec![words.to_string()];
            row.extend(names.iter().map(|name| cell(name, path)));
            row
        });
        let drawing = match self.rotor {
            Some(_) => {
                "<figure><div class=\"rotor-drawing\"></div><figcaption><span>The rotor to scale, with what it carries and what stands around it.</span></figcaption></figure>\n"
            }
            None => "",
        };
        format!("{drawing}{}", rows(&head, &body.collect::<Vec<_>>()))
    }

    /// The rotor on its magnets and on its auxiliary bearings: the results that are looked at first, and what warns.
    pub(super) fn rotordynamics(&self) -> String {
        let Some((rotor, _)) = self.rotor else {
            return paragraph(
                "<b class=\"open\">Not shown</b>: the rotor is rigid in this model, or its analysis failed.",
            );
        };
        let first = rotor.quantities.iter().filter(|own| own.headline);
        let first = first.filter(|own| !own.name.contains("response."));
        let cells = first.filter_map(|own| match &own.value {
            Value::Number(value) => Some(vec![
                words(&own.name),
                plain(&amount(*value, own.unit)).replace(' ', "\u{a0}"),
            ]),
            Value::Text(text) => Some(vec![words(&own.name), plain(text)]),
            _ => None,
        });
        let cells: Vec<Vec<String>> = cells.collect();
        // two results a line
        let half = cells.len().div_ceil(2);
        let blank = vec![String::new(), String::new()];
        let body: Vec<Vec<String>> = (0..half)
            .map(|k| {
                [
                    cells[k].clone(),
                    cells.get(k + half).unwrap_or(&blank).clone(),
                ]
                .concat()
            })
            .collect();
        let severe = rotor
            .warnings
            .iter()
            .filter(|own| own.severity <= Severity::Uncertain);
        let list: String = severe
            .map(|own| {
                format!(
                    "<li><code>{}</code> {}</li>\n",
                    own.code,
                    plain(&own.to_string())
                )
            })
            .collect();
        let list = if list.is_empty() {
            list
        } else {
            format!("<ul class=\"small\">\n{list}</ul>\n")
        };
        format!(
            "{}{}{list}",
            rows(&["result", "", "result", ""], &body),
            note(
                "Zones of levitated vibration after ISO 14839-3, limits from memory. \"On auxiliary bearings\": the rotor that rolls on them through its whole coast-down. \
                 Responses, modes and diagrams stand in the page of <code>auxbear rotor</code> of the same file."
            )
        )
    }

    pub(super) fn environment(&self) -> String {
        match &self.study.file.document.environment {
            Some(text) => paragraph(&plain(text)),
            None => paragraph(
                "<b class=\"open\">Not given</b>: gas or vacuum, temperature, lubricant and dirt about the bearings decide friction, heat and wear.",
            ),
        }
    }

    /// Critical speeds of the rotor, levitated or on its auxiliary bearings, within the range of the speeds that were run but at none of them.
    pub(super) fn critical_between_levels(&self) -> Option<String> {
        let (rotor, _) = self.rotor?;
        let levels = self.speeds();
        let is_speed = |name: &str| name.contains("critical_") && name.ends_with(".speed");
        let between = rotor.quantities.iter().filter_map(|own| {
            let Value::Number(speed) = own.value else {
                return None;
            };
            (is_speed(&own.name) && is_between(speed, &levels))
                .then(|| format!("{} ({})", cell(Some(speed), own.unit), words(&own.name)))
        });
        let list: Vec<String> = between.collect();
        (!list.is_empty()).then(|| {
            format!(
                "No run is at a critical speed between the levels of rotor.speed: {}. A level there shows what it does.",
                list.join(", ")
            )
        })
    }

    /// Sizes of the levels of the rotor's speed, rad/s; none where it is no level.
    fn speeds(&self) -> Vec<f64> {
        let candidates = self.answer.ranking.iter().flat_map(|one| &one.values);
        let texts = candidates.filter(|(path, _)| path == "rotor.speed");
        let speeds = texts.filter_map(|(_, text)| units::parse_quantity(text).ok());
        speeds.map(|own| own.value_si.abs()).collect()
    }

    /// What the linear analysis warns of dry whirl, where a requirement of whirl is met.
    pub(super) fn whirl_by_analysis(&self) -> Option<String> {
        let (rotor, _) = self.rotor?;
        let declared: Vec<_> = run::warnings::declared().collect();
        let seeks = |limit: &Limit| limits::seeks_whirl(limit, &self.study.known, &declared);
        let requirements = self.requirements();
        let mut met = requirements
            .iter()
            .filter(|own| own.verdict == Verdict::Pass);
        if !met.any(|own| seeks(own.limit)) {
            return None;
        }
        let mut warned = rotor.warnings.iter();
        let warned = warned.find(|own| WHIRL.contains(&own.code))?;
        let forces = rotor.quantities.iter();
        let forces = forces.filter(|own| own.words_in("whirl") == Some("contact force there"));
        let forces = forces.filter_map(|own| rotor.number(&own.name));
        let force = forces.reduce(f64::max).map_or(String::new(), |force| {
            let beyond = requirements.iter().enumerate().filter(|(_, own)| {
                own.verdict == Verdict::Pass
                    && own.limit.quantity.ends_with("contact_force")
                    && !own.limit.side.holds(force, own.limit.bound)
            });
            let beyond: Vec<String> = beyond.map(|(k, _)| format!("R{}", k + 1)).collect();
            let beyond = match beyond.is_empty() {
                true => String::new(),
                false => format!(", beyond {}", beyond.join(", ")),
            };
            format!(
                "; where it comes it settles at {}{beyond}",
                cell(Some(force), "N")
            )
        });
        Some(format!(
            "No whirl in these runs, and by the linear analysis it is possible: <code>{}</code> {}{force} (section 3)",
            warned.code,
            plain(explain::title(warned.code))
        ))
    }

    /// That no level is as fast as the machine of the file.
    pub(super) fn slower_than_given(&self) -> Option<String> {
        let given = self.study.file.scenario.resolved.get("rotor.speed")?;
        let given = given.value_si?.abs();
        let fastest = self.speeds().into_iter().reduce(f64::max)?;
        (fastest < given * (1.0 - 1e-9)).then(|| {
            format!(
                "No run is as fast as the machine of the file: {} at most, of {}",
                cell(Some(fastest), "rad/s"),
                cell(Some(given), "rad/s")
            )
        })
    }

    /// What follows the end of the runs, where the rotor still turns then.
    pub(super) fn ends_turning(&self) -> String {
        let spun = self
            .results_of("final speed")
            .flat_map(|own| self.values_of(own));
        let fastest = spun.map(f64::abs).fold(0.0, f64::max);
        let coasts = (self.study.file.scenario.drop()).is_some_and(|own| own.coast_down.is_some());
        if fastest <= 0.0 || coasts {
            return String::new();
        }
        let critical = self.critical_below(fastest);
        let passed = match critical.is_empty() {
            true => String::new(),
            false => format!(
                " It would pass {} on its auxiliary bearings.",
                critical.join(", ")
            ),
        };
        paragraph(&format!(
            "<b class=\"open\">The coast-down is in none of these runs</b>: they end with the rotor at up to {}. Whirl, heat, wear and life until the standstill are not shown, whatever a sum so far holds.{passed}",
            cell(Some(fastest), "rad/s")
        ))
    }

    /// Cases that no requirement judges.
    pub(super) fn without_limit(&self) -> String {
        let limits = &self.study.file.limits;
        if limits.iter().any(|limit| limit.case.is_none()) {
            return String::new();
        }
        let judged = |case: &String| limits.iter().any(|limit| limit.case.as_ref() == Some(case));
        let mut cases = self.cases();
        let all = cases.len();
        cases.retain(|case| !judged(case));
        match cases.len() {
            0 => String::new(),
            count => paragraph(&format!(
                "<b class=\"open\">No requirement judges {count} of {all} cases: {}.</b>",
                plain(&cases.join(", "))
            )),
        }
    }

    /// Critical speeds of the rotor on its auxiliary bearings below a speed, rad/s, in words.
    pub(super) fn critical_below(&self, speed: f64) -> Vec<String> {
        let quantities = self
            .rotor
            .into_iter()
            .flat_map(|(rotor, _)| &rotor.quantities);
        let of = |own: &outcome::Quantity| {
            let Value::Number(critical) = own.value else {
                return None;
            };
            let name = own.name.strip_prefix("on_auxiliary_bearings.critical_")?;
            (name.ends_with(".speed") && critical < speed).then(|| cell(Some(critical), own.unit))
        };
        quantities.filter_map(of).collect()
    }

    /// Each case with what happens in it, and how often it is expected.
    pub(super) fn events(&self) -> String {
        let toml = self.study.file.scenario.resolved.toml();
        let happens = tables_of(&toml);
        let document = &self.study.file.document;
        let none = || "<b class=\"open\">not given</b>".to_string();
        let body = self.cases().into_iter().map(|case| {
            let own = happens
                .iter()
                .filter(|(of, _)| of.as_ref().is_none_or(|of| *of == case));
            let texts: Vec<&str> = own.map(|(_, text)| text.as_str()).collect();
            let said = document.case(&case);
            let expected = said.and_then(|said| said.expected.as_ref());
            vec![
                plain(&case),
                plain(&texts.join("; ")),
                expected.map_or_else(none, |text| plain(text)),
                said.map_or(1, |said| said.drops).to_string(),
            ]
        });
        let body: Vec<Vec<String>> = body.collect();
        let head = [
            "case",
            "what happens",
            "how often it is expected",
            "drops in a row",
        ];
        let levels = self
            .study
            .file
            .inputs
            .iter()
            .filter(|input| input.levels > 0 && input.vary.path != scenario::CASE);
        let levels: Vec<String> = levels
            .map(|input| {
                format!(
                    "<code>{}</code> {}",
                    plain(&input.vary.path),
                    plain(&input.written)
                )
            })
            .collect();
        let levels = match levels.is_empty() {
            true => String::new(),
            false => format!(" at each level of {}", levels.join(", ")),
        };
        let between = self.critical_between_levels();
        let between = between.map_or(String::new(), |text| {
            paragraph(&format!("<b class=\"open\">{text}</b>"))
        });
        format!(
            "{}{between}{}",
            rows(&head, &body),
            paragraph(&format!(
                "Each case runs{levels}, with {} draws of what is not certain; all cases meet the same draws. Other faults, and speeds between the levels, are not shown.",
                self.study.draws()
            ))
        )
    }
}

/// Whether a speed lies between levels, at none of them.
fn is_between(speed: f64, levels: &[f64]) -> bool {
    let near = |level: &f64| (speed - level).abs() <= AT_LEVEL * speed;
    let any = |side: fn(f64, f64) -> bool| levels.iter().any(|level| side(*level, speed));
    any(|level, speed| level < speed)
        && any(|level, speed| level > speed)
        && !levels.iter().any(near)
}

/// Events and the motion of the base as a resolved file has them: the case that each is of, and its keys in a line.
fn tables_of(toml: &str) -> Vec<(Option<String>, String)> {
    let heads = ["[[event]]", "[base]"];
    let mut found: Vec<(Option<String>, String)> = Vec::new();
    let mut inside = false;
    for line in toml.lines() {
        if line.starts_with('[') {
            inside = heads.contains(&line);
            if inside {
                found.push((None, String::new()));
            }
            continue;
        }
        let (Some(last), true) = (found.last_mut(), inside && !line.starts_with('#')) else {
            continue;
        };
        let Some((key, value)) = line.split_once(" = ") else {
            continue;
        };
        // a value with its origin is a table
        let value = value.trim_start_matches("{ value = ");
        let value = value.split(", source =").next().unwrap_or(value);
        if value.contains("from = \"default\"") {
            continue;
        }
        let value = value
            .split(", assumed =")
            .next()
            .unwrap_or(value)
            .trim_matches('"');
        match key {
            "case" => last.0 = Some(value.to_string()),
            "name" => {}
            _ => {
                let comma = if last.1.is_empty() { "" } else { ", " };
                last.1
                    .push_str(&format!("{comma}{} {value}", key.replace('_', " ")));
            }
        }
    }
    found.retain(|(_, text)| !text.is_empty());
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_critical_speed_between_levels_is_at_none_of_them() {
        let levels = [1000.0, 2000.0, 3000.0];
        let found =
            [900.0, 1500.0, 1985.0, 2500.0, 3000.0, 3100.0].map(|own| is_between(own, &levels));
        assert_eq!(found, [false, true, false, true, false, false]);
        assert!(!is_between(1000.0, &[]) && !is_between(1500.0, &[1000.0]));
    }

    #[test]
    fn events_of_a_resolved_file_are_told_with_their_cases() {
        let text = "[[event]]\nname = \"a\"\ncase = \"one\"\ndo = \"power lost\"\nat = { value = \"50 ms\", source = \"plan\" }\n\n[run]\nduration = \"1 s\"\n\n[[event]]\ndo = \"brake\"\nat = \"1 s\"\n";
        let found = tables_of(text);
        assert_eq!(
            found[0],
            (
                Some("one".to_string()),
                "do power lost, at 50 ms".to_string()
            )
        );
        assert_eq!(found[1], (None, "do brake, at 1 s".to_string()));
        assert_eq!(found.len(), 2);
    }
}
