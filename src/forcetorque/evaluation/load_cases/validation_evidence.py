# SPDX-License-Identifier: BSD-3-Clause
"""What validation data show at a load case: measured errors, motion, and the comparison with the prior matrix."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Annotated, Literal

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.base.noise.paired_comparison import Conclusion, ErrorRatio, PairedErrors, compare_errors
from forcetorque.base.noise.window_means import joined_times, mean_error, means_of_parts
from forcetorque.base.rows_on_disk import in_blocks, mean_over_rows
from forcetorque.base.wrench import FORCE, FORCE_AND_MOMENT, MOMENT
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.excitation import hardly_moved
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.evaluated_wrenches import EvaluatedWrenches, evaluated_wrenches
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import Row, Shown, ShownWrench


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredError:
    """Error of one quantity, force or moment, on validation data."""

    constant: float
    """Norm of the mean error in the session in which it is largest; N or N m."""
    constant_at_least: float
    """What is left of a mean error, at most, when the half-width of its 95 % interval is taken off."""
    rest: float
    """Root mean square of what is left without the means; N or N m."""
    rest_at_least: float
    """Lower end of its 95 % interval; 0 where there are too few data."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Evidence:
    """What one candidate measured on validation data, against what mechanics demands there."""

    force: MeasuredError
    """Of the force; N."""
    moment: MeasuredError
    """Of the moment; N m."""
    reference: FloatArray
    """The reference, in means of a second; shape (n, 6); N, N m."""
    moved: FloatArray
    """The reference about its mean in each session; shape (n, 6); N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SecondMeans:
    """Errors of one calibration in a recording, or in the samples of one power cycle, in means of a second."""

    session: str
    """Name of the session."""
    time_s: FloatArray
    """Mean instants, not falling; shape (n,); s."""
    error: FloatArray
    """Mean errors; shape (n, 6); N, N m."""
    reference: FloatArray
    """Mean expected wrenches; shape (n, 6); N, N m."""

    @classmethod
    def of(cls, session: str, parts: Iterable[tuple[FloatArray, FloatArray, FloatArray]]) -> SecondMeans:
        """Average the errors of consecutive samples of one session in a recording.

        Args:
            session: Name of the session.
            parts: Instants, not falling, shape (n,), in s; measured minus expected readings and expected wrenches,
                shape (n, 6), in N and N m; at least one sample in all.

        Returns:
            The same segment in means of a second, with their mean instants.
        """
        time_s, means, _ = means_of_parts((time, np.hstack([error, load])) for time, error, load in parts)
        return cls(session=session, time_s=time_s, error=means[:, :6], reference=means[:, 6:])


def evidence(stretches: Sequence[SecondMeans]) -> Evidence:
    """Compute the errors of one calibration in any number of recordings.

    Args:
        stretches: What it measured in each, at least one.

    Returns:
        The errors. The constant part is that of the session in which it is largest: of two that cancel each other
        either would hurt. What is left is about the mean of each session.
    """
    instants, errors, references = [], [], []
    in_session = sorted(stretches, key=lambda stretch: stretch.session)
    for _, group in groupby(in_session, key=lambda stretch: stretch.session):
        session = list(group)
        instants.append(joined_times([one.time_s for one in session]))
        errors.append(np.concatenate([one.error for one in session]))
        references.append(np.concatenate([one.reference for one in session]))
    line = joined_times(instants)
    left, moved = (np.concatenate([own - own.mean(axis=0) for own in parts]) for parts in (errors, references))
    squares = np.column_stack([(left[:, part] ** 2).sum(axis=1) for part in FORCE_AND_MOMENT])
    widths = mean_error(squares, line).half_width
    constants = [
        (own.mean(axis=0), mean_error(own, time).half_width) for time, own in zip(instants, errors, strict=True)
    ]
    force, moment = (
        _measured(
            [(float(np.linalg.norm(mean[part])), float(np.linalg.norm(width[part]))) for mean, width in constants],
            squares[:, k],
            float(widths[k]),
        )
        for k, part in enumerate(FORCE_AND_MOMENT)
    )
    return Evidence(
        force=force,
        moment=moment,
        reference=np.concatenate(references),
        moved=moved,
    )


def _measured(constants: Sequence[tuple[float, float]], square: FloatArray, square_half_width: float) -> MeasuredError:
    rest = float(square.mean())
    least = rest - square_half_width
    return MeasuredError(
        constant=max(size for size, _ in constants),
        constant_at_least=max(max(size - half_width, 0.0) for size, half_width in constants),
        rest=float(np.sqrt(rest)),
        rest_at_least=float(np.sqrt(least)) if least > 0.0 else 0.0,
    )


def evidence_by_calibration(campaign: Campaign, calibrations: Mapping[str, Calibration]) -> dict[str, Evidence]:
    """Compute the errors of every calibration on the validation intervals of all recordings.

    Args:
        campaign: The sensor in any number of recordings.
        calibrations: Its calibrations by name, which were not fitted on these intervals.

    Returns:
        Evidence by name of the calibration; none where no recording has such an interval.
    """
    stretches: dict[str, list[SecondMeans]] = {name: [] for name in calibrations}
    for run in campaign.runs:
        if not run.has(Use.VALIDATION):
            continue
        judged = evaluated_wrenches(run, calibrations)
        sessions: dict[str, list[slice]] = {}
        for label, samples in judged.intervals:
            sessions.setdefault(campaign.session(run, label), []).append(samples)
        # the calibrations come last: a prior may have the name of one
        measured = dict(judged.measured[-len(calibrations) :])
        for name, parts in stretches.items():
            for session, intervals in sessions.items():
                parts.append(SecondMeans.of(session, _errors(judged, measured[name], intervals)))
    return {name: evidence(parts) for name, parts in stretches.items() if parts}


def _errors(
    judged: EvaluatedWrenches, measured: FloatArray, intervals: Sequence[slice]
) -> Iterator[tuple[FloatArray, FloatArray, FloatArray]]:
    """Instants, errors and loads of intervals, block by block."""
    for samples in intervals:
        columns = (values[samples] for values in (judged.time_s, measured, judged.reference, judged.load))
        for time_s, wrench, reference, load in in_blocks(*columns):
            yield time_s, wrench - reference, load


MovedAndLoad = tuple[float, float]
"""Standard deviation of a load in the validation data, all three components together, and its size; N or N m."""


def validation_excitation(
    reference: FloatArray, calibrations: Iterable[Calibration], *, moved: FloatArray | None = None
) -> tuple[MovedAndLoad, MovedAndLoad]:
    """Compute how much the loads of validation data moved, and how large loads are.

    Args:
        reference: Expected wrenches of the validation samples; shape (n, 6); N, N m.
        calibrations: Calibrations under test, for the loads that they were fitted to.
        moved: The same about their means in each of several recordings; shape (n, 6); about one mean if left out.

    Returns:
        Movement and size of the force, then of the moment. The size is the larger of the root mean square of the
        validation loads and the standard deviation of the fitted ones.
    """
    loads = reference if moved is None else moved
    mean = mean_over_rows(np.asarray, loads)
    variance = mean_over_rows(lambda block: (block - mean) ** 2, loads)
    square = mean_over_rows(lambda block: block**2, reference)
    return moved_and_load(np.sqrt(variance), np.sqrt(square), calibrations)


def moved_and_load(
    moving: FloatArray, load: FloatArray, calibrations: Iterable[Calibration]
) -> tuple[MovedAndLoad, MovedAndLoad]:
    """Compute the same from statistics of the expected wrenches.

    Args:
        moving: Their standard deviations; shape (6,); N, N m.
        load: Their root mean squares; shape (6,); N, N m.
        calibrations: As of `validation_excitation`.

    Returns:
        As of `validation_excitation`.
    """
    loads = [load, *(calibration.validity.expected_wrench_sd for calibration in calibrations)]
    force, moment = (
        (float(np.linalg.norm(moving[part])), max(float(np.linalg.norm(one[part])) for one in loads))
        for part in FORCE_AND_MOMENT
    )
    return force, moment


def static_loads_text(force: MovedAndLoad, moment: MovedAndLoad) -> str | None:
    """State that loads hardly moved while errors were measured.

    Args:
        force: Movement and size of the force; N.
        moment: Movement and size of the moment; N m.

    Returns:
        The text; None where both moved.
    """
    kinds = {"forces": (*force, "N"), "moments": (*moment, "N m")}
    static = {kind: sizes for kind, sizes in kinds.items() if hardly_moved(sizes[0], sizes[1])}
    if not static:
        return None
    of = ", ".join(f"{moved:.2g} {unit} of {load:.2g} {unit}" for moved, load, unit in static.values())
    what = "loads" if len(static) == len(kinds) else next(iter(static))
    wrong = "a wrong matrix" if what == "loads" else f"a matrix that is wrong for {what}"
    return f"the {what} hardly moved in the validation samples ({of}): {wrong} would show nothing"


def fewest_independent(components: Iterable[FloatArray], time_s: FloatArray) -> float | None:
    """Count the independent samples that errors are worth, of the component that is worth the fewest.

    Args:
        components: Errors of every component in the order of time; shape (n,) each; N, N m; NaN in gaps.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        The number; None where no component changes.
    """
    counts = [autocorrelation(component, time_s).effective_count for component in components]
    return min((count for count in counts if np.isfinite(count)), default=None)


def errors_by_component(measured: FloatArray, reference: FloatArray) -> Iterator[FloatArray]:
    """Give errors, one component after the other.

    Args:
        measured: Wrenches; shape (n, 6); N, N m.
        reference: Wrenches that mechanics demands; shape (n, 6); N, N m.

    Yields:
        Measured minus reference of each component; shape (n,); N or N m.
    """
    for component in range(measured.shape[1]):
        yield np.concatenate([one[:, component] - other[:, component] for one, other in in_blocks(measured, reference)])


Quantity = Literal["force", "moment"]

OFFSET_WORDS = {
    Offset.FITTED: "its own offset",
    Offset.FIRST_SECOND: "the offset of the first second",
    Offset.JUDGED_MEAN: "the mean of the validation samples removed",
    Offset.NONE: "no offset removed",
}
"""The offsets in sentences."""

_WIDEST = 10.0
"""Upper over lower end of an interval beyond which it is said in words."""


class ErrorComparison(Row):
    """Errors of a candidate over those of another on the same samples, as norms."""

    calibration: Annotated[str, Shown("calibration", file=True)]
    """The calibration file, or the prior."""
    offset: Annotated[Offset, Shown("offset")]
    """Which offset they are evaluated with."""
    quantity: Annotated[Quantity, Shown("error of")]
    """What the errors are of."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Unit of the errors."""
    samples: int
    """Number of validation samples."""
    mean: Annotated[float, Shown("mean", digits=3)]
    """Mean norm of the error with the candidate."""
    ratio: Annotated[float, Shown("ratio", digits=2)]
    """Root mean square error of the candidate over that of the other, geometric mean over the stretches."""
    ratio_low: Annotated[float | None, Shown("at least", digits=2)]
    """Lower end of its 95 % interval; none where too few stretches do not give one."""
    ratio_high: Annotated[float | None, Shown("at most", digits=2)]
    """Upper end."""
    segments: Annotated[int, Shown("segments")]
    """Independent segments of time that the interval comes from."""
    conclusion: Annotated[Conclusion, Shown("conclusion")]
    """Conclusion of the interval about the calibration."""

    def against(self, other_mean: float, other: str) -> str:
        """Format the comparison.

        Args:
            other_mean: Mean norm of the error with the other; N or N m.
            other: The other, in words.

        Returns:
            Both means, the conclusion, and its interval where there is one.
        """
        digits = 2 if self.quantity == "force" else 3
        means = f"{self.mean:.{digits}f} {self.unit} against {other_mean:.{digits}f} {self.unit} with {other}"
        return f"{means} ({self.conclusion}: {self._interval()})"

    def _interval(self) -> str:
        segments = f"{self.segments} segment{'' if self.segments == 1 else 's'}"
        if self.ratio_low == self.ratio_high == 1.0:
            return "the same in every sample"
        if self.ratio_low is None or self.ratio_high is None:
            return f"the errors repeat themselves, and are worth {segments} only"
        if self.conclusion == "inconclusive" and self.ratio_high > _WIDEST * self.ratio_low:
            return f"{segments} are too few, or too unlike"
        return f"{self.ratio:.2f} of it, {self.ratio_low:.2f} to {self.ratio_high:.2f} over {segments}"


