# SPDX-License-Identifier: BSD-3-Clause
"""What a user asks for: where the offset of the sensors is to come from, and from which interval."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final, Self

from forcetorque.errors import ExperimentError, known_names
from forcetorque.evaluation.offset import Offset

OF_ONE_LINK: Final = (Offset.ONE_LINK_IMU, Offset.ONE_LINK_FIXED_FRAME)
"""Offsets from still seconds in which one link alone is touched."""
OF_INTERVAL: Final = (*OF_ONE_LINK, Offset.TARE)
"""Offsets that come from an interval, which must be named."""


@dataclass(frozen=True, slots=True)
class OffsetPolicy:
    """Where the offset of the sensors is to come from."""

    offset: Offset
    """The way."""
    interval: str | None = None
    """Label of the interval that gives it, for the ways that take one."""

    def __post_init__(self) -> None:
        needed = self.offset in OF_INTERVAL
        if needed is (self.interval is None):
            expected = f"{self.offset}:LABEL, of the interval that gives it" if needed else f"{self.offset} alone"
            raise ExperimentError(f"offset: expected {expected}, got {self}")

    @classmethod
    def of(cls, words: str) -> Self:
        """Understand a policy as the command line has it, such as `none` or `one-link-imu:hanging`.

        Args:
            words: The way, and for some ways a colon and the label of an interval.

        Returns:
            The policy.

        Raises:
            ExperimentError: If there is no such way, or an interval is missing or too much.
        """
        name, _, label = words.partition(":")
        if name not in tuple(Offset):
            raise ExperimentError(f"offset: no way is called {name!r}; {known_names(name, Offset)}")
        return cls(Offset(name), label or None)

    def __str__(self) -> str:
        return self.offset.value if self.interval is None else f"{self.offset}:{self.interval}"
