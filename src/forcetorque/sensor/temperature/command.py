# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench thermal`: what temperature does to a sensor at constant load."""

from collections.abc import Collection
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from forcetorque.experiment.calibrations_under_test import OneCalibration
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.sensor.temperature.temperature_drift import Thermal


@command("the drift over temperature, heating and cooling apart")
def thermal(
    run: Annotated[
        "SensorRun",
        Option("Sensor with a linear variable that is its temperature, at a load that does not change.", "--sensor"),
    ],
    calibration: Annotated[
        "OneCalibration | None",
        Option("Calibration that reads the sensor, for the drift that it leaves. Default: its prior, or as logged."),
    ] = None,
    *,
    intervals: Annotated[
        Collection[str], Option("Label of an interval. Default: all that are not ignored.", "--interval")
    ] = (),
    variable: Annotated[str | None, Option("Variable that is the temperature. Default: the only one in degC.")] = None,
) -> "Thermal":
    """Find how a reading drifts with temperature at a constant load.

    Example: forcetorque bench thermal cycles.toml --figure drift.png

    Python: `run.thermal(calibration)`

    Returns:
        Drift per degree and per hour, and hysteresis, with intervals.

    Raises:
        ExperimentError: If there is no temperature, or no such interval.
    """
    from forcetorque.experiment.calibrations_under_test import one_named
    from forcetorque.sensor.temperature.temperature_drift import temperature_drift

    return temperature_drift(run, run.read_by(*one_named(calibration)), intervals, variable)
