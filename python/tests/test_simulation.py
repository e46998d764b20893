"""A machine that is driven from outside."""

import pytest

import auxbear
from auxbear import Scenario


def drop(rotor: str = "") -> Scenario:
    text = auxbear.template("drop").replace("[rotor]", f"[rotor]\n{rotor}", 1)
    return Scenario.parse(text).set("run.duration", "12 ms").set("run.method", "explicit")


def test_without_inputs_it_is_a_run() -> None:
    scenario = drop()
    simulation = scenario.simulation()
    assert not simulation.advance(1.0)
    assert simulation.stop is not None and simulation.stop[0] == "finished"
    assert simulation["rotor.speed"] == float(scenario.run()["rotor_final_speed"])
    assert "rotor.x" in simulation and len(simulation) == len(list(simulation))
    with pytest.raises(KeyError):
        simulation["no such channel"]


def test_a_controller_of_ones_own_brakes() -> None:
    simulation = drop('spin = "braked"\nbrake_torque = "5 N m"\nbrake_start = "1 s"').simulation()
    free = simulation["rotor.speed"]
    while simulation.advance(simulation.time + 1e-3):
        simulation.brake(simulation.time >= 2e-3)
    assert simulation["rotor.speed"] < free
    assert simulation.time == pytest.approx(12e-3)


def test_inputs_that_a_machine_does_not_have_are_refused() -> None:
    simulation = drop().simulation()
    for change in (lambda: simulation.brake(True), lambda: simulation.load(10.0), lambda: simulation.torque(1.0)):
        with pytest.raises(auxbear.Problem):
            change()
    with pytest.raises(auxbear.Problem, match="nothing else moves"):
        Scenario.parse(auxbear.template("torque")).simulation()
