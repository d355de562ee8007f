# SPDX-License-Identifier: BSD-3-Clause
"""Phases of single and double support, by thresholds of the force on each sole with hysteresis."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final, Self

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, IntArray, array, names, require_shape
from forcetorque.base.errors import EstimationError, ShapeError
from forcetorque.recording.alignment import GAP_PERIODS

TOUCH_SHARE: Final = 0.15
"""Share of the body weight that a foot bears at some time while it is down."""
RELEASE_SHARE: Final = 0.06
"""Share of the body weight that it bears all the time while it is down."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ContactThresholds:
    """Which forces make a contact.

    A foot is down over a segment in which it always bears more than `release_N` and at some time
    `contact_threshold_N`: the first says when a contact begins and ends, the second that it is one. A recording that is
    played backwards has the same contacts, which a rule that looks at the past alone does not give.
    """

    contact_threshold_N: float
    """Force that a contact reaches; N."""
    release_N: float
    """Force above which it lasts; N."""
    dwell_s: float = 0.0
    """Shortest pause between contacts, and shortest contact, that count; s."""

    def __post_init__(self) -> None:
        if not (np.isfinite(self.contact_threshold_N) and 0.0 < self.release_N <= self.contact_threshold_N):
            raise EstimationError(
                f"thresholds: expected 0 < release <= touch, got touch {self.contact_threshold_N:g} N and release "
                f"{self.release_N:g} N; where they cross no force determines whether a foot is down"
            )
        if not 0.0 <= self.dwell_s < np.inf:
            raise EstimationError(f"thresholds: expected a dwell time of at least 0 s, got {self.dwell_s:g} s")


def contact_state(force_N: Any, time_s: Any, thresholds: ContactThresholds) -> BoolArray:
    """Find the samples in which a foot is down.

    Pauses shorter than the dwell time are filled first, then contacts that are shorter still are dropped; segments at
    an end of the log, or at a gap of it, are kept, because their length is unknown.

    Args:
        force_N: Force of the ground on the sole along its normal; positive where it presses; NaN where it is not known;
            shape (n,); N.
        time_s: Instants that rise; shape (n,); s. No contact reaches over a gap of more than `GAP_PERIODS` periods.
        thresholds: Which forces make a contact.

    Returns:
        Whether the foot is down; shape (n,); False where the force is not known.

    Raises:
        ShapeError: If the shapes differ, or time does not rise.
    """
    force, time = np.asarray(force_N, dtype=np.float64), np.asarray(time_s, dtype=np.float64)
    require_shape(force, name="force_N", shape=(None,))
    require_shape(time, name="time_s", shape=force.shape)
    down = np.zeros(len(force), dtype=np.bool_)
    known = np.flatnonzero(np.isfinite(force))
    for rows in unbroken(time, known):
        down[rows] = _in_segment(force[rows], time[rows], thresholds)
    return down


def unbroken(time_s: FloatArray, rows: IntArray) -> Iterator[IntArray]:
    """Part samples where the log has gaps.

    Args:
        time_s: Instants of all samples, which rise; shape (n,); s.
        rows: Samples that are known, in order; shape (m,).

    Yields:
        Rows of every segment without a gap of more than `GAP_PERIODS` median periods.

    Raises:
        ShapeError: If time does not rise.
    """
    steps = np.diff(time_s)
    if not (np.isfinite(time_s).all() and (steps > 0.0).all()):
        raise ShapeError("time_s: expected finite instants that rise; sort the samples and leave out repeated stamps")
    if not len(rows):
        return
    limit = GAP_PERIODS * float(np.median(steps)) if len(steps) else 0.0
    yield from np.split(rows, np.flatnonzero(np.diff(time_s[rows]) > limit) + 1)


def stretches(values: FloatArray | IntArray | BoolArray) -> list[slice]:
    """Part a sequence where its value changes.

    Args:
        values: The sequence; shape (n,).

    Returns:
        Ranges of equal values, in order.
    """
    if not len(values):
        return []
    edges = [0, *(np.flatnonzero(values[1:] != values[:-1]) + 1).tolist(), len(values)]
    return [slice(start, stop) for start, stop in zip(edges[:-1], edges[1:], strict=True)]


def _in_segment(force: FloatArray, time: FloatArray, thresholds: ContactThresholds) -> BoolArray:
    down: BoolArray = force > thresholds.release_N
    for stretch in stretches(down):
        down[stretch] &= force[stretch].max() >= thresholds.contact_threshold_N
    for state in (False, True):
        for stretch in stretches(down)[1:-1]:
            lasted = time[stretch.stop] - time[stretch.start]
            if down[stretch.start] == state and lasted < thresholds.dwell_s:
                down[stretch] = not state
    return down


NO_FOOT = "no foot"
"""Name of a phase in which no foot is down."""


