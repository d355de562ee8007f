# SPDX-License-Identifier: BSD-3-Clause
"""Joint torques of several sources combined by their covariances, without a source that contradicts the others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import EstimationError
from forcetorque.base.units import NORMAL_95
from forcetorque.estimation.fusion.disagreement import (
    Disagreement,
    Innovation,
    WindowMeans,
    combined,
    disagreement,
    means_in_windows,
)
from forcetorque.estimation.fusion.source import TorqueSource


@dataclass(frozen=True, slots=True, kw_only=True)
class Conflict:
    """What the sources of an interval, or of a window, have against each other."""

    is_there: bool
    """Whether they disagree by more than chance makes them."""
    everyone: Disagreement
    """Of all sources."""
    without: Mapping[str, Disagreement]
    """Of the others, by the source that is left out."""
    suspects: tuple[str, ...]
    """Sources without which the others agree, where there is a conflict."""

    @property
    def source(self) -> str | None:
        """The source in conflict; None without conflict, and where several or none alone explain it."""
        return self.suspects[0] if len(self.suspects) == 1 else None

    def innovation(self, source: str) -> Innovation:
        """Give the innovation of one source against all others together.

        Args:
            source: Its name.

        Returns:
            What the disagreement is less without it.
        """
        total, rest = self.everyone.total, self.without[source].total
        return Innovation(
            chi2=total.chi2 - rest.chi2, degrees_of_freedom=total.degrees_of_freedom - rest.degrees_of_freedom
        )


def conflict_between(sources: Mapping[str, WindowMeans], false_alarm: float) -> Conflict:
    """Look for a conflict, and for the source without which there is none.

    Sums of squared normalised innovations are distributed as chi-squared if covariances are right and errors normal, so
    the rate of false alarms is the one asked for. Of two sources, nothing tells which is wrong.

    Args:
        sources: Means of every source over the same windows, by name.
        false_alarm: Rate of false alarms that is allowed.

    Returns:
        The conflict, if there is one.
    """
    everyone = disagreement(tuple(sources.values()))
    without = {name: disagreement([one for other, one in sources.items() if other != name]) for name in sources}
    alarmed = everyone.alarms(false_alarm)
    return Conflict(
        is_there=alarmed,
        everyone=everyone,
        without=without,
        suspects=tuple(name for name, rest in without.items() if alarmed and not rest.alarms(false_alarm)),
    )


FALSE_ALARM = 0.01
"""Rate of intervals, or of windows, that have a conflict though every covariance is right."""

WINDOW_S = 1.0
"""Length of the windows in which sources are compared: noise averages out, and motions are still seen; s."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Fusion:
    """Joint torques of all sources together over one interval."""

    joints: tuple[str, ...]
    """Names of j joints."""
    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    torque: FloatArray
    """Fused torques along +q, NaN where no source knows one; shape (n, j); N m, N where prismatic."""
    covariance: FloatArray
    """Their covariance; shape (n, j, j); (N m)^2. Where sources contradict each other and none alone explains that, it
    is larger by the mean of their squared normalised innovations."""
    used: tuple[str, ...]
    """Sources that were combined."""
    conflict: Conflict
    """Over the whole interval."""
    windows: tuple[Conflict, ...]
    """In each window by itself."""

    @property
    def half_width(self) -> FloatArray:
        """Half of the 95 % intervals; shape (n, j); N m."""
        return NORMAL_95 * np.sqrt(np.einsum("njj->nj", self.covariance))


def fuse(sources: Sequence[TorqueSource], *, false_alarm: float = FALSE_ALARM, window_s: float = WINDOW_S) -> Fusion:
    """Combine sources of joint torques by least squares weighted by their covariances.

    Errors of different sources are independent except for those that they share, such as those of the robot model:
    these stay whole, whatever the number of sources. How far two sources share them in truth depends on the links that
    each uses. Intervals take them as common to all, and the search for conflicts takes them as independent: each of the
    two is on the safe side. A source that alone contradicts the others over the interval is left out of all of it.

    Args:
        sources: Sources with the same joints and instants, at least one.
        false_alarm: Rate of false alarms of the test for conflicts, per interval and per window.
        window_s: Length of the windows in which means are compared; s.

    Returns:
        Torques with their covariance, and the conflicts.

    Raises:
        EstimationError: If names are not unique, joints or instants differ, or rate and window are none.
    """
    _require_comparable(sources)
    sources = _with_all_shared(sources)
    if not (0.0 < false_alarm < 1.0 and 0.0 < window_s < np.inf):
        raise EstimationError(
            f"fuse: expected 0 < false_alarm < 1 and a positive window_s, got {false_alarm} and {window_s} s"
        )
    compared = means_in_windows([source.independent for source in sources], window_s)
    means = dict(zip((source.name for source in sources), compared, strict=True))
    conflict = conflict_between(means, false_alarm)
    used = [source for source in sources if source.name != conflict.source]
    torque, covariance = combined(
        [source.torque for source in used],
        [source.own_covariance for source in used],
        [source.shared for source in used],
    )
    if conflict.is_there and conflict.source is None:
        covariance = covariance * max(1.0, conflict.everyone.total.ratio)
    first = sources[0]
    return Fusion(
        joints=first.joints,
        stamp_ns=first.stamp_ns,
        torque=torque,
        covariance=covariance,
        used=tuple(source.name for source in used),
        conflict=conflict,
        windows=tuple(
            conflict_between({name: one.window(k) for name, one in means.items()}, false_alarm)
            for k in range(len(means[first.name].torque))
        ),
    )


def _with_all_shared(sources: Sequence[TorqueSource]) -> list[TorqueSource]:
    """Give every source a column for each shared error, zero where it has none of them."""
    counts = {source.shared.shape[2] for source in sources} - {0}
    if len(counts) > 1:
        raise EstimationError(
            f"fuse: shared: expected the same errors in all sources that have any, got {sorted(counts)} of them"
        )
    shape = (*sources[0].torque.shape, max(counts, default=0))
    return [source if source.shared.shape == shape else replace(source, shared=np.zeros(shape)) for source in sources]


def _require_comparable(sources: Sequence[TorqueSource]) -> None:
    names = [source.name for source in sources]
    if not names or len(set(names)) < len(names):
        raise EstimationError(f"fuse: expected sources of different names, at least one, got {names}")
    first = sources[0]
    for other in sources[1:]:
        pair = f"sources {first.name!r} and {other.name!r}"
        if other.joints != first.joints:
            raise EstimationError(f"{pair}: expected the same joints, got {first.joints} and {other.joints}")
        if len(other) != len(first):
            raise EstimationError(
                f"{pair}: expected the same instants, got {len(first)} and {len(other)}; interpolate them before"
            )
        apart = np.abs(other.stamp_ns - first.stamp_ns)
        if apart.any():
            row = int(apart.argmax())
            raise EstimationError(
                f"{pair}, sample {row}: expected the same instants, they are {apart[row] * 1e-9:.6f} s apart; "
                "interpolate one to those of the other before"
            )
