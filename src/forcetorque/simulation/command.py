# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque simulate`: recordings with known truth, in the project's own form and as YARP folders."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from forcetorque.results.terminal.options import FormatOption
from forcetorque.results.terminal.output import Format, refuse_output_folder, show, start_logging


def simulate(
    scenario: Annotated[
        str, typer.Argument(help="Scenario file (TOML), or a bundled one: icub-insitu, stance, switching, wrist.")
    ],
    output: Annotated[Path, typer.Option("--output", "-o", help="Folder to make.")],
    output_format: FormatOption = Format.TABLE,
) -> None:
    """Make recordings of a simulated robot whose sensors are known.

    Example: forcetorque simulate wrist -o simulated

    Python: `app.simulate("wrist", "simulated")`
    """
    from forcetorque.simulation.recordings import write_scenario
    from forcetorque.simulation.scenario.file import bundled_scenario
    from forcetorque.simulation.scenario.scenario import load_scenario

    log = start_logging()
    file = Path(scenario) if scenario.endswith(".toml") else bundled_scenario(scenario)
    refuse_output_folder(output)
    show(write_scenario(load_scenario(file), output, progress=log.info), output_format)
