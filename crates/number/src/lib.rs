//! One number, three shapes.
//!
//! Every law, part, system and solver of auxbear is written once over [`Real`] and runs on
//!
//! - `f64`: one machine;
//! - several machines side by side, one per lane of the vector unit, each with its own constants and its own step;
//! - one machine whose equal parts (balls) are computed several at a time, a [`Real::Group`];
//! - [`Dual`]: one machine with `K` partial derivatives.
//!
//! [`Level`] sees at run time what the machine can do and hands a [`Task`] the number type to use: the code outside
//! this crate never names a vector type.
//! All shapes give bitwise the same result: they share the elementary functions ([`elementary`]), nothing is
//! contracted (`mul_add`), and nothing branches on a lane.
//!
//! # Accuracy of the elementary functions
//! Measured against the platform's `libm`, in units of the last place (ulp) of the result unless said:
//!
//! | function | range | largest error |
//! |---|---|---|
//! | `exp` | -700 ≤ x ≤ 700 (clamped outside) | 2 ulp |
//! | `ln` | normal x > 0 | 2 ulp (near 1: 4 ulp) |
//! | `powf` | 1e-300 ≤ x^y ≤ 1e300 | relative 2.3e-16 (2 + \|y ln x\|) |
//! | `tanh` | all x | 5 ulp |
//! | `tanh_pair` | all x | 6 ulp |
//! | `sin_cos` | \|x\| ≤ 1e5 rad | absolute 2.3e-16 |
//! | `asin_small` | \|x\| ≤ 0.125 | 2 ulp |
//! | `sqrt`, `abs`, `+ - * /` | all | correctly rounded |

mod constants;
mod dual;
pub mod elementary;
mod level;
#[cfg(target_arch = "x86_64")]
mod pair;
mod real;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod single;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use constants::Gather;
pub use dual::Dual;
pub use level::{Level, Task};
pub use real::{Mask, Real, Vectorized};
pub use vector::Vec2;
