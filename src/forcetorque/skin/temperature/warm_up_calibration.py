# SPDX-License-Identifier: BSD-3-Clause
"""How taxels follow thermal pads, estimated from a recording of a warm-up without contact."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated, Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, require_shape
from forcetorque.base.errors import ExperimentError, SkinError
from forcetorque.experiment.named_files import stated_in
from forcetorque.experiment.recording_notes import added_to
from forcetorque.recording.recording import Use
from forcetorque.results.table import Row, Shown
from forcetorque.skin.contact.contact_tracking import FASTER
from forcetorque.skin.layout.formats.registry import describe_patch
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.layout.normals import rebuilt_normals
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.section import load_patches
from forcetorque.skin.temperature.pad_lags import PadFilter, lagged, means_of, pad_lags
from forcetorque.skin.temperature.taxel_temperature_drift import (
    LEAST_CHANGE_COUNTS,
    LEAST_SHARE,
    HeatGains,
    TaxelHeat,
    ThermalGain,
    WarmUp,
    followed_pads,
    require_pads,
    valid_columns,
)
from forcetorque.skin.wrench.pressures_over_recording import patch_messages

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
        What was estimated, taxel by taxel.

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
    valid = valid_columns(counts[:, layout.taxels])
    _refuse_steps(layout.taxels, instants, np.where(valid, means[:, layout.taxels], 0.0))
    follows = followed_pads(layout, alive)
    taxels, pads = means[:, layout.taxels], means[:, layout.thermal_pads]
    lags = np.zeros(len(alive))
    lags[alive] = pad_lags(
        instants, taxels, pads[:, alive], (follows & valid[:, None])[:, alive], averaged=_SMOOTH_BLOCKS
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
        if valid[k]
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
    """Thermal pads that are valid and follow the heat; shape (t,)."""
    valid = valid_columns(counts[:, layout.thermal_pads])
    if not valid.any():
        raise SkinError(
            f"thermal pads: expected one that is alive, got none of {len(valid)}: all are at a rail, jump or are "
            "noisy; look at the columns of the pads, and at the cable of the board"
        )
    change = _change(means[:, layout.thermal_pads])
    usual = float(np.median(change[valid]))
    if usual < LEAST_CHANGE_COUNTS:
        raise SkinError(
            f"thermal pads: expected to change by at least {LEAST_CHANGE_COUNTS:g} counts, got {usual:.1f} (the median "
            f"of {int(valid.sum())}): they never warm; record from a cold start until the motors are warm"
        )
    return valid & (change >= LEAST_SHARE * usual)


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
    left = np.where(gains.has_pad, left - left[0], 0.0)
    # a lag leaves the same share of the change of all taxels of a pad; their mean has less noise than each
    change = np.where(gains.has_pad, np.ptp(np.array(followed), axis=0), 1.0)
    alike = (gains.follows[:, None] == gains.follows[None]).all(axis=2) & gains.has_pad
    shared = (left / change) @ (alike / np.maximum(alike.sum(axis=1, keepdims=True), 1)).T * change
    worst = np.maximum(_beyond_noise(left), _beyond_noise(shared))
    if np.count_nonzero(worst > UNEXPLAINED_COUNTS) >= _FEWEST:
        taxel = int(worst.argmax())
        when = instants[_SMOOTH_BLOCKS * int(np.abs(left[:, taxel]).argmax())]
        raise SkinError(
            f"expected thermal pads that measure the heat of the taxels, got pads that leave over "
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


UNEXPLAINED: Final = 0.5
"""What pads may leave of a taxel unsaid: half of what wakes it in frames of ten messages; counts."""


class WarmUpRow(Row):
    """A warm-up, and what was learned of it."""

    experiment: Annotated[str, Shown("warm-up")]
    """Name of the experiment."""
    minutes: Annotated[float, Shown("length", "min", digits=1)]
    """Its length."""
    pads: Annotated[int, Shown("pads")]
    """Thermal pads that taxels follow."""
    dead_pads: Annotated[int, Shown("dead")]
    """Thermal pads that show nothing."""
    pad_change_counts: Annotated[float, Shown("pads change", "counts", digits=1)]
    """Median change of the living ones."""
    taxels: Annotated[int, Shown("taxels")]
    """Taxels with gains."""
    gain: Annotated[float, Shown("gain", digits=2)]
    """Median of their gains; 1 is the rule of the firmware."""
    gain_sd: Annotated[float, Shown("spread", digits=2)]
    """Standard deviation of them from taxel to taxel."""
    misfit_counts: Annotated[float, Shown("misfit", "counts", digits=2)]
    """Median of what the pads leave of a taxel's change."""
    lag_s: Annotated[float, Shown("lag", "s", digits=1)]
    """Median lag of pads behind taxels; negative where they lead."""
    unexplained_counts: Annotated[float, Shown("unexplained", "counts", digits=1)]
    """Most that pads, followed as they come, leave of a taxel."""
    rate_counts_per_min: Annotated[float, Shown("rate", "counts/min", digits=1)]
    """Median of their steepest changes, from which limits of drift are determined."""