def known_interval(ratio: ErrorRatio) -> tuple[float, float] | tuple[None, None]:
    """Give the 95 % interval of a ratio.

    Returns:
        Its ends; None twice where too few stretches give no upper end.
    """
    return (None, None) if finite_or_none(ratio.high) is None else (ratio.low, ratio.high)


class Independence(Row):
    """How many independent samples the errors of a candidate are worth; neighbours repeat each other."""

    calibration: Annotated[str, Shown("calibration", file=True)]
    """The calibration file, or the prior."""
    samples: Annotated[int, Shown("samples")]
    """Number of validation samples."""
    independent: Annotated[tuple[float | None, ...], ShownWrench(digits=0, counts=True)]
    """Effective number of independent samples per component; none where the error does not change."""


class PriorComparison(ErrorComparison):
    """A calibration against its prior."""

    sensor: str
    """Sensor."""
    prior: Annotated[str, Shown("prior", file=True)]
    """Its prior, as the evaluation names it."""
    prior_mean: Annotated[float, Shown("of the prior", digits=3)]
    """Mean norm of the error with its prior."""
    constant: Annotated[float, Shown("constant", digits=3)]
    """Norm of the mean error vector: the part that another offset would take away."""


def prior_comparison_text(name: str, rows: Sequence[PriorComparison]) -> str:
    """Compare a calibration with its prior in a text.

    Args:
        name: The calibration.
        rows: Its comparisons with one offset, force and moment.

    Returns:
        A sentence.
    """
    words = "; ".join(f"{row.quantity} error {row.against(row.prior_mean, 'the prior')}" for row in rows)
    constant = f"; {rows[0].constant:.2f} N is constant" if rows[0].offset is Offset.FITTED else ""
    offset, samples = OFFSET_WORDS[rows[0].offset], rows[0].samples
    return f"{name} with {offset}, {samples} samples that were not fitted: {words}{constant}"


