//! Members that stand together in a file, and how many are computed at a time.

use outcome::host::{bounded, threads, timed};
use outcome::options::Options;
use std::ops::Range;
use std::sync::atomic::Ordering;

/// Members of a part.
pub const PART: usize = 64;
/// Members that a thread has at a time, at most and at first: so that its lanes stay full, and what is not written is soon done again.
const A_THREAD: usize = 64;
const AT_FIRST: usize = 8;
/// What takes less time than this is written with more, s.
const SOON: f64 = 10.0;

/// How many parts so many members have.
pub fn count(members: usize) -> usize {
    members.div_ceil(PART)
}

/// The members of a part.
pub fn members(part: usize, all: usize) -> Range<usize> {
    part * PART..((part + 1) * PART).min(all)
}

/// The part of a member.
pub fn part_of(member: usize) -> usize {
    member / PART
}

/// Computes what is lacking, some at a time until an interrupt: a kill takes what is not written, so that members of seconds are written by
/// few, those of milliseconds by many; those that coast down, whose lanes part, at first by one a thread.
///
/// # Errors
/// The first of a turn, which is the last one.
pub fn in_turns<E>(
    lacking: &[usize],
    options: &Options,
    coasts: bool,
    mut turn: impl FnMut(&[usize]) -> Result<(), E>,
) -> Result<(), E> {
    let at_first = if coasts { 1 } else { AT_FIRST };
    let threads = options.threads.map_or_else(threads, bounded);
    let (mut size, most) = (threads * at_first, (threads * A_THREAD).max(PART));
    let mut rest = lacking;
    while !rest.is_empty() {
        let some;
        (some, rest) = rest.split_at(size.min(rest.len()));
        let (made, seconds) = timed(|| turn(some));
        made?;
        if options.interrupt.load(Ordering::Relaxed) {
            break;
        }
        if seconds < SOON {
            // no more than there are already, so that turns end with the parts
            size = most.min(2 * size).min(lacking.len() - rest.len());
        }
    }
    Ok(())
}
