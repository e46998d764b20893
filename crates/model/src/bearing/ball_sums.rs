//! Sums and maxima over the balls of a bearing.

use number::Real;

/// Sums over the balls in an order that does not depend on how many balls are computed at a time: ball `j` adds to
/// part `j mod 4`, and the four parts are added last. So a lane of many machines equals the machine alone bitwise.
pub(crate) struct BallSums<R: Real, const K: usize> {
    count: usize,
    part: [[R; 4]; K],
}

impl<R: Real, const K: usize> BallSums<R, K> {
    /// Empty sums over so many balls.
    #[inline(always)]
    pub fn new(count: usize) -> Self {
        BallSums {
            count,
            part: [[R::zero(); 4]; K],
        }
    }
    /// Adds the group of balls that starts at `from`.
    #[inline(always)]
    pub fn add(&mut self, from: usize, values: &[R::Group; K]) {
        let count = self.count - from;
        for (part, value) in self.part.iter_mut().zip(values) {
            R::add_group(*value, part, from, count);
        }
    }
    /// The sums.
    #[inline(always)]
    pub fn total(&self) -> [R; K] {
        // a loop, not `map`: the closure of `map` would not be compiled for the vector unit
        let mut total = [R::zero(); K];
        for (sum, part) in total.iter_mut().zip(&self.part) {
            *sum = (part[0] + part[1]) + (part[2] + part[3]);
        }
        total
    }
}

/// The largest of one of the lists of a detail; zero where no detail was asked for.
#[inline(always)]
pub(crate) fn largest<R: Real>(detail: &[R], balls: usize, list: usize) -> R {
    let mut largest = R::zero();
    if !detail.is_empty() {
        for value in &detail[list * balls..(list + 1) * balls] {
            largest = largest.max(*value);
        }
    }
    largest
}

/// The largest of the parts of a group.
#[inline(always)]
pub(crate) fn largest_part<R: Real>(group: R::Group) -> R {
    let mut parts = [R::zero(); MOST_PARTS];
    R::store_group(group, &mut parts[..R::GROUP], 0);
    let mut largest = parts[0];
    for part in &parts[1..R::GROUP] {
        largest = largest.max(*part);
    }
    largest
}

/// Parts of the largest group.
const MOST_PARTS: usize = 16;
