# SPDX-License-Identifier: BSD-3-Clause
"""What a calibration needs of a recording: kept in a file, it can be fitted with others without being read again."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Final, Literal

import numpy as np
from pydantic import ConfigDict, Field

from forcetorque.base.arrays import ArrayField, FloatArray, IntArray
from forcetorque.base.errors import FitError
from forcetorque.base.stored_table import StoredTable, read_stored_table, write_stored_table
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import DataSet, Moments, WindowMeans
from forcetorque.experiment.calibration.posterior import LoadError
from forcetorque.experiment.calibration.provenance import FittedInterval, SensorIdentity, readings_twice
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm, MountTolerance
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from forcetorque.recording.frozen_and_saturated_samples import UnusableCounts

SCHEMA: Final = "forcetorque/moments/2"
"""Name and version of the file's form."""

_Vector = Annotated[FloatArray, ArrayField((None,))]
_Table = Annotated[FloatArray, ArrayField((None, None))]
_Wrench = Annotated[FloatArray, ArrayField((6,))]


class IntervalMoments(StoredTable):
    """One interval: its means over windows of a second, and moments and ranges of its samples."""

    interval: FittedInterval
    """Which interval it is."""
    recording: str
    """Recording that it is of, by a name that tells it from others."""
    samples: int = Field(ge=1)
    """Number of samples."""
    dropped: int = Field(ge=0)
    """Samples of the interval that were left out."""
    unusable: UnusableCounts = UnusableCounts()
    """Those among them that say nothing of the load: frozen, saturated, repeated; zeros in earlier files."""
    raw_minimum_counts: _Vector
    """Smallest reading per channel; counts."""
    raw_maximum_counts: _Vector
    """Largest reading per channel; counts."""
    variable_minimum: _Vector
    """Smallest value of every variable."""
    variable_maximum: _Vector
    """Largest value of every variable."""
    mean: _Vector
    """Mean of the samples: channels, variables, reference."""
    second_moment: _Table
    """Mean product of the same, centred."""
    time_s: _Vector
    """Mean instants of the windows on the clock of the recording; s."""
    count: _Vector
    """Samples in each window."""
    raw: _Table
    """Mean readings; counts."""
    reference: _Table
    """Mean expected wrenches; N, N m."""
    flattening: _Table
    """What a derivative window of twice the length takes from them; N, N m."""
    variables: _Table
    """Mean variables."""
    extreme_raw: _Table | None = None
    """Readings that lie at an end of the interval's range; counts; None in files of earlier versions."""
    extreme_variables: _Table | None = None
    """Variables at the same samples."""
    terms: tuple[ErrorTerm, ...] = ()
    """Numbers of the robot model that may be wrong; none where it is taken as exact."""
    model: _Table | None = None
    """Derivatives of the expected wrenches by these, components before terms; shape (n, 6 terms); None where there are
    no terms."""

    @classmethod
    def of(
        cls,
        data: DataSet,
        interval: FittedInterval,
        *,
        dropped: int,
        unusable: UnusableCounts = UnusableCounts(),  # noqa: B008
    ) -> IntervalMoments:
        """Reduce the samples of an interval.

        Args:
            data: Samples with their instants.
            interval: Which interval they are.
            dropped: Samples of the interval that were left out.
            unusable: Those among them that say nothing of the load.

        Returns:
            What is kept of them.
        """
        means, moments = WindowMeans.of(data), Moments.of(data.raw, data.reference, data.variables)
        ends = end_samples(data, moments)
        return cls(
            interval=interval,
            recording=data.recording,
            samples=moments.count,
            dropped=dropped,
            unusable=unusable,
            raw_minimum_counts=data.raw.min(axis=0),
            raw_maximum_counts=data.raw.max(axis=0),
            variable_minimum=data.variables.min(axis=0),
            variable_maximum=data.variables.max(axis=0),
            mean=moments.mean,
            second_moment=moments.second,
            time_s=means.time_s,
            count=means.count,
            raw=means.raw,
            reference=means.reference,
            flattening=means.flattening,
            # without a variable JSON would keep no rows
            variables=means.variables if means.variables.shape[1] else np.zeros((0, 0)),
            extreme_raw=data.raw[ends],
            extreme_variables=data.variables[ends] if data.variables.shape[1] else np.zeros((0, 0)),
        )

    @property
    def readings(self) -> tuple[FloatArray, FloatArray]:
        """Readings that tell the range of the interval, shape (n, c), and the variables beside them, shape (n, v)."""
        means = self.means
        if self.extreme_raw is None or self.extreme_variables is None:
            return means.raw, means.variables
        raw = np.concatenate([means.raw, self.extreme_raw])
        variables = self.extreme_variables.reshape(len(self.extreme_raw), means.variables.shape[1])
        return raw, np.concatenate([means.variables, variables])

    @property
    def session(self) -> str:
        """Session that it belongs to; the recording where its file names none."""
        return self.interval.session or self.recording

    @property
    def means(self) -> WindowMeans:
        """The means, for a fit."""
        n = len(self.time_s)
        return WindowMeans(
            label=self.interval.label,
            session=self.session,
            recording=self.recording,
            time_s=self.time_s,
            count=self.count,
            raw=self.raw,
            reference=self.reference,
            flattening=self.flattening,
            variables=self.variables if self.variables.size else np.zeros((n, 0)),
            terms=self.terms,
            model=None if self.model is None else self.model.reshape(n, 6, len(self.terms)),
        )

    def with_model(self, terms: tuple[ErrorTerm, ...], columns: FloatArray) -> IntervalMoments:
        """Add what the robot model may have wrong.

        Args:
            terms: The numbers of the model.
            columns: Derivatives of the expected wrenches by these, on the same windows; shape (n, 6, terms).

        Returns:
            The same with them.
        """
        if not terms:
            return self
        return self.model_copy(update={"terms": terms, "model": columns.reshape(len(columns), -1)})

    @property
    def moments(self) -> Moments:
        """The moments of the samples."""
        return Moments(
            count=self.samples,
            channels=len(self.raw_minimum_counts),
            variables=len(self.variable_minimum),
            origin=self.mean,
            step=np.zeros_like(self.mean),
            second=self.second_moment,
        )


