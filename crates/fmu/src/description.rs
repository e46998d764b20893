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
        let body = self.body(version);
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

    fn body(&self, version: Version) -> String {
        let two = version == Version::Two;
        let mut out = match two {
            true => " numberOfEventIndicators=\"0\"",
            false => "",
        }
        .to_string();
        let (state, early) = match two {
            true => ("FMUstate", ""),
            false => ("FMUState", " mightReturnEarlyFromDoStep=\"true\""),
        };
        let _ = write!(
            out,
            ">\n  <CoSimulation modelIdentifier=\"{IDENTIFIER}\" canHandleVariableCommunicationStepSize=\"true\" canGetAndSet{state}=\"true\" \
             canSerialize{state}=\"true\"{early}/>\n  <UnitDefinitions>\n"
        );
        let used: BTreeSet<&str> = self.variables.iter().map(|own| &own.unit[..]).collect();
        for unit in used.into_iter().filter(|unit| !unit.is_empty()) {
            let _ = writeln!(out, "    <Unit name=\"{}\"/>", quoted(unit));
        }
        let _ = write!(
            out,
            "  </UnitDefinitions>\n  <DefaultExperiment startTime=\"0\" stopTime=\"{:?}\"/>\n  <ModelVariables>\n",
            self.end
        );
        for (reference, own) in self.variables.iter().enumerate() {
            out += &variable(own, reference, two);
        }
        out += "  </ModelVariables>\n  <ModelStructure>\n";
        let all = || self.variables.iter().enumerate();
        let inputs: Vec<usize> = all()
            .filter(|(_, own)| matches!(own.role, Role::Input(_)))
            .map(|(reference, _)| reference)
            .collect();
        // version 2.0 counts from 1
        let first = usize::from(two);
        let (mut outputs, mut initial) = (String::new(), String::new());
        for (reference, own) in all() {
            let Role::Output(_, feeds) = &own.role else {
                continue;
            };
            let at = reference + first;
            let feeds = feeds
                .iter()
                .map(|place| (inputs[*place] + first).to_string());
            let feeds = feeds.collect::<Vec<_>>().join(" ");
            let (output, unknown, key) = match two {
                true => ("Unknown", "Unknown", "index"),
                false => ("Output", "InitialUnknown", "valueReference"),
            };
            let _ = writeln!(
                outputs,
                "      <{output} {key}=\"{at}\" dependencies=\"{feeds}\"/>"
            );
            let _ = writeln!(initial, "      <{unknown} {key}=\"{at}\"/>");
        }
        out += &match two {
            true => format!(
                "<Outputs>\n{outputs}</Outputs>\n<InitialUnknowns>\n{initial}</InitialUnknowns>\n"
            ),
            false => outputs + &initial,
        };
        out + "  </ModelStructure>\n"
    }
}

/// The element of a variable.
fn variable(own: &Variable, reference: usize, two: bool) -> String {
    let [causality, variability, initial] = match own.role {
        Role::Time => ["independent", "continuous", ""],
        Role::Input(_) => ["input", "continuous", ""],
        Role::Output(..) => ["output", "continuous", "calculated"],
        Role::Parameter(_) | Role::Choice(_) => ["parameter", "fixed", "exact"],
    };
    let common = format!(
        " name=\"{}\" valueReference=\"{reference}\"{} causality=\"{causality}\" variability=\"{variability}\"{}",
        quoted(&own.name),
        attribute("description", &own.meaning),
        attribute("initial", initial)
    );
    let (kind, more) = match &own.kind {
        Kind::Real(start) => {
            let start = start.map_or(String::new(), |start| format!(" start=\"{start:?}\""));
            let kind = if two { "Real" } else { "Float64" };
            (kind, attribute("unit", &own.unit) + &start)
        }
        Kind::Boolean(start) => ("Boolean", format!(" start=\"{start}\"")),
        Kind::Text if two => ("String", " start=\"\"".to_string()),
        Kind::Text => return format!("    <String{common}><Start value=\"\"/></String>\n"),
    };
    match two {
        true => format!("    <ScalarVariable{common}><{kind}{more}/></ScalarVariable>\n"),
        false => format!("    <{kind}{common}{more}/>\n"),
    }
}
