# SPDX-License-Identifier: BSD-3-Clause
"""What an evaluation needs of the validation intervals of a recording: moments in blocks, and means over seconds.

Errors of a linear calibration are linear in readings, variables and expected wrenches, so that their means and mean
squares over a block follow from its moments. A comparison with the prior cuts a recording into 1 to 10, and 40, parts
of equally many samples; blocks end wherever one of these parts, or an interval, does, and are thus some 60 in number
however long the recording is.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import Annotated

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import ArrayField, FloatArray
from forcetorque.base.noise.paired_comparison import BLOCKS, MOST_SEGMENTS, part_ends
from forcetorque.base.noise.window_means import means_of_parts
from forcetorque.base.rows_on_disk import forget_pages, in_blocks
from forcetorque.base.stored_table import StoredTable
from forcetorque.evaluation.load_cases.load_case import LoadCase, operating_load_cases
from forcetorque.evaluation.section import LoadCaseOffset
from forcetorque.experiment.calibration.moments import Moments
from forcetorque.experiment.calibration.provenance import Content
from forcetorque.experiment.calibration.stored_moments import VariableDescription
from forcetorque.experiment.experiment import ExperimentSensor, SensorVariable
from forcetorque.experiment.interval_samples import IntervalSamples, logged_content
from forcetorque.experiment.segmented_samples import samples_of_use
from forcetorque.experiment.sensor_mount import SensorMount
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.named_columns import ScalarSource
from forcetorque.recording.recording import Interval, Use

_Vector = Annotated[FloatArray, ArrayField((None,))]
_Table = Annotated[FloatArray, ArrayField((None, None))]
_Wrench = Annotated[FloatArray, ArrayField((6,))]


class EvaluatedInterval(StoredTable):
    """A validation interval."""

    label: str
    """Label."""
    start_ns: int
    """Start; ns on the recording's clock."""
    end_ns: int
    """End, which is excluded."""
    session: str | None
    """Power cycle that the file specifies; None where the recording is one."""
    content: Content | None
    """By what its samples are known again in another log; None where they hardly change."""


class EvaluationBlock(StoredTable):
    """Moments of consecutive samples of one interval."""

    interval: str
    """Label of the interval."""
    samples: int = Field(ge=1)
    """Number of samples."""
    channels: int
    """Number c of raw channels."""
    mean: _Vector
    """Mean of raw channels, variables and expected wrench; shape (c + v + 6,)."""
    second_moment: _Table
    """Mean product of the same, centred."""

    @property
    def moments(self) -> Moments:
        """The moments."""
        return Moments(
            count=self.samples,
            channels=self.channels,
            variables=len(self.mean) - self.channels - 6,
            origin=self.mean,
            step=np.zeros_like(self.mean),
            second=self.second_moment,
        )


class SessionMeans(StoredTable):
    """Means over seconds of all validation samples of one session in a recording."""

    session: str | None
    """The session that the file specifies; None where the recording is one."""
    session_names: tuple[str, ...]
    """Names under which a calibration may know it, the most special first."""
    time_s: _Vector
    """Mean instants since the start of the recording; s."""
    raw: _Table
    """Mean readings; counts."""
    reference: _Table
    """Mean expected wrenches; N, N m."""
    variables: _Table
    """Mean variables."""


_ATTRIBUTES = {"text": "words", "is_specified": "is_stated"}
"""Attribute of a load case by the key of a dataset."""


class StoredLoadCase(StoredTable):
    """Loads to come, as the experiment has them for the sensor."""

    name: str
    """Name."""
    text: str
    """What the loads are."""
    wrench: _Table
    """The loads in the sensor's frame and direction; N, N m."""
    offset: LoadCaseOffset
    """Offset that readings are taken with."""
    changes: dict[str, float]
    """Root mean square changes of variables by name."""
    allowed_force_N: float | None
    """Allowed force error; None for a share of the loads."""
    allowed_moment_Nm: float | None
    """Allowed moment error."""
    is_specified: bool
    """Whether the experiment file specifies it."""

    @classmethod
    def of(cls, case: LoadCase) -> StoredLoadCase:
        """Take a load case.

        Args:
            case: The load case.

        Returns:
            The same for a file.
        """
        values = {name: getattr(case, _ATTRIBUTES.get(name, name)) for name in cls.model_fields}
        return cls(**(values | {"changes": dict(case.changes)}))

    @property
    def load_case(self) -> LoadCase:
        """The load case."""
        return LoadCase(**{_ATTRIBUTES.get(name, name): value for name, value in self})


class StoredSensor(StoredTable):
    """How an experiment describes a sensor, as far as an evaluation needs it."""

    name: str
    """Name in the robot model."""
    serial: str
    """Serial number."""
    quantity: str
    """Quantity of its stream: `raw` or `wrench`."""
    prior: Annotated[FloatArray, ArrayField((6, None))] | None
    """Prior matrix; N/count, N m/count."""
    prior_source: str | None
    """Its file."""
    limit_counts: float
    """Largest magnitude of a raw reading."""
    full_scale: _Wrench | None
    """Full scale per component; N, N m; None if not specified."""
    variables: tuple[VariableDescription, ...]
    """Linear variables, in the order of the moments."""
    mount: SensorMount | None
    """Where it sits otherwise than the robot model states."""

    @classmethod
    def of(cls, run: SensorRun) -> StoredSensor:
        """Describe a sensor.

        Args:
            run: The sensor.

        Returns:
            The same for a file.
        """
        sensor = run.sensor
        without_variables = run.experiment.fit_options.with_variables is False
        described = [] if without_variables else [VariableDescription.of(one.linear) for one in sensor.variables]
        names = ("name", "serial", "quantity", "prior", "prior_source", "limit_counts", "full_scale")
        return cls(
            **{name: getattr(sensor, name) for name in names},
            variables=tuple(described),
            mount=run.experiment.mounts.get(sensor.name),
        )

    @property
    def sensor(self) -> ExperimentSensor:
        """The sensor; its streams are not there."""
        source = ScalarSource(stream="", quantity="", column="")
        names = ("name", "serial", "quantity", "prior", "prior_source", "limit_counts", "full_scale")
        return ExperimentSensor(
            **{name: getattr(self, name) for name in names},
            stream="",
            variables=tuple(SensorVariable(linear=one.linear, source=source) for one in self.variables),
        )


