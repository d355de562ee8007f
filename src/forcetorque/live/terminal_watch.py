# SPDX-License-Identifier: BSD-3-Clause
"""Lines of a terminal that show a live run, refreshed in place; plain lines where there is no terminal."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TextIO

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.live.loop import LiveLoop, SensorState
from forcetorque.live.sample_status import status_text

_UP, _CLEAR = "\x1b[{}A", "\x1b[2K"


class Watch:
    """Shows the state of a run."""

    def __init__(self, file: TextIO, *, clock: Callable[[], float], period_s: float, in_place: bool) -> None:
        """Begin.

        Args:
            file: Where lines go.
            clock: Gives seconds.
            period_s: Time between two states; s.
            in_place: Whether lines take the place of those before, on a terminal.
        """
        self._file, self._clock, self._period_s, self._in_place = file, clock, period_s, in_place
        self._shown, self._due = 0, clock()

    def show(self, loop: LiveLoop, *, at_once: bool = False) -> None:
        """Show the state, at most once in a period.

        Args:
            loop: The run.
            at_once: Whether to show it before the period is over.
        """
        now = self._clock()
        if now < self._due and not at_once:
            return
        self._due = now + self._period_s
        lines = list(state_lines(loop))
        if self._in_place and self._shown:
            self._file.write(_UP.format(self._shown))
        clear = _CLEAR if self._in_place else ""
        self._file.write("".join(f"{clear}{line}\n" for line in lines))
        self._file.flush()
        self._shown = len(lines)


def state_lines(loop: LiveLoop) -> Iterator[str]:
    """Write the state of a run, two lines per sensor and one for packets.

    Args:
        loop: The run.

    Yields:
        Lines of at most 80 characters for names of up to 20.
    """
    counts = loop.counts()
    lost = str(counts.lost) if counts.countable else "not countable"
    yield f"received {counts.received}, lost {lost}, late {counts.late}, repeated {counts.repeated}"
    for states in loop.states:
        for state in states:
            yield from _sensor_lines(state)


def _sensor_lines(state: SensorState) -> Iterator[str]:
    status = status_text(state.status)
    if state.wrench is None or state.half_width is None:
        yield f"{state.name}: no sample yet, {status}"
        yield ""
        return
    drift = "" if state.drift is None else f", drift since tare {max(abs(state.drift[:3])):.2f} N"
    yield f"{state.name}: {status}{drift}, with faults {state.faulty} of {state.samples}"
    numbers = zip(WRENCH_COMPONENTS, state.wrench, state.half_width, (1, 1, 1, 2, 2, 2), strict=True)
    texts = [
        f"{name} {value:.{digits}f}" + ("" if half != half else f" ±{half:.{digits}f}")
        for name, value, half, digits in numbers
    ]
    yield "  " + "  ".join(texts)
