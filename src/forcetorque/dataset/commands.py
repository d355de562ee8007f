# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque dataset check` and `compensate`."""

from collections.abc import Sequence
from importlib.metadata import version
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.base.units import parsed_numbers
from forcetorque.results.command import Option, Saved, command

if TYPE_CHECKING:
    from forcetorque.base.progress import Progress
    from forcetorque.dataset.result import CompensatedDataset, DatasetCheck
    from forcetorque.experiment.calibration.calibration_file import Calibration

_SENSES = ("sensor_to_world", "world_to_sensor")
_BIASES, _FRAMES = ("dataset", "episode"), ("sensor", "world")
_FORMS = ("quat_xyzw", "quat_wxyz", "matrix_rows", "matrix_columns")


def _require_positive(flag: str, value: float | None) -> None:
    if value is not None and not 0.0 < value < float("inf"):
        raise ForceTorqueError(f"{flag}: expected a finite number above 0, got {value:g}")


@command(
    "the findings over episodes, and the weight along gravity in each",
    Saved(flags=("--html",), help="HTML page of the result.", function="forcetorque.dataset.check:write_page"),
)
def check_dataset(
    folder: Annotated["Path | str", Option("Folder of a LeRobot dataset, v2.1 or v3.0.")],
    *,
    features: Annotated[
        Sequence[str], Option("Feature to examine. Default: those whose names say that they are forces.", "--feature")
    ] = (),
    orientation: Annotated[
        str | None, Option("Feature with the orientation of the sensor. Default: the one with elements qx qy qz qw.")
    ] = None,
    sense: Annotated[
        str | None,
        Option(
            "What its rotation does: sensor_to_world or world_to_sensor. Without, nothing is held against gravity.",
            choices=_SENSES,
        ),
    ] = None,
    form: Annotated[
        str | None, Option("How it is written. Default: by the names of its elements.", choices=_FORMS)
    ] = None,
    mass_kg: Annotated[
        float | None, Option("Known mass of the tool, by which units of forces are checked; kg.", "--mass")
    ] = None,
    progress: "Progress" = lambda _: None,
) -> "DatasetCheck":
    """Find dead, stuck, late, biased and drifting forces in a dataset.

    Example: forcetorque dataset check my_dataset --sense sensor_to_world

    Python: `dataset.check_dataset("my_dataset", sense="sensor_to_world")`

    Returns:
        Findings by field and kind, and a record for each episode; exit code 1 if one does harm.

    Raises:
        FormatError: If the dataset is damaged, or has no force.
    """
    _require_positive("--mass", mass_kg)
    from forcetorque.dataset.check import checked

    return checked(
        Path(folder),
        features=features,
        orientation=orientation,
        sense=sense,
        form=form,
        mass_kg=mass_kg,
        progress=progress,
    )


_DIRECTIONS = ("child_to_parent", "parent_to_child")
_NAME = "observation.wrench"


def _pose(text: str) -> tuple[float, ...]:
    """Six numbers of a pose as they are typed."""
    numbers = tuple(parsed_numbers(text.split(",")))
    if len(numbers) != 6:
        raise ForceTorqueError(f"--pose: expected x,y,z in m and roll,pitch,yaw in rad, got {text!r}")
    return numbers


def _refuse_contradiction(calibration: "Calibration", direction: str, unit: str | None) -> None:
    """Refuse options that state otherwise than a calibration, whose wrenches are in N and N m."""
    own = calibration.sensor.measure_direction.value
    if direction != own:
        raise ForceTorqueError(
            f"--direction: expected {own}, in which the calibration of sensor {calibration.sensor.serial!r} gives "
            f"wrenches, got {direction}"
        )
    if unit is not None:
        raise ForceTorqueError(
            f"--force-unit, --moment-unit: expected none beside --calibration, which gives N and N m, got {unit!r}"
        )


