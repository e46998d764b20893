//! From the raw values of a device to the values that were measured: the scales of a file's properties.
//!
//! A scale takes the values of another by its number, or raw values; the last is the channel's.

use super::layout::PLAIN;
use crate::file::Value;
use statistics::interpolation::held;

/// Most scales of a channel; devices use a handful.
const MOST: u32 = 64;
/// Most coefficients of a scale, or points of its table.
const MOST_NUMBERS: u32 = 1 << 16;

/// What a scale computes.
#[derive(Debug)]
enum Law {
    /// Raw values as they are, by the number of their DAQmx scaler or [`PLAIN`].
    Raw(u32),
    /// Intercept + slope × input.
    Linear {
        slope: f64,
        intercept: f64,
        input: usize,
    },
    /// Sum of coefficient i × inputⁱ.
    Polynomial {
        coefficients: Vec<f64>,
        input: usize,
    },
    /// Straight lines between points, the nearest point's value outside; the inputs ascend.
    Table {
        inputs: Vec<f64>,
        outputs: Vec<f64>,
        input: usize,
    },
    /// Right + factor × left.
    Sum {
        left: usize,
        right: usize,
        factor: f64,
    },
}

/// The scales of a channel, each after those it takes.
#[derive(Debug)]
pub struct Scaling {
    laws: Vec<Law>,
    /// Values of each law, for the piece that is being scaled.
    values: Vec<Vec<f64>>,
}

/// Where properties are looked up.
type Lookup<'a> = dyn Fn(&str) -> Option<&'a Value> + 'a;

impl Scaling {
    /// The scales of the properties; none where there are none.
    ///
    /// None too where the file says that its values are scaled. An error says why they cannot be applied.
    pub fn of(property: &Lookup) -> Result<Option<Scaling>, String> {
        let Some(count) = number(property, "NI_Number_Of_Scales").filter(|&count| count >= 1.0)
        else {
            return Ok(None);
        };
        if matches!(property("NI_Scaling_Status"), Some(Value::Text(status)) if status != "unscaled")
        {
            return Ok(None);
        }
        if count > f64::from(MOST) {
            return Err(format!("{count} scales"));
        }
        let mut scaling = Scaling {
            laws: Vec::new(),
            values: Vec::new(),
        };
        let mut known = Vec::new();
        scaling.add(property, count as u32 - 1, &mut known)?;
        if scaling.laws.iter().all(|law| matches!(law, Law::Raw(_))) {
            return Ok(None);
        }
        scaling.values.resize_with(scaling.laws.len(), Vec::new);
        Ok(Some(scaling))
    }

    /// Adds a scale after those it takes, unless it is there already; returns its place.
    fn add(
        &mut self,
        property: &Lookup,
        scale: u32,
        known: &mut Vec<(u32, usize)>,
    ) -> Result<usize, String> {
        if let Some(&(_, place)) = known.iter().find(|(number, _)| *number == scale) {
            return Ok(place);
        }
        let law = match property(&format!("NI_Scale[{scale}]_Scale_Type")) {
            Some(Value::Text(kind)) if scale != PLAIN => self.law(property, scale, kind, known)?,
            _ => Law::Raw(scale),
        };
        self.laws.push(law);
        known.push((scale, self.laws.len() - 1));
        Ok(self.laws.len() - 1)
    }

