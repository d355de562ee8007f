# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file, and what it leads to: recordings, sensors, samples, campaigns, sensor model and calibration."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.experiment.campaign import Campaign
    from forcetorque.experiment.experiment import Experiment
    from forcetorque.experiment.loading import load_experiment
    from forcetorque.experiment.sensor_run import SensorRun

__all__ = [
    "Campaign",
    "Experiment",
    "SensorRun",
    "load_experiment",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "Campaign": "forcetorque.experiment.campaign",
        "Experiment": "forcetorque.experiment.experiment",
        "SensorRun": "forcetorque.experiment.sensor_run",
        "load_experiment": "forcetorque.experiment.loading",
    },
)
