//! What the book says of a code.

use super::{Code, Problem, Result, did_you_mean};

/// The book's page of codes: the one text of their meaning and remedy.
const PAGE: &str = include_str!("codes.md");

/// The section of a code, such as `AB1007`, as plain text; letters in any case.
pub fn explain(code: &str) -> Result<String> {
    let wanted = code.trim().to_uppercase();
    let known = || sections().map(|(code, _)| code);
    let Some((code, section)) = sections().find(|(code, _)| *code == wanted) else {
        let found = format!("\"{code}\"");
        let needed = "a code is needed as messages print it, e.g. AB1007";
        let problem = Problem::new(Code::UnknownWord, "auxbear explain", found, needed);
        return Err(problem.with_hint(did_you_mean(&wanted, known())));
    };
    Ok(format!(
        "{code}\n\n{}\n",
        plain(section.trim_matches(['-', '\n']))
    ))
}

/// The title of a code, which its section begins with in bold; empty for a code without a section.
pub fn title(code: &str) -> &'static str {
    let section = sections().find(|(known, _)| *known == code);
    let bold = section.and_then(|(_, text)| text.split("**").nth(1));
    bold.unwrap_or("").trim_end_matches('.')
}

/// Every code of the page with its section.
fn sections() -> impl Iterator<Item = (&'static str, &'static str)> {
    let parts = PAGE.split("\n## ").skip(1);
    parts.filter_map(|part| part.split_once('\n'))
}

/// Markdown as people read it on a terminal: links without their targets, no marks of emphasis, examples moved in.
fn plain(section: &str) -> String {
    let mut lines = Vec::new();
    let mut example = false;
    for line in section.lines() {
        if line.starts_with("```") {
            example = !example;
            continue;
        }
        lines.push(match example {
            true => format!("    {line}"),
            false => without_links(line).replace("**", ""),
        });
    }
    lines.join("\n")
}

fn without_links(line: &str) -> String {
    let mut out = String::new();
    let mut rest = line;
    while let Some((before, after)) = rest.split_once("](") {
        let (Some((text, label)), Some((_, behind))) =
            (before.rsplit_once('['), after.split_once(')'))
        else {
            break;
        };
        out.push_str(text);
        out.push_str(label);
        rest = behind;
    }
    out + rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_code_of_a_problem_is_explained_and_the_section_ends_where_the_next_begins() {
        for code in Code::ALL {
            let text = explain(code.text()).unwrap();
            let title = format!("{code}\n\n{}.", title(code.text()));
            assert!(text.starts_with(&title) && title.len() > 12, "{text}");
            assert!(!text.contains("## ") && !text.contains("```") && !text.contains("]("));
        }
    }

    #[test]
    fn a_code_is_found_in_any_case_and_a_near_one_is_named() {
        assert_eq!(explain("ab1007"), explain(" AB1007 "));
        let told = explain("AB10007").unwrap_err().to_string();
        assert!(
            told.contains("Did you mean") && told.contains("\"AB1007\""),
            "{told}"
        );
    }

    #[test]
    fn a_link_leaves_its_text() {
        let line = "See [Units](a.md), **then** [limits](b.md#c) and [x].";
        assert_eq!(without_links(line), "See Units, **then** limits and [x].");
    }
}
