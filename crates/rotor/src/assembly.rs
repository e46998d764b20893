//! From parts to matrices.

use crate::{C64, Element, Rotor, Support};
use nalgebra::{ComplexField, DMatrix};

/// The matrices of shaft, disks, masses and housings without supports, in the complex coordinates of the rotor.
///
/// M q̈ - jΩG q̇ + D_e q̇ + D_i(q̇ - jΩq) + K q = F; all are real and symmetric and hold for both planes.
#[derive(Debug, Clone)]
pub struct Matrices {
    /// Mass M.
    pub mass: DMatrix<f64>,
    /// Stiffness K of the shaft.
    pub stiffness: DMatrix<f64>,
    /// Gyroscopic matrix G.
    pub gyroscopic: DMatrix<f64>,
    /// Non-rotating damping D_e of the shaft elements; disks have none.
    pub damping: DMatrix<f64>,
    /// Rotating damping D_i of the shaft elements.
    pub damping_rotating: DMatrix<f64>,
}

impl Matrices {
    /// The matrices of a rotor.
    #[must_use]
    pub fn new(rotor: &Rotor) -> Self {
        let size = rotor.size();
        let mut out = Self {
            mass: DMatrix::zeros(size, size),
            stiffness: DMatrix::zeros(size, size),
            gyroscopic: DMatrix::zeros(size, size),
            damping: DMatrix::zeros(size, size),
            damping_rotating: DMatrix::zeros(size, size),
        };
        for element in &rotor.elements {
            let beneath = |other: &&Element| other.carries && other.left == element.left;
            let shaft = rotor
                .elements
                .iter()
                .find(beneath)
                .filter(|_| !element.carries);
            let own = element.matrices_in(shaft.unwrap_or(element).shear_ratio());
            let at = rotor.displacement(element.left);
            let add = |whole: &mut DMatrix<f64>, part: nalgebra::Matrix4<f64>| {
                let mut block = whole.view_mut((at, at), (4, 4));
                block += part;
            };
            add(&mut out.mass, own.mass);
            add(&mut out.stiffness, own.stiffness);
            add(&mut out.gyroscopic, own.gyroscopic);
            add(
                &mut out.damping,
                own.mass * element.damping_of_mass + own.stiffness * element.damping_of_stiffness,
            );
            add(
                &mut out.damping_rotating,
                own.stiffness * element.damping_rotating,
            );
        }
        for disk in &rotor.disks {
            let at = rotor.displacement(disk.node);
            out.mass[(at, at)] += disk.mass;
            out.mass[(at + 1, at + 1)] += disk.diametral;
            out.gyroscopic[(at + 1, at + 1)] += disk.polar;
        }
        for mass in &rotor.masses {
            let at = rotor.displacement(mass.node);
            out.mass[(at, at)] += mass.mass;
        }
        for (index, housing) in rotor.housings.iter().enumerate() {
            let at = 2 * rotor.nodes.len() + index;
            out.mass[(at, at)] += housing.mass;
        }
        out
    }

    /// The same matrices in other coordinates, q = Φη.
    #[must_use]
    pub fn project(&self, basis: &DMatrix<f64>) -> Self {
        let onto = |m: &DMatrix<f64>| basis.tr_mul(&(m * basis));
        Self {
            mass: onto(&self.mass),
            stiffness: onto(&self.stiffness),
            gyroscopic: onto(&self.gyroscopic),
            damping: onto(&self.damping),
            damping_rotating: onto(&self.damping_rotating),
        }
    }

    /// The whole system at a speed in complex coordinates, exact where supports turn with the rotor ([`Rotor::turns`]): of others the part
    /// that does acts.
    ///
    /// `rows` are the rows of the basis for the coordinates of each support, as [`Carried::rows`] gives them.
    pub(crate) fn complex(&self, carried: &Carried, speed: f64) -> Dynamics<C64> {
        let whirl = C64::new(0.0, -speed);
        let mut out = Dynamics {
            mass: self.mass.map(C64::from),
            damping: (&self.damping + &self.damping_rotating).map(C64::from)
                + self.gyroscopic.map(|g| whirl * g),
            stiffness: self
                .stiffness
                .zip_map(&self.damping_rotating, |k, d| C64::from(k) + whirl * d),
        };
        for (row, support) in &carried.rows {
            let block = support.coefficients.at(speed).equal_part();
            let whole = |m: [[f64; 2]; 2]| C64::new(m[0][0], m[1][0]);
            let add = |to: &mut DMatrix<C64>, value: C64| {
                if value != C64::new(0.0, 0.0) {
                    *to += row.tr_mul(row).map(|r| value * r);
                }
            };
            add(&mut out.mass, whole(block.mass));
            add(&mut out.damping, whole(block.damping));
            add(&mut out.stiffness, whole(block.stiffness));
        }
        out
    }

