//! Which coordinates each member of a study takes.
//!
//! ```text
//!   factorial        every combination of levels, the last input fastest
//!   sweep            the machine as given, then each input alone over its levels
//!   monte carlo      independent
//!   widened          independent, from normal numbers that scatter more: rare events are met, and weighed by what they are
//!   latin hypercube  a block has one member in each of its n slices of every input
//!   sobol            a scrambled sequence that fills evenly; best with powers of two
//!   morris           a block is a trajectory: one input after the other moves by half its range
//!   selection        every combination of the levels of some inputs, each with the same draws of the others
//!   saltelli         a block is two points A and B, and A with each input of B in turn
//! ```
//! Sources: Rubinstein, Simulation and the Monte Carlo Method (1981), section 4.3 (weights); McKay, Beckman, Conover, Technometrics 21 (1979) 239 (Latin hypercube); Burley, J. Comput. Graph. Tech. 9 (2020)
//! no. 4, 1 (scrambled Sobol numbers); Morris, Technometrics 33 (1991) 161; Saltelli et al., Comput. Phys. Commun. 181 (2010) 259
//! (all from memory).

use crate::correlation::inside;
use crate::normal::{below as below_normal, quantile};
use crate::random::{below, bits, permuted, uniform};

/// Members of a scrambled Sobol sequence, at most.
pub const MOST_SOBOL: usize = 1 << 16;
/// Coordinates of a scrambled Sobol sequence, at most.
pub const MOST_SOBOL_INPUTS: usize = 256;
/// Levels of an elementary effect: a trajectory moves by half of them.
const LEVELS: usize = 4;
/// The move of a trajectory, as a share of the whole range.
pub const MOVE: f64 = 0.5;

/// Which values the members take.
#[derive(Clone, Debug, PartialEq)]
pub enum Design {
    /// Every combination of levels: their numbers, an input each.
    Factorial(Vec<usize>),
    /// One input at a time over its levels: their numbers.
    Sweep(Vec<usize>),
    /// Independent members: number of inputs, of members.
    MonteCarlo(usize, usize),
    /// Independent members whose normal numbers scatter so many times as much: number of inputs, of members, the factor.
    Widened(usize, usize, f64),
    /// Latin hypercubes: number of inputs, of members in a block, of blocks.
    LatinHypercube(usize, usize, usize),
    /// A scrambled Sobol sequence: number of inputs, of members.
    Sobol(usize, usize),
    /// Trajectories of elementary effects: number of inputs, of trajectories.
    Morris(usize, usize),
    /// Blocks for Sobol indices: number of inputs, of blocks.
    Saltelli(usize, usize),
    /// Candidates: levels of each input, 0 of one that is drawn; number of draws, which all candidates share.
    Selection(Vec<usize>, usize),
}

/// Where a member stands in one input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate {
    /// At the value given.
    Given,
    /// At a level of so many.
    Level(usize, usize),
    /// At the value below which this share lies.
    Share(f64),
}

impl Design {
    /// Number of members; none where it is too large to count.
    pub fn members(&self) -> Option<usize> {
        match self {
            Design::Factorial(levels) => levels.iter().try_fold(1_usize, |n, l| n.checked_mul(*l)),
            Design::Sweep(levels) => levels.iter().try_fold(1_usize, |n, l| n.checked_add(*l)),
            Design::MonteCarlo(_, members)
            | Design::Widened(_, members, _)
            | Design::Sobol(_, members) => Some(*members),
            Design::LatinHypercube(_, members, blocks) => members.checked_mul(*blocks),
            Design::Morris(inputs, blocks) => blocks.checked_mul(inputs + 1),
            Design::Saltelli(inputs, blocks) => blocks.checked_mul(inputs + 2),
            Design::Selection(levels, draws) => {
                let candidates = levels.iter().filter(|count| **count > 0);
                let all = |n: usize, count: &usize| n.checked_mul(*count);
                candidates.clone().try_fold(*draws, all)
            }
        }
    }

    /// The design with so many blocks more; none where it is complete as it is.
    pub fn extended(&self, more: usize) -> Option<Design> {
        Some(match *self {
            Design::Factorial(_) | Design::Sweep(_) | Design::Selection(..) => return None,
            Design::MonteCarlo(inputs, n) => Design::MonteCarlo(inputs, n.checked_add(more)?),
            Design::Widened(inputs, n, factor) => {
                Design::Widened(inputs, n.checked_add(more)?, factor)
            }
            Design::Sobol(inputs, n) => Design::Sobol(inputs, n.checked_add(more)?),
            Design::LatinHypercube(inputs, n, blocks) => {
                Design::LatinHypercube(inputs, n, blocks.checked_add(more)?)
            }
            Design::Morris(inputs, blocks) => Design::Morris(inputs, blocks.checked_add(more)?),
            Design::Saltelli(inputs, blocks) => Design::Saltelli(inputs, blocks.checked_add(more)?),
        })
    }