def independence(judged: EvaluatedWrenches) -> tuple[Independence, ...]:
    """Count how many independent samples the errors of every candidate are worth.

    Args:
        judged: Wrenches on data that was not fitted.

    Returns:
        A row per candidate.
    """
    return tuple(
        Independence(
            calibration=name,
            samples=len(judged.time_s),
            independent=tuple(
                finite_or_none(autocorrelation(error, judged.time_s).effective_count)
                for error in errors_by_component(wrench, judged.reference)
            ),
        )
        for name, wrench in judged.measured
    )


def compare_with_prior(runs: Runs, calibrations: Mapping[str, Calibration]) -> tuple[PriorComparison, ...]:
    """Compare every calibration with its own prior on the validation intervals.

    Args:
        runs: The sensor in one recording, or in several, which are pooled.
        calibrations: Its calibrations by name.

    Returns:
        Two rows, force and moment, per calibration that has a prior and offset.
    """
    campaign = Campaign.of(runs)
    recordings = [evaluated_wrenches(run, calibrations) for run in campaign.runs_with(Use.VALIDATION)]
    return prior_comparisons(campaign.sensor.name, recordings)


def prior_comparisons(sensor: str, recordings: Sequence[EvaluatedWrenches]) -> tuple[PriorComparison, ...]:
    """Compare every calibration with its own prior by what they measure.

    Args:
        sensor: Name of the sensor.
        recordings: Wrenches on data that was not fitted, by the same candidates in every recording.

    Returns:
        Two rows, force and moment, per calibration that has a prior and offset, pooled over the recordings.
    """
    # a calibration may be called `prior` too
    measured = [
        {
            (candidate.name, candidate.prior is None, offset): wrench
            for candidate, offset, wrench in judged.with_either_offset()
        }
        for judged in recordings
    ]
    return tuple(
        row
        for name, prior in recordings[0].priors.items()
        for offset in (Offset.FITTED, Offset.JUDGED_MEAN)
        for row in _compared(
            sensor,
            name,
            prior,
            offset,
            [
                PairedErrors.of(wrenches[name, False, offset], wrenches[prior, True, offset], judged.reference)
                for wrenches, judged in zip(measured, recordings, strict=True)
            ],
        )
    )


