# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench sensor`: which sensor of a catalogue holds stated loads."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, command
from forcetorque.sensor.choice.load_case import three_numbers

if TYPE_CHECKING:
    from forcetorque.sensor.choice.load_case import LoadCase
    from forcetorque.sensor.choice.result import SensorChoice

_Three = tuple[float, float, float]


@command("the share of every range that the loads use, and what each sensing principle reads")
def choose_sensor(
    loads: Annotated[
        "Sequence[LoadCase] | Path | str | None",
        Option(
            "File of loads (TOML); see docs/sensor/choice.md. Default: one load by --force, --lever, --moment.",
            typed=Path,
        ),
    ] = None,
    *,
    force: Annotated[
        _Three | None,
        Option("Force on the sensor, in its frame; N, as 0,0,500.", typed=str, reads=partial(three_numbers, "--force")),
    ] = None,
    lever: Annotated[
        _Three | None,
        Option(
            "Point of the force from the origin of the sensor; m.", typed=str, reads=partial(three_numbers, "--lever")
        ),
    ] = None,
    moment: Annotated[
        _Three | None,
        Option("Moment beside that of the force; N m.", typed=str, reads=partial(three_numbers, "--moment")),
    ] = None,
    margin: Annotated[float, Option("Share of every range to keep free.")] = 0.2,
    catalogue: Annotated["Path | str | None", Option("Catalogue (TOML) of further sensors.", typed=Path)] = None,
) -> "SensorChoice":
    """Say which sensor holds a load, and compare sensing principles.

    Example: forcetorque bench sensor --force 0,0,500 --lever 0.05,0,0

    Python: `sensor.choose_sensor("loads.toml")`

    Returns:
        Ranges of the catalogue, the best first, and principles under the largest load.

    Raises:
        ForceTorqueError: If there is no load, or a file of loads beside one.
    """
    from forcetorque.base.errors import ForceTorqueError
    from forcetorque.sensor.catalogue import catalogue_with
    from forcetorque.sensor.choice.choice import rank_sensors
    from forcetorque.sensor.choice.load_case import load_case, read_load_cases

    stated = force is not None or moment is not None
    if stated and not any((*(force or ()), *(moment or ()))):
        raise ForceTorqueError("--force, --moment: expected a load that is not zero")
    if stated == (loads is not None) or (lever is not None and force is None):
        raise ForceTorqueError(
            "loads: expected a file of loads, or --force or --moment, and --lever only with --force; got "
            f"{'both' if stated and loads is not None else 'a lever alone' if lever is not None else 'neither'}"
        )
    zero = (0.0, 0.0, 0.0)
    if loads is None:
        loads = [load_case("the load", force=force or zero, lever=lever or zero, moment=moment or zero)]
    cases = read_load_cases(loads) if isinstance(loads, Path | str) else loads
    return rank_sensors(cases, catalogue_with(catalogue), margin=margin)


sensor = choose_sensor
"""The command."""
