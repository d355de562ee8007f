# SPDX-License-Identifier: BSD-3-Clause
"""The thirteen requirements of a calibration device (thesis 6.2.1): what can be computed, and what cannot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from collections.abc import Sequence as Several

import numpy as np

from forcetorque.analysis.device.demand_rows import RequirementRow, Verdict
from forcetorque.exsitu import Placement
from forcetorque.exsitu.device import (
    FORCE_LIMIT_N,
    MOMENT_LIMIT_NM,
    SAMPLES,
    DeviceFile,
    LoadErrors,
    Run,
    Silhouette,
    Tolerances,
    answer_of,
    device_load,
    least_excitation,
    uncertain,
    workbench_loads,
)

MOST_SENSORS = 3
"""Sensors at a time, by requirement 7."""
LARGEST_LOAD_KG = 35.0
"""Load that the device must bear, by requirement 5; kg."""
MOST_JOINTS = 6
"""Degrees of freedom that requirement 10 wants fewer of."""
ENVELOPE_M2 = 1.5
"""Space that the motion must be contained in, by requirement 11; m2."""
MOST_LOADINGS = 3
"""How often weights may be put on, by requirement 2."""

_SPACING_DEG = 10.0
_NOT_COMPUTED = {
    3: ("loading feels neither difficult nor dangerous", "people say so, no geometry"),
    4: ("by hand only mount, load, start", "who unlocks the hinge is not part of the description"),
    8: ("a sensor is mounted within 2 min", "screws and holes are not described; people are timed"),
    9: ("cost of at most 10000 EUR", "no prices are described"),
    12: ("sensor at 15 to 55 degC", "there is no model of heat in the interfaces"),
    13: ("dynamic behaviour can be analysed", "neither friction nor a release of the load is described"),
}


def requirement_rows(
    file: DeviceFile, silhouettes: Several[Silhouette], errors: Mapping[str, LoadErrors]
) -> tuple[RequirementRow, ...]:
    """Judge the requirements.

    Args:
        file: The device, with all sensors that it may have, and what it does.
        silhouettes: What it sweeps.
        errors: Errors of the references by sensor.

    Returns:
        A row for each requirement, two for forces and moments of the sixth.
    """
    rows = [
        _excitation(file),
        _judged(
            2,
            "weights are put on at most 3 times",
            float(len(file.simulation.loads_kg)),
            MOST_LOADINGS,
            "",
            "loads that it calibrates with, each put on at once",
        ),
        *_strength(file),
        *_errors(errors),
        _judged(
            10,
            "fewer than 6 degrees of freedom",
            float(len(file.joint_names)),
            MOST_JOINTS - 1,
            "",
            f"{', '.join(file.joint_names)}",
        ),
        _space(silhouettes),
        *(
            RequirementRow(number=number, requirement=text, verdict=Verdict.NOT_COMPUTED, why=why)
            for number, (text, why) in _NOT_COMPUTED.items()
        ),
    ]
    return tuple(sorted(rows, key=lambda row: row.number))


def _judged(number: int, text: str, value: float, limit: float, unit: str, why: str) -> RequirementRow:
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
    """What the motion with the loads of the file excites least, over what the positions of the workbench do."""
    loads_kg = file.simulation.loads_kg
    runs = tuple(
        Run(device=file, load=device_load(file, load_kg), sequence=file.sequence, hold_s=file.motion.hold_s)
        for load_kg in loads_kg
    )
    poses = [run.sampled(SAMPLES // len(runs)) for run in runs]
    bench = workbench_loads(Placement(angle_rad=0.0, position_m=0.0), SAMPLES)
    least = {sensor: least_excitation(uncertain(poses, sensor, Tolerances()), bench) for sensor in file.sensor_names}
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


def _strength(file: DeviceFile) -> Iterator[RequirementRow]:
    limits = {"pitch": file.pitch.torque_Nm, "yaw": file.yaw.torque_Nm}
    met_kg, peaks = None, dict.fromkeys(limits, 0.0)
    for load_kg in file.loads_kg:
        load = device_load(file, load_kg)
        answer = answer_of(file, load, file.sequence.still_poses(file, load, spacing_deg=_SPACING_DEG))
        peaks = {joint: float(np.abs(answer.torque(joint)).max()) for joint in limits}
        if all(peaks[joint] <= limit for joint, limit in limits.items()):
            met_kg = load.mass_kg
    joint = max(limits, key=lambda name: peaks[name] / limits[name])
    heaviest = max(file.loads_kg)
    why = f"motor of {joint} against its limit at {heaviest:g} kg; strength of parts is not computed"
    row = _judged(5, "bears 35 kg", peaks[joint], limits[joint], "N m", why)
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
    for place, (text, limit, unit) in enumerate(
        (
            ("force of the reference within 0.5 N", FORCE_LIMIT_N, "N"),
            ("moment of the reference within 0.02 N m", MOMENT_LIMIT_NM, "N m"),
        )
    ):
        components = slice(3 * place, 3 * place + 3)
        largest = {sensor: float(one.at_most.largest[components].max()) for sensor, one in errors.items()}
        worst = max(largest, key=lambda sensor: largest[sensor])
        row = _judged(
            6,
            text,
            largest[worst],
            limit,
            unit,
            f"largest component at {worst}, everything that is off at its worst; see the errors of references",
        )
        yield row.model_copy(update={"met_to_kg": errors[worst].met_to_kg[place]})


def _space(silhouettes: Several[Silhouette]) -> RequirementRow:
    largest = max(silhouettes, key=lambda one: one.rectangle_m2)
    why = f"rectangle around all that is swept seen from {largest.view}, where it is largest; no stand, no cables"
    return _judged(11, "motion contained in 1.5 m2", largest.rectangle_m2, ENVELOPE_M2, "m2", why)
