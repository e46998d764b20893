//! How the rows of a bearing stand: where their grooves are, and how far a pair is closed by its preload.
//!
//! ```text
//!   inner R_g = ½d_m + (f_i - ½) D cos α₀,   outer R_g = ½d_m - (f_o - ½) D cos α₀
//!   z_g,i = h + σ((f_i - ½) D sin α₀ + ½ offset),   z_g,o = h - σ(f_o - ½) D sin α₀      h place, σ sign of the thrust a row takes
//!   DB (O, back to back) σ = (+, -), DF (X, face to face) (-, +), DT (tandem) (+, +), rows by rising place
//! ```
//! The preload of a pair is that of its rows when the inner grooves alone are moved. A row without an angle has its grooves opposite
//! each other and takes thrust from both sides.

use super::race::RaceGroove;
use physics::groove::{
    axis_over_root_approach, centre_distance, contact_surface_radius, pure_axial_load,
};
use physics::hertz::PointContact;
use physics::load_zone::joint_stiffness;

/// How rows stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Arrangement {
    /// One row.
    Single,
    /// DB.
    BackToBack,
    /// DF.
    FaceToFace,
    /// DT.
    Tandem,
}

impl Arrangement {
    /// All of them with their words in files and commands.
    pub const WORDS: [(&str, Arrangement); 4] = [
        ("single", Arrangement::Single),
        ("DB", Arrangement::BackToBack),
        ("DF", Arrangement::FaceToFace),
        ("DT", Arrangement::Tandem),
    ];
    /// Signs of the thrusts that its rows take on the inner ring, by rising place.
    pub fn signs(self) -> &'static [f64] {
        match self {
            Arrangement::Single => &[1.0],
            Arrangement::BackToBack => &[1.0, -1.0],
            Arrangement::FaceToFace => &[-1.0, 1.0],
            Arrangement::Tandem => &[1.0, 1.0],
        }
    }
    /// Whether its rows press on each other.
    pub fn preloads(self) -> bool {
        matches!(self, Arrangement::BackToBack | Arrangement::FaceToFace)
    }
}

/// Rows of equal balls and grooves.
#[derive(Clone, Debug, PartialEq)]
pub struct RowGeometry {
    /// How they stand.
    pub arrangement: Arrangement,
    /// Distance of their middles, m.
    pub spacing: f64,
    /// Balls of a row.
    pub balls: usize,
    /// m.
    pub ball_diameter: f64,
    /// m.
    pub pitch_diameter: f64,
    /// Groove radius over ball diameter, inner and outer.
    pub curvatures: [f64; 2],
    /// Free contact angle α₀, rad.
    pub free_angle: f64,
    /// Whether the grooves of a single row stand opposite each other.
    pub opposite: bool,
    /// Whether a single row or a tandem takes thrust towards -z.
    pub reversed: bool,
    /// Its contacts, inner and outer.
    pub contacts: [PointContact; 2],
}

impl RowGeometry {
    /// Grooves of each row, inner and outer, of rows that are closed by an offset, m; with the place of the row, m.
    pub fn grooves(&self, offset: f64) -> Vec<(f64, [RaceGroove<f64>; 2])> {
        let signs = self.arrangement.signs();
        let middle = 0.5 * (signs.len() - 1) as f64;
        let offset = match self.arrangement.preloads() {
            true => offset,
            false => 0.0,
        };
        let rows = signs.iter().enumerate();
        rows.map(|(row, sign)| {
            let place = (row as f64 - middle) * self.spacing;
            let sign = match (self.opposite, self.reversed && !self.arrangement.preloads()) {
                (true, _) => 0.0,
                (_, true) => -sign,
                _ => *sign,
            };
            (place, self.row(place, sign, offset))
        })
        .collect()
    }
    fn row(&self, place: f64, sign: f64, offset: f64) -> [RaceGroove<f64>; 2] {
        let (sine, cosine) = self.free_angle.sin_cos();
        let [inner, outer] = self.curvatures.map(|f| (f - 0.5) * self.ball_diameter);
        let groove = |race: usize, out: f64, along: f64| {
            let contact = &self.contacts[race];
            let radius = self.curvatures[race] * self.ball_diameter;
            RaceGroove {
                centre_radius: 0.5 * self.pitch_diameter + out * cosine,
                place: place + along,
                slack: radius - 0.5 * self.ball_diameter,
                stiffness: contact.stiffness,
                half_axis: axis_over_root_approach(contact),
                half_curvature: 0.5 / contact_surface_radius(0.5 * self.ball_diameter, radius),
            }
        };
        [
            groove(0, inner, sign * (inner * sine + 0.5 * offset)),
            groove(1, -outer, -sign * outer * sine),
        ]
    }
    /// Distance by which a pair is closed under a preload, N, at rest, m: twice the axial displacement of one row. None where no
    /// contact angle below 86° carries it.
    pub fn offset_of(&self, preload: f64) -> Option<f64> {
        let stiffness = joint_stiffness(self.contacts[0].stiffness, self.contacts[1].stiffness);
        let distance = centre_distance(self.curvatures, self.ball_diameter);
        let at =
            |angle: f64| pure_axial_load(self.balls, stiffness, distance, self.free_angle, angle);
        let (mut low, mut high) = (self.free_angle, 1.5);
        if at(high)[0] < preload {
            return None;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if at(middle)[0] < preload {
                low = middle
            } else {
                high = middle
            }
        }
        Some(2.0 * at(high)[1])
    }
}
