//! The motion of a finished run for one time cursor: orbits, forces, balls, the shape of the shaft, the energy ledger, at the same instants.

use auxbear::report::page::{PageColumn, PageRun};
use serde_json::{Value, json};

/// Most instants of a motion.
const MOST_INSTANTS: usize = 2000;
/// Digits of its numbers: more than a screen has dots.
const DIGITS: usize = 5;

/// Everything that moves in a run; none of what has no rotor in a bearing.
pub fn motion(run: &PageRun) -> Option<Value> {
    let own = Columns::of(run)?;
    let summary: Value = serde_json::from_str(&run.summary_json).ok()?;
    let races = run
        .columns
        .iter()
        .filter_map(|column| column.name.strip_suffix("bearing.inner_race.x"));
    let prefixes: Vec<&str> = races
        .filter(|prefix| own.has(&format!("{prefix}rotor.x")) || own.has("rotor.x"))
        .collect();
    if prefixes.is_empty() {
        return None;
    }
    let bearings: Vec<Value> = prefixes
        .iter()
        .enumerate()
        .map(|(k, prefix)| own.bearing(prefix, k, &summary))
        .collect();
    let ends = |end: &str| -> Vec<Value> {
        let lines = run
            .columns
            .iter()
            .filter(|column| column.name.ends_with(end));
        lines.map(|column| json!({ "name": column.name.replace("bearing.", ""), "values": own.values(column) })).collect()
    };
    let heat = own.sum(run, ".heat.");
    // of the kinetic energy its change: it is far larger than all others
    let changed = |values: Vec<f64>| {
        let first = values.first().copied().unwrap_or_default();
        values
            .iter()
            .map(|value| rounded(value - first))
            .collect::<Vec<f64>>()
    };
    let energies = [
        (
            "change of kinetic",
            own.named("energy.kinetic").map(changed),
        ),
        ("potential", own.named("energy.potential")),
        ("heat", Some(heat)),
        ("work put in", Some(own.sum(run, "energy.source."))),
    ];
    let energies = energies
        .into_iter()
        .filter_map(|(name, values)| Some(json!({ "name": name, "values": values? })));
    let speeds = [
        ends("rotor.speed"),
        ends("inner_race.speed"),
        ends("cage.speed"),
    ]
    .concat();
    let shaft = |way: &str| -> Vec<Value> {
        let columns = (1..).map_while(|k| own.named(&format!("shape.{k}.{way}")));
        columns.map(|values| json!(values)).collect()
    };
    let mut quantities = summary["quantities"]
        .as_object()
        .into_iter()
        .flat_map(|all| all.values());
    let places = quantities.find(|own| own["shown"]["shape"] == "place");
    Some(json!({
        "time": own.named("time"),
        "every": own.every,
        "bearings": bearings,
        "plots": [
            { "title": "Contact force", "unit": "N", "lines": ends("contact.force") },
            { "title": "Load of a bearing", "unit": "N", "lines": ends("bearing.load") },
            { "title": "Speeds", "unit": "rad/s", "lines": speeds },
            { "title": "Energy ledger", "unit": "J", "lines": energies.collect::<Vec<_>>() },
        ],
        "shape": { "place": places.map(|own| &own["value"]), "x": shaft("x"), "y": shaft("y") },
    }))
}

/// The columns of a run at some of its rows.
struct Columns<'a> {
    run: &'a PageRun,
    /// Every so many rows.
    every: usize,
}

