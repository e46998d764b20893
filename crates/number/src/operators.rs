//! Operators of numbers and masks, each written as what it gives.

/// An operator of two numbers, with its assignment where that is named, or of one.
macro_rules! operator {
    ([$($generics:tt)*] $Type:ty, $Trait:ident::$method:ident, |$x:ident| $result:expr) => {
        impl<$($generics)*> std::ops::$Trait for $Type {
            type Output = Self;
            #[inline(always)]
            fn $method(self) -> Self {
                let $x = self;
                $result
            }
        }
    };
    ([$($generics:tt)*] $Type:ty, $Trait:ident::$method:ident, |$x:ident, $y:ident| $result:expr) => {
        impl<$($generics)*> std::ops::$Trait for $Type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let ($x, $y) = (self, other);
                $result
            }
        }
    };
    ([$($generics:tt)*] $Type:ty, $Trait:ident::$method:ident, $Assign:ident::$assign:ident, |$x:ident, $y:ident| $result:expr) => {
        $crate::operators::operator!([$($generics)*] $Type, $Trait::$method, |$x, $y| $result);
        impl<$($generics)*> std::ops::$Assign for $Type {
            #[inline(always)]
            fn $assign(&mut self, other: Self) {
                *self = std::ops::$Trait::$method(*self, other);
            }
        }
    };
}
pub(crate) use operator;

/// The operators of [`Real`](crate::Real): sum, difference, product, quotient and the negative.
macro_rules! operators {
    ([$($generics:tt)*] $Type:ty, |$x:ident, $y:ident| $sum:expr, $difference:expr, $product:expr, $quotient:expr, $negative:expr) => {
        $crate::operators::operator!([$($generics)*] $Type, Add::add, AddAssign::add_assign, |$x, $y| $sum);
        $crate::operators::operator!([$($generics)*] $Type, Sub::sub, SubAssign::sub_assign, |$x, $y| $difference);
        $crate::operators::operator!([$($generics)*] $Type, Mul::mul, MulAssign::mul_assign, |$x, $y| $product);
        $crate::operators::operator!([$($generics)*] $Type, Div::div, |$x, $y| $quotient);
        $crate::operators::operator!([$($generics)*] $Type, Neg::neg, |$x| $negative);
    };
}
pub(crate) use operators;

/// The operators of [`Mask`](crate::Mask): both, either and not.
macro_rules! mask_operators {
    ([$($generics:tt)*] $Type:ty, |$x:ident, $y:ident| $both:expr, $either:expr, $not:expr) => {
        $crate::operators::operator!([$($generics)*] $Type, BitAnd::bitand, |$x, $y| $both);
        $crate::operators::operator!([$($generics)*] $Type, BitOr::bitor, |$x, $y| $either);
        $crate::operators::operator!([$($generics)*] $Type, Not::not, |$x| $not);
    };
}
pub(crate) use mask_operators;
