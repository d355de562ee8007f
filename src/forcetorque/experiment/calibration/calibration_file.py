# SPDX-License-Identifier: BSD-3-Clause
"""The `Calibration`: what a fit leaves on disk, tied to the serial number of one sensor."""

from __future__ import annotations

import json
import logging
from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, Final, Literal, Self

import numpy as np
from pydantic import ConfigDict, Field, field_validator

from forcetorque.base.arrays import ArrayField, BoolArray, FloatArray
from forcetorque.base.errors import FormatError, MissingFileError, RecordingError, SerialNumberError, ShapeError
from forcetorque.base.output_file import refuse_output, write_bytes_atomically
from forcetorque.base.stored_table import StoredTable, read_json, validated_table
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.calibration.provenance import Lambda, Provenance, Selection, SensorIdentity, Validity
from forcetorque.experiment.calibration.quadratic_correction import LinearityTest, NonlinearTrial, QuadraticCorrection
from forcetorque.experiment.calibration.robot_model_error import ModelError
from forcetorque.experiment.calibration.sensor_model import (
    LinearVariable,
    WrenchModel,
    measured_components,
    secondary_matrix,
)
from forcetorque.experiment.sensor_mount import SensorMount
from forcetorque.results.table import Table
from forcetorque.results.table_rendering import html_table, html_warnings

_LOG = logging.getLogger(__name__)

SCHEMA: Final = "forcetorque/calibration/4"
"""Name and version of the file's form."""
_FORM: Final = SCHEMA.rpartition("/")[0]

GENERATIVE: Final = "generative"
"""Name of the default estimator among the estimation types."""

JOINT: Final = "joint"
"""Name of the estimator of all sensors at once among the estimation types."""

JOINT_SCHEMA: Final = "forcetorque/joint/1"
"""Name and version of the form of the file that sensors of a joint calibration share."""


class Prior(StoredTable):
    """The matrix that the fit was pulled towards."""

    matrix: Annotated[FloatArray, ArrayField((6, None))]
    """Prior matrix; shape (6, c); N/count, N m/count."""
    offset: Annotated[FloatArray, ArrayField((6,))]
    """Offset that the fitted data give with the prior matrix; shape (6,); N, N m."""
    source: str
    """File that it came from."""


class CalibratedVariable(StoredTable):
    """What a linear variable, such as temperature, adds to the wrench."""

    name: str
    """Name."""
    unit: str
    """Unit."""
    reference_value: float
    """Value at which it contributes nothing."""
    coefficients: Annotated[FloatArray, ArrayField((6,))]
    """What is added per unit above that; shape (6,); N, N m per unit."""
    standard_error: Annotated[FloatArray, ArrayField((6,), minimum=0.0)] | None
    """Standard error of the coefficients by leaving out blocks."""
    prior: Annotated[FloatArray, ArrayField((6,))] | None = None
    """Coefficients that the fit was pulled towards."""
    minimum: float
    """Smallest fitted value."""
    maximum: float
    """Largest fitted value."""

    @classmethod
    def of(
        cls,
        variable: LinearVariable,
        reference_value: float,
        coefficients: FloatArray,
        standard_error: FloatArray | None,
        values: FloatArray,
    ) -> Self:
        """Tell what was fitted of a variable.

        Args:
            variable: What is known of it beside the data.
            reference_value: As of the class.
            coefficients: As of the class.
            standard_error: As of the class.
            values: Its fitted values, or the least and the largest of every interval.

        Returns:
            The same for the artefact.
        """
        return cls(
            name=variable.name,
            unit=variable.unit,
            reference_value=float(reference_value),
            coefficients=coefficients,
            standard_error=standard_error,
            prior=variable.prior,
            minimum=float(values.min()),
            maximum=float(values.max()),
        )


class SessionOffset(StoredTable):
    """Offset of one session: a stretch of time in which the sensor was not switched off."""

    name: str
    """Name of the session."""
    offset: Annotated[FloatArray, ArrayField((6,))]
    """Offset in wrench space; shape (6,); N, N m."""
    standard_error: Annotated[FloatArray, ArrayField((6,), minimum=0.0)] | None
    """Its standard error; N, N m."""
    drift_per_s: Annotated[FloatArray, ArrayField((6,))] | None = None
    """What is added to it per second; N/s, N m/s; None where it was taken as constant."""
    drift_from_ns: int | None = None
    """Instant from which the drift counts; ns on the recording's clock."""
    prior_offset: Annotated[FloatArray, ArrayField((6,))] | None
    """Offset that the same data give with the prior matrix; shape (6,); N, N m."""


