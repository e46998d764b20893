//! Spring, damper and Maxwell branches by a measured dynamic stiffness: least squares without negative parts.

use model::mount::{DynamicStiffness, MaxwellBranch};
use nalgebra::{DMatrix, DVector};
use problem::{Code, Place, Problem};
use std::f64::consts::TAU;
use units::Unit;

/// A row of a table.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StiffnessRow {
    /// Frequency, rad/s.
    pub frequency: f64,
    /// Measured there.
    pub stiffness: DynamicStiffness,
}

/// A measured dynamic stiffness.
#[derive(Clone, Debug, PartialEq)]
pub struct MeasuredStiffness {
    /// Rows of rising frequency.
    pub rows: Vec<StiffnessRow>,
}

/// Columns of a table with an example of their units.
const COLUMNS: [(&str, &str); 3] = [("frequency", "rad/s"), ("storage", "N/m"), ("loss", "N/m")];

impl MeasuredStiffness {
    /// Reads a table: a header `frequency [Hz], storage [N/mm], loss [N/mm]` and a row for each frequency. The name stands for the file.
    ///
    /// # Errors
    /// What is no such table, with line and column.
    pub fn parse(text: &str, file: &str) -> problem::Result<Self> {
        let refuse = |line: usize, key: &str, found: String, allowed: String| {
            let place = Place::Line { line, column: 1 };
            Problem::new(Code::SectionTable, file, found, allowed)
                .at(place)
                .on_key(key)
        };
        let lines = (1..).zip(text.lines());
        let mut lines = lines.filter(|(_, line)| !line.trim().is_empty() && !line.starts_with('#'));
        let (at, header) = lines.next().unwrap_or((1, ""));
        let apart = ['\t', ';', ',']
            .into_iter()
            .find(|own| header.contains(*own))
            .unwrap_or(',');
        let heads: Vec<&str> = header.split(apart).map(str::trim).collect();
        let column = |(name, si): (&str, &str)| {
            let own =
                |head: &&str| head.split(['[', '(']).next().unwrap_or_default().trim() == name;
            let allowed =
                format!("a column \"{name} [{si}]\", with a unit of its dimension, is needed");
            let Some(k) = heads.iter().position(own) else {
                return Err(refuse(
                    at,
                    name,
                    format!("the header \"{header}\""),
                    allowed,
                ));
            };
            let unit = heads[k]
                .split_once(['[', '('])
                .map(|own| own.1.trim_end_matches([']', ')']));
            let unit = unit.and_then(|unit| Unit::parse(unit.trim()).ok());
            let is = |own: &Unit, other: &str| {
                Unit::parse(other).is_ok_and(|other| other.dimension() == own.dimension())
            };
            match unit {
                Some(unit) if is(&unit, si) => Ok((k, unit, 1.0)),
                // turns a second
                Some(unit) if name == "frequency" && is(&unit, "Hz") => Ok((k, unit, TAU)),
                _ => Err(refuse(
                    at,
                    name,
                    format!("the column \"{}\"", heads[k]),
                    allowed,
                )),
            }
        };
        let columns = COLUMNS
            .map(column)
            .into_iter()
            .collect::<problem::Result<Vec<_>>>()?;
        let mut rows: Vec<StiffnessRow> = Vec::new();
        for (at, line) in lines {
            let cells: Vec<&str> = line.split(apart).map(str::trim).collect();
            let mut numbers = [0.0; 3];
            for (number, ((k, unit, factor), (name, _))) in
                numbers.iter_mut().zip(columns.iter().zip(COLUMNS))
            {
                let cell = cells.get(*k).copied().unwrap_or_default();
                let value = cell
                    .parse::<f64>()
                    .ok()
                    .map(|value| factor * unit.to_si(value));
                let Some(value) = value.filter(|value| value.is_finite()) else {
                    let allowed = "a number is needed".to_string();
                    return Err(refuse(at, name, format!("\"{cell}\""), allowed));
                };
                if name != "storage" && value < 0.0 {
                    let allowed = "0 or more is needed: a mount takes energy, and frequencies are counted from 0";
                    return Err(refuse(at, name, cell.to_string(), allowed.to_string()));
                }
                *number = value;
            }
            let [frequency, storage, loss] = numbers;
            if storage == 0.0 && loss == 0.0 {
                let allowed = "a row with a stiffness is needed: nothing was measured there";
                let found = "storage and loss of 0".to_string();
                return Err(refuse(at, "storage", found, allowed.to_string()));
            }
            if frequency <= rows.last().map_or(0.0, |row| row.frequency) {
                let found = format!("{} after a frequency not below it", cells[columns[0].0]);
                let allowed = "rising frequencies above 0, each once, are needed";
                return Err(refuse(at, "frequency", found, allowed.to_string()));
            }
            let stiffness = DynamicStiffness { storage, loss };
            rows.push(StiffnessRow {
                frequency,
                stiffness,
            });
        }
        let table = MeasuredStiffness { rows };
        let unknowns = 2 + table.times().len();
        if table.rows.len() < unknowns {
            let found = format!("{} rows for {unknowns} unknowns", table.rows.len());
            let allowed =
                "as many rows as spring, damper and one branch a decade have unknowns are needed";
            return Err(refuse(at, "frequency", found, allowed.to_string()));
        }
        Ok(table)
    }

