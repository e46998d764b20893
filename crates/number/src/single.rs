//! One machine whose equal parts are computed several at a time.

use crate::Real;
use crate::elementary::*;
use crate::operators::operators;
use crate::pair::Pair;
use crate::real::Vectorized;
use crate::scalar::scalar_real;
use std::marker::PhantomData;

/// A vector that holds one part of a machine per lane.
pub trait Parts: Bits {
    /// The parts from `from` on; the last one repeated behind the end of the list.
    fn load(parts: &[f64], from: usize) -> Self;
    /// Writes the parts from `from` on, as far as the list goes.
    fn store(self, parts: &mut [f64], from: usize);
    /// Adds the first `count` parts to four sums, part `i` to sum `i mod 4`, one after the other.
    fn add_to(self, sums: &mut [f64; 4], count: usize);
}

impl<V: Parts> Parts for Pair<V> {
    #[inline(always)]
    fn load(parts: &[f64], from: usize) -> Self {
        Pair(V::load(parts, from), V::load(parts, from + V::LANES))
    }
    #[inline(always)]
    fn store(self, parts: &mut [f64], from: usize) {
        self.0.store(parts, from);
        self.1.store(parts, from + V::LANES);
    }
    #[inline(always)]
    fn add_to(self, sums: &mut [f64; 4], count: usize) {
        self.0.add_to(sums, count);
        self.1.add_to(sums, count.saturating_sub(V::LANES));
    }
}

/// One machine whose parts fill the lanes of `V`.
#[derive(Debug)]
#[repr(transparent)]
pub struct Single<V>(f64, PhantomData<V>);

impl<V> Single<V> {
    #[inline(always)]
    fn new(value: f64) -> Self {
        Single(value, PhantomData)
    }
    #[inline(always)]
    fn values(list: &[Self]) -> &[f64] {
        // SAFETY: transparent over f64.
        unsafe { std::slice::from_raw_parts(list.as_ptr().cast(), list.len()) }
    }
    #[inline(always)]
    fn values_mut(list: &mut [Self]) -> &mut [f64] {
        // SAFETY: transparent over f64.
        unsafe { std::slice::from_raw_parts_mut(list.as_mut_ptr().cast(), list.len()) }
    }
}
impl<V> Clone for Single<V> {
    #[inline(always)]
    fn clone(&self) -> Self {
        *self
    }
}
impl<V> Copy for Single<V> {}

operators!(
    [V] Single<V>, |x, y|
    Single::new(x.0 + y.0),
    Single::new(x.0 - y.0),
    Single::new(x.0 * y.0),
    Single::new(x.0 / y.0),
    Single::new(-x.0)
);

scalar_real!(impl [V: Parts] for Single<V>, |x| x.0, Single::new, {
    type Group = V;
    const GROUP: usize = V::LANES;
    #[inline(always)]
    fn grouped(self) -> V {
        V::splat(self.0)
    }
    #[inline(always)]
    fn load_group(parts: &[Self], from: usize) -> V {
        V::load(Self::values(parts), from)
    }
    #[inline(always)]
    fn store_group(group: V, parts: &mut [Self], from: usize) {
        group.store(Self::values_mut(parts), from);
    }
    #[inline(always)]
    fn add_group(group: V, sums: &mut [Self; 4], _from: usize, count: usize) {
        let mut values = [sums[0].0, sums[1].0, sums[2].0, sums[3].0];
        group.add_to(&mut values, count);
        for (sum, value) in sums.iter_mut().zip(&values) {
            sum.0 = *value;
        }
    }
    #[inline(always)]
    fn vectorized<T: Vectorized>(task: T) -> T::Output {
        V::vectorized(task)
    }
});
