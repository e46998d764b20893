//! A qualification: the members of its study, then what its document needs besides, then the document.
//!
//! ```text
//!   members ──▶ members nearest to a limit at design accuracy ──▶ the deciding ones with little known inputs at their ends
//!           ──▶ drops in a row ──▶ signals of the test ──▶ document.html, predicted.csv
//! ```
//! Each stage keeps what it computed as it goes, and the next call computes what is missing.

use super::document::Document;
use super::{Directory, Done, confirmed_path, headed, table_of, text_file};
use crate::directory::{aside, io_error, page_run};
use crate::history::{self, View};
use crate::members;
use crate::page::PageRun;
use problem::{Problem, Result, open_file};
use run::Options;
use run::study::answer::Answer;
use run::study::in_a_row::InARow;
use run::study::little_known::LittleKnown;
use run::study::parts;
use run::study::selection::Candidate;
use run::study::table::{Column, Table};
use sha2::{Digest, Sha256};
use std::path::PathBuf;
use std::sync::atomic::Ordering;

const DOCUMENT: &str = "document.html";
const REQUIREMENTS: &str = "qualification.json";
const PREDICTED: &str = "predicted.csv";

/// What a caller of a qualification decides besides.
pub struct Wish<'a> {
    /// The day, as the document has it.
    pub date: &'a str,
    /// Told what is done of what, a stage at a time.
    pub progress: &'a (dyn Fn(&str, f64, usize) + Sync),
}

/// What a qualification left.
pub struct Qualified {
    /// What its study left.
    pub done: Done,
    /// Members that were confirmed at design accuracy.
    pub confirmed: usize,
    /// Runs besides the members.
    pub besides: usize,
    /// The document.
    pub document: PathBuf,
    /// Whether every stage is complete.
    pub complete: bool,
    /// Requirements met, not met, not shown.
    pub tally: [usize; 3],
}

/// What is there of the stages after the members.
#[derive(Default)]
struct Besides {
    known: Vec<LittleKnown>,
    ends: Table,
    rows: Vec<InARow>,
    drops: Table,
    predicted: Vec<Column>,
    complete: bool,
}

impl Directory {
    /// Computes what is missing of a qualification and writes its document.
    ///
    /// # Errors
    /// What cannot be written, and files that cannot be read.
    pub fn qualify(&self, options: &Options, wish: &Wish) -> Result<Qualified> {
        self.study.file.require_qualification()?;
        let members = self.study.members();
        let progress = |done: f64| (wish.progress)("runs", done, members);
        self.compute(options, &progress, &|| {
            let table = table_of(&self.path, &self.study)?;
            self.document(&table, &Besides::default(), wish, options)
                .map(|_| ())
        })?;
        let done = self.finish(options)?;
        let table = table_of(&self.path, &self.study)?;
        let mut besides = Besides::default();
        let goes_on = || !options.interrupt.load(Ordering::Relaxed);
        let mut complete = done.complete && goes_on();
        if complete {
            (besides.known, besides.ends) = self.ends(&table, options, wish)?;
            let asked = self.study.deciding(&table).len() * besides.known.len() * 2;
            complete = besides.ends.members.len() == asked && goes_on();
        }
        if complete {
            (besides.rows, besides.drops) = self.drops(&table, options, wish)?;
            let asked: usize = besides.rows.iter().map(|row| row.drops).sum();
            complete = besides.drops.members.len() == asked && goes_on();
        }
        if complete {
            besides.predicted = self.predicted(options, wish)?;
            complete = goes_on();
        }
        besides.complete = complete;
        let tally = self.document(&table, &besides, wish, options)?;
        let place = confirmed_path(&self.path);
        let confirmed = if place.exists() {
            members::count(&place)?
        } else {
            0
        };
        Ok(Qualified {
            confirmed,
            besides: besides.ends.members.len() + besides.drops.members.len(),
            document: self.path.join(DOCUMENT),
            complete,
            tally,
            done,
        })
    }

    fn kept(&self, name: &str) -> PathBuf {
        self.path.join(super::MEMBERS).join(name)
    }

    /// The deciding members with each little known input at its ends.
    fn ends(
        &self,
        table: &Table,
        options: &Options,
        wish: &Wish,
    ) -> Result<(Vec<LittleKnown>, Table)> {
        let study = &self.study;
        let known = study.little_known();
        let deciding = study.deciding(table);
        let all = deciding.len() * known.len() * 2;
        let place = self.kept("ends.parquet");
        let mut kept = match place.exists() {
            true => members::read(&place, &study.input_columns(), &(0..all.max(1)))?,
            false => Table::default(),
        };
        // of other deciding members nothing can be kept
        let same = |row: usize| {
            let drawn = study
                .drawn(deciding[kept.members[row] / 2 / known.len()])
                .numbers;
            let columns = kept.columns.iter().take(kept.inputs);
            columns
                .zip(drawn)
                .all(|(column, number)| column.values[row].to_bits() == number.to_bits())
        };
        if !(0..kept.members.len()).all(same) {
            kept = Table::default();
        }
        let missing: Vec<usize> = (0..all).filter(|row| !kept.members.contains(row)).collect();
        let told = |done: f64| (wish.progress)("runs with other inputs", done, all);
        parts::in_turns(&missing, options, false, |some| {
            let done = kept.members.len() as f64;
            told(done);
            let plan = Options {
                progress: &|share| told(done + share * some.len() as f64),
                ..*options
            };
            kept.append(study.with_ends(&deciding, &known, some, &plan));
            kept = study.in_order(std::mem::take(&mut kept).sorted());
            if !kept.members.is_empty() {
                aside(&place, |file| members::write(file, &kept).map_err(io_error))?;
            }
            Ok::<(), Box<Problem>>(())
        })?;
        Ok((known, kept))
    }

