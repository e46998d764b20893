"""Scenarios: from files and values, changed, checked, refused."""

import copy
import pickle
import subprocess
import sys

import auxbear
import numpy
import pytest
from conftest import SCENARIOS

TORQUE = {"system": "torque", "bearing": {"name": "6005"}}


def test_a_dict_is_read_like_a_file():
    scenario = auxbear.Scenario(TORQUE, **{"torque.speed": "6000 rpm"})
    assert scenario.system == "torque"
    again = auxbear.Scenario.parse(scenario.toml())
    assert again.values() == scenario.values()
    assert scenario.origin("torque.speed")[0] == "given"


def test_the_starting_file_of_every_system_is_read():
    for kind in ["drop", "machine", "spin_up", "torque", "rig"]:
        assert auxbear.Scenario.parse(auxbear.template(kind)).system == kind


def test_set_changes_in_place_and_a_copy_stays():
    scenario = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml")
    before = scenario.copy()
    assert scenario.set("run.duration", "20 ms") is scenario
    assert scenario.values()["run.duration"] == "20 ms"
    assert before.values()["run.duration"] != "20 ms"


def test_what_is_refused_leaves_the_scenario_as_it_was():
    scenario = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml")
    before = scenario.toml()
    with pytest.raises(auxbear.Problem) as caught:
        scenario.set("rotor.mas", "8 kg")
    problem = caught.value
    assert problem.key == "rotor.mas" and problem.code.startswith("AB")
    assert "rotor.mass" in problem.hint
    assert "set()" in str(problem) and "--set" not in str(problem)
    assert scenario.toml() == before


def test_a_problem_of_a_file_has_its_line(tmp_path):
    file = tmp_path / "wrong.toml"
    text = (SCENARIOS / "reference_drop.toml").read_text(encoding="utf-8")
    file.write_text(text.replace("[rotor]", "[rotor]\ncolour = 3", 1), encoding="utf-8")
    with pytest.raises(auxbear.Problem) as caught:
        auxbear.Scenario.load(file)
    problem = caught.value
    assert problem.file == str(file)
    assert file.read_text(encoding="utf-8").splitlines()[problem.line - 1] == "colour = 3"
    assert problem.code in auxbear.explain(problem.code)
    again = pickle.loads(pickle.dumps(problem))
    assert (again.line, str(again)) == (problem.line, str(problem))


def test_a_file_that_is_missing_and_a_bare_number_are_problems(tmp_path):
    with pytest.raises(auxbear.Problem):
        auxbear.Scenario.load(tmp_path / "nothing.toml")
    with pytest.raises(auxbear.Problem) as caught:
        auxbear.Scenario(TORQUE, **{"torque.speed": 6000})
    assert caught.value.key == "torque.speed"


def test_numbers_of_numpy_and_quantities_of_pint_are_values(drop):
    scenario = drop.copy().set("bearing.ball_count", numpy.int64(9))
    assert scenario.values()["bearing.ball_count"] == "9"
    pint = pytest.importorskip("pint")
    unit = pint.UnitRegistry()
    for quantity, text in [(0.2 * unit.mm, "0.2 mm"), (200 * unit.um, "200 um")]:
        scenario.set("contact.radial_air_clearance", quantity)
        given = scenario.values()["contact.radial_air_clearance"]
        assert given.replace("µm", "um") == text
    scenario.set("mount.stiffness", 5e7 * unit.newton / unit.meter)
    scenario.set("rotor.polar_inertia", 0.02 * unit.kg * unit.m**2)


def test_what_is_no_value_is_told():
    with pytest.raises(TypeError, match="not object"):
        auxbear.Scenario(TORQUE, title=object())
    with pytest.raises(TypeError, match="as a value and as a table"):
        auxbear.Scenario({"rotor": 1, "rotor.mass": "8 kg"})


def test_a_check_runs_nothing(drop):
    assert all(warning.code.startswith("AB") for warning in drop.check())


def test_the_catalogue_is_asked():
    found = auxbear.bearing("SKF 6205-2RS1/C3")
    assert found["name"] == "6205" and "seals" in found["left_out"]
    assert found["values"]["bore_diameter"]["value"] == 0.025
    some = auxbear.bearings(bore="25 mm", kind="deep groove")
    assert "6205" in [one["name"] for one in some]
    with pytest.raises(auxbear.Problem):
        auxbear.bearing("no such")
    with pytest.raises(auxbear.Problem):
        auxbear.bearings(bore="25 kg")


def test_a_scenario_is_pickled_and_copied_whole():
    scenario = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml").set("run.duration", "20 ms")
    for other in (pickle.loads(pickle.dumps(scenario)), copy.deepcopy(scenario)):
        assert other.values() == scenario.values() and other.system == "drop"
        other.set("run.duration", "10 ms")
        assert scenario.values()["run.duration"] == "20 ms"


def test_numbers_of_numpy_are_numbers():
    scenario = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml")
    for number in (numpy.float64(0.2), numpy.float32(0.25), numpy.int64(0)):
        scenario.set("contact.friction_coefficient", number)
        assert float(scenario.values()["contact.friction_coefficient"]) == float(number)


def test_the_pages_are_there_when_they_are_named():
    script = "import auxbear; print(auxbear.laws.hertz, auxbear.optimise.Question, auxbear.distributed.run)"
    subprocess.run([sys.executable, "-c", script], check=True)
    with pytest.raises(AttributeError):
        auxbear.nothing
