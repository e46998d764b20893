//! A study file: which scenario is run many times, what differs from run to run, and what is asked.
//!
//! ```toml
//! format = "auxbear.study/1"
//! scenario = "drop.toml"        # relative to this file
//! set = ["run.accuracy=screening"]   # of the scenario, as after --set
//! seed = 1
//!
//! [design]
//! kind = "monte carlo"          # widened, latin hypercube, sobol, factorial, sweep, morris, saltelli, selection
//! members = 1000                # blocks of morris and saltelli
//!
//! [[input]]
//! path = "contact.friction_coefficient"
//! lognormal = 0.2               # or normal, uniform, triangular, choice, in the words of [vary]
//!
//! [[limit]]
//! quantity = "peak_contact_force"
//! most = "5 kN"
//! share = 0.99
//!
//! [question]
//! results = ["peak_contact_force", "first_impact_force"]
//! ```

use crate::scenario::key::quoted;
use crate::scenario::raw::{Written, collect, raw, tables};
use crate::scenario::study_inputs::{StudyInput, inputs_of};
use crate::scenario::study_section::{Page, Section};
use crate::scenario::{Accuracy, BuiltIn, Limit, Scenario, System};
use problem::{Code, Place, Problem};
use statistics::correlation::Correlation;
use statistics::design::{Design, MOST_SOBOL, MOST_SOBOL_INPUTS};
use std::path::{Path, PathBuf};
use toml::de::DeTable;

/// The format of a study file.
pub const STUDY_FORMAT: &str = "auxbear.study/1";
/// Members of a study, at most: each is a row in memory.
const MOST_MEMBERS: usize = 1_000_000;
/// Factor of a widened design where none is given: probabilities about a thousandth, of few inputs.
const WIDENING: f64 = 2.0;
/// Largest one: beyond it hardly a member counts.
const MOST_WIDENING: f64 = 4.0;
const DESIGNS: [&str; 9] = [
    "monte carlo",
    "widened",
    "latin hypercube",
    "sobol",
    "factorial",
    "sweep",
    "morris",
    "saltelli",
    "selection",
];

/// A study that was read and checked.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// The file, as the user named it.
    pub file: String,
    /// Title of the report.
    pub title: Option<String>,
    /// The scenario that is run; what repeats it or varies it is the study.
    pub scenario: Scenario,
    /// Seed of the design.
    pub seed: u64,
    /// Word of the design.
    pub kind: &'static str,
    /// Its members, with the blocks that were added.
    pub design: Design,
    /// Members, or blocks of Morris and Saltelli designs, as asked for at first.
    pub asked: usize,
    /// Blocks that were added.
    pub added: usize,
    /// What differs from member to member.
    pub inputs: Vec<StudyInput>,
    /// Pairs of inputs with their coefficients.
    pub pairs: Vec<(usize, usize, f64)>,
    /// Their correlation; none where they are independent.
    pub correlation: Option<Correlation>,
    /// Limits of the study file, then those of the scenario.
    pub limits: Vec<Limit>,
    /// Results that the page shows; all limits' where none are named.
    pub results: Vec<(String, Place)>,
    /// Members nearest to each limit that are run again at design accuracy.
    pub confirm: usize,
    /// The result that candidates of a selection are ranked by, and whether most of it is best.
    pub rank: Option<(String, bool, Place)>,
}

impl StudyFile {
    /// Reads a study file and the scenario that it names.
    ///
    /// # Errors
    /// What is wrong with either, with file, line and key.
    pub fn read(path: &Path) -> Result<StudyFile, Box<Problem>> {
        let text = problem::read_text(path, "a study file")?;
        let file = path.display().to_string();
        StudyFile::parse(text.trim_start_matches('\u{feff}'), &file, path.parent())
    }

