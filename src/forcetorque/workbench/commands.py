# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench workbench`: known loads to a matrix, what to hang next, faults of the bench."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, Saved, command

if TYPE_CHECKING:
    from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
    from forcetorque.workbench.bench_recording import BenchRecording
    from forcetorque.workbench.result import Workbench


@command(
    "forces on the spheres of their loads, and of errors",
    Saved(
        flags=("--output", "-o"),
        help="File of the calibration (JSON) to write; of one sensor.",
        standard_output=True,
    ),
)
def workbench(
    *files: Annotated[
        "BenchRecording | Path | str", Option("Workbench files (TOML), one per sensor; see docs/workbench.md.")
    ],
    only_next: Annotated[
        bool, Option("Only check the blocks that are there, and say what to hang next.", "--next")
    ] = False,
    full_matrix: Annotated[bool, Option("Refuse loads that do not move all six directions.")] = False,
    spec: Annotated[
        "AcceptanceFile | Path | str | None", Option("Acceptance file (TOML) with limits; exit code 1 if one fails.")
    ] = None,
    seed: Annotated[int, Option("Seed of the partitions into folds.", python_only=True)] = 0,
) -> "Workbench":
    """Calibrate sensors with known loads, and find faults of the workbench.

    Example: forcetorque bench workbench SN170.toml -o SN170.json

    The exit code is 1 where a sensor has no matrix, or a limit of --spec fails.

    Python: `app.workbench("SN170.toml")`

    Returns:
        Faults, errors and matrices; `save` writes the calibration of a single sensor.
    """
    from importlib.metadata import version

    from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
    from forcetorque.results.result import created_now
    from forcetorque.workbench.bench_recording import BenchRecording, read_bench
    from forcetorque.workbench.calibrate import workbench

    return workbench(
        [given if isinstance(given, BenchRecording) else read_bench(given) for given in files],
        code_version=version("forcetorque"),
        created=created_now(),
        full_matrix=full_matrix,
        only_next=only_next,
        spec=read_acceptance(spec) if isinstance(spec, (Path, str)) else spec,
        seed=seed,
    )
