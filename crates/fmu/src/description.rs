//! The description of a unit, `modelDescription.xml`.
//!
//! Written here: the types of `fmi-schema` 0.8 have no units of variables, no texts with a value and no empty lists of dependencies in
//! version 2.0, and an order of elements that its schema refuses.

use crate::variables::{Kind, Role, Variable};
use std::collections::BTreeSet;
use std::fmt::Write;

/// A version of the interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Version {
    /// FMI 2.0.
    Two,
    /// FMI 3.0.
    Three,
}

/// Name of the library in a unit.
pub(crate) const IDENTIFIER: &str = "auxbear";

/// What a description says.
pub(crate) struct Model<'a> {
    pub title: &'a str,
    pub variables: &'a [Variable],
    /// End of the run, s.
    pub end: f64,
    /// What makes units differ whose descriptions are alike.
    pub content: &'a str,
}

/// FNV-1a of 128 bits: a name for a content, in the form of a guid.
fn guid(of: &[&str]) -> String {
    let bytes = of.iter().flat_map(|text| text.bytes());
    let hash = bytes.fold(
        0x6c62_272e_07bb_0142_62b8_2175_6295_c58d_u128,
        |hash, byte| {
            (hash ^ u128::from(byte)).wrapping_mul(0x0000_0000_0100_0000_0000_0000_0000_013b)
        },
    );
    let text = format!("{hash:032x}");
    let parts = [
        &text[..8],
        &text[8..12],
        &text[12..16],
        &text[16..20],
        &text[20..],
    ];
    format!("{{{}}}", parts.join("-"))
}

/// A text within an attribute.
fn quoted(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for own in text.chars() {
        match own {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            own if own.is_control() => out.push(' '),
            own => out.push(own),
        }
    }
    out
}

/// An attribute, where it is not empty.
fn attribute(name: &str, value: &str) -> String {
    match value.is_empty() {
        true => String::new(),
        false => format!(" {name}=\"{}\"", quoted(value)),
    }
}

