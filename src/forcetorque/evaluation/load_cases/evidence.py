# SPDX-License-Identifier: BSD-3-Clause
"""What validation data say of a load case: errors in means of a second, and how much the loads moved."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.base.noise.means import mean_error, means_over, one_after_another
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.candidates import JudgedWrenches
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use


@dataclass(frozen=True, slots=True, kw_only=True)
class MeasuredError:
    """Error of one quantity, force or moment, on judged data."""

    constant: float
    """Norm of the mean error in the session in which it is largest; N or N m."""
    constant_at_least: float
    """What is left of a mean error, at most, when the half-width of its 95 % interval is taken off."""
    rest: float
    """Root mean square of what is left without the means; N or N m."""
    rest_at_least: float
    """Lower end of its 95 % interval; 0 where the data are too few to tell."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Evidence:
    """What one candidate measured on judged data, against what mechanics demands there."""

    force: MeasuredError
    """Of the force; N."""
    moment: MeasuredError
    """Of the moment; N m."""
    reference: FloatArray
    """The reference, in means of a second; shape (n, 6); N, N m."""
    moved: FloatArray
    """The reference about its mean in each session; shape (n, 6); N, N m."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JudgedStretch:
    """What one candidate measured in a recording, or in as much of it as belongs to one session."""

    session: str
    """Name of the session."""
    time_s: FloatArray
    """Instants, not falling; shape (n,); s."""
    measured: FloatArray
    """What was measured; shape (n, 6); N, N m."""
    reference: FloatArray
    """What mechanics demands; shape (n, 6); N, N m."""


def evidence(stretches: Sequence[JudgedStretch]) -> Evidence:
    """Sum up the errors of one candidate in any number of recordings.

    Args:
        stretches: What it measured in each, at least one.

    Returns:
        The errors. The constant part is that of the session in which it is largest: of two that cancel each other
        either would hurt. What is left is about the mean of each session.
    """
    instants, errors, references = [], [], []
    in_session = sorted(stretches, key=lambda stretch: stretch.session)
    for _, session in groupby(in_session, key=lambda stretch: stretch.session):
        means = [means_over(one.time_s, np.hstack([one.measured - one.reference, one.reference])) for one in session]
        instants.append(one_after_another([time for time, _, _ in means]))
        columns = np.concatenate([columns for _, columns, _ in means])
        errors.append(columns[:, :6])
        references.append(columns[:, 6:])
    line = one_after_another(instants)
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


def judged_evidence(campaign: Campaign, calibrations: Mapping[str, Calibration]) -> dict[str, Evidence]:
    """Sum up what every calibration measures on the validation intervals of all recordings.

    Args:
        campaign: The sensor in any number of recordings.
        calibrations: Its calibrations by name, which have not seen these intervals.

    Returns:
        Evidence by name of the calibration; none where no recording has such an interval.
    """
    stretches: dict[str, list[JudgedStretch]] = {name: [] for name in calibrations}
    for run in campaign.runs:
        if not run.has(Use.VALIDATION):
            continue
        judged = run.judged(calibrations)
        # the calibrations come last: a prior may have the name of one
        measured = dict(judged.measured[-len(calibrations) :])
        for session, samples in _sessions(campaign, run, judged).items():
            for name in calibrations:
                stretches[name].append(
                    JudgedStretch(
                        session=session,
                        time_s=judged.time_s[samples],
                        measured=measured[name][samples],
                        reference=judged.reference[samples],
                    )
                )
    return {name: evidence(parts) for name, parts in stretches.items() if parts}


def _sessions(campaign: Campaign, run: SensorRun, judged: JudgedWrenches) -> dict[str, IntArray]:
    """Samples by session, in the order of time."""
    indices: dict[str, list[IntArray]] = {}
    for label, samples in judged.intervals:
        own = np.arange(samples.start, samples.stop)
        indices.setdefault(campaign.session(run, label), []).append(own)
    return {session: np.concatenate(parts) for session, parts in indices.items()}


HARDLY = 0.05
"""Share of the load below which it hardly moved."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JudgedExcitation:
    """How much the judged loads moved, and how large loads are."""

    force: float
    """Standard deviation of the reference force, all three components together; N."""
    moment: float
    """The same of the moment; N m."""
    load_force: float
    """The larger of the root mean square judged force and the standard deviation of the fitted ones; N."""
    load_moment: float
    """The same of the moment; N m."""

    @classmethod
    def of(
        cls, reference: FloatArray, calibrations: Iterable[Calibration], *, moved: FloatArray | None = None
    ) -> JudgedExcitation:
        """Sum up judged loads.

        Args:
            reference: Expected wrenches of the judged samples; shape (n, 6); N, N m.
            calibrations: Calibrations that are judged, for the loads that they were fitted to.
            moved: The same about their means in each of several recordings; shape (n, 6); about one mean if left out.

        Returns:
            Their size and movement.
        """
        moving = np.sqrt((reference if moved is None else moved).var(axis=0))
        load = np.sqrt((reference**2).mean(axis=0))
        fitted = [calibration.validity.reference_deviation for calibration in calibrations]
        force, moment = (
            (float(np.linalg.norm(moving[part])), max(float(np.linalg.norm(one[part])) for one in (load, *fitted)))
            for part in FORCE_AND_MOMENT
        )
        return cls(force=force[0], moment=moment[0], load_force=force[1], load_moment=moment[1])

    @property
    def words(self) -> str | None:
        """That the loads hardly moved, in words; None where they moved."""
        return still_words(self.force, self.load_force, self.moment, self.load_moment)


def still_words(force: float, load_force: float, moment: float, load_moment: float) -> str | None:
    """Say that loads hardly moved while errors were measured.

    Args:
        force: Standard deviation of the force; N.
        load_force: Size of the force; N.
        moment: Standard deviation of the moment; N m.
        load_moment: Size of the moment; N m.

    Returns:
        Words; None where both moved.
    """
    kinds = {"forces": (force, load_force, "N"), "moments": (moment, load_moment, "N m")}
    still = {kind: sizes for kind, sizes in kinds.items() if hardly_moved(sizes[0], sizes[1])}
    if not still:
        return None
    of = ", ".join(f"{moved:.2g} {unit} of {load:.2g} {unit}" for moved, load, unit in still.values())
    what = "loads" if len(still) == len(kinds) else next(iter(still))
    wrong = "a wrong matrix" if what == "loads" else f"a matrix that is wrong for {what}"
    return f"the {what} hardly moved in the judged samples ({of}): {wrong} would show nothing"


def hardly_moved(moved: float, load: float) -> bool:
    """Tell whether a load moved so little that a wrong matrix would show nothing.

    Args:
        moved: Standard deviation of the load.
        load: Size of loads, in the same unit.

    Returns:
        Whether it did.
    """
    return moved <= HARDLY * load


def fewest_independent(error: FloatArray, time_s: FloatArray) -> float | None:
    """Count the independent samples that errors are worth, of the component that is worth the fewest.

    Args:
        error: Errors in the order of time; shape (n, 6); N, N m; NaN in gaps.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        The number; None where no component changes.
    """
    counts = [autocorrelation(component, time_s).effective_count for component in error.T]
    return min((count for count in counts if np.isfinite(count)), default=None)
