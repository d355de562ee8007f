# SPDX-License-Identifier: BSD-3-Clause
"""Intervals free of contact of an experiment whose intervals were not chosen yet.

A free sensor measures the expected wrench at one level, its offset; a contact moves it to another level. So the level
is chosen at which the expected wrench moves most, whatever the intervals of the file are, and what `inspect` finds
beside it is left out.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.true_runs import true_runs
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.draft.gravity_fit import MARGIN_S, SHORTEST_S
from forcetorque.inspection.draft.intervals_and_clocks import MOST_SPANS
from forcetorque.inspection.findings import over_the_whole_log
from forcetorque.inspection.model_errors import ModelErrors
from forcetorque.inspection.residual_findings import LOAD_SHARE, UNEXPLAINED, model_findings

_BLOCK_S = 0.5
"""Length of the medians whose levels are compared."""
_MOST_LEVELS = 400
"""Number of levels that are tried, evenly over the log."""
_NOISE_FACTOR = 3.0
"""Distance to a level, in usual changes from block to block, within which a block is at it."""
_ROUNDS, _FEWEST_BLOCKS = 3, 20
"""How often errors that follow the load are taken out of the levels, and blocks below which they are not."""
_LEAST_SHARE = 0.1
"""Share of the log below which the free time of a sensor does not limit that of others."""


@dataclass(frozen=True, slots=True, kw_only=True)
class FreeTime:
    """When a sensor, or all of several, measure what is expected."""

    sensors: tuple[str, ...]
    """Sensors that it is about."""
    left_out: Mapping[str, str]
    """Reasons why other sensors were left out, by their names."""
    spans: tuple[tuple[int, int], ...]
    """First and last instant of the longest intervals, in the order of time; ns."""


def free_time(runs: Sequence[SensorRun]) -> FreeTime:
    """Find the intervals in which nothing but the support touches.

    Args:
        runs: Sensors of one experiment.

    Returns:
        The intervals that all sensors share.
    """
    start, end = runs[0].experiment.recording.span_ns
    disturbed: dict[str, list[tuple[int, int]]] = {}
    left_out: dict[str, str] = {}
    for run in runs:
        try:
            spans = _disturbed(run)
        except ForceTorqueError as error:
            left_out[run.sensor.name] = str(error)
            continue
        if sum(b - a for a, b in _complement(spans, start, end)) < _LEAST_SHARE * (end - start):
            left_out[run.sensor.name] = "something touches it nearly all the time"
        else:
            disturbed[run.sensor.name] = spans
    shared = _complement([span for spans in disturbed.values() for span in spans], start, end) if disturbed else []
    longest = sorted(sorted(shared, key=lambda span: span[0] - span[1])[:MOST_SPANS])
    return FreeTime(sensors=tuple(disturbed), left_out=left_out, spans=tuple(longest))


def _complement(spans: Sequence[tuple[int, int]], start: int, end: int) -> list[tuple[int, int]]:
    """What is left of a log beside spans and a margin to them, as far as it is long enough."""
    margin, left, at = round(MARGIN_S * 1e9), [], start
    for first, last in sorted(spans):
        if first - margin - at >= SHORTEST_S * 1e9:
            left.append((at, first - margin))
        at = max(at, last + margin)
    return [*left, (at, end)] if end - at >= SHORTEST_S * 1e9 else left


def _disturbed(run: SensorRun) -> list[tuple[int, int]]:
    """Spans in which something is measured that is not expected."""
    correction = run.read_by(None, None).bare
    supported = [interval for interval in run.experiment.recording.intervals if interval.support is not None]
    spans: list[tuple[int, int]] = []
    for interval in over_the_whole_log(run.experiment, supported):
        part = run.interval_samples(interval, variables=correction.variables, smoothed=False)
        stamps, expected = part.samples.stamp_ns, run.sensor.expected_reading(part.samples.reference)
        measured = part.readings.wrench(correction)
        block = (stamps - stamps[0]) // round(_BLOCK_S * 1e9)
        at_level = _at_one_level(block, measured - expected, expected)
        spans += [(int(stamps[first]), int(stamps[last])) for first, last in true_runs(~at_level)]
        findings = model_findings(run.sensor.stream, stamps, measured, expected, in_use=at_level)
        spans += [
            (one.start_ns, one.end_ns)
            for one in findings
            if one.kind in UNEXPLAINED and one.start_ns is not None and one.end_ns is not None
        ]
    return spans


def _at_one_level(block: IntArray, residual: FloatArray, expected: FloatArray) -> BoolArray:
    """Samples of the blocks whose residual force is at the level at which the expected force moves most; shape (n,)."""
    starts = np.flatnonzero(np.diff(block, prepend=-1))
    parts = np.split(np.arange(len(block)), starts[1:])
    levels = np.array([np.median(residual[part], axis=0) for part in parts])
    loads = np.array([np.median(expected[part], axis=0) for part in parts])
    load = float(np.percentile(np.linalg.norm(expected[:, :3], axis=1), 95))
    usual = float(np.median(np.linalg.norm(np.diff(levels[:, :3], axis=0), axis=1))) if len(levels) > 1 else 0.0
    tolerance = max(LOAD_SHARE * load, _NOISE_FACTOR * usual)

    def near(values: FloatArray, centre: FloatArray) -> BoolArray:
        return np.asarray(np.linalg.norm((values - centre)[:, :3], axis=1) <= tolerance)

    best, most = np.ones(len(levels), dtype=np.bool_), -1.0
    for candidate in np.unique(np.linspace(0, len(levels) - 1, min(len(levels), _MOST_LEVELS)).round().astype(int)):
        chosen = near(levels, levels[candidate])
        moved = float(((loads[chosen, :3] - loads[chosen, :3].mean(axis=0)) ** 2).sum())
        if moved > most:
            best, most = chosen, moved
    at = block[starts] - float(block[starts].mean())
    # errors of the matrix and of the robot follow the load, and a drift the time; a contact follows none of them
    for _ in range(_ROUNDS):
        if np.count_nonzero(best) >= _FEWEST_BLOCKS:
            beside = ModelErrors(residual=levels, expected=loads, usable=best).beside_load()
            slope, level = np.polyfit(at[best], beside[best], 1)
            best = near(beside, np.outer(at, slope) + level)
    return np.repeat(best, [len(part) for part in parts])
