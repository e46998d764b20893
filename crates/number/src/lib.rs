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
//! | `two_thirds` | 1e-300 ≤ x ≤ 1e300 | 2 ulp |
//! | `asin_small` | \|x\| ≤ 0.125 | 2 ulp |
//! | `sqrt`, `abs`, `+ - * /` | all | correctly rounded |
//!
//! # Why the unsafe code is sound
//! Beside the C interface of co-simulation units this is the only crate with unsafe code; all others forbid it. There are three kinds:
//!
//! - **Instructions that a machine may not have** (`x86.rs`, `dual.rs`). An intrinsic is undefined behaviour only where the
//!   machine lacks its instructions, or where it reaches memory that is not there. The vector types and their masks are private,
//!   their only constructors are methods of [`Real`] and [`Mask`], and no public item names them: code outside has such a type
//!   only as the parameter of a [`Task`], which [`Level::run_one`] and [`Level::run_many`] start after they asserted
//!   `level <= Level::detect()`. Detection asks for exactly the features that `avx2::run` and `avx512::run` enable, AVX2 among those
//!   of AVX-512, so that the order of the levels is one of inclusion. [`Dual`] calls these two functions in the branch of the
//!   level that was detected. A value cannot outlive the machine.
//! - **Loads and stores of vectors** (`x86.rs`). `Four` loads and stores four numbers through a slice of four that `get` returned,
//!   or lane by lane. `Eight` masks the lanes behind the end of the slice, and masked lanes are not accessed: the pointer, which
//!   may then lie outside, is made by `wrapping_add` and never read. An empty list panics before. `add_to` loads and stores the
//!   four numbers of an array of four. None of these asks for alignment.
//! - **The same bits as another type.** An array of four or eight `f64` has the size of the vector that it is transmuted to, which
//!   the compiler checks, and every pattern of bits is a value of both. `Single<V>` is `repr(transparent)` over `f64` beside a
//!   `PhantomData`, so that a slice of one is a slice of the other, of the same length, alignment and lifetime, borrowed in the same
//!   way.
//!
//! Every method is tested on every level of the machine against `f64`, bit by bit. Miri has not been run on it.

#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

mod constants;
mod dual;
pub mod elementary;
mod level;
mod operators;
#[cfg(target_arch = "x86_64")]
mod pair;
mod real;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod single;
mod space;
mod vector;
#[cfg(target_arch = "x86_64")]
mod x86;

pub use constants::Gather;
pub use dual::Dual;
pub use level::{Level, Task};
pub use real::{Mask, Real, Vectorized};
pub use space::{Vec3, direction_angle};
pub use vector::Vec2;