    /// Reads a text; the name stands for the file in messages, and the scenario is looked for from the folder on.
    ///
    /// # Errors
    /// What is wrong with it or its scenario, with file, line and key.
    pub fn parse(text: &str, file: &str, folder: Option<&Path>) -> Result<StudyFile, Box<Problem>> {
        let root = DeTable::parse(text).map_err(|error| Problem::of_toml(&error, text, file))?;
        let page = Page { file };
        let mut head = Section::new(&page, "");
        let (mut design, mut question) = (
            Section::new(&page, "design"),
            Section::new(&page, "question"),
        );
        let (mut inputs, mut limits, mut correlations) = (Vec::new(), Vec::new(), Vec::new());
        for (key, value) in root.get_ref() {
            let start = key.span().start;
            match key.get_ref().as_ref() {
                "input" => inputs = tables(text, start, value.get_ref()),
                "limit" => limits = tables(text, start, value.get_ref()),
                "correlation" => correlations = tables(text, start, value.get_ref()),
                word @ ("design" | "question") => {
                    let section = if word == "design" {
                        &mut design
                    } else {
                        &mut question
                    };
                    match value.get_ref() {
                        toml::de::DeValue::Table(table) => {
                            collect(text, table, "", &mut section.list);
                        }
                        other => {
                            let allowed = format!("a section [{word}] is needed");
                            let place = Place::of_offset(text, start);
                            let found = raw(other).text();
                            return Err(page.problem(Code::WrongType, place, word, found, allowed));
                        }
                    }
                }
                other => {
                    let place = Place::of_offset(text, start);
                    head.list
                        .push((other.to_string(), raw(value.get_ref()), place));
                }
            }
        }
        head.known(
            &["format", "title", "description", "scenario", "set", "seed"],
            &["design", "input", "limit", "correlation", "question"],
        )?;
        let format = head.text("format")?;
        if format.as_ref().is_none_or(|(word, _)| word != STUDY_FORMAT) {
            let found = format.map_or("nothing".to_string(), |(word, _)| quoted(&word));
            let allowed = format!(
                "format = \"{STUDY_FORMAT}\" is needed; auxbear new study writes such a file"
            );
            return Err(page.problem(Code::UnknownFormat, Place::Whole, "format", found, allowed));
        }
        let (scenario, place) = head.text("scenario")?.ok_or_else(|| {
            let allowed = "scenario = \"drop.toml\" is needed: the file that is run many times";
            page.problem(
                Code::MissingKey,
                Place::Whole,
                "scenario",
                "nothing",
                allowed,
            )
        })?;
        let scenario = folder.map_or(PathBuf::from(&scenario), |folder| folder.join(&scenario));
        let sets: Vec<String> = head.texts("set")?.into_iter().map(|(set, _)| set).collect();
        let scenario = Scenario::read(&scenario, &sets, &BuiltIn)?;
        single(&scenario).map_err(|found| {
            let allowed = "a scenario of single runs is needed: what differs from run to run stands in the study file";
            page.problem(Code::StudyScenario, place, "scenario", found, allowed)
        })?;
        let (seed, _) = head.count("seed")?.unwrap_or((0, Place::Whole));
        let kind = design.word("kind", &DESIGNS)?;
        let inputs = inputs_of(&page, &scenario, inputs, kind)?;
        let (shape, asked, added) = shape(&mut design, kind, &inputs)?;
        let pairs = pairs_of(&page, correlations, &inputs)?;
        let correlation = correlation_of(&page, &pairs, inputs.len(), kind)?;
        let rank = rank(&mut question, kind)?;
        let confirm = question.count("confirm")?;
        let results = question.texts("results")?;
        let mut limits = scenario.limits_of(file, limits)?;
        limits.extend(scenario.limits.iter().cloned());
        if let Some((1.., place)) = confirm {
            let at_screening = matches!(&scenario.system, System::Drop(drop) if drop.run.accuracy == Accuracy::Screening);
            if !at_screening || limits.is_empty() {
                let allowed = "a limit, and members at screening accuracy (set = [\"run.accuracy=screening\"]), are needed: those nearest to a limit are run again at design accuracy";
                return Err(question.wrong(
                    Code::StudyDesign,
                    place,
                    "confirm",
                    "nothing to confirm",
                    allowed,
                ));
            }
        }
        Ok(StudyFile {
            file: file.to_string(),
            title: head.text("title")?.map(|(title, _)| title),
            scenario,
            seed: seed as u64,
            kind,
            design: shape,
            asked,
            added,
            inputs,
            pairs: pairs
                .into_iter()
                .map(|(a, b, rho, _)| (a, b, rho))
                .collect(),
            correlation,
            limits,
            results,
            confirm: confirm.map_or(0, |(count, _)| count),
            rank,
        })
    }

