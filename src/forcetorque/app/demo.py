# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque demo`: a simulated sensor whose true matrix is known is calibrated, evaluated and compared with it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from forcetorque.app.python.run import Run
    from forcetorque.base.arrays import FloatArray
    from forcetorque.experiment.calibration.calibration_file import Calibration

_EXPERIMENT = """\
schema = "forcetorque/experiment/1"
name = "arm with known truth"

[robot]
urdf = "arm.urdf"

[recording]
format = "parquet"
path = "recording"

[[sensor]]
name = "arm_ft"
stream = "arm_ft"
serial = "SIM001"
prior = "matrix_SIM001.txt"

[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "fit"
start_s = 1.0
end_s = 59.0
use = "calibration"
support = "base"

[[interval]]
label = "judge"
start_s = 61.0
end_s = 119.0
use = "validation"
support = "base"
"""
_FILES = ("experiment.toml", "arm.urdf", "matrix_SIM001.txt", "recording", "calibration.json", "before_and_after.png")
_PUSH_N, _LEVER_M, _PUSHES = 50.0, 0.3, 1000


def demo(
    folder: Annotated[
        Path, typer.Option("--output", "-o", help="Folder for the files; made if it is not there.")
    ] = Path("demo"),
) -> None:
    """Calibrate a simulated sensor whose true matrix is known, and compare.

    Example: forcetorque demo -o build/demo

    Python: `forcetorque.load_experiment(file)` reads what it made
    """
    from forcetorque.app.python.experiment import load_experiment
    from forcetorque.results.answer import answer_text
    from forcetorque.results.terminal.command_output import refuse_standard_output, shows_colours, start_logging, width

    log = start_logging()
    refuse_standard_output("--output", folder)
    log.info("simulating an arm for 120 s")
    mounted, factory = _simulated(folder)
    file, result = folder / "experiment.toml", folder / "calibration.json"
    log.info("calibrating on the first half")
    run = load_experiment(file)["arm_ft"]
    calibration = run.calibrate()
    calibration.save(result)
    log.info("evaluating on the second half")
    answers = run.evaluate({str(result): calibration}).answers()
    typer.echo(answer_text(tuple(answers), width(), str(file), coloured=shows_colours(sys.stdout)), nl=False)
    for name, (force, moment) in _errors_of_pushes(mounted, {"prior": factory, "new": calibration.matrix}).items():
        typer.echo(
            f"{name} matrix, push of {_PUSH_N:.0f} N that was not recorded: {force:.2f} N, {moment:.3f} N m wrong"
        )
    files = [
        "recording/",
        "experiment.toml",
        "matrix_SIM001.txt",
        "calibration.json",
        *_picture(run, calibration, folder),
    ]
    typer.echo(f"written to {folder}: {', '.join(files)}")


def _picture(run: Run, calibration: Calibration, folder: Path) -> list[str]:
    """Draw readings before and after against the expected wrench; name of the file, none without matplotlib."""
    from forcetorque.base.errors import MissingExtraError
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.results.figure_style import png_bytes

    try:
        figure = run.figure(calibration)
    except MissingExtraError as error:
        typer.echo(f"no picture: {error}", err=True)
        return []
    write_bytes_atomically(folder / "before_and_after.png", png_bytes(figure))
    return ["before_and_after.png"]


def _simulated(folder: Path) -> tuple[FloatArray, FloatArray]:
    """Write recording, robot, factory matrix and experiment file; the true matrix and that of the factory."""
    import shutil

    import numpy as np

    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
    from forcetorque.recording.storage import write_recording
    from forcetorque.robot.urdf import read_urdf
    from forcetorque.simulation.robots import ARM_URDF
    from forcetorque.simulation.simulated_sensor import SimulatedSensor, distorted_by_mounting, y_shaped_matrix
    from forcetorque.simulation.trace import simulate_recording

    _refuse_foreign(folder)
    folder.mkdir(parents=True, exist_ok=True)
    factory = y_shaped_matrix(arm_m=0.02, counts_per_newton=60.0)
    mounted = distorted_by_mounting(factory, relative=0.05, rng=np.random.default_rng(7))
    model = read_urdf(ARM_URDF)
    recording = simulate_recording(
        model,
        {
            "arm_ft": SimulatedSensor(
                matrix=mounted, offset=np.array([8.0, -5.0, 20.0, 0.3, -0.2, 0.1]), noise_counts=4.0
            )
        },
        support="base",
        gravity_direction=[0.0, 0.0, -1.0],
        ranges={joint: (-2.2, 2.2) for joint in model.joints if model.joints[joint].type.moves},
        duration_s=120.0,
        rate_hz=100.0,
        slowest_hz=0.05,
        seed=11,
    )
    write_recording(folder / "recording", recording)
    write_matrix_file(folder / "matrix_SIM001.txt", encode_matrix(factory))
    shutil.copyfile(ARM_URDF, folder / "arm.urdf")
    write_bytes_atomically(folder / "experiment.toml", _EXPERIMENT.encode())
    return mounted, factory


def _refuse_foreign(folder: Path) -> None:
    """Refuse a folder with an experiment that no demonstration made: its files have the same names."""
    from forcetorque.base.errors import OutputError

    if folder.exists() and not folder.is_dir():
        raise OutputError(f"{folder}: expected a folder, or a name for a new one, got a file")
    file = folder / "experiment.toml"
    made = file.is_file() and file.read_bytes() == _EXPERIMENT.encode()
    if not made and any((folder / name).exists() for name in _FILES):
        raise OutputError(f"{folder}: expected a new folder, or that of an earlier demonstration; name another one")


def _errors_of_pushes(mounted: FloatArray, matrices: dict[str, FloatArray]) -> dict[str, tuple[float, float]]:
    """Mean force and moment error of random pushes, which no recording has."""
    import numpy as np

    rng = np.random.default_rng(3)
    force, point = rng.normal(size=(2, _PUSHES, 3))
    force *= _PUSH_N / np.linalg.norm(force, axis=1, keepdims=True)
    point *= _LEVER_M * rng.uniform(size=(_PUSHES, 1)) / np.linalg.norm(point, axis=1, keepdims=True)
    push = np.hstack([force, np.cross(point, force)])
    errors = {name: push @ (matrix @ np.linalg.inv(mounted) - np.eye(6)).T for name, matrix in matrices.items()}
    return {
        name: (float(np.linalg.norm(error[:, :3], axis=1).mean()), float(np.linalg.norm(error[:, 3:], axis=1).mean()))
        for name, error in errors.items()
    }
