# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench plate`: who or what stands on force plates."""

from collections.abc import Collection
from typing import TYPE_CHECKING, Annotated

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.results.command import Option, command

if TYPE_CHECKING:
    from pathlib import Path

    from forcetorque.plates.result import PlateWeight


@command()
def plate(
    file: Annotated["Path", Option("C3D file with force plates of types 1 to 4.")],
    *,
    start_s: Annotated[float | None, Option("Start of the interval; s. Default: the longest interval at rest.")] = None,
    end_s: Annotated[float | None, Option("End of the interval; s. Default: as of --start-s.")] = None,
    gravity: Annotated[float, Option("Magnitude of gravity; m/s2.")] = STANDARD_GRAVITY,
    recording: Annotated[
        Collection[str],
        Option("What the file leaves open, as origin_from=surface or force_unit=N; repeat for more.", "--recording"),
    ] = (),
) -> "PlateWeight":
    """Weigh who or what stands on force plates, and find plates that contradict each other.

    Example: forcetorque bench plate standing.c3d

    Python: `app.plate("standing.c3d")`

    Returns:
        Mass with its interval, centre of pressure on each plate, and contradictions.

    Raises:
        FormatError: If the file is damaged, or leaves something open that is not stated.
        ExperimentError: If nothing stands still on the plates.
    """
    from forcetorque.plates.plate_file import read_plates
    from forcetorque.plates.standing import weigh

    return weigh(read_plates(file, recording), gravity=gravity, start_s=start_s, end_s=end_s)
