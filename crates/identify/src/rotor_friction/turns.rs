//! Means over whole turns of the rotor: what its unbalance swings averages out of them, and out of nothing shorter.
//!
//! ```text
//!   window    the points of one turn, each half a turn behind the one before; whole where they cover nine tenths of it
//!   swing     root mean square of μ about a straight line over the turn
//!   band      swing/(2π n) of n turns: a radian of phase by which the swing of one does not meet that of the next;
//!             all of the swing where none is whole
//!   n         (windows + 1)/2: half of each is in the next
//! ```

use problem::{note, note::Note};
use statistics::uncertain::Uncertain;

/// Friction at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FrictionPoint {
    /// Time, s.
    pub time: f64,
    /// Slip u of the rotor's surface over the race's, m/s.
    pub slip: Uncertain,
    /// Coefficient of friction μ, 1; along the slip, negative where the race is driven against it.
    pub friction: Uncertain,
    /// Deviation of μ by what all points share.
    pub shared_deviation: f64,
}

/// Part of a turn that must be covered by points to count as whole.
const WHOLE: f64 = 0.9;
/// Largest slip over the smallest of turns that are joined.
const ALIKE: f64 = 1.5;
/// Swing over the mean of μ from which on it is worth a note.
const NOTED: f64 = 0.1;

/// Means over the points of one turn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Window {
    /// Their number.
    count: f64,
    /// Part of the turn that they cover.
    covered: f64,
    /// What they cover, s.
    lasting: f64,
    /// Means: time, |u|, its square, its sign, its deviation.
    time: f64,
    slip: f64,
    slip_square: f64,
    sign: f64,
    slip_deviation: f64,
    /// Means of μ, of its shared deviation, of its own variance.
    friction: f64,
    shared: f64,
    own: f64,
    /// Root mean square of μ about a straight line.
    swing: f64,
}

impl Window {
    fn whole(&self) -> bool {
        self.covered >= WHOLE
    }
}

/// Points by turns of the rotor, counted from the first; where none is whole, one after another.
///
/// - `places`: of each point, turns of the rotor until then, and the part of a turn that it stands for
pub(super) fn windows(points: &[FrictionPoint], places: &[(f64, f64)]) -> Vec<Window> {
    let overlapping = stepped(points, places, 0.5);
    match overlapping.iter().any(Window::whole) {
        true => overlapping,
        false => stepped(points, places, 1.0),
    }
}

/// Windows that begin so many turns apart.
fn stepped(points: &[FrictionPoint], places: &[(f64, f64)], step: f64) -> Vec<Window> {
    let (Some(begin), Some(end)) = (places.first(), places.last()) else {
        return Vec::new();
    };
    let count = ((end.0 - begin.0) / step).floor() as usize + 1;
    (0..count)
        .filter_map(|k| {
            let from = begin.0 + step * k as f64;
            let first = places.partition_point(|place| place.0 < from);
            let last = places.partition_point(|place| place.0 < from + 1.0);
            (first < last).then(|| window(&points[first..last], &places[first..last]))
        })
        .collect()
}

fn window(points: &[FrictionPoint], places: &[(f64, f64)]) -> Window {
    let count = points.len() as f64;
    let mean = |f: &dyn Fn(&FrictionPoint) -> f64| points.iter().map(f).sum::<f64>() / count;
    let covered: f64 = places.iter().map(|place| place.1).sum();
    let (friction, middle) = (
        mean(&|p| p.friction.value),
        places.iter().map(|place| place.0).sum::<f64>() / count,
    );
    // a straight line over the turn, and what is left of it
    let (mut square, mut product, mut sum) = (0.0, 0.0, 0.0);
    for (point, place) in points.iter().zip(places) {
        let (along, off) = (place.0 - middle, point.friction.value - friction);
        square += along * along;
        product += along * off;
        sum += off * off;
    }
    let left = if square > 0.0 {
        sum - product * product / square
    } else {
        sum
    };
    let (from, to) = (points[0].time, points[points.len() - 1].time);
    let spacing = if points.len() > 1 {
        (to - from) / (count - 1.0)
    } else {
        0.0
    };
    Window {
        count,
        covered,
        lasting: to - from + spacing,
        time: mean(&|p| p.time),
        slip: mean(&|p| p.slip.value.abs()),
        slip_square: mean(&|p| p.slip.value.powi(2)),
        sign: mean(&|p| p.slip.value.signum()),
        slip_deviation: mean(&|p| p.slip.deviation),
        friction,
        shared: mean(&|p| p.shared_deviation),
        own: mean(&|p| p.friction.deviation.powi(2) - p.shared_deviation.powi(2)).max(0.0),
        swing: (left.max(0.0) / count).sqrt(),
    }
}

