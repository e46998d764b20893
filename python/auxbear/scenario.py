"""What is simulated."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from os import PathLike
from typing import Any

from auxbear import _auxbear, _progress, _toml
from auxbear._progress import Progress
from auxbear.result import ModelWarning, Result, RunWarning


class Scenario:
    """A scenario that was read and checked.

    From a file: ``Scenario.load("drop.toml")``. From values: a dict or keyword arguments, in the sections of a file. A quantity
    is a text with its unit or a quantity of pint; a key may be a path:

    >>> Scenario(system="torque", bearing={"name": "6005"}, **{"torque.speed": "6000 rpm"})

    Raises ``Problem`` for whatever a file with these values would be refused.
    """

    __slots__ = ("_native",)

    def __init__(self, values: Mapping[str, Any] | None = None, /, **more: Any) -> None:
        given = {"format": "auxbear.scenario/1", **(values or {}), **more}
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
        return scenario

    def set(self, path: str, value: Any) -> Scenario:
        """Changes one value in place and returns the scenario, so that calls can follow each other.

        What is refused raises ``Problem`` and leaves the scenario as it was. ``copy()`` first, to keep the one that was.
        """
        self._native = self._native.changed([(path, _toml.value(value))])
        return self

    def copy(self) -> Scenario:
        """Another scenario with these values."""
        return self._of(self._native)

    __copy__ = copy

    @property
    def system(self) -> str:
        """Name of the system: ``"drop"``, ``"machine"``, ``"spin_up"``, ``"torque"``, ``"rig"``, …"""
        return self._native.system()

    @property
    def title(self) -> str | None:
        """Title of the report."""
        return self._native.title()

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
        return [RunWarning(code, text) for code, text in self._native.check()]

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

        - ``repeat``: number of perturbed starts, ``repeat.count`` of a file
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

    def __repr__(self) -> str:
        title = f": {self.title}" if self.title else ""
        return f"<auxbear.Scenario {self.system}{title}>"


def template(kind: str) -> str:
    """The commented starting file of a kind: ``"drop"``, ``"machine"``, ``"spin_up"``, ``"torque"``, ``"study"``, …"""
    return _known(kind, _auxbear.template(kind))


def schema(kind: str) -> str:
    """The JSON Schema of a kind of file, for editors."""
    return _known(kind, _auxbear.schema(kind))


def _known(kind: str, text: str | None) -> str:
    if text is None:
        raise ValueError(f'"{kind}" is no kind of file; auxbear.template("drop") is one')
    return text


def explain(code: str) -> str:
    """The book's page of an error or warning code."""
    return _auxbear.explain(code)