    /// The law of a scale of a kind.
    fn law(
        &mut self,
        property: &Lookup,
        scale: u32,
        kind: &str,
        known: &mut Vec<(u32, usize)>,
    ) -> Result<Law, String> {
        let get = |name: &str| number(property, &format!("NI_Scale[{scale}]_{kind}_{name}"));
        let need =
            |name: &str| get(name).ok_or_else(|| format!("scale {scale} ({kind}) lacks {name}"));
        let list = |name: &str| -> Result<Vec<f64>, String> {
            let count = match get(&format!("{name}_Size")) {
                // Older writers state no size of a polynomial: it has four coefficients, as npTDMS takes it.
                None if kind == "Polynomial" => 4.0,
                None => need(&format!("{name}_Size"))?,
                Some(count) => count,
            };
            if !(0.0..=f64::from(MOST_NUMBERS)).contains(&count) {
                return Err(format!("scale {scale} ({kind}) has {count} {name}"));
            }
            let all = 0..count as u32;
            all.map(|i| need(&format!("{name}[{i}]"))).collect()
        };
        let mut input = |name: &str| -> Result<usize, String> {
            // A scale takes lower numbers only, so that none takes itself.
            let source = get(name).map_or(PLAIN, |source| source as u32);
            if source >= scale && source != PLAIN {
                return Err(format!("scale {scale} ({kind}) takes scale {source}"));
            }
            self.add(property, source, known)
        };
        Ok(match kind {
            "Linear" => Law::Linear {
                slope: need("Slope")?,
                intercept: need("Y_Intercept")?,
                input: input("Input_Source")?,
            },
            "Polynomial" => Law::Polynomial {
                coefficients: list("Coefficients")?,
                input: input("Input_Source")?,
            },
            "Table" => {
                let inputs = list("Pre_Scaled_Values")?;
                let mut points: Vec<(f64, f64)> =
                    inputs.into_iter().zip(list("Scaled_Values")?).collect();
                points.sort_by(|a, b| a.0.total_cmp(&b.0));
                if points.is_empty() {
                    return Err(format!("scale {scale} (Table) is empty"));
                }
                let (inputs, outputs) = points.into_iter().unzip();
                Law::Table {
                    inputs,
                    outputs,
                    input: input("Input_Source")?,
                }
            }
            "Add" | "Subtract" => Law::Sum {
                left: input("Left_Operand_Input_Source")?,
                right: input("Right_Operand_Input_Source")?,
                factor: if kind == "Add" { 1.0 } else { -1.0 },
            },
            _ => return Err(format!("scale {scale} is of the kind {kind}")),
        })
    }

    /// The raw values that are needed, by the number of their scaler.
    pub fn needs(&self) -> impl Iterator<Item = u32> {
        self.laws.iter().filter_map(|law| match law {
            Law::Raw(scale) => Some(*scale),
            _ => None,
        })
    }

    /// Scales a piece: `raw` gives the raw values of a scaler, as many as `values` has.
    pub fn apply<'a>(&mut self, raw: impl Fn(u32) -> &'a [f64], values: &mut [f64]) {
        for (place, law) in self.laws.iter().enumerate() {
            let (before, rest) = self.values.split_at_mut(place);
            let Some(out) = rest.first_mut() else {
                continue;
            };
            out.clear();
            let input = |input: &usize| before[*input].iter().copied();
            match law {
                Law::Raw(scale) => out.extend_from_slice(raw(*scale)),
                Law::Linear {
                    slope,
                    intercept,
                    input: from,
                } => out.extend(input(from).map(|x| intercept + slope * x)),
                Law::Polynomial {
                    coefficients,
                    input: from,
                } => {
                    let sum = |x| coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c);
                    out.extend(input(from).map(sum));
                }
                Law::Table {
                    inputs,
                    outputs,
                    input: from,
                } => out.extend(input(from).map(|x| held(inputs, outputs, x))),
                Law::Sum {
                    left,
                    right,
                    factor,
                } => out.extend(input(left).zip(input(right)).map(|(l, r)| r + factor * l)),
            }
        }
        if let Some(last) = self.values.last() {
            for (value, scaled) in values.iter_mut().zip(last) {
                *value = *scaled;
            }
        }
    }
}

