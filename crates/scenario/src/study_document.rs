//! What the document of a qualification says that no run knows: who wrote it, how often a case is expected, what else is required.
//!
//! ```toml
//! [document]
//! machine = "Expander EX-48"
//! author = "A. Engineer"
//! revision = "B"
//! environment = "dry nitrogen, 20 degC"
//! test_case = "power lost"          # whose signals are predicted; the first case unless given
//!
//! [[case]]
//! name = "power lost"
//! expected = "five times in 20 years"
//! drops = 10                        # so many in a row, each with the wear of those before
//!
//! [[requirement]]                   # what no result answers: it is not shown
//! text = "The thrust bearing carries the axial force of a surge"
//! why = "its axial magnet is taken to hold throughout"
//! ```

use problem::key::{Key, Kind, Range, quoted};
use problem::raw::Sections;
use problem::table::Table;
use problem::{Code, Result, did_you_mean};

/// Sections of a study file that the document alone reads.
pub(super) const SECTIONS: [&str; 3] = ["document", "case", "requirement"];
/// Drops in a row, at most.
const MOST_DROPS: f64 = 1000.0;

#[rustfmt::skip]
const HEAD: &[Key] = &[
    Key::new("document.machine", Kind::Text, "Expander EX-48", "Name of the machine on the first page.").optional("the title of its scenario"),
    Key::new("document.author", Kind::Text, "A. Engineer", "Who is responsible for the document.").optional("a line is left for the name"),
    Key::new("document.revision", Kind::Text, "B", "Revision of the document.").optional("none is named"),
    Key::new("document.environment", Kind::Text, "dry nitrogen, 20 degC", "Gas or vacuum, temperature, dirt about the bearings.").optional("the document says that it is not given"),
    Key::new("document.test_case", Kind::Text, "power lost", "Case of the planned test, whose signals are predicted.").optional("the first case"),
];
#[rustfmt::skip]
const CASE: &[Key] = &[
    Key::new("case.name", Kind::Text, "power lost", "Name of a case of the scenario."),
    Key::new("case.expected", Kind::Text, "five times in 20 years", "How often it is expected.").optional("the document says that it is not given"),
    Key::new("case.drops", Kind::Count, "10", "So many of it are run in a row, each with the wear and the grease that those before left.").within(Range::FromTo(2.0, MOST_DROPS)).optional("one"),
];
#[rustfmt::skip]
const REQUIREMENT: &[Key] = &[
    Key::new("requirement.text", Kind::Text, "The thrust bearing carries a surge", "What is required."),
    Key::new("requirement.why", Kind::Text, "its axial magnet is taken to hold", "Why no result answers it."),
    Key::new("requirement.source", Kind::Text, "contract 12.3", "Where it comes from.").optional("the document says that it has none"),
];

/// What a document says that no run knows.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct StudyDocument {
    /// Name of the machine.
    pub machine: Option<String>,
    /// Who is responsible.
    pub author: Option<String>,
    /// Its revision.
    pub revision: Option<String>,
    /// Gas or vacuum, temperature, dirt.
    pub environment: Option<String>,
    /// The case of the planned test.
    pub test_case: Option<String>,
    /// What is said of cases.
    pub cases: Vec<CaseOfDocument>,
    /// What is required and no result answers.
    pub requirements: Vec<Requirement>,
}

/// What a document says of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseOfDocument {
    /// Its name.
    pub name: String,
    /// How often it is expected.
    pub expected: Option<String>,
    /// So many are run in a row; 1: each begins as new.
    pub drops: usize,
}

/// What is required and no result answers.
#[derive(Clone, Debug, PartialEq)]
pub struct Requirement {
    /// What is required.
    pub text: String,
    /// Why no result answers it.
    pub why: String,
    /// Where it comes from.
    pub source: Option<String>,
}

