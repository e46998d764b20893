//! What happens at known instants, as data: the solver lands on each, and the system switches there.

/// Events in the order of their times.
#[derive(Clone, Debug, PartialEq)]
pub struct Schedule<E> {
    /// Events before the run or at its start.
    at_the_start: Vec<E>,
    instants: Vec<f64>,
    events: Vec<E>,
}

impl<E> Default for Schedule<E> {
    fn default() -> Self {
        Schedule {
            at_the_start: Vec::new(),
            instants: Vec::new(),
            events: Vec::new(),
        }
    }
}

impl<E: Copy> Schedule<E> {
    /// Events at their times, s: those not after 0 are there from the start, those at no finite time never come. Of several at
    /// one time the order is kept.
    pub fn of(events: impl IntoIterator<Item = (f64, E)>) -> Self {
        let mut schedule = Schedule::default();
        let mut later: Vec<(f64, E)> = Vec::new();
        for (time, event) in events {
            if time <= 0.0 {
                schedule.at_the_start.push(event);
            } else if time.is_finite() {
                later.push((time, event));
            }
        }
        later.sort_by(|a, b| a.0.total_cmp(&b.0));
        (schedule.instants, schedule.events) = later.into_iter().unzip();
        schedule
    }
    /// What holds from the start.
    pub fn at_the_start(&self) -> impl Iterator<Item = E> + Clone + '_ {
        self.at_the_start.iter().copied()
    }
    /// All events with their times, s; 0 of what holds from the start.
    pub fn all(&self) -> impl Iterator<Item = (f64, E)> + '_ {
        let later = self
            .instants
            .iter()
            .copied()
            .zip(self.events.iter().copied());
        self.at_the_start().map(|event| (0.0, event)).chain(later)
    }
    /// Instants to land on, ascending, s.
    pub fn instants(&self) -> &[f64] {
        &self.instants
    }
    /// What happens at a landing.
    pub fn event(&self, landing: usize) -> E {
        self.events[landing]
    }
}