/// A property that is a number.
fn number(property: &Lookup, name: &str) -> Option<f64> {
    match property(name) {
        Some(Value::Number(number)) => Some(*number),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scales one raw value by the scales of the properties.
    fn scaled(properties: &[(&str, Value)], raw: f64) -> Result<Option<f64>, String> {
        let lookup = |name: &str| properties.iter().find(|p| p.0 == name).map(|p| &p.1);
        Ok(Scaling::of(&lookup)?.map(|mut scaling| {
            let mut value = [0.0];
            scaling.apply(|_| std::slice::from_ref(&raw), &mut value);
            value[0]
        }))
    }

    fn text(text: &str) -> Value {
        Value::Text(text.to_owned())
    }

    #[test]
    fn a_chain_of_linear_and_polynomial_is_applied_in_its_order() {
        let n = Value::Number;
        let properties = [
            ("NI_Number_Of_Scales", n(2.0)),
            ("NI_Scaling_Status", text("unscaled")),
            ("NI_Scale[0]_Scale_Type", text("Linear")),
            ("NI_Scale[0]_Linear_Slope", n(2.0)),
            ("NI_Scale[0]_Linear_Y_Intercept", n(1.0)),
            ("NI_Scale[0]_Linear_Input_Source", n(f64::from(u32::MAX))),
            ("NI_Scale[1]_Scale_Type", text("Polynomial")),
            ("NI_Scale[1]_Polynomial_Coefficients_Size", n(3.0)),
            ("NI_Scale[1]_Polynomial_Coefficients[0]", n(1.0)),
            ("NI_Scale[1]_Polynomial_Coefficients[1]", n(0.0)),
            ("NI_Scale[1]_Polynomial_Coefficients[2]", n(3.0)),
            ("NI_Scale[1]_Polynomial_Input_Source", n(0.0)),
        ];
        // 3 → 2·3 + 1 = 7 → 1 + 3·49 = 148.
        assert_eq!(scaled(&properties, 3.0), Ok(Some(148.0)));
    }

    #[test]
    fn a_scale_that_takes_itself_or_is_unknown_is_refused() {
        let n = Value::Number;
        let mut properties = vec![
            ("NI_Number_Of_Scales", n(1.0)),
            ("NI_Scale[0]_Scale_Type", text("Linear")),
            ("NI_Scale[0]_Linear_Slope", n(2.0)),
            ("NI_Scale[0]_Linear_Y_Intercept", n(1.0)),
            ("NI_Scale[0]_Linear_Input_Source", n(0.0)),
        ];
        assert!(scaled(&properties, 3.0).is_err());
        properties[1].1 = text("Thermocouple");
        assert!(scaled(&properties, 3.0).is_err_and(|why| why.contains("Thermocouple")));
    }

    #[test]
    fn scaled_values_are_not_scaled_again() {
        let n = Value::Number;
        let properties = [
            ("NI_Number_Of_Scales", n(1.0)),
            ("NI_Scaling_Status", text("scaled")),
            ("NI_Scale[0]_Scale_Type", text("Linear")),
            ("NI_Scale[0]_Linear_Slope", n(2.0)),
            ("NI_Scale[0]_Linear_Y_Intercept", n(1.0)),
        ];
        assert_eq!(scaled(&properties, 3.0), Ok(None));
    }

    #[test]
    fn a_polynomial_without_a_size_has_four_coefficients() {
        let n = Value::Number;
        let mut properties = vec![
            ("NI_Number_Of_Scales", n(1.0)),
            ("NI_Scale[0]_Scale_Type", text("Polynomial")),
            ("NI_Scale[0]_Polynomial_Coefficients[0]", n(1.5)),
            ("NI_Scale[0]_Polynomial_Coefficients[1]", n(0.01)),
            ("NI_Scale[0]_Polynomial_Coefficients[2]", n(0.0)),
            ("NI_Scale[0]_Polynomial_Coefficients[3]", n(1e-9)),
        ];
        // 1.5 + 0.01·1000 + 1e-9·1e9 = 12.5.
        let found = scaled(&properties, 1e3).unwrap().unwrap();
        assert!((found - 12.5).abs() < 1e-12, "{found}");
        properties.pop();
        assert!(scaled(&properties, 1e3).is_err());
    }
}