class StoredEvaluation(StoredTable):
    """What an evaluation needs of one sensor in one recording."""

    sensor: StoredSensor
    """The sensor."""
    log_sha256: tuple[str, ...]
    """SHA-256 of the files of the log."""
    intervals: tuple[EvaluatedInterval, ...]
    """The validation intervals, in the order of time."""
    blocks: tuple[EvaluationBlock, ...]
    """Their samples in blocks, in the order of time."""
    sessions: tuple[SessionMeans, ...]
    """Their samples in means over seconds."""
    load_cases: tuple[StoredLoadCase, ...]
    """Load cases of the sensor."""
    circular: tuple[str, ...]
    """Loads that the sensor itself weighed, as text."""

    @classmethod
    def of(cls, run: SensorRun, intervals: Sequence[IntervalSamples] | None = None) -> StoredEvaluation:
        """Reduce the validation intervals of a recording.

        Args:
            run: The sensor.
            intervals: Samples of the intervals in the order of time; computed here if None.

        Returns:
            What is kept of them.
        """
        sensor = StoredSensor.of(run)
        if intervals is None:
            intervals = samples_of_use(run, Use.VALIDATION, evaluated_variables(run))
        return cls(
            sensor=sensor,
            log_sha256=tuple(sorted(run.experiment.log_sha256)),
            intervals=tuple(_interval(run, one.interval) for one in intervals),
            blocks=tuple(_blocks(intervals)),
            sessions=tuple(_session_means(run, intervals)),
            load_cases=tuple(map(StoredLoadCase.of, operating_load_cases([run]))),
            circular=run.circular_loads(),
        )

    def contents(self) -> Iterator[tuple[int, Content | None]]:
        """Say by what samples are known again.

        Yields:
            For every interval its number of samples, and by what they are known.
        """
        for one in self.intervals:
            yield sum(block.samples for block in self.blocks if block.interval == one.label), one.content


def evaluated_variables(run: SensorRun) -> list[str]:
    """Name the linear variables that an evaluation keeps.

    Args:
        run: The sensor.

    Returns:
        Their names.
    """
    return [variable.name for variable in StoredSensor.of(run).variables]


def _interval(run: SensorRun, interval: Interval) -> EvaluatedInterval:
    return EvaluatedInterval(
        label=interval.label,
        start_ns=interval.start_ns,
        end_ns=interval.end_ns,
        session=run.experiment.roles[interval.label].session,
        content=logged_content(run.experiment, run.sensor, interval),
    )


def _blocks(intervals: Sequence[IntervalSamples]) -> Iterable[EvaluationBlock]:
    lengths = [len(one.samples) for one in intervals]
    total, start = sum(lengths), 0
    counts = (*range(1, MOST_SEGMENTS + 1), BLOCKS)
    ends = {end for count in counts for end in part_ends(total, count)} | set(np.cumsum(lengths).tolist())
    for one, length in zip(intervals, lengths, strict=True):
        own = [start, *sorted(end for end in ends if start < end <= start + length)]
        columns = one.raw, one.samples.reference, one.samples.variables
        for first, last in zip(own, own[1:], strict=False):
            moments = Moments.of(*(values[first - start : last - start] for values in columns))
            forget_pages(columns)
            yield EvaluationBlock(
                interval=one.interval.label,
                samples=moments.count,
                channels=moments.channels,
                mean=moments.mean,
                second_moment=moments.second,
            )
        start += length


def _session_means(run: SensorRun, intervals: Sequence[IntervalSamples]) -> Iterable[SessionMeans]:
    groups: dict[str | None, list[IntervalSamples]] = {}
    for one in intervals:
        groups.setdefault(run.experiment.roles[one.interval.label].session, []).append(one)
    for session, own in groups.items():
        channels = own[0].raw.shape[1]
        time_s, means, _ = means_of_parts(_timed_parts(own, run.experiment.recording.start_ns))
        variables = means[:, channels + 6 :]
        yield SessionMeans(
            session=session,
            session_names=run.experiment.session_names(own[0].interval.label),
            time_s=time_s,
            raw=means[:, :channels],
            reference=means[:, channels : channels + 6],
            variables=variables if variables.shape[1] else np.zeros((0, 0)),
        )


def _timed_parts(intervals: Sequence[IntervalSamples], start_ns: int) -> Iterator[tuple[FloatArray, FloatArray]]:
    for one in intervals:
        samples = one.samples
        for stamps, *columns in in_blocks(samples.stamp_ns, one.raw, samples.reference, samples.variables):
            yield seconds_since(stamps, start_ns), np.hstack(columns)
