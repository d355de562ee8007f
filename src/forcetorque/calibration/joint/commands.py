# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque calibrate --jointly`: all sensors of a robot at once."""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from importlib.metadata import version
from pathlib import Path

from forcetorque.base.errors import ExperimentError
from forcetorque.base.output_file import declare_outputs
from forcetorque.calibration.corrected_urdf import write_corrected_urdf
from forcetorque.calibration.joint.calibrate import JOINT_FILE, calibrate_jointly, calibration_file
from forcetorque.results.result import created_now
from forcetorque.results.terminal.command_inputs import read_experiments, sensors_named
from forcetorque.results.terminal.command_output import Format, drawn_to, show


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


def calibrate_together(
    experiments: Sequence[Path],
    output: Path,
    sensors: Sequence[str] | None,
    figure: Path | None,
    write_urdf: Path | None,
    log: logging.Logger,
    output_format: Format,
    *,
    details: bool,
    force: bool,
) -> None:
    """Calibrate all sensors at once, write and show what comes out.

    Args:
        experiments: Experiment files.
        output: Folder for the calibrations.
        sensors: Names of the sensors; None for all of the first file.
        figure: File for the figure of what is left of the equations; None for none.
        write_urdf: File for the corrected URDF of the first experiment; None for none.
        log: Where messages go.
        output_format: Form of the result.
        details: As of `show`.
        force: As of `declare_outputs`.

    Raises:
        ExperimentError: If the output is not a folder.
    """
    if output.suffix == ".json" or (output.exists() and not output.is_dir()):
        raise ExperimentError(
            f"--output {output}: expected a folder, for one file per sensor and {JOINT_FILE} with what they share"
        )
    contents = list(read_experiments(experiments, log).values())
    chosen = sensors_named(contents[0], sensors)
    files = [output / calibration_file(sensor.name, sensor.serial) for sensor in chosen]
    outputs = filter(None, [*files, output / JOINT_FILE, write_urdf])
    declare_outputs(*filter(Path.exists, outputs), force=force)  # as of one sensor alone
    result = calibrate_jointly(
        contents,
        output,
        [sensor.name for sensor in chosen],
        code_version=version("forcetorque"),
        created=created_now(),
        progress=log.info,
    )
    written = result.save(force=force)
    if write_urdf is not None:
        write_corrected_urdf(contents[0], output / JOINT_FILE, write_urdf, force=force)
        log.info("corrected robot model written to %s", write_urdf)
    shown = written if figure is None else drawn_to(written, figure)
    show(shown, output_format, details=details, experiments=experiments)