def end_samples(data: DataSet, moments: Moments) -> IntArray:
    """Find the samples at the ends of the range along channels, components of the load, and principal directions.

    Args:
        data: Samples.
        moments: Their moments.

    Returns:
        Indices of the samples, rising; shape (k,).
    """
    # which directions the recordings have together is known only when they are fitted, and means over a second miss
    # what fast movements reach
    _, of_raw = np.linalg.eigh(moments.raw_raw)
    scale = np.sqrt(np.maximum(np.diag(moments.reference_reference), np.finfo(float).tiny))
    _, of_loads = np.linalg.eigh(moments.reference_reference / np.outer(scale, scale))
    along = [data.raw.T, of_raw.T @ data.raw.T, data.reference.T, (of_loads.T / scale) @ data.reference.T]
    rows = [np.ascontiguousarray(row) for rows in along for row in rows]  # along samples is five times as fast
    return np.unique([[row.argmin(), row.argmax()] for row in rows])


class VariableDescription(StoredTable):
    """A linear variable of the sensor, as its experiment file describes it."""

    name: str
    """Name."""
    unit: str
    """Unit."""
    reference_value: float | None
    """Value at which it contributes nothing."""
    prior: _Wrench | None
    """Expected coefficients; N, N m per unit."""
    prior_deviation: _Wrench | None
    """How far they may be from these; N, N m per unit."""

    @classmethod
    def of(cls, variable: LinearVariable) -> VariableDescription:
        """Describe a variable.

        Args:
            variable: The variable.

        Returns:
            The same for a file.
        """
        names = ("name", "unit", "reference_value", "prior", "prior_deviation")
        return cls(**{name: getattr(variable, name) for name in names})

    @property
    def linear(self) -> LinearVariable:
        """The variable."""
        return LinearVariable(
            name=self.name,
            unit=self.unit,
            reference_value=self.reference_value,
            prior=self.prior,
            prior_deviation=self.prior_deviation,
        )