    /// Drops in a row.
    fn drops(&self, table: &Table, options: &Options, wish: &Wish) -> Result<(Vec<InARow>, Table)> {
        let rows = self.study.in_a_row(table);
        let place = self.kept("in_a_row.parquet");
        let kept = match place.exists() {
            true => members::read(&place, &self.study.input_columns(), &(0..usize::MAX))?,
            false => Table::default(),
        };
        let all: usize = rows.iter().map(|row| row.drops).sum();
        let quiet = Options {
            progress: &|_| {},
            ..*options
        };
        let table = self
            .study
            .run_in_a_row(&rows, kept, &quiet, &mut |table: &Table| {
                (wish.progress)("drops in a row", table.members.len() as f64, all);
                aside(&place, |file| members::write(file, table).map_err(io_error))
            })?;
        Ok((rows, table))
    }

    /// Signals of the test, as they were computed or anew; nothing where this was interrupted.
    fn predicted(&self, options: &Options, wish: &Wish) -> Result<Vec<Column>> {
        let place = self.kept("predicted.parquet");
        if place.exists() {
            let damaged = |error: String| members::damaged(&place, error);
            let file = open_file(&place).map_err(|error| damaged(error.to_string()))?;
            return history::read(file, &place).map_err(|error| damaged(error.to_string()));
        }
        (wish.progress)("signals of the test", 0.0, self.study.draws());
        let Some(columns) = self.study.predicted(options) else {
            return Ok(Vec::new());
        };
        let views: Vec<View> = columns.iter().map(View::from).collect();
        aside(&place, |file| {
            history::write_table(file, "predicted", &views, Vec::new()).map_err(io_error)
        })?;
        Ok(columns)
    }

    /// Writes the document of what is there: requirements met, not met, not shown.
    fn document(
        &self,
        table: &Table,
        besides: &Besides,
        wish: &Wish,
        options: &Options,
    ) -> Result<[usize; 3]> {
        let study = &self.study;
        let answer = study.answer(table);
        let scenario = study.file.scenario.resolved.toml();
        let mut hash = Sha256::new();
        hash.update(headed(&study.file));
        hash.update(scenario);
        let hash: String = hash
            .finalize()
            .iter()
            .map(|byte| format!("{byte:02x}"))
            .collect();
        let never = std::sync::atomic::AtomicBool::new(false);
        let alone = study
            .file
            .scenario
            .rotor_alone()
            .and_then(std::result::Result::ok);
        let rotor = alone.and_then(|alone| {
            let mut outcome = run::run(&alone, &Options::unwatched(&never)).ok()?;
            // a document is the same however long it took
            outcome.work.seconds = 0.0;
            let page = page_run("rotor", &alone, &outcome).ok()?;
            Some((outcome, page))
        });
        let owed = match besides.complete {
            true => study.owed(table, &besides.known, &besides.ends),
            false => Vec::new(),
        };
        let worst_run = match besides.complete {
            true => self.worst_run(&answer, options),
            false => None,
        };
        let document = Document {
            study,
            table,
            answer: &answer,
            known: &besides.known,
            owed: &owed,
            rows: &besides.rows,
            drops: &besides.drops,
            predicted: &besides.predicted,
            rotor: rotor.as_ref().map(|(outcome, page)| (outcome, page)),
            date: wish.date,
            hash: &hash,
            worst_run: worst_run.as_ref().map(|(member, page)| (*member, page)),
            complete: besides.complete,
        };
        text_file(&self.path.join(DOCUMENT), &document.html())?;
        text_file(&self.path.join(REQUIREMENTS), &document.json())?;
        if !besides.predicted.is_empty() {
            text_file(&self.path.join(PREDICTED), &csv(&besides.predicted))?;
        }
        Ok(document.tally())
    }

    /// The run nearest to a requirement.
    fn worst_run(&self, answer: &Answer, options: &Options) -> Option<(usize, PageRun)> {
        let all = answer.ranking.iter().filter_map(Candidate::nearest);
        let (.., member) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let scenario = self.study.scenario(member).ok()?;
        let quiet = Options {
            progress: &|_| {},
            ..*options
        };
        let mut outcome = run::run(&scenario, &quiet).ok()?;
        outcome.work.seconds = 0.0;
        Some((member, page_run("run", &scenario, &outcome).ok()?))
    }
}

/// Columns as text: names with units in the first line, an empty cell where there is nothing.
fn csv(columns: &[Column]) -> String {
    let line = |cells: Vec<String>| cells.join(",") + "\n";
    let mut text = line(
        columns
            .iter()
            .map(|own| format!("{} [{}]", own.name, own.unit))
            .collect(),
    );
    for row in 0..columns[0].values.len() {
        let cells = columns.iter().map(|own| own.values[row]);
        text.push_str(&line(
            cells
                .map(|value| {
                    if value.is_finite() {
                        value.to_string()
                    } else {
                        String::new()
                    }
                })
                .collect(),
        ));
    }
    text
}
