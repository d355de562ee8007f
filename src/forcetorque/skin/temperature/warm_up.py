# SPDX-License-Identifier: BSD-3-Clause
"""Learn from a recording without contact how each taxel follows the thermal pads while the robot warms up."""

from __future__ import annotations

from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, require_shape
from forcetorque.base.errors import SkinError
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.temperature.gains import HeatGains, require_pads
from forcetorque.skin.temperature.lags import lagged, means_of, pad_lags
from forcetorque.skin.temperature.pad_filter import PadFilter
from forcetorque.skin.temperature.pads import (
    LEAST_CHANGE_COUNTS,
    LEAST_SHARE,
    TaxelHeat,
    ThermalGain,
    WarmUp,
    followed_pads,
    sound_columns,
)

BLOCK_S: Final = 1.0
"""Time over which messages are averaged: noise falls, heat hardly changes."""
SHORTEST_S: Final = 180.0
"""Shortest warm-up: three of the minutes over which rates are taken."""
STEP_COUNTS: Final = 1.5
"""Change within 2 s that is no heat, which brings 0.1, but a contact; of a noisy taxel `STEP_SD` of its deviations."""
STEP_SD: Final = 6.0
UNEXPLAINED_COUNTS: Final = 2.5
"""What the pads may leave of a taxel: more, in two of them, is a slow contact, or heat that no lag explains."""
NOISE_SD: Final = 2.5
"""Standard deviations of a difference of two means that are not taken for what pads leave."""
_STEP_BLOCKS: Final = 2
_RATE_TENS: Final = 6
_SMOOTH_BLOCKS: Final = 10
_MEDIAN_OF_NORMAL: Final = 0.6745
"""Median of the size of a normal deviate of standard deviation 1."""
_FEWEST: Final = 2
"""Taxels that make a contact, as elsewhere."""


def fit_warm_up(experiment: str, seconds: FloatArray, counts: FloatArray, layout: SkinLayout) -> WarmUp:
    """Learn the gains.

    Args:
        experiment: Name of the experiment.
        seconds: Times of the messages, increasing; shape (k,); s.
        counts: Messages; shape (k, columns); counts.
        layout: The patch.

    Returns:
        What was learned, taxel by taxel.

    Raises:
        SkinError: If the patch has no thermal pads, none is alive or warms, or something touched it.
    """
    require_pads(layout)
    require_shape(counts, name="counts", shape=(len(seconds), layout.columns))
    if seconds[-1] - seconds[0] < SHORTEST_S:
        raise SkinError(
            f"expected a warm-up of at least {SHORTEST_S:g} s, got {seconds[-1] - seconds[0]:.0f} s; record from a "
            "cold start until the motors are warm"
        )
    instants, means = _block_means(seconds, counts)
    alive = _living_pads(layout, counts, means)
    sound = sound_columns(counts[:, layout.taxels])
    _refuse_steps(layout.taxels, instants, np.where(sound, means[:, layout.taxels], 0.0))
    follows = followed_pads(layout, alive)
    taxels, pads = means[:, layout.taxels], means[:, layout.thermal_pads]
    lags = np.zeros(len(alive))
    lags[alive] = pad_lags(
        instants, taxels, pads[:, alive], (follows & sound[:, None])[:, alive], averaged=_SMOOTH_BLOCKS
    )
    late = {lag: means_of(lagged(instants, taxels, max(lag, 0.0)), _SMOOTH_BLOCKS) for lag in np.unique(lags).tolist()}
    held = np.stack([lagged(instants, pad, max(-lag, 0.0)) for pad, lag in zip(pads.T, lags, strict=True)], axis=1)
    tens, slow_pads, slow = (
        means_of(instants, _SMOOTH_BLOCKS),
        means_of(held, _SMOOTH_BLOCKS),
        means_of(taxels, _SMOOTH_BLOCKS),
    )
    heat = [
        _taxel_heat(
            tens,
            slow[:, k],
            np.stack([late[lag][:, k] for lag in lags[own]], axis=1),
            slow_pads[:, own],
            layout.thermal_pads[own],
            lags[own],
        )
        if sound[k]
        else None
        for k, own in enumerate(follows)
    ]
    _refuse_unexplained(layout.taxels, tens, [None if one is None else one[1] for one in heat])
    learned = tuple(TaxelHeat() if one is None else one[0] for one in heat)
    learned = _with_unexplained(layout.taxels, instants, taxels, means, learned)
    return WarmUp(
        experiment=experiment,
        seconds=float(seconds[-1] - seconds[0]),
        pad_change_counts=float(np.median(_change(pads[:, alive]))),
        dead_pads=tuple(layout.thermal_pads[~alive].tolist()),
        taxels=learned,
    )


