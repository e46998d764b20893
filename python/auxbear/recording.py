"""Measured channels that are in memory already."""

from __future__ import annotations

import itertools
import shutil
import tempfile
import weakref
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from auxbear import _auxbear, _si

if TYPE_CHECKING:
    import numpy.typing

_numbers = itertools.count(1)

#: Share of an interval by which instants may miss an even clock.
_UNEVEN = 1e-3


class Recording:
    """Channels of a test, which ``signals`` and ``identify`` take where they name a measurement file.

    >>> recording = Recording({"tacho": volts, "torque": moments}, interval="10 us", units={"torque": "N m"})
    >>> result = Scenario(system="signals", signals={"file": recording, "speed": {"channel": "tacho", …}}).run()
    >>> test = Scenario(system="signals", signals={"file": recording, …})
    >>> Scenario(system="identify", identify={"tests": [test], …}, bearing={"name": "6005"})

    - ``channels``: arrays of shape (values,) by the names of their channels
    - ``interval``: time between values, in s or as a text with its unit; or ``time``: their instants, s, evenly spaced
    - ``units``: unit of each channel that has one, as a text

    The values go through a file in a folder of its own, to the bit, and are read as those of any file are; the folder is removed
    with this object and the scenarios that use it.
    """

    def __init__(
        self,
        channels: Mapping[str, numpy.typing.ArrayLike],
        *,
        interval: float | str | None = None,
        time: numpy.typing.ArrayLike | None = None,
        units: Mapping[str, str] | None = None,
    ) -> None:
        import numpy

        if (interval is None) == (time is None):
            raise TypeError("either interval or time is needed")
        first, step = 0.0, _si.number(interval, "s")
        if time is not None:
            first, step = _clock(numpy.asarray(time, dtype=float))
        units = units or {}
        unknown = set(units) - set(channels)
        if unknown:
            raise KeyError(f"units of channels that are not there: {', '.join(sorted(unknown))}")
        given = []
        for name, values in channels.items():
            array = numpy.ascontiguousarray(values, dtype=float)
            if array.ndim != 1:
                raise ValueError(f'channel "{name}": an array of shape (values,) is needed, not {array.shape}')
            given.append((name, units.get(name, ""), array))
        if not given:
            raise ValueError("a channel at least is needed")
        folder = tempfile.mkdtemp(prefix="auxbear-")
        self._remove = weakref.finalize(self, shutil.rmtree, folder, ignore_errors=True)
        self._path = Path(folder) / f"recording {next(_numbers)}.tdms"
        self.channels = [name for name, _, _ in given]
        _auxbear.write_recording(self._path, given, step, first)

    def __fspath__(self) -> str:
        return str(self._path)

    def __repr__(self) -> str:
        return f"<auxbear.Recording {', '.join(self.channels)}>"


def _clock(times: Any) -> tuple[float, float]:
    import numpy

    if times.ndim != 1 or len(times) < 2:
        raise ValueError(f"time: instants of shape (values,) are needed, two at least, not {times.shape}")
    interval = (times[-1] - times[0]) / (len(times) - 1)
    missed = numpy.abs(times - times[0] - interval * numpy.arange(len(times))).max()
    if not interval > 0.0 or not missed <= _UNEVEN * interval:
        raise ValueError("time: evenly spaced, rising instants are needed; write others to a file with a channel of times")
    return float(times[0]), float(interval)
