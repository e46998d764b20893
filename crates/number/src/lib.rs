//! One number, three shapes.
//!
//! Every law, part, system and solver of auxbear is written once over [`Real`] and runs on
//!
//! - `f64`: one machine;
//! - [`Lanes`]: `W` machines side by side, one per SIMD lane, each with its own constants and its own step;
//! - [`Dual`]: one machine with `K` partial derivatives.
//!
//! A lane gives bitwise the result of the scalar run: all shapes share the same elementary functions
//! ([`elementary`]), nothing is contracted (`mul_add`), and nothing branches on a lane.
//! A single `f64` machine computes its equal parts (balls) four at a time as a [`Real::Group`].
//! [`Level`] picks the widest vector unit at run time.
//!
//! # Accuracy of the elementary functions
//! Measured against the platform's `libm`, in units of the last place (ulp) of the result unless said:
//!
//! | function | range | largest error |
//! |---|---|---|
//! | `exp` | -700 ≤ x ≤ 700 (clamped outside) | 2 ulp |
//! | `ln` | normal x > 0 | 2 ulp (near 1: 4 ulp) |
//! | `powf` | 1e-300 ≤ x^y ≤ 1e300 | relative 2.3e-16 (2 + \|y ln x\|) |
//! | `tanh` | all x | 4 ulp |
//! | `sin_cos` | \|x\| ≤ 1e5 rad | absolute 2.3e-16 |
//! | `asin_small` | \|x\| ≤ 0.125 | 2 ulp |
//! | `sqrt`, `abs`, `+ - * /` | all | correctly rounded |

mod constants;
mod dual;
pub mod elementary;
mod lanes;
mod level;
mod real;
mod vector;

pub use constants::Gather;
pub use dual::Dual;
pub use lanes::{LaneMask, Lanes};
pub use level::{Level, Task};
pub use real::{Mask, Real};
pub use vector::Vec2;
