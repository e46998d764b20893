"""Many runs of one scenario."""

from __future__ import annotations

import datetime
import json
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

from auxbear import _auxbear, _progress, _toml
from auxbear._progress import Progress
from auxbear.result import Table, unknown
from auxbear.scenario import Scenario


class Study:
    """A design over the inputs of a scenario.

    From a file: ``Study.load("study.toml")``. From values: a dict or keyword arguments in the sections of a file; its scenario
    is named by a path, relative to the current directory.

    >>> Study(scenario="drop.toml", seed=1, design={"kind": "sobol", "points": 64},
    ...       input=[{"path": "rotor.mass", "uniform": ["7 kg", "9 kg"]}])
    """

    __slots__ = ("_native",)

    def __init__(self, values: Mapping[str, Any] | None = None, /, **more: Any) -> None:
        given = {"format": "auxbear.study/1", **(values or {}), **more}
        self._native = _auxbear.Study.parse(_toml.document(given), "study from Python", ".")

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Study:
        """Reads a file and the scenario that it names."""
        return cls._of(_auxbear.Study.read(path))

    @classmethod
    def _of(cls, native: _auxbear.Study) -> Study:
        study = cls.__new__(cls)
        study._native = native
        return study

    @property
    def members(self) -> int:
        """Number of members of the design."""
        return self._native.members()

    @property
    def inputs(self) -> list[str]:
        """The paths that differ from member to member."""
        return self._native.inputs()

    @property
    def kind(self) -> str:
        """Word of the design."""
        return self._native.kind()

    @property
    def scenario(self) -> Scenario:
        """The scenario that is run many times."""
        return Scenario._of(self._native.scenario())

    def member(self, k: int) -> Scenario:
        """The scenario of member k: a run of it gives that member's results."""
        return Scenario._of(self._native.member(k))

    def toml(self) -> str:
        """The resolved file."""
        return self._native.toml()

    def run(
        self,
        directory: str | PathLike[str],
        *,
        add: int = 0,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> StudyResult:
        """Begins the study in a directory, or goes on where it stopped.

        Ctrl-C ends it with ``KeyboardInterrupt``; the parts computed stand in the directory, and the same call goes on.

        - ``add``: blocks that are added to the design
        - ``threads``, ``progress``: as of ``Scenario.run``
        """
        tell, end = _progress.shown("study", progress)
        try:
            self._native.run(directory, add, threads, tell)
        finally:
            end()
        return StudyResult.load(directory)

    def qualify(
        self,
        directory: str | PathLike[str],
        *,
        date: str | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> list[dict[str, Any]]:
        """Begins a qualification in a directory, or goes on where it stopped, and writes its ``document.html``.

        Returns its requirements: text, verdict (``met``, ``not met``, ``not shown``), worst value, margin and member.

        - ``date``: as the document has it; today
        - ``threads``, ``progress``: as of ``Scenario.run``
        """
        tell, end = _progress.shown("qualify", progress)
        try:
            self._native.qualify(directory, date or datetime.date.today().isoformat(), threads, tell)
        finally:
            end()
        text = (Path(directory) / "qualification.json").read_text(encoding="utf-8")
        return json.loads(text)["requirements"]

    def __repr__(self) -> str:
        return f"<auxbear.Study {self.kind}, {self.members} members>"


class StudyResult:
    """What a study directory holds."""

    def __init__(self, directory: Path, study: Study, members: Table, summary: dict[str, Any]) -> None:
        self.directory = directory
        self.study = study
        #: Drawn inputs (``input.…``) beside results, a row a member
        self.members = members
        #: What ``summary.json`` holds: spreads, limits with verdicts, sensitivity, failed members
        self.summary = summary

    @classmethod
    def load(cls, directory: str | PathLike[str]) -> StudyResult:
        """Reads a study directory."""
        native, members = _auxbear.read_study(directory)
        place = Path(directory)
        summary = json.loads((place / "summary.json").read_text(encoding="utf-8"))
        return cls(place, Study._of(native), Table(members), summary)

    @property
    def complete(self) -> bool:
        """Whether all members are there."""
        return self.summary["complete"]

    @property
    def failed(self) -> list[dict[str, Any]]:
        """Members that did not end as planned, with the reason."""
        return self.summary["failed"]

    @property
    def limits(self) -> list[dict[str, Any]]:
        """Limits with their verdicts."""
        return self.summary["limits"]

    @property
    def estimate(self) -> dict[str, Any] | None:
        """Inputs with their standard uncertainties, of a study of ``kind = "estimate"`` whose members are all there."""
        return self.summary.get("estimate")

    def __getitem__(self, name: str) -> dict[str, Any]:
        """Mean and spread of a result over the members."""
        known = self.summary["quantities"]
        if name not in known:
            raise unknown("result", name, list(known))
        return known[name]

    def __repr__(self) -> str:
        return f"<auxbear.StudyResult {len(self.members)} of {self.study.members} members, {len(self.failed)} failed>"
