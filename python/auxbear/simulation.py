"""A machine that is driven from outside, step by step."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from auxbear import _auxbear


class Simulation(Mapping[str, float]):
    """A drop, a spin-up or a test on a rig at an instant: ``Scenario.simulation()``.

    It goes on from stop to stop, and inputs change between them:

    >>> simulation = scenario.simulation()
    >>> while simulation.advance(simulation.time + 1e-3):
    ...     simulation.brake(simulation["rotor.y"] < -0.2e-3)

    A mapping of the channels of its state, in SI: motions, then what the energy ledger has summed up. Without inputs it takes the
    steps of ``Scenario.run`` where these are explicit. Temperatures do not act on its motion.
    """

    __slots__ = ("_native", "_stop")

    def __init__(self, native: _auxbear.Simulation) -> None:
        self._native = native
        self._stop: tuple[str, float, str] | None = None

    @property
    def time(self) -> float:
        """The time that is reached, s."""
        return self._native.time()

    @property
    def stop(self) -> tuple[str, float, str] | None:
        """Reason, time and words of its end; none while it goes on."""
        return self._stop

    def advance(self, until: float) -> bool:
        """Goes on to a time, s, which ends a step; False once it is over, at ``run.duration`` or before: see ``stop``."""
        self._stop = self._native.advance(until)
        return self._stop is None

    def brake(self, on: bool) -> None:
        """Puts the brake of the rotor on or takes it off, where ``rotor.brake_torque`` is given."""
        self._native.change("brake", float(on))

    def load(self, force: float) -> None:
        """Sets the radial load on a bearing on a rig, N, 0 or more; until the next row of its table."""
        self._native.change("load", force)

    def torque(self, moment: float) -> None:
        """Sets the torque on the inner race, N m, where ``drive.kind`` is a torque; until the next row of its table."""
        self._native.change("torque", moment)

    def __getitem__(self, name: str) -> float:
        value = self._native.value(name)
        if value is None:
            raise KeyError(name)
        return value

    def __iter__(self) -> Iterator[str]:
        return iter(self._native.names())

    def __len__(self) -> int:
        return len(self._native.names())

    def __repr__(self) -> str:
        return f"<Simulation at {self.time:.6g} s>"
