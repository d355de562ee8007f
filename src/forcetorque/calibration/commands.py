# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate`: from an experiment file to calibration files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from forcetorque.base.errors import ExperimentError, FitError, ForceTorqueError, require_known
from forcetorque.base.units import parsed_number
from forcetorque.results.terminal.command_output import (
    Format,
    drawn_to,
    end_with,
    refuse_standard_output,
    show,
    start_logging,
)
from forcetorque.results.terminal.options import DetailsOption, ForceOption, FormatOption, SensorOption

if TYPE_CHECKING:
    import logging

    from forcetorque.calibration.calibrate import SensorCalibrations
    from forcetorque.experiment.calibration.estimation_type import EstimationType
    from forcetorque.experiment.calibration.stored_moments import RecordingMoments
    from forcetorque.experiment.campaign import Campaign
    from forcetorque.experiment.experiment import Experiment


def calibrate(
    experiments: Annotated[
        list[Path],
        typer.Argument(
            help="Experiment files (TOML), or files of moments (.json); all are fitted together. See docs/recording.md."
        ),
    ],
    output: Annotated[
        Path, typer.Option("--output", "-o", help="A .json file for one sensor, or a folder for one file per sensor.")
    ],
    sensor: SensorOption = None,
    regularisation: Annotated[
        str | None,
        typer.Option(
            "--lambda", help="Lambda of a thesis' type in counts2, or `held-out`. Default: what the experiment says."
        ),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option(
            "--type",
            help="`generative`, or a type of the thesis, SnTdTO to OwTrTO. Default: what the experiment says, else "
            "generative.",
        ),
    ] = None,
    nonlinear: Annotated[
        bool | None,
        typer.Option(
            "--nonlinear/--linear",
            help="Let quadratic terms correct readings where they win on recordings that were not fitted. Default: "
            "what the experiment says, else not.",
        ),
    ] = None,
    jointly: Annotated[
        bool,
        typer.Option(
            "--jointly",
            help="All sensors at once, from parts of the robot between them that nothing touches, whatever the feet "
            "do; see docs/calibration/joint.md.",
        ),
    ] = False,
    moments: Annotated[
        Path | None,
        typer.Option("--moments", help="Folder to keep what the fit needs of each recording, to be added to others."),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            help="PNG, SVG or PDF of the information gained: errors of every load, before and after; with "
            "--jointly what is left of the equation of every part.",
        ),
    ] = None,
    write_urdf: Annotated[
        Path | None,
        typer.Option(
            "--write-urdf",
            help="URDF file to write: that of the first experiment with the masses, centres of mass and joint zeros "
            "that the fit found. With one sensor, which does not separate all of them, or --jointly.",
        ),
    ] = None,
    force: ForceOption = False,
    details: DetailsOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Fit matrix and offset of each sensor to any number of recordings.

    Example: forcetorque calibrate cold.toml warm.toml -o calibrations

    Python: `run.calibrate()`, over experiments `run.calibrate(other["arm_ft"])`; `--jointly`:
    `forcetorque.calibrate_jointly([experiment])`
    """
    from forcetorque.calibration.corrected_urdf import write_corrected_urdf
    from forcetorque.calibration.joint.calibrate import JOINT_FILE
    from forcetorque.results.terminal.command_output import refuse_figure

    log = start_logging()
    refuse_standard_output("--output", output)
    refuse_figure(figure, force=force)
    refusals: list[ForceTorqueError] = []
    first: Experiment | None
    result: SensorCalibrations | None
    if jointly:
        alone = {"--lambda": regularisation, "--type": kind, "--nonlinear": nonlinear, "--moments": moments}
        refuse_beside_jointly(alone)
        first, result = _fitted_jointly(experiments, output, sensor, write_urdf, log, force=force)
        found = output / JOINT_FILE
    else:
        options = {"regularisation": _lambda(regularisation), "kind": _kind(kind), "nonlinear": nonlinear}
        first, found, result = _fitted_alone(
            experiments, output, sensor, moments, write_urdf, log, refusals, options, force=force
        )
    if result is not None:
        result = result.save(force=force)
        try:
            result = result if figure is None else drawn_to(result, figure)
        except ForceTorqueError as error:  # what cannot be drawn is shown all the same
            refusals.append(error)
        show(result, output_format, details=details, experiments=experiments, refusals=refusals)
        if write_urdf is not None and first is not None:
            write_corrected_urdf(first, found, write_urdf, force=force)
            log.info("corrected robot model written to %s", write_urdf)
    end_with(refusals)


def _fitted_alone(
    experiments: Sequence[Path],
    output: Path,
    wanted: Sequence[str] | None,
    moments: Path | None,
    write_urdf: Path | None,
    log: logging.Logger,
    refusals: list[ForceTorqueError],
    options: Mapping[str, Any],
    *,
    force: bool,
) -> tuple[Experiment | None, Path, SensorCalibrations | None]:
    """Fit sensor by sensor: first experiment, first file and calibrations; who is refused is added to the refusals."""
    from importlib.metadata import version

    from forcetorque.base.output_file import declare_outputs
    from forcetorque.calibration.calibrate import SensorCalibrations, calibrate_for_file
    from forcetorque.calibration.reduced_recordings import store_moments
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.results.result import created_now
    from forcetorque.results.terminal.command_inputs import campaign_of, readable_experiments, stored_moments

    stored = stored_moments(experiments)
    contents, left_out = readable_experiments([path for path in experiments if path.suffix != ".json"], log)
    names = _sensors(contents, stored, wanted)
    files = calibration_files(output, names)
    # folders of the others are made when they are written
    declare_outputs(*filter(Path.exists, filter(None, [*files, write_urdf])), force=force)
    if write_urdf is not None:
        _require_one_fit(write_urdf, names, contents)
    made: dict[str, Any] = {"code_version": version("forcetorque"), "created": created_now()}
    thesis = options["kind"] not in (None, "generative") or options["regularisation"] is not None
    results = []
    for (name, serial), file in zip(names, files, strict=True):
        log.info("fitting %s (%s)", name, serial)
        campaign = campaign_of(contents, name, left_out=left_out) if contents else None
        own = [one for one in stored.values() if one.sensor.name == name]
        try:
            with stated_in(f"{experiments[0]}: sensor {name!r}" if len(experiments) == 1 else f"sensor {name!r}"):
                if campaign is not None:
                    campaign = campaign.usable()
                    _state_memory(campaign, log, thesis=thesis)
                    if moments is not None:
                        store_moments(campaign, moments, force=force)
                results.append(calibrate_for_file(campaign, file, moments=own, **made, **options))
        except ForceTorqueError as error:  # a limb that stands still says nothing against the others
            refusals.append(error)
            _warn_of_doubts(campaign, log)
    result = SensorCalibrations.together(results) if results else None
    return next(iter(contents.values()), None), files[0], result


def refuse_beside_jointly(options: Mapping[str, object]) -> None:
    """Refuse options that only a sensor by itself has.

    Args:
        options: Values by option; None where it was not given.

    Raises:
        ExperimentError: If one was given.
    """
    for option, value in options.items():
        if value is not None:
            raise ExperimentError(
                f"{option}: all sensors together have no such choice; leave out {option} or --jointly"
            )


def _fitted_jointly(
    experiments: Sequence[Path],
    output: Path,
    wanted: Sequence[str] | None,
    write_urdf: Path | None,
    log: logging.Logger,
    *,
    force: bool,
) -> tuple[Experiment, SensorCalibrations]:
    """Fit all sensors at once: first experiment and calibrations."""
    from importlib.metadata import version

    from forcetorque.base.output_file import declare_outputs
    from forcetorque.calibration.joint.calibrate import JOINT_FILE, calibrate_jointly, calibration_file
    from forcetorque.results.result import created_now
    from forcetorque.results.terminal.command_inputs import read_experiments, sensors_named

    if output.suffix == ".json" or (output.exists() and not output.is_dir()):
        raise ExperimentError(
            f"--output {output}: expected a folder, for one file per sensor and {JOINT_FILE} with what they share"
        )
    contents = list(read_experiments(experiments, log).values())
    sensors = sensors_named(contents[0], wanted)
    files = [output / calibration_file(sensor.name, sensor.serial) for sensor in sensors]
    outputs = filter(None, [*files, output / JOINT_FILE, write_urdf])
    declare_outputs(*filter(Path.exists, outputs), force=force)  # as of one sensor alone
    names, made = [sensor.name for sensor in sensors], created_now()
    return contents[0], calibrate_jointly(
        contents, output, names, code_version=version("forcetorque"), created=made, progress=log.info
    )


_THESIS_BYTES, _WHOLE_BYTES, _OTHER_BYTES = 640, 1400, 500_000_000
"""Memory of a fit that holds all samples: for each by a type of the thesis, for each by the generative model, and for
all else; of one sensor in a leg of a biped, two thirds fitted, docs/measured.md."""
_LARGE_BYTES = 1_000_000_000
"""Memory that is stated before it is taken."""


def _state_memory(campaign: Campaign, log: logging.Logger, *, thesis: bool) -> None:
    """Say how much memory a fit takes that holds all samples at once, before it does."""
    experiments = [run.experiment for run in campaign.runs]
    thesis = thesis or not experiments[0].fit_options.generative
    estimated = campaign.sensor.mount_is_unknown or any(
        one.loads is not None and not one.loads.are_stated for one in experiments
    )
    if not thesis and not estimated:
        return
    samples = sum(len(run.stream.stamp_ns) for run in campaign.runs)
    size = _OTHER_BYTES + samples * (_THESIS_BYTES if thesis else _WHOLE_BYTES)
    if size > _LARGE_BYTES:
        why = "an estimation type or lambda" if thesis else "a mount or load that is estimated"
        instead = "without it the recording is" if thesis else "stated in the experiment file, the recording is"
        log.warning(
            "%s takes all %d samples at once, about %.1f GB of memory; %s read in segments",
            why,
            samples,
            size * 1e-9,
            instead,
        )


def _require_one_fit(write_urdf: Path, sensors: Sequence[object], contents: Mapping[Path, Experiment]) -> None:
    from forcetorque.experiment.calibration.robot_model_error import EXACT

    if len(sensors) != 1 or not contents:
        raise ExperimentError(
            f"--write-urdf {write_urdf}: expected an experiment and one sensor, or all sensors --jointly, got "
            f"{len(sensors)} sensors and {len(contents)} experiments; fits of several sensors find several masses for "
            "one link"
        )
    if next(iter(contents.values())).fit_options.tolerance == EXACT:
        raise ExperimentError(
            f'--write-urdf {write_urdf}: expected [robot] tolerance other than "exact", which leaves nothing to correct'
        )


def _warn_of_doubts(campaign: Campaign | None, log: logging.Logger) -> None:
    """Say what is doubtful in the data of a sensor that could not be fitted: it may be the reason."""
    from forcetorque.calibration.calibrate import data_doubts

    for sentence in campaign.left_out if campaign else ():
        log.warning("%s", sentence)
    for run in campaign.runs if campaign else ():
        for sentence in data_doubts(run):
            log.warning("%s", sentence)


def _sensors(
    contents: Mapping[Path, Experiment], stored: Mapping[Path, RecordingMoments], wanted: Sequence[str] | None
) -> list[tuple[str, str]]:
    """Names and serial numbers of the sensors that are meant: those of the first file, or of the moments."""
    from forcetorque.results.terminal.command_inputs import sensors_named

    for content in contents.values():
        sensors = [(sensor.name, sensor.serial) for sensor in sensors_named(content, wanted)]
        break
    else:
        known = {one.sensor.name: one.sensor.serial for one in stored.values()}
        for name in wanted or ():
            require_known(name, known, ExperimentError, f"--sensor: no file of moments is of {name!r}")
        sensors = [(name, known[name]) for name in dict.fromkeys(wanted or known)]
    for path, one in stored.items():
        # who names sensors leaves the others out on purpose
        if wanted is None and one.sensor.name not in dict(sensors):
            raise ExperimentError(
                f"{path}: moments of {one.sensor.name!r}, which is not fitted here; leave the file out, or name "
                "sensors with --sensor"
            )
    return sensors


def calibration_files(output: Path, sensors: Sequence[tuple[str, str]]) -> list[Path]:
    """Name the files of calibrations.

    Args:
        output: A .json file for one sensor, or a folder.
        sensors: Name and serial number of every sensor.

    Returns:
        A file per sensor.

    Raises:
        ExperimentError: If one file is to hold several, or the folder is another file.
    """
    from forcetorque.calibration.joint.calibrate import calibration_file

    if output.suffix == ".json":
        if len(sensors) != 1:
            raise ExperimentError(
                f"--output {output}: one file for {len(sensors)} sensors; name a folder, or one sensor with --sensor"
            )
        return [output]
    if output.exists() and not output.is_dir():
        raise ExperimentError(f"--output {output}: expected a folder or a .json file, got another file")
    return [output / calibration_file(name, serial) for name, serial in sensors]


def _kind(text: str | None) -> EstimationType | Literal["generative"] | None:
    from forcetorque.experiment.calibration.estimation_type import estimation_type

    if text is None:
        return None
    return "generative" if text == "generative" else estimation_type(text)


def _lambda(text: str | None) -> float | Literal["held-out"] | None:
    if text is None:
        return None
    if text == "held-out":
        return "held-out"
    value = parsed_number(text)
    if not value >= 0.0:
        raise FitError(f"--lambda: expected a number of at least 0 counts2 or `held-out`, got {text!r}")
    return value