    /// The same with more blocks.
    ///
    /// # Errors
    /// Where the design is complete as it is, or becomes too large.
    pub fn extended(mut self, more: usize) -> Result<StudyFile, Box<Problem>> {
        let longer = self.design.extended(more);
        match longer.filter(is_possible) {
            Some(design) => self.design = design,
            None => {
                let found = format!("{more} blocks more of a {} design", self.kind);
                let allowed = format!(
                    "factorials and sweeps are complete as they are, a sobol design has at most {MOST_SOBOL} points, any other {MOST_MEMBERS} members"
                );
                let problem = Problem::new(Code::StudyDesign, &self.file, found, allowed);
                return Err(Box::new(problem.on_key("--add")));
            }
        }
        self.added += more;
        Ok(self)
    }

    /// The resolved study as a file beside its resolved scenario.
    pub fn toml(&self) -> String {
        let mut out = format!("format = \"{STUDY_FORMAT}\"\n");
        if let Some(title) = &self.title {
            out.push_str(&format!("title = {}\n", quoted(title)));
        }
        out.push_str(&format!(
            "scenario = \"scenario.toml\"\nseed = {}\n",
            self.seed
        ));
        out.push_str(&format!("\n[design]\nkind = \"{}\"\n", self.kind));
        if let Design::Selection(_, draws) = self.design {
            out.push_str(&format!("draws = {draws}\n"));
        } else if !matches!(self.design, Design::Factorial(_) | Design::Sweep(_)) {
            out.push_str(&format!(
                "{} = {}\nadded = {}\n",
                count_key(self.kind),
                self.asked,
                self.added
            ));
        }
        if let Design::Widened(_, _, factor) = self.design {
            out.push_str(&format!("widen = {}\n", units::number_text(factor)));
        }
        for input in &self.inputs {
            out.push_str(&format!(
                "\n[[input]]\npath = {}\n{}\n",
                quoted(&input.vary.path),
                input.vary.distribution_toml()
            ));
            if input.has_levels() {
                out.push_str(&format!("levels = {}\n", input.levels));
            }
        }
        for (a, b, coefficient) in &self.pairs {
            let names = [a, b]
                .map(|k| quoted(&self.inputs[*k].vary.path))
                .join(", ");
            let coefficient = units::number_text(*coefficient);
            out.push_str(&format!(
                "\n[[correlation]]\ninputs = [{names}]\ncoefficient = {coefficient}\n"
            ));
        }
        let own = self.limits.len() - self.scenario.limits.len();
        for limit in &self.limits[..own] {
            out.push_str(&format!("\n{}", limit.toml()));
        }
        if !self.results.is_empty() {
            let names: Vec<String> = self.results.iter().map(|(name, _)| quoted(name)).collect();
            out.push_str(&format!("\n[question]\nresults = [{}]\n", names.join(", ")));
        }
        if self.results.is_empty() && (self.confirm > 0 || self.rank.is_some()) {
            out.push_str("\n[question]\n");
        }
        if self.confirm > 0 {
            out.push_str(&format!("confirm = {}\n", self.confirm));
        }
        if let Some((name, most, _)) = &self.rank {
            let best = if *most { "most" } else { "least" };
            out.push_str(&format!("rank = {}\nbest = \"{best}\"\n", quoted(name)));
        }
        out
    }
}

/// Why a scenario is no single run; a study takes what repeats it upon itself.
fn single(scenario: &Scenario) -> Result<(), String> {
    match &scenario.system {
        System::Drop(drop) if drop.repeat.count > 1 => {
            Err(format!("one with repeat.count = {}", drop.repeat.count))
        }
        _ if !scenario.vary.is_empty() => {
            Err("one that varies values itself, by [vary] or [repeat]".to_string())
        }
        System::Drop(_)
        | System::SpinUp(_)
        | System::Rig(_)
        | System::Torque(_)
        | System::Rotor(_)
        | System::CoastDown(_) => Ok(()),
        System::Signals(_) | System::Identify(_) => {
            Err("the analysis of a measurement".to_string())
        }
    }
}

