//! The ranking of a selection, and the cases of a qualification: as a table of the page, and as lines of a terminal.

use super::cells::{amount, bound, known, marked, percent, rows, short, table};
use crate::page::escape_text as plain;
use outcome::{Judged, Verdict};
use problem::explain;
use run::study::Study;
use run::study::answer::Answer;
use run::study::selection::Candidate;
use scenario::Forbidden;

/// Share of the repetitions below which the first place is not settled.
const SETTLED: f64 = 0.9;

/// The cases of a qualification with their verdicts; nothing of other designs.
pub(super) fn cases(study: &Study, answer: &Answer) -> String {
    if study.file.rank.is_some() || answer.ranking.is_empty() {
        return String::new();
    }
    format!(
        "<h2>Cases</h2>\n<p>{}</p>\n{}<p class=\"small\">Every case meets the same draws. A run is shown in full by <code>auxbear study FILE --member N</code>; \
         <code>auxbear qualify FILE</code> writes the document.</p>\n",
        plain(&verdict(study, answer)),
        of_each(answer),
    )
}

/// Each case at each level: verdict, the limit that is nearest, and what is not held or not decided, with the run farthest beyond.
pub(super) fn of_each(answer: &Answer) -> String {
    let row = |one: &Candidate| {
        let limits = one.limits.iter().zip(&one.worst);
        let broken = limits.filter(|(judged, _)| judged.verdict != Verdict::Pass);
        let broken = broken.map(|(judged, worst)| {
            let run = worst.map_or(String::new(), |member| format!(" (run {member})"));
            format!(
                "{} {}{run}: {}",
                marked(judged.verdict),
                requirement(judged),
                plain(&judged.why)
            )
        });
        let failed = one.why.iter().filter(|_| one.draws[1] > 0);
        let failed = failed.map(|why| {
            format!(
                "{} of {} draws failed: {}",
                one.draws[1],
                one.draws[0],
                plain(why)
            )
        });
        let told: Vec<String> = broken
            .chain(failed)
            .chain(one.open.iter().map(|why| plain(why)))
            .collect();
        let nearest = one
            .nearest()
            .map_or("–".to_string(), |(judged, margin, member)| {
                format!(
                    "{}: {} (run {member})",
                    words(&judged.limit.quantity),
                    percent(margin)
                )
            });
        vec![
            of_values(&one.values),
            marked(one.verdict),
            one.draws[0].to_string(),
            nearest,
            told.join("<br>"),
        ]
    };
    table(
        &[
            "case",
            "verdict",
            "runs",
            "nearest limit and its margin",
            "not held, or not decided",
        ],
        answer.ranking.iter().map(row),
    )
}

/// A limit in words.
pub(super) fn requirement(judged: &Judged) -> String {
    let limit = &judged.limit;
    let case = limit
        .case
        .as_ref()
        .map_or(String::new(), |case| format!(", {} alone", plain(case)));
    let share = match limit.share {
        1.0 => String::new(),
        share => format!(" in {}", percent(share)),
    };
    match &limit.forbids {
        Some(Forbidden::Code(code)) => format!(
            "no warning <code>{code}</code> ({}){share}{case}",
            plain(explain::title(code))
        ),
        Some(Forbidden::Severity(severity)) => format!(
            "no warning that is {} or worse{share}{case}",
            severity.word()
        ),
        None => format!(
            "{}: {}{share}{case}",
            words(&limit.quantity),
            plain(&bound(judged)).replace(' ', "\u{a0}")
        ),
    }
}

/// Words of a case with its levels.
pub(super) fn of_values(values: &[(String, String)]) -> String {
    let texts: Vec<&str> = values.iter().map(|(_, value)| value.as_str()).collect();
    plain(&texts.join(", "))
}

/// Words of a result.
pub(super) fn words(name: &str) -> String {
    plain(&name.replace(['_', '.'], " "))
}

/// Which cases hold every limit.
fn of_cases(answer: &Answer) -> String {
    let count = |verdict| {
        answer
            .ranking
            .iter()
            .filter(|one| one.verdict == verdict)
            .count()
    };
    let [pass, fail, open] = [Verdict::Pass, Verdict::Fail, Verdict::Undecided].map(count);
    let all = answer.ranking.len();
    let draws = answer
        .ranking
        .iter()
        .map(|one| one.draws[0])
        .min()
        .unwrap_or(0);
    let rare = 100.0 * (1.0 - 0.05f64.powf(1.0 / draws.max(1) as f64));
    let draws = format!(
        "That {draws} draws hold a limit leaves room for up to {} % that do not (95 % confidence).",
        short(rare)
    );
    match (fail, open) {
        (0, 0) => format!("All of {all} cases hold every limit in every draw. {draws}"),
        _ => format!(
            "{fail} of {all} cases break a limit, {open} are undecided, {pass} hold every limit. {draws}"
        ),
    }
}

