//! What every system's ledger counts: energies and angular momentum at a state, and what flowed since the start.
//!
//! At all times: works of the sources = change of (kinetic + potential) + heats, and
//! change of angular momentum about the origin = external angular impulse.

/// Energies and angular momentum at one state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Content {
    /// Kinetic energy of all centres, J.
    pub translation: f64,
    /// Kinetic energy of all spins, J.
    pub spin: f64,
    /// Potential: springs, contacts, weight, J.
    pub potential: f64,
    /// Angular momentum about the origin, N m s.
    pub angular_momentum: f64,
}

impl Content {
    /// Kinetic and potential energy, J.
    pub fn energy(&self) -> f64 {
        self.translation + self.spin + self.potential
    }
}

/// What flowed since the start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flows {
    /// Sum of the heats, J.
    pub heat: f64,
    /// Sum of the works of the sources, J.
    pub work: f64,
    /// Sum of the sizes of these works, J.
    pub work_size: f64,
    /// External angular impulse, N m s.
    pub angular_impulse: f64,
}

impl Flows {
    /// Sums the channels of a ledger: its heats, then the works of its sources, then the external angular impulse.
    ///
    /// # Panics
    /// When there are not so many heats, and the impulse.
    pub fn of(channels: &[f64], heats: usize) -> Self {
        let (heats, rest) = channels.split_at(heats);
        let (works, impulse) = rest.split_at(rest.len() - 1);
        Flows {
            heat: heats.iter().sum(),
            work: works.iter().sum(),
            work_size: works.iter().map(|work| work.abs()).sum(),
            angular_impulse: impulse[0],
        }
    }
}

/// Energy and angular momentum at two states of a run, and what flowed between them.
#[derive(Clone, Copy, Debug)]
pub struct Balance {
    /// At the earlier state.
    pub start: (Content, Flows),
    /// At the later state.
    pub end: (Content, Flows),
}

impl Balance {
    /// Between two states, by a function that gives contents and flows of one.
    pub fn between(start: &[f64], end: &[f64], at: impl Fn(&[f64]) -> (Content, Flows)) -> Self {
        Balance {
            start: at(start),
            end: at(end),
        }
    }
    /// Works less heats less what is stored, J: zero but for errors.
    pub fn energy_residual(&self) -> f64 {
        let ((stored, flowed), (now, by_now)) = (self.start, self.end);
        (by_now.work - flowed.work) - (by_now.heat - flowed.heat) - (now.energy() - stored.energy())
    }
    /// External impulse less the change of angular momentum, N m s: zero but for errors.
    pub fn angular_momentum_residual(&self) -> f64 {
        let ((held, flowed), (now, by_now)) = (self.start, self.end);
        (by_now.angular_impulse - flowed.angular_impulse)
            - (now.angular_momentum - held.angular_momentum)
    }
    /// External angular impulse between the states, N m s.
    pub fn angular_impulse(&self) -> f64 {
        self.end.1.angular_impulse - self.start.1.angular_impulse
    }
    /// Heat made between the states, J.
    pub fn heat(&self) -> f64 {
        self.end.1.heat - self.start.1.heat
    }
    /// Size of the works between the states, J.
    pub fn work_size(&self) -> f64 {
        self.end.1.work_size - self.start.1.work_size
    }
}
