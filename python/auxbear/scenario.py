"""What is simulated."""

from __future__ import annotations

import re
import shutil
import tempfile
import warnings
import weakref
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from auxbear import _auxbear, _progress, _toml
from auxbear._progress import Progress
from auxbear.result import Declared, Evaluated, ModelWarning, Result, RunWarning, Table
from auxbear.simulation import Simulation


class Scenario:
    """A scenario that was read and checked.

    From a file: ``Scenario.load("drop.toml")``. From values: a dict or keyword arguments, in the sections of a file. A quantity
    is a text with its unit or a quantity of pint; a key may be a path:

    >>> Scenario(system="torque", bearing={"name": "6005"}, **{"torque.speed": "6000 rpm"})

    Raises ``Problem`` for whatever a file with these values would be refused.
    """

    __slots__ = ("_native", "_kept", "__weakref__")

    def __init__(self, values: Mapping[str, Any] | None = None, /, **more: Any) -> None:
        given = {"format": "auxbear.scenario/1", **(values or {}), **more}
        # recordings among the values live as long as what names them
        self._kept: list[Any] = [given]
        self._native = _auxbear.Scenario.parse(_toml.document(given), "scenario from Python")

    @classmethod
    def load(cls, path: str | PathLike[str]) -> Scenario:
        """Reads a file. Paths in it are relative to the file."""
        return cls._of(_auxbear.Scenario.read(path))

    @classmethod
    def parse(cls, text: str, name: str = "text") -> Scenario:
        """Reads a text in the format of a file; the name stands for the file in messages."""
        return cls._of(_auxbear.Scenario.parse(text, name))

    @classmethod
    def _of(cls, native: _auxbear.Scenario) -> Scenario:
        scenario = cls.__new__(cls)
        scenario._native = native
        scenario._kept = []
        return scenario

    def set(self, path: str, value: Any) -> Scenario:
        """Changes one value in place and returns the scenario, so that calls can follow each other.

        What is refused raises ``Problem`` and leaves the scenario as it was. ``copy()`` first, to keep the one that was.
        """
        self._native = self._native.changed([(path, _toml.value(value))])
        self._kept.append(value)
        return self

    def copy(self) -> Scenario:
        """Another scenario with these values."""
        copy = self._of(self._native)
        copy._kept = list(self._kept)
        return copy

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Scenario:
        # what was read does not change, and recordings are files
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        # recordings in memory live as long as this process holds them
        return Scenario.parse, (self.toml(), self.title or "scenario from Python")

    @property
    def system(self) -> str:
        """Name of the system: ``"drop"``, ``"machine"``, ``"spin_up"``, ``"torque"``, ``"rig"``, …"""
        return self._native.system()

    @property
    def title(self) -> str | None:
        """Title of the report."""
        return self._native.title()

    def _as_file(self) -> str:
        """A file of these values, for a scenario that names it."""
        folder = tempfile.mkdtemp(prefix="auxbear-")
        weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        name = re.sub(r"[^\w .-]", "-", self.title or self.system)
        path = Path(folder) / f"{name[:100]}.toml"
        path.write_text(self.toml(), encoding="utf-8")
        return str(path)

    def toml(self) -> str:
        """The resolved file: every value with its unit, and defaults."""
        return self._native.toml()

    def values(self) -> dict[str, str | None]:
        """Every value by its path, as a text with unit; None for what is not given or follows from other values."""
        return {path: text for path, text, _, _ in self._native.values()}

    def origin(self, path: str) -> tuple[str, str]:
        """Where a value is from: a word, such as ``"given"`` or ``"assumed"``, and a note."""
        for known, _, mark, note in self._native.values():
            if known == path:
                return mark, note
        raise KeyError(path)

    def check(self) -> list[RunWarning]:
        """Builds the machine, runs nothing, and returns what should be known before a run."""
        return [RunWarning(*warning) for warning in self._native.check()]

    def results(self) -> list[Declared]:
        """Name, unit and meaning of each result of a run, without running it. A ``*`` stands for what only a run decides."""
        return [Declared(*of) for of in self._native.results()]

    def columns(self) -> list[Declared]:
        """Name, unit and meaning of each column of the history, without a run."""
        return [Declared(*of) for of in self._native.columns()]

    def run(
        self,
        *,
        repeat: int | None = None,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> Result:
        """Simulates it.

        A run that fails returns what was computed: see ``Result.complete``. Warnings of the model are issued as
        ``ModelWarning`` too. Ctrl-C ends it with ``KeyboardInterrupt``.

        - ``repeat``: number of drops from random unbalance angles, ``repeat.count`` of a file
        - ``threads``: all cores by default
        - ``progress``: a function that is told the share done, from 0 to 1; True or False shows a line or none; by default a
          line is shown in notebooks and terminals
        """
        native = self._native
        if repeat is not None:
            native = native.changed([("repeat.count", _toml.value(repeat))])
        tell, end = _progress.shown(native.system(), progress)
        try:
            outcome = native.run(threads, tell)
        finally:
            end()
        result = Result(outcome)
        for warning in result.warnings:
            warnings.warn(f"{warning.code}: {warning.text}", ModelWarning, stacklevel=2)
        return result

    def simulation(self) -> Simulation:
        """The machine at its start, to be driven step by step with inputs of one's own: a drop, a spin-up or a test on a rig."""
        return Simulation(self._native.simulation())

    def fmu(
        self,
        path: str | PathLike[str],
        *,
        input: str = "current",
        version: int | str = 2,
        libraries: Sequence[str | PathLike[str]] | None = None,
    ) -> Path:
        """Writes a drop or machine, without the controllers of its magnets, as a co-simulation unit, and returns its path.

        ``input`` is what commands the magnets, ``"current"``, ``"voltage"`` or ``"force"``, ``version`` that of FMI, 2 or 3. ``libraries``
        are those of the platforms; without, the one of the package for this platform.
        """
        own = [Path(library) for library in libraries] if libraries else sorted(Path(__file__).parent.glob("*auxbear_fmu.*"))
        self._native.unit(Path(path), input, str(version), own)
        return Path(path)

    def evaluate(
        self,
        changes: Sequence[Mapping[str, Any]],
        *,
        threads: int | None = None,
        progress: bool | Progress | None = None,
    ) -> Evaluated:
        """Simulates it once with each of these changes, dicts of paths and values, many side by side.

        Returns a table of results, a row each, and the reasons of the rows that failed, also of values that are out of range. A
        path or a value that no run could take, such as an unknown key or a number without its unit, raises ``Problem``. The
        numbers of a row depend on its changes alone.
        """
        given = [[(path, _toml.value(value)) for path, value in change.items()] for change in changes]
        tell, end = _progress.shown(self.system, progress)
        try:
            table, failed = self._native.evaluate(given, threads, tell)
        finally:
            end()
        return Evaluated(Table(table), failed)

    def __repr__(self) -> str:
        title = f": {self.title}" if self.title else ""
        return f"<auxbear.Scenario {self.system}{title}>"


def template(kind: str) -> str:
    """The commented starting file of a kind: ``"drop"``, ``"machine"``, ``"spin_up"``, ``"torque"``, ``"study"``, …"""
    return _known(kind, _auxbear.template(kind))


def schema(kind: str) -> str:
    """The JSON Schema of a kind of file, for editors; of ``"summary"`` that of a run's ``summary.json``."""
    return _known(kind, _auxbear.schema(kind))


def _known(kind: str, text: str | None) -> str:
    if text is None:
        raise ValueError(f'"{kind}" is no kind of file; auxbear.template("drop") is one')
    return text


def explain(code: str) -> str:
    """The book's page of an error or warning code."""
    return _auxbear.explain(code)
