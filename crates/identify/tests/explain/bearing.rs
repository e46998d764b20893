//! A bearing finer than the one the comparison assumes: each ball has its own spin and its own Hertz load from preload
//! and dead weight, the cage is rigid, traction has another shape, M(Ω) another law, grease and films other courses.

/// What is wrong with the lubricant or the traction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lubricant {
    /// Drag of fresh grease, build-up angle (rad), drag after breakdown, its time (s).
    pub grease: Option<[f64; 4]>,
    /// Loss of traction k_T and of drag k_D per unit rise, time of the film (s).
    pub heating: Option<[f64; 3]>,
    /// R μ_max ΣQ over M at 150 rad/s.
    pub traction_limit: f64,
}

/// Constants of the bearing.
#[derive(Clone, Copy, Debug)]
pub struct Bearing {
    pub lubricant: Lubricant,
    /// Swing of ball loads around the bearing.
    pub load_swing: f64,
    /// u0, m/s.
    pub slip_speed: f64,
    /// Part of M without speed dependence over M(150 rad/s).
    pub load_share: f64,
    /// Share of the drag on the orbit.
    pub orbit_share: f64,
}

pub const RADIUS: f64 = 14.825e-3;
pub const RATIO: f64 = 3.175 / 14.825;
pub const BALLS: usize = 10;
pub const BALL_MASS: f64 = 1.052e-3;
pub const CAGE_MASS: f64 = 8e-3;
/// M at 150 rad/s, N m.
pub const MOMENT: f64 = 25e-3;
const TOP: f64 = 150.0;

/// One moment of a run.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    pub time: f64,
    pub speed: f64,
    pub outer_moment: f64,
    pub inner_moment: f64,
    pub cage: f64,
    pub angular_momentum: f64,
    pub heat: f64,
}

struct Ball {
    spin: f64,
    inner: f64,
    outer: f64,
    couple: f64,
    inner_rolling: f64,
    outer_rolling: f64,
}

impl Bearing {
    /// M0 and its slope: a power of 0.6 as in SKF's rolling moment, and churning with the square of the speed.
    fn viscous(&self, speed: f64) -> (f64, f64) {
        let x = speed.abs() / TOP;
        let size = (1.0 - self.load_share) * MOMENT;
        // regular at rest: (x² + ε²)^0.3
        let base = x * x + 1e-4;
        let rest = 1e-4_f64.powf(0.3);
        let moment = size * (0.96 * (base.powf(0.3) - rest) / (1.0 - rest) + 0.04 * x * x);
        let slope = size * (0.96 * 0.6 * x * base.powf(-0.7) / (1.0 - rest) + 0.08 * x) / TOP;
        (moment.copysign(speed), slope)
    }

    /// Steady moment, N m.
    pub fn steady(&self, speed: f64) -> f64 {
        self.viscous(speed).0 + self.load_share * MOMENT * (speed / 0.3).tanh()
    }

    fn load(&self, angle: f64) -> f64 {
        (1.0 + self.load_swing * angle.cos()).max(0.0).powf(1.5)
    }

