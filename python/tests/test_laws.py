"""Laws over arrays: the numbers of a run, shapes, limits, signs."""

import auxbear
import numpy
import pytest
from auxbear import laws

BALL = dict(ball_diameter=6.6e-3, pitch_diameter=36e-3, groove_curvature=0.52, contact_modulus=1.13e11)


def test_hertz_has_its_powers_and_its_shape():
    load = numpy.array([[1.0, 8.0, 64.0]])
    found = laws.hertz(load, **BALL, race="inner")
    assert found.approach.shape == (1, 3)
    # Q = K δ^1.5, p ~ Q^⅓, and the mean pressure is two thirds of the largest
    numpy.testing.assert_allclose(found.stiffness * found.approach**1.5, load, rtol=1e-12)
    pressure = found.maximum_pressure
    numpy.testing.assert_allclose(pressure[0, 1:] / pressure[0, :-1], 2.0, rtol=1e-12)
    area = numpy.pi * found.semi_major * found.semi_minor
    numpy.testing.assert_allclose(pressure, 1.5 * load / area, rtol=1e-12)
    outer = laws.hertz(load, **BALL, race="outer")
    assert (outer.maximum_pressure < pressure).all()


def test_palmgren_is_the_law_of_a_torque():
    scenario = auxbear.Scenario(system="torque", bearing={"name": "6005", "moment": {"law": "palmgren"}})
    result = scenario.run()
    values, bearing = scenario.values(), auxbear.bearing("6005")["values"]

    def factor(key):
        return float(values[f"bearing.moment.{key}"])

    moment = laws.palmgren(
        float(result["speed"]),
        float(result["radial_load"]),
        viscous_factor=factor("f0"),
        viscosity=float(result["viscosity"]),
        pitch_diameter=bearing["pitch_diameter"]["value"],
        load_factor=factor("f1_factor"),
        load_exponent=factor("f1_exponent"),
        static_load_rating=bearing["static_load_rating"]["value"],
    )
    assert float(moment.sum) == pytest.approx(float(result["friction_moment"]), rel=1e-9)


def test_palmgren_is_odd_in_speed_and_fades_at_rest():
    speeds = numpy.array([-300.0, 0.0, 300.0])
    constants = dict(viscous_factor=1.5, viscosity=2e-5, pitch_diameter=36e-3)
    more = dict(load_factor=7e-4, load_exponent=0.5, static_load_rating=6.5e3)
    moment = laws.palmgren(speeds, 100.0, **constants, **more).sum
    assert moment[0] == -moment[2] < 0.0 == moment[1]


def test_a_film_grows_with_speed_and_shrinks_under_load():
    oil = dict(viscosity=0.02, pressure_coefficient=2e-8, race="inner")
    speed, load = numpy.array([[1.0], [2.0]]), numpy.array([50.0, 100.0, 200.0])
    film = laws.film(speed, load, **BALL, **oil)
    assert film.central.shape == (2, 3)
    assert (film.minimum < film.central).all()
    assert (numpy.diff(film.central, axis=0) > 0).all() and (numpy.diff(film.central, axis=1) < 0).all()


def test_a_driven_race_accelerates_by_the_moment_that_is_left():
    moments = numpy.array([0.0, 0.5, 1.0])
    given = dict(race_inertia=3e-5, set_inertia=1e-5, drive_moment=0.4)
    found = laws.race_acceleration(**given, steady_moment=0.4 * moments)
    numpy.testing.assert_allclose(found, [1e4, 5e3, 0.0], rtol=1e-12, atol=1e-9)


def test_what_makes_no_contact_is_refused():
    with pytest.raises(ValueError, match="groove"):
        laws.hertz(1.0, **{**BALL, "groove_curvature": 0.49}, race="inner")
    with pytest.raises(ValueError, match="inner"):
        laws.hertz(1.0, **BALL, race="middle")


def test_skf_has_its_powers_and_signs():
    bearing = dict(mean_diameter=36e-3, rolling_factors=(4.1e-7, 1.7), sliding_factors=(3.73e-3, 14.6), static_load_rating=6550.0)
    speed = numpy.array([10.0, -10.0, 20.0])
    found = laws.skf(speed, 300.0, viscosity=20e-6, seal_moment=0.01, **bearing)
    assert found.speed_dependent[0] == -found.speed_dependent[1] > 0.0
    assert found.load_dependent[0] == -found.load_dependent[1] > 0.01
    # rolling grows with (ν n)^0.6 where the inlet does not warm
    assert found.speed_dependent[2] / found.speed_dependent[0] == pytest.approx(2.0**0.6, rel=2e-3)
    # a slow bearing rubs as its boundaries do, in proportion to μ_bl
    slow = [laws.skf(1e-3, 300.0, viscosity=20e-6, boundary_friction=mu, **bearing).load_dependent for mu in (0.1, 0.2)]
    assert slow[1] / slow[0] == pytest.approx(2.0, rel=1e-3)
    with pytest.raises(ValueError, match="static_load_rating"):
        laws.skf(1.0, 300.0, mean_diameter=36e-3, viscosity=20e-6, rolling_factors=(4.1e-7, 1.7), sliding_factors=(3.73e-3, 14.6))


def test_units_are_converted_and_others_refused():
    pint = pytest.importorskip("pint")
    units = pint.UnitRegistry()
    plain = laws.hertz(100.0, **BALL, race="inner")
    with_units = BALL | {"ball_diameter": units.Quantity(6.6, "mm"), "pitch_diameter": "36 mm"}
    for load in (units.Quantity(0.1, "kN"), "0.1 kN", numpy.float32(100.0)):
        found = laws.hertz(load, **with_units, race="inner")
        assert found.maximum_pressure == pytest.approx(plain.maximum_pressure, rel=1e-12)
    many = laws.hertz(units.Quantity([0.1, 0.2], "kN"), **BALL, race="inner")
    assert many.maximum_pressure[0] == pytest.approx(plain.maximum_pressure, rel=1e-12)
    with pytest.raises(pint.DimensionalityError):
        laws.hertz(units.Quantity(1.0, "m"), **BALL, race="inner")
    with pytest.raises(ValueError, match="quantity in N"):
        laws.hertz("1 m", **BALL, race="inner")


def test_bodies_that_change_from_place_to_place_are_each_their_own():
    diameters = numpy.array([6.6e-3, 6.6e-3, 8e-3, 6.6e-3])
    many = laws.hertz(50.0, **(BALL | {"ball_diameter": diameters}), race="outer")
    for place, diameter in enumerate(diameters):
        one = laws.hertz(50.0, **(BALL | {"ball_diameter": diameter}), race="outer")
        assert many.stiffness[place] == one.stiffness and one.stiffness.shape == ()
