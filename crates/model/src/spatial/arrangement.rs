//! Where the grooves of the rows of a bearing are, and how far its rows are closed by a preload.
//!
//! ```text
//!   inner R_g = ½d_m + (f_i - ½) D cos α₀,   outer R_g = ½d_m - (f_o - ½) D cos α₀
//!   z_g,i = h + σ((f_i - ½) D sin α₀ + u_σ),   z_g,o = h - σ(f_o - ½) D sin α₀      h place, σ sign of the thrust a row takes
//!   N u_± : Q(u_±) = preload/N_±        the N_+ rows of one sign press on the N_- of the other, the inner ring at rest in its middle
//! ```
//! Inner grooves alone are moved by a preload. A row without an angle has its grooves opposite each other, σ = 0, and takes thrust from
//! both sides.

use super::ball::SpatialBall;
use super::race::RaceGroove;
use super::spring::PreloadSpring;
use physics::groove::{
    axis_over_root_approach, centre_distance, contact_surface_radius, pure_axial_load,
};
use physics::hertz::PointContact;
use physics::load_zone::joint_stiffness;

/// Rows of equal balls and grooves.
#[derive(Clone, Debug, PartialEq)]
pub struct RowGeometry {
    /// Signs of the thrusts that its rows take on the inner ring, by rising place; 0 of grooves that stand opposite each other.
    pub signs: Vec<f64>,
    /// Distance of the middles of neighbours, m.
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
    /// Its contacts, inner and outer.
    pub contacts: [PointContact; 2],
}

impl RowGeometry {
    /// Grooves of each row, inner and outer, of rows that are closed by distances, m, those that take thrust towards +z and the others; with
    /// the place of the row, m.
    pub fn grooves(&self, closed: [f64; 2]) -> Vec<(f64, [RaceGroove<f64>; 2])> {
        let middle = 0.5 * (self.signs.len() - 1) as f64;
        let rows = self.signs.iter().enumerate();
        rows.map(|(row, sign)| {
            let place = (row as f64 - middle) * self.spacing;
            let closed = closed[usize::from(*sign < 0.0)];
            (place, self.row(place, *sign, closed))
        })
        .collect()
    }
    fn row(&self, place: f64, sign: f64, closed: f64) -> [RaceGroove<f64>; 2] {
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
            groove(0, inner, sign * (inner * sine + closed)),
            groove(1, -outer, -sign * outer * sine),
        ]
    }
    /// Distances by which rows are closed under a preload of the whole set, N, at rest, m: those that take thrust towards +z, and the
    /// others. None where no contact angle below 86° carries it.
    pub fn closed_by(&self, preload: f64) -> Option<[f64; 2]> {
        let count = |side: f64| self.signs.iter().filter(|sign| **sign == side).count() as f64;
        let [one, other] = [1.0, -1.0].map(|side| self.displacement(preload / count(side)));
        Some([one?, other?])
    }
    /// Axial displacement of a row under a thrust, N: m.
    fn displacement(&self, thrust: f64) -> Option<f64> {
        let stiffness = joint_stiffness(self.contacts[0].stiffness, self.contacts[1].stiffness);
        let distance = centre_distance(self.curvatures, self.ball_diameter);
        let at =
            |angle: f64| pure_axial_load(self.balls, stiffness, distance, self.free_angle, angle);
        let (mut low, mut high) = (self.free_angle, 1.5);
        if thrust.is_nan() || at(high)[0] < thrust {
            return None;
        }
        for _ in 0..200 {
            let middle = 0.5 * (low + high);
            if at(middle)[0] < thrust {
                low = middle
            } else {
                high = middle
            }
        }
        Some(at(high)[1])
    }
}

/// Preload of rows at rest, N: what those of one side carry where the inner ring, moved along its axis, is in equilibrium, and a spring
/// where there is one. Each row by its number of balls and one of them.
pub fn preload_at_rest(
    rows: &[(usize, SpatialBall<f64>)],
    spring: Option<&PreloadSpring<f64>>,
) -> f64 {
    let slides = |ball: &SpatialBall<f64>| spring.is_some_and(|own| own.presses(ball));
    let thrusts = |moved: f64| {
        let fixed = rows.iter().filter(|(_, ball)| !slides(ball));
        let pressed: f64 = fixed
            .map(|(balls, ball)| *balls as f64 * ball.thrust_at_rest(moved))
            .sum();
        let slid = spring.map_or(0.0, |own| own.slid_by(pressed.abs()));
        let one = move |(balls, ball): &(usize, SpatialBall<f64>)| {
            let beside = moved - if slides(ball) { slid } else { 0.0 };
            *balls as f64 * ball.thrust_at_rest(beside)
        };
        rows.iter().map(one)
    };
    let reach = |(_, ball): &(usize, SpatialBall<f64>)| {
        let [radial, axial] = ball.groove_distance();
        radial.hypot(axial)
    };
    let farthest = rows.iter().map(reach).fold(0.0, f64::max);
    let (mut low, mut high) = (-farthest, farthest);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        // the farther the ring, the more the rows push it back
        if thrusts(middle).sum::<f64>() > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * thrusts(0.5 * (low + high)).map(f64::abs).sum::<f64>()
}
