//! The machine of the reference files.

use serde::Deserialize;

/// Constants of the planar ball-by-ball bearing with its rotor, SI, under the words of this program.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct ReferenceMachine {
    /// Number of balls.
    #[serde(rename = "N")]
    pub ball_count: usize,
    /// Gravity, m/s², downwards.
    #[serde(rename = "g")]
    pub gravity: f64,
    /// Ball radius, m.
    #[serde(rename = "r")]
    pub ball_radius: f64,
    /// Inner track radius, m.
    #[serde(rename = "Ri")]
    pub inner_track_radius: f64,
    /// Outer track radius, m.
    #[serde(rename = "Ro")]
    pub outer_track_radius: f64,
    /// Ball mass, kg.
    #[serde(rename = "m_b")]
    pub ball_mass: f64,
    /// Inner race mass, kg.
    #[serde(rename = "m_i")]
    pub inner_race_mass: f64,
    /// Inner race inertia, kg m².
    #[serde(rename = "I_i")]
    pub inner_race_inertia: f64,
    /// Mass of the outer race with its housing, kg.
    #[serde(rename = "m_o")]
    pub outer_race_mass: f64,
    /// Cage mass, kg.
    #[serde(rename = "m_c")]
    pub cage_mass: f64,
    /// Cage inertia, kg m².
    #[serde(rename = "I_c")]
    pub cage_inertia: f64,
    /// Hertz factor of the inner contacts, N/m^1.5.
    #[serde(rename = "Ki")]
    pub inner_contact_stiffness: f64,
    /// Hertz factor of the outer contacts, N/m^1.5.
    #[serde(rename = "Ko")]
    pub outer_contact_stiffness: f64,
    /// Contact damping time, s.
    #[serde(rename = "beta")]
    pub contact_damping_time: f64,
    /// Traction law: 0 tanh, 1 four parameters.
    #[serde(rename = "tr_kind")]
    pub traction_kind: i64,
    /// Largest traction coefficient of the tanh law.
    #[serde(rename = "mu_max")]
    pub traction_maximum: f64,
    /// Reference speed of the tanh law, m/s.
    #[serde(rename = "u0")]
    pub traction_reference_speed: f64,
    /// A of the four-parameter law.
    #[serde(rename = "trA")]
    pub traction_a: f64,
    /// B of the four-parameter law, s/m.
    #[serde(rename = "trB")]
    pub traction_b: f64,
    /// C of the four-parameter law, s/m.
    #[serde(rename = "trC")]
    pub traction_c: f64,
    /// D of the four-parameter law.
    #[serde(rename = "trD")]
    pub traction_d: f64,
    /// Radius of the pocket centres, m.
    #[serde(rename = "Rp")]
    pub pocket_radius: f64,
    /// Gap between ball and pocket, m.
    #[serde(rename = "gp")]
    pub pocket_gap: f64,
    /// Pocket stiffness, N/m.
    #[serde(rename = "kp")]
    pub pocket_stiffness: f64,
    /// Pocket damping, s/m.
    #[serde(rename = "ap")]
    pub pocket_damping: f64,
    /// Pocket friction coefficient.
    #[serde(rename = "mu_c")]
    pub pocket_friction_coefficient: f64,
    /// Reference speed of the pocket friction, m/s.
    #[serde(rename = "u0c")]
    pub pocket_friction_reference_speed: f64,
    /// Drag on the orbit of a ball, N s/m.
    #[serde(rename = "cd")]
    pub orbit_drag: f64,
    /// Drag on the spin of a ball, N m s.
    #[serde(rename = "cw")]
    pub spin_drag: f64,
    /// Drag on the cage, N m s.
    #[serde(rename = "cc")]
    pub cage_drag: f64,
    /// Mount stiffness, N/m.
    #[serde(rename = "ks")]
    pub mount_stiffness: f64,
    /// Mount damping, N s/m.
    #[serde(rename = "cs")]
    pub mount_damping: f64,
    /// Torque on the inner race, N m.
    #[serde(rename = "tau_i")]
    pub inner_race_torque: f64,
    /// 1: the centre of the inner race is held.
    #[serde(rename = "fix_i")]
    pub inner_race_centre_held: i64,
    /// 1: there is a rotor.
    #[serde(rename = "rotor")]
    pub has_rotor: i64,
    /// Rotor mass, kg.
    #[serde(rename = "m_r")]
    pub rotor_mass: f64,
    /// Rotor polar inertia, kg m².
    #[serde(rename = "I_r")]
    pub rotor_inertia: f64,
    /// Unbalance eccentricity, m.
    #[serde(rename = "e_u")]
    pub unbalance_eccentricity: f64,
    /// Bore radius, m.
    #[serde(rename = "R0")]
    pub bore_radius: f64,
    /// Radial air clearance, m.
    #[serde(rename = "c0")]
    pub radial_air_clearance: f64,
    /// Stiffness of the rotor/race contact, N/m^exponent.
    #[serde(rename = "kr")]
    pub contact_stiffness: f64,
    /// Exponent of the rotor/race contact.
    #[serde(rename = "nr")]
    pub contact_exponent: f64,
    /// Damping of the rotor/race contact, s/m.
    #[serde(rename = "ar")]
    pub contact_damping: f64,
    /// Friction coefficient of the rotor/race contact.
    #[serde(rename = "mur")]
    pub contact_friction_coefficient: f64,
    /// Reference speed of that friction, m/s.
    #[serde(rename = "u0r")]
    pub contact_friction_reference_speed: f64,
    /// Levitation stiffness, N/m.
    #[serde(rename = "ka")]
    pub levitation_stiffness: f64,
    /// Levitation damping, N s/m.
    #[serde(rename = "ca")]
    pub levitation_damping: f64,
}

/// More balls than any bearing has: a larger number in a file is a mistake.
const MOST_BALLS: usize = 1000;

impl ReferenceMachine {
    /// Number of states, without energy accounts.
    pub(super) fn states(&self) -> Result<usize, String> {
        if (1..=MOST_BALLS).contains(&self.ball_count) {
            Ok(18 + 5 * self.ball_count)
        } else {
            Err(format!(
                "{} balls; 1 to {MOST_BALLS} are possible",
                self.ball_count
            ))
        }
    }
}
