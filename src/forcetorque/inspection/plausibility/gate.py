# SPDX-License-Identifier: BSD-3-Clause
"""All checks of the gate, in the order in which one explains the next; here also those of clocks and delays."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled, symmetric_pseudo_inverse
from forcetorque.experiment.calibration.sensor_model import is_invertible, measured_components
from forcetorque.inspection.plausibility.compared_wrenches import ROBOT, Doubt, Movement, Setup
from forcetorque.inspection.plausibility.gravity_sense_gain_and_unit_checks import (
    axis_doubts,
    gains_of,
    require_moment_unit,
    require_moving_load,
    require_same_sign,
    require_within_full_scale,
    scale_doubts,
    span_doubts,
)
from forcetorque.recording.clock_offset import EVEN, ResampledPair, residual_at_lags

_FEWEST = 20
"""Changes of a channel below which it may rise all the while by chance."""

_ONE_WAY = 0.99
"""Share of a channel's changes that go one way in a clock; the others are those of a counter that starts again.

Of a gauge half do: its noise changes it at every sample. Under a load that goes one way, or smoothed, more do.
"""

_FOLLOWS = 0.9
"""Share of a channel that such a load explains; of a clock swings explain some tenths, and a slow sweep nearly all."""

_STRAIGHT, _BENT = 1e-4, 1e-2
"""Shares of their movement that a channel lacks, and the load has, off a straight line in time, where the channel is a
clock although the load explains it: no gauge is straighter than all that it measures."""


def require_gauges(data_sets: Sequence[DataSet], moments: Moments) -> None:
    """Refuse a channel that rises, or falls, whatever the load does.

    Args:
        data_sets: The data, of at least two samples each.
        moments: Their moments.

    Raises:
        FitError: If there is one; the message names it.
    """
    up, down = (
        sum(np.count_nonzero(compare(data.raw[1:], data.raw[:-1]), axis=0) for data in data_sets)
        for compare in (np.greater, np.less)
    )
    one_way = (up + down >= _FEWEST) & (np.maximum(up, down) >= _ONE_WAY * (up + down))
    channels, load = _off_line(data_sets)
    straight = (channels < _STRAIGHT) & (load > _BENT)
    clocks = np.flatnonzero(one_way & (straight | (_explained(moments) < _FOLLOWS)))
    if len(clocks):
        channel = int(clocks[0])
        way = "rises" if up[channel] > down[channel] else "falls"
        raise FitError(
            f"channel ch{channel}, column {channel + 1} of {moments.channels} of the raw reading, {way} from sample to "
            "sample whatever the load does, as a clock or a counter; leave it out of the reading's columns"
        )


def _off_line(data_sets: Sequence[DataSet]) -> tuple[FloatArray, float]:
    """Share of their movement that channels, shape (c,), and the load have off a straight line in time."""
    moved, left = np.zeros((2, data_sets[0].raw.shape[1] + 6))
    for data in data_sets:
        time = np.arange(float(len(data.raw))) if data.time_s is None else data.time_s
        time = time - time.mean()
        values = np.hstack([data.raw, data.reference])
        values = values - values.mean(axis=0)
        square = np.einsum("ij,ij->j", values, values)
        moved += square
        left += np.maximum(square - (time @ values) ** 2 / max(time @ time, np.finfo(float).tiny), 0.0)
    load = [_share(left[-6:][part].sum(), moved[-6:][part].sum()) for part in FORCE_AND_MOMENT]
    return _share(left[:-6], moved[:-6]), float(min(load))


def _explained(moments: Moments) -> FloatArray:
    """Share of the movement of every channel that the reference explains; shape (c,)."""
    to_raw = moments.reference_raw
    square = np.einsum("ik,ij,jk->k", to_raw, symmetric_pseudo_inverse(moments.reference_reference), to_raw)
    return _share(square, np.diag(moments.raw_raw))


def _share(part: FloatArray, whole: FloatArray) -> FloatArray:
    """Of what does not move it is all."""
    return np.divide(part, whole, out=np.ones(np.shape(whole)), where=whole > 0.0)


_LARGEST_S = 0.5
"""Largest delay that is looked for."""

_FEWEST_LAGS = 2
"""Samples below which a delay is that of the logging itself."""

_BETTER = 0.8
"""Part of the residual's mean square that may be left without the delay for it to matter."""

_SHORTEST = 10
"""Length of a data set in largest delays, below which it is left out."""

_COARSE = 10
"""Steps in which the largest delay is searched before the best one's surroundings are, sample by sample."""


def delay_doubts(data_sets: Sequence[DataSet], prior: FloatArray | None) -> Iterator[Doubt]:
    """Look for the lag at which the reference explains most of the reading.

    Args:
        data_sets: The data; those without time stamps are left out.
        prior: Matrix that makes a force of the raw reading; shape (6, c); None to take the channels as they are.

    Yields:
        A doubt where a lag of at least two samples explains the reading clearly better than none.
    """
    timed = [data for data in data_sets if data.time_s is not None]
    long = [data for data in timed if data.time_s[-1] - data.time_s[0] > _SHORTEST * _LARGEST_S]
    if not long:
        return
    step = float(np.median(np.concatenate([np.diff(data.time_s) for data in long])))
    most = int(_LARGEST_S / step + EVEN) if step > 0.0 else 0
    if most < _FEWEST_LAGS:
        return
    even = [
        ResampledPair.of(
            data.time_s,
            data.raw if prior is None else data.raw @ prior[:3].T,
            data.reference,
            step_s=step,
            most=most,
        )
        for data in long
        if data.time_s is not None
    ]
    lag = _best_lag(even, most)
    if abs(lag) < _FEWEST_LAGS:
        return
    left = [
        float(m.left(m.lasting).sum())
        for m in (Movement.of([_at_lag(pair, at) for pair in even], None) for at in (0, lag))
    ]
    if left[1] < _BETTER * left[0]:
        yield Doubt(
            kind="delay",
            message=f"the reading comes {abs(lag) * step * 1e3:.0f} ms {'later' if lag > 0 else 'earlier'} than the "
            f"reference: moved by it, {1.0 - (left[1] / left[0]) ** 0.5:.0%} less of it is left unexplained; align "
            'their clocks by [[clock]], delay_s = "estimate" (columns of one table as two [[recording.stream]] of the '
            "same file; among arrays shift joint_time_s), or log both by one clock, and look for a delay between their "
            "ports",
        )