@dataclass(frozen=True, slots=True, kw_only=True)
class SupportPhase:
    """A segment in which the same feet are down."""

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
        """Feet that are down, as text."""
        return " + ".join(self.feet) or NO_FOOT

    @property
    def duration_s(self) -> float:
        """From its first sample to its last; s."""
        return self.end_s - self.start_s


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SupportPhases(ArrayRecord):
    """Contacts of all feet at n instants, and the phases that they make."""

    feet: tuple[str, ...] = field(metadata=names("feet"))
    """The feet."""
    time_s: FloatArray = field(metadata=array("n"))
    """Instants; shape (n,); s."""
    down: BoolArray = field(metadata=array("n", "feet", dtype="bool"))
    """Whether each foot is down; shape (n, feet)."""
    known: BoolArray = field(metadata=array("n", dtype="bool"))
    """Whether the forces of all feet are known; other samples belong to no phase; shape (n,)."""
    phases: tuple[SupportPhase, ...]
    """Phases in the order of time."""

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
        EstimationError: If there is no foot.
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
    return phases_of_contacts(feet, time, down, known)


def phases_of_contacts(
    feet: Sequence[str], time_s: FloatArray, down: BoolArray, known: BoolArray | None = None
) -> SupportPhases:
    """Give the support phases of contacts that are known.

    Args:
        feet: The feet.
        time_s: Instants that rise; shape (n,); s.
        down: Whether each foot is down; shape (n, feet).
        known: Whether that is known; shape (n,); everywhere if None.

    Returns:
        The phases.
    """
    told = np.ones(len(time_s), dtype=np.bool_) if known is None else known
    phases = tuple(_phases(tuple(feet), time_s, down, told))
    return SupportPhases(feet=tuple(feet), time_s=time_s, down=down & told[:, None], known=told, phases=phases)


def require_support(
    phases: Sequence[SupportPhases], forces: Sequence[Mapping[str, FloatArray]], thresholds: ContactThresholds
) -> None:
    """Refuse recordings in which no foot is ever down; in one of several the robot may hang.

    Args:
        phases: The phases of each.
        forces: The forces that they are of, as `support_phases` takes them.
        thresholds: Which forces make a contact.

    Raises:
        EstimationError: If no foot is down in any.
    """
    if any(phase.feet for one in phases for phase in one.phases):
        return
    largest: dict[str, float] = {}
    for foot, force in ((foot, force) for by_foot in forces for foot, force in by_foot.items()):
        largest[foot] = float(np.nanmax(np.append(force, largest.get(foot, -np.inf))))
    most = ", ".join(
        f"{foot} {force:.3g} N" if np.isfinite(force) else f"{foot} no force that is known"
        for foot, force in largest.items()
    )
    raise EstimationError(
        f"no support phase found: expected a foot that bears {thresholds.contact_threshold_N:.3g} N at some time, "
        f"got at most {most}; is the sign that of the ground on the foot, or the robot in the air? Lower the "
        "thresholds otherwise"
    )


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


_FORM = re.compile(r"\s*([0-9.eE+-]+)\s*(N|%)\s*")
_PERCENT = 100.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceLimit:
    """A force, or a share of the body weight; exactly one of both."""

    force_N: float | None = None
    """The force; N."""
    share: float | None = None
    """The share of the body weight."""

    def __post_init__(self) -> None:
        stated = [value for value in (self.force_N, self.share) if value is not None]
        if len(stated) != 1 or not 0.0 < stated[0] < float("inf"):
            raise EstimationError(
                f"force: expected a positive force in N or a positive share of the body weight, got {self.force_N} N "
                f"and {self.share}"
            )

    @classmethod
    def of(cls, text: str) -> Self:
        """Understand `50N` or `15%`.

        Args:
            text: A number with its unit.

        Returns:
            The force.

        Raises:
            EstimationError: If it is not of that form.
        """
        match = _FORM.fullmatch(text)
        try:
            number = float(match[1]) if match else None
        except ValueError:
            number = None
        if match is None or number is None:
            raise EstimationError(
                f"force: expected newtons such as 50N, or a share of body weight as 15%, got {text!r}"
            )
        return cls(force_N=number) if match[2] == "N" else cls(share=number / _PERCENT)

    def newtons(self, weight_N: float | None) -> float:
        """Give the force.

        Args:
            weight_N: Weight of the robot; None where it is unknown; N.

        Returns:
            The force; N.

        Raises:
            EstimationError: If it is a share of an unknown weight.
        """
        if self.force_N is not None:
            return self.force_N
        if weight_N is None:
            raise EstimationError(
                f"force: expected newtons, got {self} of an unknown body weight; name the robot in [robot], "
                "or state thresholds such as 50N"
            )
        return (self.share or 0.0) * weight_N

    def __str__(self) -> str:
        return f"{self.force_N:g}N" if self.share is None else f"{_PERCENT * self.share:g}%"
