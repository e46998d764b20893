//! `auxbear qualify`.

use crate::arguments::{Qualify, stem};
use crate::digits::readable;
use crate::exit::Exit;
use crate::study::{PAUSE, cases, warn};
use crate::{console, run};
use auxbear::problem::Result;
use auxbear::report::study::{Directory, Qualified, Wish};
use auxbear::run::Options;
use auxbear::scenario::StudyFile;
use auxbear::study::Study;
use chrono::Utc;
use std::path::Path;
use std::sync::Mutex;
use std::time::Instant;

/// Begins a qualification or goes on with it, and writes its document.
pub fn perform(wish: &Qualify) -> Result<Exit> {
    let threads = wish.threads.as_deref().map(run::threads).transpose()?;
    let file = StudyFile::read(&wish.file)?;
    file.require_qualification()?;
    let own = || Path::new("runs").join(stem(&wish.file));
    let path = wish.out.clone().unwrap_or_else(own);
    let study = Study::new(file)?;
    run::listen(true);
    let directory = Directory::open(&path, study, 0)?;
    let begin = Instant::now();
    let before = directory.there;
    let options = Options {
        threads: threads.map(usize::from),
        interrupt: &run::INTERRUPT,
        progress: &|_| {},
        controllers: run::controllers(),
        rows: None,
    };
    let told = Mutex::new(begin);
    let qualified = directory.qualify(
        &options,
        &Wish {
            date: &Utc::now().date_naive().to_string(),
            progress: &|what, done, all| {
                let Some(mut last) = told
                    .lock()
                    .ok()
                    .filter(|last| !wish.quiet && last.elapsed() > PAUSE)
                else {
                    return;
                };
                *last = Instant::now();
                let share = 100.0 * done / all.max(1) as f64;
                console::report(&format!("qualify: {share:.0} % of {all} {what}"));
            },
        },
    )?;
    let done = &qualified.done;
    if !wish.quiet {
        let computed = done.answer.members - before;
        let seconds = begin.elapsed().as_secs_f64();
        console::print(&text(&directory.study, &qualified, (computed, seconds)))?;
    }
    warn(done);
    if !qualified.complete {
        let members = done.answer.members;
        console::report(&format!(
            "interrupted: {members} of {} runs are kept; the same command goes on",
            done.answer.asked
        ));
        return Ok(Exit::Interrupted);
    }
    match done.failed == done.answer.members {
        true => Ok(Exit::Failed),
        false => Ok(Exit::Done),
    }
}

/// Verdicts, and what they took.
fn text(study: &Study, qualified: &Qualified, (computed, seconds): (usize, f64)) -> String {
    let [met, not, open] = qualified.tally;
    let answer = &qualified.done.answer;
    let mut text = cases(study, answer);
    text.push_str(&format!(
        "requirements: {met} met, {not} not met, {open} not shown\n"
    ));
    let confirmed = 100.0 * qualified.confirmed as f64 / answer.members.max(1) as f64;
    text.push_str(&format!(
        "{} runs, {:.1} % confirmed at design accuracy, {} with other inputs or in a row\n",
        answer.members, confirmed, qualified.besides
    ));
    if computed > 0 {
        let each = readable(seconds / answer.ranking.len().max(1) as f64, "s");
        text.push_str(&format!(
            "{} for {computed} runs and all besides, {each} a case and level\n",
            readable(seconds, "s")
        ));
    }
    text.push_str(&format!("{}\n", qualified.document.display()));
    text
}
