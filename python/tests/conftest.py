"""Scenarios that are short, and shared between tests."""

from pathlib import Path

import auxbear
import pytest

SCENARIOS = Path(__file__).parents[2] / "scenarios"


@pytest.fixture(scope="session")
def drop():
    """A drop of 20 ms: the first contacts."""
    scenario = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml")
    return scenario.set("run.duration", "20 ms")


@pytest.fixture(scope="session")
def result(drop):
    return drop.run()


@pytest.fixture
def short_study(tmp_path):
    """A study of drops of 12 ms that runs in a moment."""
    drop = auxbear.Scenario.load(SCENARIOS / "reference_drop.toml").set("run.duration", "12 ms")
    file = tmp_path / "drop.toml"
    file.write_text(drop.toml(), encoding="utf-8")
    return auxbear.Study(
        scenario=str(file),
        seed=3,
        design={"kind": "sobol", "members": 32},
        input=[{"path": "rotor.mass", "uniform": ["7 kg", "9 kg"]}],
    )
