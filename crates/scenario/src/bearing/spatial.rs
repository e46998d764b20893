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
    /// Distance of their middles, m; 0 of one row.
    pub row_spacing: f64,
    /// Side to which a single row or a tandem carries thrust.
    pub thrust_side: ThrustSide,
    /// Width of a row, m, where the catalogue knows it.
    pub row_width: Option<f64>,
    /// Points of a contact at which slip is taken.
    pub nodes: ContactNodes,
    /// Height of the groove's shoulder above its bottom, m, where the run-over is watched.
    pub shoulder_height: Option<f64>,
}

impl Arrangement {
    /// Number of rows.
    pub fn rows(self) -> usize {
        match self {
            Arrangement::Single => 1,
            Arrangement::BackToBack | Arrangement::FaceToFace | Arrangement::Tandem => 2,
        }
    }
}

impl Spatial {
    pub(super) fn of(values: &Values, bearing: &Section<'_>) -> Self {
        Spatial {
            arrangement: bearing.choice("arrangement"),
            row_spacing: (bearing.maybe("row_spacing"))
                .or_else(|| values.dimension("width"))
                .unwrap_or(0.0),
            thrust_side: bearing.chosen("thrust_side").unwrap_or(ThrustSide::End),
            row_width: values.dimension("width"),
            nodes: bearing.choice("contact_nodes"),
            shoulder_height: bearing.maybe("shoulder_height"),
        }
    }
}