/// The result that candidates are ranked by.
fn rank(question: &mut Section, kind: &str) -> Result<Option<(String, bool, Place)>, Box<Problem>> {
    if kind != "selection" {
        question.known(&["results", "confirm"], &[])?;
        return Ok(None);
    }
    question.known(&["results", "confirm", "rank", "best"], &[])?;
    let Some((name, place)) = question.text("rank")? else {
        let allowed =
            "rank = \"peak_contact_force\" is needed: the result that candidates are ranked by";
        return Err(question.wrong(Code::MissingKey, Place::Whole, "rank", "nothing", allowed));
    };
    let most = match question.text("best")? {
        None => false,
        Some(_) => question.word("best", &["least", "most"])? == "most",
    };
    Ok(Some((name, most, place)))
}

/// The factor by which the normal numbers of a widened design scatter more.
fn widening(section: &Section) -> Result<f64, Box<Problem>> {
    let Some((value, place)) = section.number("widen")? else {
        return Ok(WIDENING);
    };
    match (1.0..=MOST_WIDENING).contains(&value) && value > 1.0 {
        true => Ok(value),
        false => {
            let allowed = format!("a number above 1 and up to {MOST_WIDENING} is needed");
            Err(section.wrong(Code::OutOfRange, place, "widen", value.to_string(), allowed))
        }
    }
}

/// The word for the number of members, or of blocks.
fn count_key(kind: &str) -> &'static str {
    match kind {
        "morris" | "saltelli" => "blocks",
        "selection" => "draws",
        _ => "members",
    }
}

fn is_possible(design: &Design) -> bool {
    let sequence = match design {
        Design::Sobol(_, points) | Design::Saltelli(_, points) => *points,
        _ => 0,
    };
    sequence <= MOST_SOBOL
        && design
            .members()
            .is_some_and(|members| (1..=MOST_MEMBERS).contains(&members))
}

/// The design with its numbers, and how many members or blocks were asked for and added.
fn shape(
    section: &mut Section,
    kind: &str,
    inputs: &[StudyInput],
) -> Result<(Design, usize, usize), Box<Problem>> {
    let count = inputs.len();
    let levels = || inputs.iter().map(|input| input.levels).collect();
    let complete = match kind {
        "factorial" => Some(Design::Factorial(levels())),
        "sweep" => Some(Design::Sweep(levels())),
        _ => None,
    };
    let key = count_key(kind);
    match (&complete, kind) {
        (Some(_), _) => section.known(&["kind"], &[])?,
        (None, "selection") => section.known(&["kind", key], &[])?,
        (None, "widened") => section.known(&["kind", key, "added", "widen"], &[])?,
        (None, _) => section.known(&["kind", key, "added"], &[])?,
    }
    let number = section.count(key)?;
    let (added, _) = section.count("added")?.unwrap_or((0, Place::Whole));
    let needed = format!("{key} = 100 is needed: a whole number from 1 on");
    let (asked, place) = match (&complete, number) {
        (Some(_), _) => (0, Place::Whole),
        (None, Some((asked, place))) if asked > 0 => (asked, place),
        (None, Some((_, place))) => {
            return Err(section.wrong(Code::OutOfRange, place, key, "0", needed));
        }
        (None, None) => {
            return Err(section.wrong(Code::MissingKey, Place::Whole, key, "nothing", needed));
        }
    };
    let design = complete.or(match kind {
        "monte carlo" => Some(Design::MonteCarlo(count, asked)),
        "widened" => Some(Design::Widened(count, asked, widening(section)?)),
        "latin hypercube" => Some(Design::LatinHypercube(count, asked, 1)),
        "sobol" => Some(Design::Sobol(count, asked)),
        "morris" => Some(Design::Morris(count, asked)),
        "selection" => Some(Design::Selection(levels(), asked)),
        _ => Some(Design::Saltelli(count, asked)),
    });
    let design = design.and_then(|design| {
        if added > 0 {
            design.extended(added)
        } else {
            Some(design)
        }
    });
    let columns = if kind == "saltelli" { 2 * count } else { count };
    let columns_fit = !["sobol", "saltelli"].contains(&kind) || columns <= MOST_SOBOL_INPUTS;
    match design.filter(|design| columns_fit && is_possible(design)) {
        Some(design) => Ok((design, asked, added)),
        None => {
            let allowed = format!(
                "at most {MOST_MEMBERS} members are possible; of sobol numbers {MOST_SOBOL} points of {MOST_SOBOL_INPUTS} columns, of which saltelli takes two an input"
            );
            Err(section.wrong(
                Code::StudyDesign,
                place,
                key,
                "a design that is too large",
                allowed,
            ))
        }
    }
}

