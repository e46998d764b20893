"""A scenario as the function of an optimiser."""

import math

import auxbear
import numpy
import pytest
from auxbear.optimise import Question
from auxbear.result import Evaluated
from conftest import SCENARIOS

optuna = pytest.importorskip("optuna")

STARTS = [{"rotor.unbalance_angle": f"{45 * k} deg"} for k in range(4)]


def test_rows_are_single_runs_to_the_bit(drop):
    changes = [{"rotor.mass": "7 kg"}, {"rotor.mass": "8.5 kg", "mount.stiffness": "1e7 N/m"}, {"rotor.mass": "-1 kg"}]
    table, failed = drop.evaluate(changes)
    assert list(failed) == [2] and "rotor.mass" in failed[2]
    for row, change in enumerate(changes[:2]):
        single = drop.copy()
        for path, value in change.items():
            single.set(path, value)
        result = single.run()
        for name in ("first_impact_force", "peak_hertz_pressure", "energy_dissipated"):
            if name in table.columns:
                assert table[name][row] == float(result[name])
    assert "first_impact_force" in table.columns
    assert math.isnan(table["first_impact_force"][2])


def test_an_answer_has_objectives_noise_and_constraints(drop):
    question = Question(drop, minimise=["first_impact_force"], at_most={"first_impact_force": "700 N"}, draws=STARTS)
    soft, hard, refused = question.ask([{"mount.stiffness": "5e6 N/m"}, {"mount.stiffness": "8e7 N/m"}, {"mount.stiffness": "-1 N/m"}])
    assert soft.objectives < hard.objectives
    assert soft.allowed and not hard.allowed
    assert soft.noise[0] > 0.0
    assert hard.constraints[0] == pytest.approx(hard.objectives[0] / 700.0 - 1.0)
    assert refused.objectives == [math.inf] and len(refused.failed) == len(STARTS)


def test_names_that_are_no_results_are_refused(drop):
    with pytest.raises(KeyError, match="first_impact_force"):
        Question(drop, minimise=["first_impact_forces"]).ask([{}])
    with pytest.raises(ValueError, match="objective"):
        Question(drop)


class Columns(dict):
    """As much of a table as an answer needs."""

    @property
    def columns(self):
        return list(self)


class Formula:
    """Stands for a scenario: results in closed form, and noise that the draws bring."""

    def copy(self):
        return self

    def evaluate(self, changes, *, threads=None):
        x = numpy.array([change["x"] for change in changes])
        y = numpy.array([change.get("y", 0.0) for change in changes])
        noise = numpy.array([math.sin(97.0 * change["draw"] + 13.0 * change["x"]) for change in changes])
        columns = {"bowl": (x - 0.3) ** 2 + 0.05 * noise, "left": x**2 + y**2, "right": (x - 1.0) ** 2 + y**2}

        return Evaluated(Columns(columns), {})


def asked(question, directions, proposals, batches, seed):
    """Optuna proposes batches and is told what they give."""
    optuna.logging.set_verbosity(optuna.logging.WARNING)
    sampler = optuna.samplers.NSGAIISampler(population_size=20, seed=seed) if len(directions) > 1 else optuna.samplers.TPESampler(seed=seed)
    study = optuna.create_study(directions=directions, sampler=sampler)
    for _ in range(batches):
        trials = [study.ask() for _ in range(20)]
        answers = question.ask([proposals(trial) for trial in trials])
        for trial, answer in zip(trials, answers, strict=True):
            study.tell(trial, answer.objectives)
    return study


def test_a_noisy_minimum_is_found():
    draws = [{"draw": k} for k in range(16)]
    question = Question(Formula(), minimise=["bowl"], draws=draws)
    study = asked(question, ["minimize"], lambda trial: {"x": trial.suggest_float("x", -2.0, 2.0)}, 8, seed=1)
    assert abs(study.best_params["x"] - 0.3) < 0.15
    answer = question.ask([{"x": 0.3}])[0]
    assert 0.0 < answer.noise[0] < 0.05


def test_a_pareto_front_is_found():
    question = Question(Formula(), minimise=["left", "right"], draws=[{"draw": 0}])

    def proposed(trial):
        return {"x": trial.suggest_float("x", -1.0, 2.0), "y": trial.suggest_float("y", -1.0, 1.0)}

    study = asked(question, ["minimize", "minimize"], proposed, 30, seed=2)
    front = [trial.values for trial in study.best_trials]
    assert len(front) > 10
    # in closed form √left + √right = 1
    missed = [abs(math.sqrt(left) + math.sqrt(right) - 1.0) for left, right in front]
    assert numpy.median(missed) < 0.02


def test_a_real_mount_is_chosen():
    drop = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml").set("run.duration", "12 ms").set("run.accuracy", "screening")
    question = Question(drop, minimise=["first_impact_force"], draws=STARTS)
    study = asked(question, ["minimize"], lambda trial: {"mount.stiffness": f"{trial.suggest_float('k', 1e6, 1e8, log=True)} N/m"}, 2, seed=3)
    # a softer mount is hit less hard
    assert study.best_params["k"] < 3e6


def test_a_key_or_a_number_that_no_run_can_take_raises(drop):
    for change in [{"rotor.mas": "8 kg"}, {"rotor.mass": 8.0}, {"rotor.mass": numpy.float64(8.0)}, {"rotor.mass": "8 m"}]:
        with pytest.raises(auxbear.Problem, match="rotor.mas"):
            drop.evaluate([{}, change])
        with pytest.raises(auxbear.Problem, match="rotor.mas"):
            Question(drop, minimise=["first_impact_force"]).ask([change])


def test_numbers_of_numpy_are_values_of_a_candidate(drop):
    values = numpy.linspace(0.1, 0.3, 2)
    table, failed = drop.evaluate([{"contact.friction_coefficient": value} for value in values])
    assert not failed and numpy.isfinite(table["first_impact_force"]).all()
