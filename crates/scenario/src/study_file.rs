//! A study file: which scenario is run many times, what differs from run to run, and what is asked.
//!
//! ```toml
//! format = "auxbear.study/1"
//! scenario = "drop.toml"        # relative to this file
//! set = ["run.accuracy=screening"]   # of the scenario, as after --set
//! seed = 1
//!
//! [design]
//! kind = "monte carlo"          # widened, latin hypercube, sobol, factorial, sweep, morris, saltelli, selection, estimate, qualification
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

use crate::study_document::{self, StudyDocument};
use crate::study_inputs::{StudyInput, estimable, inputs_of};
use crate::{Accuracy, BuiltIn, CASE, Distribution, Limit, Scenario, UNBALANCE_ANGLE};
use problem::key::{Key, Kind, Range, quoted};
use problem::raw::{Raw, Sections, Written};
use problem::table::Table;
use problem::{Code, Place, Problem, Result};
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
const DESIGNS: [&str; 11] = [
    "monte carlo",
    "widened",
    "latin hypercube",
    "sobol",
    "factorial",
    "sweep",
    "morris",
    "saltelli",
    "selection",
    ESTIMATE,
    QUALIFICATION,
];
/// Inputs within bounds that measured curves determine.
const ESTIMATE: &str = "estimate";
/// Every case at every level of the inputs that have levels, each with the same draws of the others.
pub(super) const QUALIFICATION: &str = "qualification";

/// Whether a design has candidates, each with the same draws.
pub(super) fn has_candidates(kind: &str) -> bool {
    ["selection", QUALIFICATION].contains(&kind)
}

/// The keys of a study file.
#[rustfmt::skip]
mod keys {
    use super::{DESIGNS, Key, Kind, MOST_WIDENING, Range, STUDY_FORMAT};

    pub const HEAD: &[Key] = &[
        Key::new("format", Kind::Text, STUDY_FORMAT, "Format and version of this file."),
        Key::new("title", Kind::Text, "Scatter of a drop", "Title of the report.").optional("the report is titled by the file name"),
        Key::new("description", Kind::Text, "What was asked", "Text for the report.").optional("the report has no introduction"),
        Key::new("scenario", Kind::Text, "drop.toml", "The file that is run many times, relative to this one."),
        Key::new("set", Kind::Texts, "[\"run.accuracy=screening\"]", "Overrides of the scenario, as after --set.").optional("it is run as it is"),
        Key::new("seed", Kind::Count, "1", "Seed of the design.").default("0", "any number gives as good a sample"),
    ];
    pub const KIND: Key = Key::new("design.kind", Kind::Word(&DESIGNS), "monte carlo", "Kind of the design.");
    pub const MEMBERS: Key = Key::new("design.members", Kind::Count, "100", "Number of members.").positive();
    pub const BLOCKS: Key = Key::new("design.blocks", Kind::Count, "100", "Number of blocks.").positive();
    pub const DRAWS: Key = Key::new("design.draws", Kind::Count, "100", "Number of members of each candidate.").positive();
    pub const ADDED: Key = Key::new("design.added", Kind::Count, "100", "Members or blocks added to those asked for at first.").optional("none were added");
    pub const WIDEN: Key = Key::new("design.widen", Kind::Coefficient, "2.0", "Factor by which normal numbers scatter more.").within(Range::AboveTo(1.0, MOST_WIDENING)).optional("2: probabilities about a thousandth, of few inputs");
    pub const RESULTS: Key = Key::new("question.results", Kind::Texts, "[\"peak_contact_force\"]", "Results that the page shows.").optional("those of the limits");
    pub const CONFIRM: Key = Key::new("question.confirm", Kind::Count, "10", "Members nearest to each limit that are run again at design accuracy.").optional("none is");
    pub const RANK: Key = Key::new("question.rank", Kind::Text, "peak_contact_force", "The result that candidates are ranked by.");
    pub const BEST: Key = Key::new("question.best", Kind::Word(&["least", "most"]), "least", "Which of its values is best.").default("least", "loads, heat and times are better small");
    pub const CORRELATION: &[Key] = &[
        Key::new("correlation.inputs", Kind::Texts, "[\"rotor.mass\", \"mount.stiffness\"]", "Paths of two inputs."),
        Key::new("correlation.coefficient", Kind::Coefficient, "0.5", "Their coefficient."),
    ];
}

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
    /// What the document of a qualification says besides.
    pub document: StudyDocument,
}