    /// Decades of frequency that it covers.
    pub fn decades(&self) -> f64 {
        let ends = [self.rows.first(), self.rows.last()];
        let [low, high] = ends.map(|row| row.map_or(1.0, |row| row.frequency));
        (high / low).log10()
    }

    /// Relaxation times of whole decades whose loss peaks within the table, s.
    fn times(&self) -> Vec<f64> {
        let ends = [self.rows.last(), self.rows.first()];
        let [low, high] = ends.map(|row| row.map_or(0.0, |row| -row.frequency.log10()));
        let whole = (low - 1e-9).ceil() as i32..=(high + 1e-9).floor() as i32;
        whole.map(|power| 10f64.powi(power)).collect()
    }
}

/// A fitted mount.
#[derive(Clone, Debug, PartialEq)]
pub struct Fit {
    /// Stiffness, N/m.
    pub stiffness: f64,
    /// Damping, N s/m.
    pub damping: f64,
    /// Maxwell branches with some stiffness.
    pub branches: Vec<MaxwellBranch<f64>>,
}

impl Fit {
    /// By a table; each row counts by its distance over the size of its stiffness.
    pub fn of(table: &MeasuredStiffness) -> Self {
        let times = table.times();
        let (rows, count) = (&table.rows, table.rows.len());
        let size = |row: &StiffnessRow| row.stiffness.storage.hypot(row.stiffness.loss);
        let branch = |stiffness: f64, time: &f64| MaxwellBranch {
            stiffness,
            rate: 1.0 / time,
        };
        let part = |row: &StiffnessRow, k: usize| match k {
            0 => [1.0, 0.0],
            1 => [0.0, row.frequency],
            _ => {
                let own = branch(1.0, &times[k - 2]).dynamic_stiffness(row.frequency);
                [own.storage, own.loss]
            }
        };
        let mut a = DMatrix::from_fn(2 * count, 2 + times.len(), |i, k| {
            part(&rows[i / 2], k)[i % 2] / size(&rows[i / 2])
        });
        let b = DVector::from_fn(2 * count, |i, _| {
            let row = &rows[i / 2];
            [row.stiffness.storage, row.stiffness.loss][i % 2] / size(row)
        });
        let lengths: Vec<f64> = a.column_iter().map(|own| own.norm()).collect();
        for (mut own, length) in a.column_iter_mut().zip(&lengths) {
            own /= *length;
        }
        let found = not_negative(&a, &b);
        let found: Vec<f64> = found
            .iter()
            .zip(&lengths)
            .map(|(own, length)| own / length)
            .collect();
        let branches = found[2..]
            .iter()
            .zip(&times)
            .map(|(own, time)| branch(*own, time));
        Fit {
            stiffness: found[0],
            damping: found[1],
            branches: branches.filter(|own| own.stiffness > 0.0).collect(),
        }
    }

