//! Quantities with units: read `"25 mm"`, convert to SI, print again.
//!
//! Inside the program every number is SI. This crate is the edge where people's units come in and go out.
//!
//! - Angle is a base dimension here, so `rpm`, `rad/s` and `deg/s` are distinguished from `Hz` and from bare numbers.
//!   Torque (`N m`) and energy (`J`) are the same dimension.
//! - Decimal units are exact: `"0.25 mm"` gives the same `f64` as the literal `0.00025`, because the power of ten of the
//!   unit is added to the exponent of the number before it becomes a float. SI units have the factor 1 exactly.
//! - `degC` is an absolute temperature and stands alone; in a product write `K`.
//! - One `/` only, and one factor or one pair of brackets after it: `W/(m K)`, never `W/m K`.
//!
//! ```
//! let gap = units::parse_quantity("0.25 mm").unwrap();
//! assert_eq!(gap.value_si, 0.00025);
//! assert_eq!(gap.dimension.name(), Some("length"));
//! assert_eq!(units::display(gap.value_si, "um").unwrap(), "250 um");
//! ```

#![forbid(unsafe_code)]
#![deny(clippy::disallowed_methods, clippy::disallowed_types)]

/// 0 °C, K. Source: definition of the degree Celsius.
pub const ICE_POINT: f64 = 273.15;
/// Standard acceleration of gravity, m/s². Source: definition, ISO 80000-3.
pub const STANDARD_GRAVITY: f64 = 9.80665;

mod dimension;
mod error;
mod near;
mod product;
mod quantity;
mod rational;
mod symbols;
mod unit;

pub use dimension::Dimension;
pub use error::ParseError;
pub use near::{edit_distance, nearest_names};
pub use product::as_product;
pub use quantity::{Quantity, display, number_text, parse_quantity};
pub use rational::Rational;
pub use unit::Unit;
