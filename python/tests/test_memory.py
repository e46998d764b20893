"""Measured channels in memory."""

import gc
from pathlib import Path

import auxbear
import numpy
import pytest
from conftest import SCENARIOS

INTERVAL = 1e-5
MARKS = 60


def turning(acceleration):
    """Times and turned angle of a shaft at 100 rad/s that is accelerated in the middle."""
    time = numpy.arange(60_000) * INTERVAL
    late = numpy.clip(time - 0.2, 0.0, 0.2)
    angle = 100.0 * time + 0.5 * acceleration * late**2 + acceleration * 0.2 * numpy.clip(time - 0.4, 0.0, None)
    return time, angle


def signals(recording, **more):
    speed = {"channel": "tacho", "kind": "analog", "marks_per_revolution": MARKS}
    torque = {"channel": "torque", "sensor_frequency": "300 Hz", "damping_ratio": 0.2}
    return auxbear.Scenario(system="signals", signals={"file": recording, "speed": speed, "torque": torque, **more})


def recorded(acceleration=500.0, **clock):
    time, angle = turning(acceleration)
    noise = numpy.random.default_rng(1).normal(0.0, 1e-4, len(time))
    channels = {"tacho": 5.0 * (numpy.sin(MARKS * angle) > 0.0), "torque": 0.025 + noise}
    return auxbear.Recording(channels, units={"torque": "N m", "tacho": "V"}, **(clock or {"interval": "10 us"}))


def test_arrays_give_speed_and_torque():
    result = signals(recorded()).run()
    history = result.history
    late = history["time"] > 0.45
    assert abs(history["shaft.speed"][late].mean() - 200.0) < 0.05
    assert result.complete
    # a text, a number and instants state the same clock
    for clock in ({"interval": INTERVAL}, {"time": turning(0.0)[0]}):
        again = signals(recorded(**clock)).run()
        assert abs(float(again["peak_speed"]) - float(result["peak_speed"])) < 1e-6


def test_a_recording_lives_as_long_as_what_names_it():
    recording = recorded()
    path = Path(recording)
    scenario = signals(recording)
    copy = scenario.copy()
    del recording, scenario
    gc.collect()
    assert path.exists()
    copy.run()
    del copy
    gc.collect()
    assert not path.exists()


def test_what_is_no_recording_is_refused():
    for channels, more, error in [
        ({}, {"interval": 1.0}, "a channel"),
        ({"a": [[1.0]]}, {"interval": 1.0}, "shape"),
        ({"a": [1.0]}, {}, "interval or time"),
        ({"a": [1.0]}, {"interval": "1 mm"}, "no quantity in s"),
        ({"a": [1.0, 2.0, 3.0]}, {"time": [0.0, 1.0, 3.0]}, "evenly"),
        ({"a": [1.0]}, {"interval": 1.0, "units": {"b": "V"}}, "not there"),
    ]:
        with pytest.raises((TypeError, ValueError, KeyError), match=error):
            auxbear.Recording(channels, **more)


def test_signals_in_memory_are_a_test_of_identify(tmp_path):
    # what a simulated rig wrote, named by scenarios or by their files, tells the same
    tests = []
    for name in ("rig_coast_down", "rig_test_1"):
        auxbear.Scenario.load(SCENARIOS / f"{name}.toml").run().write(tmp_path / name)
        file = tmp_path / name / "signals.toml"
        given = auxbear.Scenario.load(file)
        tests.append((file, given))
    asked = {"viscosity": "100 mm^2/s"}
    bearing = {"name": "6005"}

    def found(coast_down, test):
        values = {"coast_down": [coast_down], "tests": [test], **asked}
        result = auxbear.Scenario(system="identify", identify=values, bearing=bearing).run()
        return {name: quantity.value for name, quantity in result.items() if isinstance(quantity.value, float)}

    of_files = found(str(tests[0][0]), str(tests[1][0]))
    of_memory = found(tests[0][1], tests[1][1])
    assert len(of_files) > 20
    assert of_memory == of_files
