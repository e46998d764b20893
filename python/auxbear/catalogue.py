"""Bearings known by name, with the origin of every number."""

from __future__ import annotations

import json
from os import PathLike
from typing import Any

from auxbear import _auxbear


def bearings(
    *,
    bore: str | None = None,
    speed: str | None = None,
    kind: str | None = None,
    material: str | None = None,
    file: str | PathLike[str] | None = None,
) -> list[dict[str, Any]]:
    """The bearings of the catalogue that are wanted; all without a wish.

    - ``bore``: ``"25 mm"``, or a range ``"20 mm..30 mm"``
    - ``speed``: least limiting speed, ``"20000 rpm"``
    - ``kind``: ``"deep groove"``, ``"angular contact"``
    - ``material``: of the balls, ``"steel"``, ``"silicon nitride"``
    - ``file``: bearings of your own beside the built-in ones

    Each is ``{"name": …, "values": {"width": {"value": 0.012, "unit": "m", "mark": "catalogue", "note": …}, …}, …}``, in SI.
    """
    return json.loads(_auxbear.bearings_json(bore, speed, kind, material, file))["bearings"]


def bearing(name: str, *, file: str | PathLike[str] | None = None) -> dict[str, Any]:
    """One bearing by its name or designation, as in ``bearings``; ``left_out`` names parts of the designation without effect."""
    text, left_out = _auxbear.bearing_json(name, file)
    return {**json.loads(text)["bearings"][0], "left_out": left_out}