class Calibration(StoredTable):
    """A fitted sensor: `wrench = matrix raw + sum of coefficients (variable - reference value) + offset`.

    Where there are quadratic terms, what they add at the load is taken off that.
    """

    model_config = ConfigDict(
        defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True, populate_by_name=True
    )

    schema_name: Literal["forcetorque/calibration/4"] = Field(default=SCHEMA, alias="schema")
    """Form of the file."""
    sensor: SensorIdentity
    """The sensor."""
    matrix: Annotated[FloatArray, ArrayField((6, None))]
    """Calibration matrix; shape (6, c); N/count, N m/count."""
    offset: Annotated[FloatArray, ArrayField((6,))]
    """Offset of the last session, in wrench space, where every variable has its reference value; shape (6,); N, N m."""
    sessions: tuple[SessionOffset, ...] = ()
    """Offset of every session; none in files of earlier versions."""
    variables: tuple[CalibratedVariable, ...] = ()
    """Linear variables; none for a type without."""
    quadratic: QuadraticCorrection | None = None
    """Quadratic terms that correct readings; None for a linear calibration."""
    nonlinear: NonlinearTrial | None = None
    """Whether such a correction won on recordings that were not fitted; None where it was not asked for."""
    linearity: LinearityTest | None = None
    """Whether the data show quadratic terms; None with a prior and six channels, or where a correction is asked for."""
    estimation_type: str = "OnTdTO"
    """`generative`, `joint`, or a type of thesis 5.1.4; `by axis` where every row has its own, see `selection`."""
    joint: str | None = None
    """File beside it with the covariance of all sensors that were calibrated together; None for one alone."""
    posterior: Posterior | None = None
    """What the generative model knows, from which the error of any reading follows; None for the thesis' types."""
    raw_offset_counts: Annotated[FloatArray, ArrayField((None,))] | None = None
    """Raw reading without load that a sphere type found; shape (c,)."""
    matrix_standard_error: Annotated[FloatArray, ArrayField((6, None), minimum=0.0)] | None
    """Standard error of the matrix: of the posterior, or for the thesis' types by leaving out blocks, without the pull
    of the prior; None where that was kept."""
    offset_standard_error: Annotated[FloatArray, ArrayField((6,), minimum=0.0)] | None
    """Standard error of the offset, likewise; N, N m."""
    residual_rms: Annotated[FloatArray, ArrayField((6,), minimum=0.0)]
    """Root mean square of readings less expected wrenches of the robot model as it is stated, on what was FITTED, means
    over a second or samples; N, N m."""
    noise_rms: Annotated[FloatArray, ArrayField((6,), minimum=0.0)] | None = None
    """What errors of the robot model, cables and quadratic terms, which the fit found beside the sensor, leave of that;
    N, N m; None where the model was taken as exact, for other estimators, and in files of earlier versions."""
    lambda_counts2: Lambda | None
    """Lambda of a thesis' type, convention of thesis (5.4); None where every row has its own, see `selection`, and for
    the generative model, which has none."""
    prior: Prior | None
    """Prior; None for the first calibration of a sensor."""
    validity: Validity
    """Where the fit is supported by data."""
    selection: Selection
    """How lambda came about."""
    warnings: tuple[str, ...] = ()
    """What makes the data doubtful that were fitted."""
    model_errors: tuple[ModelError, ...] = ()
    """What the fit found of the robot model, which it took as uncertain; none where it was taken as exact."""
    mount: SensorMount | None = None
    """Pose of the sensor against the robot model, stated or estimated before the fit; None for that of the model."""
    provenance: Provenance
    """What the fit was made from."""

    @field_validator("matrix")
    @classmethod
    def _reads_a_load(cls, matrix: FloatArray) -> FloatArray:
        if not matrix.any():
            raise ValueError("expected a matrix, got one of zeros, which reads no load")
        return matrix

    @property
    def model(self) -> WrenchModel:
        """Matrix, offset, coefficients of the variables, and quadratic terms."""
        coefficients = [variable.coefficients for variable in self.variables]
        return WrenchModel(
            matrix=self.matrix,
            offset=self.offset,
            coefficients=np.column_stack(coefficients) if coefficients else np.zeros((6, 0)),
            reference_values=np.array([variable.reference_value for variable in self.variables]),
            quadratic=self.quadratic,
        )

    def __repr__(self) -> str:
        sensor, count = self.sensor, self.provenance.samples
        prior = "no prior" if self.prior is None else f"prior {self.prior.source}"
        what = f"{self.estimation_type}, {count} samples of {self.provenance.experiment!r}, {prior}"
        return f"<Calibration of {sensor.name} ({sensor.serial}): {what}>"

    __str__ = __repr__

    def _repr_html_(self) -> str:
        errors = self.matrix_standard_error
        table = Table(
            caption=f"{self!r}: matrix with standard errors, offset",
            headings=("component", *(f"channel {k}" for k in range(self.matrix.shape[1])), "offset"),
            rows=tuple(
                (
                    f"{name}, {unit}",
                    *(
                        f"{value:.4g}" if errors is None else f"{value:.4g} ±{errors[k, j]:.1g}"
                        for j, value in enumerate(self.matrix[k])
                    ),
                    f"{self.offset[k]:.4g}",
                )
                for k, (name, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True))
            ),
        )
        shares = None if self.posterior is None else self.posterior.learnt_shares()
        learnt = "" if shares is None else f"<p>{_learnt(shares, measured_components(self.matrix))}</p>"
        return html_warnings(self.warnings) + html_table(table) + learnt

    def save(self, path: Path | str, *, force: bool = False) -> None:
        """Write the calibration as JSON; on any error the file keeps what it held before.

        Args:
            path: File to write or to replace, in an existing folder.
            force: Whether a file that is neither a result nor a figure may be replaced; an input never is.

        Raises:
            OutputError: If the file is an input of it, or a file that `force` is needed for.
        """
        refuse_output(path, inputs_sha256=self.provenance.inputs_sha256.values(), force=force)
        write_calibration(path, self)

    def in_session(self, name: str) -> Calibration:
        """Give the calibration with the offset of a session.

        Args:
            name: Name of the session.

        Returns:
            The calibration with that offset; the same where the session was not fitted.
        """
        for session in self.sessions:
            if session.name == name:
                prior = self.prior
                if prior is not None and session.prior_offset is not None:
                    prior = prior.model_copy(update={"offset": session.prior_offset})
                update = {"offset": session.offset, "offset_standard_error": session.standard_error, "prior": prior}
                return self.model_copy(update=update)
        return self

    def apply(
        self, raw: Any, *, serial: str, variables: Mapping[str, Any] | None = None, allow_foreign: bool = False
    ) -> FloatArray:
        """Turn raw readings of the sensor into wrenches.

        Args:
            raw: Raw readings; shape (..., c); counts.
            serial: Serial number of the sensor that gave them.
            variables: Values of the linear variables by name, such as `temperature`; shape (...) or one for all.
            allow_foreign: Whether another sensor's readings are to be accepted.

        Returns:
            Wrenches in the sensor's frame; shape (..., 6); N, N m.

        Raises:
            SerialNumberError: If the readings are of another sensor and that was not allowed.
            ShapeError: If the number of channels differs, or values of a variable do not fit the readings.
            RecordingError: If a variable is missing, or unknown to the calibration.
        """
        self.require_serial(serial, allow_foreign=allow_foreign)
        counts = np.asarray(raw, dtype=np.float64)
        return self.model.wrench(counts, self._values(counts, variables))

    def beyond_limits(self, raw: Any, *, variables: Mapping[str, Any] | None = None) -> BoolArray:
        """Tell which readings are of loads outside those that the quadratic terms were fitted to.

        Args:
            raw: As of `apply`.
            variables: As of `apply`.

        Returns:
            Whether the reading is corrected as at the limit, not at its own load; shape (...); False without terms.
        """
        counts = np.asarray(raw, dtype=np.float64)
        return self.model.beyond(counts, self._values(counts, variables))

    def _values(self, counts: FloatArray, variables: Mapping[str, Any] | None) -> FloatArray | None:
        by_name = {} if variables is None else variables
        names = [variable.name for variable in self.variables]
        if set(by_name) != set(names):
            raise RecordingError(
                f"calibration of sensor {self.sensor.serial!r}: expected values of the variables {names}, "
                f"got {sorted(by_name)}; its offset holds only with them"
            )
        values = [np.asarray(by_name[name], dtype=np.float64) for name in names]
        for name, value in zip(names, values, strict=True):
            if value.shape not in ((), counts.shape[:-1]):
                raise ShapeError(f"variable {name!r}: expected shape () or {counts.shape[:-1]}, got {value.shape}")
        return np.stack([np.broadcast_to(v, counts.shape[:-1]) for v in values], axis=-1) if values else None

    def require_serial(self, serial: str, *, allow_foreign: bool = False) -> None:
        """Refuse a sensor that is not the calibrated one.

        Args:
            serial: Serial number of the sensor at hand.
            allow_foreign: Whether another sensor is to be accepted.

        Raises:
            SerialNumberError: If it is another sensor and that was not allowed.
        """
        if serial != self.sensor.serial and not allow_foreign:
            raise SerialNumberError(
                f"calibration of sensor {self.sensor.serial!r}: expected readings of that sensor, got {serial!r}; "
                "every sensor has its own matrix"
            )

    def secondary_matrix(self) -> FloatArray | None:
        """Give the matrix that corrects a stream made with the prior (5.20), for the linear part of the reading.

        Returns:
            `C C_prior^-1`; shape (6, 6); None where there is no prior or it has not six channels and components.
        """
        if self.prior is None or self.matrix.shape != (6, 6) or not measured_components(self.matrix).all():
            return None
        return secondary_matrix(self.matrix, self.prior.matrix)


