//! `auxbear study`.

use crate::arguments::{Study as Wish, stem};
use crate::digits::readable;
use crate::exit::Exit;
use crate::limits::bound;
use crate::{console, run};
use auxbear::problem::key::article;
use auxbear::problem::{Code, Problem, Result};
use auxbear::report::directory::free_path;
use auxbear::report::study::{Directory, Done, chosen, estimate_note, estimate_rows};
use auxbear::run::Options;
use auxbear::run::outcome::{Severity, Verdict};
use auxbear::scenario::StudyFile;
use auxbear::study::Study;
use auxbear::study::answer::{Answer, Sensitivity};
use auxbear::study::selection::Candidate;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Time between lines of progress.
pub const PAUSE: Duration = Duration::from_secs(2);

/// Begins a study or goes on with it, or runs one of its members with its full report.
pub fn perform(wish: &Wish) -> Result<Exit> {
    let threads = wish.threads.as_deref().map(run::threads).transpose()?;
    let file = StudyFile::read(&wish.file)?;
    let name = stem(&wish.file);
    let add = wish.add.as_deref().map(|text| whole(text, "--add"));
    let add = add.transpose()?;
    if let Some(text) = &wish.member {
        let file = match add {
            Some(more) => file.extended(more)?,
            None => file,
        };
        let study = Study::new(file)?;
        let k = whole(text, "--member")?;
        if k >= study.members() {
            let found = format!("member {k} of a study of {} members", study.members());
            let allowed = format!("a number from 0 to {} is needed", study.members() - 1);
            let problem = Problem::at_path(Code::OutOfRange, &wish.file, found, allowed);
            return Err(problem.on_key("--member"));
        }
        let scenario = study.scenario(k)?;
        let own = || free_path(&format!("{name}-member-{k}"));
        let path = wish.out.clone().unwrap_or_else(own);
        return run::execute(&scenario, &path, threads, wish.quiet);
    }
    let own = || Path::new("runs").join(&name);
    let path = wish.out.clone().unwrap_or_else(own);
    let study = Study::new(file)?;
    run::listen(true);
    let directory = Directory::open(&path, study, add.unwrap_or(0))?;
    let pace = Pace::new(&directory, wish.quiet);
    let options = Options {
        threads: threads.map(usize::from),
        interrupt: &run::INTERRUPT,
        progress: &|_| {},
        controllers: run::controllers(),
        rows: None,
    };
    let done = directory.run(&options, &|members| pace.show(members))?;
    if !wish.quiet {
        console::print(&text(&path, &directory.study, &done))?;
    }
    warn(&done);
    match done.complete {
        // no member has results
        true if done.failed == done.answer.members => Ok(Exit::Failed),
        true => Ok(Exit::Done),
        false => {
            let members = done.answer.members;
            console::report(&format!(
                "interrupted: {members} of {} members are kept; the same command goes on",
                done.answer.asked
            ));
            Ok(Exit::Interrupted)
        }
    }
}

/// What the members warn of, and how many failed.
pub fn warn(done: &Done) {
    let warned = done.warned.iter();
    for warned in warned.filter(|warned| warned.severity() < Severity::Note) {
        let share = warned.share(done.answer.members);
        let (code, title) = (&warned.code, &warned.title);
        console::report(&format!("warning[{code}]: {title}: {share}"));
    }
    if done.failed > 0 {
        let failed = done.failed;
        let why = done.answer.ranking.iter().find_map(|one| one.why.as_ref());
        let why = why.map_or(String::new(), |why| format!(", one since {why}"));
        console::report(&format!(
            "{failed} members failed{why}: summary.json says why of each"
        ));
    }
}

fn whole(text: &str, key: &str) -> Result<usize> {
    text.trim().parse().map_err(|_| {
        let needed = "a whole number is needed";
        let found = format!("\"{text}\"");
        Problem::new(Code::OutOfRange, "auxbear study", found, needed).on_key(key)
    })
}

/// Rate and remaining time, a line at a time.
struct Pace {
    begin: Instant,
    there: f64,
    all: usize,
    last: Option<Mutex<Instant>>,
}