def _at_lag(pair: ResampledPair, lag: int) -> DataSet:
    return DataSet(label="", raw=pair.at_lag(lag).T, reference=pair.reference)


def _best_lag(even: Sequence[ResampledPair], most: int) -> int:
    """Lag, in samples, with the smallest residual of the reading regressed on the reference."""
    residual = residual_at_lags(even)

    def left(lag: int) -> float:
        return float(residual(lag).sum())

    width = max(most // _COARSE, 1)
    near = min(range(-(most // width) * width, most + 1, width), key=left)
    return min(range(max(near - width + 1, -most), min(near + width, most + 1)), key=left)


FEWEST = 20
"""Samples below which six components of a reference explain any reading."""


def examine(
    data_sets: Sequence[DataSet],
    prior: FloatArray | None,
    full_scale: FloatArray | None = None,
    *,
    setup: Setup = ROBOT,
) -> tuple[Doubt, ...]:
    """Judge whether readings can be those of a sensor under the modelled load, before anything is fitted to them.

    Offsets of data sets are no matter, nor are slow drifts and what linear variables explain.

    Args:
        data_sets: Stretches of calibration data of one sensor.
        prior: Matrix that the sensor is read by so far; shape (6, c); without it sign and scale cannot be judged.
        full_scale: Largest wrench that the sensor reads; shape (6,); N, N m; None if it is not known.
        setup: Where the data come from, which decides on what is common there and where to look for causes.

    Returns:
        What is doubtful; nothing where all is well. Of few samples it is only asked whether their load moves, which
        stays a doubt.

    Raises:
        FitError: If nothing may be fitted: the prior is singular, the model has no mass, its load stands still or is
            beyond the sensor, a channel is a clock, or the reading does not follow the load, or follows it the wrong
            way round or by a factor that no sensor has, in all or in its moments.
        ShapeError: If data sets, or data and prior, have different numbers of channels or variables.
    """
    measures_all = prior is None or not np.any(prior) or bool(measured_components(np.asarray(prior)).all())
    if prior is not None and np.shape(prior) == (6, 6) and measures_all and not is_invertible(prior):
        raise FitError("the prior matrix is singular, so no matrix corrects what it made")
    filled = [data for data in data_sets if len(data.raw)]
    if not filled:
        return ()  # the fit itself says what is missing
    usable = [data for data in filled if len(data.raw) > 1]  # one sample has no neighbour
    if sum(len(data.raw) for data in usable) < FEWEST:
        require_moving_load(_pooled(filled), setup)
        return (_too_few(sum(len(data.raw) for data in filled)),)
    moments = _pooled(usable)
    require_moving_load(moments, setup)
    require_gauges(usable, moments)
    if full_scale is not None:
        require_within_full_scale(usable, read_only(full_scale, name="full_scale", shape=(6,)))
    if prior is not None:
        prior = read_only(prior, name="prior", shape=(6, moments.channels))
    movement = Movement.of(usable, prior)
    doubts = [*span_doubts(movement, setup, has_prior=prior is not None)]
    if prior is not None:
        require_same_sign(movement, prior, setup)
        if measures_all:
            require_moment_unit(movement, setup)
        doubts += [*scale_doubts(movement, prior, setup), *axis_doubts(movement, prior, setup)]
    return (*doubts, *delay_doubts(usable, prior))


_REVERSED = -0.5
"""Gain below which a reading is the expected one with the other sign."""


def require_sense(data_sets: Sequence[DataSet], prior: FloatArray) -> None:
    """Refuse readings that follow the modelled load the wrong way round, about as large as it, and judge nothing else.

    Gravity that is turned, as by an IMU on another link, has a smaller negative gain, and other causes.

    Args:
        data_sets: Stretches of calibration data of one sensor.
        prior: Matrix that the sensor is read by so far; shape (6, c).

    Raises:
        FitError: If the force, or one axis of it, is opposite to the expected force.
    """
    usable = [data for data in data_sets if len(data.raw) > 1]
    if sum(len(data.raw) for data in usable) < FEWEST:
        return
    movement = Movement.of(usable, prior)
    if gains_of(movement, prior).overall < _REVERSED:
        require_same_sign(movement, prior)


def _pooled(data_sets: Sequence[DataSet]) -> Moments:
    return pooled(Moments.of(data.raw, data.reference, data.variables) for data in data_sets)


def _too_few(samples: int) -> Doubt:
    return Doubt(
        kind="span",
        message=f"{samples} samples are fitted, which do not tell whether the reading follows the load; fit a longer "
        "span, in which it moves",
    )
