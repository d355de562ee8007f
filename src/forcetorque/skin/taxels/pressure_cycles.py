# SPDX-License-Identifier: BSD-3-Clause
"""What was recorded of a patch under pressure: every used interval, where it rests, loads and unloads."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import numpy as np

from forcetorque.base.arrays import ArrayRecord, BoolArray, FloatArray, array, require_shape
from forcetorque.base.errors import ExperimentError, SkinError
from forcetorque.experiment.intervals import RecordedSpan
from forcetorque.experiment.named_files import stated_in
from forcetorque.recording.alignment import interpolate, seconds_since, usable_samples
from forcetorque.recording.recording import Use
from forcetorque.skin.patches_of_experiment import ExperimentPatch, PatchExperiment
from forcetorque.skin.taxels.taxel_faults import TaxelFault, require_counts, taxel_faults

REST_SHARE = 0.03
"""Share of the highest pressure below which a patch rests."""
TURN_SHARE = 0.05
"""Share of the highest pressure by which it must turn back to have turned; less is the valve."""
TOP_SHARE = 0.9
"""Share of the highest pressure from which on samples show how a taxel reads there."""
LEAST_RISE_PA = 1e3
"""A pressure that changes by less does not rise: one count of a taxel is about 8 kPa; Pa."""

ONSET_SHARE = 0.001
"""Share of the highest pressure above its rest from which on the pressure has begun to rise, where noise allows it."""
ONSET_SD = 5.0
"""The same over the standard deviation of the smoothed pressure at rest, where noise is larger."""

MOST_IN_BAG_PA = 110e3
"""A vacuum bag presses at most with the pressure of the air around it; Pa."""
_REST_ROWS = 20
"""Messages at rest that a rest level needs: their mean then is good to 0.15 counts."""
_SMOOTH_ROWS = 25
"""Rows of a median that takes single wrong readings of the pressure away."""
_REST_QUANTILE = 0.1
"""Share of the messages before the rise that must be at rest: a first step of pressure may last longer than rest."""
_MEDIAN_OF_NORMAL = 0.6745
"""Median of the size of a normal deviate of standard deviation 1."""
_SD_OF_MEDIAN = 1.2533
"""Standard deviation of a median of many normal deviates, over that of their mean."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PressureCycle(ArrayRecord):
    """Counts and pressure of one recording, both from their rest level in it."""

    fall: FloatArray = field(metadata=array("n", "c"))
    """Counts below rest; shape (n, c)."""
    pressure: FloatArray = field(metadata=array("n"))
    """Pressure above that at rest; shape (n,); Pa."""
    unloading: BoolArray = field(metadata=array("n", dtype="bool"))
    """Whether the pressure came down to a sample, and did not go up to it; shape (n,)."""
    rest: FloatArray = field(metadata=array("c"))
    """Rest level of each column; shape (c,); counts."""
    rest_pressure: float
    """Reading of the pressure at rest; Pa."""

    @property
    def highest(self) -> float:
        """Highest pressure; Pa."""
        return float(self.pressure.max())

    @property
    def top_fall(self) -> FloatArray:
        """Mean fall of each column near the highest pressure; shape (c,); counts."""
        return self.fall[self.pressure >= TOP_SHARE * self.highest].mean(axis=0)


