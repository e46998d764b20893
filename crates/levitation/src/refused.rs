//! What is refused, in words.

use std::fmt;

/// Why a levitation cannot be built or analysed.
#[derive(Debug, Clone, PartialEq)]
pub enum Refused {
    /// Matrices of a state space that do not fit, as (rows, columns).
    MatrixSizes {
        /// Of A.
        a: (usize, usize),
        /// Of B.
        b: (usize, usize),
        /// Of C.
        c: (usize, usize),
        /// Of D.
        d: (usize, usize),
    },
    /// A coefficient that is infinite or no number.
    NotFinite,
    /// A filter of more than second order, or with more zeros than poles: coefficients of num and den.
    Filter {
        /// Coefficients of num.
        num: usize,
        /// Coefficients of den.
        den: usize,
    },
    /// A derivative without a time constant above zero, s.
    DerivativeCorner(f64),
    /// A node that the rotor does not have.
    Node {
        /// The axis.
        axis: String,
        /// Its node.
        node: usize,
        /// Nodes of the rotor.
        nodes: usize,
    },
    /// A controller of another size than sensors and magnets.
    ControllerSize {
        /// Inputs and outputs of the controller.
        found: (usize, usize),
        /// Axes of sensors and of magnets.
        needed: (usize, usize),
    },
    /// A time of the controller that cannot be.
    Time {
        /// Which.
        what: &'static str,
        /// Its value, s.
        value: f64,
        /// What is allowed.
        allowed: &'static str,
    },
    /// A value of a sensor, an amplifier or a magnet that must be above zero.
    NotPositive {
        /// The axis.
        axis: String,
        /// Which.
        what: &'static str,
        /// Its value.
        value: f64,
    },
    /// A bias above the largest current of a coil, A.
    Bias {
        /// The axis.
        axis: String,
        /// Bias.
        bias: f64,
        /// Largest current.
        largest: f64,
    },
    /// The steps of an eigenvalue solution did not end.
    NoEigenvalues,
    /// The equations of an answer have none: the loop has an eigenvalue there.
    Singular,
    /// The magnets cannot hold the rotor where its sensors want it.
    NoEquilibrium,
}

impl fmt::Display for Refused {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MatrixSizes { a, b, c, d } => {
                let size = |(rows, columns): &(usize, usize)| format!("{rows} × {columns}");
                write!(
                    out,
                    "matrices that do not fit: A {}, B {}, C {}, D {}; n states, m inputs and p outputs need A n × n, B n × m, C p × n, D p × m",
                    size(a),
                    size(b),
                    size(c),
                    size(d)
                )
            }
            Self::NotFinite => write!(out, "a coefficient that is no finite number"),
            Self::Filter { num, den } => write!(
                out,
                "{num} coefficients over {den}; a filter has 1 to 3 below and at most as many above, the highest power first"
            ),
            Self::DerivativeCorner(value) => write!(
                out,
                "a derivative with the time constant {value} s; it must be above 0, or noise would be amplified without bound"
            ),
            Self::Node { axis, node, nodes } => write!(
                out,
                "{axis} at node {node}; the rotor has nodes 0 to {}",
                nodes.saturating_sub(1)
            ),
            Self::ControllerSize { found, needed } => write!(
                out,
                "a controller from {} signals to {} commands; {} sensor axes and {} magnet axes are there",
                found.0, found.1, needed.0, needed.1
            ),
            Self::Time {
                what,
                value,
                allowed,
            } => write!(out, "{what} {value} s; allowed is {allowed}"),
            Self::NotPositive { axis, what, value } => {
                write!(out, "{axis}: {what} {value}; it must be above 0")
            }
            Self::Bias {
                axis,
                bias,
                largest,
            } => write!(
                out,
                "{axis}: a bias of {bias} A above the largest current of a coil, {largest} A"
            ),
            Self::NoEigenvalues => write!(out, "the eigenvalues were not found"),
            Self::Singular => write!(
                out,
                "no answer: the closed loop has an eigenvalue at the frequency asked for"
            ),
            Self::NoEquilibrium => write!(
                out,
                "the magnets cannot hold the rotor: no equilibrium within gaps and currents"
            ),
        }
    }
}

impl std::error::Error for Refused {}
