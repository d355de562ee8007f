# SPDX-License-Identifier: BSD-3-Clause
"""Plausibility checks, the generative fit of one sensor, the joint fit of all, the fits of the thesis, export."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.calibration.calibrate import (
        calibrate_for_file as calibrate_for_file,
        calibrate_sensor as calibrate_sensor,
    )
    from forcetorque.calibration.export.command import export_calibrations as export_calibrations
    from forcetorque.calibration.joint.calibrate import calibrate_jointly as calibrate_jointly
    from forcetorque.calibration.reduced_recordings import (
        recording_moments as recording_moments,
        store_moments as store_moments,
    )
    from forcetorque.calibration.summary import information_figure as information_figure

CAPABILITY = Capability(
    page="calibration/calibration.md",
    needs=(
        "inspection",
        "payload",
    ),
    commands=(
        "forcetorque.calibration.calibrate_command:calibrate",
        "forcetorque.calibration.export.command:export",
    ),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    calibrate_for_file="forcetorque.calibration.calibrate",
    calibrate_jointly="forcetorque.calibration.joint.calibrate",
    calibrate_sensor="forcetorque.calibration.calibrate",
    export_calibrations="forcetorque.calibration.export.command",
    information_figure="forcetorque.calibration.summary",
    recording_moments="forcetorque.calibration.reduced_recordings",
    store_moments="forcetorque.calibration.reduced_recordings",
)