    /// Runs along a course of speed from rest.
    pub fn run(&self, speed: impl Fn(f64) -> f64, end: f64, fine_until: f64) -> Vec<Row> {
        let mut rows = Vec::new();
        let mean_load: f64 = (0..720)
            .map(|i| self.load(f64::from(i).to_radians() / 2.0))
            .sum::<f64>()
            / 720.0;
        let ball_limit =
            self.lubricant.traction_limit * MOMENT / RADIUS / (BALLS as f64 * mean_load);
        let (mut orbit, mut spins) = (0.0, [0.0; BALLS]);
        let (mut cage_angle, mut time, mut film) = (0.0_f64, 0.0, 0.0_f64);
        let (mut turned, mut worked) = (0.0_f64, 0.0_f64);
        while time < end {
            let h = if time < fine_until { 2.5e-4 } else { 1e-3 };
            time += h;
            let race = speed(time);
            let mut drag = 1.0;
            let mut grip = 1.0;
            if let Some([fresh, angle, broken, duration]) = self.lubricant.grease {
                let build = 1.0 - (-(turned / angle).powf(0.9)).exp();
                let breakdown = 1.0 - (1.0 + 0.5 * worked / duration).powi(-2);
                drag *= (fresh + (1.0 - fresh) * build) * (1.0 - (1.0 - broken) * breakdown);
            }
            if let Some([traction, viscous, _]) = self.lubricant.heating {
                grip /= 1.0 + traction * film;
                drag /= 1.0 + viscous * film;
            }
            let loads: [f64; BALLS] = std::array::from_fn(|j| {
                self.load(cage_angle + std::f64::consts::TAU * j as f64 / BALLS as f64)
            });
            let total: f64 = loads.iter().sum();
            let push = loads.map(|load| load * ball_limit * grip);
            let shares = loads.map(|load| load / total);
            let (last_orbit, last_spins) = (orbit, spins);
            let mut balls: Vec<Ball> = Vec::new();
            let mut orbit_drag = 0.0;
            for _ in 0..60 {
                let (moment, slope) = self.viscous(2.0 * orbit / RADIUS);
                let f = 2.0 * self.orbit_share * drag * moment / RADIUS;
                let f_slope = 4.0 * self.orbit_share * drag * slope / (RADIUS * RADIUS);
                let inertia = (BALLS as f64 * BALL_MASS + CAGE_MASS) / h;
                let mut residual = inertia * (orbit - last_orbit) + f;
                let mut stiffness = inertia + f_slope;
                balls.clear();
                for j in 0..BALLS {
                    let (ball, a, b) = self.ball(
                        race,
                        orbit,
                        last_spins[j],
                        spins[j],
                        push[j],
                        shares[j],
                        drag,
                        h,
                    );
                    residual += ball.outer - ball.inner;
                    stiffness += a - b;
                    spins[j] = ball.spin;
                    balls.push(ball);
                }
                orbit_drag = f;
                let step = residual / stiffness;
                if step.abs() < 1e-10 {
                    break;
                }
                // the spins follow the orbit exactly, so this is a scalar monotone equation
                orbit -= step.clamp(-0.3, 0.3);
            }
            let sum = |value: &dyn Fn(&Ball) -> f64| balls.iter().map(value).sum::<f64>();
            let ball_radius = RATIO * RADIUS;
            let heat = sum(&|b| {
                b.inner * (RADIUS * race - orbit - b.spin)
                    + b.outer * (orbit - b.spin)
                    + (b.couple + b.outer_rolling) * b.spin / ball_radius
                    + b.inner_rolling * (b.spin / ball_radius + race)
            }) + orbit_drag * orbit;
            let outer_moment =
                sum(&|b| (1.0 + 2.0 * RATIO) * RADIUS * b.outer - b.outer_rolling - b.couple)
                    + RADIUS * (1.0 + RATIO) * orbit_drag;
            let cage = orbit / (RADIUS * (1.0 + RATIO));
            rows.push(Row {
                time,
                speed: race,
                outer_moment,
                inner_moment: sum(&|b| RADIUS * b.inner + b.inner_rolling),
                cage,
                angular_momentum: (BALLS as f64 * BALL_MASS + CAGE_MASS)
                    * RADIUS
                    * (1.0 + RATIO)
                    * orbit
                    - 0.4 * BALL_MASS * ball_radius * spins.iter().sum::<f64>(),
                heat,
            });
            cage_angle += cage * h;
            turned += cage.abs() * h;
            worked += h * cage.abs() / (cage.abs() + 2.0);
            if let Some([_, _, duration]) = self.lubricant.heating {
                film += h / duration * (heat / (MOMENT * TOP) - film);
            }
        }
        rows
    }

    /// One ball in balance of spin at an orbit speed; the change of its pull on the orbit with the orbit speed as
    /// direct part and the part through its spin.
    #[allow(clippy::too_many_arguments)]
    fn ball(
        &self,
        race: f64,
        orbit: f64,
        last: f64,
        guess: f64,
        push: f64,
        share: f64,
        drag: f64,
        h: f64,
    ) -> (Ball, f64, f64) {
        let radius = RATIO * RADIUS;
        let inertia = 0.4 * BALL_MASS / h;
        let rolling = RATIO / (1.0 + RATIO) * self.load_share * MOMENT * share;
        let at = |spin: f64| {
            let (inner, inner_slope) = self.traction(RADIUS * race - orbit - spin, push);
            let (outer, outer_slope) = self.traction(orbit - spin, push);
            let (moment, slope) = self.viscous(2.0 * spin / RADIUS);
            let couple_share = 2.0 * RATIO * (1.0 - self.orbit_share) * drag / BALLS as f64;
            let (couple, couple_slope) =
                (couple_share * moment, couple_share * slope * 2.0 / RADIUS);
            let (a, b) = ((spin / radius + race).tanh(), (spin / radius).tanh());
            let rolling_slope = rolling * (2.0 - a * a - b * b) / radius;
            let ball = Ball {
                spin,
                inner,
                outer,
                couple,
                inner_rolling: rolling * a,
                outer_rolling: rolling * b,
            };
            let residual =
                inertia * (spin - last) - inner - outer + (couple + rolling * (a + b)) / radius;
            let slope =
                inertia + inner_slope + outer_slope + (couple_slope + rolling_slope) / radius;
            (ball, residual, slope, inner_slope, outer_slope)
        };
        // the residual rises with the spin: a bracket around the root, Newton inside it
        let (mut low, mut high) = (-20.0, 20.0);
        let mut spin = guess;
        let mut now = at(spin);
        for _ in 0..60 {
            if now.1 > 0.0 {
                high = spin;
            } else {
                low = spin;
            }
            let step = now.1 / now.2;
            if step.abs() < 1e-11 {
                break;
            }
            spin -= step;
            if spin <= low || spin >= high {
                spin = 0.5 * (low + high);
            }
            now = at(spin);
        }
        let (ball, _, slope, inner_slope, outer_slope) = now;
        let difference = inner_slope - outer_slope;
        (
            ball,
            inner_slope + outer_slope,
            difference * difference / slope,
        )
    }

    /// Force and slope over slip: x/(1+|x|^1.5)^(2/3).
    fn traction(&self, slip: f64, push: f64) -> (f64, f64) {
        let x = slip / self.slip_speed;
        let base = 1.0 + x.abs() * x.abs().sqrt();
        let root = base.cbrt() * base.cbrt();
        (push * x / root, push / self.slip_speed / (root * base))
    }
}
