//! Two vectors as one number.
//!
//! The arithmetic of a ball is one long chain in which every operation waits for the one before: two independent
//! chains side by side keep the vector unit busy.

use crate::elementary::{Bits, elementary_functions};
use crate::operators::{mask_operators, operators};
use crate::real::Vectorized;
use crate::scalar::group_of_one;
use crate::{Mask, Real};

/// Two numbers, or two masks, side by side: the lanes of the first, then those of the second.
#[derive(Clone, Copy, Debug)]
pub struct Pair<V>(pub V, pub V);

operators!(
    [V: Real] Pair<V>, |x, y|
    Pair(x.0 + y.0, x.1 + y.1),
    Pair(x.0 - y.0, x.1 - y.1),
    Pair(x.0 * y.0, x.1 * y.1),
    Pair(x.0 / y.0, x.1 / y.1),
    Pair(-x.0, -x.1)
);
mask_operators!([M: Mask] Pair<M>, |x, y| Pair(x.0 & y.0, x.1 & y.1), Pair(x.0 | y.0, x.1 | y.1), Pair(!x.0, !x.1));

impl<M: Mask> Mask for Pair<M> {
    const LANES: usize = 2 * M::LANES;
    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }
    #[inline(always)]
    fn lane(self, index: usize) -> bool {
        if index < M::LANES {
            self.0.lane(index)
        } else {
            self.1.lane(index - M::LANES)
        }
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> bool) -> Self {
        let first = M::from_lanes(&mut lane);
        Pair(first, M::from_lanes(|i| lane(M::LANES + i)))
    }
}

/// A method of both halves.
macro_rules! halves {
    ($($method:ident($($other:ident)?);)*) => {$(
        #[inline(always)]
        fn $method(self $(, $other: Self)?) -> Self {
            Pair(self.0.$method($($other.0)?), self.1.$method($($other.1)?))
        }
    )*};
}

impl<V: Bits> Real for Pair<V> {
    type Mask = Pair<V::Mask>;
    const LANES: usize = 2 * V::LANES;
    group_of_one!();
    halves! { sqrt(); abs(); round(); max(other); min(other); }
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Pair(V::splat(value), V::splat(value))
    }
    #[inline(always)]
    fn from_lanes(mut lane: impl FnMut(usize) -> f64) -> Self {
        let first = V::from_lanes(&mut lane);
        Pair(first, V::from_lanes(|i| lane(V::LANES + i)))
    }
    #[inline(always)]
    fn lane(self, index: usize) -> f64 {
        if index < V::LANES {
            self.0.lane(index)
        } else {
            self.1.lane(index - V::LANES)
        }
    }
    elementary_functions!();
    #[inline(always)]
    fn vectorized<T: Vectorized>(task: T) -> T::Output {
        V::vectorized(task)
    }
    #[inline(always)]
    fn greater(self, other: Self) -> Self::Mask {
        Pair(self.0.greater(other.0), self.1.greater(other.1))
    }
    #[inline(always)]
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self {
        Pair(
            V::select(mask.0, yes.0, no.0),
            V::select(mask.1, yes.1, no.1),
        )
    }
}

impl<V: Bits> Bits for Pair<V> {
    halves! { exp2_shifted(); near_inverse_cube_root(); negated_where_negative(other); negated_by_bit_one(shifted); }
    #[inline(always)]
    fn mantissa_exponent(self) -> (Self, Self) {
        let (first, second) = (self.0.mantissa_exponent(), self.1.mantissa_exponent());
        (Pair(first.0, second.0), Pair(first.1, second.1))
    }
    #[inline(always)]
    fn odd_shifted(self) -> Self::Mask {
        Pair(self.0.odd_shifted(), self.1.odd_shifted())
    }
}
