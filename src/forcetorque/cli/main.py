# SPDX-License-Identifier: BSD-3-Clause
"""The parser of every command; scientific modules are imported when a command runs."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Annotated

import typer

from forcetorque.cli.options import CalibrationsOption, ExperimentArgument, FormatOption, SensorOption
from forcetorque.cli.output import ExportFormat, Format, OtherSensorsChoice
from forcetorque.errors import ForceTorqueError

app = typer.Typer(
    name="forcetorque",
    help="Calibrate force-torque sensors where they are mounted, and say how far to trust them.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)


def main() -> None:
    """Run the command line; a known error is one line on standard error and exit code 2."""
    try:
        app()
    except (ForceTorqueError, OSError) as error:
        sys.stderr.write("error: " + " ".join(str(error).split()) + "\n")
        raise SystemExit(2) from None


@app.callback(invoke_without_command=True)
def _version(
    version: Annotated[bool, typer.Option("--version", help="Print the version and stop.", is_eager=True)] = False,
) -> None:
    if version:
        from importlib.metadata import version as installed_version

        typer.echo(installed_version("forcetorque"))
        raise typer.Exit


@app.command("accept")
def _accept(
    experiment: ExperimentArgument,
    spec: Annotated[
        Path, typer.Option("--spec", help="Acceptance file (TOML) with the limits; see docs/acceptance.md.")
    ],
    calibration: CalibrationsOption = None,
    population: Annotated[
        list[Path] | None,
        typer.Option(
            "--population", help="Matrix file or calibration of another sensor, or a folder of them; repeat for more."
        ),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Accept or reject sensors by limits; exit code 1 if one fails.

    Example: forcetorque accept experiment.toml --spec limits.toml -c leg.json
    """
    from forcetorque.cli.accept import run

    run(experiment, spec=spec, calibrations=calibration, population=population, output_format=output_format)


