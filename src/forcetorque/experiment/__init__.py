# SPDX-License-Identifier: BSD-3-Clause
"""The experiment file, and what it leads to: recordings, sensors, samples, campaigns, sensor model and calibration."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names

if TYPE_CHECKING:
    from forcetorque.experiment.campaign import Campaign as Campaign
    from forcetorque.experiment.experiment import Experiment as Experiment
    from forcetorque.experiment.loading import load_experiment as load_experiment
    from forcetorque.experiment.sensor_run import SensorRun as SensorRun

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    Campaign="forcetorque.experiment.campaign",
    Experiment="forcetorque.experiment.experiment",
    SensorRun="forcetorque.experiment.sensor_run",
    load_experiment="forcetorque.experiment.loading",
)
