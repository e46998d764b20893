"""Values of Python as TOML, so that a scenario in Python is read like one in a file."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any


def value(of: Any) -> str:
    """One value as TOML: texts, numbers, switches, lists, tables, and quantities of pint."""
    if hasattr(of, "magnitude") and hasattr(of, "units"):
        return json.dumps(_quantity(of), ensure_ascii=False)
    if hasattr(of, "tolist"):  # NumPy: a scalar, which may pass for a float of Python, or an array
        of = of.tolist()
    if isinstance(of, bool):
        return "true" if of else "false"
    if isinstance(of, str):
        return json.dumps(of, ensure_ascii=False)
    if isinstance(of, (int, float)):
        return repr(of)
    if isinstance(of, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {value(item)}" for key, item in of.items()) + "}"
    if isinstance(of, Sequence):
        return "[" + ", ".join(map(value, of)) + "]"
    if hasattr(of, "__fspath__"):
        return value(of.__fspath__())
    if hasattr(of, "_as_file"):
        return value(of._as_file())
    raise TypeError(f"a text with a unit, number, switch, list or dict is needed, not {type(of).__name__}")


def document(of: Mapping[str, Any]) -> str:
    """A whole file; a key with points in it stands for nested tables, as in ``{"rotor.mass": "8 kg"}``."""
    nested: dict[str, Any] = {}
    for key, item in of.items():
        _put(nested, key, item)
    return "".join(f"{_key(key)} = {value(item)}\n" for key, item in nested.items())


def _put(table: dict[str, Any], key: str, item: Any) -> None:
    first, point, rest = key.partition(".")
    if not point and not isinstance(item, Mapping):
        table[key] = item
        return
    inner = table.setdefault(first, {})
    if not isinstance(inner, dict):
        raise TypeError(f'"{first}" is given as a value and as a table')
    for name, value_of in {rest: item}.items() if point else item.items():
        _put(inner, name, value_of)


def _key(name: str) -> str:
    is_bare = name.isascii() and name.replace("_", "a").replace("-", "a").isalnum()
    return name if is_bare else json.dumps(name, ensure_ascii=False)


def _quantity(of: Any) -> str:
    units = f"{of.units:~}".replace(" ", "").replace("**", "^")
    return f"{float(of.magnitude)!r}".removesuffix(".0") + f" {units}"
