# SPDX-License-Identifier: BSD-3-Clause
"""One sensor of a workbench: its fit, errors where it was not fitted, and what its loads leave open."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.calibration.generative.agreement import unmoved_directions
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.workbench.bench import Bench
from forcetorque.workbench.fit import BenchFit, fit_bench
from forcetorque.workbench.held_out import in_folds, one_by_one, rms, whole_series
from forcetorque.workbench.recording import BenchRecording
from forcetorque.workbench.result import BenchSensorRow, SeriesRow

_SWAPPED = 0.5
"""Error with forces and moments exchanged, over that as stated, below which they were exchanged."""
_SAMPLES = 10
"""Samples that a position counts for where neighbours are compared."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class FittedBench:
    """A sensor with its fit."""

    recording: BenchRecording
    """What it read."""
    row: BenchSensorRow
    """What its bench says of it, for people."""
    bench: Bench
    """Positions whose load and reading are known."""
    fitted: BenchFit | None
    """The fit; None where the loads do not tell a matrix."""
    series: tuple[SeriesRow, ...]
    """Series left out as a whole."""
    doubts: tuple[str, ...] = ()
    """What makes its data doubtful."""

    @property
    def matrix(self) -> FloatArray | None:
        """The matrix; shape (6, c); None where there is none."""
        return None if self.fitted is None else self.fitted.fit.model.matrix


def fit_recording(recording: BenchRecording, rng: np.random.Generator, *, with_series: bool) -> FittedBench:
    """Fit a sensor.

    Args:
        recording: What it read.
        rng: Source of the deals into folds.
        with_series: Whether whole series are left out, too, which takes a fit for each.

    Returns:
        The fit.

    Raises:
        ExperimentError: If nothing was read.
    """
    if recording.bench is None:
        raise ExperimentError(f"{recording.file}: expected readings at positions, there is none yet")
    bench = recording.bench.usable()
    _require_halves(bench, recording.file)
    unmoved = unmoved_directions(bench.loads.wrench, [len(bench)])
    fitted, reason = None, ""
    doubts: tuple[str, ...] = ()
    try:
        doubts = _implausible(bench) if len(unmoved) < len(WRENCH_COMPONENTS) else ()
        fitted = fit_bench(bench)
    except FitError as error:
        reason = str(error)
    held_out = None if fitted is None else one_by_one(fitted)
    folds = None if fitted is None else in_folds(fitted, rng)
    excitation = excitation_of(Moments.of(bench.raw, bench.loads.wrench))
    channels = tuple(f"ch{k}" for k in range(bench.raw.shape[1]))
    row = BenchSensorRow(
        file=recording.file,
        sensor=bench.sensor,
        serial=bench.serial,
        positions=len(bench),
        without_load=tuple(_not_known(recording.bench)),
        rank=6 - len(unmoved),
        unmoved=unmoved,
        unseen=excitation.describe_unexcited(channel_names=channels) if len(channels) > 6 else "",
        fitted=fitted is not None,
        reason=reason,
        held_out=held_out,
        folds_mean=None if folds is None else folds.mean(axis=0),
        folds_least=None if folds is None else folds.min(axis=0),
        folds_largest=None if folds is None else folds.max(axis=0),
        prior=None if bench.prior is None else rms(bench.read_by(bench.prior) - bench.loads.wrench),
        scatter="",
    )
    series: tuple[SeriesRow, ...] = ()
    if with_series and fitted is not None and held_out is not None:
        series = _series_rows(fitted, held_out)
    return FittedBench(recording=recording, row=row, bench=bench, fitted=fitted, series=series, doubts=doubts)


def _not_known(bench: Bench) -> Iterator[str]:
    """Positions that are not used, with the components that are missing where others are there."""
    for name, wrench, raw in zip(bench.loads.names, bench.loads.wrench, bench.raw, strict=True):
        missing = [c for c, known in zip(WRENCH_COMPONENTS, np.isfinite(wrench), strict=True) if not known]
        if 0 < len(missing) < len(WRENCH_COMPONENTS):
            yield f"{name} (no {', '.join(missing)})"
        elif missing or not np.isfinite(raw).all():
            yield name


def _series_rows(fitted: BenchFit, held_out: FloatArray) -> tuple[SeriesRow, ...]:
    rows: Sequence[tuple[str, FloatArray | str]] = tuple(whole_series(fitted).items())
    return tuple(
        SeriesRow(
            serial=fitted.bench.serial,
            series=name,
            error=None if isinstance(outcome, str) else rms(outcome),
            largest_force_N=None if isinstance(outcome, str) else float(np.linalg.norm(outcome[:, :3], axis=1).max()),
            ratio=float("nan") if isinstance(outcome, str) else float((rms(outcome) / held_out).max()),
            reason=outcome if isinstance(outcome, str) else "",
        )
        for name, outcome in rows
    )


def _implausible(bench: Bench) -> tuple[str, ...]:
    """What makes it doubtful that the readings are those of a sensor under the known loads, each position a block."""
    from forcetorque.calibration.plausibility.checks import examine
    from forcetorque.calibration.plausibility.setup import WORKBENCH

    blocks = DataSet(
        label=bench.serial,
        raw=np.repeat(bench.raw, _SAMPLES, axis=0),
        reference=np.repeat(bench.loads.wrench, _SAMPLES, axis=0),
    )
    return tuple(doubt.message for doubt in examine([blocks], bench.prior, setup=WORKBENCH))


def _require_halves(bench: Bench, file: str) -> None:
    """Refuse known wrenches whose forces and moments were exchanged, as far as a prior can tell."""
    if bench.prior is None:
        return
    read, known = bench.read_by(bench.prior), bench.loads.wrench
    sizes = np.repeat([max(float(np.abs(read[:, part]).max()), 1e-12) for part in FORCE_AND_MOMENT], 3)
    stated, exchanged = (float((((read - loads) / sizes) ** 2).sum()) for loads in (known, np.roll(known, 3, axis=1)))
    if exchanged < _SWAPPED**2 * stated:
        raise ExperimentError(
            f"{file}: expected known wrenches as force, then moment, got what the prior reads as moment, then force; "
            "exchange the columns of readings.known, or of readings.channels"
        )
