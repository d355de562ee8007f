# SPDX-License-Identifier: BSD-3-Clause
"""The block of bytes with the arrays of a scene, and what several parts of a scene need."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

import numpy as np
import numpy.typing as npt

from forcetorque.base.errors import ForceTorqueError
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.smoothing import smooth_columns
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches
from forcetorque.viewer.scene import ArrayRef

ALIGNMENT = 8
"""Every array starts at a multiple of this many bytes."""


class Block:
    """Collects the arrays of a scene in one block of bytes."""

    def __init__(self, begin: int = 0) -> None:
        """Collect nothing yet.

        Args:
            begin: Where the block begins in a longer one; bytes.
        """
        self._parts: list[bytes] = []
        self._size = begin

    def add(self, values: npt.NDArray[Any], dtype: Literal["float32", "float64", "uint32"]) -> ArrayRef:
        """Append an array.

        Args:
            values: The array.
            dtype: Type to store it in.

        Returns:
            Where it is.
        """
        data = np.ascontiguousarray(values, dtype=np.dtype(dtype).newbyteorder("<")).tobytes()
        padding = -len(data) % ALIGNMENT
        reference = ArrayRef(offset=self._size, shape=tuple(values.shape), dtype=dtype)
        self._parts.append(data + b"\0" * padding)
        self._size += len(data) + padding
        return reference

    def bytes(self) -> bytes:
        """Give the whole block.

        Returns:
            Its bytes.
        """
        return b"".join(self._parts)


def read_array(block: bytes, reference: ArrayRef) -> npt.NDArray[Any]:
    """Give an array of a block.

    Args:
        block: The block.
        reference: Where the array is.

    Returns:
        The array, not to be changed.
    """
    dtype = np.dtype(reference.dtype).newbyteorder("<")
    count = int(np.prod(reference.shape))
    return np.frombuffer(block, dtype=dtype, count=count, offset=reference.offset).reshape(reference.shape)


def peak(wrenches: npt.NDArray[Any]) -> tuple[float, float]:
    """Find the largest force and the largest moment.

    Args:
        wrenches: Wrenches, NaN where absent; shape (n, 6); N, N m.

    Returns:
        Largest norm of each; N, N m; 0 where all are absent.
    """
    force, moment = (np.linalg.norm(wrenches[:, part], axis=1) for part in FORCE_AND_MOMENT)
    return float(np.nanmax(force, initial=0.0)), float(np.nanmax(moment, initial=0.0))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SceneDraft:
    """What all parts of a scene write into."""

    block: Block = field(default_factory=Block)
    """Takes the arrays."""
    notes: list[str] = field(default_factory=list)
    """Takes what is missing, and why."""
    sources: list[str] = field(default_factory=list)
    """Takes where the rest comes from."""


_DERIVATIVES = {"velocity": 1, "acceleration": 2}


class Priors:
    """How sensors are read without a calibration; what cannot be read is known, too, and not tried again."""

    def __init__(self, experiment: Experiment, sensors: Sequence[ExperimentSensor]) -> None:
        """Take the sensors that will be asked for, whose expected wrenches are computed together."""
        self._experiment = experiment
        self._shared = SharedWrenches(experiment.recording, {sensor.name: sensor.stream for sensor in sensors})
        self._known: dict[str, Correction | ForceTorqueError] = {}

    def of(self, sensor: ExperimentSensor) -> Correction:
        """Give the prior, or the logged wrench, with the offset that the calibration intervals give.

        Args:
            sensor: A sensor of the experiment.

        Returns:
            How it is read.

        Raises:
            ForceTorqueError: If it has no prior, or its offset cannot be found.
        """
        if sensor.name not in self._known:
            try:
                self._known[sensor.name] = SensorRun(self._experiment, sensor, shared=self._shared).uncalibrated()
            except ForceTorqueError as error:
                self._known[sensor.name] = error
        correction = self._known[sensor.name]
        if isinstance(correction, ForceTorqueError):
            raise correction
        return correction


def differentiated(experiment: Experiment) -> Experiment:
    """Put the derivatives of joint positions beside them, which are else computed again for every interval.

    Args:
        experiment: The experiment.

    Returns:
        One that gives the same wrenches; the same one where derivatives are logged or cannot be computed.
    """
    streams = experiment.recording.streams
    logged = any(_DERIVATIVES.keys() & stream.signals.keys() for stream in streams.values())
    if experiment.processing.logged_derivatives or logged:
        return experiment
    try:
        with_derivatives = {name: _with_derivatives(stream, experiment) for name, stream in streams.items()}
    except ForceTorqueError:
        return experiment  # whoever needs them says why there are none
    return replace(
        experiment,
        recording=replace(experiment.recording, streams=with_derivatives),
        processing=replace(experiment.processing, logged_derivatives=True),
    )


def _with_derivatives(stream: Stream, experiment: Experiment) -> Stream:
    if "position" not in stream.signals:
        return stream
    position = stream.signals["position"]
    window = experiment.processing.derivative_window
    signals = dict(stream.signals)
    for quantity, derivative in _DERIVATIVES.items():
        values = smooth_columns(stream.stamp_ns, position.values, window, derivative=derivative)
        units = tuple(unit + ("/s" if derivative == 1 else "/s2") for unit in position.units)
        signals[quantity] = Signal(quantity=quantity, values=values, columns=position.columns, units=units)
    return replace(stream, signals=signals)
