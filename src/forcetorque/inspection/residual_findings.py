# SPDX-License-Identifier: BSD-3-Clause
"""Contacts of a free limb, steps, intervals off level, and outliers of a sensor, beside its expected wrench.

The residual is measurement minus expectation, less its median over the samples that are in use. A running median of
half a second takes vibration out and keeps steps sharp. The limit is a tenth of the load of the limb on the sensor, or
four times the usual scatter if that is more: heuristics, chosen so that a log of a laboratory gives few and useful
findings. A contact in samples in use shifts their median and widens their scatter, so that both are taken again
without it.

This search needs no interval that is known to be free of contact. `robot collisions` learns noise and errors of the
model from such an interval, less what this search finds there, and then finds weaker contacts.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from operator import itemgetter

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, true_runs
from forcetorque.base.errors import ShapeError
from forcetorque.base.units import MAD_TO_DEVIATION
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.inspection.model_errors import ModelErrors
from forcetorque.recording.frozen_and_saturated_samples import mask_of
from forcetorque.recording.recording import Finding

LOAD_SHARE = 0.1
"""Least residual of a finding, as a share of the load of the limb."""
FIRM_SHARE = 0.5
"""Least share of the weight of the limb that a certain contact carries at its peak."""
SCATTERS = 4.0
"""Least residual of a finding, in robust standard deviations of the smoothed residual."""
CONTACT_SCATTERS = 3.0
"""Least lifting force of a contact, in robust standard deviations."""
OUTLIER_SCATTERS = 12.0
"""Least deviation of an outlier from the smoothed residual, in robust standard deviations."""

UNEXPLAINED = frozenset({"contact", "light_contact", "off_level", "step"})
"""Kinds of findings in whose time something is measured that the model does not explain."""

_SMOOTH_S, _LEVEL_S, _EDGE_S, _MERGE_S, _SHORTEST_S = 0.5, 1.0, 0.25, 1.0, 0.5
_LONGEST_OUTLIER = 3
_QUICK_S, _SHORTEST_PUSH_S, _LONGEST_PUSH_S, _QUIET_S = 0.2, 0.25, 20.0, 0.5
"""Length of the running median that keeps pushes of half a second, how long a push is, and for how long all axes are
back at their level before and after it; s."""
_ALONG = 0.9
"""Cosine from which on a force acts along the weight: more weight, not a push."""
_ROUNDS, _LEAST_AT_LEVEL = 4, 0.1
"""How often the level is taken without contacts, and the least share of samples in use that is left for it."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Residual:
    stream: str
    stamp_ns: IntArray
    rate_hz: float
    values: FloatArray
    smooth: FloatArray
    quick: FloatArray
    limit: FloatArray
    least: FloatArray
    expected: FloatArray
    in_use: BoolArray

    def samples(self, seconds: float) -> int:
        return max(1, round(seconds * self.rate_hz))

    def finding(self, kind: str, message: str, first: int, last: int, axis: int | None, size: float) -> Finding:
        channel, unit = (None, "N") if axis is None else (WRENCH_COMPONENTS[axis], WRENCH_UNITS[axis])
        return Finding.over(
            self.stream, self.stamp_ns, kind, message, first, last, channel=channel, size=size, unit=unit
        )