    /// Whether a member is one of a sample of the distributions, of which shares and means can be asked.
    pub fn is_sample(&self, k: usize) -> bool {
        match self {
            Design::Factorial(_)
            | Design::Sweep(_)
            | Design::Widened(..)
            | Design::Morris(..)
            | Design::Selection(..) => false,
            Design::MonteCarlo(..) | Design::LatinHypercube(..) | Design::Sobol(..) => true,
            Design::Saltelli(inputs, _) => k % (inputs + 2) < 2,
        }
    }

    /// What member k counts for: the density of its numbers over that from which they were drawn,
    ///
    /// ```text
    ///   w = Π s e^(-z² (s² - 1)/2)        of a number s z, z standard normal;  mean 1
    /// ```
    pub fn weight(&self, seed: u64, k: usize) -> f64 {
        match *self {
            Design::Widened(inputs, _, factor) => (0..inputs)
                .map(|input| normal(seed, k, input))
                .map(|z| factor * (-0.5 * z * z * (factor * factor - 1.0)).exp())
                .product(),
            _ => 1.0,
        }
    }

    /// The coordinates of member k.
    pub fn member(&self, seed: u64, k: usize) -> Vec<Coordinate> {
        let share = Coordinate::Share;
        match self {
            Design::Factorial(levels) => combination(levels, k),
            Design::Selection(levels, draws) => {
                let counts: Vec<usize> = levels.iter().map(|count| (*count).max(1)).collect();
                let mut coordinates = combination(&counts, k / draws);
                let drawn = coordinates.iter_mut().zip(levels);
                let drawn = drawn.filter(|(_, count)| **count == 0);
                for (dimension, (coordinate, _)) in drawn.enumerate() {
                    *coordinate = share(sobol(seed, k % draws, dimension));
                }
                coordinates
            }
            Design::Sweep(levels) => {
                let mut coordinates = vec![Coordinate::Given; levels.len()];
                let mut left = k;
                for (input, count) in levels.iter().enumerate() {
                    if (1..=*count).contains(&left) {
                        coordinates[input] = Coordinate::Level(left - 1, *count);
                    }
                    left = left.wrapping_sub(*count);
                    if left == 0 || left > k {
                        break;
                    }
                }
                coordinates
            }
            Design::MonteCarlo(inputs, _) => (0..*inputs)
                .map(|input| share(uniform(seed, k as u64, input as u64)))
                .collect(),
            Design::Widened(inputs, _, factor) => (0..*inputs)
                .map(|input| share(inside(below_normal(factor * normal(seed, k, input)))))
                .collect(),
            Design::LatinHypercube(inputs, members, _) => {
                let (block, at) = ((k / members) as u64, k % members);
                (0..*inputs)
                    .map(|input| {
                        let slice = permuted(at, *members, bits(seed, block, input as u64));
                        let inside = uniform(seed ^ INSIDE, k as u64, input as u64);
                        share((slice as f64 + inside) / *members as f64)
                    })
                    .collect()
            }
            Design::Sobol(inputs, _) => (0..*inputs).map(|i| share(sobol(seed, k, i))).collect(),
            Design::Morris(inputs, _) => trajectory(seed, *inputs, k),
            Design::Saltelli(inputs, _) => {
                let (block, role) = (k / (inputs + 2), k % (inputs + 2));
                let from_b = |input: usize| role == 1 || role == input + 2;
                (0..*inputs)
                    .map(|i| share(sobol(seed, block, i + if from_b(i) { *inputs } else { 0 })))
                    .collect()
            }
        }
    }
}

/// A combination of levels, the last input fastest.
fn combination(levels: &[usize], k: usize) -> Vec<Coordinate> {
    let mut left = k;
    let mut coordinates: Vec<Coordinate> = (levels.iter().rev())
        .map(|count| {
            let at = left % count;
            left /= count;
            Coordinate::Level(at, *count)
        })
        .collect();
    coordinates.reverse();
    coordinates
}

/// A standard normal number.
fn normal(seed: u64, k: usize, input: usize) -> f64 {
    quantile(uniform(seed, k as u64, input as u64))
}

/// Keeps the places inside slices apart from the order of the slices.
const INSIDE: u64 = 0x5851_f42d_4c95_7f2d;

/// A scrambled Sobol number, inside (0, 1).
fn sobol(seed: u64, index: usize, dimension: usize) -> f64 {
    let scramble = bits(seed, 0, 0) as u32;
    let u = sobol_burley::sample(index as u32, dimension as u32, scramble);
    // numbers of 24 bits: the middle of what each stands for
    f64::from(u) + 0.5 / f64::from(1_u32 << 24)
}

/// A member of a trajectory: from a point of the grid each input moves once by half the levels, in an order of its own.
fn trajectory(seed: u64, inputs: usize, k: usize) -> Vec<Coordinate> {
    let (block, step) = ((k / (inputs + 1)) as u64, k % (inputs + 1));
    (0..inputs)
        .map(|input| {
            let start = below(LEVELS, seed, block, input as u64);
            let moved = (start + LEVELS / 2) % LEVELS;
            let at = if turn(seed, inputs, block, input) < step {
                moved
            } else {
                start
            };
            Coordinate::Share((at as f64 + 0.5) / LEVELS as f64)
        })
        .collect()
}

