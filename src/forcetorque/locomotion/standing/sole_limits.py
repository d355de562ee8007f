# SPDX-License-Identifier: BSD-3-Clause
"""What the ground cannot do to a flat sole: press outside its outline, pull, or hold it beyond friction.

Friction of a sole that is pressed flat is bounded by an ellipsoid of the force along the ground and the torsion about
its normal through the centre of pressure [1]:

    used = sqrt((force along / friction)^2 + (torsion / torsional friction)^2) / normal force

Where `torsional_friction_m` is not stated the torsion is left out.

References:
    [1] Howe, Cutkosky, Practical force-motion models for sliding manipulation, 1996; MuJoCo bounds contacts in the same
    way.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Final, Literal, NamedTuple

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.units import NORMAL_95
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import Sole
from forcetorque.locomotion.standing.interval_balance import FootPressure, IntervalBalance
from forcetorque.locomotion.standing.support_phases import stretches
from forcetorque.results.table import Row, Shown

SHORTEST_S: Final = 0.05
"""Time that an event lasts at least; noise of one sample is none; s."""
PAUSE_S: Final = 0.2
"""Pause after which another event begins; s."""
_MM: Final = 1e3
_TINY: Final = 1e-12

EventKind = Literal["outside", "pulls", "slip_risk", "slip"]


class SoleEventRow(Row):
    """A time in which the force on a sole reaches what the ground can do; half-widths are of 95 % intervals."""

    recording: str
    """Name of the experiment."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    sole: Annotated[str, Shown("sole")]
    """Its frame."""
    sensors: Annotated[tuple[str, ...], Shown("by")]
    """Sensors that bound the foot, which measured it."""
    kind: Annotated[EventKind, Shown("event")]
    """The whole interval of the centre of pressure outside the outline; of the normal force below zero, by more than a
    contact has; of the friction used beyond 100 % (`slip`), or its upper end (`slip_risk`). Without the covariance of
    the wrench the number alone is compared."""
    start_s: Annotated[float, Shown("from", "s", digits=2)]
    """Begin, from the start of the recording."""
    end_s: Annotated[float, Shown("to", "s", digits=2)]
    """End."""
    beyond_mm: Annotated[float | None, Shown("outside by", "mm", digits=1, error="beyond_half_width_95_mm")] = None
    """Largest distance of the point from the outline; of `outside`."""
    beyond_half_width_95_mm: float | None = None
    """Its half-width; None where the covariance of the wrench is not known."""
    used_percent: Annotated[float | None, Shown("friction used", "%", digits=0, error="used_half_width_95_percent")] = (
        None
    )
    """Largest friction used, of what is stated; of slips."""
    used_half_width_95_percent: float | None = None
    """Its half-width; None where the covariance of the wrench is not known."""
    normal_N: Annotated[float, Shown("normal force", "N", digits=1)]
    """Force along the normal of the sole then; negative where it pulls."""


class Bounded(NamedTuple):
    """A number of every sample, with its uncertainty."""

    value: FloatArray
    """Shape (n,)."""
    half_width_95: FloatArray | None
    """Half of its 95 % interval; shape (n,); None where the covariance of the wrench is not known."""

    @property
    def lower(self) -> FloatArray:
        """Lower end of the interval, the number itself without one; shape (n,)."""
        return self.value if self.half_width_95 is None else self.value - self.half_width_95

    @property
    def upper(self) -> FloatArray:
        """Upper end of the interval, the number itself without one; shape (n,)."""
        return self.value if self.half_width_95 is None else self.value + self.half_width_95


def friction_used(sole: Sole, wrench: FloatArray, covariance: FloatArray | None) -> Bounded:
    """Give the share of its friction that a sole uses, to first order of the errors of the wrench.

    Args:
        sole: A sole with a friction.
        wrench: What the ground does to it, in and about its frame, pressing; shape (n, 6); N, N m.
        covariance: Covariance of the wrench; shape (n, 6, 6); None where it is not known.

    Returns:
        The share; 1 where it slips if the friction is as stated.
    """
    weights = np.zeros(2)  # of force and torsion, squared
    if sole.friction is not None:
        weights[0] = sole.friction**-2.0
    if sole.torsional_friction_m is not None:
        weights[1] = sole.torsional_friction_m**-2.0
    force, normal, moment = wrench[:, :2], wrench[:, 2], wrench[:, 3:]
    # about the centre of pressure no moment is left along the ground: torsion = force . moment / normal
    torsion = np.einsum("ni,ni->n", wrench[:, :3], moment) / normal
    squared = weights[0] * np.einsum("ni,ni->n", force, force) + weights[1] * torsion**2
    used = np.sqrt(squared) / normal
    if covariance is None:
        return Bounded(used, None)
    of_torsion = np.column_stack([moment[:, :2], moment[:, 2] - torsion, wrench[:, :3]]) / normal[:, None]
    derivative = weights[1] * torsion[:, None] * of_torsion
    derivative[:, :2] += weights[0] * force
    derivative[:, 2] -= squared / normal
    derivative /= (np.maximum(used, _TINY) * normal**2)[:, None]
    return Bounded(used, NORMAL_95 * np.sqrt(np.einsum("ni,nij,nj->n", derivative, covariance, derivative)))