def model_findings(
    stream: str,
    stamp_ns: IntArray,
    measured: FloatArray,
    expected: FloatArray,
    *,
    in_use: BoolArray,
    stability: FloatArray | None = None,
) -> tuple[Finding, ...]:
    """Compare the measurements of a sensor, whose distal links should be free, with the expected wrench.

    Args:
        stream: Name of the sensor's stream, for the findings.
        stamp_ns: Increasing instants; shape (n,); ns.
        measured: Measured wrenches, offset not removed; shape (n, 6); N, N m.
        expected: Expected wrenches; shape (n, 6); N, N m.
        in_use: Samples of intervals in use, which define level and scatter; shape (n,).
        stability: Drift over the log that any sensor of its range has; shape (6,); N, N m; none if None.

    Returns:
        Findings of the kinds `drift`, `contact` and `light_contact` (something carries part of the limb's
        weight, or pushes several axes; from its begin to its end), `step`, `off_level` and `outlier`; each with its
        time and size.

    Raises:
        ShapeError: If the shapes differ or no sample is in use.
    """
    if measured.shape != expected.shape or measured.shape != (len(stamp_ns), 6) or not in_use.any():
        raise ShapeError(
            f"expected readings and references of one shape (n, 6) and some samples in use, "
            f"got {measured.shape}, {expected.shape} and {np.count_nonzero(in_use)} in use"
        )
    residual = _residual(stream, stamp_ns, measured, expected, in_use)
    errors = ModelErrors(residual=residual.smooth, expected=expected, usable=in_use)
    drifts, residual = _drifts(residual, errors, np.zeros(6) if stability is None else stability)
    contacts, pushes = _contacts_and_pushes(residual)
    for _ in range(_ROUNDS):
        # what carries or moves the limb is no level of the sensor
        firm = [run for run in (*contacts, *pushes) if _is_firm(residual, *run)]
        at_level = in_use & ~mask_of(firm, len(stamp_ns))
        if np.count_nonzero(at_level) < max(_LEAST_AT_LEVEL * np.count_nonzero(in_use), residual.samples(_LEVEL_S)):
            break
        if (at_level == residual.in_use).all():
            break
        residual = _at_level(residual, at_level)
        contacts, pushes = _contacts_and_pushes(residual)
    # a light contact may as well be a step of the sensor: its axes are then reported too
    free = ~mask_of([run for run in contacts if _is_firm(residual, *run)], len(stamp_ns))
    untouched = ~mask_of(pushes, len(stamp_ns))
    usable = residual.in_use & free
    errors = ModelErrors(
        residual=residual.smooth, expected=expected, usable=usable if usable.any() else residual.in_use
    )
    return (
        *drifts,
        *_push_findings(residual, pushes),
        *_contact_findings(residual, contacts),
        *_off_level(residual, free & untouched, errors),
        *_steps(residual, free & untouched, errors),
        *_outliers(residual, free & untouched),
    )


def _contacts_and_pushes(residual: _Residual) -> tuple[list[tuple[int, int]], list[tuple[int, int]]]:
    """Runs in which something carries part of the weight, and those of other forces, each from its begin to its end."""
    errors = ModelErrors(residual=residual.smooth, expected=residual.expected, usable=residual.in_use)
    carried = _carried(residual.smooth, residual.expected)
    weight = np.linalg.norm(residual.expected[:, :3], axis=1)
    usual = CONTACT_SCATTERS * MAD_TO_DEVIATION * float(np.median(np.abs(carried[residual.in_use])))
    least = np.maximum(LOAD_SHARE * weight, usual)
    contacts = [run for run in _merged(residual, carried > least) if not _is_no_contact(residual, least, errors, *run)]
    free = residual.in_use & ~mask_of([run for run in contacts if _is_firm(residual, *run)], len(weight))
    if free.any():
        errors = replace(errors, usable=free)
    contacts = _whole(residual, contacts, errors)
    return contacts, _pushes(residual, contacts, errors)


def _whole(residual: _Residual, contacts: Sequence[tuple[int, int]], errors: ModelErrors) -> list[tuple[int, int]]:
    """Contacts with the time before and after in which they push several axes without carrying weight."""
    if not contacts:
        return []
    together = (np.abs(residual.quick) > residual.limit).sum(axis=1) > 1
    grown = mask_of(contacts, len(together))
    reach = residual.samples(_QUIET_S)
    for first, last in _joined(residual, together, _QUIET_S):
        beside = grown[max(0, first - reach) : last + 1 + reach].any() and not grown[first : last + 1].all()
        if beside and len(_unexplained(residual, errors, first, last)) > 1:
            grown[first : last + 1] = True
    return _joined(residual, grown, _QUIET_S)


def _residual(
    stream: str, stamp_ns: IntArray, measured: FloatArray, expected: FloatArray, in_use: BoolArray
) -> _Residual:
    values = measured - expected
    values = values - np.median(values[in_use], axis=0)
    rate_hz = 1e9 / float(np.median(np.diff(stamp_ns))) if len(stamp_ns) > 1 else 1.0
    smooth, quick = (_running_median(values, max(1, round(seconds * rate_hz))) for seconds in (_SMOOTH_S, _QUICK_S))
    scatter = MAD_TO_DEVIATION * np.median(np.abs(smooth[in_use]), axis=0)
    load = np.repeat([np.percentile(np.linalg.norm(expected[:, part], axis=1), 95) for part in FORCE_AND_MOMENT], 3)
    return _Residual(
        stream=stream,
        stamp_ns=stamp_ns,
        rate_hz=rate_hz,
        values=values,
        smooth=smooth,
        quick=quick,
        limit=np.maximum(LOAD_SHARE * load, SCATTERS * scatter),
        least=LOAD_SHARE * load,
        expected=expected,
        in_use=in_use,
    )


