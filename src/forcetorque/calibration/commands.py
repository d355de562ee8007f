# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate`: from an experiment file to calibration files."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

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
    from functools import partial
    from importlib.metadata import version

    from forcetorque.base.output_file import declare_outputs
    from forcetorque.calibration.calibrate import SensorCalibrations, calibrate_for_file
    from forcetorque.calibration.corrected_urdf import write_corrected_urdf
    from forcetorque.calibration.joint.commands import calibrate_together, refuse_beside_jointly
    from forcetorque.calibration.reduced_recordings import store_moments
    from forcetorque.experiment.named_files import stated_in
    from forcetorque.results.result import created_now
    from forcetorque.results.terminal.command_inputs import campaign_of, readable_experiments, stored_moments
    from forcetorque.results.terminal.command_output import refuse_figure

    log = start_logging()
    refuse_standard_output("--output", output)
    refuse_figure(figure, force=force)
    if jointly:
        alone = {"--lambda": regularisation, "--type": kind, "--nonlinear": nonlinear, "--moments": moments}
        refuse_beside_jointly(alone)
        calibrate_together(
            experiments, output, sensor, figure, write_urdf, log, output_format, details=details, force=force
        )
        return
    stored = stored_moments(experiments)
    contents, left_out = readable_experiments([path for path in experiments if path.suffix != ".json"], log)
    names = _sensors(contents, stored, sensor)
    files = calibration_files(output, names)
    # folders of the others are made when they are written
    declare_outputs(*filter(Path.exists, filter(None, [*files, write_urdf])), force=force)
    if write_urdf is not None:
        _require_one_fit(write_urdf, names, contents)
    fit = partial(
        calibrate_for_file,
        code_version=version("forcetorque"),
        created=created_now(),
        regularisation=_lambda(regularisation),
        kind=_kind(kind),
        nonlinear=nonlinear,
    )
    results, refusals = [], []
    for (name, serial), file in zip(names, files, strict=True):
        log.info("fitting %s (%s)", name, serial)
        campaign = campaign_of(contents, name, left_out=left_out) if contents else None
        own = [one for one in stored.values() if one.sensor.name == name]
        try:
            with stated_in(f"{experiments[0]}: sensor {name!r}" if len(experiments) == 1 else f"sensor {name!r}"):
                campaign = None if campaign is None else campaign.usable()
                if campaign is not None:
                    _state_memory(campaign, log, thesis=kind not in (None, "generative") or regularisation is not None)
                if moments is not None and campaign is not None:
                    store_moments(campaign, moments, force=force)
                results.append(fit(campaign, file, moments=own))
        except ForceTorqueError as error:  # a limb that stands still says nothing against the others
            refusals.append(error)
            _warn_of_doubts(campaign, log)
    if results:
        refusals = _show(
            SensorCalibrations.together(results).save(force=force),
            figure,
            output_format,
            details=details,
            experiments=experiments,
            refusals=refusals,
        )
        if write_urdf is not None:
            write_corrected_urdf(next(iter(contents.values())), files[0], write_urdf, force=force)
            log.info("corrected robot model written to %s", write_urdf)
    end_with(refusals)


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


def _show(
    calibrations: SensorCalibrations,
    figure: Path | None,
    output_format: Format,
    *,
    details: bool,
    experiments: Sequence[Path],
    refusals: Sequence[ForceTorqueError],
) -> list[ForceTorqueError]:
    """Draw and show what was fitted; what cannot be drawn is shown all the same, and the refusals come back."""
    refusals = [*refusals]
    if figure is not None:
        try:
            calibrations = drawn_to(calibrations, figure)
        except ForceTorqueError as error:
            refusals.append(error)
    show(calibrations, output_format, details=details, experiments=experiments, refusals=refusals)
    return refusals


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
