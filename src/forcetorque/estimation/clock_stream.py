# SPDX-License-Identifier: BSD-3-Clause
"""The stream at whose instants contacts and torques are estimated."""

from __future__ import annotations

from forcetorque.base.errors import ExperimentError
from forcetorque.experiment.experiment import Experiment
from forcetorque.recording.stream import Stream
from forcetorque.skin.experiment import force_patches


def clock_stream(experiment: Experiment) -> Stream:
    """Give the stream at whose instants is estimated.

    Args:
        experiment: The experiment.

    Returns:
        The stream of the first sensor, or of the first patch where there is none.

    Raises:
        ExperimentError: If there is neither.
    """
    if experiment.sensors:
        return experiment.recording.stream(experiment.sensors[0].stream)
    patches = force_patches(experiment)
    if not patches:
        raise ExperimentError(
            f"experiment {experiment.name!r}: expected [[sensor]], or a [[patch]] with a table, got neither; "
            "`forcetorque skin calibrate` makes a table"
        )
    return experiment.recording.stream(patches[0].counts)