def _at_level(residual: _Residual, at_level: BoolArray) -> _Residual:
    """The residual less its median over some samples, by whose scatter its limits are."""
    level = np.median(residual.values[at_level], axis=0)
    smooth = residual.smooth - level
    scatter = MAD_TO_DEVIATION * np.median(np.abs(smooth[at_level]), axis=0)
    return replace(
        residual,
        values=residual.values - level,
        smooth=smooth,
        quick=residual.quick - level,
        limit=np.maximum(residual.least, SCATTERS * scatter),
        in_use=at_level,
    )


def _running_median(values: FloatArray, size: int) -> FloatArray:
    """Median over windows of samples, shape (n, k); the first and last sample are repeated beyond the ends."""
    from scipy.ndimage import median_filter  # here because importing it takes longer than most commands

    result = np.empty_like(values)
    for k, column in enumerate(values.T):  # of a single axis SciPy sorts no window anew
        result[:, k] = median_filter(np.ascontiguousarray(column), size=size, mode="nearest")
    return result


_SEGMENTS = 12
"""Segments of a log whose levels show a drift."""
_EVEN = 0.8
"""Share of the variance of these levels that a straight line explains, from which on they drift."""
_SUDDEN = 0.4
"""Share of a drift that comes from one segment to the next, from which on it is a step."""
_SHORTEST_DRIFT_S, _LEAST_IN_USE = 30.0, 0.5
"""Time that samples in use span at least for a drift: s, and as a share of the log."""


def _drifts(residual: _Residual, errors: ModelErrors, stability: FloatArray) -> tuple[list[Finding], _Residual]:
    """Axes whose level moves evenly over the whole log, and the residual without that."""
    rows = np.flatnonzero(residual.in_use)
    seconds = (residual.stamp_ns - residual.stamp_ns[0]) * 1e-9
    span_s = float(np.ptp(seconds[rows])) if len(rows) else 0.0
    if len(rows) < 10 * _SEGMENTS or span_s < max(_SHORTEST_DRIFT_S, _LEAST_IN_USE * float(seconds[-1])):
        return [], residual
    segments = np.array_split(rows, _SEGMENTS)
    at_s = np.array([np.median(seconds[segment]) for segment in segments])
    at_s = at_s - at_s.mean()
    slopes = np.zeros(6)
    for values in (errors.beside_load(), residual.values):
        levels = np.array([np.median(values[segment], axis=0) for segment in segments])
        levels = levels - levels.mean(axis=0)
        slope = at_s @ levels / (at_s @ at_s)
        total = np.abs(slope) * span_s
        is_even = ((levels - np.outer(at_s, slope)) ** 2).sum(axis=0) < (1.0 - _EVEN) * (levels**2).sum(axis=0)
        is_slow = np.abs(np.diff(levels, axis=0)).max(axis=0) < _SUDDEN * total
        slopes = np.where((total > np.maximum(residual.least, stability)) & is_even & is_slow, slope, slopes)
    if not slopes.any():
        return [], residual
    findings = [
        residual.finding(
            "drift",
            f"{WRENCH_COMPONENTS[axis]} drifts evenly over the log, as of a sensor that warms up",
            int(rows[0]),
            int(rows[-1]),
            int(axis),
            float(slopes[axis] * span_s),
        )
        for axis in np.flatnonzero(slopes)
    ]
    taken = np.outer(seconds - seconds.mean(), slopes)
    values, smooth, quick = residual.values - taken, residual.smooth - taken, residual.quick - taken
    scatter = MAD_TO_DEVIATION * np.median(np.abs(smooth[residual.in_use]), axis=0)
    limit = np.maximum(residual.least, SCATTERS * scatter)
    return findings, replace(residual, values=values, smooth=smooth, quick=quick, limit=limit)