class RecordingMoments(StoredTable):
    """All that a calibration needs of the calibration intervals of one recording."""

    model_config = ConfigDict(
        defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True
    )

    schema_name: Literal["forcetorque/moments/2"] = Field(default=SCHEMA, alias="schema")
    """Form of the file."""
    sensor: SensorIdentity
    """The sensor."""
    experiment: str
    """Name of the experiment."""
    prior: Annotated[FloatArray, ArrayField((6, None))] | None
    """Prior matrix; N/count, N m/count."""
    prior_source: str | None
    """File that it came from."""
    full_scale: _Vector
    """Full scale of every channel; counts, or N and N m where a wrench stands for counts."""
    load_full_scale: _Wrench | None = None
    """Largest loads of a sensor of fewer than six components; N, N m; None for one of six."""
    accuracy: _Wrench | None
    """Accuracy of the reference; N, N m; None for 1e-3 of full scale."""
    repeatability: float
    """Share of its response by which the sensor differs from one motion to the next."""
    mount_rotation_rad: float | None = None
    """How far its frame may be turned from that of the robot model, as a standard deviation; None if not specified."""
    mount_shift_m: float | None = None
    """How far its origin may be from that of the robot model; m; None if not specified."""
    prior_size: _Wrench | None = None
    """How far coefficients of the prior matrix are off, relative to their row, as the file states it."""
    drift: bool
    """Whether the offset of a session may move evenly in time."""
    nonlinear: bool = False
    """Whether quadratic terms may correct readings."""
    variables: tuple[VariableDescription, ...]
    """Linear variables that are fitted."""
    intervals: tuple[IntervalMoments, ...] = Field(min_length=1)
    """The intervals."""
    warnings: tuple[str, ...] = ()
    """What makes any fit of them doubtful."""
    added: tuple[str, ...] = ()
    """What the experiment file adds to its log, in sentences."""
    load_error: LoadError | None = None
    """What is not known of loads that the sensor weighed itself; None where all were stated."""
    inputs_sha256: dict[str, str]
    """SHA-256 of every input file, by its path."""

    @property
    def assumptions(self) -> Assumptions:
        """What is known beside data and prior."""
        return Assumptions(
            full_scale=self.full_scale,
            load_full_scale=self.load_full_scale,
            accuracy=self.accuracy,
            repeatability=self.repeatability,
            mount=MountTolerance(rotation_rad=self.mount_rotation_rad, shift_m=self.mount_shift_m),
            prior_size=self.prior_size,
        )

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write it as JSON; on any error the file keeps what it held before.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            OutputError: If the file is an input of it, or a file that `force` is needed for.
        """
        write_stored_table(path, self, inputs_sha256=self.inputs_sha256.values(), force=force)


def read_moments(path: Path | str) -> RecordingMoments:
    """Read what `RecordingMoments.save` wrote.

    Args:
        path: JSON file.

    Returns:
        The moments.
    """
    return read_stored_table(
        path, RecordingMoments, expected="a file of moments, there is none; `calibrate --moments` makes one"
    )


def require_same_sensor(recordings: Sequence[RecordingMoments]) -> None:
    """Refuse to fit recordings of different sensors, or with different assumptions.

    Args:
        recordings: Moments of every recording, at least one.

    Raises:
        FitError: If they are not of one sensor that was mounted, described and read in one way, or a recording or its
            readings come twice.
    """
    if not recordings:
        raise FitError("expected at least one recording, got none")
    first = _compared(recordings[0])
    for other in recordings[1:]:
        for what, there in _compared(other).items():
            if first[what] != there:
                raise FitError(
                    f"{other.experiment!r}: expected the {what} of {recordings[0].experiment!r}, {first[what]}, got "
                    f"{there}; recordings are fitted together for one sensor, mounted, described and read in one way"
                )
    stretches = [(i.recording, i.interval.label) for recording in recordings for i in recording.intervals]
    for recording, label in stretches:
        if stretches.count((recording, label)) > 1:
            raise FitError(
                f"interval {label!r} of {recording!r} comes twice; its samples would too. Name another experiment, or "
                "leave one of the two out"
            )
    contents = ((one.recording, one.samples, one.interval.content) for part in recordings for one in part.intervals)
    for message in readings_twice(contents).values():
        raise FitError(f"{message}; leave one of the two out")


def _compared(recording: RecordingMoments) -> dict[str, Any]:
    sensor = recording.sensor
    return {
        "serial number": sensor.serial,
        "sensor": sensor.name,
        "mounting (frame, direction)": f"{sensor.frame}, {sensor.measure_direction.value}",
        "prior matrix": None if recording.prior is None else recording.prior.tolist(),
        "full scale": recording.full_scale.tolist(),
        "full scale of loads": None if recording.load_full_scale is None else recording.load_full_scale.tolist(),
        "accuracy": None if recording.accuracy is None else recording.accuracy.tolist(),
        "repeatability": recording.repeatability,
        "tolerance of the mount (rotation, shift)": [recording.mount_rotation_rad, recording.mount_shift_m],
        # its last digits are those of the processor that computed it
        "uncertainty of the prior matrix": None
        if recording.prior_size is None
        else [f"{size:.6g}" for size in recording.prior_size],
        "drift": recording.drift,
        "nonlinear": recording.nonlinear,
        "variables": [variable.model_dump(mode="json") for variable in recording.variables],
    }