type Pair = (usize, usize, f64, Place);

fn pairs_of(
    page: &Page,
    tables: Vec<Vec<Written>>,
    inputs: &[StudyInput],
) -> Result<Vec<Pair>, Box<Problem>> {
    let mut pairs: Vec<Pair> = Vec::new();
    for list in tables {
        let mut section = Section::new(page, "correlation");
        section.list = list;
        section.known(&["inputs", "coefficient"], &[])?;
        let begin = section
            .list
            .first()
            .map_or(Place::Whole, |(.., place)| *place);
        let names = section.texts("inputs")?;
        let of = |name: &str| inputs.iter().position(|input| input.vary.path == name);
        let places: Vec<Option<usize>> = names.iter().map(|(name, _)| of(name)).collect();
        let needed = "inputs = [\"…\", \"…\"] is needed: the paths of two inputs that are no choices, each pair once";
        let choice = |k: usize| {
            matches!(
                inputs[k].vary.distribution,
                crate::scenario::Distribution::Choice(_)
            )
        };
        let (a, b) = match places.as_slice() {
            [Some(a), Some(b)] if a != b && !choice(*a) && !choice(*b) => (*a.min(b), *a.max(b)),
            _ => {
                return Err(section.wrong(
                    Code::UnknownWord,
                    begin,
                    "inputs",
                    "other names",
                    needed,
                ));
            }
        };
        if pairs.iter().any(|pair| (pair.0, pair.1) == (a, b)) {
            return Err(section.wrong(
                Code::Conflict,
                begin,
                "inputs",
                "a pair given twice",
                needed,
            ));
        }
        let value = section.number("coefficient")?.map(|(value, _)| value);
        match value.filter(|value| value.abs() < 1.0) {
            Some(value) => pairs.push((a, b, value, begin)),
            None => {
                let allowed = "a bare number between -1 and 1 is needed";
                return Err(section.wrong(
                    Code::OutOfRange,
                    begin,
                    "coefficient",
                    "no such number",
                    allowed,
                ));
            }
        }
    }
    Ok(pairs)
}

fn correlation_of(
    page: &Page,
    pairs: &[Pair],
    count: usize,
    kind: &str,
) -> Result<Option<Correlation>, Box<Problem>> {
    let Some((.., place)) = pairs.first() else {
        return Ok(None);
    };
    if ["factorial", "sweep", "morris", "saltelli", "selection"].contains(&kind) {
        let found = format!("correlated inputs of a {kind} design");
        let allowed = "its effects and indices belong to independent inputs; monte carlo, widened, latin hypercube and sobol take correlated ones";
        return Err(page.problem(
            Code::StudyCorrelation,
            *place,
            "correlation",
            found,
            allowed,
        ));
    }
    let plain: Vec<_> = pairs.iter().map(|(a, b, rho, _)| (*a, *b, *rho)).collect();
    match Correlation::of(count, &plain) {
        Some(correlation) => Ok(Some(correlation)),
        None => {
            let allowed = "coefficients that inputs can have together are needed (a positive definite matrix)";
            Err(page.problem(
                Code::StudyCorrelation,
                *place,
                "correlation",
                "coefficients that contradict each other",
                allowed,
            ))
        }
    }
}
