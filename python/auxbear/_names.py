"""Names of results and columns as attributes, so that editors and notebooks complete them."""

from __future__ import annotations

from typing import Any, Protocol


class _Named(Protocol):
    def keys(self) -> Any: ...
    def __getitem__(self, name: str) -> Any: ...


class Completing:
    """Values by name that are attributes too: ``result.first_impact_force``, ``result.drive_end.peak_contact_force``.

    A name that the class has itself, such as ``stop``, is that of the class: ``result["stop"]`` is always the value.
    """

    __slots__ = ()

    def __getattr__(self: _Named, name: str) -> Any:
        return _attribute(self, "", name)

    def __dir__(self: _Named) -> list[str]:
        return [*object.__dir__(self), *_beginnings(self, "")]

    def _ipython_key_completions_(self: _Named) -> list[str]:
        return list(self.keys())


class Part:
    """Values whose names begin with that of a part."""

    __slots__ = ("_of", "_begin")

    def __init__(self, of: _Named, begin: str) -> None:
        self._of = of
        self._begin = begin

    def __getattr__(self, name: str) -> Any:
        return _attribute(self._of, self._begin, name)

    def __dir__(self) -> list[str]:
        return _beginnings(self._of, self._begin)

    def __repr__(self) -> str:
        return f"<{self._begin[:-1]}: {', '.join(dir(self))}>"


def _attribute(of: _Named, begin: str, name: str) -> Any:
    # what is asked of every object, also before it has its values
    if name.startswith("_"):
        raise AttributeError(name)
    whole = f"{begin}{name}"
    if whole in (names := list(of.keys())):
        return of[whole]
    if any(known.startswith(f"{whole}.") for known in names):
        return Part(of, f"{whole}.")
    raise AttributeError(f"no {whole!r}")


def _beginnings(of: _Named, begin: str) -> list[str]:
    """What may follow, up to the next point."""
    rests = (name[len(begin) :] for name in of.keys() if name.startswith(begin))
    return sorted({rest.partition(".")[0] for rest in rests})