def pressure_cycle(counts: FloatArray, pressure: FloatArray, *, in_bag: bool = False) -> PressureCycle:
    """Split a recording of pressure on a patch into rest, loading and unloading.

    The rest level is that of this recording, before the pressure first rises: it moves from one to the next with
    temperature and creep. The pressure counts from its own rest too, for gauges read some hundredths of a bar there.
    The rise begins where the pressure leaves the noise of its rest, so that no sample of it is taken for rest.

    Args:
        counts: Counts, a row per message; shape (n, c).
        pressure: Reading of the gauge at the same instants; shape (n,); Pa.
        in_bag: Whether the gauge is inside a vacuum bag, and falls by what presses on the patch.

    Returns:
        The recording from rest.

    Raises:
        SkinError: If a message is all zero or has gaps, or the pressure never rises, only rises, or does not begin at
            rest; the other way round in a bag.
    """
    require_shape(pressure, name="pressure", shape=(len(counts),))
    require_counts(counts)
    sign, rises, falls = (-1.0, "falls", "rises") if in_bag else (1.0, "rises", "falls")
    pressure = sign * pressure
    smooth = _median_filtered(pressure)
    lowest, highest = float(smooth.min()), float(smooth.max())
    resting, pressing = round(sign * lowest), round(sign * highest)
    if highest - lowest < LEAST_RISE_PA:
        raise SkinError(
            f"expected a pressure that {rises} by at least {LEAST_RISE_PA:g} Pa, got {resting} to {pressing} Pa: "
            f"it never {rises}; is the unit right?"
        )
    swing = highest - lowest
    if float(np.median(smooth[:_REST_ROWS])) > highest - REST_SHARE * swing:
        remedy = (
            "leave out pressure_of of [[patch]] where the gauge is that of a chamber"
            if in_bag
            else 'is the gauge inside a vacuum bag? Then state pressure_of = "bag" in [[patch]]'
        )
        raise SkinError(
            f"expected a pressure that {rises} from rest, got one that {falls} from {pressing} to {resting} Pa; "
            f"{remedy}"
        )
    start = _onset(pressure, smooth, swing, int(np.argmax(smooth > lowest + REST_SHARE * swing)))
    if start < _REST_ROWS:
        raise SkinError(
            f"expected at least {_REST_ROWS} messages at rest before the pressure {rises}, got {start}: the rest level "
            "is taken anew in each recording; begin the interval earlier, or record a longer rest"
        )
    unloading = _unloading(smooth, TURN_SHARE * swing)
    if not unloading.any():
        raise SkinError(
            f"expected a pressure that {rises} and {falls}, got one that only {rises}, to {pressing} Pa: without "
            "unloading nothing is known of hysteresis; let the interval go on until the pressure is let out"
        )
    rest = counts[:start].mean(axis=0)
    rest_pressure = float(pressure[:start].mean())
    return PressureCycle(
        fall=rest - counts,
        pressure=pressure - rest_pressure,
        unloading=unloading,
        rest=rest,
        rest_pressure=sign * rest_pressure,
    )


def _onset(pressure: FloatArray, smooth: FloatArray, swing: float, risen: int) -> int:
    """First row of the rise, given one that is well within it; all rows before it rest."""
    step = np.diff(pressure[:risen])
    noise = float(np.median(np.abs(step - np.median(step)))) / (_MEDIAN_OF_NORMAL * np.sqrt(2.0)) if len(step) else 0.0
    tolerance = max(ONSET_SHARE * swing, ONSET_SD * noise * _SD_OF_MEDIAN / np.sqrt(_SMOOTH_ROWS))
    # a low quantile of the rows before is the level of rest as soon as enough of them rest; rows above that by more
    # than noise are no rest, and are left out until none is left over
    while risen:
        resting = smooth[:risen] <= np.quantile(smooth[:risen], _REST_QUANTILE) + tolerance
        onset = int(np.flatnonzero(resting)[-1]) + 1
        if onset == risen:
            break
        risen = onset
    return risen


