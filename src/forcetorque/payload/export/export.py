# SPDX-License-Identifier: BSD-3-Clause
"""The load of a wrist sensor for a robot, taken from its experiment and written in any form of file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.inertia import Inertia
from forcetorque.base.output_file import STANDARD_OUTPUT, refuse_output, write_bytes_atomically
from forcetorque.base.pose import skew
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.arm_log import FLANGE
from forcetorque.payload.export.arm_controllers_and_simulators import ARMS, arm_text, not_held
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.load_parameters import RobotLoad, flange_load
from forcetorque.payload.export.ros_hrpsys_and_mc_rtc import (
    broadcaster_text,
    force_torque_tools_text,
    ft_tools_text,
    gravity_filter_text,
    hrpsys_text,
    mc_rtc_text,
)
from forcetorque.payload.held_load import held_load
from forcetorque.payload.identification.load_estimates import HypothesisRow
from forcetorque.payload.identify import weigh_load, weighing_sensor
from forcetorque.payload.load_on_wrist_sensor import wrist_loads
from forcetorque.payload.load_warnings import overruled, overweight_loads, reason_to_withhold
from forcetorque.payload.loads_on_robot_links import link_loads
from forcetorque.payload.result import WeighedLoad
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import amount

_HASH = ("# ", "")
_REMARKS: Mapping[LoadFormat, tuple[str, str] | None] = {
    LoadFormat.MC_RTC: None,
    LoadFormat.HRPSYS: None,
    LoadFormat.KUKA: ("; ", ""),
    LoadFormat.ABB: ("! ", ""),
    LoadFormat.URDF: ("<!-- ", " -->"),
    LoadFormat.MJCF: ("<!-- ", " -->"),
}
"""What begins and ends a remark of files whose remarks do not stand after #; None where there are none."""


def write_load_file(
    path: Path | str,
    load: RobotLoad,
    form: LoadFormat,
    *,
    world_frame: str | None = None,
    body_H_sensor: FloatArray | None = None,
) -> None:
    """Write a load for a robot; on any error the file keeps what it held before.

    The reason to tell of a doubtful load is a comment, or, of a form without comments, a file beside it that ends in
    `.override.txt`.

    Args:
        path: File to write or to replace, in an existing folder; `-` is standard output.
        load: The load.
        form: Form of the file.
        world_frame: For `gravity-filter`, the frame of tf whose z axis points up.
        body_H_sensor: For `mc-rtc`, pose of the sensor in its parent body, for an arm in its flange; shape (4, 4); m.
    """
    texts: dict[LoadFormat, Callable[[], str]] = {
        LoadFormat.ROS2_BROADCASTER: lambda: broadcaster_text(load),
        LoadFormat.GRAVITY_FILTER: lambda: gravity_filter_text(load, world_frame=world_frame),
        LoadFormat.FT_TOOLS: lambda: ft_tools_text(load),
        LoadFormat.FORCE_TORQUE_TOOLS: lambda: force_torque_tools_text(load),
        LoadFormat.MC_RTC: lambda: mc_rtc_text(load, body_H_sensor=body_H_sensor),
        LoadFormat.HRPSYS: lambda: hrpsys_text(load),
    }
    text = arm_text(flange_load(load, form, body_H_sensor), form) if form in ARMS else texts[form]()
    remarks = _REMARKS.get(form, _HASH)
    note = None if load.override is None else _one_line(load.override)
    if remarks is None:
        if note is not None or str(path) != str(STANDARD_OUTPUT):
            _write_beside(path, form, note)
    else:
        begin, end = remarks
        posture = [f"with {_one_line(load.posture)}"] if load.posture else []
        lines = [f"forcetorque {form}", *posture, *([] if note is None else [note])]
        if end:
            lines = [re.sub("-(?=-)", "- ", line) for line in lines]  # two hyphens end a remark of XML
        text = "".join(f"{begin}{line}{end}\n" for line in lines) + text
    write_bytes_atomically(Path(path), text.encode())


def _one_line(text: str) -> str:
    """A text as a remark can hold it: no line break, no control character, no half of a character."""
    return "".join(letter if letter.isprintable() else " " for letter in text)