impl Pace {
    fn new(directory: &Directory, quiet: bool) -> Pace {
        let begin = Instant::now();
        Pace {
            begin,
            there: directory.there as f64,
            all: directory.study.members(),
            last: (!quiet).then(|| Mutex::new(begin)),
        }
    }

    fn show(&self, members: f64) {
        let Some(Ok(mut last)) = self.last.as_ref().map(Mutex::lock) else {
            return;
        };
        if last.elapsed() < PAUSE {
            return;
        }
        *last = Instant::now();
        let done = members - self.there;
        let left = match done > 0.0 {
            true => {
                let each = self.begin.elapsed().as_secs_f64() / done;
                let left = (self.all as f64 - members) * each;
                let [each, left] = [each, left].map(|seconds| readable(seconds, "s"));
                format!(", {each} each, {left} left")
            }
            false => String::new(),
        };
        let all = self.all;
        // members side by side end together: a share of the work is no count of those that had ended
        let share = 100.0 * members / all.max(1) as f64;
        console::report(&format!("study: {share:.0} % of {all} members{left}"));
    }
}

/// The best candidates of a selection, and what is said of the first.
fn ranking(study: &Study, answer: &Answer) -> String {
    const FIRST: usize = 6;
    let rank = study.file.rank.as_ref();
    if answer.ranking.is_empty() {
        return String::new();
    }
    let Some((name, ..)) = rank else {
        return cases(study, answer);
    };
    let known = study.known.iter().find(|known| known.name == *name);
    let unit = known.map_or("", |known| known.unit);
    let row = |(place, one): (usize, &Candidate)| {
        let values: Vec<&str> = one.values.iter().map(|(_, value)| value.as_str()).collect();
        let broken = one.broken().next();
        [
            format!("  {}. {}", place + 1, one.verdict.word()),
            values.join(", "),
            (one.quantile).map_or("–".to_string(), |value| readable(value, unit)),
            broken.map_or(String::new(), |judged| {
                judged.limit.quantity.replace('_', " ")
            }),
        ]
    };
    let first = answer.ranking.iter().enumerate().take(FIRST);
    let rows: Vec<[String; 4]> = first.map(row).collect();
    format!(
        "by {}, of which 95 % of the draws are not worse:\n{}{}\n",
        name.replace(['_', '.'], " "),
        console::table(&rows),
        chosen(study, answer)
    )
}

/// The cases of a qualification, with the limits that each does not hold.
pub fn cases(study: &Study, answer: &Answer) -> String {
    let rows = answer.ranking.iter().flat_map(|one| {
        let values: Vec<&str> = one.values.iter().map(|(_, value)| value.as_str()).collect();
        let mut rows = vec![[
            format!("  {}", one.verdict.word()),
            values.join(", "),
            String::new(),
            one.open.clone().unwrap_or_default(),
        ]];
        let judged = one.limits.iter().zip(&one.worst);
        let broken = judged.filter(|(judged, _)| judged.verdict != Verdict::Pass);
        rows.extend(broken.map(|(judged, worst)| {
            let member = worst.map_or(String::new(), |member| format!("; member {member}"));
            [
                String::new(),
                format!(
                    "  {}: {}",
                    judged.limit.quantity.replace(['_', '.'], " "),
                    judged.verdict.word()
                ),
                bound(judged),
                format!("{}{member}", judged.why),
            ]
        }));
        rows
    });
    let rows: Vec<[String; 4]> = rows.collect();
    format!(
        "cases:\n{}{}\n",
        console::table(&rows),
        chosen(study, answer)
    )
}