impl StudyFile {
    /// Reads a study file and the scenario that it names.
    ///
    /// # Errors
    /// What is wrong with either, with file, line and key.
    pub fn read(path: &Path) -> Result<StudyFile> {
        let text = problem::read_text(path, "a study file")?;
        let file = path.display().to_string();
        StudyFile::parse(text.trim_start_matches('\u{feff}'), &file, path.parent())
    }

    /// Reads a text; the name stands for the file in messages, and the scenario is looked for from the folder on.
    ///
    /// # Errors
    /// What is wrong with it or its scenario, with file, line and key.
    pub fn parse(text: &str, file: &str, folder: Option<&Path>) -> Result<StudyFile> {
        let root = DeTable::parse(text).map_err(|error| Problem::of_toml(&error, text, file))?;
        let names = [
            &["design", "input", "limit", "correlation", "question"],
            study_document::SECTIONS.as_slice(),
        ]
        .concat();
        let sections = Sections::of(text, root.get_ref(), &names);
        require_format(file, &sections.head)?;
        let top = (String::new(), "the top level");
        let head: Table = Table::read(file, top, keys::HEAD, &sections.head, &names)?;
        let scenario = head.text("scenario").unwrap_or_default();
        let scenario = folder.map_or(PathBuf::from(scenario), |folder| folder.join(scenario));
        let scenario = Scenario::read(&scenario, head.texts("set"), &BuiltIn)?;
        single(&scenario).map_err(|found| {
            let allowed = "a scenario of single runs is needed: what differs from run to run stands in the study file";
            head.problem(Code::StudyScenario, "scenario", found, allowed)
        })?;
        let kind = kind_of(file, sections.one("design"))?;
        let mut tables = sections.all("input").to_vec();
        if kind == QUALIFICATION {
            if scenario.system.cases().names.is_empty() {
                let allowed = "a machine is needed whose [[event]] or [base] name a case";
                let found = "a scenario without cases";
                return head.refuse(Code::StudyDesign, "scenario", found, allowed);
            }
            if head
                .texts("set")
                .iter()
                .any(|set| set.trim_start().starts_with(CASE))
            {
                let found = format!("{CASE}, which differs from member to member");
                let allowed = "a qualification runs every case; an [[input]] of run.case with a choice names some of them";
                return head.refuse(Code::Conflict, "set", found, allowed);
            }
            tables.splice(0..0, of_each_qualification(&scenario, &tables));
        }
        let inputs = inputs_of(file, &scenario, &tables, kind)?;
        if kind == ESTIMATE {
            estimable(file, &scenario, &inputs)?;
        }
        let (design, asked, added) = design_of(file, sections.one("design"), kind, &inputs)?;
        let (pairs, correlation) = correlated(file, sections.all("correlation"), &inputs, kind)?;
        let keys: &[Key] = match kind {
            "selection" => &[keys::RESULTS, keys::CONFIRM, keys::RANK, keys::BEST],
            _ => &[keys::RESULTS, keys::CONFIRM],
        };
        let place = ("question".to_string(), "[question]");
        let question = Table::read(file, place, keys, sections.one("question"), &[])?;
        let ranked = |name: &str| {
            let most = question.word("best") == Some("most");
            (name.to_string(), most, question.place_of("rank"))
        };
        let mut limits = scenario.limits_of(file, sections.all("limit").to_vec())?;
        limits.extend(scenario.limits.iter().cloned());
        let cases = qualifiable(file, kind, &scenario, (&inputs, &limits))?;
        let document = StudyDocument::of(file, &sections, cases)?;
        let confirm = question.count("confirm").unwrap_or(0);
        let at_screening =
            (scenario.drop()).is_some_and(|drop| drop.run.accuracy == Accuracy::Screening);
        if confirm > 0 && (!at_screening || limits.is_empty()) {
            let found = "nothing to confirm";
            let allowed = "a limit, and members at screening accuracy (set = [\"run.accuracy=screening\"]), are needed: those nearest to a limit are run again at design accuracy";
            return question.refuse(Code::StudyDesign, "confirm", found, allowed);
        }
        let results = question.texts("results").iter();
        Ok(StudyFile {
            file: file.to_string(),
            title: head.text("title").map(str::to_string),
            scenario,
            seed: head.count("seed").unwrap_or(0) as u64,
            kind,
            design,
            asked,
            added,
            inputs,
            pairs,
            correlation,
            limits,
            results: results
                .map(|name| (name.clone(), question.place_of("results")))
                .collect(),
            confirm,
            rank: question.text("rank").map(ranked),
            document,
        })
    }

