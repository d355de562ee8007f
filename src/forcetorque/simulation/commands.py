# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque simulate`: recordings with known truth, in the project's own form and as YARP folders."""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.simulation.recordings import WrittenScenario


@command()
def simulate(
    scenario: Annotated[
        "Path | str",
        Option("Scenario file (TOML), or a bundled one: icub-insitu, stance, switching, wrist.", typed=str),
    ],
    folder: Annotated["Path | str", Option("Folder to make.", "--output", "-o", folder=True)],
    *,
    progress: Annotated["Progress", Option("Called with a line for people at every recording, such as `print`.")] = (
        lambda _: None
    ),
) -> "WrittenScenario":
    """Make recordings of a simulated robot whose sensors are known.

    Example: forcetorque simulate wrist -o simulated

    Python: `app.simulate("wrist", "simulated")`

    Returns:
        What was written: an experiment file per recording.

    Raises:
        ForceTorqueError: If there is no such scenario, or the folder is there already.
    """
    from forcetorque.simulation.recordings import write_scenario
    from forcetorque.simulation.scenario.scenario import load_scenario
    from forcetorque.simulation.scenario.scenario_file import bundled_scenario

    file = Path(scenario) if str(scenario).endswith(".toml") else bundled_scenario(str(scenario))
    return write_scenario(load_scenario(file), folder, progress=progress)
