# SPDX-License-Identifier: BSD-3-Clause
"""The thirteen requirements of a calibration device (thesis 6.2.1), and records of the demands on its components."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence as Several
from enum import StrEnum
from typing import Annotated

import numpy as np

from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.device.components import device_load
from forcetorque.device.device_file import DeviceFile, DeviceHeat
from forcetorque.device.error_budget import FORCE_LIMIT_N, MOMENT_LIMIT_NM, LoadErrors
from forcetorque.device.excitation_options import SAMPLES, least_excitation, sampled_poses, workbench_loads
from forcetorque.device.expected_wrench import device_response
from forcetorque.device.motion import DeviceTrajectory
from forcetorque.device.motors_hinge_and_envelope import EnvelopeRow
from forcetorque.device.tolerances import Tolerances, joined_loads
from forcetorque.results.table import Row, Shown, ShownWrench, WrenchValues
from forcetorque.workbench.position_means import Placement


class Verdict(StrEnum):
    """Whether a requirement is met."""

    MET = "met"
    NOT_MET = "not met"
    NOT_COMPUTED = "not computed"


class RequirementRow(Row):
    """One requirement of the thesis (6.2.1)."""

    number: Annotated[int, Shown("no.")]
    """Number in the thesis."""
    requirement: Annotated[str, Shown("requirement")]
    """The requirement."""
    verdict: Annotated[Verdict, Shown("verdict")]
    """Whether it is met."""
    value: Annotated[float | None, Shown("value", digits=3)] = None
    """Computed value; None where none is computed."""
    limit: Annotated[float | None, Shown("limit", digits=3)] = None
    """Limit of the value."""
    unit: Annotated[str, Shown("unit")] = ""
    """Unit of both."""
    met_to_kg: Annotated[float | None, Shown("met up to", "kg", digits=1)] = None
    """Load up to which it is met, carrier included; None where no load meets it, or it does not depend on the load."""
    why: str
    """How it was evaluated, or why it was not."""


class UnwindingRow(Row):
    """Average torques for one way in which yaw returns."""

    yaw_return: Annotated[str, Shown("yaw returns")]
    """How yaw returns."""
    yaw_path_deg: Annotated[float, Shown("path of yaw", "deg", digits=0)]
    """Path of yaw, both ways counted."""
    pitch_over_peak: Annotated[float | None, Shown("pitch, average over peak", digits=3)]
    """Of the motor of pitch."""
    yaw_over_peak: Annotated[float | None, Shown("yaw, average over peak", digits=3)]
    """Of the motor of yaw."""


class HingeRow(Row):
    """Moment of gravity about the hinge on a way."""

    step: Annotated[int, Shown("step")]
    """Step of the way."""
    hinge: Annotated[str, Shown("hinge")]
    """`locked` or `free`."""
    from_deg: Annotated[float, Shown("from", "deg", digits=1)]
    """Position of the hinge at the start."""
    to_deg: Annotated[float, Shown("to", "deg", digits=1)]
    """Position at the end."""
    least_Nm: Annotated[float, Shown("least", "N m", digits=2)]
    """Smallest moment about the hinge, towards larger angles; of a free hinge, at the position of the start."""
    most_Nm: Annotated[float, Shown("most", "N m", digits=2)]
    """Largest."""


class LockRow(Row):
    """Whether a load reaches the other lock."""

    load: Annotated[str, Shown("load")]
    """The load."""
    reaches: Annotated[bool, Shown("reaches the lock")]
    """Whether gravity drives it to the other lock and never back, without friction."""
    holding_Nm: Annotated[float, Shown("lock holds", "N m", digits=2)]
    """Largest moment on a lock."""
    closing_Nm: Annotated[float, Shown("left 1 deg before", "N m", digits=3)]
    """Moment 1 degree before the lock: more friction stops the load farther away."""


class BudgetRow(Row):
    """Error of the expected wrench of one sensor by one quantity."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor."""
    quantity: Annotated[str, Shown("quantity")]
    """Quantity with an error; `all` for all together."""
    plus_minus: Annotated[float | None, Shown("+-", digits=3)]
    """Largest error of the quantity, half of a full width; None for all together."""
    unit: Annotated[str, Shown("unit")]
    """Unit of that."""
    rms: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Root mean square over the motion; N, N m."""
    largest: WrenchValues
    """Largest magnitude of each component; N, N m."""
    force_N: Annotated[float, Shown("largest f", "N", digits=3)]
    """Largest norm of the error of the force."""
    moment_Nm: Annotated[float, Shown("largest t", "N m", digits=3)]
    """Largest norm of the error of the moment."""


class GradeRow(Row):
    """Errors of the expected wrench by a grade of encoders or of an inertial sensor."""

    gravity_by: Annotated[str, Shown("gravity by")]
    """`encoders` of pitch and yaw, or `IMU`."""
    full_width: Annotated[float, Shown("width", digits=4)]
    """Full width of the error."""
    plus_minus: Annotated[float, Shown("+-", digits=4)]
    """Half of the full width."""
    unit: Annotated[str, Shown("unit")]
    """Unit of both."""
    rms: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Root mean square over the motion, as in Table 6.3; N, N m."""
    single_force_N: Annotated[float, Shown("one: f", "N", digits=2)]
    """Largest error of the force by one encoder, or one axis of the inertial sensor."""
    single_moment_Nm: Annotated[float, Shown("one: t", "N m", digits=3)]
    """Of the moment."""
    largest: WrenchValues
    """Largest magnitude of each component with errors of all of them; N, N m."""
    largest_force_N: Annotated[float, Shown("all: f", "N", digits=2)]
    """Largest component of the error of the force with errors of all of them, which requirement 6 limits."""
    largest_moment_Nm: Annotated[float, Shown("all: t", "N m", digits=3)]
    """The same of the moment."""
    force_norm_N: float
    """Largest norm of the error of the force."""
    moment_norm_Nm: float
    """Largest norm of the error of the moment."""
    force_met_to_kg: Annotated[float | None, Shown("0.5 N to", "kg", digits=1)]
    """Load up to which all components of the force meet requirement 6; None if none does."""
    moment_met_to_kg: Annotated[float | None, Shown("0.02 N m to", "kg", digits=1)]
    """The same of the moment."""


