"""What happens when a magnetically levitated rotor falls onto its auxiliary rolling bearings.

>>> import auxbear
>>> scenario = auxbear.Scenario.load("drop.toml")
>>> result = scenario.set("run.duration", "20 ms").run()
>>> float(result["first_impact_force"]), result["first_impact_force"].unit

Numbers are in SI; a quantity that is given is a text with a unit, such as ``"0.25 mm"``.
"""

from importlib import import_module as _import_module
from typing import TYPE_CHECKING as _TYPE_CHECKING

from auxbear._auxbear import version as _version
from auxbear._problem import Problem
from auxbear.catalogue import bearing, bearings
from auxbear.recording import Recording
from auxbear.result import Declared, Evaluated, ModelWarning, Quantity, Result, RunWarning, Spread, Table
from auxbear.scenario import Scenario, explain, schema, template
from auxbear.simulation import Simulation
from auxbear.study import Study, StudyResult

if _TYPE_CHECKING:
    from auxbear import distributed, figures, laws, optimise

__version__: str = _version()

#: Pages that are imported when they are named: they need more than this one.
_PAGES = ("distributed", "figures", "laws", "optimise")

__all__ = [
    "Declared",
    "Evaluated",
    "ModelWarning",
    "Problem",
    "Quantity",
    "Recording",
    "Result",
    "RunWarning",
    "Scenario",
    "Simulation",
    "Spread",
    "Study",
    "StudyResult",
    "Table",
    "bearing",
    "bearings",
    "distributed",
    "explain",
    "figures",
    "laws",
    "optimise",
    "schema",
    "template",
]


def __getattr__(name: str) -> object:
    if name in _PAGES:
        return _import_module(f"auxbear.{name}")
    raise AttributeError(f"module 'auxbear' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_PAGES})
