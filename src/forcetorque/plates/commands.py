# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque bench plate` and `bench fit-plate`: who stands on force plates, and their calibration."""

from collections.abc import Collection
from typing import TYPE_CHECKING, Annotated

from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import MeasureDirection
from forcetorque.results.command import Option, Saved, command

if TYPE_CHECKING:
    from pathlib import Path

    from forcetorque.plates.result import PlateCalibration, PlateWeight


@command("the force on every plate and where it acts")
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
    """Weigh who stands on force plates, and compare the plates.

    Example: forcetorque bench plate standing.c3d

    Python: `plates.plate("standing.c3d")`

    Returns:
        Mass with its interval, centre of pressure on each plate, and contradictions.

    Raises:
        FormatError: If the file is damaged, or leaves something open that is not stated.
        ExperimentError: If nothing stands still on the plates.
    """
    from forcetorque.plates.plate_file import read_plates
    from forcetorque.plates.weight_on_plates import weigh

    return weigh(read_plates(file, recording), gravity=gravity, start_s=start_s, end_s=end_s)


@command(
    "the errors of the centre of pressure over the plate, before and after",
    Saved(flags=("--output", "-o"), help="File of the calibration (JSON) to write.", standard_output=True),
    Saved(
        flags=("--cal-matrix",),
        help="File of CAL_MATRIX to write: six rows of numbers in the units of the C3D file.",
        function="forcetorque.plates.result:save_cal_matrix",
    ),
)
def fit_plate(
    file: Annotated["Path", Option("C3D file of a trial with known loads on a force plate.")],
    *,
    measure_direction: Annotated[
        str,
        Option(
            "Who acts on whom in the channels: child_to_parent if they hold the force on the plate (Fz above 0 under a "
            "load), parent_to_child if they hold the reaction.",
            "--measure-direction",
            "-d",
            choices=tuple(direction.value for direction in MeasureDirection),
        ),
    ],
    serial: Annotated[str, Option("Serial number of the plate.", "--serial", "-s")],
    plate: Annotated[int | None, Option("Number of the plate, from 1. Default: the only one.")] = None,
    tip: Annotated[str | None, Option("Marker at the tip of an instrumented pole.")] = None,
    head: Annotated[str | None, Option("Another marker on the axis of the pole.")] = None,
    load_cell: Annotated[str | None, Option("Channel of its load cell; compression positive, N or kN.")] = None,
    weights: Annotated[
        "Path | None",
        Option(
            "Table (CSV) of weights in place of a pole, with start_s and end_s of each; see docs/guides/plates.md.",
            "--weights",
            "-w",
        ),
    ] = None,
    recording: Annotated[
        Collection[str],
        Option("What the file leaves open, as origin_from=surface or force_unit=N; repeat for more.", "--recording"),
    ] = (),
) -> "PlateCalibration":
    """Calibrate a force plate with a pole or weights.

    Example: forcetorque bench fit-plate a.c3d -s F -d parent_to_child -w w.csv

    Python: `plates.fit_plate("pole.c3d", serial="FP1", measure_direction="parent_to_child", tip="pole_tip", ...)`

    Returns:
        Gains, cross-talk, error of the centre of pressure before and after; `save` writes the calibration.

    Raises:
        FormatError: If the file is damaged, or leaves something open that is not stated.
        ExperimentError: If neither a pole nor weights are stated, or markers, channel or intervals are not there.
        FitError: If the loads determine no matrix, or contradict the measurements.
    """
    from importlib.metadata import version
    from pathlib import Path

    from forcetorque.base.errors import ExperimentError
    from forcetorque.plates.applied_loads import loads_of_pole, loads_of_weights
    from forcetorque.plates.plate_calibration import calibrate_loads
    from forcetorque.plates.plate_file import read_plates
    from forcetorque.results.result import created_now

    plates, direction = read_plates(file, recording), MeasureDirection(measure_direction)
    chosen = plates.plate(plate)
    if weights is not None and tip is head is load_cell is None:
        loads = loads_of_weights(plates, chosen, Path(weights), serial=serial, measure_direction=direction)
    elif weights is None and tip is not None and head is not None and load_cell is not None:
        loads = loads_of_pole(
            plates, chosen, tip=tip, head=head, load_cell=load_cell, serial=serial, measure_direction=direction
        )
    else:
        raise ExperimentError(
            f"{file}: expected --tip, --head and --load-cell of a pole, or --weights, got "
            f"{'both' if weights is not None else 'not all of them'}"
        )
    return calibrate_loads(
        plates,
        chosen,
        loads,
        measure_direction=direction,
        code_version=version("forcetorque"),
        created=created_now(),
    )
