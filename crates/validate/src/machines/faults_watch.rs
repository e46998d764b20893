//! What is compared of a run with faults: rows at given instants, and extremes.

use crate::json::{list, number};
use model::system::machine::RotorMachine;
use number::Vec2;
use serde_json::Value;
use solve::{Flow, Observer, Step};

/// A row of the run.
pub(super) struct Row {
    pub places: Vec<Vec2<f64>>,
    pub currents: Vec<(f64, [f64; 2])>,
}

/// Rows and extremes of a run.
pub(super) struct Watch {
    pub times: Vec<f64>,
    pub rows: Vec<Row>,
    pub peaks: Vec<f64>,
    pub largest: Vec<(f64, [f64; 2])>,
    /// Places of the stops among those watched.
    pub stops: Vec<usize>,
    pub radii: [f64; 2],
    pub crossed: Vec<Option<f64>>,
    pub outside: [Vec<Option<f64>>; 2],
    pub before: Option<(f64, Vec<f64>)>,
    pub hold: f64,
}

impl Watch {
    pub fn new(machine: &RotorMachine, times: Vec<f64>, given: &Value) -> Result<Self, String> {
        let (nodes, stops) = (list(given, "nodes")?, list(given, "stop_nodes")?);
        let at = stops
            .iter()
            .map(|stop| nodes.iter().position(|node| node == stop));
        Ok(Watch {
            times,
            rows: Vec::new(),
            peaks: vec![0.0; nodes.len()],
            largest: vec![(0.0, [0.0; 2]); machine.axes().count()],
            stops: at.collect::<Option<_>>().ok_or("stops that are no rows")?,
            radii: [number(given, "radius_m")?, number(given, "radius_2_m")?],
            crossed: vec![None; stops.len()],
            outside: [vec![None; stops.len()], vec![None; stops.len()]],
            before: None,
            hold: number(given, "hold_s")?,
        })
    }

    pub fn look(&mut self, machine: &RotorMachine, time: f64, state: &[f64]) {
        let places: Vec<Vec2<f64>> = (0..self.peaks.len())
            .map(|k| machine.place(k, state))
            .collect();
        let sizes: Vec<f64> = places
            .iter()
            .map(|place| place.length_squared().sqrt())
            .collect();
        for (peak, size) in self.peaks.iter_mut().zip(&sizes) {
            *peak = peak.max(*size);
        }
        let currents: Vec<_> = machine.currents(time, state).to_vec();
        for (largest, (control, coils)) in self.largest.iter_mut().zip(&currents) {
            largest.0 = largest.0.max(control.abs());
            for (largest, coil) in largest.1.iter_mut().zip(coils) {
                *largest = largest.max(*coil);
            }
        }
        for (k, at) in self.stops.iter().enumerate() {
            let now = sizes[*at];
            if let Some((then, before)) = &self.before
                && self.crossed[k].is_none()
                && before[*at] <= self.radii[0]
                && now > self.radii[0]
            {
                let share = (self.radii[0] - before[*at]) / (now - before[*at]);
                self.crossed[k] = Some(then + share * (time - then));
            }
            for (of, radius) in self.radii.iter().enumerate() {
                if now > *radius {
                    self.outside[of][k] = Some(time);
                }
            }
        }
        if self
            .times
            .get(self.rows.len())
            .is_some_and(|own| (own - time).abs() < 1e-12)
        {
            self.rows.push(Row { places, currents });
        }
        self.before = Some((time, sizes));
    }
}

impl Observer<RotorMachine> for Watch {
    fn step(&mut self, step: &mut Step<RotorMachine>) -> Flow {
        let (machine, time) = (step.machine, step.end);
        let state = step.state(1.0).to_vec();
        self.look(machine, time, &state);
        Flow::Continue
    }
}
