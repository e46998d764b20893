//! Where a value comes from.

/// Where a value comes from; every value of a run carries it to the resolved file and the report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Provenance {
    /// By the user, without further words.
    Given,
    /// By the user, who names a source.
    GivenWithSource(String),
    /// By the user, who calls it an assumption.
    Assumed(String),
    /// A default that is a convention, with its reason.
    Default(String),
    /// A default that is an assumption, with its reason.
    DefaultAssumed(String),
    /// From the bearing catalogue.
    Catalogue {
        /// Name of the bearing.
        bearing: String,
        /// How sure the catalogue is, for example "catalogue", "derived" or "assumed".
        mark: String,
        /// Source of the number.
        source: String,
    },
    /// Computed from other values.
    Derived(String),
}

impl Provenance {
    /// One word for tables: `given`, `assumed`, `default`, `catalogue` or `derived`.
    pub fn mark(&self) -> &'static str {
        match self {
            Provenance::Given | Provenance::GivenWithSource(_) => "given",
            Provenance::Assumed(_) | Provenance::DefaultAssumed(_) => "assumed",
            Provenance::Default(_) => "default",
            Provenance::Catalogue { mark, .. } if mark == "assumed" => "assumed",
            Provenance::Catalogue { .. } => "catalogue",
            Provenance::Derived(_) => "derived",
        }
    }

    /// Source, reason or way of computing; empty where the user gave none.
    pub fn note(&self) -> String {
        match self {
            Provenance::Given => String::new(),
            Provenance::GivenWithSource(text)
            | Provenance::Assumed(text)
            | Provenance::Default(text)
            | Provenance::Derived(text) => text.clone(),
            Provenance::DefaultAssumed(text) => format!("default: {text}"),
            Provenance::Catalogue {
                bearing,
                mark,
                source,
            } => format!("{bearing}, {mark}: {source}"),
        }
    }
}