def outside(foot: FootPressure) -> Bounded:
    """Give how far the centre of pressure of a foot lies outside its outline.

    Args:
        foot: A foot whose sole has an outline.

    Returns:
        The distance, negative inside, NaN without a point; m.
    """
    points, edges = foot.pressure.points, foot.sole.edges
    distances = points @ edges[:, :2].T + edges[:, 2]
    nearest = edges[distances.argmax(axis=1), :2]
    covariance = foot.pressure.covariance
    half = None if covariance is None else NORMAL_95 * np.sqrt(np.einsum("ni,nij,nj->n", nearest, covariance, nearest))
    return Bounded(foot.beyond_m, half)


def sole_events(interval: IntervalBalance, *, release_N: float) -> Iterator[SoleEventRow]:
    """Find the times in which what is measured on a sole reaches or exceeds what the ground can do.

    Args:
        interval: How a robot stood, with wrenches on its feet.
        release_N: Force above which a contact lasts; a smaller pull is an error of the model of a foot in the air.

    Yields:
        Events of each foot, those of a kind in the order of time. A time of `slip` is no `slip_risk`.
    """
    for foot in interval.feet:
        yield from _of_foot(interval, foot, release_N)


def _of_foot(interval: IntervalBalance, foot: FootPressure, release_N: float) -> Iterator[SoleEventRow]:
    pressed, normal = foot.pressure.known, foot.wrench[:, 2]
    if foot.sole.outline is not None:
        distance = outside(foot)
        for span in _spans(pressed & (distance.lower > 0.0), interval.time_s):
            at = span.start + int(np.nanargmax(distance.value[span]))
            yield _row(interval, foot, "outside", span, at, beyond=distance)
    half = 0.0 if foot.covariance is None else NORMAL_95 * np.sqrt(foot.covariance[:, 2, 2])
    for span in _spans(np.asarray((normal < -release_N) & (normal + half < 0.0)), interval.time_s):
        yield _row(interval, foot, "pulls", span, span.start + int(np.nanargmin(normal[span])))
    if not foot.sole.has_friction:
        return
    used = friction_used(foot.sole, np.where(pressed[:, None], foot.wrench, np.nan), foot.covariance)
    slips = list(_spans(np.asarray(used.lower > 1.0), interval.time_s))
    held = np.ones(len(normal), dtype=np.bool_)
    for span in slips:
        held[span] = False
    risks = list(_spans(np.asarray(used.upper > 1.0) & held, interval.time_s))
    kinds: tuple[tuple[EventKind, list[slice]], ...] = (("slip", slips), ("slip_risk", risks))
    for kind, spans in kinds:
        for span in spans:
            yield _row(interval, foot, kind, span, span.start + int(np.nanargmax(used.value[span])), used=used)


def _spans(marks: BoolArray, time_s: FloatArray) -> Iterator[slice]:
    """Spans of marked samples that last; over a short pause they are one."""
    period_s = float(np.median(np.diff(time_s))) if len(time_s) > 1 else 0.0
    spans: list[slice] = []
    for span in stretches(marks):
        if not marks[span.start] or time_s[span.stop - 1] - time_s[span.start] + period_s < SHORTEST_S:
            continue
        if spans and time_s[span.start] - time_s[spans[-1].stop - 1] < PAUSE_S:
            span = slice(spans.pop().start, span.stop)
        spans.append(span)
    yield from spans


def _row(
    interval: IntervalBalance,
    foot: FootPressure,
    kind: EventKind,
    span: slice,
    at: int,
    *,
    beyond: Bounded | None = None,
    used: Bounded | None = None,
) -> SoleEventRow:
    return SoleEventRow(
        recording=interval.recording,
        interval=interval.label,
        sole=foot.sole.frame,
        sensors=foot.sensors,
        kind=kind,
        start_s=float(interval.time_s[span.start]),
        end_s=float(interval.time_s[span.stop - 1]),
        beyond_mm=_at(beyond, at, _MM)[0],
        beyond_half_width_95_mm=_at(beyond, at, _MM)[1],
        used_percent=_at(used, at, 100.0)[0],
        used_half_width_95_percent=_at(used, at, 100.0)[1],
        normal_N=float(foot.wrench[at, 2]),
    )


def _at(bounded: Bounded | None, at: int, factor: float) -> tuple[float | None, float | None]:
    if bounded is None:
        return None, None
    half = bounded.half_width_95
    return factor * float(bounded.value[at]), None if half is None else factor * float(half[at])