def _median_filtered(values: FloatArray) -> FloatArray:
    padded = np.pad(values, _SMOOTH_ROWS // 2, mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, _SMOOTH_ROWS)
    return np.median(windows, axis=1)


def _unloading(pressure: FloatArray, turn: float) -> BoolArray:
    """Whether each sample comes after a highest point, and before the next lowest one, which differ by `turn`."""
    unloading = np.zeros(len(pressure), dtype=bool)
    down, extreme, place = False, pressure[0], 0
    for k, value in enumerate(pressure.tolist()):
        if (value < extreme) if down else (value > extreme):
            extreme, place = value, k
        elif abs(value - extreme) > turn:
            down, extreme = not down, value
            unloading[place:] = down
            place = k
    return unloading


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PatchRecording:
    """One interval with a patch under pressure."""

    experiment: str
    """Name of the experiment."""
    label: str
    """Label of the interval."""
    use: Use
    """Whether it is for calibration or validation."""
    seconds: FloatArray
    """Instants since the start of the recording; shape (n,); s."""
    cycle: PressureCycle
    """Counts and pressure from rest, a column per taxel."""
    faults: tuple[tuple[TaxelFault, ...], ...]
    """What is wrong with each taxel here."""

    @property
    def valid(self) -> BoolArray:
        """Taxels with which nothing is wrong; shape (c,)."""
        return np.array([not reasons for reasons in self.faults])


def patch_recordings(experiment: PatchExperiment, patch: ExperimentPatch) -> list[PatchRecording]:
    """Read every interval of an experiment that is not ignored.

    Args:
        experiment: The experiment.
        patch: One of its patches.

    Returns:
        A recording per interval.

    Raises:
        ExperimentError: If the file does not say which stream is the pressure.
    """
    if patch.pressure is None:
        raise ExperimentError(
            f"{experiment.file}: patch {patch.name!r}: expected pressure, the stream with the pressure of the chamber "
            "or bag, got none"
        )
    used = [interval for interval in experiment.intervals if interval.use is not Use.IGNORE]
    recordings = []
    for interval in used:
        with stated_in(f"{experiment.file}: patch {patch.name!r}: interval {interval.label!r}"):
            recordings.append(_recording(experiment, patch, patch.pressure, interval))
    return recordings


def _recording(
    experiment: PatchExperiment, patch: ExperimentPatch, pressure: str, interval: RecordedSpan
) -> PatchRecording:
    stream = experiment.recording.stream(patch.counts)
    chamber = experiment.recording.stream(pressure)
    usable = usable_samples(stream.stamp_ns)
    rows = usable[interval.holds(stream.stamp_ns[usable])]
    at = interpolate(chamber, chamber.signal("pressure").values, stream.stamp_ns[rows])[:, 0]
    whole = stream.signal("taxel_counts").values
    measured = np.isfinite(at) & np.isfinite(whole[rows]).all(axis=1)
    rows, at = rows[measured], at[measured]
    if len(rows) < 2:
        raise SkinError("expected messages with a pressure, got none; do both streams cover the interval?")
    message = whole[rows]
    require_counts(message, where=repr(patch.counts), rows=rows)
    counts = message[:, patch.taxels]
    cycle = pressure_cycle(counts, at, in_bag=patch.in_bag)
    if patch.in_bag and cycle.highest > MOST_IN_BAG_PA:
        raise SkinError(
            f"pressure_of: expected a bag that is at most emptied, {MOST_IN_BAG_PA:g} Pa below rest, got "
            f"{cycle.highest:.0f} Pa; is the unit right?"
        )
    return PatchRecording(
        experiment=experiment.name,
        label=interval.label,
        use=interval.use,
        seconds=seconds_since(stream.stamp_ns[rows], experiment.recording.start_ns),
        cycle=cycle,
        faults=taxel_faults(counts, cycle.top_fall),
    )


def same_patch(experiments: Sequence[PatchExperiment], name: str | None) -> list[ExperimentPatch]:
    """Find one patch in several experiments.

    Args:
        experiments: Experiments.
        name: Name of the patch; None for the only one.

    Returns:
        The patch in each.

    Raises:
        ExperimentError: If it is not the same patch in all.
    """
    patches = [experiment.patch(name) for experiment in experiments]
    first = patches[0]
    for experiment, patch in zip(experiments, patches, strict=True):
        same = (patch.name, patch.serial, patch.columns) == (first.name, first.serial, first.columns)
        if not same or not np.array_equal(patch.taxels, first.taxels):
            raise ExperimentError(
                f"{experiment.file}: expected the patch {_description(first)} of {experiments[0].file}, got "
                f"{_description(patch)}; every patch has its own curves"
            )
    return patches


def _description(patch: ExperimentPatch) -> str:
    serial = "" if patch.serial is None else f" ({patch.serial})"
    return f"{patch.name!r}{serial} with {len(patch.taxels)} taxels in {patch.columns} columns"


def of_use(recordings: Iterable[PatchRecording], use: Use) -> list[PatchRecording]:
    """Choose the recordings of one use.

    Args:
        recordings: Recordings.
        use: The use.

    Returns:
        Those with it.
    """
    return [recording for recording in recordings if recording.use is use]
