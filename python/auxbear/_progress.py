"""A line of progress where somebody watches: a terminal or a notebook."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable

Progress = Callable[[float], object]


def shown(what: str, wish: bool | Progress | None) -> tuple[Progress | None, Callable[[], None]]:
    """What is told the share done, from 0 to 1, and what ends the line."""
    if callable(wish):
        return wish, lambda: None
    if wish is not None and not isinstance(wish, bool):
        raise TypeError(f"progress: a function, True, False or None is needed, not {wish!r}")
    is_watched = sys.stderr is not None and (sys.stderr.isatty() or "ipykernel" in sys.modules)
    if not (is_watched if wish is None else wish):
        return None, lambda: None
    line = _Line(what)
    return line.show, line.end


class _Line:
    def __init__(self, what: str) -> None:
        self.what = what
        self.begin = self.last = time.monotonic()
        self.width = 0

    def show(self, share: float) -> None:
        now = time.monotonic()
        # what is over at once needs no line
        if now - self.begin < 1.0 or now - self.last < 0.2:
            return
        self.last = now
        left = (now - self.begin) * (1.0 - share) / share if share > 0.0 else 0.0
        text = f"{self.what}: {100.0 * share:.0f} %, {left:.0f} s left"
        print("\r" + text.ljust(self.width), end="", file=sys.stderr, flush=True)
        self.width = len(text)

    def end(self) -> None:
        if self.width:
            print("\r" + " " * self.width + "\r", end="", file=sys.stderr, flush=True)
