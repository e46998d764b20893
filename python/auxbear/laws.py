"""Laws over NumPy arrays.

Every argument is a number or an array in SI, a text with its unit, or a quantity of pint; arrays are brought to one shape by
NumPy's rules, and results have that shape. The laws are those of a run; the book names their sources and ranges.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

import numpy
import numpy.typing

from auxbear import _auxbear, _si

Numbers = numpy.typing.ArrayLike
Array = numpy.typing.NDArray[numpy.float64]


class Hertz(NamedTuple):
    """A point contact under load."""

    #: Approach of the bodies, m
    approach: Array
    #: Long semi-axis, m
    semi_major: Array
    #: Short semi-axis, m
    semi_minor: Array
    #: Maximum pressure, Pa
    maximum_pressure: Array
    #: K of Q = K δ^(3/2), N/m^(3/2)
    stiffness: Array


class Film(NamedTuple):
    """Thickness of an oil film."""

    #: In the middle of the contact, m
    central: Array
    #: Where it is thinnest, m
    minimum: Array


class Moment(NamedTuple):
    """A steady friction moment in its two parts, each with the sign of the speed."""

    #: M0, N m
    speed_dependent: Array
    #: M1, N m
    load_dependent: Array

    @property
    def sum(self) -> Array:
        """M, N m"""
        return self.speed_dependent + self.load_dependent


def hertz(
    load: Numbers,
    *,
    ball_diameter: Numbers,
    pitch_diameter: Numbers,
    groove_curvature: Numbers,
    contact_modulus: Numbers,
    contact_angle: Numbers = 0.0,
    race: Literal["inner", "outer"],
) -> Hertz:
    """The exact elastic contact of a ball in the groove of a race, after Hertz.

    - ``load``: N, not negative
    - ``ball_diameter``, ``pitch_diameter``: m
    - ``groove_curvature``: groove radius over ball diameter, above 0.5
    - ``contact_modulus``: E* of 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂, Pa
    - ``contact_angle``: rad
    """
    given = (
        (load, "N"),
        (ball_diameter, "m"),
        (pitch_diameter, "m"),
        (groove_curvature, "1"),
        (contact_angle, "rad"),
        (contact_modulus, "Pa"),
    )
    return Hertz(*_each(_auxbear.hertz, given, _is_inner(race)))


def film(
    entrainment: Numbers,
    load: Numbers,
    *,
    ball_diameter: Numbers,
    pitch_diameter: Numbers,
    groove_curvature: Numbers,
    contact_modulus: Numbers,
    viscosity: Numbers,
    pressure_coefficient: Numbers,
    contact_angle: Numbers = 0.0,
    supply: Numbers = 1.0,
    race: Literal["inner", "outer"],
) -> Film:
    """Thickness of the oil film between ball and race, the thickest of four regimes, before heating of the inlet.

    - ``entrainment``: mean of the two surface speeds, m/s
    - ``load``: N
    - ``viscosity``: dynamic, at the inlet, Pa s
    - ``pressure_coefficient``: of viscosity, 1/Pa
    - ``supply``: share of the flooded thickness that starvation leaves, 1 flooded
    - the others: as of ``hertz``
    """
    given = (
        (entrainment, "m/s"),
        (load, "N"),
        (ball_diameter, "m"),
        (pitch_diameter, "m"),
        (groove_curvature, "1"),
        (contact_angle, "rad"),
        (contact_modulus, "Pa"),
        (viscosity, "Pa s"),
        (pressure_coefficient, "1/Pa"),
        (supply, "1"),
    )
    return Film(*_each(_auxbear.film, given, _is_inner(race)))


def palmgren(
    speed: Numbers,
    load: Numbers,
    *,
    viscous_factor: Numbers,
    viscosity: Numbers,
    pitch_diameter: Numbers,
    load_factor: Numbers,
    load_exponent: Numbers,
    static_load_rating: Numbers,
) -> Moment:
    """Palmgren's moment: M0 = 1e-7 f0 (ν n)^⅔ d_m³, M1 = z (W/C0)^y W d_m, fading to 0 at rest.

    - ``speed``: rad/s, either sign
    - ``load``: radial load W, N
    - ``viscous_factor``: f0
    - ``viscosity``: kinematic ν, m²/s
    - ``pitch_diameter``: d_m, m
    - ``load_factor``, ``load_exponent``: z and y
    - ``static_load_rating``: C0, N
    """
    given = (
        (speed, "rad/s"),
        (load, "N"),
        (viscous_factor, "1"),
        (viscosity, "m^2/s"),
        (pitch_diameter, "m"),
        (load_factor, "1"),
        (load_exponent, "1"),
        (static_load_rating, "N"),
    )
    return Moment(*_each(_auxbear.palmgren, given))


def skf(
    speed: Numbers,
    radial_load: Numbers,
    axial_load: Numbers = 0.0,
    *,
    mean_diameter: Numbers,
    viscosity: Numbers,
    rolling_factors: tuple[Numbers, ...],
    sliding_factors: tuple[Numbers, ...],
    static_load_rating: Numbers | None = None,
    starvation: Numbers = 0.0,
    boundary_friction: Numbers = 0.12,
    film_friction: Numbers = 0.05,
    drag: Numbers = 0.0,
    seal_moment: Numbers = 0.0,
) -> Moment:
    """The SKF model of the moment of a ball bearing: rolling and drag follow the speed, sliding and seals the load.

    - ``speed``: rad/s, either sign
    - ``radial_load``, ``axial_load``: N
    - ``mean_diameter``: (d + D)/2, m
    - ``viscosity``: kinematic ν, m²/s
    - ``rolling_factors``, ``sliding_factors``: R1, R2 and S1, S2 of a deep groove bearing, whose ``static_load_rating`` C0, N, is needed;
      R1, R2, R3 and S1, S2, S3 of an angular contact bearing
    - ``starvation``: K_rs (d + D) √(K_z/(2 (D - d))), per mm²/s and rpm
    - ``boundary_friction``, ``film_friction``: sliding friction μ_bl, μ_EHL
    - ``drag``: of an oil bath per squared speed, N mm/rpm²
    - ``seal_moment``: of both seals, N m
    """
    factors: list[Any] = [*rolling_factors, *sliding_factors]
    is_deep_groove = static_load_rating is not None
    if is_deep_groove and len(factors) == 4:
        factors += [static_load_rating, 0.0]
    elif is_deep_groove or len(factors) != 6:
        raise ValueError("R1, R2, S1, S2 with static_load_rating, or R1, R2, R3, S1, S2, S3 without it, are needed")
    given = (
        (speed, "rad/s"),
        (radial_load, "N"),
        (axial_load, "N"),
        (mean_diameter, "m"),
        (viscosity, "m^2/s"),
        (starvation, "1"),
        (boundary_friction, "1"),
        (film_friction, "1"),
        (drag, "1"),
        (seal_moment, "N m"),
        *((factor, "1") for factor in factors[:4]),
        (factors[4], "N" if is_deep_groove else "1"),
        (factors[5], "1"),
    )
    return Moment(*_each(_auxbear.skf, given, is_deep_groove))


def race_acceleration(
    *,
    race_inertia: Numbers,
    set_inertia: Numbers,
    drive_moment: Numbers,
    steady_moment: Numbers,
) -> Array:
    """Angular acceleration of an inner race that a rotor rubs along and whose balls roll, rad/s²: (T - M)/(I + J).

    - ``race_inertia``: inner race with its sleeve, kg m²
    - ``set_inertia``: of balls and cage, seen at the race, kg m²
    - ``drive_moment``: bore radius times friction coefficient times load, N m
    - ``steady_moment``: N m
    """
    given = (
        (race_inertia, "kg m^2"),
        (set_inertia, "kg m^2"),
        (drive_moment, "N m"),
        (steady_moment, "N m"),
    )
    return _each(_auxbear.race_acceleration, given)[0]


def _is_inner(race: str) -> bool:
    if race not in ("inner", "outer"):
        raise ValueError(f'race="inner" or "outer" is needed, not {race!r}')
    return race == "inner"


def _each(law: Callable[..., list[Any]], given: tuple[tuple[Numbers, str], ...], *more: bool) -> list[Any]:
    values = [_si.number(value, unit) for value, unit in given]
    if all(isinstance(value, (float, int)) for value in values):
        # a place alone needs no arrays, which would take longer than the law
        return [found.reshape(()) for found in law(values, *more)]
    arrays = numpy.broadcast_arrays(*(numpy.asarray(value, dtype=float) for value in values))
    flat = [numpy.ascontiguousarray(array).ravel() for array in arrays]
    return [found.reshape(arrays[0].shape) for found in law(flat, *more)]
