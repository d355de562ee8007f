# SPDX-License-Identifier: BSD-3-Clause
"""What several parts of a scene need, computed once."""

from __future__ import annotations

from dataclasses import replace

from forcetorque.analysis import Correction, SensorRun
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import Experiment, ExperimentSensor
from forcetorque.recording import Signal, Stream
from forcetorque.recording.smoothing import smooth_columns

_DERIVATIVES = {"velocity": 1, "acceleration": 2}


class Priors:
    """How sensors are read without a calibration; what cannot be read is known, too, and not tried again."""

    def __init__(self, experiment: Experiment) -> None:
        self._experiment = experiment
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
                self._known[sensor.name] = SensorRun(self._experiment, sensor).uncalibrated()
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
