"""A scenario as the function that an optimiser asks: batches in, objectives with their noise and constraints out.

There is no optimiser here. Optuna, pymoo, or any that asks for values of a batch, proposes; this answers:

>>> question = Question(scenario, minimise=["first_impact_force"], at_most={"whirl_amplitude": "0.3 mm"}, draws=draws)
>>> for answer in question.ask([{"mount.stiffness": "2e7 N/m"}, {"mount.stiffness": "4e7 N/m"}]):
...     print(answer.objectives, answer.noise, answer.constraints)

Impacts are chaotic: one run of a candidate says little of it. ``draws`` are starts, or whatever else scatters; every candidate
meets the same ones, so that candidates differ less by chance than their values do.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from auxbear import _si
from auxbear.result import Evaluated, unknown
from auxbear.scenario import Scenario


class Answer(NamedTuple):
    """What a candidate gives."""

    #: Mean of each objective over the draws, to be made small: of one that is to be large the negative; infinite where all
    #: draws failed
    objectives: list[float]
    #: Standard error of each mean
    noise: list[float]
    #: Mean of each limited result less its limit, over the size of the limit: at most 0 where it is kept; infinite where all draws failed
    constraints: list[float]
    #: Reasons of the draws that failed
    failed: list[str]

    @property
    def allowed(self) -> bool:
        """Whether no draw failed and all constraints are kept."""
        return not self.failed and all(value <= 0.0 for value in self.constraints)


class Question:
    """What is asked of every candidate.

    - ``minimise``, ``maximise``: names of results, the objectives in this order
    - ``at_most``, ``at_least``: limits by the names of results, numbers in SI, texts with a unit or quantities of pint
    - ``draws``: changes that scatter, a dict of paths and values each; by default the scenario as it is
    """

    def __init__(
        self,
        scenario: Scenario,
        *,
        minimise: Sequence[str] = (),
        maximise: Sequence[str] = (),
        at_most: Mapping[str, Any] | None = None,
        at_least: Mapping[str, Any] | None = None,
        draws: Sequence[Mapping[str, Any]] = ({},),
    ) -> None:
        self._scenario = scenario.copy()
        self._objectives = [(name, 1.0) for name in minimise] + [(name, -1.0) for name in maximise]
        if not self._objectives:
            raise ValueError("an objective at least is needed: minimise or maximise")
        if not draws:
            raise ValueError("a draw at least is needed; one that changes nothing is {}")
        self._limits = [(name, value, 1.0) for name, value in (at_most or {}).items()]
        self._limits += [(name, value, -1.0) for name, value in (at_least or {}).items()]
        self._draws = [dict(draw) for draw in draws]

    @property
    def objectives(self) -> list[str]:
        """Names of the objectives."""
        return [name for name, _ in self._objectives]

    def ask(self, candidates: Sequence[Mapping[str, Any]], *, threads: int | None = None) -> list[Answer]:
        """Runs every candidate with every draw, side by side, and returns an answer each.

        A candidate is a dict of paths and values. One whose run fails, or whose values are out of range, is an answer with the
        reasons; an unknown key or a number without its unit raises ``Problem``.
        """
        changes = [{**candidate, **draw} for candidate in candidates for draw in self._draws]
        evaluated = self._scenario.evaluate(changes, threads=threads)
        count = len(self._draws)
        return [self._answer(evaluated, range(k * count, (k + 1) * count)) for k in range(len(candidates))]

    def _answer(self, evaluated: Evaluated, rows: range) -> Answer:
        failed = [evaluated.failed[row] for row in rows if row in evaluated.failed]
        if len(failed) == len(rows):
            infinite = float("inf")
            return Answer([infinite] * len(self._objectives), [0.0] * len(self._objectives), [infinite] * len(self._limits), failed)
        objectives, noise = [], []
        for name, sign in self._objectives:
            mean, error = _mean(evaluated, name, rows)
            objectives.append(sign * mean)
            noise.append(error)
        constraints = []
        for name, limit, sign in self._limits:
            mean, _ = _mean(evaluated, name, rows)
            most = float(_si.number(limit, evaluated.table.units[name]))
            constraints.append(sign * (mean - most) / (abs(most) or 1.0))
        return Answer(objectives, noise, constraints, failed)


def _mean(evaluated: Evaluated, name: str, rows: range) -> tuple[float, float]:
    import numpy

    if name not in evaluated.table.columns:
        raise unknown("result", name, evaluated.table.columns)
    values = evaluated.table[name][rows.start : rows.stop]
    values = values[numpy.isfinite(values)]
    if not len(values):
        # a result that no draw has, as the force of a contact that never begins
        return float("nan"), 0.0
    spread = float(values.std(ddof=1)) if len(values) > 1 else float("nan")
    return float(values.mean()), spread / len(values) ** 0.5
