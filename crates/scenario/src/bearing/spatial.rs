//! A bearing in space: how its rows stand, and where slip is taken in its contacts.

use crate::section::Section;
use crate::values::Values;
use problem::words;

words! {
/// How the rows of a bearing stand.
pub enum Arrangement {
    Single = "single",
    /// O.
    BackToBack = "DB",
    /// X.
    FaceToFace = "DF",
    Tandem = "DT",
    /// Two against one, O.
    TwoBackToOne = "TBT",
    /// Two against one, X.
    TwoFaceToOne = "TFT",
    /// Three in tandem.
    Three = "TT",
    /// Two against two, O.
    TwoBackToTwo = "QBC",
    /// Two against two, X.
    TwoFaceToTwo = "QFC",
    /// Three against one, O.
    ThreeBackToOne = "QBT",
    /// Three against one, X.
    ThreeFaceToOne = "QFT",
    /// Four in tandem.
    Four = "QT",
}
}

words! {
/// Where a rotor presses a row to that carries thrust from one side alone.
pub enum ThrustSide {
    /// Towards the end of the shaft.
    End = "end",
    /// Towards its start.
    Start = "start",
}
}

words! {
/// At how many points of a contact slip is taken.
pub enum ContactNodes {
    /// Three that have the couple of pure spin.
    Matched = "matched",
    One = "1",
    Three = "3",
    Five = "5",
    Nine = "9",
}
}

/// What a bearing in space has besides what one of the plane has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spatial {
    /// How its rows stand.
    pub arrangement: Arrangement,
    /// Distance of the middles of neighbours, m; 0 of one row.
    pub row_spacing: f64,
    /// Side to which a single row, a tandem or most rows of a set carry thrust.
    pub thrust_side: ThrustSide,
    /// Width of a row, m, where the catalogue knows it.
    pub row_width: Option<f64>,
    /// What presses the rows of one side, where a spring does.
    pub spring: Option<PreloadSpring>,
    /// Points of a contact at which slip is taken.
    pub nodes: ContactNodes,
    /// Height of the groove's shoulder above its bottom, m, where the run-over is watched.
    pub shoulder_height: Option<f64>,
}

/// A spring that presses rows of one side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PreloadSpring {
    /// N/m.
    pub stiffness: f64,
    /// Thrust that its rows carry.
    pub side: ThrustSide,
    /// Compression beyond that of the preload until it is solid, m; none where it never is.
    pub travel: Option<f64>,
    /// Mass of the outer rings that slide, kg.
    pub mass: f64,
}

impl ThrustSide {
    /// +1 towards the end of the shaft.
    pub fn sign(self) -> f64 {
        match self {
            ThrustSide::End => 1.0,
            ThrustSide::Start => -1.0,
        }
    }
}

impl Arrangement {
    /// Signs of the thrusts that its rows take on the inner ring, by rising place, where most of them take that towards the end of the shaft.
    pub fn signs(self) -> &'static [f64] {
        match self {
            Arrangement::Single => &[1.0],
            Arrangement::BackToBack => &[1.0, -1.0],
            Arrangement::FaceToFace => &[-1.0, 1.0],
            Arrangement::Tandem => &[1.0, 1.0],
            Arrangement::TwoBackToOne => &[1.0, 1.0, -1.0],
            Arrangement::TwoFaceToOne => &[-1.0, 1.0, 1.0],
            Arrangement::Three => &[1.0, 1.0, 1.0],
            Arrangement::TwoBackToTwo => &[1.0, 1.0, -1.0, -1.0],
            Arrangement::TwoFaceToTwo => &[-1.0, -1.0, 1.0, 1.0],
            Arrangement::ThreeBackToOne => &[1.0, 1.0, 1.0, -1.0],
            Arrangement::ThreeFaceToOne => &[-1.0, 1.0, 1.0, 1.0],
            Arrangement::Four => &[1.0, 1.0, 1.0, 1.0],
        }
    }
    /// Number of rows.
    pub fn rows(self) -> usize {
        self.signs().len()
    }
    /// Whether its rows press on each other.
    pub fn preloads(self) -> bool {
        self.signs().contains(&-1.0)
    }
}

impl Spatial {
    /// Signs of the thrusts that its rows take on the inner ring, by rising place: +1 towards the end of the shaft.
    pub fn signs(&self) -> Vec<f64> {
        let signs = self.arrangement.signs().iter();
        match self.thrust_side {
            ThrustSide::End => signs.copied().collect(),
            // the same set, turned round
            ThrustSide::Start => signs.rev().map(|sign| -sign).collect(),
        }
    }

    pub(super) fn of(values: &Values, bearing: &Section<'_>) -> Self {
        let mut own = Spatial {
            spring: None,
            arrangement: bearing.choice("arrangement"),
            row_spacing: (bearing.maybe("row_spacing"))
                .or_else(|| values.dimension("width"))
                .unwrap_or(0.0),
            thrust_side: bearing.chosen("thrust_side").unwrap_or(ThrustSide::End),
            row_width: values.dimension("width"),
            nodes: bearing.choice("contact_nodes"),
            shoulder_height: bearing.maybe("shoulder_height"),
        };
        own.spring = bearing.maybe("preload_spring_stiffness").map(|stiffness| {
            let chosen = bearing.chosen("preload_spring_side");
            let side: ThrustSide = chosen.unwrap_or(ThrustSide::Start);
            let rows = own
                .signs()
                .iter()
                .filter(|sign| **sign == side.sign())
                .count();
            let rings = bearing.maybe("inner_race_mass").unwrap_or(0.0) * rows as f64;
            PreloadSpring {
                stiffness,
                side,
                travel: bearing.maybe("preload_spring_travel"),
                mass: bearing.maybe("preload_spring_mass").unwrap_or(rings),
            }
        });
        own
    }
}
