# SPDX-License-Identifier: BSD-3-Clause
"""Programs of robots on the live stream: the arithmetic that they do with the file they are given, beside ours.

A program that corrects readings gets what the sensor sends. One that takes a load off gets the corrected reading with
the weight of the tool in it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RecordingError, known_names
from forcetorque.base.pose import make_pose, rotation_from_rpy
from forcetorque.calibration.export.formats import ExportFormat
from forcetorque.calibration.export.wholebodydynamics import SensorCorrection, corrected, read_groups
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.live.corrector import Corrected, Corrector
from forcetorque.live.gravity_and_tool_weight import Tool
from forcetorque.live.option_values import HeldQuantity, OffsetSource
from forcetorque.live.packets import Packet
from forcetorque.live.result import LiveCheck
from forcetorque.live.sample_status import FAULTS
from forcetorque.payload.export.arm_controllers_and_simulators import READABLE_ARMS, read_arm_load
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.ros_hrpsys_and_mc_rtc import read_gravity_filter

_WHOLE_BODY = ExportFormat.WHOLEBODYDYNAMICS.value
PROGRAMS = (_WHOLE_BODY, LoadFormat.GRAVITY_FILTER.value, *(form.value for form in READABLE_ARMS))
"""Programs whose arithmetic is known."""
_Weight = Callable[[FloatArray], FloatArray]


@dataclass(slots=True, kw_only=True, eq=False)
class ProgramCheck:
    """Compares one program with the wrenches of one sensor."""

    program: str
    """Its name, of `PROGRAMS`."""
    file: Path
    """What it is given."""
    corrector: Corrector
    """Corrector of the sensor."""
    place: int
    """Index of the sensor in it."""
    correction: SensorCorrection | None = None
    """How it corrects readings; None for one that takes a load off."""
    weight: _Weight | None = None
    """What it takes off at a gravity in the frame of the reading; shapes (3,), (6,); m/s2; N, N m."""
    samples: int = 0
    """Samples that were compared."""
    outside: int | None = 0
    """Samples with a component that differs by more than its interval; None without a posterior."""
    _largest: FloatArray = field(default_factory=lambda: np.zeros(2))
    _half_width: FloatArray = field(default_factory=lambda: np.full(2, np.nan))

    def add(self, packet: Packet, sample: Corrected) -> None:
        """Compare a sample; one with a fault, or for which the program gives no finite wrench, is left out.

        Args:
            packet: What came.
            sample: What was made of it.
        """
        k = self.place
        if sample.status[k] & FAULTS:
            return
        ours = sample.wrench[k]
        if self.correction is not None:
            theirs = corrected(self.correction, self._reading(packet), self._temperature(packet))
        elif self.weight is not None and packet.gravity is not None:
            theirs = ours + self.corrector.weight[k] - self.weight(packet.gravity)
        else:
            return
        difference, half_width = np.abs(theirs - ours), sample.half_width[k]
        if not np.isfinite(difference).all():
            return
        self.samples += 1
        if self.outside is not None:
            judged = not np.isnan(half_width).any()
            self.outside = self.outside + bool((difference > half_width).any()) if judged else None
        for half in range(2):
            worst = 3 * half + int(difference[3 * half : 3 * half + 3].argmax())
            if difference[worst] >= self._largest[half]:
                self._largest[half], self._half_width[half] = difference[worst], half_width[worst]

    def row(self) -> LiveCheck:
        """Give what the comparison was worth.

        Returns:
            The row.
        """
        force, moment = self._largest.tolist() if self.samples else (np.nan, np.nan)
        force_half, moment_half = self._half_width.tolist()
        return LiveCheck(
            sensor=self.corrector.calibrations[self.place].sensor.name,
            program=self.program,
            file=str(self.file),
            samples=self.samples,
            force_difference_N=force,
            force_half_width_95_N=force_half,
            moment_difference_Nm=moment,
            moment_half_width_95_Nm=moment_half,
            outside=self.outside if self.samples else None,
        )

    def _reading(self, packet: Packet) -> FloatArray:
        """What the sensor sends: the wrench by its prior matrix."""
        values = packet.values[self.place]
        if self.corrector.options.quantity is HeldQuantity.WRENCH:
            return values
        prior = self.corrector.calibrations[self.place].prior
        if prior is None:
            raise RecordingError(f"--check {self.program}: expected a calibration with the prior matrix of the sensor")
        return prior.matrix @ values[: prior.matrix.shape[1]]

    def _temperature(self, packet: Packet) -> float | None:
        names = self.corrector.variables[self.place]
        if "temperature" not in names or packet.variables is None:
            return None
        return float(packet.variables[self.place, names.index("temperature")])


def program_checks(
    entries: Sequence[str],
    correctors: Sequence[Corrector],
    *,
    sensor_pose: Sequence[float] | None,
    frame: str | None = None,
    warn: Callable[[str], None] = lambda _: None,
) -> list[ProgramCheck]:
    """Read what programs are given.

    Args:
        entries: `PROGRAM=FILE`.
        correctors: Correctors of the run.
        sensor_pose: Pose of the sensor in the flange of an arm: x, y, z, roll, pitch, yaw; m, rad; None for none.
        frame: Frame of the reading; None where it is not stated.
        warn: Called with what could not be compared.

    Returns:
        A comparison for every sensor of every file.

    Raises:
        RecordingError: If a program is not known, what it needs is not stated, or no file has one of the sensors.
    """
    checks: list[ProgramCheck] = []
    for entry in entries:
        program, equals, name = entry.partition("=")
        if not (equals and name and program in PROGRAMS):
            raise RecordingError(f"--check {entry}: expected PROGRAM=FILE; {known_names(program, PROGRAMS)}")
        file = Path(name)
        if program == _WHOLE_BODY:
            checks += _corrections(file, correctors)
        else:
            checks.append(_load(program, file, correctors, sensor_pose))
        if program == LoadFormat.GRAVITY_FILTER:
            _require_frame(file, frame, warn)
    _require_all_sensors(checks, correctors)
    if sensor_pose is not None and not any(check.program in READABLE_ARMS for check in checks):
        raise RecordingError("--sensor-pose: expected --check with the file of an arm, got none")
    return checks


def _corrections(file: Path, correctors: Sequence[Corrector]) -> list[ProgramCheck]:
    corrections = {correction.sensor: correction for correction in read_groups(file)}
    checks = [
        ProgramCheck(
            program=_WHOLE_BODY, file=file, corrector=corrector, place=k, correction=corrections[one.sensor.name]
        )
        for corrector in correctors
        for k, one in enumerate(corrector.calibrations)
        if one.sensor.name in corrections
    ]
    if not checks:
        names = [one.sensor.name for corrector in correctors for one in corrector.calibrations]
        raise RecordingError(
            f"--check {_WHOLE_BODY}={file}: expected one of {', '.join(names)}, got {', '.join(corrections)}"
        )
    for check in checks:
        options, calibration = check.corrector.options, check.corrector.calibrations[check.place]
        if options.take_tool_off:
            raise RecordingError(f"--check {_WHOLE_BODY}: it takes no tool off: expected no --take-tool-off")
        if options.offset is not OffsetSource.FITTED:
            raise RecordingError(
                f"--check {_WHOLE_BODY}: it adds the fitted offset, whose error a tare takes off: expected --offset "
                f"fitted, got {options.offset}"
            )
        has_temperature = "temperature" in check.corrector.variables[check.place]
        if check.correction and check.correction.temperature_coefficients is not None and not has_temperature:
            raise RecordingError(
                f"--check {_WHOLE_BODY}={file}: {calibration.sensor.name} has FT_TEMPERATURE_COEFFICIENTS: expected a "
                "calibration with the variable 'temperature', got one without; export this calibration again"
            )
    return checks


def _require_all_sensors(checks: Sequence[ProgramCheck], correctors: Sequence[Corrector]) -> None:
    compared = {check.corrector.calibrations[check.place].sensor.name for check in checks}
    names = [one.sensor.name for corrector in correctors for one in corrector.calibrations]
    if checks and (missing := [name for name in names if name not in compared]):
        raise RecordingError(
            f"--check: expected a correction of every sensor, got none of {', '.join(missing)}; export what is "
            "missing, or leave its calibration out"
        )


def _load(
    program: str, file: Path, correctors: Sequence[Corrector], sensor_pose: Sequence[float] | None
) -> ProgramCheck:
    corrector = correctors[0]
    if not corrector.options.take_tool_off:
        raise RecordingError(
            f"--check {program}: it takes a load off: expected --take-tool-off with --tool-mass and --tool-centre"
        )
    (calibration,) = corrector.calibrations
    if program == LoadFormat.GRAVITY_FILTER:
        weight = _filter_weight(file)
    else:
        if sensor_pose is None:
            raise RecordingError(
                f"--check {program}: expected --sensor-pose, that of the sensor in the flange, whose frame the load is "
                "in; 0 0 0 0 0 0 where they are one"
            )
        weight = _arm_weight(LoadFormat(program), file, calibration, sensor_pose)
    return ProgramCheck(program=program, file=file, corrector=corrector, place=0, weight=weight)


def _require_frame(file: Path, frame: str | None, warn: Callable[[str], None]) -> None:
    *_, of_file = read_gravity_filter(file)
    if frame is None:
        warn(f"{file}: its sensor_frame {of_file!r} is taken for the frame of the reading, whose name is not stated")
    elif of_file != frame:
        raise RecordingError(f"{file}: sensor_frame: expected {frame!r}, as --frame states, got {of_file!r}")


def _filter_weight(file: Path) -> _Weight:
    """`mass * gravity_field`, turned into the sensor's frame, and its moment about the origin."""
    mass, centre, along, _ = read_gravity_filter(file)
    if along[:2].any():
        raise RecordingError(f"{file}: gravity_field: expected it along z of the world, which points up, got {along}")

    def weight(gravity: FloatArray) -> FloatArray:
        if not (magnitude := np.linalg.norm(gravity)) > 0.0:  # it points nowhere
            return np.full(6, np.nan)
        force = mass * along[2] * -gravity / magnitude
        return np.concatenate([force, np.cross(centre, force)])

    return weight


def _arm_weight(form: LoadFormat, file: Path, calibration: Calibration, sensor_pose: Sequence[float]) -> _Weight:
    """The weight of the load of the flange at the gravity of the stream: what a controller takes for it is unknown."""
    load = read_arm_load(file, form)
    flange_H_sensor = make_pose(rotation_from_rpy(sensor_pose[3:]), sensor_pose[:3])
    centre = flange_H_sensor[:3, :3].T @ (load.centre_of_mass - flange_H_sensor[:3, 3])
    per_gravity = Tool(mass_kg=load.mass, centre_m=centre).per_gravity(calibration.sensor.measure_direction)
    return lambda gravity: per_gravity @ gravity