/// Turns of nearly the same slip, from the smallest slip to the largest; turns that are not whole only where none is.
pub(super) fn joined(windows: &[Window], ranges: usize) -> Vec<Vec<&Window>> {
    let mut sorted: Vec<&Window> = windows.iter().filter(|window| window.whole()).collect();
    if sorted.is_empty() {
        sorted = windows.iter().collect();
    }
    sorted.sort_by(|a, b| a.slip.total_cmp(&b.slip));
    let width = sorted.last().map_or(0.0, |window| window.slip) / ranges as f64;
    let mut list: Vec<Vec<&Window>> = Vec::new();
    for window in sorted {
        match list.last_mut() {
            Some(part)
                if window.slip <= part[0].slip + width && window.slip <= ALIKE * part[0].slip =>
            {
                part.push(window);
            }
            _ => list.push(vec![window]),
        }
    }
    list
}

/// The mean of windows: of those that are whole, where one is.
///
/// - `correlation_time`: of the errors of single points, s
pub(super) fn mean(part: &[&Window], correlation_time: f64) -> FrictionPoint {
    let whole: Vec<&Window> = (part.iter().copied())
        .filter(|window| window.whole())
        .collect();
    let of = if whole.is_empty() {
        part
    } else {
        whole.as_slice()
    };
    let count: f64 = of.iter().map(|window| window.count).sum();
    let mean = |f: &dyn Fn(&Window) -> f64| of.iter().map(|w| w.count * f(w)).sum::<f64>() / count;
    // half of a whole turn is in the next
    let turns = match whole.len() {
        0 => of.len() as f64,
        some => 0.5 * (some as f64 + 1.0),
    };
    let lasting = turns * mean(&|w| w.lasting);
    let independent = if correlation_time > 0.0 {
        (lasting / correlation_time).clamp(1.0, count)
    } else {
        count
    };
    let swing = mean(&|w| w.swing * w.swing).sqrt();
    let swing = if whole.is_empty() {
        swing
    } else {
        swing / (std::f64::consts::TAU * turns)
    };
    let shared = mean(&|w| w.shared);
    let slip = mean(&|w| w.slip);
    let spread = (mean(&|w| w.slip_square) - slip * slip).max(0.0).sqrt();
    let sign = if mean(&|w| w.sign) < 0.0 { -1.0 } else { 1.0 };
    FrictionPoint {
        time: mean(&|w| w.time),
        slip: Uncertain::new(sign * slip, mean(&|w| w.slip_deviation).hypot(spread)),
        friction: Uncertain::new(
            mean(&|w| w.friction),
            shared
                .hypot((mean(&|w| w.own) / independent).sqrt())
                .hypot(swing),
        ),
        shared_deviation: shared,
    }
}

/// What is worth a word: a swing, or that nothing averages it out.
pub(super) fn note(windows: &[Window]) -> Option<Note> {
    if !windows.iter().any(Window::whole) {
        return Some(note!(
            "the rotor slides for less than a turn at a time: what its unbalance swings is not averaged out of μ, and is in its band"
        ));
    }
    let whole = || windows.iter().filter(|window| window.whole());
    let count = whole().map(|window| window.count).sum::<f64>();
    let mean = |f: &dyn Fn(&Window) -> f64| whole().map(|w| w.count * f(w)).sum::<f64>() / count;
    let (swing, size) = (mean(&|w| w.swing * w.swing).sqrt(), mean(&|w| w.friction));
    (swing > NOTED * size.abs()).then(|| {
        note!(
            "μ swings by ± {:.0} % (one deviation) within a turn of the rotor, where its load is taken as it is given: means over whole turns count, not single points",
            100.0 * swing / size.abs()
        )
    })
}