def _pushes(residual: _Residual, contacts: Sequence[tuple[int, int]], errors: ModelErrors) -> list[tuple[int, int]]:
    """Runs in which several axes are off together and come back: a force on the limb that is not one of `contacts`."""
    off = np.abs(residual.quick) > residual.limit
    pushes = []
    for first, last in _joined(residual, np.asarray(off.any(axis=1)), _QUIET_S):
        length_s = (residual.stamp_ns[last] - residual.stamp_ns[first]) * 1e-9
        own = slice(first, last + 1)
        if not _SHORTEST_PUSH_S <= length_s <= _LONGEST_PUSH_S or first == 0 or last == len(off) - 1:
            continue
        if off[own].any(axis=0).sum() < 2 or any(first <= end and last >= start for start, end in contacts):
            continue
        force, weight = residual.quick[own, :3].mean(axis=0), residual.expected[own, :3].mean(axis=0)
        if force @ weight >= _ALONG * np.linalg.norm(force) * np.linalg.norm(weight):
            continue
        if len(_unexplained(residual, errors, first, last)) > 1:
            pushes.append((first, last))
    return pushes


def _unexplained(residual: _Residual, errors: ModelErrors, first: int, last: int) -> list[int]:
    """Axes that are off in a run by more than errors of the model leave."""
    beside = replace(errors, residual=residual.quick)
    off = (np.abs(residual.quick[first : last + 1]) > residual.limit).any(axis=0)
    return [
        axis
        for axis in np.flatnonzero(off).tolist()
        if not _is_explained(residual, beside, first, last, axis, _SHORTEST_PUSH_S)
    ]


def _push_findings(residual: _Residual, pushes: Sequence[tuple[int, int]]) -> list[Finding]:
    text = "several axes are off together for a while: something pushes the limb"
    findings = []
    for a, b in pushes:
        largest = float(np.linalg.norm(residual.values[a : b + 1, :3], axis=1).max())
        kind = "contact" if _is_firm(residual, a, b) else "light_contact"
        findings.append(residual.finding(kind, text, a, b, None, largest))
    return findings


def _is_explained(
    residual: _Residual, errors: ModelErrors, first: int, last: int, axis: int, shortest_s: float = _SHORTEST_S
) -> bool:
    return errors.explain_level(
        first,
        last,
        itemgetter((slice(None), axis)),
        np.full(last - first + 1, residual.limit[axis]),
        axes=slice(axis, axis + 1),
        is_moment=axis >= 3,
        margin=residual.samples(_LEVEL_S),
        shortest=residual.samples(shortest_s),
    )


def _carried(residual: FloatArray, expected: FloatArray) -> FloatArray:
    """Force that lifts the limb, against the expected weight; shape (n,); N."""
    weight = np.linalg.norm(expected[:, :3], axis=1)
    along = np.einsum("ij,ij->i", residual[:, :3], expected[:, :3])
    return np.divide(-along, weight, out=np.zeros_like(along), where=weight > 0.0)


def _merged(residual: _Residual, mask: BoolArray) -> list[tuple[int, int]]:
    """Runs of true values, joined across short pauses, without short ones."""
    shortest = residual.samples(_SHORTEST_S)
    return [run for run in _joined(residual, mask, _MERGE_S) if run[1] - run[0] + 1 >= shortest]


def _joined(residual: _Residual, mask: BoolArray, pause_s: float) -> list[tuple[int, int]]:
    """Runs of true values, joined across shorter pauses."""
    joined: list[tuple[int, int]] = []
    for first, last in true_runs(mask):
        if joined and residual.stamp_ns[first] - residual.stamp_ns[joined[-1][1]] < pause_s * 1e9:
            joined[-1] = (joined[-1][0], last)
        else:
            joined.append((first, last))
    return joined


def _is_firm(residual: _Residual, first: int, last: int) -> bool:
    """Whether the force of a run is so large against the weight that it is no step of the sensor."""
    own = slice(first, last + 1)
    weight = np.linalg.norm(residual.expected[own, :3], axis=1)
    return bool((np.linalg.norm(residual.smooth[own, :3], axis=1) > FIRM_SHARE * weight).any())


def _is_no_contact(residual: _Residual, least: FloatArray, errors: ModelErrors, first: int, last: int) -> bool:
    """Whether errors of the model explain that the limb seems to be lifted."""
    own = slice(first, last + 1)
    return errors.explain_level(
        first,
        last,
        lambda values: _carried(values, residual.expected[own]),
        least[own],
        axes=slice(0, 3),
        is_moment=False,
        margin=residual.samples(_LEVEL_S),
        shortest=residual.samples(_SHORTEST_S),
    )


def _contact_findings(residual: _Residual, contacts: Sequence[tuple[int, int]]) -> list[Finding]:
    findings = []
    for first, last in contacts:
        largest = float(np.linalg.norm(residual.smooth[first : last + 1, :3], axis=1).max())
        if _is_firm(residual, first, last):
            kind, text = "contact", "the limb touches something, which carries part of its weight"
        else:
            kind, text = "light_contact", "the limb is lifted a little: a light contact, or a step of the sensor"
        findings.append(residual.finding(kind, text, first, last, None, largest))
    return findings


