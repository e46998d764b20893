//! How far a leap of a coast-down goes.

use crate::coast_down::build::CoastDownModel;
use crate::drop::context::Context;
use crate::drop::multirate::batch::Observation;
use crate::drop::multirate::interval::Motion;
use std::f64::consts::LN_2;

/// Largest jump of the logarithm of the speed in the motion: a lightly damped resonance of a mount is a few percent wide, and so steps on it.
pub(super) const JUMP: f64 = 0.04;
/// From how far above a natural frequency to how far below it is passed in jumps: a motion that leaves its race softens, and drags its resonance down.
const NEAR: [f64; 2] = [1.1, 0.7];
/// Contact force over that before, or over the load at rest, from which on a motion is another one: at 2 a sinusoidal one leaves its race.
pub(super) const HARDER: f64 = 1.5;
/// Power beside the laws, over theirs, of a rotor that rolls.
const ROLLS: f64 = 0.03;
/// Acceleration of unbalance over that of gravity below which it lifts no rotor, a hundredfold resonance included.
const CALM: f64 = 0.01;
/// Speed over that at the beginning from which on a moment that no law knows is held: a four-hundredth of the energy is left.
pub(super) const HELD: f64 = 0.05;
/// Share of the moment which friction transmits that bearings may brake with where a rotor is left to the laws.
pub(super) const TRANSMITS: f64 = 0.5;

/// A natural frequency.
pub(super) struct Mode {
    /// rad/s.
    frequency: f64,
    /// Damping ratio.
    damping: f64,
    /// Rate at which unbalance makes it grow, over the square of the speed, s; 0 where it is forced.
    grows: f64,
}

/// The natural frequencies that constants tell: of rotor and mount of each bearing, and of the pendulum in the air clearance, which a vertical
/// rotor is not.
pub(super) fn modes(context: &Context, motion: &Motion) -> Vec<Mode> {
    let pendulum = motion.pendulum();
    let drop = context.setup.drop();
    // the weight, changed by e Ω² once a turn, excites a motion of half the speed: λ = e Ω²/(4 g) √(g/c0)
    let grows = eccentricity(motion) * pendulum / (4.0 * drop.gravity.acceleration);
    let pendulums = [
        Mode {
            frequency: pendulum,
            damping: 0.0,
            grows: 0.0,
        },
        Mode {
            frequency: 2.0 * pendulum,
            damping: 0.0,
            grows,
        },
    ];
    let mut list = match drop.gravity.acceleration > 0.0 {
        true => Vec::from(pendulums),
        false => Vec::new(),
    };
    for (k, own) in context.setup.machine.constants.bearings.iter().enumerate() {
        // the weight is that on one row
        let mass = drop.body.mass * drop.share(k) + own.outer_moving_mass();
        let mount = &own.mount;
        list.push(Mode {
            frequency: (mount.stiffness / mass).sqrt(),
            damping: mount.damping / (2.0 * (mount.stiffness * mass).sqrt()),
            grows: 0.0,
        });
    }
    list
}

/// How natural frequencies let a rotor go on, ln of the speeds.
#[derive(Clone, Copy)]
pub(super) struct Pace {
    /// The longest leap.
    pub leap: f64,
    /// The largest jump of its motion: a part of the width of a resonance, so that it stays on its branch.
    pub jump: f64,
    /// How long its motion is followed before a leap: as long as one that grows needs for a factor e, s.
    pub dwell: f64,
}

/// The pace that natural frequencies allow from a speed, rad/s.
pub(super) fn pace(modes: &[Mode], speed: f64) -> Pace {
    let free = Pace {
        leap: f64::INFINITY,
        jump: JUMP,
        dwell: 0.0,
    };
    let [above, below] = NEAR;
    modes.iter().fold(free, |pace, mode| {
        let own = mode.damping.max(0.5 * JUMP);
        match speed / mode.frequency {
            ratio if ratio > above => Pace {
                leap: pace.leap.min((ratio / above).ln().max(own)),
                ..pace
            },
            ratio if ratio > below => Pace {
                leap: pace.leap.min(own),
                jump: pace.jump.min(mode.width()),
                dwell: match mode.grows > 0.0 {
                    true => pace.dwell.max(1.0 / (mode.grows * speed * speed)),
                    false => pace.dwell,
                },
            },
            _ => pace,
        }
    })
}

impl Mode {
    /// A quarter of the width of its resonance, by its damping where that is known.
    fn width(&self) -> f64 {
        match self.damping > 0.0 {
            true => 0.5 * self.damping,
            false => JUMP,
        }
    }
}