def _learnt(shares: FloatArray, measured: BoolArray) -> str:
    each = ", ".join(f"{WRENCH_COMPONENTS[k]} {100.0 * shares[k]:.0f} %" for k in np.flatnonzero(measured))
    return f"information gained of each load: {each}; the rest the prior decides"


def write_calibration(path: Path | str, calibration: Calibration) -> None:
    """Write a calibration as JSON, a field per line; on any error the file keeps what it held before.

    Args:
        path: File to write or to replace, in an existing folder.
        calibration: What to write.
    """
    content = calibration.model_dump(mode="json", by_alias=True)
    # no indent or space inside a field: an indent takes four times as long, and half as much space again
    texts = {name: json.dumps(value, allow_nan=False, separators=(",", ":")) for name, value in content.items()}
    lines = ",\n".join(f'  "{name}": {text}' for name, text in texts.items())
    write_bytes_atomically(Path(path), f"{{\n{lines}\n}}\n".encode())


def read_calibration(path: Path | str) -> Calibration:
    """Read a calibration that `write_calibration` wrote.

    Args:
        path: JSON file.

    Returns:
        The calibration.

    Raises:
        FormatError: If it is not a calibration of this schema version.
    """
    file = Path(path)
    if file.is_dir():
        raise FormatError(f"{file}: expected a calibration file, got a folder; name a file in it")
    try:
        content = read_json(file, expected="a calibration file, there is none; `forcetorque calibrate` makes one")
    except FormatError as error:
        raise FormatError(f"{error}; a calibration is a JSON file, which `forcetorque calibrate` writes") from error
    schema = content.get("schema") if isinstance(content, dict) else None
    if schema == JOINT_SCHEMA:
        raise FormatError(
            f"{file}: expected the calibration of a sensor, got what the sensors of a joint calibration share; name "
            "the files of the sensors beside it"
        )
    if schema != SCHEMA:
        raise FormatError(f"{file}: expected the schema {SCHEMA!r}, got {schema!r}; fit again with this version")
    return validated_table(file, Calibration, content)


