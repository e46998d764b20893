"""The one exception for wrong input, and for what cannot be written."""

from __future__ import annotations


class Problem(ValueError):
    """One thing that is wrong with an input, worded so that it can be corrected.

    ``code`` is stable, such as ``"AB0103"``; ``auxbear.explain(code)`` tells its page of the book. ``line`` and ``column``
    count from 1 and are None where no line of a file is concerned.
    """

    code: str = ""
    file: str = ""
    line: int | None = None
    column: int | None = None
    key: str | None = None
    found: str = ""
    allowed: str = ""
    hint: str | None = None
