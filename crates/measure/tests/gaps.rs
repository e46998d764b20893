//! Gaps in a train of pulses: how many marks they hold, and rests in which nobody can count.

use crate::synthetic::wheel::Random;
use measure::pulse::{Edges, Wheel, number};
use std::f64::consts::TAU;

const FULL: Wheel = Wheel {
    marks: 60,
    missing: 0,
};

fn stamped(times: Vec<f64>) -> Edges {
    Edges::stamped(times, 1e-7, None).unwrap()
}

#[test]
fn long_gaps_are_counted_right_in_spite_of_uneven_marks() {
    let mut random = Random::new(8);
    let pitch = TAU / 60.0;
    let marks: Vec<f64> = (0..60).map(|_| 0.01 * pitch * random.normal()).collect();
    for lost in [5, 10, 30, 60, 100] {
        for _ in 0..20 {
            let begin = 200 + (300.0 * random.uniform()) as usize;
            // 149.85 rad/s, slowing down by 2 rad/s².
            let times: Vec<f64> = (0..1200)
                .filter(|k| !(begin..begin + lost).contains(k))
                .map(|k| {
                    let angle = k as f64 * pitch + marks[k % 60];
                    let time = (149.85 - (149.85f64.powi(2) - 4.0 * angle).sqrt()) / 2.0;
                    time + 5e-6 * random.normal()
                })
                .collect();
            let pulses = number(&stamped(times), &FULL).unwrap();
            assert_eq!(*pulses.marks.last().unwrap(), 1199, "{lost} from {begin}");
        }
    }
}

#[test]
fn a_rest_within_the_record_is_refused() {
    // Slows down with 40 rad/s² from 40 rad/s, rests from 1 s to 2 s, starts with 2000 rad/s².
    let down = |k: usize| 1.0 - (1.0 - k as f64 * TAU / 60.0 / 20.0).sqrt();
    let up = |k: usize| 2.0 + ((k as f64 + 0.5) * TAU / 60.0 / 1000.0).sqrt();
    let first = (0..191).map(down).filter(|t| t.is_finite());
    let times: Vec<f64> = first.chain((0..2000).map(up)).collect();
    let why = number(&stamped(times), &FULL).unwrap_err().to_string();
    assert!(why.contains("comes to rest after 0.9"), "{why}");
}
