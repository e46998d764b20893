//! Laws over arrays of equal length: `python/auxbear/laws.py` brings them to one length, and names and explains each number.

use auxbear::physics::film::{EntrainedContact, FilmThickness};
use auxbear::physics::hertz::{BallRace, PointContact, Race, maximum_pressure};
use auxbear::physics::palmgren::Palmgren;
use auxbear::physics::rolling;
use auxbear::physics::skf::{SkfAngularContact, SkfContacts, SkfDeepGroove, SkfMoment};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// What a law is given: an array for each of its arguments, or one number each.
#[derive(FromPyObject)]
pub enum Arguments<'py> {
    Numbers(Vec<f64>),
    Arrays(Vec<PyReadonlyArray1<'py, f64>>),
}
type Arrays<'py> = Vec<Bound<'py, PyArray1<f64>>>;

/// Evaluates a law of `N` numbers at each place; it gives `M` numbers, or says why there are none.
fn each<'py, const N: usize, const M: usize>(
    py: Python<'py>,
    given: &Arguments<'py>,
    mut law: impl FnMut([f64; N]) -> Result<[f64; M], String>,
) -> PyResult<Arrays<'py>> {
    let columns: Vec<&[f64]> = match given {
        Arguments::Numbers(numbers) => numbers.iter().map(std::slice::from_ref).collect(),
        Arguments::Arrays(arrays) => (arrays.iter())
            .map(|array| Ok(array.as_slice()?))
            .collect::<PyResult<_>>()?,
    };
    let columns: [&[f64]; N] = (columns.try_into())
        .map_err(|_| PyValueError::new_err(format!("{N} arrays are needed")))?;
    let count = columns.iter().map(|column| column.len()).min().unwrap_or(0);
    let mut found: [Vec<f64>; M] = std::array::from_fn(|_| Vec::with_capacity(count));
    for place in 0..count {
        let values = law(columns.map(|column| column[place])).map_err(PyValueError::new_err)?;
        for (list, value) in found.iter_mut().zip(values) {
            list.push(value);
        }
    }
    let arrays = found.into_iter().map(|list| PyArray1::from_vec(py, list));
    Ok(arrays.collect())
}

fn race(is_inner: bool) -> Race {
    match is_inner {
        true => Race::Inner,
        false => Race::Outer,
    }
}

/// Load, ball and pitch diameter, groove curvature, contact angle, contact modulus.
#[pyfunction]
pub fn hertz<'py>(py: Python<'py>, given: Arguments<'py>, is_inner: bool) -> PyResult<Arrays<'py>> {
    // the contact costs a hundred times its load: it is built anew where its bodies change
    let mut built: Option<([f64; 5], PointContact)> = None;
    each(py, &given, |[load, ball, pitch, groove, angle, modulus]| {
        let bodies = [ball, pitch, groove, angle, modulus];
        let contact = match built {
            Some((before, contact)) if before == bodies => contact,
            _ => {
                let place = BallRace {
                    ball_diameter: ball,
                    pitch_diameter: pitch,
                    groove_curvature: groove,
                    contact_angle: angle,
                    race: race(is_inner),
                };
                PointContact::new(place.curvature(), modulus)
                    .map_err(|refused| refused.to_string())?
            }
        };
        built = Some((bodies, contact));
        Ok([
            contact.approach(load),
            contact.semi_major(load),
            contact.semi_minor(load),
            maximum_pressure(contact.pressure_factor, load),
            contact.stiffness,
        ])
    })
}

/// Entrainment, load, ball and pitch diameter, groove curvature, contact angle, contact modulus, viscosity, pressure
/// coefficient, supply.
#[pyfunction]
pub fn film<'py>(py: Python<'py>, given: Arguments<'py>, is_inner: bool) -> PyResult<Arrays<'py>> {
    each(py, &given, |values| {
        let [
            speed,
            load,
            ball,
            pitch,
            groove,
            angle,
            modulus,
            viscosity,
            pressure,
            supply,
        ] = values;
        let place = BallRace {
            ball_diameter: ball,
            pitch_diameter: pitch,
            groove_curvature: groove,
            contact_angle: angle,
            race: race(is_inner),
        };
        let contact = EntrainedContact::new(place.curvature(), modulus)
            .map_err(|refused| refused.to_string())?;
        let film = FilmThickness::new(&contact, viscosity, pressure, supply);
        Ok([film.central(speed, load), film.minimum(speed, load)])
    })
}

/// Speed, load, then the constants of the bearing.
#[pyfunction]
pub fn palmgren<'py>(py: Python<'py>, given: Arguments<'py>) -> PyResult<Arrays<'py>> {
    each(py, &given, |[speed, load, f0, nu, pitch, z, y, rating]| {
        let law = Palmgren {
            viscous_factor: f0,
            viscosity: nu,
            pitch_diameter: pitch,
            load_factor: z,
            load_exponent: y,
            static_load_rating: rating,
            preload: 0.0,
        };
        let parts = law.parts(speed, load);
        Ok([parts.speed_dependent, parts.load_dependent])
    })
}

/// Speed, radial and axial load, mean diameter, viscosity, starvation, friction of boundary and of film, drag, moment of the seals, then
/// the load factors of the type: R1, R2, R3, S1, S2, S3, or R1, R2, S1, S2 and the static load rating of a deep groove bearing.
#[pyfunction]
pub fn skf<'py>(
    py: Python<'py>,
    given: Arguments<'py>,
    is_deep_groove: bool,
) -> PyResult<Arrays<'py>> {
    each(py, &given, |values| {
        let [
            speed,
            radial,
            axial,
            mean_diameter,
            viscosity,
            starvation,
            boundary_friction,
            film_friction,
            drag,
            seal_moment,
            a,
            b,
            c,
            d,
            e,
            f,
        ] = values;
        let law = SkfMoment {
            contacts: match is_deep_groove {
                true => SkfContacts::DeepGroove(SkfDeepGroove {
                    r1: a,
                    r2: b,
                    s1: c,
                    s2: d,
                    static_load_rating: e,
                }),
                false => SkfContacts::AngularContact(SkfAngularContact {
                    r1: a,
                    r2: b,
                    r3: c,
                    s1: d,
                    s2: e,
                    s3: f,
                }),
            },
            mean_diameter,
            viscosity,
            starvation,
            boundary_friction,
            film_friction,
            drag,
            seal_moment,
        };
        let parts = law.parts(speed, radial, axial);
        Ok([parts.speed_dependent, parts.load_dependent])
    })
}

/// Inertia of the race, of the set; drive moment, steady moment.
#[pyfunction]
pub fn race_acceleration<'py>(py: Python<'py>, given: Arguments<'py>) -> PyResult<Arrays<'py>> {
    each(py, &given, |[race, set, drive, steady]| {
        Ok([rolling::race_acceleration(race, set, drive, steady)])
    })
}
