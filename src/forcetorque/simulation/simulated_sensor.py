# SPDX-License-Identifier: BSD-3-Clause
"""A six-channel sensor with a Y-shaped element, the error of its workbench matrix, and what its board sends."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array, require_shape
from forcetorque.base.errors import FormatError, RecordingError, SensorError
from forcetorque.recording.recording import Recording
from forcetorque.recording.stream import QUANTITIES, Signal
from forcetorque.sensor.electronics import HeldCounts, hold_on_saturation
from forcetorque.simulation.sensor_effects import Creep, Crosstalk, Noise, ThermalDrift


def matrix_error(workbench: FloatArray, mounted: FloatArray) -> FloatArray:
    """Give E of `read = (1 + E) true`.

    Args:
        workbench: Matrix that readings are made with; shape (6, 6); N/count, N m/count.
        mounted: True matrix; shape (6, 6); N/count, N m/count.

    Returns:
        E, force before moment; shape (6, 6); 1, 1/m above on the right, m below on the left.
    """
    return workbench @ np.linalg.inv(mounted) - np.eye(6)


def random_matrix_error(share: float, lever_m: float, rng: np.random.Generator) -> FloatArray:
    """Draw an error of a given size.

    Args:
        share: Root mean square of its coefficients, moments over the lever taken for forces.
        lever_m: Moment over force; m.
        rng: Source of the error; the same draw for every size.

    Returns:
        E; shape (6, 6); 1, 1/m above on the right, m below on the left.
    """
    drawn = rng.standard_normal((6, 6))
    size = np.repeat([1.0, lever_m], 3)
    return share / np.sqrt((drawn**2).mean()) * drawn * size[:, None] / size


def mounted_matrix(where: str, workbench: FloatArray, error: FloatArray) -> FloatArray:
    """Give the true matrix of a sensor whose workbench matrix has an error.

    The matrix that moves is the mounted one: mounting is what changes a sensor, while the workbench matrix stays one
    that scatters like those of real sensors. Counts follow, since `mounted^-1 = workbench^-1 (1 + E)`.

    Args:
        where: What asks for the error, for messages.
        workbench: Matrix that readings are made with; shape (6, 6); N/count, N m/count.
        error: E of `read = (1 + E) true`; shape (6, 6).

    Returns:
        The true matrix; shape (6, 6); N/count, N m/count.

    Raises:
        FormatError: If no mounting can do so much.
    """
    # between no error and this one the sensor is singular somewhere if a real eigenvalue reaches -1
    values = np.linalg.eigvals(error)
    if ((values.imag == 0.0) & (values.real <= -1.0)).any():
        raise FormatError(
            f"{where}, with which a load would be read with the wrong sign; ask for less, or draw another sensor with "
            "another seed"
        )
    return np.asarray(np.linalg.solve(np.eye(6) + error, workbench), dtype=np.float64)


_ARM_ANGLES = np.deg2rad([0.0, 120.0, 240.0])


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SimulatedSensor(ArrayRecord):
    """What turns a true wrench into counts: `matrix raw + offset = wrench`, then all that spoils it."""

    matrix: FloatArray = field(metadata=array(6, 6))
    """True calibration matrix as mounted; shape (6, 6); N/count, N m/count."""
    offset: FloatArray = field(metadata=array(6))
    """True offset in wrench space, of one power-up; shape (6,); N, N m."""
    noise_counts: float
    """Standard deviation of white noise on every channel; counts."""
    noise_corner_hz: float = 0.0
    """Frequency below which 1/f noise prevails; Hz; 0 for none."""
    step_counts: float = 1.0
    """Step of the converter; 0 for none; counts."""
    limit_counts: int = 32767
    """Magnitude at which a channel is saturated; counts."""
    drift: ThermalDrift | None = None
    """Change with temperature."""
    creep: Creep | None = None
    """Slow response."""
    crosstalk: Crosstalk | None = None
    """Response that no matrix describes."""

    def read(
        self,
        wrench: FloatArray,
        rng: np.random.Generator,
        *,
        rate_hz: float,
        temperature_degC: FloatArray | None = None,
    ) -> HeldCounts:
        """Turn true wrenches into what the board streams.

        Args:
            wrench: True wrenches in the sensor's frame and direction, evenly in time; shape (n, 6); N, N m.
            rng: Source of the noise.
            rate_hz: Rate of the samples; Hz.
            temperature_degC: Temperature of the sensor; shape (n,); degC; needed if it drifts.

        Returns:
            Counts in whole steps within the limits, held while a channel is saturated, and the status.

        Raises:
            SensorError: If it drifts and there is no temperature.
        """
        response = np.asarray(np.linalg.solve(self.matrix, wrench.T).T, dtype=np.float64)
        if self.creep is not None:
            response = self.creep.response(response, rate_hz=rate_hz)
        counts = response - np.linalg.solve(self.matrix, self.offset)
        if self.crosstalk is not None:
            counts = counts + self.crosstalk.counts(wrench)
        if self.drift is not None:
            if temperature_degC is None:
                raise SensorError("temperature_degC: expected the temperature of a sensor that drifts, got none")
            counts = counts + self.drift.drift(temperature_degC, rate_hz=rate_hz)
        noise = Noise(white_counts=self.noise_counts, corner_hz=self.noise_corner_hz)
        counts = counts + noise.sample(*counts.shape, rate_hz=rate_hz, rng=rng)
        if self.step_counts > 0.0:
            counts = np.rint(counts / self.step_counts) * self.step_counts
        within = np.clip(counts, -self.limit_counts, self.limit_counts)
        return hold_on_saturation(within, lowest=-self.limit_counts, highest=self.limit_counts)

    def matrix_error(self, matrix: FloatArray) -> FloatArray:
        """Compute the error of a matrix for a true wrench w: it reads the counts as `(1 + E) w + bias`.

        Args:
            matrix: Matrix that readings are made with; shape (6, 6); N/count, N m/count.

        Returns:
            E, force before moment; shape (6, 6); 1, 1/m above on the right, m below on the left.
        """
        return matrix_error(matrix, self.matrix)

    def bias(self, matrix: FloatArray) -> FloatArray:
        """Compute the wrench by a matrix where nothing loads the sensor, beside `(1 + E) w`.

        Args:
            matrix: Matrix that readings are made with; shape (6, 6); N/count, N m/count.

        Returns:
            The bias; shape (6,); N, N m.
        """
        return -matrix @ np.linalg.solve(self.matrix, self.offset)


def y_shaped_matrix(*, arm_m: float, counts_per_newton: float) -> FloatArray:
    """Give the calibration matrix of an ideal sensor whose three arms carry two gauges each.

    One gauge of an arm sees the force across it in the plane, with the moment about z; the other
    sees the force along z, with the moments about x and y.

    Args:
        arm_m: Distance of the gauges from the axis; m.
        counts_per_newton: Sensitivity of a gauge; counts/N.

    Returns:
        The matrix; shape (6, 6); N/count, N m/count.
    """
    rows = []
    for angle in _ARM_ANGLES:
        cosine, sine = np.cos(angle), np.sin(angle)
        rows.append([-sine, cosine, 0.0, 0.0, 0.0, 1.0 / arm_m])
        rows.append([0.0, 0.0, 1.0, sine / arm_m, -cosine / arm_m, 0.0])
    return np.asarray(np.linalg.inv(counts_per_newton * np.array(rows)), dtype=np.float64)


def distorted_by_mounting(matrix: FloatArray, *, relative: float, rng: np.random.Generator) -> FloatArray:
    """Let mounting mix the channels: every coefficient moves by a random part of its row.

    Args:
        matrix: Matrix before mounting; shape (6, c).
        relative: Standard deviation of the change, relative to the root mean square of the row.
        rng: Source of the change.

    Returns:
        Matrix after mounting; shape (6, c).
    """
    scale = np.sqrt((matrix**2).mean(axis=1, keepdims=True))
    return matrix + relative * scale * rng.standard_normal(matrix.shape)


def calibrated_by_board(recording: Recording, stream: str, *, matrix: FloatArray, frame: str) -> Recording:
    """Replace the counts of a sensor by the wrench that its board makes of them.

    Args:
        recording: The recording.
        stream: Stream with the counts.
        matrix: Matrix that the board applies; shape (6, c); N/count, N m/count.
        frame: Frame of the sensor.

    Returns:
        The recording with `wrench` in place of `raw` in that stream.

    Raises:
        RecordingError: If the stream holds a wrench already.
    """
    source = recording.stream(stream)
    raw = source.signal("raw")
    if "wrench" in source.signals:
        raise RecordingError(f"stream {stream!r}: expected counts alone, got a wrench beside them")
    require_shape(matrix, name="matrix", shape=(6, len(raw.columns)))
    quantity = QUANTITIES["wrench"]
    wrench = Signal(
        quantity=quantity.name,
        values=raw.values @ matrix.T,
        columns=quantity.columns,
        units=quantity.units,
        frame=frame,
    )
    signals = {
        "wrench" if name == "raw" else name: wrench if name == "raw" else s for name, s in source.signals.items()
    }
    return replace(recording, streams={**recording.streams, stream: replace(source, signals=signals)})
