# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque extent`: how long sensors were logged."""

from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from forcetorque.extent.extents import Extent

    from forcetorque.experiment.sensor_run import SensorRun


@command()
def extent(run: Annotated["SensorRun", Option("Sensor.", "--sensor")]) -> "Extent":
    """Show how long sensors were logged.

    Example: forcetorque extent experiment.toml

    Python: `extent.extent(run)`
    """
    from forcetorque.extent.extents import sensor_extent

    return sensor_extent(run)