@app.command("calibrate")
def _calibrate(
    experiment: ExperimentArgument,
    output: Annotated[
        Path, typer.Option("--output", "-o", help="A .json file for one sensor, or a folder for one file per sensor.")
    ],
    sensor: SensorOption = None,
    regularisation: Annotated[
        str | None,
        typer.Option("--lambda", help="Lambda in counts2, or `held-out`. Default: what the experiment file says."),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option("--type", help="Estimation type, SnTdTO to OwTrTO. Default: what the experiment file says."),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Fit the matrix and offset of each sensor on the calibration intervals.

    Example: forcetorque calibrate experiment.toml -o right_leg.json
    """
    from forcetorque.cli.calibrate import run

    run(
        experiment,
        output=output,
        sensors=sensor,
        regularisation=regularisation,
        kind=kind,
        output_format=output_format,
    )


@app.command("estimate")
def _estimate(
    experiment: ExperimentArgument,
    output: Annotated[Path, typer.Option("--output", "-o", help="File for every sample, .parquet or .csv.")],
    calibration: CalibrationsOption = None,
    contacts: Annotated[
        list[str] | None,
        typer.Option(
            "--contacts",
            help="FRAME, FRAME:force or FRAME:force_along:x,y,z; repeat for more. Default: those of the file, else "
            "at the sensors.",
        ),
    ] = None,
    length_scale: Annotated[
        float | None,
        typer.Option("--length-scale", help="Moment that weighs as much as one newton; m. For more than six unknowns."),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Estimate contact wrenches, joint torques and expected readings.

    Example: forcetorque estimate experiment.toml -o estimates.parquet
    """
    from forcetorque.cli.estimate import run

    run(
        experiment,
        output=output,
        calibrations=calibration,
        contacts=contacts,
        length_scale=length_scale,
        output_format=output_format,
    )


@app.command("evaluate")
def _evaluate(
    experiment: ExperimentArgument,
    calibration: Annotated[
        list[Path], typer.Option("--calibration", "-c", help="Calibration file; repeat to compare several.")
    ],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Judge calibrations on the validation intervals, prior against new.

    Example: forcetorque evaluate experiment.toml --calibration right_leg.json
    """
    from forcetorque.cli.evaluate import run

    run(experiment, calibrations=calibration, output_format=output_format)


@app.command("export")
def _export(
    calibration: Annotated[list[Path], typer.Argument(help="Calibration files; one for icub-matrix.")],
    to: Annotated[
        ExportFormat,
        typer.Option(
            "--to",
            help="Matrix file for the sensor's DSP, XML groups for wholebodydynamics, a plain table, or the "
            "coefficients of temperature and other variables by themselves.",
        ),
    ],
    output: Annotated[Path, typer.Option("--output", "-o", help="File to write.")],
    full_scale: Annotated[
        tuple[int, int, int, int, int, int] | None,
        typer.Option(
            "--full-scale", help="Six full scales for icub-matrix; N, N m. Default: chosen to hold the matrix."
        ),
    ] = None,
    sensor_name: Annotated[
        str | None,
        typer.Option("--sensor-name", help="Name of the sensor in the robot's configuration, for wholebodydynamics."),
    ] = None,
    stream: Annotated[
        Path | None,
        typer.Option(
            "--stream", help="Calibration that the stream is already made with. Default: the prior matrix alone."
        ),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Write calibrations as files that a robot or another program reads.

    Example: forcetorque export leg.json --to wholebodydynamics -o leg.xml
    """
    from forcetorque.cli.export import run

    run(
        calibration,
        to=to,
        output=output,
        full_scale=full_scale,
        sensor_name=sensor_name,
        stream=stream,
        output_format=output_format,
    )


@app.command("gains")
def _gains(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    margin: Annotated[
        float, typer.Option("--margin", help="Share of the limit to keep free for forces that were not recorded.")
    ] = 0.2,
    amplifier_gain: Annotated[
        str | None,
        typer.Option("--amplifier-gain", help="Present gains, like 24 or 24,24,24,36,36,36. Default: of the file."),
    ] = None,
    allowed_gains: Annotated[
        str | None,
        typer.Option("--allowed-gains", help="Gains that can be set, like 8,16,24,36,48. Default: of the file."),
    ] = None,
    calibration: CalibrationsOption = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the channels against their limits, before and after.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Show the head-room of raw channels and which amplifier gains suit them.

    Example: forcetorque gains experiment.toml --margin 0.2
    """
    from forcetorque.cli.gains import run

    run(
        experiment,
        sensors=sensor,
        margin=margin,
        amplifier_gain=amplifier_gain,
        allowed_gains=allowed_gains,
        calibrations=calibration,
        figure=figure,
        output_format=output_format,
    )


@app.command("inspect")
def _inspect(
    log: Annotated[
        Path, typer.Argument(help="Experiment file, YARP dumper folder, or folder of the project's own form.")
    ],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Find gaps, lost messages, frozen or saturated sensors, steps and contacts.

    Example: forcetorque inspect experiment.toml
    """
    from forcetorque.cli.inspect import run

    run(log, output_format=output_format)


@app.command("payload")
def _payload(experiment: ExperimentArgument, output_format: FormatOption = Format.TABLE) -> None:
    """Estimate mass, centre of mass and bias of a wrist sensor's load.

    Example: forcetorque payload experiment.toml
    """
    from forcetorque.cli.payload import run

    run(experiment, output_format=output_format)


@app.command("schema")
def _schema(
    name: Annotated[
        str,
        typer.Argument(
            help="experiment, acceptance, scenario, recording, calibration, accept, calibrate, estimate, evaluate, "
            "export, gains, inspect, payload, simulate, sphere, study, validate or view."
        ),
    ],
) -> None:
    """Print the JSON schema of a file or of a command's result.

    Example: forcetorque schema experiment
    """
    from forcetorque.cli.schema import run

    run(name)


@app.command("simulate")
def _simulate(
    scenario: Annotated[str, typer.Argument(help="Scenario file (TOML), or icub-insitu or wrist for a bundled one.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder to make.")],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Make recordings of a simulated robot whose sensors are known.

    Example: forcetorque simulate wrist -o simulated
    """
    from forcetorque.cli.simulate import run

    run(scenario, output=output, output_format=output_format)


@app.command("sphere")
def _sphere(
    experiment: ExperimentArgument,
    sensor: SensorOption = None,
    calibration: Annotated[
        list[Path] | None,
        typer.Option("--calibration", "-c", help="Calibration file to compare with the prior; repeat for more."),
    ] = None,
    interval: Annotated[
        list[str] | None,
        typer.Option(
            "--interval",
            help="Label or kind of an interval whose motion draws a sphere; repeat for more. Default: the sphere "
            "intervals of the file, else all.",
        ),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of the forces, the ellipsoids and the weight by the model.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Compare how the three axes weigh a limb that is carried around.

    Example: forcetorque sphere experiment.toml --interval grid
    """
    from forcetorque.cli.sphere import run

    run(
        experiment,
        sensors=sensor,
        calibrations=calibration,
        intervals=interval,
        figure=figure,
        output_format=output_format,
    )


@app.command("study")
def _study(
    experiments: Annotated[list[Path], typer.Argument(help="Experiment files (TOML) with the same sensors.")],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder to make, with a folder per sensor.")],
    sensor: SensorOption = None,
    data_set: Annotated[
        list[str] | None,
        typer.Option(
            "--data-set",
            help="NAME=LABEL,LABEL: intervals, by label or kind, that are fitted together; repeat for more. Default: "
            "every combination of kinds.",
        ),
    ] = None,
    kind: Annotated[
        list[str] | None,
        typer.Option("--type", help="Estimation type, SnTdTO to OwTrTO; repeat for more. Default: all nine."),
    ] = None,
    regularisation: Annotated[
        list[float] | None,
        typer.Option(
            "--lambda",
            help="Lambda as the thesis' tables count it, a sixth of that of its equation (5.4); repeat for more. "
            "Default: the thirteen of the tables.",
        ),
    ] = None,
    sphere: Annotated[
        list[str] | None,
        typer.Option(
            "--sphere",
            help="Interval whose motion draws a sphere, for the types S...; repeat for more. Default: what the files "
            "say.",
        ),
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Fit every estimation type, lambda and data set, and choose.

    Example: forcetorque study simulated/*.toml --sphere grid -o study
    """
    from forcetorque.cli.study import run

    run(
        experiments,
        output=output,
        sensors=sensor,
        data_sets=data_set,
        kinds=kind,
        lambdas=regularisation,
        sphere=sphere,
        output_format=output_format,
    )


@app.command("validate")
def _validate(
    experiment: ExperimentArgument,
    calibration: CalibrationsOption = None,
    sensor: Annotated[
        list[str] | None,
        typer.Option(
            "--sensor", help="Sensor to judge; repeat for more. Default: those of the calibrations, else all."
        ),
    ] = None,
    sub_model: Annotated[
        str | None,
        typer.Option(
            "--sub-model",
            help="Part of the robot that nothing touches, by the sensor at its base or the root link. Default: that "
            "beyond the sensor.",
        ),
    ] = None,
    contact: Annotated[
        str | None,
        typer.Option("--contact", help="Link at whose origin the contact is estimated. Default: that on the sensor."),
    ] = None,
    others: Annotated[
        OtherSensorsChoice,
        typer.Option("--others", help="What the other sensors of the part read: what the model expects, or measured."),
    ] = OtherSensorsChoice.MODEL,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Judge calibrations by the contact force where nothing touches.

    Example: forcetorque validate experiment.toml -c right_leg.json
    """
    from forcetorque.cli.validate import run
    from forcetorque.evaluation import OtherSensors

    run(
        experiment,
        calibrations=calibration,
        sensors=sensor,
        sub_model=sub_model,
        contact=contact,
        other_sensors=OtherSensors(others.value),
        output_format=output_format,
    )


@app.command("view")
def _view(
    experiment: ExperimentArgument,
    calibration: CalibrationsOption = None,
    sensor: SensorOption = None,
    output: Annotated[
        Path | None,
        typer.Option("--output", "-o", help="File for the page, which then works offline. Default: it is served."),
    ] = None,
    no_browser: Annotated[bool, typer.Option("--no-browser", help="Print the address and open nothing.")] = False,
    port: Annotated[
        int | None, typer.Option("--port", help="Port of 127.0.0.1 to serve at. Default: any that is free.")
    ] = None,
    mesh_dir: Annotated[
        list[Path] | None,
        typer.Option("--mesh-dir", help="Folder that holds the packages of meshes, or is one; repeat for more."),
    ] = None,
    video: Annotated[Path | None, typer.Option("--video", help="File for a video (MP4); needs chromium.")] = None,
    fps: Annotated[float, typer.Option("--fps", help="Frames per second of the video.")] = 25.0,
    speed: Annotated[float, typer.Option("--speed", help="Seconds of the log per second of the video.")] = 1.0,
    start: Annotated[float | None, typer.Option("--start", help="Start of the video; s. Default: of the log.")] = None,
    end: Annotated[float | None, typer.Option("--end", help="End of the video; s. Default: of the log.")] = None,
    size: Annotated[tuple[int, int], typer.Option("--size", help="Width and height of the video; pixels.")] = (
        1280,
        720,
    ),
    browser: Annotated[
        Path | None, typer.Option("--browser", help="Program that draws the video. Default: chromium or chrome.")
    ] = None,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Show robot pose and force space, linked in time, in the browser.

    Example: forcetorque view experiment.toml -c right_leg.json -o view.html
    """
    from forcetorque.cli.view import run

    run(
        experiment,
        calibrations=calibration,
        sensors=sensor,
        mesh_folders=mesh_dir,
        output=output,
        port=port,
        open_browser=not no_browser,
        video=video,
        fps=fps,
        speed=speed,
        start_s=start,
        end_s=end,
        size=size,
        browser=browser,
        output_format=output_format,
    )