    /// Whether measured curves are to determine its inputs.
    pub fn estimates(&self) -> bool {
        self.kind == ESTIMATE
    }

    /// Refuses what is no qualification.
    ///
    /// # Errors
    /// Another kind of design.
    pub fn require_qualification(&self) -> Result<()> {
        if self.kind == QUALIFICATION {
            return Ok(());
        }
        let found = quoted(self.kind);
        let allowed = "kind = \"qualification\" is needed; auxbear study runs any design";
        Err(Problem::new(Code::StudyDesign, &self.file, found, allowed).on_key("design.kind"))
    }

    /// The same with more blocks.
    ///
    /// # Errors
    /// Where the design is complete as it is, or becomes too large.
    pub fn extended(mut self, more: usize) -> Result<StudyFile> {
        let longer = self.design.extended(more);
        match longer.filter(is_possible) {
            Some(design) => self.design = design,
            None => {
                let found = format!("{more} blocks more of a {} design", self.kind);
                let allowed = format!(
                    "factorials and sweeps are complete as they are, a sobol design has at most {MOST_SOBOL} points, any other {MOST_MEMBERS} members"
                );
                let problem = Problem::new(Code::StudyDesign, &self.file, found, allowed);
                return Err(problem.on_key("--add"));
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
        out.push_str(&self.document.toml());
        out
    }
}

/// The cases of a qualification; refuses those that the machine does not have, and a qualification that would judge nothing.
fn qualifiable<'a>(
    file: &str,
    kind: &str,
    scenario: &Scenario,
    (inputs, limits): (&'a [StudyInput], &[Limit]),
) -> Result<&'a [String]> {
    let known = scenario.system.cases().names;
    let refuse = |key: &str, found: String, allowed: &str| {
        Err(Problem::new(Code::StudyDesign, file, found, allowed).on_key(key))
    };
    let chosen = inputs.iter().find(|input| input.vary.path == CASE);
    let chosen = match chosen.map(|input| &input.vary.distribution) {
        Some(Distribution::Choice(texts)) => texts.as_slice(),
        _ => &[],
    };
    if let Some(other) = chosen.iter().find(|name| !known.contains(name)) {
        let allowed = format!("cases of the scenario are needed: {}", known.join(", "));
        return refuse("input.choice", quoted(other), &allowed);
    }
    if kind != QUALIFICATION {
        return Ok(&[]);
    }
    if limits.is_empty() {
        let allowed = "a [[limit]] in the study or its scenario is needed: else nothing is judged";
        return refuse("limit", "no limit".to_string(), allowed);
    }
    let own = limits.iter().filter_map(|limit| limit.case.as_ref());
    match own.clone().find(|case| !chosen.contains(case)) {
        None => Ok(chosen),
        Some(other) => {
            let found = format!("a limit of the case {}, which is left out", quoted(other));
            let allowed = format!("one of the cases {} is needed", chosen.join(", "));
            refuse("limit.case", found, &allowed)
        }
    }
}

/// Inputs that every qualification has, where its file does not have them: the cases of the machine, and the angle of the unbalance.
fn of_each_qualification(scenario: &Scenario, tables: &[Vec<Written>]) -> Vec<Vec<Written>> {
    let given = |path: &str| {
        let mut keys = tables.iter().flatten();
        keys.any(|(key, raw, _)| key == "path" && matches!(raw, Raw::Text(own) if own == path))
    };
    let text = |text: &str| Raw::Text(text.to_string());
    let cases: Vec<Raw> = scenario
        .system
        .cases()
        .names
        .iter()
        .map(|name| text(name))
        .collect();
    let turn = ["0 deg", "360 deg"].map(text).to_vec();
    let added = [(CASE, "choice", cases), (UNBALANCE_ANGLE, "uniform", turn)];
    let added = added
        .into_iter()
        .filter(|(path, _, list)| !given(path) && !list.is_empty());
    let table = |(path, word, list): (&str, &str, Vec<Raw>)| {
        let keys = [("path", text(path)), (word, Raw::List(list))];
        keys.map(|(key, raw)| (key.to_string(), raw, Place::Whole))
            .to_vec()
    };
    added.map(table).collect()
}

/// Why a scenario is no single run; a study takes what repeats it upon itself.
fn single(scenario: &Scenario) -> Result<(), String> {
    match (&scenario.system, scenario.drop()) {
        (_, Some(drop)) if drop.repeat.count > 1 => {
            Err(format!("one with repeat.count = {}", drop.repeat.count))
        }
        _ if !scenario.vary.is_empty() => {
            Err("one that varies values itself, by [vary] or [repeat]".to_string())
        }
        (system, _) if system.name().reads_measurements() => {
            Err("the analysis of a measurement".to_string())
        }
        _ => Ok(()),
    }
}

/// A study begins with its format: a file of another one would fail on its keys with misleading words.
fn require_format(file: &str, head: &[Written]) -> Result<()> {
    let format = head.iter().find(|(key, ..)| key == "format");
    let found = match format {
        Some((_, Raw::Text(word), _)) if word == STUDY_FORMAT => return Ok(()),
        Some((_, raw, _)) => raw.text(),
        None => "nothing".to_string(),
    };
    let allowed =
        format!("format = \"{STUDY_FORMAT}\" is needed; auxbear new study writes such a file");
    Err(Problem::new(Code::UnknownFormat, file, found, allowed).on_key("format"))
}

/// The kind of the design, on which its other keys depend.
fn kind_of(file: &str, written: &[Written]) -> Result<&'static str> {
    let kinds = written.iter().filter(|(key, ..)| key == "kind");
    let plain = |raw: &Raw| match raw {
        Raw::Text(text) => Raw::Text(text.replace('_', " ")),
        other => other.clone(),
    };
    let kinds: Vec<Written> = kinds
        .map(|(key, raw, place)| (key.clone(), plain(raw), *place))
        .collect();
    let table: Table = Table::read(
        file,
        ("design".to_string(), "[design]"),
        &[keys::KIND],
        &kinds,
        &[],
    )?;
    Ok(table.word("kind").unwrap_or(DESIGNS[0]))
}

