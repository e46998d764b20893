//! Vectors of the plane.

use crate::Real;
use crate::operators::operator;
use std::ops::Mul;

/// A vector of the plane: x to the right, y up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec2<R> {
    /// Component to the right.
    pub x: R,
    /// Component upwards.
    pub y: R,
}

impl<R: Real> Vec2<R> {
    /// A vector from its components.
    #[inline(always)]
    pub fn new(x: R, y: R) -> Self {
        Vec2 { x, y }
    }
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Vec2::new(R::zero(), R::zero())
    }
    /// a·b.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y
    }
    /// The component of a×b out of the plane.
    #[inline(always)]
    pub fn cross(self, other: Self) -> R {
        self.x * other.y - self.y * other.x
    }
    /// The vector turned by +90°.
    #[inline(always)]
    pub fn turned(self) -> Self {
        Vec2::new(-self.y, self.x)
    }
    /// |a|², the square of the length.
    #[inline(always)]
    pub fn length_squared(self) -> R {
        self.dot(self)
    }
}

operator!([R: Real] Vec2<R>, Add::add, AddAssign::add_assign, |a, b| Vec2::new(a.x + b.x, a.y + b.y));
operator!([R: Real] Vec2<R>, Sub::sub, |a, b| Vec2::new(a.x - b.x, a.y - b.y));
operator!([R: Real] Vec2<R>, Neg::neg, |a| Vec2::new(-a.x, -a.y));
impl<R: Real> Mul<R> for Vec2<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Vec2::new(self.x * factor, self.y * factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn turning_is_counter_clockwise() {
        let e = Vec2::new(1.0, 0.0);
        assert_eq!(e.turned(), Vec2::new(0.0, 1.0));
        assert_eq!(e.cross(e.turned()), 1.0);
        assert_eq!(e.dot(e.turned()), 0.0);
    }
}
