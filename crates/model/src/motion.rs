//! What parts see and what they answer.

use number::{Real, Vec2};
use std::ops::{Add, AddAssign, Neg};

/// Position and speed of a body that spins about an axis out of the plane.
///
/// Six degrees of freedom: two in the plane, one along the axis, two of tilt, one of spin.
/// A planar part ignores axial and tilt motion and says so.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body<R> {
    /// Centre in the plane, m.
    pub position: Vec2<R>,
    /// Centre along the axis, m.
    pub axial: R,
    /// Tilt about x and y: of its axis -a_y and a_x, for small ones in rad.
    pub tilt: Vec2<R>,
    /// Angle about the axis, rad.
    pub angle: R,
    /// Speed of the centre in the plane, m/s.
    pub velocity: Vec2<R>,
    /// Speed along the axis, m/s.
    pub axial_speed: R,
    /// Rate of tilt about x and y, rad/s.
    pub tilt_rate: Vec2<R>,
    /// Angular speed about the axis, rad/s.
    pub spin: R,
}

impl<R: Real> Body<R> {
    /// A body that moves in the plane only.
    #[inline(always)]
    pub fn planar(position: Vec2<R>, velocity: Vec2<R>, angle: R, spin: R) -> Self {
        Body {
            position,
            axial: R::zero(),
            tilt: Vec2::zero(),
            angle,
            velocity,
            axial_speed: R::zero(),
            tilt_rate: Vec2::zero(),
            spin,
        }
    }
}

/// Motion of the two bodies a bearing connects. The system owns both.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motion<R> {
    /// Inner race with its sleeve.
    pub inner: Body<R>,
    /// Outer race with its housing.
    pub outer: Body<R>,
}

/// Force and moment on a body, the moment about its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wrench<R> {
    /// Force in the plane, N.
    pub force: Vec2<R>,
    /// Force along the axis, N.
    pub axial_force: R,
    /// Moment about x and y, N m.
    pub tilt_moment: Vec2<R>,
    /// Moment about the axis, N m.
    pub moment: R,
}

impl<R: Real> Wrench<R> {
    /// A wrench of the plane.
    #[inline(always)]
    pub fn planar(force: Vec2<R>, moment: R) -> Self {
        Wrench {
            force,
            axial_force: R::zero(),
            tilt_moment: Vec2::zero(),
            moment,
        }
    }
    /// No force, no moment.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::planar(Vec2::zero(), R::zero())
    }
}

impl<R: Real> Add for Wrench<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Wrench {
            force: self.force + other.force,
            axial_force: self.axial_force + other.axial_force,
            tilt_moment: self.tilt_moment + other.tilt_moment,
            moment: self.moment + other.moment,
        }
    }
}
impl<R: Real> AddAssign for Wrench<R> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}
impl<R: Real> Neg for Wrench<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Wrench {
            force: -self.force,
            axial_force: -self.axial_force,
            tilt_moment: -self.tilt_moment,
            moment: -self.moment,
        }
    }
}