/// The ranking; nothing of other designs.
pub(super) fn html(study: &Study, answer: &Answer) -> String {
    let (Some((name, most, _)), false) = (&study.file.rank, answer.ranking.is_empty()) else {
        return String::new();
    };
    let unit =
        (study.known.iter().find(|known| known.name == *name)).map_or("", |known| known.unit);
    // a number stays with its unit
    let whole = |text: String| text.replace(' ', "\u{a0}");
    let number = |value: Option<f64>| whole(known(value, unit));
    let row = |(place, one): (usize, &Candidate)| {
        let mut cells = vec![(place + 1).to_string(), marked(one.verdict)];
        cells.extend(one.values.iter().map(|(_, value)| plain(value)));
        cells.extend([
            number(one.quantile),
            number(one.mean),
            match one.verdict {
                Verdict::Pass => whole(format!("{} %", short(100.0 * one.first))),
                _ => "–".to_string(),
            },
            plain(&reason(one)),
            one.member.to_string(),
        ]);
        cells
    };
    let words = name.replace(['_', '.'], " ");
    let direction = if *most { "below" } else { "above" };
    let mut head = vec!["place".to_string(), "verdict".to_string()];
    let paths = answer.ranking[0].values.iter();
    head.extend(paths.map(|(path, _)| path.clone()));
    head.extend([
        format!("{words}: not {direction}, in 95 %"),
        "mean".to_string(),
        "first in".to_string(),
        "why not".to_string(),
        "first member".to_string(),
    ]);
    let head: Vec<&str> = head.iter().map(String::as_str).collect();
    let body: Vec<Vec<String>> = answer.ranking.iter().enumerate().map(row).collect();
    format!(
        "<h2>Ranking</h2>\n<p>{}</p>\n{}<p class=\"small\">Every candidate meets the same draws. “First in”: how often it comes first of those that hold all limits when \
         the draws are drawn with repetition. A member runs again with its full report by <code>auxbear study FILE --member N</code>.</p>\n",
        plain(&verdict(study, answer)),
        rows(&head, &body)
    )
}

/// Why a candidate does not hold its limits.
fn reason(one: &Candidate) -> String {
    let broken = one.broken().map(|judged| {
        let value = judged.value.map(|value| amount(value, judged.unit));
        let worst = value.unwrap_or_else(|| "no value".to_string());
        let name = judged.limit.quantity.replace(['_', '.'], " ");
        let (bound, hold, all) = (bound(judged), judged.hold, judged.members);
        format!("{name} {worst}, {bound}: {hold} of {all} hold it")
    });
    let mut parts: Vec<String> = broken.collect();
    if let (count @ 1.., Some(why)) = (one.draws[1], &one.why) {
        parts.push(format!("{count} of {} failed: {why}", one.draws[0]));
    }
    parts.join("; ")
}

/// Which one to take, and how sure that is.
pub fn verdict(study: &Study, answer: &Answer) -> String {
    if study.file.rank.is_none() {
        return of_cases(answer);
    }
    let passes = |one: &&Candidate| one.verdict == Verdict::Pass;
    let passing = answer.ranking.iter().filter(passes).count();
    let all = answer.ranking.len();
    let Some(best) = answer.ranking.first().filter(passes) else {
        return format!("None of {all} candidates holds every limit in every draw.");
    };
    let unit = (study.file.rank.as_ref())
        .and_then(|(name, ..)| study.known.iter().find(|known| known.name == *name))
        .map_or("", |known| known.unit);
    let value = best.quantile.map(|value| amount(value, unit));
    let value = value.unwrap_or_else(|| "no value".to_string());
    let often = format!(
        "first in {} % of the repetitions of the draws",
        short(100.0 * best.first)
    );
    let sure = match best.first >= SETTLED {
        true => often,
        false => format!(
            "but the first place is not settled: it is {often}; more draws, or another seed, may change it"
        ),
    };
    let values = best.values.iter().map(|(_, value)| value.as_str());
    let values: Vec<&str> = values.collect();
    let (draws, failed) = (best.draws[0], best.draws[1]);
    let rare = 100.0 * (1.0 - 0.05f64.powf(1.0 / draws.max(1) as f64));
    format!(
        "{passing} of {all} candidates hold every limit in all of their {} draws. Best: {} ({value}), {sure}. That {draws} draws hold a limit leaves room for up to {} % that do not (95 % confidence).",
        draws - failed,
        values.join(", "),
        short(rare)
    )
}