_OVERRIDE = "# forcetorque override\n"
"""Head of a file that says why a doubtful load was written."""


def override_file(path: Path | str, form: LoadFormat) -> Path | None:
    """Name the file that says why a doubtful load was written.

    Args:
        path: File of the load.
        form: Its form.

    Returns:
        The file beside it; None where the file of the load has remarks.

    Raises:
        ExperimentError: If the load goes to standard output.
    """
    if _REMARKS.get(form, _HASH) is not None:
        return None
    if str(path) == str(STANDARD_OUTPUT):
        raise ExperimentError("--output: expected a file, beside which the reason is written, got standard output")
    return Path(f"{path}.override.txt")


def _write_beside(path: Path | str, form: LoadFormat, note: str | None) -> None:
    """Write the reason beside a file without remarks; where there is none, remove that of an earlier load."""
    beside = override_file(path, form)
    if beside is None:
        return
    if note is not None:
        write_bytes_atomically(beside, f"{_OVERRIDE}{path}: {note}\n".encode())
    elif beside.is_file() and beside.read_bytes().startswith(_OVERRIDE.encode()):
        beside.unlink()


def robot_load(
    run: SensorRun,
    bias: Sequence[float | None] | FloatArray,
    *,
    weighed: WeighedLoad | None = None,
    doubt: str | None = None,
    override: str | None = None,
) -> RobotLoad:
    """Give the load of a sensor, estimated or stated, or the links of a robot beyond it, with a bias of the sensor.

    Args:
        run: The sensor.
        bias: Reading without load, such as that of `weigh_load`, or minus the offset of `tare`; shape (6,); N, N m;
            None where the data leave it open.
        weighed: What several recordings say together, as `weigh_load` gives it; the run alone if None.
        doubt: What else is doubtful, such as a tare under a load that moves; None for nothing.
        override: Reason to tell of a doubtful load, which is written with it; refused if None.

    Returns:
        The load, to write it for a robot (`export_load`).

    Raises:
        ExperimentError: As of `held_load`, or if another sensor weighed the load, or the data leave the bias open, or
            the readings contradict the frames, senses and units by which the load was weighed, or, without a reason, if
            the load is doubtful.
    """
    if weighed is not None and weighed.sensor != run.sensor.name:
        raise ExperimentError(f"expected the sensor {weighed.sensor!r}, which weighed, got {run.sensor.name!r}")
    known = np.array(bias, dtype=np.float64)
    if not np.isfinite(known).all():
        names = ", ".join(np.array(WRENCH_COMPONENTS)[~np.isfinite(known)])
        raise ExperimentError(
            f"expected a bias along every axis, of which a robot is told, the data leave {names} open: "
            "`forcetorque payload` says what to record"
        )
    if contradiction := next(_contradictions(run, weighed), None):
        raise ExperimentError(
            f"expected a load that the readings agree with, of which a robot is told, they say: {contradiction}; mend "
            "that, and weigh again"
        )
    if weighed is None and _is_estimated(run):
        doubt = doubt or reason_to_withhold(weigh_load(run))
    elif weighed is not None:
        doubt = doubt or reason_to_withhold(weighed)
    note = overruled(doubt, override, where=f"load of {run.sensor.name!r}")
    held = held_load(run, weighed)
    mass = held.inertia.mass
    centre, about_centre = _about_centre(held.inertia)
    # zero, or what rounding leaves of it, is no inertia that a simulator takes
    of_links = not held.has_inertia and bool(np.linalg.eigvalsh(_about_centre(held.links)[1])[0] > _POINT_KGM2)
    matrix = run.sensor.prior if run.sensor.quantity == "raw" else None
    return RobotLoad(
        sensor=run.sensor.name,
        frame=held.frame,
        direction=held.direction,
        mass=mass,
        centre_of_mass=centre,
        inertia=about_centre if held.has_inertia or of_links else None,
        load=held.load,
        links_mass=held.links.mass,
        lacks_inertia=of_links,
        bias=known,
        matrix=np.eye(6) if matrix is None else matrix,
        posture=", ".join(f"{row.joint} at {amount(row.position or 0.0, row.unit)}" for row in held.posture),
        override=note,
    )