@command("mass and centre of mass of the tool that was taken off")
def compensate_dataset(
    folder: Annotated["Path | str", Option("Folder of a LeRobot dataset, v2.1 or v3.0.")],
    output: Annotated[
        "Path | str", Option("Folder to make: a copy with two features more.", "--output", "-o", folder=True)
    ],
    *,
    sense: Annotated[
        str | None, Option("What the rotation of the orientation does; never inferred.", choices=_SENSES)
    ] = None,
    direction: Annotated[
        str | None,
        Option(
            "Who acts on whom in the measurement, never inferred: child_to_parent if a hanging tool reads down, else "
            "parent_to_child.",
            choices=_DIRECTIONS,
        ),
    ] = None,
    feature: Annotated[str | None, Option("Feature with the measured wrench. Default: the only wrench.")] = None,
    force_unit: Annotated[str | None, Option("Unit of its forces, such as N. Default: by their names.")] = None,
    moment_unit: Annotated[str | None, Option("Unit of its moments, such as 'N m'. Default: by their names.")] = None,
    orientation: Annotated[
        str | None, Option("Feature with the orientation of the sensor. Default: the one with elements qx qy qz qw.")
    ] = None,
    form: Annotated[
        str | None, Option("How it is written. Default: by the names of its elements.", choices=_FORMS)
    ] = None,
    mount: Annotated[
        bool,
        Option("The sensor is turned against the frame of the orientation by an unknown rotation.", "--unknown-mount"),
    ] = False,
    load: Annotated[
        "Path | str | None",
        Option("Tool, as a result of `forcetorque payload FILE --format json`. Default: identified from the dataset."),
    ] = None,
    bias: Annotated[
        str, Option("Whether one bias is taken off all episodes, or one of each.", choices=_BIASES)
    ] = "dataset",
    free_s: Annotated[
        float | None,
        Option("Time from the start of each episode in which nothing touches; s. Default: all frames.", "--free"),
    ] = None,
    calibration: Annotated[
        "Calibration | Path | str | None",
        Option("Calibration that turns the feature into wrenches.", "--calibration", "-c"),
    ] = None,
    serial: Annotated[str | None, Option("Serial number of the sensor, for --calibration.")] = None,
    frame: Annotated[str, Option("Axes of the result: of the sensor, or of the world.", choices=_FRAMES)] = "sensor",
    pose: Annotated[
        Sequence[float] | None,
        Option(
            "Pose x,y,z,roll,pitch,yaw (m, rad) of the sensor in another frame, for the wrench about its origin.",
            typed=str,
            reads=_pose,
        ),
    ] = None,
    name: Annotated[
        str | None,
        Option("Feature to add. Default: observation.wrench; with _compensated behind it where that is measured."),
    ] = None,
    gravity: Annotated[float, Option("Magnitude of gravity; m/s2.")] = 9.80665,
    progress: "Progress" = lambda _: None,
) -> "CompensatedDataset":
    """Add the wrench without the weight and bias of the tool to a copy.

    Example: forcetorque dataset compensate data -o new --sense sensor_to_world

    Python: `dataset.compensate_dataset("my_dataset", "compensated", sense="sensor_to_world",
    direction="child_to_parent", force_unit="N", moment_unit="N m")`

    Returns:
        What was taken off and added.

    Raises:
        FormatError: If the dataset is damaged, lacks an orientation, or sense and direction are not given.
        UnitError: If units are neither given nor in the names.
        FitError: If the episodes do not determine weight and bias.
        OutputError: If the output is in the dataset, or the feature is there already.
        ForceTorqueError: If an option has no such value, or contradicts another.
    """
    from forcetorque.base.pose import make_pose, rotation_from_rpy
    from forcetorque.base.wrench import MeasureDirection
    from forcetorque.dataset.compensate import Measurement, Request, compensated
    from forcetorque.dataset.force_fields import any_field, orientation_field, wrench_field
    from forcetorque.dataset.tool_load import read_known_load
    from forcetorque.experiment.calibration.calibration_file import read_calibration
    from forcetorque.formats.lerobot.dataset import read_dataset

    options: dict[str, Any] = {key: value for key, value in locals().items() if isinstance(value, str | float | int)}
    options["version"] = version("forcetorque")
    for flag, value, choices in (
        ("--sense", sense, _SENSES),
        ("--direction", direction, _DIRECTIONS),
        ("--form", form, _FORMS),
        ("--bias", bias, _BIASES),
        ("--frame", frame, _FRAMES),
    ):
        if value is not None and value not in choices:
            raise ForceTorqueError(f"{flag}: expected one of {', '.join(choices)}, got {value!r}")
    _require_positive("--free", free_s)
    if pose is not None and (len(pose) != 6 or not all(map(isfinite, pose))):
        raise ForceTorqueError(f"--pose: expected six finite numbers x,y,z,roll,pitch,yaw, got {list(pose)}")
    if pose is not None and frame != "sensor":
        raise ForceTorqueError(
            f"--pose beside --frame {frame}: expected one of them, both name the frame of the result"
        )
    dataset = read_dataset(Path(folder))
    if sense is None or direction is None:
        raise FormatError(
            f"{folder}: expected --sense, sensor_to_world if the orientation turns vectors along the sensor's axes to "
            "the world's, and --direction, child_to_parent if a hanging tool reads down: the format has neither"
        )
    read = read_calibration(calibration) if isinstance(calibration, Path | str) else calibration
    if read is not None:
        _refuse_contradiction(read, direction, force_unit or moment_unit)
    known = None if load is None else read_known_load(Path(load))
    options |= {"load": repr(known), "pose": pose}
    options["calibration"] = None if read is None else repr(read)
    measurement = Measurement(
        field=wrench_field(dataset, feature) if read is None else any_field(dataset, feature),
        orientation=orientation_field(dataset, orientation, sense, form, gravity=gravity),
        force_unit=force_unit,
        moment_unit=moment_unit,
        calibration=read,
        serial=serial,
    )
    added = name or (f"{_NAME}_compensated" if _NAME in dataset.features else _NAME)
    request = Request(
        measurement=measurement,
        direction=MeasureDirection(direction),
        known=known,
        mount=mount,
        by_episode=bias == "episode",
        free_s=free_s,
        frame=frame,
        frame_H_sensor=None if pose is None else make_pose(rotation_from_rpy(pose[3:]), pose[:3]),
        name=added,
    )
    return compensated(dataset, Path(output), request, options=options, progress=progress)
