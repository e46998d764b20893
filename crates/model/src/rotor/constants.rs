//! Constants of a rotor.

use crate::table::Table;
use number::Vec2;

/// One modal coordinate, the same in both planes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coordinate {
    /// Frequency ω of the free rotor at rest, rad/s; zero of rigid motions.
    pub frequency: f64,
    /// Modal mass, kg; 1 of coordinates made orthonormal.
    pub mass: f64,
    /// Entry of W = ΦᵀM1, kg.
    pub weight: f64,
    /// Entry of N at φ = 0, m: see [`RotorConstants::with_unbalance`].
    pub unbalance: Vec2<f64>,
}

/// Mass times distance from the axis at a node.
#[derive(Clone, Debug, PartialEq)]
pub struct Unbalance {
    /// Row φ of the node.
    pub node: Vec<f64>,
    /// Product u, kg m.
    pub product: f64,
    /// Phase δ on the rotor, rad: its angle is φ + δ.
    pub phase: f64,
}

/// A torque on the spin by tables: τ(|Ω|) s(t).
#[derive(Clone, Debug, PartialEq)]
pub struct TorqueTables {
    /// τ over the size of the spin, N m: above 0 it drives, below 0 it brakes.
    pub over_speed: Table,
    /// s over the time.
    pub share_over_time: Table,
}

/// Constants of a rotor.
#[derive(Clone, Debug, PartialEq)]
pub struct RotorConstants {
    /// Its coordinates; none of one that only turns: the flywheel of a rig, or the rotor that slides in a bore there.
    pub coordinates: Vec<Coordinate>,
    /// Gyroscopic matrix G row by row, symmetric; empty where there is none.
    pub gyroscopic: Vec<f64>,
    /// Damping D_e that does not rotate, row by row, symmetric; empty where there is none.
    pub damping: Vec<f64>,
    /// Damping D_i that rotates with the shaft, row by row, symmetric; empty where there is none.
    pub damping_rotating: Vec<f64>,
    /// Polar moment of inertia I_G about the mass centre, kg m².
    pub polar_inertia: f64,
    /// Torque of the drive at rest, N m.
    pub drive_torque: f64,
    /// What it falls by with the spin, N m s.
    pub drive_slope: f64,
    /// Drag by the spin, N m s, never negative.
    pub drag: f64,
    /// Drag by its square, N m s², never negative.
    pub drag_square: f64,
    /// Torque of a drive or of a load over speed and time; none where there is none.
    pub torque: Option<TorqueTables>,
    /// Torque that brakes the spin once the brake is on, N m, never negative.
    pub brake_torque: f64,
    /// True where a drive holds the spin whatever it takes.
    pub spin_held: bool,
    /// So many of its first coordinates are displacements of housings, which carry the rotor and are no part of it. Their mounts are
    /// the last seals of the machine, in this order.
    pub housings: usize,
    /// Rows φ of places whose displacement is watched.
    pub places: Vec<Vec<f64>>,
}

impl RotorConstants {
    /// Whether a drive may run it up.
    pub(crate) fn driven(&self) -> bool {
        self.drive_torque != 0.0 || self.torque.is_some()
    }
    /// A rigid rotor of one plane that spins freely: mass (kg), polar inertia about its mass centre (kg m²), eccentricity of
    /// that (m). Its nodes have the row (1).
    pub fn point(mass: f64, polar_inertia: f64, eccentricity: f64) -> Self {
        RotorConstants {
            coordinates: vec![Coordinate {
                frequency: 0.0,
                mass,
                weight: mass,
                unbalance: Vec2::new(eccentricity, 0.0),
            }],
            gyroscopic: Vec::new(),
            damping: Vec::new(),
            damping_rotating: Vec::new(),
            polar_inertia,
            drive_torque: 0.0,
            drive_slope: 0.0,
            drag: 0.0,
            drag_square: 0.0,
            torque: None,
            brake_torque: 0.0,
            spin_held: false,
            housings: 0,
            places: Vec::new(),
        }
    }
    /// A rotor that only turns: polar inertia, kg m²; without effect, and zero, where its spin is held.
    pub fn turning(polar_inertia: f64, spin_held: bool) -> Self {
        RotorConstants {
            coordinates: Vec::new(),
            polar_inertia: if spin_held { 0.0 } else { polar_inertia },
            spin_held,
            ..Self::point(1.0, 1.0, 0.0)
        }
    }
    /// Adds unbalances to a rotor; the polar inertia of one without any is that of the whole rotor about its axis, these masses in it.
    ///
    /// Formula: N = M⁻¹ Σ u e^{jδ} φ,  I_G = I_p - NᴴMN
    #[must_use]
    pub fn with_unbalance(mut self, planes: &[Unbalance]) -> Self {
        let about_centre = |own: &Coordinate| own.mass * own.unbalance.length_squared();
        self.polar_inertia += self.coordinates.iter().map(about_centre).sum::<f64>();
        for plane in planes {
            let (sine, cosine) = plane.phase.sin_cos();
            for (own, shape) in self.coordinates.iter_mut().zip(&plane.node) {
                own.unbalance += Vec2::new(cosine, sine) * (plane.product * shape / own.mass);
            }
        }
        self.polar_inertia -= self.coordinates.iter().map(about_centre).sum::<f64>();
        self
    }
    /// Mass of the rotor, kg; exact where the coordinates hold its rigid translation.
    pub fn mass(&self) -> f64 {
        let share = |own: &Coordinate| own.weight * (own.weight / own.mass);
        self.own_coordinates().iter().map(share).sum()
    }
    /// Coordinates without those of housings.
    pub fn own_coordinates(&self) -> &[Coordinate] {
        &self.coordinates[self.housings..]
    }
    /// Largest distance of the mass centre from the axis, at a node, m.
    pub fn eccentricity(&self, node: &[f64]) -> f64 {
        self.arm(node).length_squared().sqrt()
    }
    /// Bound of that at a node, m, however its modes turn against each other.
    pub fn most_eccentric(&self, node: &[f64]) -> f64 {
        let own = self.coordinates.iter().zip(node);
        own.map(|(own, shape)| own.unbalance.length_squared().sqrt() * shape.abs())
            .sum()
    }
    /// -φ·N at φ = 0.
    pub(super) fn arm(&self, node: &[f64]) -> Vec2<f64> {
        let parts = self.coordinates.iter().zip(node);
        -parts.fold(Vec2::zero(), |sum, (own, shape)| {
            sum + own.unbalance * *shape
        })
    }
    /// Why a rotor cannot be computed.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let n = self.coordinates.len();
        let rows = self.places.iter().all(|row| row.len() == n);
        let matrices = [&self.gyroscopic, &self.damping, &self.damping_rotating];
        let whole = |matrix: &&Vec<f64>| matrix.is_empty() || matrix.len() == n * n;
        let inert = self.polar_inertia > 0.0 || n == 0 && self.spin_held;
        if !rows {
            Some("a place has an entry for each coordinate")
        } else if !matrices.iter().all(whole) {
            Some("a matrix has a row and a column for each coordinate")
        } else if !self.coordinates.iter().all(|own| own.mass > 0.0) || !inert {
            Some("masses and inertias are positive")
        } else {
            None
        }
    }
}
