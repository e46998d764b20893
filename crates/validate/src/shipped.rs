//! The cases of `cases/`, part of the program.

macro_rules! cases {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!("../cases/", $name, ".toml")))),*]
    };
}

/// Name and text of every shipped case.
pub(super) const CASES: &[(&str, &str)] = cases![
    "elastic_bounce",
    "film_209_inner",
    "film_209_outer",
    "free_fall",
    "hertz_amesweb_ball_in_race",
    "hertz_engtools_6206",
    "hertz_stiffness_6005_inner",
    "hertz_stiffness_6005_outer",
    "kinematics_cwru_6203",
    "kinematics_cwru_6205",
    "oil_viscosity_sae140",
    "oil_viscosity_vg68",
    "palmgren_factors_60_grease",
    "palmgren_factors_73b_oil",
    "palmgren_factors_timken_02",
    "palmgren_high_speed",
    "palmgren_low_speed",
    "palmgren_paper_form",
    "published_flywheel_spin_down",
    "published_free_rotor",
    "published_free_rotor_plain",
    "published_heavy_caged",
    "published_heavy_full_complement",
    "published_whirl_as_new",
    "published_whirl_damped",
    "published_whirl_worn",
    "rolling_moments_6005",
    "skf_22208e",
    "skf_6005_grease",
    "skf_7006_jet",
];
