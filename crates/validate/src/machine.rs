//! The machine of the reference files.

use serde::Deserialize;

/// The machine of a table: the key of the files, the field, its type, its meaning.
macro_rules! machine {
    ($($key:literal $field:ident: $Type:ty, $meaning:literal;)*) => {
        /// Constants of the planar ball-by-ball bearing with its rotor, SI, under the words of this program.
        #[derive(Clone, Debug, Default, Deserialize, PartialEq)]
        #[serde(deny_unknown_fields)]
        pub struct ReferenceMachine {
            $(
                #[doc = $meaning]
                #[serde(rename = $key)]
                pub $field: $Type,
            )*
        }
    };
}

machine! {
    "N" ball_count: usize, "Number of balls.";
    "g" gravity: f64, "Gravity, m/s², downwards.";
    "r" ball_radius: f64, "Ball radius, m.";
    "Ri" inner_track_radius: f64, "Inner track radius, m.";
    "Ro" outer_track_radius: f64, "Outer track radius, m.";
    "m_b" ball_mass: f64, "Ball mass, kg.";
    "m_i" inner_race_mass: f64, "Inner race mass, kg.";
    "I_i" inner_race_inertia: f64, "Inner race inertia, kg m².";
    "m_o" outer_race_mass: f64, "Mass of the outer race with its housing, kg.";
    "m_c" cage_mass: f64, "Cage mass, kg.";
    "I_c" cage_inertia: f64, "Cage inertia, kg m².";
    "Ki" inner_contact_stiffness: f64, "Hertz factor of the inner contacts, N/m^1.5.";
    "Ko" outer_contact_stiffness: f64, "Hertz factor of the outer contacts, N/m^1.5.";
    "beta" contact_damping_time: f64, "Contact damping time, s.";
    "tr_kind" traction_kind: i64, "Traction law: 0 tanh, 1 four parameters.";
    "mu_max" traction_maximum: f64, "Largest traction coefficient of the tanh law.";
    "u0" traction_reference_speed: f64, "Reference speed of the tanh law, m/s.";
    "trA" traction_a: f64, "A of the four-parameter law.";
    "trB" traction_b: f64, "B of the four-parameter law, s/m.";
    "trC" traction_c: f64, "C of the four-parameter law, s/m.";
    "trD" traction_d: f64, "D of the four-parameter law.";
    "Rp" pocket_radius: f64, "Radius of the pocket centres, m.";
    "gp" pocket_gap: f64, "Gap between ball and pocket, m.";
    "kp" pocket_stiffness: f64, "Pocket stiffness, N/m.";
    "ap" pocket_damping: f64, "Pocket damping, s/m.";
    "mu_c" pocket_friction_coefficient: f64, "Pocket friction coefficient.";
    "u0c" pocket_friction_reference_speed: f64, "Reference speed of the pocket friction, m/s.";
    "cd" orbit_drag: f64, "Drag on the orbit of a ball, N s/m.";
    "cw" spin_drag: f64, "Drag on the spin of a ball, N m s.";
    "cc" cage_drag: f64, "Drag on the cage, N m s.";
    "ks" mount_stiffness: f64, "Mount stiffness, N/m.";
    "cs" mount_damping: f64, "Mount damping, N s/m.";
    "tau_i" inner_race_torque: f64, "Torque on the inner race, N m.";
    "fix_i" inner_race_centre_held: i64, "1: the centre of the inner race is held.";
    "rotor" has_rotor: i64, "1: there is a rotor.";
    "m_r" rotor_mass: f64, "Rotor mass, kg.";
    "I_r" rotor_inertia: f64, "Rotor polar inertia, kg m².";
    "e_u" unbalance_eccentricity: f64, "Unbalance eccentricity, m.";
    "R0" bore_radius: f64, "Bore radius, m.";
    "c0" radial_air_clearance: f64, "Radial air clearance, m.";
    "kr" contact_stiffness: f64, "Stiffness of the rotor/race contact, N/m^exponent.";
    "nr" contact_exponent: f64, "Exponent of the rotor/race contact.";
    "ar" contact_damping: f64, "Damping of the rotor/race contact, s/m.";
    "mur" contact_friction_coefficient: f64, "Friction coefficient of the rotor/race contact.";
    "u0r" contact_friction_reference_speed: f64, "Reference speed of that friction, m/s.";
    "ka" levitation_stiffness: f64, "Levitation stiffness, N/m.";
    "ca" levitation_damping: f64, "Levitation damping, N s/m.";
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
