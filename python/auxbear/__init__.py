"""What happens when a magnetically levitated rotor falls onto its auxiliary rolling bearings.

>>> import auxbear
>>> scenario = auxbear.Scenario.load("drop.toml")
>>> result = scenario.set("run.duration", "20 ms").run()
>>> float(result["first_impact_force"]), result["first_impact_force"].unit

Numbers are in SI; a quantity that is given is a text with a unit, such as ``"0.25 mm"``.
"""

from auxbear._auxbear import version as _version
from auxbear._problem import Problem
from auxbear.catalogue import bearing, bearings
from auxbear.recording import Recording
from auxbear.result import Evaluated, ModelWarning, Quantity, Result, RunWarning, Spread, Table
from auxbear.scenario import Scenario, explain, schema, template
from auxbear.study import Study, StudyResult

__version__: str = _version()

__all__ = [
    "Evaluated",
    "ModelWarning",
    "Problem",
    "Quantity",
    "Recording",
    "Result",
    "RunWarning",
    "Scenario",
    "Spread",
    "Study",
    "StudyResult",
    "Table",
    "bearing",
    "bearings",
    "explain",
    "schema",
    "template",
]