    /// The whole system at a speed in real coordinates: the x-plane first, then the y-plane.
    pub(crate) fn real(&self, carried: &Carried, speed: f64) -> Dynamics<f64> {
        let size = self.mass.nrows();
        let both = |m: &DMatrix<f64>| {
            let mut out = DMatrix::zeros(2 * size, 2 * size);
            out.view_mut((0, 0), (size, size)).copy_from(m);
            out.view_mut((size, size), (size, size)).copy_from(m);
            out
        };
        // -jΩA of w = x + jy: +ΩA y in the x-plane, -ΩA x in the y-plane.
        let turn = |to: &mut DMatrix<f64>, m: &DMatrix<f64>| {
            let mut upper = to.view_mut((0, size), (size, size));
            upper += m * speed;
            let mut lower = to.view_mut((size, 0), (size, size));
            lower -= m * speed;
        };
        let mut out = Dynamics {
            mass: both(&self.mass),
            damping: both(&(&self.damping + &self.damping_rotating)),
            stiffness: both(&self.stiffness),
        };
        turn(&mut out.damping, &self.gyroscopic);
        turn(&mut out.stiffness, &self.damping_rotating);
        for (row, support) in &carried.rows {
            let block = support.coefficients.at(speed);
            let product = row.tr_mul(row);
            let add = |to: &mut DMatrix<f64>, m: [[f64; 2]; 2]| {
                for (i, line) in m.iter().enumerate() {
                    for (j, value) in line.iter().enumerate().filter(|(_, v)| **v != 0.0) {
                        let mut part = to.view_mut((i * size, j * size), (size, size));
                        part += &product * *value;
                    }
                }
            };
            add(&mut out.mass, block.mass);
            add(&mut out.damping, block.damping);
            add(&mut out.stiffness, block.stiffness);
        }
        out
    }
}

/// The supports of a rotor with the row that gives the displacement across each from the coordinates in use.
#[derive(Debug, Clone)]
pub(crate) struct Carried {
    /// Row vector (1 × coordinates) and support.
    pub rows: Vec<(DMatrix<f64>, Support)>,
}

impl Carried {
    /// In the rotor's own coordinates.
    pub fn new(rotor: &Rotor) -> Self {
        let rows = rotor.supports.iter().map(|support| {
            let mut row = DMatrix::zeros(1, rotor.size());
            row[(0, rotor.coordinate(support.at))] = 1.0;
            if let Some(housing) = support.on {
                row[(0, rotor.coordinate(crate::Place::Housing(housing)))] -= 1.0;
            }
            (row, support.clone())
        });
        Self {
            rows: rows.collect(),
        }
    }

    /// In other coordinates, q = Φη.
    pub fn project(&self, basis: &DMatrix<f64>) -> Self {
        let rows = self.rows.iter();
        Self {
            rows: rows
                .map(|(row, support)| (row * basis, support.clone()))
                .collect(),
        }
    }
}

/// M q̈ + C q̇ + K q = F at one speed, over complex or over real coordinates.
#[derive(Debug, Clone)]
pub struct Dynamics<T: ComplexField> {
    /// Mass.
    pub mass: DMatrix<T>,
    /// What multiplies q̇.
    pub damping: DMatrix<T>,
    /// What multiplies q.
    pub stiffness: DMatrix<T>,
}

impl Rotor {
    /// The whole system at a speed (rad/s) over complex coordinates; `None` where a support treats x and y differently.
    #[must_use]
    pub fn complex_dynamics(&self, speed: f64) -> Option<Dynamics<C64>> {
        self.turns()
            .then(|| Matrices::new(self).complex(&Carried::new(self), speed))
    }

    /// The whole system at a speed (rad/s) over real coordinates: (w, ψ, …) of the x-plane, then of the y-plane.
    #[must_use]
    pub fn real_dynamics(&self, speed: f64) -> Dynamics<f64> {
        Matrices::new(self).real(&Carried::new(self), speed)
    }
}