def _block_means(seconds: FloatArray, counts: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Means of a second, and their middles; gaps have none; shapes (b,) and (b, columns)."""
    block = ((seconds - seconds[0]) // BLOCK_S).astype(np.int64)
    starts = np.flatnonzero(np.diff(block, prepend=-1))
    number = np.diff(starts, append=len(block))
    means: FloatArray = np.add.reduceat(counts, starts, axis=0) / number[:, None]
    return np.add.reduceat(seconds, starts) / number, means


def _change(means: FloatArray) -> FloatArray:
    """How far each column goes, by means of ten seconds; shape (c,); counts."""
    return np.ptp(means_of(means, _SMOOTH_BLOCKS), axis=0)


def _living_pads(layout: SkinLayout, counts: FloatArray, means: FloatArray) -> BoolArray:
    """Thermal pads that are sound and follow the heat; shape (t,)."""
    sound = sound_columns(counts[:, layout.thermal_pads])
    if not sound.any():
        raise SkinError(
            f"thermal pads: expected one that is alive, got none of {len(sound)}: all are at a rail, jump or are "
            "noisy; look at the columns of the pads, and at the cable of the board"
        )
    change = _change(means[:, layout.thermal_pads])
    usual = float(np.median(change[sound]))
    if usual < LEAST_CHANGE_COUNTS:
        raise SkinError(
            f"thermal pads: expected to change by at least {LEAST_CHANGE_COUNTS:g} counts, got {usual:.1f} (the median "
            f"of {int(sound.sum())}): they never warm; record from a cold start until the motors are warm"
        )
    return sound & (change >= LEAST_SHARE * usual)


def _refuse_steps(columns: IntArray, instants: FloatArray, taxels: FloatArray) -> None:
    """Heat comes slowly; what comes within two seconds on two taxels is a contact."""
    step = taxels[_STEP_BLOCKS:] - taxels[:-_STEP_BLOCKS]
    usual = np.median(np.abs(step), axis=0) / _MEDIAN_OF_NORMAL
    steep = np.abs(step) > np.maximum(STEP_COUNTS, STEP_SD * usual)
    rows = np.flatnonzero(steep.sum(axis=1) >= _FEWEST)
    if len(rows):
        row = rows[0]
        worst = int(np.where(steep[row], np.abs(step[row]), 0.0).argmax())
        raise SkinError(
            f"expected a warm-up without contact, got {int(steep[row].sum())} taxels that change by over "
            f"{STEP_COUNTS:g} counts within {_STEP_BLOCKS} s at {instants[row]:.0f} s, taxel {columns[worst]} by "
            f"{step[row, worst]:.1f}: something touches the patch; let the interval end before, or record again"
        )


def _refuse_unexplained(columns: IntArray, instants: FloatArray, residuals: list[FloatArray | None]) -> None:
    """A contact that comes slowly is what the pads do not explain."""
    left = np.column_stack([np.zeros(len(instants)) if one is None else one for one in residuals])
    worst = np.abs(left).max(axis=0)
    unexplained = int(np.count_nonzero(worst > UNEXPLAINED_COUNTS))
    if unexplained >= _FEWEST:
        taxel = int(worst.argmax())
        when = instants[int(np.abs(left[:, taxel]).argmax())]
        raise SkinError(
            f"expected taxels that follow the thermal pads, got {unexplained} that differ by over "
            f"{UNEXPLAINED_COUNTS:g} counts, taxel {columns[taxel]} by {worst[taxel]:.1f} at {when:.0f} s: something "
            "touches the patch, or it was heated from outside; record again without"
        )


def _with_unexplained(
    columns: IntArray, instants: FloatArray, taxels: FloatArray, means: FloatArray, learned: tuple[TaxelHeat, ...]
) -> tuple[TaxelHeat, ...]:
    """Follow the pads as frames do, and keep what that leaves of each taxel beyond noise; too much is refused."""
    gains = HeatGains.learned(learned)
    pads = PadFilter(gains.lags)
    passed = np.diff(instants, prepend=instants[0])
    followed = [
        gains.fall(pads.follow(time, row))[0] for time, row in zip(passed.tolist(), means[:, gains.pads], strict=True)
    ]
    left = means_of(taxels - np.array(followed), _SMOOTH_BLOCKS)
    left = np.where(gains.told, left - left[0], 0.0)
    # a lag leaves the same share of the change of all taxels of a pad; their mean has less noise than each
    change = np.where(gains.told, np.ptp(np.array(followed), axis=0), 1.0)
    alike = (gains.follows[:, None] == gains.follows[None]).all(axis=2) & gains.told
    shared = (left / change) @ (alike / np.maximum(alike.sum(axis=1, keepdims=True), 1)).T * change
    worst = np.maximum(_beyond_noise(left), _beyond_noise(shared))
    if np.count_nonzero(worst > UNEXPLAINED_COUNTS) >= _FEWEST:
        taxel = int(worst.argmax())
        when = instants[_SMOOTH_BLOCKS * int(np.abs(left[:, taxel]).argmax())]
        raise SkinError(
            f"expected thermal pads that tell heat when taxels feel it, got pads that leave over "
            f"{UNEXPLAINED_COUNTS:g} counts of {np.count_nonzero(worst > UNEXPLAINED_COUNTS)} taxels, of taxel "
            f"{columns[taxel]} {worst[taxel]:.1f} at {when:.0f} s, with a lag of {np.median(gains.lags):.0f} s in the "
            "median: that would read as contacts; let the motors heat the patch more slowly, or use skin wrench "
            "without a warm-up"
        )
    return tuple(
        heat.model_copy(update={"unexplained_counts": float(counts)})
        for heat, counts in zip(learned, worst, strict=True)
    )


def _beyond_noise(left: FloatArray) -> FloatArray:
    """Largest of each column, less what noise from row to row makes of it; shape (n,)."""
    # a median, for what a lag leaves comes in a few rows
    noise = NOISE_SD / _MEDIAN_OF_NORMAL * np.median(np.abs(np.diff(left, axis=0)), axis=0)
    return np.sqrt(np.maximum((left**2).max(axis=0) - noise**2, 0.0))


def _taxel_heat(
    instants: FloatArray,
    taxel: FloatArray,
    late: FloatArray,
    pads: FloatArray,
    columns: IntArray,
    lags: FloatArray,
) -> tuple[TaxelHeat, FloatArray]:
    """Gains of one taxel, `late` as each of its pads, and what they leave of it; counts."""
    x = pads - pads.mean(axis=0)
    y = late - late.mean(axis=0)
    squares = (x**2).sum(axis=0)
    gains = (y * x).sum(axis=0) / squares
    left = (y - x * gains).mean(axis=1)
    misfit = float(np.sqrt(np.mean(left**2)))
    # what is left is slow, so that fewer of its means are independent
    likeness = float(np.clip(left[1:] @ left[:-1] / (left @ left), 0.0, 0.99))
    sd = misfit * np.sqrt((1.0 + likeness) / (1.0 - likeness) / squares)
    duration, change = (values[_RATE_TENS:] - values[:-_RATE_TENS] for values in (instants, taxel))
    return TaxelHeat(
        gains=tuple(
            ThermalGain(pad=int(column), gain=float(gain), sd=float(error), lag_s=float(lag))
            for column, gain, error, lag in zip(columns, gains, sd, lags, strict=True)
        ),
        misfit_counts=misfit,
        rate_counts_per_s=float(np.abs(change / duration).max()),
    ), left