impl<'a> Columns<'a> {
    fn of(run: &'a PageRun) -> Option<Columns<'a>> {
        let time = run.columns.iter().find(|column| column.name == "time")?;
        let every = time.values.len().div_ceil(MOST_INSTANTS).max(1);
        (time.values.len() > 1).then_some(Columns { run, every })
    }

    fn has(&self, name: &str) -> bool {
        self.run.columns.iter().any(|column| column.name == name)
    }

    fn values(&self, column: &PageColumn) -> Vec<f64> {
        column
            .values
            .iter()
            .step_by(self.every)
            .map(|value| rounded(*value))
            .collect()
    }

    fn named(&self, name: &str) -> Option<Vec<f64>> {
        let column = self.run.columns.iter().find(|column| column.name == name)?;
        Some(self.values(column))
    }

    /// The sum of all columns whose names have this in them.
    fn sum(&self, run: &PageRun, part: &str) -> Vec<f64> {
        let rows = run.columns.first().map_or(0, |column| column.values.len());
        let own: Vec<&PageColumn> = run
            .columns
            .iter()
            .filter(|column| column.name.contains(part))
            .collect();
        let sum = |row: usize| {
            own.iter()
                .filter_map(|column| column.values.get(row))
                .sum::<f64>()
        };
        (0..rows)
            .step_by(self.every)
            .map(|row| rounded(sum(row)))
            .collect()
    }

    fn bearing(&self, prefix: &str, k: usize, summary: &Value) -> Value {
        let rotor = |way: &str| {
            self.named(&format!("{prefix}rotor.{way}"))
                .or_else(|| self.named(&format!("rotor.{way}")))
        };
        let race = |way: &str| self.named(&format!("{prefix}bearing.inner_race.{way}"));
        let apart = |way: &str| -> Vec<f64> {
            let both = rotor(way)
                .unwrap_or_default()
                .into_iter()
                .zip(race(way).unwrap_or_default());
            both.map(|(rotor, race)| rounded(rotor - race)).collect()
        };
        let path: Vec<[f64; 2]> = apart("x")
            .into_iter()
            .zip(apart("y"))
            .map(<[f64; 2]>::from)
            .collect();
        let ball = |n: usize| {
            let of = |what: &str| self.named(&format!("{prefix}bearing.ball_{n:02}.{what}"));
            Some(json!({ "azimuth": of("azimuth")?, "load": of("inner_load")? }))
        };
        let several = &summary["auxiliary_bearings"][k]["clearance_radius_m"];
        json!({
            "name": prefix.trim_end_matches('.'),
            "clearance": several.as_f64().or(summary["clearance_radius_m"].as_f64()),
            "path": path,
            "force": self.named(&format!("{prefix}bearing.contact.force")),
            "balls": (1..).map_while(ball).collect::<Vec<_>>(),
        })
    }
}

/// A number with as many digits as are shown; what is none becomes 0.
fn rounded(value: f64) -> f64 {
    format!("{value:.*e}", DIGITS - 1)
        .parse()
        .ok()
        .filter(|value: &f64| value.is_finite())
        .unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(name: &str, values: &[f64]) -> PageColumn {
        PageColumn {
            name: name.to_string(),
            values: values.to_vec(),
            ..PageColumn::default()
        }
    }

    #[test]
    fn everything_stands_at_the_same_instants() {
        let rows = 3 * MOST_INSTANTS;
        let rising: Vec<f64> = (0..rows).map(|k| k as f64).collect();
        let names = [
            "time",
            "a.rotor.x",
            "a.rotor.y",
            "a.bearing.inner_race.x",
            "a.bearing.inner_race.y",
            "a.bearing.contact.force",
            "a.bearing.ball_01.azimuth",
            "a.bearing.ball_01.inner_load",
            "rotor.speed",
            "energy.kinetic",
            "a.energy.heat.x",
            "a.energy.heat.y",
            "shape.1.x",
            "shape.1.y",
        ];
        let run = PageRun {
            summary_json: r#"{"clearance_radius_m": 1e-4, "quantities": {"places": {"value": [0.5], "shown": {"shape": "place"}}}}"#.to_string(),
            columns: names.iter().map(|name| column(name, &rising)).collect(),
            ..PageRun::default()
        };
        let found = motion(&run).unwrap();
        let count = found["time"].as_array().unwrap().len();
        assert_eq!(count, MOST_INSTANTS);
        let bearing = &found["bearings"][0];
        assert_eq!(
            (bearing["name"].as_str(), bearing["clearance"].as_f64()),
            (Some("a"), Some(1e-4))
        );
        assert_eq!(bearing["path"].as_array().unwrap().len(), count);
        assert_eq!(bearing["path"][7], json!([0.0, 0.0]));
        assert_eq!(bearing["balls"][0]["load"][5], 15.0);
        assert_eq!(
            found["plots"][3]["lines"][1]["values"][5], 30.0,
            "two heats"
        );
        assert_eq!(found["shape"]["x"][0].as_array().unwrap().len(), count);
        // what only has a time moves nothing
        let still = PageRun {
            columns: vec![column("time", &rising)],
            ..run
        };
        assert!(motion(&still).is_none());
    }

    #[test]
    fn numbers_have_as_many_digits_as_are_shown() {
        assert_eq!(rounded(1.234_567_8e-5), 1.2346e-5);
        assert_eq!(rounded(f64::NAN), 0.0);
    }
}
