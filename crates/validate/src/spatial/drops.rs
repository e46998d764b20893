//! Drops onto a pair of rows (`spatial_drops.json`): the state at the end, the mean of an ensemble, the energy balance.

use super::given::{Params, by_class, inward, state_outward};
use crate::compare::{Worst, part};
use crate::json::{list, number};
use crate::report::{Row, Tolerance};
use model::spatial::ball::BALL_STATES;
use model::spatial::rigid_body::BODY_STATES;
use model::spatial::{Assembly, AssemblyConstants, AssemblyProbe, Frame, LEDGER};
use number::{Level, Real, Task};
use serde_json::Value;
use solve::{BOGACKI_SHAMPINE, Batch, Ending, Flow, Machine, Observer, Settings, Step, Stop};
use statistics::random::uniform;
use std::sync::atomic::AtomicBool;

/// Tolerance of the steps: that of the ensembles of the files.
const TOLERANCE: f64 = 1e-8;
/// Members of an ensemble.
const MEMBERS: usize = 8;
/// Places of the balls of members differ by so much, m.
const PERTURBATION: f64 = 1e-10;
/// Grid on which the files take the first contact, s.
const GRID: f64 = 1e-5;

pub(super) fn rows(file: &Value) -> Result<Vec<Row>, String> {
    let mut worst = Worst::default();
    for (at, given) in list(file, "cases")?.iter().enumerate() {
        let name = given["name"].as_str().unwrap_or_default();
        let place = format!("cases[{at}] {name}");
        worst.row(&place, given, |worst| drop(given, &place, worst))?;
    }
    Ok(worst.into_rows())
}

/// What the files allow the states of a body, of a ball and the accounts at a tolerance of 1: 1 mm, 100 m/s, 0.01 of an orientation,
/// 1e4 rad/s, 100 J; of a ball's angle as much along a track of 2 cm.
const BODY: [f64; BODY_STATES] = [
    1e-3, 1e-3, 1e-3, 1e2, 1e2, 1e2, 1e-2, 1e-2, 1e-2, 1e-2, 1e4, 1e4, 1e4,
];
const BALL: [f64; BALL_STATES] = [1e-3, 1e2, 5e-2, 5e3, 1e-3, 1e2, 1e4, 1e4, 1e4];
const ACCOUNT: f64 = 1e2;

/// A machine that falls; its rows have as many balls each.
struct Drop(AssemblyConstants);

/// Machines in lanes.
struct Drops<R: Real>(Assembly<R>);

fn watched<R>(probe: AssemblyProbe<R>) -> [R; 2] {
    [probe.bore_normal_force, probe.face_normal_force]
}

impl Machine for Drop {
    type Mode = ();
    fn dimension(&self) -> usize {
        self.0.states()
    }
    fn quadratures(&self) -> usize {
        LEDGER.len()
    }
    fn probes(&self) -> usize {
        2
    }
    fn error_scale(&self, channel: usize) -> f64 {
        let balls = self.0.first_ball_state(0);
        if channel < balls {
            BODY[channel % BODY_STATES]
        } else if channel < self.0.first_account() {
            BALL[(channel - balls) / self.0.rows[0].balls % BALL_STATES]
        } else {
            ACCOUNT
        }
    }
    fn channel_name(&self, channel: usize) -> String {
        format!("state {channel}")
    }
    fn start_mode(&self) {}
    fn transition(&self, _: usize, (): &mut (), _: &mut [f64]) {}
    fn rate(&self, (): &(), _: f64, state: &[f64], rate: &mut [f64], probe: &mut [f64]) {
        let found = Assembly::<f64>::gather(&|_| &self.0).rate(state, rate);
        let count = probe.len();
        probe.copy_from_slice(&watched(found)[..count]);
    }
}

impl<R: Real> Batch<R> for Drops<R> {
    type Machine = Drop;
    type Mode = ();
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Drop) -> Self
    where
        Drop: 'a,
    {
        Drops(Assembly::gather(&|lane| &machine(lane).0))
    }
    fn gather_mode(_: &dyn Fn(usize)) {}
    #[inline(always)]
    fn rate(&self, (): &(), _: R, state: &[R], rate: &mut [R], probe: &mut [R]) {
        let found = self.0.rate(state, rate);
        let count = probe.len();
        probe.copy_from_slice(&watched(found)[..count]);
    }
}

/// Largest forces of bore and face at the ends of steps, N, and when the first was seen, s.
#[derive(Clone, Default)]
struct Watch {
    peaks: [f64; 2],
    first: Option<f64>,
}

impl Observer<Drop> for Watch {
    fn step(&mut self, step: &mut Step<Drop>) -> Flow {
        for (k, peak) in self.peaks.iter_mut().enumerate() {
            let force = step.end_probe(k);
            *peak = peak.max(force);
            if force > 0.0 {
                self.first.get_or_insert(step.end);
            }
        }
        Flow::Continue
    }
}

/// Members that fall side by side.
struct Ensemble<'a> {
    machine: &'a Drop,
    starts: &'a [Vec<f64>],
    end: f64,
    watches: &'a mut [Watch],
}

impl Task for Ensemble<'_> {
    type Output = Vec<Ending>;
    fn run<R: Real>(self) -> Vec<Ending> {
        let settings = Settings {
            start: 0.0,
            end: self.end,
            tolerance: TOLERANCE,
            first_step: 1e-9,
            largest_step: 1e-3,
            step_limit: 100_000_000,
        };
        let machines = vec![self.machine; self.starts.len()];
        solve::run::<R, Drops<R>, _>(
            &BOGACKI_SHAMPINE,
            &machines,
            self.starts,
            self.watches,
            &settings,
            &AtomicBool::new(false),
        )
    }
}

