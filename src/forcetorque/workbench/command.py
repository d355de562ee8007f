# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque workbench`: known loads to a matrix, what to hang next, and what is wrong with the bench."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from forcetorque.base.errors import ForceTorqueError
from forcetorque.results.terminal.options import ForceOption, FormatOption
from forcetorque.results.terminal.output import (
    Format,
    refuse_two_on_standard_output,
    show,
    show_warnings,
    start_logging,
    stop_at_failures,
)

if TYPE_CHECKING:
    from forcetorque.workbench.result import Workbench


def workbench(
    files: Annotated[list[Path], typer.Argument(help="Workbench files (TOML), one per sensor; see docs/workbench.md.")],
    output: Annotated[
        Path | None, typer.Option("--output", "-o", help="File of the calibration (JSON) to write; of one sensor.")
    ] = None,
    next_only: Annotated[
        bool, typer.Option("--next", help="Only check the blocks that are there, and say what to hang next.")
    ] = False,
    full_matrix: Annotated[
        bool, typer.Option("--full-matrix", help="Refuse loads that do not move all six directions.")
    ] = False,
    spec: Annotated[
        Path | None, typer.Option("--spec", help="Acceptance file (TOML) with limits; exit code 1 if one fails.")
    ] = None,
    figure: Annotated[
        Path | None, typer.Option("--figure", help="PNG of forces on the spheres of their loads, and of errors.")
    ] = None,
    force: ForceOption = False,
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Calibrate sensors with known loads, and find faults of the workbench.

    Example: forcetorque workbench SN170.toml -o SN170.json

    Python: `app.workbench("SN170.toml")`
    """
    from importlib.metadata import version

    from forcetorque.base.output_file import declare_outputs
    from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance
    from forcetorque.results.result import created_now
    from forcetorque.results.terminal.output import refuse_figure
    from forcetorque.workbench.calibrate import workbench
    from forcetorque.workbench.recording import read_bench

    start_logging()
    refuse_figure(figure, force=force)
    if output is not None:
        _require_one(files, next_only=next_only)
        refuse_two_on_standard_output(output, output_format)
        declare_outputs(output, force=force)
    answer = workbench(
        [read_bench(file) for file in files],
        code_version=version("forcetorque"),
        created=created_now(),
        full_matrix=full_matrix,
        only_next=next_only,
        spec=None if spec is None else read_acceptance(spec),
    )
    if output is not None:
        answer.save(output)
        answer = answer.model_copy(update={"file": str(output)})
    if figure is not None:
        answer = _drawn(answer, figure)
    if output is not None and output.name == "-":
        show_warnings(answer)
    else:
        show(answer, output_format)
    stop_at_failures([criterion for criterion in answer.criteria if not criterion.passed])


def _require_one(files: list[Path], *, next_only: bool) -> None:
    if len(files) > 1 or next_only:
        raise ForceTorqueError("--output: expected one file and no --next, for a file holds one calibration")


def _drawn(answer: Workbench, figure: Path) -> Workbench:
    from forcetorque.base.output_file import write_bytes_atomically
    from forcetorque.results.figures import png_bytes
    from forcetorque.workbench.figure import bench_figure

    if answer.picture is None:
        raise ForceTorqueError(f"--figure {figure}: expected readings that tell a matrix, there are none to draw")
    write_bytes_atomically(figure, png_bytes(bench_figure(answer.picture)))
    return answer.model_copy(update={"figure": str(figure)})