impl Model<'_> {
    /// The guid with the whole text.
    pub fn written(&self, version: Version) -> (String, String) {
        let body = match version {
            Version::Two => self.body_of_two(),
            Version::Three => self.body_of_three(),
        };
        let guid = guid(&[self.content, &body]);
        let (number, token) = match version {
            Version::Two => ("2.0", "guid"),
            Version::Three => ("3.0", "instantiationToken"),
        };
        let tool = concat!("auxbear ", env!("CARGO_PKG_VERSION"));
        let head = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"{number}\" modelName=\"{}\" {token}=\"{guid}\" \
             generationTool=\"{tool}\" variableNamingConvention=\"flat\"",
            quoted(self.title)
        );
        (guid, format!("{head}{body}</fmiModelDescription>\n"))
    }

    fn units(&self) -> String {
        let used: BTreeSet<&str> = (self.variables.iter())
            .map(|own| own.unit.as_str())
            .collect();
        let units = used.into_iter().filter(|unit| !unit.is_empty());
        units.fold(String::new(), |mut out, unit| {
            let _ = writeln!(out, "    <Unit name=\"{}\"/>", quoted(unit));
            out
        })
    }
    fn experiment(&self) -> String {
        format!(
            "  <DefaultExperiment startTime=\"0\" stopTime=\"{:?}\"/>\n",
            self.end
        )
    }
    /// Value references of inputs, in their order.
    fn inputs(&self) -> Vec<usize> {
        let all = self.variables.iter().enumerate();
        all.filter(|(_, own)| matches!(own.role, Role::Input(_)))
            .map(|(reference, _)| reference)
            .collect()
    }
    /// Outputs by their value references, with those of the inputs that they show at once, `first` more.
    fn outputs(&self, first: usize) -> impl Iterator<Item = (usize, String)> {
        let inputs = self.inputs();
        let all = self.variables.iter().enumerate();
        all.filter_map(move |(reference, own)| match &own.role {
            Role::Output(_, feeds) => {
                let feeds = feeds
                    .iter()
                    .map(|place| (inputs[*place] + first).to_string());
                Some((reference + first, feeds.collect::<Vec<_>>().join(" ")))
            }
            _ => None,
        })
    }

    fn body_of_two(&self) -> String {
        let mut out = format!(
            " numberOfEventIndicators=\"0\">\n  <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canHandleVariableCommunicationStepSize=\"true\" \
             canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\"/>\n"
        );
        let _ = write!(
            out,
            "  <UnitDefinitions>\n{}  </UnitDefinitions>\n",
            self.units()
        );
        out += &self.experiment();
        out += "  <ModelVariables>\n";
        for (reference, own) in self.variables.iter().enumerate() {
            let [causality, variability, initial] = match own.role {
                Role::Time => ["independent", "continuous", ""],
                Role::Input(_) => ["input", "continuous", ""],
                Role::Output(..) => ["output", "continuous", "calculated"],
                Role::Parameter(_) | Role::Choice(_) => ["parameter", "fixed", "exact"],
            };
            let _ = writeln!(
                out,
                "    <ScalarVariable name=\"{}\" valueReference=\"{reference}\"{} causality=\"{causality}\" variability=\"{variability}\"{}>{}</ScalarVariable>",
                quoted(&own.name),
                attribute("description", &own.meaning),
                attribute("initial", initial),
                match &own.kind {
                    Kind::Real(None) => format!("<Real{}/>", attribute("unit", &own.unit)),
                    Kind::Real(Some(start)) => format!(
                        "<Real{} start=\"{start:?}\"/>",
                        attribute("unit", &own.unit)
                    ),
                    Kind::Boolean(start) => format!("<Boolean start=\"{start}\"/>"),
                    Kind::Text => "<String start=\"\"/>".to_string(),
                }
            );
        }
        out += "  </ModelVariables>\n  <ModelStructure>\n    <Outputs>\n";
        for (index, feeds) in self.outputs(1) {
            let _ = writeln!(
                out,
                "      <Unknown index=\"{index}\" dependencies=\"{feeds}\"/>"
            );
        }
        out += "    </Outputs>\n    <InitialUnknowns>\n";
        for (index, _) in self.outputs(1) {
            let _ = writeln!(out, "      <Unknown index=\"{index}\"/>");
        }
        out += "    </InitialUnknowns>\n  </ModelStructure>\n";
        out
    }

    fn body_of_three(&self) -> String {
        let mut out = format!(
            ">\n  <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canHandleVariableCommunicationStepSize=\"true\" canGetAndSetFMUState=\"true\" \
             canSerializeFMUState=\"true\" mightReturnEarlyFromDoStep=\"true\"/>\n"
        );
        let _ = write!(
            out,
            "  <UnitDefinitions>\n{}  </UnitDefinitions>\n",
            self.units()
        );
        out += &self.experiment();
        out += "  <ModelVariables>\n";
        for (reference, own) in self.variables.iter().enumerate() {
            let [causality, variability, initial] = match own.role {
                Role::Time => ["independent", "continuous", ""],
                Role::Input(_) => ["input", "continuous", ""],
                Role::Output(..) => ["output", "continuous", "calculated"],
                Role::Parameter(_) | Role::Choice(_) => ["parameter", "fixed", "exact"],
            };
            let common = format!(
                "name=\"{}\" valueReference=\"{reference}\"{} causality=\"{causality}\" variability=\"{variability}\"{}",
                quoted(&own.name),
                attribute("description", &own.meaning),
                attribute("initial", initial)
            );
            let unit = attribute("unit", &own.unit);
            let _ = match &own.kind {
                Kind::Real(None) => writeln!(out, "    <Float64 {common}{unit}/>"),
                Kind::Real(Some(start)) => {
                    writeln!(out, "    <Float64 {common}{unit} start=\"{start:?}\"/>")
                }
                Kind::Boolean(start) => writeln!(out, "    <Boolean {common} start=\"{start}\"/>"),
                Kind::Text => writeln!(out, "    <String {common}><Start value=\"\"/></String>"),
            };
        }
        out += "  </ModelVariables>\n  <ModelStructure>\n";
        for (reference, feeds) in self.outputs(0) {
            let _ = writeln!(
                out,
                "    <Output valueReference=\"{reference}\" dependencies=\"{feeds}\"/>"
            );
        }
        for (reference, _) in self.outputs(0) {
            let _ = writeln!(out, "    <InitialUnknown valueReference=\"{reference}\"/>");
        }
        out += "  </ModelStructure>\n";
        out
    }
}