/// The verdicts and the results that are shown.
fn text(path: &Path, study: &Study, done: &Done) -> String {
    let answer = &done.answer;
    let mut text = format!(
        "{}: {} members of {} {} design, {} failed\n",
        PathBuf::from(path).display(),
        answer.members,
        article(study.file.kind),
        study.file.kind,
        done.failed
    );
    let limits: Vec<[String; 4]> = (answer.limits.iter())
        .map(|limit| {
            let judged = &limit.judged;
            let beyond = limit.beyond.map_or(String::new(), |(share, [low, high])| {
                let [share, low, high] = [share, low, high].map(percent);
                format!("; beyond it {share} of members, 95 % interval {low} to {high}")
            });
            [
                format!("  {}", judged.verdict.word()),
                judged.limit.quantity.replace(['_', '.'], " "),
                bound(judged),
                format!("{}{beyond}", judged.why),
            ]
        })
        .collect();
    if !limits.is_empty() {
        text.push_str(&format!("limits:\n{}", console::table(&limits)));
    }
    match &answer.estimate {
        None => {}
        Some(Err(why)) => text.push_str(&format!("nothing was estimated: {why}\n")),
        Some(Ok(found)) => {
            let table = console::table(&estimate_rows(found));
            text.push_str(&format!("estimate:\n{table}{}\n", estimate_note(found)));
        }
    }
    text.push_str(&ranking(study, answer));
    text.push_str(&spreads(study, answer));
    text.push_str(&sensitivities(study, answer));
    text
}

/// The results that are shown with their spread; of a sweep its levels were chosen, and a mean says nothing.
fn spreads(study: &Study, answer: &Answer) -> String {
    let shown = study.shown();
    let mut rows = vec![["  result", "mean", "deviation", "5 %", "95 %"].map(str::to_string)];
    let found = answer
        .spreads
        .iter()
        .filter(|(name, ..)| shown.contains(name));
    for (name, unit, spread) in found.filter(|_| study.file.kind != "sweep") {
        let Some(spread) = spread else { continue };
        let number = |value: f64| readable(value, unit);
        let of = match spread.members < answer.members {
            true => format!(" (of the {} that have it)", spread.members),
            false => String::new(),
        };
        rows.push([
            format!("  {}{of}", name.replace(['_', '.'], " ")),
            number(spread.mean),
            number(spread.standard_deviation),
            number(spread.quantiles[0]),
            number(spread.quantiles[2]),
        ]);
    }
    let of = match study.file.kind {
        "widened" => " of the wider distributions, which are not those of the machine",
        _ => "",
    };
    match rows.len() {
        1 => String::new(),
        _ => format!("results{of}:\n{}", console::table(&rows)),
    }
}

/// What each result owes to each input.
fn sensitivities(study: &Study, answer: &Answer) -> String {
    let inputs = study.file.inputs.iter();
    let inputs = || inputs.clone().map(|input| format!("  {}", input.vary.path));
    let banded = |value: f64, [low, high]: [f64; 2]| format!("{value:.3} ({low:.3} to {high:.3})");
    let mut text = String::new();
    for (name, unit, found) in &answer.sensitivity {
        let name = name.replace(['_', '.'], " ");
        let (head, rows): (String, Vec<[String; 3]>) = match found {
            Sensitivity::Sweep(given, ranges) => {
                let given = given.map_or("not known".to_string(), |value| readable(value, unit));
                let rows = inputs().zip(ranges).filter_map(|(path, range)| {
                    let [low, high] = (*range)?;
                    Some([path, readable(low, unit), readable(high, unit)])
                });
                (
                    format!("{name}, {given} as given; least and most over each input alone"),
                    rows.collect(),
                )
            }
            Sensitivity::Effects(effects) => {
                let rows = inputs().zip(effects).filter_map(|(path, effect)| {
                    let effect = effect.as_ref()?;
                    let [size, spread] = [effect.mean_size, effect.deviation];
                    Some([path, readable(size, unit), readable(spread, unit)])
                });
                (
                    format!("{name}: mean size and deviation of the effects of each input"),
                    rows.collect(),
                )
            }
            Sensitivity::Indices(indices) => {
                let rows = inputs().zip(indices).map(|(path, index)| {
                    let both = [&index.first, &index.total];
                    let [first, total] = both.map(|one| banded(one.value, one.band));
                    [path, first, total]
                });
                (
                    format!("{name}: Sobol indices, first order and total (95 % bands)"),
                    rows.collect(),
                )
            }
        };
        text.push_str(&format!("{head}:\n{}", console::table(&rows)));
    }
    text
}

fn percent(share: f64) -> String {
    let digits = format!("{:.3}", 100.0 * share);
    format!("{} %", digits.trim_end_matches('0').trim_end_matches('.'))
}
