//! Vectors of space.

use crate::operators::operator;
use crate::{Gather, Real};
use std::ops::Mul;

/// A vector of space, right-handed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vec3<R> {
    /// First component.
    pub x: R,
    /// Second component.
    pub y: R,
    /// Third component.
    pub z: R,
}

impl<R: Real> Vec3<R> {
    /// A vector from its components.
    #[inline(always)]
    pub fn new(x: R, y: R, z: R) -> Self {
        Vec3 { x, y, z }
    }
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Vec3::new(R::zero(), R::zero(), R::zero())
    }
    /// a·b.
    #[inline(always)]
    pub fn dot(self, other: Self) -> R {
        self.x * other.x + self.y * other.y + self.z * other.z
    }
    /// a×b.
    #[inline(always)]
    pub fn cross(self, other: Self) -> Self {
        Vec3::new(
            self.y * other.z - self.z * other.y,
            self.z * other.x - self.x * other.z,
            self.x * other.y - self.y * other.x,
        )
    }
    /// |a|², the square of the length.
    #[inline(always)]
    pub fn length_squared(self) -> R {
        self.dot(self)
    }
    /// The part across a unit vector.
    #[inline(always)]
    #[must_use]
    pub fn across(self, unit: Self) -> Self {
        self - unit * self.dot(unit)
    }
    /// The same vector for every part of a group.
    #[inline(always)]
    #[must_use]
    pub fn grouped(self) -> Vec3<R::Group> {
        Vec3::new(self.x.grouped(), self.y.grouped(), self.z.grouped())
    }
}

operator!([R: Real] Vec3<R>, Add::add, AddAssign::add_assign, |a, b| Vec3::new(a.x + b.x, a.y + b.y, a.z + b.z));
operator!([R: Real] Vec3<R>, Sub::sub, SubAssign::sub_assign, |a, b| Vec3::new(a.x - b.x, a.y - b.y, a.z - b.z));
operator!([R: Real] Vec3<R>, Neg::neg, |a| Vec3::new(-a.x, -a.y, -a.z));
impl<R: Real> Mul<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: R) -> Self {
        Vec3::new(self.x * factor, self.y * factor, self.z * factor)
    }
}

impl<R: Real> Gather<R> for Vec3<f64> {
    type Out = Vec3<R>;
    fn gather<'a>(machine: &dyn Fn(usize) -> &'a Self) -> Vec3<R>
    where
        Self: 'a,
    {
        Vec3::new(
            R::from_lanes(|lane| machine(lane).x),
            R::from_lanes(|lane| machine(lane).y),
            R::from_lanes(|lane| machine(lane).z),
        )
    }
}

/// Angle of a direction from the first axis, rad, between -π and π: what `atan2` gives, for a unit vector.
///
/// Half angles by square roots until the sine is small, then its arc sine; relative error 1e-15.
#[inline(always)]
pub fn direction_angle<R: Real>(cosine: R, sine: R) -> R {
    let (one, half) = (R::one(), R::splat(0.5));
    // of φ/2 the larger of sine and cosine by a root, the other by the sine of φ: no digits are lost at either end
    let beyond = cosine.less(R::zero());
    let large = ((one + cosine.abs()) * half).sqrt();
    let small = sine * half * large.recip();
    let mut s = R::select(beyond, large * sine.sign_or_plus(), small);
    let mut c = R::select(beyond, small.abs(), large);
    for _ in 0..4 {
        s *= (R::splat(2.0) * (one + c)).sqrt().recip();
        c = ((one + c) * half).sqrt();
    }
    R::splat(32.0) * s.asin_small()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Dual;

    #[test]
    fn vectors_are_right_handed() {
        let (x, y) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0));
        assert_eq!(x.cross(y), Vec3::new(0.0, 0.0, 1.0));
        let v = Vec3::new(0.3, -2.0, 5.0);
        assert_eq!(v.across(y), Vec3::new(0.3, 0.0, 5.0));
        assert_eq!(v.cross(v), Vec3::zero());
    }
    #[test]
    fn directions_have_their_angle() {
        for i in -1000..=1000 {
            let angle = std::f64::consts::PI * f64::from(i) / 1000.0;
            let (sine, cosine) = angle.sin_cos();
            let found = direction_angle(cosine, sine);
            // near ±180° sine and cosine themselves know the angle to 2e-16 only
            assert!((found - angle).abs() <= 2e-15 * angle.abs(), "{angle}");
        }
        for angle in [1e-12_f64, -3e-5, 1.5, -2.9] {
            let along = Dual::<1>::variable(angle, 0);
            let (sine, cosine) = Real::sin_cos(along);
            let slope = direction_angle(cosine, sine).partial[0];
            assert!((slope - 1.0).abs() < 1e-13, "{angle}: {slope}");
        }
    }
}
