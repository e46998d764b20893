"""What comes out of a run."""

from __future__ import annotations

import difflib
import html
import json
import operator
from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any, NamedTuple

from auxbear import _auxbear, _si
from auxbear._names import Completing

if TYPE_CHECKING:
    import numpy
    import numpy.typing
    import pandas
    import plotly.graph_objects


class ModelWarning(UserWarning):
    """Something the user should know before trusting the numbers of a run."""


class RunWarning(NamedTuple):
    """A warning with its stable code; severity is destroys, invalid, uncertain or note; values have their SI units behind them."""

    code: str
    text: str
    severity: str
    part: str
    time: float | None
    values: dict[str, tuple[float | str, str]]


class Declared(NamedTuple):
    """A result or column before a run."""

    name: str
    unit: str
    meaning: str


class Spread(NamedTuple):
    """Mean and spread over the members of a repeated run in which the quantity exists; quantiles at 5, 50 and 95 %."""

    mean: float
    standard_deviation: float
    smallest: float
    largest: float
    quantiles: list[float]
    members: int


def _operator(function: Callable[..., Any], *, of_one_unit: bool, is_swapped: bool = False) -> Any:
    """An operation of a quantity with another, a number in its unit, or where units have to agree a text with a unit."""

    def operation(self: Quantity, other: Any) -> Any:
        if isinstance(other, Quantity):
            if of_one_unit and other.unit != self.unit:
                raise TypeError(f"{self.name} is in {self.unit or '1'}, {other.name} in {other.unit or '1'}")
            other = other._plain()
        elif of_one_unit:
            other = _si.number(other, self.unit)
        return function(other, self._plain()) if is_swapped else function(self._plain(), other)

    return operation


class Quantity:
    """A named result, which computes, compares and formats as its number: ``float(quantity)``, ``quantity > "700 N"``,
    ``f"{quantity:.1f}"``, ``quantity.unit``, ``quantity.law``. Lists compute as arrays.
    """

    __slots__ = ("name", "value", "unit", "why", "law", "source", "valid", "chaotic", "spread")

    name: str
    #: Number, list of numbers or text; None where it does not exist in this run
    value: float | list[float] | str | None
    #: SI unit; empty for texts and counts
    unit: str
    #: Why there is no value
    why: str | None
    law: str
    source: str
    valid: str
    #: True where members of a repeated run show that tiny changes of the start change it much
    chaotic: bool
    #: None of a single run
    spread: Spread | None

    def __init__(self, name: str, told: tuple[Any, ...]) -> None:
        self.name = name
        self.value, self.unit, self.why, self.law, self.source, self.valid, self.chaotic, spread = told
        self.spread = None if spread is None else Spread(*spread)

    def __float__(self) -> float:
        if self.value is None:
            raise ValueError(f"{self.name} has no value: {self.why}")
        if isinstance(self.value, float):
            return self.value
        raise TypeError(f"{self.name} is no number: {self.value!r}")

    def _plain(self) -> Any:
        """The number, or the array of a list."""
        return self.__array__() if isinstance(self.value, list) else float(self)

    __add__ = __radd__ = _operator(operator.add, of_one_unit=True)
    __sub__ = _operator(operator.sub, of_one_unit=True)
    __rsub__ = _operator(operator.sub, of_one_unit=True, is_swapped=True)
    __mul__ = __rmul__ = _operator(operator.mul, of_one_unit=False)
    __truediv__ = _operator(operator.truediv, of_one_unit=False)
    __rtruediv__ = _operator(operator.truediv, of_one_unit=False, is_swapped=True)
    __pow__ = _operator(operator.pow, of_one_unit=False)
    __lt__ = _operator(operator.lt, of_one_unit=True)
    __le__ = _operator(operator.le, of_one_unit=True)
    __gt__ = _operator(operator.gt, of_one_unit=True)
    __ge__ = _operator(operator.ge, of_one_unit=True)

    def __eq__(self, other: object) -> Any:
        if isinstance(other, Quantity) and other.unit != self.unit:
            return False
        if self.value is None or isinstance(self.value, str) or other is None:
            return self.value == (other.value if isinstance(other, Quantity) else other)
        try:
            return _operator(operator.eq, of_one_unit=True)(self, other)
        except (TypeError, ValueError):
            return NotImplemented

    def __hash__(self) -> int:
        return hash(self.value)

    def __neg__(self) -> Any:
        return -self._plain()

    def __abs__(self) -> Any:
        return abs(self._plain())

    def __round__(self, digits: int | None = None) -> Any:
        return round(float(self), digits)

    def __format__(self, spec: str) -> str:
        return format(float(self), spec) if spec else str(self)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> numpy.ndarray[Any, Any]:
        import numpy

        if self.value is None or isinstance(self.value, str):
            float(self)
        return numpy.array(self.value, dtype=dtype or float)

    def __str__(self) -> str:
        if self.value is None:
            return f"none: {self.why}"
        return f"{self.value} {self.unit}".rstrip()

    def __repr__(self) -> str:
        return f"<{self.name} = {self}>"