impl StudyDocument {
    /// Reads the sections of the document; `cases` are those that are run, none of a study that is no qualification.
    ///
    /// # Errors
    /// Sections beside another design, and cases that are not run.
    pub(super) fn of(file: &str, sections: &Sections, cases: &[String]) -> Result<StudyDocument> {
        let read = |name: &'static str, keys: &'static [Key], written| {
            let head = (name.to_string(), name);
            let table: Table = Table::read(file, head, keys, written, &[])?;
            if cases.is_empty() {
                let found = "a section that has no effect";
                let allowed = "it is used only with [design] kind = \"qualification\"";
                return table.refuse(Code::UnusedKey, "", found, allowed);
            }
            let mut texts = keys.iter().map(Key::name);
            match texts.find(|key| table.text(key).is_some_and(|text| text.trim().is_empty())) {
                None => Ok(table),
                Some(key) => table.refuse(
                    Code::UnknownWord,
                    key,
                    "a text without letters",
                    "a text is needed",
                ),
            }
        };
        let known = |table: &Table, key: &str| match table.text(key) {
            Some(case) if !cases.iter().any(|known| known == case) => {
                let allowed = format!("one of the cases {} is needed", cases.join(", "));
                let problem = table.problem(Code::UnknownWord, key, quoted(case), allowed);
                Err(problem.with_hint(did_you_mean(case, cases.iter().map(String::as_str))))
            }
            case => Ok(case.map(str::to_string)),
        };
        let text = |table: &Table, key: &str| table.text(key).map(str::to_string);
        let mut document = StudyDocument::default();
        for (k, written) in sections.all("document").iter().enumerate() {
            let table = read("document", HEAD, written)?;
            if k > 0 {
                return table.refuse(Code::Conflict, "", "a second [document]", "one is needed");
            }
            document = StudyDocument {
                machine: text(&table, "machine"),
                author: text(&table, "author"),
                revision: text(&table, "revision"),
                environment: text(&table, "environment"),
                test_case: known(&table, "test_case")?,
                ..document
            };
        }
        for written in sections.all("case") {
            let table = read("case", CASE, written)?;
            let name = known(&table, "name")?.unwrap_or_default();
            if document.cases.iter().any(|case| case.name == name) {
                let allowed = "each case once is needed";
                return table.refuse(Code::Conflict, "name", quoted(&name), allowed);
            }
            document.cases.push(CaseOfDocument {
                name,
                expected: text(&table, "expected"),
                drops: table.count("drops").unwrap_or(1),
            });
        }
        for written in sections.all("requirement") {
            let table = read("requirement", REQUIREMENT, written)?;
            document.requirements.push(Requirement {
                text: text(&table, "text").unwrap_or_default(),
                why: text(&table, "why").unwrap_or_default(),
                source: text(&table, "source"),
            });
        }
        Ok(document)
    }

    /// The sections as a file has them.
    pub(super) fn toml(&self) -> String {
        let section = |head: &str, keys: &[(&str, &Option<String>)]| {
            let given = keys
                .iter()
                .filter_map(|(key, text)| Some((key, text.as_ref()?)));
            let lines: String = given
                .map(|(key, text)| format!("{key} = {}\n", quoted(text)))
                .collect();
            match lines.is_empty() {
                true => lines,
                false => format!("\n{head}\n{lines}"),
            }
        };
        let mut out = section(
            "[document]",
            &[
                ("machine", &self.machine),
                ("author", &self.author),
                ("revision", &self.revision),
                ("environment", &self.environment),
                ("test_case", &self.test_case),
            ],
        );
        for case in &self.cases {
            let name = Some(case.name.clone());
            out.push_str(&section(
                "[[case]]",
                &[("name", &name), ("expected", &case.expected)],
            ));
            if case.drops > 1 {
                out.push_str(&format!("drops = {}\n", case.drops));
            }
        }
        for own in &self.requirements {
            let [text, why] = [&own.text, &own.why].map(|text| Some(text.clone()));
            let keys = [("text", &text), ("why", &why), ("source", &own.source)];
            out.push_str(&section("[[requirement]]", &keys));
        }
        out
    }

    /// What is said of a case.
    pub fn case(&self, name: &str) -> Option<&CaseOfDocument> {
        self.cases.iter().find(|case| case.name == name)
    }
}