    /// At a frequency, rad/s.
    pub fn at(&self, frequency: f64) -> DynamicStiffness {
        let start = DynamicStiffness {
            storage: self.stiffness,
            loss: self.damping * frequency,
        };
        let branches = self.branches.iter();
        branches.fold(start, |sum, own| sum + own.dynamic_stiffness(frequency))
    }

    /// Distance to each row over the size of its stiffness.
    fn errors<'a>(&'a self, table: &'a MeasuredStiffness) -> impl Iterator<Item = f64> + 'a {
        table.rows.iter().map(|row| {
            let (ours, theirs) = (self.at(row.frequency), row.stiffness);
            let distance = (ours.storage - theirs.storage).hypot(ours.loss - theirs.loss);
            distance / theirs.storage.hypot(theirs.loss)
        })
    }

    /// The largest of them.
    pub fn worst(&self, table: &MeasuredStiffness) -> f64 {
        self.errors(table).fold(0.0, f64::max)
    }

    /// Their root mean square.
    pub fn mean(&self, table: &MeasuredStiffness) -> f64 {
        let sum: f64 = self.errors(table).map(|own| own * own).sum();
        (sum / table.rows.len() as f64).sqrt()
    }

    /// Lines for the section `mount` of a scenario, with seven digits.
    ///
    /// # Errors
    /// A mount has a spring, and the table shows none.
    pub fn lines(&self) -> Result<String, String> {
        if self.stiffness <= 0.0 {
            let why = "the table shows no static stiffness, and mount.stiffness must be above 0";
            return Err(why.to_string());
        }
        let list = |unit: &str, of: fn(&MaxwellBranch<f64>) -> f64| {
            let text = |own: &MaxwellBranch<f64>| format!("\"{:.6e} {unit}\"", of(own));
            self.branches
                .iter()
                .map(text)
                .collect::<Vec<_>>()
                .join(", ")
        };
        let mut out = format!(
            "stiffness = \"{:.6e} N/m\"\ndamping = \"{:.6e} N s/m\"",
            self.stiffness, self.damping
        );
        if !self.branches.is_empty() {
            out += &format!(
                "\nbranch_stiffness = [{}]\nbranch_time = [{}]",
                list("N/m", |own| own.stiffness),
                list("s", |own| 1.0 / own.rate)
            );
        }
        Ok(out)
    }
}

/// The x ≥ 0 with the least |A x - b|: Lawson and Hanson's active set.
fn not_negative(a: &DMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    let count = a.ncols();
    let (mut x, mut free) = (DVector::zeros(count), Vec::<usize>::new());
    // each pass frees one unknown and holds some: a bound far above what tables need
    for _ in 0..30 * count {
        let slope = a.tr_mul(&(b - a * &x));
        let held = (0..count).filter(|k| !free.contains(k) && slope[*k] > 1e-13);
        let Some(next) = held.max_by(|i, j| slope[*i].total_cmp(&slope[*j])) else {
            break;
        };
        free.push(next);
        loop {
            let own = a.select_columns(&free);
            let Ok(best) = own.svd(true, true).solve(b, 1e-14) else {
                return x;
            };
            let below = (0..free.len()).filter(|k| best[*k] <= 0.0);
            let share = |k: &usize| x[free[*k]] / (x[free[*k]] - best[*k]);
            let step = below.map(|k| share(&k)).fold(1.0, f64::min);
            for (k, at) in free.iter().enumerate() {
                x[*at] += step * (best[k] - x[*at]);
            }
            if step >= 1.0 {
                break;
            }
            free.retain(|at| x[*at] > 1e-15);
            for k in (0..count).filter(|k| !free.contains(k)) {
                x[k] = 0.0;
            }
        }
    }
    x
}