MOST_SENSORS = 3
"""Sensors at a time, by requirement 7."""
LARGEST_LOAD_KG = 35.0
"""Load that the device must bear, by requirement 5; kg."""
MOST_JOINTS = 6
"""Degrees of freedom, of which requirement 10 allows fewer."""
ENVELOPE_M2 = 1.5
"""Largest space of the motion, by requirement 11; m2."""
MOST_LOADINGS = 3
"""Largest number of loadings, by requirement 2."""

COLDEST_DEGC, HOTTEST_DEGC = 15.0, 55.0
"""Temperatures between which the device excites a sensor, by requirement 12."""

_SPACING_DEG = 10.0
_NOT_COMPUTED = {
    3: ("loading feels neither difficult nor dangerous", "people say so, no geometry"),
    4: ("by hand only mount, load, start", "who unlocks the hinge is not part of the description"),
    8: ("a sensor is mounted within 2 min", "screws and holes are not described; people are timed"),
    9: ("cost of at most 10000 EUR", "no prices are described"),
    13: ("dynamic behaviour can be analysed", "neither friction nor a release of the load is described"),
}


def requirement_rows(
    file: DeviceFile, swept: Several[EnvelopeRow], errors: Mapping[str, LoadErrors]
) -> tuple[RequirementRow, ...]:
    """Evaluate the requirements.

    Args:
        file: The device with the largest number of sensors, and its motion.
        swept: The swept space, by view.
        errors: Errors of the expected wrench by sensor.

    Returns:
        A record for each requirement, two for forces and moments of the sixth.
    """
    rows = [
        _excitation(file),
        _compared(
            2,
            "weights are put on at most 3 times",
            float(len(file.simulation.loads_kg)),
            MOST_LOADINGS,
            "",
            "loads that it calibrates with, each put on at once",
        ),
        *_strength(file),
        *_errors(errors),
        _compared(
            10,
            "fewer than 6 degrees of freedom",
            float(len(file.joint_names)),
            MOST_JOINTS - 1,
            "",
            f"{', '.join(file.joint_names)}",
        ),
        _space(swept),
        _heat(file.heat),
        *(
            RequirementRow(number=number, requirement=text, verdict=Verdict.NOT_COMPUTED, why=why)
            for number, (text, why) in _NOT_COMPUTED.items()
        ),
    ]
    return tuple(sorted(rows, key=lambda row: row.number))


def _compared(number: int, text: str, value: float, limit: float, unit: str, why: str) -> RequirementRow:
    return RequirementRow(
        number=number,
        requirement=text,
        verdict=Verdict.MET if value <= limit else Verdict.NOT_MET,
        value=value,
        limit=limit,
        unit=unit,
        why=why,
    )


