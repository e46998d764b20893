//! What is known at the instants of a coast-down, and how it ended.

use std::sync::Arc;
use thermal::bearing_network::Landing;
use thermal::coast_down::Endless;

/// What is known at the end of a step. Moments and powers are those of all bearings.
#[derive(Clone, Debug)]
pub(crate) struct Row {
    pub time: f64,
    pub speed: f64,
    /// Of the nodes of all bearings, °C.
    pub temperatures: Vec<f64>,
    /// M0 and M1 of all bearings, and what brakes the rotor besides, N m.
    pub moments: [f64; 3],
    /// Of each bearing.
    pub bearings: Vec<RowOfBearing>,
    /// Largest growth rate of the temperatures, 1/s.
    pub growth: f64,
    /// Power that is taken from each node to hold it, W, of all equal bearings.
    pub taken: Vec<f64>,
}

/// What is known of a bearing at the end of a step.
#[derive(Clone, Debug)]
pub(crate) struct RowOfBearing {
    /// M0 and M1 of all equal bearings together, N m.
    pub moment: f64,
    /// Radial load of one of them, N.
    pub load: f64,
    /// Diametral, m.
    pub clearance: f64,
    /// Of the most loaded ball at the inner and at the outer race, N.
    pub largest_ball_loads: [f64; 2],
    /// Its largest pressure, Pa.
    pub largest_pressure: f64,
    /// How the rotor lies in it.
    pub landing: Landing,
    /// Speed of its inner race, rad/s.
    pub speed: f64,
    /// Of its balls, where intervals follow them: as the nearest has seen them.
    pub balls: Option<Arc<BallsSeen>>,
}

/// What an interval has seen of the balls of a bearing.
#[derive(Clone, Debug)]
pub(crate) struct BallsSeen {
    /// Largest load at the inner and at the outer race, N.
    pub largest: [f64; 2],
    /// Cubes of the loads that pass each point of both rings in a turn, N³: of the inner ring from its angle 0 on, of the outer one from the
    /// frame's x axis on. Of several rows as of one that takes as much life.
    pub cubes: [Vec<f64>; 2],
}

impl RowOfBearing {
    /// Load of the most loaded ball, N.
    pub fn largest_ball_load(&self) -> f64 {
        self.largest_ball_loads[0].max(self.largest_ball_loads[1])
    }
}

impl Row {
    /// Smallest clearance of all bearings, m.
    pub fn clearance(&self) -> f64 {
        let each = self.bearings.iter().map(|bearing| bearing.clearance);
        each.fold(f64::INFINITY, f64::min)
    }
}

/// How a coast-down ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum End {
    Stands,
    /// At a stop speed that is no standstill.
    Reached,
    Late,
    Interrupted,
    Beyond,
    Endless(Endless),
    /// For this reason.
    Lost(&'static str),
}

impl End {
    /// Whether it has left what the model describes.
    pub fn leaves(self) -> bool {
        !matches!(
            self,
            End::Stands | End::Reached | End::Late | End::Interrupted
        )
    }
}
