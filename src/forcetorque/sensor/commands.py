# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench thermal`, `drift`, `response`, `gains` and `sensor`."""

from collections.abc import Collection, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.results.command import Option, command
from forcetorque.results.terminal.command_output import Format, show, start_logging
from forcetorque.results.terminal.options import DetailsOption, ExperimentsArgument, FormatOption

if TYPE_CHECKING:
    from forcetorque.experiment.calibrations_under_test import OneCalibration
    from forcetorque.experiment.campaign import Runs
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.sensor.choice.load_case import LoadCase
    from forcetorque.sensor.choice.result import SensorChoice
    from forcetorque.sensor.gains.gains import Gains
    from forcetorque.sensor.sessions.session_drift import Drift
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


@command("offset and gain of every session with their intervals")
def drift(
    run: Annotated[
        "Runs", Option("Sensor in recordings of several sessions: files, or `session` of intervals.", "--sensor")
    ],
    calibration: Annotated[
        "OneCalibration | None",
        Option("Calibration that reads the sensor, without its offsets. Default: its prior, or as logged."),
    ] = None,
) -> "Drift":
    """Tell offset and gain of every session, and which changed beyond noise.

    Example: forcetorque bench drift monday.toml friday.toml --figure drift.png

    Python: `run.drift(calibration)`, over experiments `sensor.drift([run, other["arm_ft"]], calibration)`

    Returns:
        Offsets and gains by session with intervals, and their changes with a test.

    Raises:
        ExperimentError: If there are fewer than two sessions.
        FitError: If there are too few samples.
    """
    from forcetorque.experiment.calibrations_under_test import one_named
    from forcetorque.experiment.campaign import Campaign
    from forcetorque.sensor.sessions.session_drift import session_drift

    return session_drift(Campaign.of(run), *one_named(calibration))


def response(
    experiments: ExperimentsArgument,
    excitation: Annotated[
        str,
        typer.Option("--excitation", "-e", help="What was done to the sensor: impact, release, pendulum or static."),
    ],
    sensor: Annotated[str | None, typer.Option("--sensor", help="Sensor; the first of the file if left out.")] = None,
    component: Annotated[
        str | None, typer.Option("--component", help="Component of the wrench, such as fx; found if left out.")
    ] = None,
    force: Annotated[
        str | None,
        typer.Option("--force", help="Stream with the measured force (applied_wrench) or proper_acceleration."),
    ] = None,
    mass: Annotated[
        float | None, typer.Option("--mass-kg", help="Mass that was let go, or that the acceleration is of; kg.")
    ] = None,
    cut_off: Annotated[
        float | None, typer.Option("--cut-off-hz", help="Cut-off of the filter; its natural frequency if left out.")
    ] = None,
    interval: Annotated[
        list[str] | None,
        typer.Option("--interval", help="Label of an interval; repeat for more. Default: all that are not ignored."),
    ] = None,
    calibration: Annotated[
        Path | None, typer.Option("--calibration", "-c", help="Calibration that reads the sensor.")
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG, SVG or PDF of the response and of the decays.")
    ] = None,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Tell bandwidth and resonance of a sensor, their filter, or static curves.

    Example: forcetorque bench response taps.toml -e impact --force hammer

    Python: `run.response("impact", calibration)`
    """
    from forcetorque.experiment.campaign_intervals import refuse_a_file_twice
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.experiment.sensor_run import SensorRun
    from forcetorque.results.terminal.command_inputs import read_calibrations, read_experiment
    from forcetorque.results.terminal.command_output import drawn_to, refuse_figure
    from forcetorque.sensor.bandwidth.response import response

    log = start_logging()
    refuse_figure(figure)
    refuse_a_file_twice(experiments)
    calibrations = read_calibrations(None if calibration is None else [calibration])
    contents = [read_experiment(path, log) for path in experiments]
    with stated_in(", ".join(str(path) for path in experiments)):
        wanted = sensor if sensor is not None else contents[0].sensors[0].name
        result = response(
            [SensorRun(content, content.sensor(wanted)) for content in contents],
            excitation,
            calibrations or None,
            component=component,
            force=force,
            mass_kg=mass,
            cut_off_hz=cut_off,
            intervals=interval or (),
        )
    if figure is not None:
        result = drawn_to(result, figure)
    show(result, output_format, details=details, experiments=experiments)


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


_Three = tuple[float, float, float]


def _three(option: str, text: str) -> _Three:
    from forcetorque.sensor.choice.load_case import three_numbers

    return three_numbers(option, text)


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
        Option("Force on the sensor, in its frame; N, as 0,0,500.", typed=str, reads=partial(_three, "--force")),
    ] = None,
    lever: Annotated[
        _Three | None,
        Option("Point of the force from the origin of the sensor; m.", typed=str, reads=partial(_three, "--lever")),
    ] = None,
    moment: Annotated[
        _Three | None,
        Option("Moment beside that of the force; N m.", typed=str, reads=partial(_three, "--moment")),
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
