//! State events: the instants at which a [guard](Machine::guard) falls to zero.
//!
//! A guard is positive while its mode holds. The step at whose end it is not positive is taken again by its lane alone, to the
//! instant at which dense output brings it to zero; where that must be better, by the secant on steps that end there. So no
//! observer, sample or largest value sees a state that was not, but for an event at the very start of a step, which is taken at its end.

use crate::step::Step;
use crate::system::Machine;
use crate::watch;

/// Fraction of a step below which an event lies at its start. It would come again and again: it is taken at the end of the step.
const AT_THE_START: f64 = 1e-9;
/// Times a step is taken again for one event; two suffice where the guard is smooth.
const RETAKES: usize = 5;

/// A step that is taken again because an event lies in it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Retake {
    /// The instant tried before, or the start of the step, s, and the guard there.
    before: (f64, f64),
    /// End of the step in which the event was seen, s.
    within: f64,
    /// Times it was taken again.
    times: usize,
}

/// What the guard says of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Event {
    Absent,
    AtTheEnd,
    /// At an instant within the step, s, to which it is to be taken again.
    Within(f64),
}

/// Looks for a state event in a step, or, where one was found before, whether the step now ends on it.
pub(crate) fn find_event<M: Machine>(step: &mut Step<M>, retake: &mut Option<Retake>) -> Event {
    let (machine, mode, start, end) = (step.machine, step.mode, step.start, step.end);
    let value = machine.guard(mode, end, step.at_end);
    let Some(last) = retake else {
        if value > 0.0 {
            return Event::Absent;
        }
        let at_start = machine.guard(mode, start, step.at_start);
        if at_start <= 0.0 {
            return Event::AtTheEnd;
        }
        let theta = watch::root(step, (0.0, at_start), (1.0, value), |step, theta| {
            let time = step.time(theta);
            {
                let (state, probe) = step.evaluate(theta);
                machine.guard(mode, time, (state, probe))
            }
        });
        let instant = step.time(theta);
        if theta < AT_THE_START || instant <= start || instant >= end {
            return Event::AtTheEnd;
        }
        *retake = Some(Retake {
            before: (start, at_start),
            within: end,
            times: 1,
        });
        return Event::Within(instant);
    };
    let (before, at_before) = last.before;
    let next = end - value * (end - before) / (value - at_before);
    let within = next > start && next <= last.within;
    if value.abs() <= machine.guard_error(mode) || last.times == RETAKES || !within {
        return Event::AtTheEnd;
    }
    last.before = (end, value);
    last.times += 1;
    Event::Within(next)
}
