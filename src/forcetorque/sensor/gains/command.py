# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench gains`: how far the channels are from saturation, and which amplifier gains would suit them."""

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Annotated

from forcetorque.base.errors import ForceTorqueError
from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from forcetorque.experiment.calibrations_under_test import OneCalibration
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.sensor.gains.gains import Gains


def _numbers(option: str, text: str) -> tuple[float, ...]:
    try:
        numbers = tuple(float(word) for word in text.split(","))
    except ValueError as error:
        raise ForceTorqueError(f"{option} {text}: expected numbers with commas between them") from error
    if any(not 0.0 < number < float("inf") for number in numbers):
        raise ForceTorqueError(f"{option} {text}: expected finite numbers above 0")
    return numbers


@command("the channels against their limits, before and after")
def gains(
    run: Annotated["SensorRun", Option("Sensor with raw counts.", "--sensor", all_sensors=True)],
    calibration: Annotated[
        "OneCalibration | None", Option("Calibration whose matrix converts counts. Default: the prior.")
    ] = None,
    *,
    margin: Annotated[float, Option("Share of the limit to keep free for forces that were not recorded.")] = 0.2,
    amplifier_gain: Annotated[
        Sequence[float] | None,
        Option(
            "Present gains, like 24 or 24,24,24,36,36,36. Default: of the file.",
            typed=str,
            reads=partial(_numbers, "--amplifier-gain"),
        ),
    ] = None,
    allowed_gains: Annotated[
        Sequence[float] | None,
        Option(
            "Gains that can be set, like 8,16,24,36,48. Default: of the file.",
            typed=str,
            reads=partial(_numbers, "--allowed-gains"),
        ),
    ] = None,
) -> "Gains":
    """Show the head-room of raw channels and which amplifier gains suit them.

    Example: forcetorque bench gains experiment.toml --margin 0.2

    Python: `run.gains()`

    Returns:
        Ranges, advice and resolution over all intervals that are not ignored.

    Raises:
        ExperimentError: If all intervals are ignored, the counts are not known, or no sample has a reading.
        ShapeError: If the matrix does not have a column per channel.
        ForceTorqueError: If there is neither one gain nor one per channel, or gains are allowed and the present ones
            are not known.
    """
    from forcetorque.sensor.gains.gains import select_gains, with_gains

    return select_gains(with_gains(run, amplifier_gain, allowed_gains), calibration, margin=margin)