/// Place of an input in the order in which a trajectory moves them.
fn turn(seed: u64, inputs: usize, block: u64, input: usize) -> usize {
    permuted(input, inputs, bits(seed ^ INSIDE, block, inputs as u64))
}

/// The input that step `step` of a trajectory moves (from 0 on), and whether upwards.
pub(crate) fn moved(seed: u64, inputs: usize, block: usize, step: usize) -> (usize, bool) {
    let block = block as u64;
    let input = (0..inputs).find(|input| turn(seed, inputs, block, *input) == step);
    let input = input.unwrap_or(0);
    (input, below(LEVELS, seed, block, input as u64) < LEVELS / 2)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shares(design: &Design, seed: u64, k: usize) -> Vec<f64> {
        let number = |coordinate: Coordinate| match coordinate {
            Coordinate::Share(u) => u,
            other => panic!("{other:?}"),
        };
        design.member(seed, k).into_iter().map(number).collect()
    }

    #[test]
    fn combinations_and_sweeps_are_complete() {
        let design = Design::Factorial(vec![2, 3]);
        assert_eq!(design.members(), Some(6));
        let all: Vec<_> = (0..6).map(|k| design.member(0, k)).collect();
        assert_eq!(all[4], [Coordinate::Level(1, 2), Coordinate::Level(1, 3)]);
        assert!((0..6).all(|k| all[..k].iter().all(|other| *other != all[k])));
        let sweep = Design::Sweep(vec![2, 3]);
        assert_eq!(sweep.members(), Some(6));
        use Coordinate::{Given, Level};
        let all: Vec<_> = (0..6).map(|k| sweep.member(0, k)).collect();
        assert_eq!(all[0], [Given, Given]);
        assert_eq!(all[2], [Level(1, 2), Given]);
        assert_eq!(all[3], [Given, Level(0, 3)]);
        assert_eq!(all[5], [Given, Level(2, 3)]);
    }

    #[test]
    fn candidates_share_their_draws() {
        let design = Design::Selection(vec![2, 0, 3, 0], 8);
        assert_eq!(design.members(), Some(48));
        for k in 0..48 {
            let (own, first) = (design.member(5, k), design.member(5, k % 8));
            assert_eq!([own[1], own[3]], [first[1], first[3]]);
            let candidate = k / 8;
            assert_eq!(own[0], Coordinate::Level(candidate / 3, 2));
            assert_eq!(own[2], Coordinate::Level(candidate % 3, 3));
        }
        assert_ne!(design.member(5, 0)[1], design.member(6, 0)[1]);
        assert_eq!(design.extended(1), None);
    }

    #[test]
    fn a_latin_hypercube_has_each_slice_once_in_every_block() {
        let design = Design::LatinHypercube(3, 20, 2);
        for block in 0..2 {
            for input in 0..3 {
                let mut slices: Vec<usize> = (0..20)
                    .map(|k| (shares(&design, 4, block * 20 + k)[input] * 20.0) as usize)
                    .collect();
                slices.sort_unstable();
                assert!(slices.into_iter().eq(0..20));
            }
        }
    }

    #[test]
    fn a_sequence_has_one_member_in_each_part_of_a_power_of_two() {
        let design = Design::Sobol(5, 64);
        for input in 0..5 {
            let mut parts: Vec<usize> = (0..64)
                .map(|k| (shares(&design, 9, k)[input] * 64.0) as usize)
                .collect();
            parts.sort_unstable();
            assert!(parts.into_iter().eq(0..64), "{input}");
        }
        assert_ne!(shares(&design, 9, 3), shares(&design, 10, 3));
    }

    #[test]
    fn whole_blocks_more_keep_every_member() {
        let designs = [
            Design::MonteCarlo(3, 10),
            Design::LatinHypercube(3, 10, 1),
            Design::Sobol(3, 16),
            Design::Morris(3, 4),
            Design::Saltelli(3, 4),
        ];
        for design in designs {
            let more = design.extended(3).unwrap();
            let members = design.members().unwrap();
            assert!(more.members().unwrap() > members);
            for k in 0..members {
                let bits = |design| shares(design, 7, k).into_iter().map(f64::to_bits);
                assert!(bits(&design).eq(bits(&more)), "{design:?} {k}");
            }
        }
        assert_eq!(Design::Sweep(vec![3]).extended(1), None);
    }

    #[test]
    fn a_trajectory_moves_one_input_at_a_time_by_half_the_range() {
        let design = Design::Morris(4, 50);
        for block in 0..50 {
            let points: Vec<_> = (0..5)
                .map(|step| shares(&design, 1, block * 5 + step))
                .collect();
            for (step, pair) in points.windows(2).enumerate() {
                let (input, up) = moved(1, 4, block, step);
                let wanted = if up { MOVE } else { -MOVE };
                for (other, (before, after)) in pair[0].iter().zip(&pair[1]).enumerate() {
                    assert_eq!(after - before, if other == input { wanted } else { 0.0 });
                }
            }
        }
    }
}
