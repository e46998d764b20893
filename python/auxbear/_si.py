"""Numbers in SI from what people compute with: plain numbers, arrays, texts with a unit, quantities of pint or astropy."""

from __future__ import annotations

from typing import Any

from auxbear import _auxbear


def number(value: Any, unit: str) -> Any:
    """The value in this unit of SI, a number or an array; a plain one is taken to be in it. Another dimension raises."""
    if isinstance(value, str):
        return _auxbear.number_in(value, unit)
    name = unit if unit not in ("", "1") else "dimensionless"
    if hasattr(value, "magnitude") and hasattr(value, "units"):  # pint
        return value.to(name).magnitude
    if hasattr(value, "to_value"):  # astropy
        return value.to_value(unit if name == unit else "")
    return value
