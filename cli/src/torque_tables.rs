//! What `auxbear torque` prints: tables over acceleration, load, law and lubricant.

use crate::digits::four_digits;
use crate::{console, limits};
use auxbear::outcome::{Outcome, Value};
use auxbear::units;
use std::path::Path;

/// The text printed after a computation.
pub fn text(path: &Path, outcome: &Outcome) -> String {
    let found = Found(outcome);
    let mut text = format!("{}\n{}\n", outcome.title, found.place());
    text.push_str(&format!("\n{}", console::table(&found.accelerations())));
    if let Some(Value::Number(power)) = found.value("power_loss") {
        text.push_str(&format!("power loss M Ω {} W\n", four_digits(*power)));
    }
    if let Some(Value::Number(_)) = found.value("starting_moment") {
        let moment = found.number("starting_moment", "N mm");
        text.push_str(&format!("at rest {moment} N mm to start\n"));
    }
    if found.list("loads").len() > 1 {
        text.push_str(&format!("\n{}", console::table(&found.loads())));
    }
    if found.laws().len() > 1 {
        text.push_str(&format!("\n{}", console::table(&found.laws())));
    }
    if found.lubricants().len() > 1 {
        text.push_str(&format!("\n{}", console::table(&found.lubricants())));
    }
    text.push('\n');
    text.push_str(&limits::text(outcome));
    text.push_str(&format!("{}\n", path.join("report.html").display()));
    text
}

/// What was computed, by name.
struct Found<'a>(&'a Outcome);

impl Found<'_> {
    fn value(&self, name: &str) -> Option<&Value> {
        let mut quantities = self.0.quantities.iter();
        let quantity = quantities.find(|quantity| quantity.name == name);
        quantity.map(|quantity| &quantity.value)
    }

    fn list(&self, name: &str) -> &[f64] {
        match self.value(name) {
            Some(Value::List(list)) => list,
            _ => &[],
        }
    }

    /// A number in a unit, without the unit; a dash where there is none.
    fn number(&self, name: &str, unit: &str) -> String {
        match self.value(name) {
            Some(Value::Number(number)) => in_unit(*number, unit),
            _ => "-".to_string(),
        }
    }

    /// Why a number is not there; empty where it is.
    fn why(&self, name: &str) -> String {
        match self.value(name) {
            Some(Value::None { why }) => why.clone(),
            _ => String::new(),
        }
    }

    /// Where the tables hold that vary one thing.
    fn place(&self) -> String {
        let part = |name, unit: &str| match self.value(name) {
            Some(Value::Number(number)) => Some(format!("{} {unit}", in_unit(*number, unit))),
            _ => None,
        };
        let parts = [
            part("speed", "rad/s"),
            part("radial_load", "N"),
            part("temperature", "degC"),
            part("viscosity", "mm^2/s"),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        format!("at {}; moments in N mm", parts.join(", "))
    }

    fn accelerations(&self) -> Vec<[String; 8]> {
        let head = [
            "acceleration",
            "M0",
            "M1",
            "inertia, inner",
            "inertia, outer",
            "loss F",
            "t_I",
            "t_O",
        ];
        let steady = ["speed_dependent_moment", "load_dependent_moment"];
        let [m0, m1] = steady.map(|name| self.number(name, "N mm"));
        let columns = [
            "inner_race_inertia_moments",
            "outer_race_inertia_moments",
            "acceleration_loss_moments",
            "inner_race_moments",
            "outer_race_moments",
        ]
        .map(|name| self.list(name));
        let mut rows = vec![head.map(String::from)];
        for (row, acceleration) in self.list("accelerations").iter().enumerate() {
            let [inner, outer, loss, t_i, t_o] = columns.map(|column| {
                column
                    .get(row)
                    .map_or("-".into(), |si| in_unit(*si, "N mm"))
            });
            let acceleration = format!("{} rad/s^2", four_digits(*acceleration));
            rows.push([
                acceleration,
                m0.clone(),
                m1.clone(),
                inner,
                outer,
                loss,
                t_i,
                t_o,
            ]);
        }
        rows
    }

    fn loads(&self) -> Vec<[String; 3]> {
        let mut rows = vec![["load", "M1", "M"].map(String::from)];
        let m1 = self.list("load_dependent_moments_over_load");
        let sums = self.list("friction_moments_over_load");
        for ((load, m1), sum) in self.list("loads").iter().zip(m1).zip(sums) {
            rows.push([
                format!("{} N", four_digits(*load)),
                in_unit(*m1, "N mm"),
                in_unit(*sum, "N mm"),
            ]);
        }
        rows
    }

    fn laws(&self) -> Vec<[String; 5]> {
        const END: &str = "_friction_moment";
        let mut rows = vec![["law", "M0", "M1", "M", ""].map(String::from)];
        let names = self
            .0
            .quantities
            .iter()
            .map(|quantity| quantity.name.as_str());
        for name in names.filter(|name| name.starts_with("law_") && name.ends_with(END)) {
            let law = name.trim_end_matches(END);
            let part = |end: &str| self.number(&format!("{law}_{end}"), "N mm");
            rows.push([
                law.trim_start_matches("law_").replace('_', " "),
                part("speed_dependent_moment"),
                part("load_dependent_moment"),
                part("friction_moment"),
                self.why(name),
            ]);
        }
        rows
    }

    fn lubricants(&self) -> Vec<[String; 4]> {
        let mut rows = vec![["lubricant", "mm^2/s", "M", ""].map(String::from)];
        for number in 1.. {
            let name = format!("lubricant_{number}");
            let Some(Value::Text(lubricant)) = self.value(&name) else {
                break;
            };
            let moment = format!("{name}_friction_moment");
            rows.push([
                lubricant.clone(),
                self.number(&format!("{name}_viscosity"), "mm^2/s"),
                self.number(&moment, "N mm"),
                self.why(&moment),
            ]);
        }
        rows
    }
}

/// The number alone, to four digits.
fn in_unit(si: f64, unit: &str) -> String {
    let text = units::display(si, unit).unwrap_or_default();
    let number = text.split(' ').next().unwrap_or_default();
    number.parse().map_or("-".to_string(), four_digits)
}