def calibrations_in(folder: Path) -> dict[str, Calibration]:
    """Read the calibrations of a folder, such as `calibrate` and `run` write for several sensors.

    Args:
        folder: The folder; other results of the library in it are passed over, other JSON files with a warning in the
            log.

    Returns:
        Calibrations by name of their file, sorted by it.

    Raises:
        MissingFileError: If it holds none.
        FormatError: If one is of another schema version, or a JSON file is damaged.
    """
    schemas = {file: _schema(file) for file in sorted(folder.glob("*.json"))}
    files = [file for file, schema in schemas.items() if schema.startswith(_FORM)]
    if not files:
        raise MissingFileError(f"{folder}: expected a folder of calibrations, .json; it holds none")
    if others := [file.name for file, schema in schemas.items() if not schema.startswith("forcetorque/")]:
        _LOG.warning("%s: left out %s: expected calibrations, got other JSON files", folder, ", ".join(others))
    return {str(file): read_calibration(file) for file in files}


def is_other_result(file: Path) -> bool:
    """Find out whether a JSON file is another result of the library, such as the truth of a simulation.

    Args:
        file: The file.

    Returns:
        Whether its schema is one of the library and not that of a calibration.

    Raises:
        FormatError: If it is no JSON.
    """
    schema = _schema(file)
    return schema.startswith("forcetorque/") and not schema.startswith(_FORM)


def _schema(file: Path) -> str:
    """Name and version of a JSON file's form; empty if it has none."""
    content = read_json(file, expected="a JSON file")
    return str(content.get("schema", "")) if isinstance(content, dict) else ""