_POINT_KGM2 = 1e-9
"""Principal moment of links below which they are points."""


def _about_centre(inertia: Inertia) -> tuple[FloatArray, FloatArray]:
    """Centre of mass, shape (3,), m, and inertia about it, shape (3, 3), kg m2."""
    centre = inertia.first_moment / inertia.mass if inertia.mass else np.zeros(3)
    return centre, inertia.second_moment + inertia.mass * skew(centre) @ skew(centre)


def _is_estimated(run: SensorRun) -> bool:
    """Whether a load is estimated by the recording of the run itself."""
    loads = wrist_loads(run.experiment) or link_loads(run.experiment)
    if loads is None or weighing_sensor(run.experiment).name != run.sensor.name:
        return False
    return not loads.are_stated and run.has(Use.CALIBRATION)


def require_agreeing_logs(weighed: WeighedLoad) -> None:
    """Refuse a load of logs whose other fields contradict its frame.

    Raises:
        ExperimentError: If one of them does.
    """
    for words in (words for arm in weighed.arms for words in arm.contradictions):
        raise ExperimentError(f"expected a load that the log agrees with, of which a robot is told: {words}")


def _contradictions(run: SensorRun, weighed: WeighedLoad | None) -> Iterator[str]:
    """What says that the load is not what hangs there, or the bias not that of the sensor."""
    wrist = wrist_loads(run.experiment)
    accounts: Sequence[HypothesisRow] = ()
    if weighed is not None:
        accounts = weighed.hypotheses
    elif wrist is not None and run.has(Use.CALIBRATION) and wrist.table.applied is None:
        accounts = wrist.solution(run.experiment).hypotheses
    # a mass that is stated as 0 is no mistake: a robot may be told that nothing hangs there
    spared = {"no load"} if wrist is not None and wrist.are_stated else set()
    against = (account for account in accounts if account.severity == "contradiction")
    yield from (f"{account.name}: {account.description}" for account in against if account.name not in spared)
    yield from overweight_loads(run)


def export_load(
    load: RobotLoad,
    output: Path | str,
    form: LoadFormat,
    *,
    world_frame: str | None = None,
    body_H_sensor: FloatArray | None = None,
    force: bool = False,
) -> str:
    """Write the file in which a robot is told what hangs on its sensor.

    Args:
        load: The load.
        output: File to write or to replace.
        form: Form of the file.
        world_frame: For `gravity-filter`, the frame of tf whose z axis points up.
        body_H_sensor: For `mc-rtc`, pose of the sensor in its parent body, for an arm in its flange; shape (4, 4); m.
        force: Whether a file that is neither a result nor a figure may be replaced.

    Returns:
        What the program does with it, and what its file cannot hold with the error that this causes.
    """
    refuse_output(output, force=force)
    if load.override is not None and (beside := override_file(output, form)) is not None:
        refuse_output(beside, force=force)
    write_load_file(output, load, form, world_frame=world_frame, body_H_sensor=body_H_sensor)
    parts = [f"it holds with {load.posture} alone"] if load.posture else []
    if load.load and load.links_mass and form is not LoadFormat.ROS2_BROADCASTER:
        links = f"{load.links_mass:.4g} kg of links of the URDF beyond the sensor"
        parts.insert(0, f"it holds {load.mass:.4g} kg: the load {load.load!r} and {links}")
    if form not in ARMS:
        return "; ".join([form.convention, *parts])
    lacks = parts + list(not_held(flange_load(load, form, body_H_sensor), form, load.bias))
    if load.lacks_inertia:
        lacks.append(
            f"the inertia of the load {load.load!r} is not known and left out: each 0.001 kg m2 of it makes 0.001 N m "
            "for each rad/s2"
        )
    if load.frame != FLANGE:
        lacks.append(
            "it holds what is beyond the sensor: each 0.1 kg of a sensor that is mounted on the flange makes 0.98 N"
        )
    return "; ".join([form.convention, *lacks])