/// The word for the number of members, or of blocks.
fn count_key(kind: &str) -> &'static str {
    match kind {
        "morris" | "saltelli" => "blocks",
        kind if has_candidates(kind) => "draws",
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
fn design_of(
    file: &str,
    written: &[Written],
    kind: &str,
    inputs: &[StudyInput],
) -> Result<(Design, usize, usize)> {
    let count = inputs.len();
    let levels = || inputs.iter().map(|input| input.levels).collect();
    let keys: &[Key] = match kind {
        "factorial" | "sweep" => &[],
        kind if has_candidates(kind) => &[keys::DRAWS],
        "widened" => &[keys::MEMBERS, keys::ADDED, keys::WIDEN],
        "morris" | "saltelli" => &[keys::BLOCKS, keys::ADDED],
        _ => &[keys::MEMBERS, keys::ADDED],
    };
    let numbers: Vec<Written> = (written.iter())
        .filter(|(key, ..)| key != "kind")
        .cloned()
        .collect();
    let table = Table::read(
        file,
        ("design".to_string(), "[design]"),
        keys,
        &numbers,
        &["kind"],
    )?;
    let key = count_key(kind);
    let asked = table.count(key).unwrap_or(0);
    let added = table.count("added").unwrap_or(0);
    let design = match kind {
        "factorial" => Design::Factorial(levels()),
        "sweep" => Design::Sweep(levels()),
        "monte carlo" => Design::MonteCarlo(count, asked),
        "widened" => Design::Widened(count, asked, table.number("widen").unwrap_or(WIDENING)),
        "latin hypercube" | ESTIMATE => Design::LatinHypercube(count, asked, 1),
        "sobol" => Design::Sobol(count, asked),
        "morris" => Design::Morris(count, asked),
        kind if has_candidates(kind) => Design::Selection(levels(), asked),
        _ => Design::Saltelli(count, asked),
    };
    let design = match added {
        0 => Some(design),
        more => design.extended(more),
    };
    let columns = if kind == "saltelli" { 2 * count } else { count };
    let columns_fit = !["sobol", "saltelli"].contains(&kind) || columns <= MOST_SOBOL_INPUTS;
    match design.filter(|design| columns_fit && is_possible(design)) {
        Some(design) => Ok((design, asked, added)),
        None => {
            let allowed = format!(
                "at most {MOST_MEMBERS} members are possible; of sobol numbers {MOST_SOBOL} points of {MOST_SOBOL_INPUTS} columns, of which saltelli takes two an input"
            );
            let found = "a design that is too large";
            table.refuse(Code::StudyDesign, key, found, allowed)
        }
    }
}

/// Pairs of inputs with their coefficients, and their correlation.
type Correlated = (Vec<(usize, usize, f64)>, Option<Correlation>);

fn correlated(
    file: &str,
    tables: &[Vec<Written>],
    inputs: &[StudyInput],
    kind: &str,
) -> Result<Correlated> {
    let mut pairs: Vec<(usize, usize, f64)> = Vec::new();
    let mut first = None;
    for written in tables {
        let table: Table = Table::read(
            file,
            ("correlation".to_string(), "[[correlation]]"),
            keys::CORRELATION,
            written,
            &[],
        )?;
        let wrong =
            |code, key: &str, found: &str, allowed: &str| table.refuse(code, key, found, allowed);
        let of = |name: &String| inputs.iter().position(|input| input.vary.path == *name);
        let places: Vec<Option<usize>> = table.texts("inputs").iter().map(of).collect();
        let needed = "inputs = [\"…\", \"…\"] is needed: the paths of two inputs that are no choices, each pair once";
        let choice = |k: usize| matches!(inputs[k].vary.distribution, Distribution::Choice(_));
        let (a, b) = match places.as_slice() {
            [Some(a), Some(b)] if a != b && !choice(*a) && !choice(*b) => (*a.min(b), *a.max(b)),
            _ => return wrong(Code::UnknownWord, "inputs", "other names", needed),
        };
        if pairs.iter().any(|pair| (pair.0, pair.1) == (a, b)) {
            return wrong(Code::Conflict, "inputs", "a pair given twice", needed);
        }
        let value = table.needed("coefficient");
        if value.abs() >= 1.0 {
            let allowed = "a bare number between -1 and 1 is needed";
            return wrong(Code::OutOfRange, "coefficient", &value.to_string(), allowed);
        }
        pairs.push((a, b, value));
        first.get_or_insert(table);
    }
    let Some(table) = first else {
        return Ok((pairs, None));
    };
    let wrong = |found: &str, allowed| table.refuse(Code::StudyCorrelation, "", found, allowed);
    if ["factorial", "sweep", "morris", "saltelli"].contains(&kind) || has_candidates(kind) {
        return wrong(
            &format!("correlated inputs of a {kind} design"),
            "its effects and indices belong to independent inputs; monte carlo, widened, latin hypercube and sobol take correlated ones",
        );
    }
    match Correlation::of(inputs.len(), &pairs) {
        Some(correlation) => Ok((pairs, Some(correlation))),
        None => wrong(
            "coefficients that contradict each other",
            "coefficients that inputs can have together are needed (a positive definite matrix)",
        ),
    }
}
