# SPDX-License-Identifier: BSD-3-Clause
"""Which feet bear a robot when: phases of single and double support, and those in which no foot is down."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, read_only, require_shape
from forcetorque.errors import EstimationError
from forcetorque.estimation.balance.contact_state import ContactThresholds, contact_state, stretches, unbroken

NO_FOOT = "no foot"
"""Name of a phase in which no foot is down."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportPhase:
    """A stretch in which the same feet are down."""

    feet: tuple[str, ...]
    """Feet that are down."""
    samples: slice
    """Its samples, those between whose forces are not known included."""
    start_s: float
    """Instant of its first sample; s."""
    end_s: float
    """Instant of its last sample; s."""

    @property
    def name(self) -> str:
        """Feet that are down, in words."""
        return " + ".join(self.feet) or NO_FOOT

    @property
    def duration_s(self) -> float:
        """From its first sample to its last; s."""
        return self.end_s - self.start_s


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SupportPhases:
    """Contacts of all feet at n instants, and the phases that they make."""

    feet: tuple[str, ...]
    """The feet."""
    time_s: FloatArray
    """Instants; shape (n,); s."""
    down: BoolArray
    """Whether each foot is down; shape (n, feet)."""
    known: BoolArray
    """Whether the forces of all feet are known; other samples belong to no phase; shape (n,)."""
    phases: tuple[SupportPhase, ...]
    """Phases in the order of time."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "time_s", read_only(self.time_s, name="time_s", shape=(None,)))
        for name, shape in (("down", (len(self.time_s), len(self.feet))), ("known", (len(self.time_s),))):
            array = np.array(getattr(self, name), dtype=np.bool_)
            require_shape(array, name=name, shape=shape)
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of phases that occur, in the order in which they first do."""
        return tuple(dict.fromkeys(phase.name for phase in self.phases))

    def holds(self, name: str) -> BoolArray:
        """Mark the samples of all phases of a name.

        Args:
            name: Such as `l_sole` or `l_sole + r_sole`.

        Returns:
            Whether a sample lies in one and its forces are known; shape (n,).
        """
        inside = np.zeros(len(self.time_s), dtype=np.bool_)
        for phase in self.phases:
            inside[phase.samples] |= phase.name == name
        return inside & self.known


def support_phases(forces: Mapping[str, Any], time_s: Any, thresholds: ContactThresholds) -> SupportPhases:
    """Find the support phases of a robot from the vertical forces of its feet.

    Args:
        forces: Force of the ground on each foot along the normal of its sole, positive where it presses; NaN where it
            is not known; shape (n,) each; N.
        time_s: Instants that rise; shape (n,); s.
        thresholds: Which forces make a contact.

    Returns:
        The phases. Samples in which the force of a foot is not known belong to none, and no phase reaches over a gap
        of the log.

    Raises:
        EstimationError: If there is no foot, no force is known, or no foot ever is down.
    """
    time = np.asarray(time_s, dtype=np.float64)
    if not forces:
        raise EstimationError("support phases: expected the force of a foot at least, got none")
    feet = tuple(forces)
    columns = [np.asarray(forces[foot], dtype=np.float64) for foot in feet]
    for foot, column in zip(feet, columns, strict=True):
        require_shape(column, name=f"force of {foot!r}", shape=time.shape)
    down = np.stack([contact_state(column, time, thresholds) for column in columns], axis=1)
    known: BoolArray = np.all(np.isfinite(np.stack(columns, axis=1)), axis=1)
    phases = tuple(_phases(feet, time, down, known))
    if not any(phase.feet for phase in phases):
        raise EstimationError(_nothing_down(feet, columns, thresholds))
    return SupportPhases(feet=feet, time_s=time, down=down & known[:, None], known=known, phases=phases)


def _phases(feet: tuple[str, ...], time: FloatArray, down: BoolArray, known: BoolArray) -> Iterator[SupportPhase]:
    states = down @ (1 << np.arange(len(feet)))  # a number for every set of feet
    for rows in unbroken(time, np.flatnonzero(known)):
        for stretch in stretches(states[rows]):
            first, last = int(rows[stretch.start]), int(rows[stretch.stop - 1])
            yield SupportPhase(
                feet=tuple(foot for foot, here in zip(feet, down[first], strict=True) if here),
                samples=slice(first, last + 1),
                start_s=float(time[first]),
                end_s=float(time[last]),
            )


def _nothing_down(feet: tuple[str, ...], columns: list[FloatArray], thresholds: ContactThresholds) -> str:
    most = ", ".join(
        f"{foot} {np.nanmax(column):.3g} N" if np.isfinite(column).any() else f"{foot} no force that is known"
        for foot, column in zip(feet, columns, strict=True)
    )
    return (
        f"no support phase found: expected a foot that bears {thresholds.touch_N:.3g} N at some time, got at most "
        f"{most}; is the sign that of the ground on the foot, or the robot in the air? Lower the thresholds otherwise"
    )