/// Largest eccentricity of the rotor in a bearing, m.
fn eccentricity(motion: &Motion) -> f64 {
    let constants = motion.constants();
    let bearings = constants.bearings.iter();
    let largest = bearings.map(|bearing| constants.rotor.most_eccentric(&bearing.node));
    largest.fold(0.0, f64::max)
}

/// Speed below which unbalance lifts no rotor, rad/s.
pub(super) fn calm(motion: &Motion) -> f64 {
    (CALM * motion.gravity() / eccentricity(motion)).sqrt()
}

/// How far a leap goes towards a speed at which the machine changes, ln of both: no interval closes the last one, which has its size.
pub(super) fn towards(ahead: f64) -> f64 {
    match ahead > JUMP {
        true => (ahead - JUMP).max(0.5 * ahead),
        false => ahead,
    }
}

/// Loads at rest of the bearings, N; of one that carries hardly anything, and so never rests, that of the mean bearing. Weight along the shaft counts
/// in that mean.
pub(super) fn at_rest(built: &CoastDownModel) -> impl Iterator<Item = f64> {
    let loads = || built.parts.iter().map(|part| part.warm.radial_load);
    let mean = (loads().sum::<f64>() + built.thrust) / built.parts.len() as f64;
    loads().map(move |load| load.max(mean))
}

/// The largest contact force over the load at rest, of all bearings; on faces over the weight along the shaft.
pub(super) fn pressed(built: &CoastDownModel, now: &Observation) -> f64 {
    let bearings = now.mean.bearings.iter().zip(at_rest(built));
    bearings
        .map(|(own, load)| (own.peak_force / load).max(own.peak_thrust / load.max(built.thrust)))
        .fold(0.0, f64::max)
}

/// Contact forces of a motion from which on it is another one, N.
pub(super) fn hardest(built: &CoastDownModel, now: &Observation) -> Vec<f64> {
    let bearings = now.mean.bearings.iter().zip(at_rest(built));
    bearings
        .map(|(own, load)| HARDER * own.peak_force.max(load))
        .collect()
}

/// How far losses are from those of rolling, over them: from what laws say; where no law knows a bearing, the share of friction of rotor and races.
pub(super) fn beside(built: &CoastDownModel, now: &Observation) -> f64 {
    match built.by_laws() {
        true => now.ratio() - 1.0,
        false => now.mean.rubs(),
    }
}

/// Whether a rotor rolls under its weight, which keeps one from whirling that is not vertical.
pub(super) fn rolls(built: &CoastDownModel, now: &Observation) -> bool {
    let mut bearings = now.mean.bearings.iter();
    let upright = built.parts.iter().all(|part| part.warm.radial_load == 0.0);
    bearings.all(|own| upright || own.whirl.abs() < 1.0)
        && pressed(built, now) <= HARDER
        && beside(built, now).abs() < ROLLS
}

/// What an observation allows.
pub(super) struct Limits {
    /// Moment that brakes the rotor, N m.
    pub moment: f64,
    /// Time so far, and of the coast-down still to come at this moment, s.
    time: f64,
    rest: f64,
    /// Relative error of the mean power.
    pub error: f64,
    /// Longest time, s.
    longest: f64,
}

impl Limits {
    pub fn of(built: &CoastDownModel, now: &Observation) -> Self {
        let start = &built.start;
        let braked = built
            .losses(start.time, start.speed)
            .rotor
            .moment(start.speed)
            + now.followed.rotor;
        let moment = now.mean.powers()[0] / start.speed + braked;
        let rest = built.inertia * start.speed / moment;
        let error = now.relative_error(braked * start.speed);
        let uncertain = built.end.tolerance * (start.time + rest) / error;
        Limits {
            moment,
            time: start.time,
            rest,
            error,
            longest: uncertain.min(LN_2 / now.growth).min(JUMP / now.spins),
        }
    }
    /// Time so far and still to come, s.
    pub fn whole_time(&self) -> f64 {
        self.time + self.rest
    }
    /// Time of a leap, s.
    pub fn time(&self, length: f64) -> f64 {
        self.rest * (1.0 - (-length).exp())
    }
    /// Length of the next leap, of those that its error and natural frequencies allow.
    pub fn length(&self, allowed: f64) -> f64 {
        let share = (self.longest / self.rest).min(0.5);
        allowed.min(-(1.0 - share).ln())
    }
}