def _compared(
    sensor: str, candidate: str, prior: str, offset: Offset, pairs: Sequence[PairedErrors]
) -> Iterator[PriorComparison]:
    comparison = compare_errors(pairs)
    constant = np.average([pair.mean for pair in pairs], axis=0, weights=[pair.samples for pair in pairs])
    quantities: tuple[tuple[Quantity, Literal["N", "N m"], slice, ErrorRatio], ...] = (
        ("force", "N", FORCE, comparison.force),
        ("moment", "N m", MOMENT, comparison.moment),
    )
    for quantity, unit, axes, ratio in quantities:
        squares = [pair.of_quantity(axes).sums for pair in pairs]
        if not any(square.any() for square in squares):  # the sensor does not measure it
            continue
        low, high = known_interval(ratio)
        sums = np.sum([np.sqrt(square).sum(axis=1) for square in squares], axis=0)
        mean, prior_mean = (sums / comparison.count).tolist()
        yield PriorComparison(
            sensor=sensor,
            calibration=candidate,
            prior=prior,
            offset=offset,
            quantity=quantity,
            unit=unit,
            samples=comparison.count,
            mean=mean,
            prior_mean=prior_mean,
            constant=float(np.linalg.norm(constant[axes])),
            ratio=ratio.ratio,
            ratio_low=low,
            ratio_high=high,
            segments=ratio.segments,
            conclusion=ratio.conclusion,
        )