def _excitation(file: DeviceFile) -> RequirementRow:
    """The least excitation by the motion with the loads of the file, over that by the positions of the workbench."""
    loads_kg = file.simulation.loads_kg
    trajectories = [
        DeviceTrajectory(device=file, load=device_load(file, load), sequence=file.sequence, hold_s=file.motion.hold_s)
        for load in loads_kg
    ]
    poses = [sampled_poses(trajectory, SAMPLES // len(trajectories)) for trajectory in trajectories]
    bench = workbench_loads(Placement(angle_rad=0.0, position_m=0.0), SAMPLES)
    least = {sensor: least_excitation(joined_loads(poses, sensor, Tolerances()), bench) for sensor in file.sensor_names}
    worst = min(least, key=lambda sensor: least[sensor])
    loads = " and ".join(f"{load_kg:g} kg" for load_kg in loads_kg)
    return RequirementRow(
        number=1,
        requirement="excitation at least that of the 24 positions",
        verdict=Verdict.MET if least[worst] >= 1.0 else Verdict.NOT_MET,
        value=least[worst],
        limit=1.0,
        unit="of theirs",
        why=f"the motion with {loads}, in the direction in which {worst} is excited least; remedies are above",
    )


def _heat(heat: DeviceHeat | None) -> RequirementRow:
    """The temperatures at which heat put in, or taken out, is what is lost to the room."""
    text = f"sensor at {COLDEST_DEGC:g} to {HOTTEST_DEGC:g} degC"
    if heat is None:
        why = "no [heat] is described: power of the heater, losses and heat capacity"
        return RequirementRow(number=12, requirement=text, verdict=Verdict.NOT_COMPUTED, why=why)
    hottest = heat.ambient_degC + heat.heating_W / heat.loss_W_per_K
    coldest = heat.ambient_degC - heat.cooling_W / heat.loss_W_per_K
    heated = _time_to(f"heated to {HOTTEST_DEGC:g} degC", heat, heat.ambient_degC, hottest, HOTTEST_DEGC)
    cooled = _time_to(f"cooled from there to {COLDEST_DEGC:g} degC", heat, HOTTEST_DEGC, coldest, COLDEST_DEGC)
    return RequirementRow(
        number=12,
        requirement=text,
        verdict=Verdict.MET if coldest <= COLDEST_DEGC and hottest >= HOTTEST_DEGC else Verdict.NOT_MET,
        value=hottest,
        limit=HOTTEST_DEGC,
        unit="degC",
        why=f"one body at {heat.ambient_degC:g} degC in the room reaches {coldest:.3g} to {hottest:.3g} degC; "
        f"{heated}; {cooled}",
    )


def _time_to(words: str, heat: DeviceHeat, start_degC: float, end_degC: float, limit_degC: float) -> str:
    """When the exponential way from a temperature to the one that it ends at passes a limit."""
    if end_degC == limit_degC != start_degC:
        return f"{words} only in the limit, ever slower"
    behind, ahead = end_degC - start_degC, end_degC - limit_degC
    if (limit_degC - start_degC) * behind <= 0.0 or ahead * behind <= 0.0:
        return f"never {words}" if start_degC != limit_degC else f"{words} from the start"
    minutes = heat.capacity_J_per_K / heat.loss_W_per_K * math.log(behind / ahead) / 60.0
    return f"{words} in {minutes:.3g} min"


def _strength(file: DeviceFile) -> Iterator[RequirementRow]:
    limits = {"pitch": file.pitch.torque_Nm, "yaw": file.yaw.torque_Nm}
    met_kg, peaks = None, dict.fromkeys(limits, 0.0)
    for load_kg in file.loads_kg:
        load = device_load(file, load_kg)
        response = device_response(file, load, file.sequence.still_poses(file, load, spacing_deg=_SPACING_DEG))
        peaks = {joint: float(np.abs(response.torque(joint)).max()) for joint in limits}
        if all(peaks[joint] <= limit for joint, limit in limits.items()):
            met_kg = load.mass_kg
    joint = max(limits, key=lambda name: peaks[name] / limits[name])
    heaviest = max(file.loads_kg)
    why = f"motor of {joint} against its limit at {heaviest:g} kg; strength of parts is not computed"
    row = _compared(5, "bears 35 kg", peaks[joint], limits[joint], "N m", why)
    bears = row.verdict is Verdict.MET and heaviest >= LARGEST_LOAD_KG
    verdict = Verdict.MET if bears else Verdict.NOT_MET
    yield row.model_copy(update={"verdict": verdict, "met_to_kg": met_kg})
    yield RequirementRow(
        number=7,
        requirement="up to 3 sensors at a time",
        verdict=verdict,
        value=float(len(file.sensor)),
        limit=float(MOST_SENSORS),
        unit="sensors",
        met_to_kg=met_kg,
        why="the stack of three is what everything here is computed with; motors bear it as 5 says",
    )


def _errors(errors: Mapping[str, LoadErrors]) -> Iterator[RequirementRow]:
    for half, (text, limit, unit) in enumerate(
        (
            ("force of the reference within 0.5 N", FORCE_LIMIT_N, "N"),
            ("moment of the reference within 0.02 N m", MOMENT_LIMIT_NM, "N m"),
        )
    ):
        components = FORCE_AND_MOMENT[half]
        largest = {
            sensor: float(by_load.at_largest_load.largest[components].max()) for sensor, by_load in errors.items()
        }
        worst = max(largest, key=lambda sensor: largest[sensor])
        row = _compared(
            6,
            text,
            largest[worst],
            limit,
            unit,
            f"largest component at {worst}, everything that is off at its worst; see the errors of references",
        )
        yield row.model_copy(update={"met_to_kg": errors[worst].met_to_kg[half]})


def _space(swept: Several[EnvelopeRow]) -> RequirementRow:
    largest = max(swept, key=lambda row: row.rectangle_m2)
    why = f"rectangle around all that is swept seen from {largest.view}, where it is largest; no stand, no cables"
    return _compared(11, "motion contained in 1.5 m2", largest.rectangle_m2, ENVELOPE_M2, "m2", why)