def learn_warm_up(
    experiment: Path | str | PatchExperiment, patch: ExperimentPatch
) -> tuple[WarmUp, tuple[str, ...], dict[str, str]]:
    """Read a warm-up and learn the gains of a patch.

    Args:
        experiment: Experiment file with the patch and its layout, or what was read of it; its one interval for
            calibration is the warm-up.
        patch: The patch that is calibrated.

    Returns:
        What was estimated, warnings and what the file adds to its log, and the SHA-256 of its input files.

    Raises:
        ExperimentError: If it is another patch, its layout is not specified, or its interval is not.
    """
    content = load_patches(experiment) if isinstance(experiment, (Path, str)) else experiment
    own = content.patch(patch.name)
    with stated_in(f"{content.file}: patch {own.name!r}: warm-up"):
        same = (own.serial, own.columns) == (patch.serial, patch.columns)
        if not same or not np.array_equal(own.taxels, patch.taxels):
            raise ExperimentError(
                f"expected the patch that is calibrated, with serial {patch.serial!r} and {len(patch.taxels)} taxels "
                f"in {patch.columns} columns, got {own.serial!r} with {len(own.taxels)} in {own.columns}"
            )
        if own.layout is None:
            raise ExperimentError("layout: expected the file that says which columns are thermal pads, got none")
        seconds, counts = patch_messages(content, own)
        chosen = _warming(content, seconds)
        described = describe_patch(own.layout)
        layout = described.layout(rebuilt_normals(described.positions, described.modules))
        learned = fit_warm_up(content.name, seconds[chosen], counts[chosen], layout)
    added = tuple(f"warm-up {content.name!r}: {sentence}" for sentence in added_to(content.recording))
    return (
        learned,
        (*_warnings(learned, own), *added),
        {f"{content.name}: {k}": v for k, v in content.inputs_sha256.items()},
    )


def _warming(content: PatchExperiment, seconds: np.ndarray) -> np.ndarray:
    """Messages of the one interval for calibration."""
    used = [interval for interval in content.intervals if interval.use is Use.CALIBRATION]
    if len(used) != 1:
        raise ExperimentError(f'expected one interval with use = "calibration", the warm-up, got {len(used)}')
    (interval,) = used
    stamps = content.recording.start_ns + np.rint(1e9 * seconds).astype(np.int64)
    chosen = interval.holds(stamps)
    if np.count_nonzero(chosen) < 2:
        raise ExperimentError(f"interval {interval.label!r}: expected messages, got none")
    return chosen


def _warnings(learned: WarmUp, patch: ExperimentPatch) -> tuple[str, ...]:
    """What is missing of the gains."""
    without = [int(column) for column, heat in zip(patch.taxels, learned.taxels, strict=True) if not heat.gains]
    warnings = []
    if learned.dead_pads:
        warnings.append(
            f"{len(learned.dead_pads)} thermal pads are dead ({_listed(learned.dead_pads)}): their taxels follow the "
            "other pad of the module, or those of the nearest module with one"
        )
    if without:
        warnings.append(
            f"{len(without)} taxels were not valid in the warm-up ({_listed(without)}): they have no gain, and are "
            "left out where heat is taken out by gains"
        )
    lags = HeatGains.learned(learned.taxels).lags
    if np.any(lags):
        late, early = int(np.count_nonzero(lags > 0.0)), int(np.count_nonzero(lags < 0.0))
        warnings.append(
            f"{late} of {len(lags)} thermal pads feel heat later than their taxels and {early} sooner, by "
            f"{np.median(lags):+.0f} s in the median: this is made up for once a trend is seen, not when heat begins"
        )
    unexplained = np.array([heat.unexplained_counts for heat in learned.taxels])
    many = int(np.count_nonzero(unexplained > UNEXPLAINED))
    if many > 1:
        warnings.append(
            f"thermal pads leave over {UNEXPLAINED:g} counts of {many} of {len(unexplained)} taxels unexplained when "
            f"heat comes, at most {unexplained.max():.1f}: less than {FASTER:g} times that wakes no taxel, and "
            f"heat that comes more than {FASTER:g} times as fast reads as contacts"
        )
    return tuple(warnings)


def _listed(columns: tuple[int, ...] | list[int], most: int = 8) -> str:
    more = ", ..." if len(columns) > most else ""
    return ", ".join(map(str, columns[:most])) + more


def warm_up_row(learned: WarmUp) -> WarmUpRow:
    """Sum a warm-up up.

    Args:
        learned: What was estimated.

    Returns:
        Its row.
    """
    taxels = [heat for heat in learned.taxels if heat.gains]
    gains = np.array([np.mean([gain.gain for gain in heat.gains]) for heat in taxels])
    rates = [heat.rate_counts_per_s for heat in taxels if heat.rate_counts_per_s is not None]
    return WarmUpRow(
        experiment=learned.experiment,
        minutes=learned.seconds / 60.0,
        pads=len(HeatGains.learned(learned.taxels).pads),
        dead_pads=len(learned.dead_pads),
        pad_change_counts=learned.pad_change_counts,
        taxels=len(taxels),
        gain=float(np.median(gains)),
        gain_sd=float(gains.std()),
        misfit_counts=float(np.median([heat.misfit_counts for heat in taxels])),
        lag_s=float(np.median(HeatGains.learned(learned.taxels).lags)),
        unexplained_counts=max(heat.unexplained_counts for heat in taxels),
        rate_counts_per_min=60.0 * float(np.median(rates)),
    )
