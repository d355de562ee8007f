# SPDX-License-Identifier: BSD-3-Clause
"""What `forcetorque study` gives: the choice, what it is worth on other sessions, and where the tables are."""

from __future__ import annotations

from typing import Literal

from pydantic import BaseModel, ConfigDict, Field

from forcetorque.analysis import SensorStudy
from forcetorque.evaluation import KNOWN_BEFORE, Offset
from forcetorque.spatial import WRENCH_COMPONENTS
from forcetorque.study import CONVENTION, Study


class CombinationRow(BaseModel):
    """Calibration intervals that were fitted together."""

    name: str
    """Name."""
    intervals: list[str]
    """Labels of the intervals."""
    samples: int
    """Number of samples."""
    excited: int
    """Directions of the raw readings that the loads move."""
    channels: int
    """Number of raw channels."""


class ChosenRow(BaseModel):
    """A candidate, or the workbench matrix, with its mean contact force over all validation data."""

    name: str
    """Data set, type and lambda of (5.4); `workbench` for the prior."""
    lambda_counts2: float | None
    """Lambda of (5.4), as `calibrate` counts it; counts2."""
    table_lambda_counts2: float | None
    """The same as the tables of the thesis count it, a sixth; counts2."""
    relative_lambda: float | None
    """The same over the mean variance of the raw channels."""
    force_mean_N: float
    """Mean norm of the contact force."""
    force_mean_error_N: float
    """Standard error of that mean, from blocks of time."""
    moment_mean_Nm: float
    """Mean norm of the contact moment."""
    mean_absolute: list[float]
    """Mean absolute value per component; N, N m."""


class AxisRow(BaseModel):
    """The best candidate of one axis."""

    axis: str
    """Component."""
    name: str
    """Data set, type and lambda."""
    mean_absolute: float
    """Its mean absolute value; N, N m."""
    workbench: float | None
    """That of the workbench matrix, offset re-estimated."""


class SessionRow(BaseModel):
    """A choice made on all other sessions, scored on one."""

    session: str
    """Session."""
    samples: int
    """Number of its samples."""
    chosen: str
    """Candidate that is best by magnitude on the other sessions."""
    force_mean_N: float
    """Its mean norm of the contact force on this session."""
    workbench_force_mean_N: float | None
    """That of the workbench matrix, offset re-estimated."""
    by_axis: list[str]
    """Candidates that are best on the other sessions, per component."""
    mean_absolute: list[float]
    """Their mean absolute value on this session; N, N m."""


class ModeResult(BaseModel):
    """What is best in one offset mode."""

    offset: Offset
    """Offset from the first second of the judged interval, or that of the fitted data."""
    best: ChosenRow
    """Smallest mean contact force."""
    by_axis: list[AxisRow]
    """Smallest mean absolute value of every component."""
    across_sessions: list[SessionRow]
    """The same choice, made and scored on different sessions; empty if there is only one."""


class SensorStudyResult(BaseModel):
    """The study of one sensor."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    folder: str
    """Folder of its files."""
    candidates: int
    """Number of fitted matrices, without the workbench's."""
    validation_samples: int
    """Samples that they were judged on."""
    combinations: list[CombinationRow]
    """What was fitted together."""
    left_out: list[str]
    """Types that a combination cannot give, with the reason."""
    workbench: ChosenRow | None
    """The prior matrix, offset re-estimated; None for a sensor without one."""
    modes: list[ModeResult]
    """The choice in both offset modes."""
    files: list[str]
    """Tables, figures and calibrations in the folder."""


class StudyResult(BaseModel):
    """What `forcetorque study` found."""

    model_config = ConfigDict(populate_by_name=True)

    schema_name: Literal["forcetorque/study/2"] = Field(default="forcetorque/study/2", alias="schema")
    """Form of the result."""
    lambda_convention: str = f"{CONVENTION}; counts2"
    """How lambdas are counted; in the first form of the result names and `--lambda` counted a sixth of it."""
    experiments: list[str]
    """Experiment files."""
    folder: str
    """Folder with a folder per sensor."""
    sensors: list[SensorStudyResult]
    """One per sensor."""


def sensor_result(made: SensorStudy, *, folder: str, files: list[str]) -> SensorStudyResult:
    """Put the result of one sensor together.

    Args:
        made: Its study.
        folder: Folder of its files.
        files: Names of the files.

    Returns:
        The result.
    """
    study = made.study
    judged = study.judgements[Offset.FIRST_SECOND]
    return SensorStudyResult(
        sensor=made.data.identity.name,
        serial=made.data.identity.serial,
        folder=folder,
        candidates=len(study.fits.candidates),
        validation_samples=int(judged.errors.count.sum()),
        combinations=[
            CombinationRow(
                name=each.name,
                intervals=list(each.labels),
                samples=each.moments.count,
                excited=sum(each.excitation.excited),
                channels=each.moments.channels,
            )
            for each in study.fits.combinations
        ],
        left_out=list(study.fits.left_out),
        workbench=None if study.workbench is None else _chosen(study, Offset.FIRST_SECOND, len(study.models) - 1),
        modes=[_mode(study, source) for source in KNOWN_BEFORE],
        files=files,
    )


def _mode(study: Study, source: Offset) -> ModeResult:
    choice, pooled = study.choices[source], study.judgements[source].over()
    return ModeResult(
        offset=source,
        best=_chosen(study, source, choice.by_magnitude),
        by_axis=[
            AxisRow(
                axis=component,
                name=study.name(index),
                mean_absolute=float(pooled.mean_absolute[index, axis]),
                workbench=None if study.workbench is None else float(pooled.mean_absolute[-1, axis]),
            )
            for axis, (component, index) in enumerate(zip(WRENCH_COMPONENTS, choice.by_axis, strict=True))
        ],
        across_sessions=[
            SessionRow(
                session=score.session,
                samples=score.samples,
                chosen=study.name(score.chosen),
                force_mean_N=score.force_mean,
                workbench_force_mean_N=score.workbench_force_mean,
                by_axis=[study.name(index) for index in score.by_axis],
                mean_absolute=score.mean_absolute.tolist(),
            )
            for score in choice.across_sessions
        ],
    )


def _chosen(study: Study, source: Offset, index: int) -> ChosenRow:
    pooled, spread = study.judgements[source].over(), study.judgements[source].part().standard_error()
    candidate = study.fits.candidates[index] if index < len(study.fits.candidates) else None
    return ChosenRow(
        name=study.name(index),
        table_lambda_counts2=None if candidate is None else candidate.table_lambda,
        lambda_counts2=None if candidate is None else candidate.lambda_counts2,
        relative_lambda=None if candidate is None else candidate.relative_lambda,
        force_mean_N=float(pooled.force_mean[index]),
        force_mean_error_N=float(spread.force_mean[index]),
        moment_mean_Nm=float(pooled.moment_mean[index]),
        mean_absolute=pooled.mean_absolute[index].tolist(),
    )
