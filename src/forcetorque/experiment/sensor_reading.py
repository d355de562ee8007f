# SPDX-License-Identifier: BSD-3-Clause
"""How a sensor is read: what it logged, and what a calibration or a prior makes of it. Everybody reads it here."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray, require_shape
from forcetorque.base.errors import ExperimentError
from forcetorque.base.rows_on_disk import in_blocks
from forcetorque.experiment.calibration.calibration_file import Calibration, Prior, SessionOffset
from forcetorque.experiment.calibration.sensor_model import WrenchModel, recover_raw
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sample_quality import sample_quality, usable_readings
from forcetorque.recording.alignment import Interpolation
from forcetorque.recording.recording import Interval


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Correction:
    """How a reading becomes a wrench."""

    model: WrenchModel
    """What is done to the reading."""
    source: str
    """Where it comes from, in words."""
    matrix_source: str
    """Where it comes from but for its offset, in words."""
    of_wrench: bool = False
    """Whether the model is for the logged wrench, not for raw counts."""
    variables: tuple[str, ...] = ()
    """Variables of the sensor that the model needs, in its order."""
    removes_offset: bool = True
    """Whether data gave its offset; without, its wrenches have whatever offset the sensor has."""
    sessions: Mapping[str, FloatArray] = field(default_factory=dict)
    """Offset of every session that was fitted, by its name; shape (6,); N, N m."""
    intervals: Mapping[str, FloatArray] = field(default_factory=dict)
    """Offset of every interval that gave one of its own, by its label; shape (6,); N, N m."""
    calibration: Calibration | None = None
    """The calibration that it is of, which knows where it holds; None for a prior and the logged wrench."""

    @classmethod
    def of(cls, name: str, calibration: Calibration) -> Self:
        """Read by a calibration.

        Args:
            name: Name of its file.
            calibration: The calibration.

        Returns:
            The correction.
        """
        variables = tuple(variable.name for variable in calibration.variables)
        sessions = {session.name: session.offset for session in calibration.sessions}
        return cls(
            model=calibration.model,
            source=name,
            matrix_source=name,
            variables=variables,
            sessions=sessions,
            calibration=calibration,
        )

    @classmethod
    def of_prior(cls, name: str, prior: Prior, sessions: Sequence[SessionOffset] = ()) -> Self:
        """Read by the prior of a calibration, with the offsets that the calibration carries for it.

        Args:
            name: Name of the calibration.
            prior: Its prior.
            sessions: Its sessions.

        Returns:
            The correction.
        """
        return cls(
            model=WrenchModel(matrix=prior.matrix, offset=prior.offset),
            source=f"the prior {prior.source}, offset of the data that {name} was fitted on",
            matrix_source=f"the prior {prior.source}",
            sessions={one.name: one.prior_offset for one in sessions if one.prior_offset is not None},
        )

    def in_session(self, names: Sequence[str]) -> Self:
        """Give the correction with the offset of a session.

        Args:
            names: Names under which the session may be known, the most special first (`Experiment.session_names`).

        Returns:
            The correction with the offset of that session; the same where it was not fitted.
        """
        for name in names:
            if name in self.sessions:
                return replace(self, model=replace(self.model, offset=self.sessions[name]))
        return self

    def over(self, experiment: Experiment, label: str | None) -> Self:
        """Give the correction with the offset that holds over an interval.

        Args:
            experiment: The experiment.
            label: Label of the interval; None for what lies in none.

        Returns:
            The correction with the offset that the interval gave, else with that of its session.
        """
        if label is not None and label in self.intervals:
            return replace(self, model=replace(self.model, offset=self.intervals[label]))
        return self.in_session(experiment.session_names(label))

    @property
    def bare(self) -> Self:
        """The correction without any offset."""
        return replace(
            self,
            model=replace(self.model, offset=np.zeros(6)),
            source=f"{self.matrix_source}, no offset removed",
            removes_offset=False,
            sessions={},
            intervals={},
        )

    def with_offset(self, offset: FloatArray, words: str, *, intervals: Mapping[str, FloatArray] | None = None) -> Self:
        """Give the correction with another offset.

        Args:
            offset: To be added; shape (6,); N, N m.
            words: Where it comes from.
            intervals: Offsets of intervals that gave one of their own, by label; shape (6,) each; none if None.

        Returns:
            The correction, with this offset in every session.
        """
        return replace(
            self,
            model=replace(self.model, offset=offset),
            source=f"{self.matrix_source}, offset {words}",
            removes_offset=True,
            sessions={},
            intervals=intervals or {},
        )

    @classmethod
    def without_offset(cls, sensor: ExperimentSensor) -> Self:
        """Read by the prior of the experiment, or take the logged wrench, with whatever offset it has.

        Returns:
            The correction.

        Raises:
            ExperimentError: If raw counts have no prior.
        """
        of_wrench = sensor.quantity != "raw"
        if not of_wrench and sensor.prior is None:
            raise ExperimentError(
                f"sensor {sensor.name!r}: raw counts become wrenches by a calibration or a prior matrix"
            )
        matrix = np.eye(6) if of_wrench or sensor.prior is None else sensor.prior
        words = "the logged wrench" if of_wrench else f"the prior {sensor.prior_source}"
        return cls(
            model=WrenchModel(matrix=matrix, offset=np.zeros(6)),
            source=f"{words}, no offset removed",
            matrix_source=words,
            of_wrench=of_wrench,
            removes_offset=False,
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Readings:
    """What a sensor read at n instants, in every form that a correction may want."""

    logged: FloatArray
    """As logged; shape (n, c); counts, or N and N m."""
    raw: FloatArray
    """Raw readings, logged or recovered through the prior; shape (n, c); counts."""
    variables: Mapping[str, FloatArray]
    """Linear variables by name; shape (n,) each."""

    @classmethod
    def of(cls, sensor: ExperimentSensor, logged: FloatArray, variables: Mapping[str, FloatArray]) -> Self:
        """Recover raw counts where only wrenches were logged.

        Args:
            sensor: The sensor.
            logged: What it logged; shape (n, c).
            variables: Linear variables by name; shape (n,) each.

        Returns:
            The readings.

        Raises:
            ExperimentError: If the stream is calibrated and the sensor has no prior.
        """
        if sensor.quantity == "raw":
            return cls(logged=logged, raw=logged, variables=variables)
        if sensor.prior is None:
            raise ExperimentError(f"sensor {sensor.name!r}: recovering raw counts needs the prior matrix")
        return cls(logged=logged, raw=recover_raw(logged, sensor.prior), variables=variables)

    def at(self, chosen: BoolArray | slice) -> Self:
        """Pick some instants.

        Args:
            chosen: Which; shape (n,), or a range.

        Returns:
            Copies of the readings there.
        """
        variables = {name: np.array(values[chosen]) for name, values in self.variables.items()}
        return replace(self, logged=np.array(self.logged[chosen]), raw=np.array(self.raw[chosen]), variables=variables)

    def blocks(self) -> Iterator[Self]:
        """Give the readings block by block.

        Yields:
            As `in_blocks`.
        """
        for logged, raw, *values in in_blocks(self.logged, self.raw, *self.variables.values()):
            variables = dict(zip(self.variables, values, strict=True))
            yield replace(self, logged=logged, raw=raw, variables=variables)

    def wrench(self, correction: Correction) -> FloatArray:
        """Read the sensor.

        Args:
            correction: How.

        Returns:
            Wrenches in the sensor's frame and direction; shape (n, 6); N, N m; NaN in gaps.
        """
        values = self.logged if correction.of_wrench else self.raw
        name = f"{correction.matrix_source}: matrix"
        require_shape(correction.model.matrix, name=name, shape=(6, values.shape[1]))
        columns = [self.variables[variable] for variable in correction.variables]
        return correction.model.wrench(values, np.stack(columns, axis=-1) if columns else None)


def readings_at(
    experiment: Experiment, sensor: ExperimentSensor, variables: Sequence[str], at_ns: IntArray
) -> Readings:
    """Give what a sensor read at given instants.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        variables: Names of the linear variables that are wanted.
        at_ns: Instants; shape (n,); ns.

    Returns:
        Its readings; NaN in gaps and where samples say nothing of the load; between the others where it is repeated.
    """
    stream = experiment.recording.stream(sensor.stream)
    rows = np.flatnonzero(~sample_quality(experiment, sensor).repeated)
    neighbours = Interpolation(stream, rows).at(at_ns)
    before, after = (usable_readings(experiment, sensor, row) for row in (neighbours.before, neighbours.after))
    values = {name: sensor.variable(name).source.at(experiment.recording, at_ns) for name in variables}
    return Readings.of(sensor, neighbours.interpolated(before, after), values)


def wrench_at(
    experiment: Experiment,
    sensor: ExperimentSensor,
    correction: Correction,
    at_ns: IntArray,
    *,
    interval: Interval | None = None,
) -> FloatArray:
    """Give what a sensor measured at given instants.

    Args:
        experiment: The experiment.
        sensor: One of its sensors.
        correction: How it is read.
        at_ns: Instants; shape (n,); ns.
        interval: Interval whose session gives the offset, also at the instants around it that a filter takes; None to
            go by the interval that each instant lies in.

    Returns:
        Wrenches in its frame and direction; shape (n, 6); N, N m; NaN in gaps and where samples say nothing of
        the load.
    """
    readings = readings_at(experiment, sensor, correction.variables, at_ns)
    if interval is not None:
        return readings.wrench(correction.over(experiment, interval.label))
    wrench = readings.wrench(correction.over(experiment, None))
    for span in experiment.recording.intervals if correction.sessions or correction.intervals else ():
        inside = span.holds(at_ns)
        wrench[inside] = readings.at(inside).wrench(correction.over(experiment, span.label))
    return wrench