/// The first member starts as the file says, the others with balls a little off their places.
fn starts(machine: &AssemblyConstants, frame: &Frame, y: &[f64]) -> Vec<Vec<f64>> {
    let balls = machine.first_ball_state(0);
    let member = |member: u64| {
        let mut y = y.to_vec();
        for k in (balls..machine.first_account()).filter(|k| (k - balls) % BALL_STATES < 3) {
            let share = 2.0 * uniform(1, member, k as u64) - 1.0;
            y[k] += if member == 0 {
                0.0
            } else {
                PERTURBATION * share
            };
        }
        inward(machine, frame, &y)
    };
    (0..MEMBERS as u64).map(member).collect()
}

fn drop(given: &Value, place: &str, worst: &mut Worst) -> Result<(), String> {
    let params = Params(&given["params"]);
    let (constants, frame) = (params.constants()?, params.frame()?);
    let (y0, y): (Vec<f64>, Vec<f64>) = (part(&given["y0"])?, part(&given["y"])?);
    let states = constants.states();
    if y0.len() != states || y.len() != states {
        return Err(format!("y0 and y are not {states} numbers"));
    }
    let starts = starts(&constants, &frame, &y0);
    let machine = Drop(constants);
    let mut watches = vec![Watch::default(); MEMBERS];
    let endings = Level::detect().run_many(Ensemble {
        machine: &machine,
        starts: &starts,
        end: number(given, "T")?,
        watches: &mut watches,
    });
    if let Some(early) = endings.iter().find(|ending| ending.stop != Stop::Finished) {
        return Err(format!(
            "the run ended at {} s: {:?}",
            early.time, early.stop
        ));
    }
    let constants = &machine.0;
    let ends: Vec<Vec<f64>> = endings
        .iter()
        .map(|ending| state_outward(constants, &frame, &ending.state))
        .collect();
    if given["compare_state"] == true {
        let own: Vec<f64> = part(&given["self_convergence"])?;
        if own.len() != states {
            return Err(format!("self_convergence is not {states} numbers"));
        }
        for (k, [name, unit, _], largest) in by_class(constants, &y) {
            let allowed = (100.0 * own[k]).max(1e-6 * largest);
            let why = format!("{place}, state {k}; that of the file");
            let mut compared = worst.under(Tolerance::Absolute(allowed), why);
            compared.add(name, unit, [y[k], ends[0][k]]);
        }
    }
    let members: Vec<_> = (ends.iter().zip(&watches))
        .map(|(state, watch)| quantities(constants, state, watch))
        .collect();
    for (k, (key, unit, _)) in members[0].iter().enumerate() {
        let known = &given["ensemble"][key];
        let (mean, spread) = (number(known, "mean")?, number(known, "sd")?);
        let sum: f64 = members.iter().map(|member| member[k].2).sum();
        let why = format!("{place}; 5 standard deviations of the ensemble and 1e-4 of its mean");
        let allowed = Tolerance::Absolute(5.0 * spread + 1e-4 * mean.abs());
        let mut compared = worst.under(allowed, why);
        compared.add(key, unit, [mean, sum / MEMBERS as f64]);
    }
    let first = watches[0].first.ok_or("the rotor never touched")?;
    let mut when = worst.under(
        Tolerance::Absolute(GRID),
        format!("{place}; the grid of the file"),
    );
    when.add(
        "first_contact_after",
        "s",
        [number(given, "first_contact_after")?, first],
    );
    let why = format!("{place}; 1e-6 of what was dissipated");
    let mut balance = worst.under(Tolerance::Absolute(1e-6), why);
    for (start, ending) in starts.iter().zip(&endings) {
        balance.add(
            "energy_residual",
            "",
            [0.0, residual(constants, start, &ending.state)],
        );
    }
    Ok(())
}

/// Name in the files, unit and value of what is compared with an ensemble.
fn quantities(
    machine: &AssemblyConstants,
    state: &[f64],
    watch: &Watch,
) -> Vec<(String, &'static str, f64)> {
    let place = |body| state[machine.body(body) + 2];
    let speed = |body| state[machine.body(body) + 12];
    let account = |k: usize| state[machine.first_account() + k];
    let mut all = vec![
        ("peak_bore_N".to_string(), "N", watch.peaks[0]),
        ("peak_face_N".to_string(), "N", watch.peaks[1]),
        ("inner_speed".to_string(), "rad/s", speed(1)),
        ("rotor_z".to_string(), "m", place(0)),
        ("inner_z".to_string(), "m", place(1)),
        ("outer_z".to_string(), "m", place(2)),
        ("face_friction_J".to_string(), "J", account(14)),
        ("bore_friction_J".to_string(), "J", account(9)),
        ("ball_slip_J".to_string(), "J", account(2) + account(3)),
    ];
    let cages = 0..machine.rows.len();
    all.extend(cages.map(|row| (format!("cage{row}_speed"), "rad/s", speed(3 + row))));
    all
}

/// What the energy balance lacks, of the energy dissipated.
fn residual(machine: &AssemblyConstants, start: &[f64], end: &[f64]) -> f64 {
    let energy = |state: &[f64]| {
        let content = machine.content(state);
        content.kinetic + content.potential
    };
    let accounts = |k: usize| end[machine.first_account() + k] - start[machine.first_account() + k];
    let heat: f64 = (0..16).map(accounts).sum();
    let supplied = accounts(16) + accounts(17);
    (energy(end) - energy(start) + heat - supplied) / heat
}