def _off_level(residual: _Residual, free: BoolArray, errors: ModelErrors) -> list[Finding]:
    findings = []
    for axis, name in enumerate(WRENCH_COMPONENTS):
        far = (np.abs(residual.smooth[:, axis]) > residual.limit[axis]) & free
        for first, last in _merged(residual, far):
            if _is_explained(residual, errors, first, last, axis):
                continue
            level = float(np.median(residual.values[first : last + 1, axis]))
            text = f"{name} is off the level of the samples in use"
            findings.append(residual.finding("off_level", text, first, last, axis, level))
    return findings


def _steps(residual: _Residual, free: BoolArray, errors: ModelErrors) -> list[Finding]:
    """Differences between the levels of a second before and a second after, each off by a quarter second."""
    width = residual.samples(_LEVEL_S)
    shift = width // 2 + residual.samples(_EDGE_S)
    findings: list[Finding] = []
    if len(free) <= 2 * shift:
        return findings
    levels = _running_median(residual.values, width)
    away = _all_around(free, shift + width // 2)  # both levels free of contact to their ends
    for axis, name in enumerate(WRENCH_COMPONENTS):
        change = np.zeros(len(free))
        change[shift:-shift] = levels[2 * shift :, axis] - levels[: -2 * shift, axis]
        # a repeated edge sample is no level; and where a wrong prior makes levels wander, only the sudden counts
        margin = shift + width // 2
        change[:margin] = change[len(change) - margin :] = 0.0
        usual = MAD_TO_DEVIATION * float(np.median(np.abs(change[residual.in_use])))
        limit = max(residual.least[axis], SCATTERS * usual)
        change[~away] = 0.0
        while np.abs(change).max() > limit:
            peak = int(np.argmax(np.abs(change)))
            size, half = float(change[peak]), width // 2
            before, after = (slice(peak + way * shift - half, peak + way * shift + half + 1) for way in (-1, 1))
            if not errors.explain_step(size, axis, before, after, limit):
                at = _steepest(residual, axis, peak, shift, float(np.sign(size)))
                findings.append(residual.finding("step", f"{name} steps against the model", at, at, axis, size))
            change[max(0, peak - 2 * shift) : peak + 2 * shift + 1] = 0.0
    return sorted(findings, key=lambda finding: finding.start_ns or 0)


def _all_around(mask: BoolArray, reach: int) -> BoolArray:
    """Whether all samples within a reach are true, of those that there are; shape (n,)."""
    untrue = np.concatenate([[0], np.cumsum(~mask)])
    at = np.arange(len(mask))
    return np.asarray(untrue[np.minimum(at + reach + 1, len(mask))] == untrue[np.maximum(at - reach, 0)])


def _steepest(residual: _Residual, axis: int, peak: int, shift: int, sign: float) -> int:
    """Index at which the smoothed residual changes fastest near a step."""
    first, last = max(0, peak - shift), min(len(residual.smooth), peak + shift + 1)
    part = residual.smooth[first:last, axis]
    lag = residual.samples(_EDGE_S)
    if len(part) <= lag:
        return peak
    return first + lag // 2 + int(np.argmax(sign * (part[lag:] - part[:-lag])))


def _outliers(residual: _Residual, free: BoolArray) -> list[Finding]:
    quick = residual.values - residual.smooth
    free = _all_around(free, residual.samples(_QUIET_S))  # a limb that is let go rings
    scatter = MAD_TO_DEVIATION * np.median(np.abs(quick[residual.in_use]), axis=0)
    findings: list[Finding] = []
    for axis, name in enumerate(WRENCH_COMPONENTS):
        limit = max(OUTLIER_SCATTERS * scatter[axis], residual.limit[axis])
        runs = [run for run in true_runs((np.abs(quick[:, axis]) > limit) & free) if run[1] - run[0] < _LONGEST_OUTLIER]
        if runs:
            largest = max(runs, key=lambda run: float(np.abs(quick[run[0], axis])))
            size = float(quick[largest[0], axis])
            text = f"{len(runs)} outlier(s) of {name} of at most {_LONGEST_OUTLIER} samples, the largest here"
            findings.append(residual.finding("outlier", text, *largest, axis, size))
    return findings