class Table(Completing):
    """Columns of equal length, each with name, unit and meaning.

    Readers of Arrow take it without a copy: ``polars.DataFrame(table)``, ``pyarrow.table(table)``,
    ``pandas.DataFrame.from_arrow(table)``, and DuckDB by its name in a query. Unit and meaning stand in the metadata of the
    fields, as in the Parquet file. ``table["time"]`` is a NumPy array of shape (rows,), and ``pandas.DataFrame(dict(table))`` has
    the columns of ``to_pandas()``.
    """

    __slots__ = ("_native",)

    def __init__(self, native: _auxbear.Table) -> None:
        self._native = native

    @property
    def columns(self) -> list[str]:
        """Names of the columns."""
        return self._native.names()

    @property
    def units(self) -> dict[str, str]:
        """SI unit of each column."""
        return dict(self._native.units())

    @property
    def meanings(self) -> dict[str, str]:
        """What each column is, in words."""
        return dict(self._native.meanings())

    def __getitem__(self, name: str) -> numpy.typing.NDArray[numpy.float64]:
        try:
            return self._native.column(name)
        except KeyError:
            raise unknown("column", name, self.columns) from None

    def __contains__(self, name: object) -> bool:
        return name in self._native.names()

    def __iter__(self) -> Iterator[str]:
        return iter(self._native.names())

    def __len__(self) -> int:
        """Number of rows."""
        return self._native.rows()

    def keys(self) -> list[str]:
        """Names of the columns, so that ``dict(table)`` has their arrays."""
        return self._native.names()

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> numpy.ndarray[Any, Any]:
        # numpy and pandas.DataFrame would take the names for the values
        raise TypeError(
            "a table has named columns: table.to_pandas(), pandas.DataFrame.from_arrow(table), or table[name] as an array"
        )

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        return self._native.__arrow_c_stream__(requested_schema)

    def __arrow_c_schema__(self) -> object:
        return self._native.__arrow_c_schema__()

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame; units stand in ``frame.attrs["units"]``."""
        import pandas

        frame = pandas.DataFrame({name: self[name] for name in self.columns})
        frame.attrs["units"] = self.units
        return frame

    def __repr__(self) -> str:
        return f"<auxbear.Table {len(self)} rows, {len(self.columns)} columns>"


class Evaluated(NamedTuple):
    """What a list of changes gave."""

    #: Results, a row each
    table: Table
    #: Reasons of the rows that failed, by their places; their results are empty
    failed: dict[int, str]


class Result(Completing, Mapping[str, Quantity]):
    """Everything known after a run: named results as in a dict, and what stands in its run directory."""

    def __init__(self, native: _auxbear.Outcome) -> None:
        self._native = native

    def __getitem__(self, name: str) -> Quantity:
        told = self._native.quantity(name)
        if told is None:
            raise unknown("result", name, self._native.names())
        return Quantity(name, told)

    def __iter__(self) -> Iterator[str]:
        return iter(self._native.names())

    def __len__(self) -> int:
        return len(self._native.names())

    @property
    def system(self) -> str:
        """Name of the system."""
        return self._native.system()

    @property
    def complete(self) -> bool:
        """True where the whole run was computed; else ``stop`` says how it ended."""
        return self._native.complete()

    @property
    def stop(self) -> str:
        """How the run ended, in a sentence."""
        return self._native.stop()[2]

    @cached_property
    def warnings(self) -> list[RunWarning]:
        """What the user should know before trusting the numbers; what destroys stands first."""
        return [RunWarning(*warning) for warning in self._native.warnings()]

    @cached_property
    def history(self) -> Table:
        """Time histories: a column a channel, ``time`` first."""
        return Table(self._native.history())

    @cached_property
    def members(self) -> Table | None:
        """Results of each member of a repeated run, a row a member; member 0 is the unperturbed run."""
        native = self._native.members()
        return None if native is None else Table(native)

    @cached_property
    def summary(self) -> dict[str, Any]:
        """What ``summary.json`` of the run directory holds: quantities, limits, contacts, inputs, work."""
        return json.loads(self._native.summary())

    @property
    def limits(self) -> list[dict[str, Any]]:
        """Limits of the scenario with their verdicts."""
        return self.summary.get("limits", [])

    def to_pandas(self) -> pandas.DataFrame:
        """The history as a data frame."""
        return self.history.to_pandas()

    def figure(self, picture: str, bearing: str | None = None) -> plotly.graph_objects.Figure:
        """A standard picture as a Plotly figure: ``orbit``, ``force``, ``speed``, ``load``, ``moment``, ``clearance``,
        ``temperature`` or ``heat``; ``bearing`` names one of several auxiliary bearings. Needs Plotly.
        """
        from auxbear.figures import figure

        return figure(self, picture, bearing)

    def write(self, directory: str | PathLike[str]) -> None:
        """Writes the run directory, as ``auxbear run --out`` does. What exists is never overwritten."""
        self._native.write(directory)

    def report(self, path: str | PathLike[str]) -> None:
        """Writes the report alone, one HTML file without a network. A file of this name is replaced."""
        name = fspath(path)
        with open(name, "w", encoding="utf-8") as file:
            file.write(self._native.html(self._native.title()))

    def __repr__(self) -> str:
        word = "complete" if self.complete else self._native.stop()[0]
        return f"<auxbear.Result {self.system}, {word}: {len(self)} results, {len(self.warnings)} warnings>"

    def _repr_html_(self) -> str:
        warnings = "".join(
            f"<p><b>{warning.code}</b> {html.escape(warning.text)}</p>" for warning in self.warnings
        )
        end = "" if self.complete else f"<p><b>not complete</b> {html.escape(self.stop)}</p>"
        rows = "".join(_row(quantity) for quantity in self.values())
        title = html.escape(self._native.title())
        return f"<h4>{title}</h4>{end}{warnings}<table>{rows}</table>"


def _row(of: Quantity) -> str:
    value = of.value
    if isinstance(value, float):
        shown = f"{value:.6g}"
    elif isinstance(value, list):
        shown = ", ".join(f"{number:.4g}" for number in value[:4]) + (", …" if len(value) > 4 else "")
    else:
        shown = html.escape(value or "none")
    tip = html.escape(of.why or of.law, quote=True)
    return f'<tr title="{tip}"><td>{html.escape(of.name)}</td><td>{shown}</td><td>{html.escape(of.unit)}</td></tr>'


def unknown(what: str, name: object, known: list[str]) -> KeyError:
    """The exception for a name that is not there, with the names near it."""
    near = difflib.get_close_matches(str(name), known, 2)
    hint = f"; did you mean {' or '.join(near)}?" if near else ""
    return KeyError(f"no {what} {name!r}{hint}")
