# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque payload`: loads with the half-widths of their 95 % intervals, biases, and their text."""

from __future__ import annotations

import statistics
from collections.abc import Iterable, Iterator, Sequence
from itertools import combinations
from math import floor, hypot, log10
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field

from forcetorque.base.units import NORMAL_95
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.payload.identification.load_estimates import (
    BiasRow,
    BiasTestRow,
    DriftRow,
    HypothesisRow,
    LoadEstimate,
    OutlierRow,
    Three,
    VariableRow,
    three,
)
from forcetorque.payload.identification.parameter_vector import SECOND_MOMENTS, SIX_PLACES, six_of
from forcetorque.results.number_text import finite_or_none, plus_minus, with_error
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, WrenchValues, optional_table, table_of

_ROUNDING = 1e-12
"""Share of the inertia that a mass in the centre of mass has about the sensor, below which an inertia is rounding."""


class LoadRow(Row):
    """A load; half-widths are of 95 % intervals."""

    load: Annotated[str, Shown("load")]
    """Its name."""
    estimated: Annotated[bool, Shown("estimated")]
    """Whether anything of it was estimated; else it is as stated."""
    mass_kg: Annotated[float | None, Shown("mass", "kg", digits=4, error="mass_half_width_95_kg")]
    """Mass; none where it is open."""
    mass_half_width_95_kg: float | None
    """Half-width of its interval; none where it is open."""
    centre_of_mass_m: Three
    """Centre of mass in the frame of the sensor, or of the link; none where it is open."""
    centre_of_mass_half_width_95_m: Three
    """Half-widths of its intervals; none where they are open."""
    inertia_kgm2: tuple[Three, Three, Three] | None
    """About the centre of mass, along the same axes; none of a point mass."""
    inertia_half_width_95_kgm2: tuple[Three, Three, Three] | None
    """Half-widths of its intervals; none of a point mass."""
    link: str | None = None
    """Link of the robot that it hangs on; none on a wrist sensor."""
    inertial: tuple[float, ...] | None = None
    """On a link: mass, first moment, and inertia xx, yy, zz, xy, xz, yz about the origin of the link's frame; kg, kg m,
    kg m2; none where any of it is open."""
    covariance: tuple[tuple[float, ...], ...] | None = None
    """Of these ten, one standard error squared; none where they are."""

    @classmethod
    def of(cls, load: LoadEstimate, link: str | None = None) -> Self:
        """Tell an estimate.

        Args:
            load: The estimate.
            link: Link of the robot that it hangs on; none on a wrist sensor.

        Returns:
            Its row.
        """
        of_point = load.mass * float(load.centre_of_mass @ load.centre_of_mass)
        point = not (np.abs(load.inertia) > _ROUNDING * abs(of_point)).any()
        return cls(
            load=load.name,
            estimated=load.estimated,
            mass_kg=finite_or_none(load.mass),
            mass_half_width_95_kg=finite_or_none(load.mass_half_width),
            centre_of_mass_m=three(load.centre_of_mass),
            centre_of_mass_half_width_95_m=three(load.centre_of_mass_half_width),
            inertia_kgm2=None if point else _matrix(load.inertia),
            inertia_half_width_95_kgm2=None if point else _matrix(load.inertia_half_width),
            link=link,
            **({} if link is None or not np.isfinite(load.covariance).all() else _inertial(load)),
        )


def _inertial(load: LoadEstimate) -> dict[str, Any]:
    about_origin = load.as_inertia()
    values = np.concatenate([[about_origin.mass], about_origin.first_moment, six_of(about_origin.second_moment)])
    covariance = 0.5 * (load.covariance + load.covariance.T)
    return {"inertial": tuple(values.tolist()), "covariance": tuple(map(tuple, covariance.tolist()))}


def _matrix(values: Iterable[Iterable[float]]) -> tuple[Three, Three, Three]:
    first, second, third = (three(row) for row in values)
    return first, second, third


class RecordingLoadRow(LoadRow):
    """What one of several recordings says of a load by itself."""

    recording: Annotated[str, Shown("recording")]
    """Name of the recording."""

    @classmethod
    def by(cls, recording: str, load: LoadEstimate, link: str | None = None) -> Self:
        """Tell an estimate.

        Args:
            recording: Name of the recording.
            load: The estimate.
            link: Link of the robot that it hangs on; none on a wrist sensor.

        Returns:
            Its row.
        """
        return cls(recording=recording, **dict(LoadRow.of(load, link)))


class ValidationLoadRow(Row):
    """An interval that was not fitted, held against the loads that were."""

    interval: Annotated[str, Shown("interval")]
    """Its label."""
    observations: Annotated[int, Shown("observations")]
    """Number of means or poses in it."""
    force_error_N: Annotated[float, Shown("force", "N", digits=3)]
    """Root mean square of what the loads leave of the force about its middle."""
    moment_error_Nm: Annotated[float, Shown("moment", "N m", digits=4)]
    """The same of the moment."""
    largest_force_N: Annotated[float, Shown("largest", "N", digits=2)]
    """Largest of what the loads leave of the force about its middle, in means over a quarter of a second."""
    contact: Annotated[bool, Shown("contact")]
    """Whether that is over a fifth of the weight of the load: something else than the load pulls (a heuristic)."""


_MOST_DIGITS = 9
"""Digits behind the point of an inertia; kg m2."""


def load_words(load: LoadRow) -> str:
    """Say where a load is and what it weighs.

    Returns:
        A sentence without the sensor.
    """
    mass = with_error(load.mass_kg, load.mass_half_width_95_kg, digits=4)
    pairs = zip(load.centre_of_mass_m, load.centre_of_mass_half_width_95_m, strict=True)
    centre = ", ".join(
        with_error(None if place is None else 1e3 * place, None if half is None else 1e3 * half, digits=2)
        for place, half in pairs
    )
    name = "" if load.load == "load" else f"{load.load}: "
    half = "± half a 95 % interval" if load.estimated else "as stated"
    return f"{name}{mass} kg at ({centre}) mm, {half}"


def inertia_words(load: LoadRow) -> str | None:
    """Say what the inertia of a load is.

    Returns:
        A sentence; None where the inertia was not asked for.
    """
    values, halves = load.inertia_kgm2, load.inertia_half_width_95_kgm2
    if values is None or halves is None or all(half == 0.0 for row in halves for half in row):
        return None
    pairs = {SECOND_MOMENTS[k]: (values[i][j], halves[i][j]) for k, (i, j) in enumerate(zip(*SIX_PLACES, strict=True))}
    known = [half for _, half in pairs.values() if half]
    digits = min(max(1 - floor(log10(min(known))), 0), _MOST_DIGITS) if known else 0
    numbers = ", ".join(f"{pair} {with_error(*both, digits=digits)}" for pair, both in pairs.items())
    name = "" if load.load == "load" else f"{load.load}: "
    return f"{name}inertia about the centre of mass {numbers} kg m2"


def mount_words(mount_rad: Sequence[float], half_width_rad: Three | None) -> str:
    """Say how a sensor is turned.

    Args:
        mount_rad: Rotation vector of `sensor_R_motion`; rad.
        half_width_rad: Half-widths of 95 % intervals about the sensor's axes; rad; None where they are open.

    Returns:
        The rotation vector that turns the axes of the motion into those of the sensor, with intervals.
    """
    halves = half_width_rad or (None, None, None)
    parts = ", ".join(
        f"{-np.rad2deg(value):.2f} {'(open)' if half is None else f'±{np.rad2deg(half):.2f}'}"
        for value, half in zip(mount_rad, halves, strict=True)
    )
    return f"mount: the sensor is turned by ({parts}) deg (rotation vector) against the axes of the motion"


def tilt_words(tilt_rad: Sequence[float], half_width_rad: Sequence[float | None] | None) -> str:
    """Say how the world of the orientation streams is tilted against gravity.

    Args:
        tilt_rad: Rotation vector of gravity about x and y of the world; rad.
        half_width_rad: Half-widths of 95 % intervals; rad; None where they are open.

    Returns:
        Both angles in degrees, with intervals.
    """
    parts = ", ".join(
        f"{axis} {np.rad2deg(value):.2f} {'(open)' if half is None else f'±{np.rad2deg(half):.2f}'}"
        for axis, value, half in zip("xy", tilt_rad, half_width_rad or (None, None), strict=True)
    )
    return f"tilt of gravity about axes of the world: {parts} deg (95 %)"


def drift_words(drift: DriftRow) -> str:
    """Say whether a drift was taken, and why.

    Args:
        drift: The choice.

    Returns:
        A sentence.
    """
    taken = "biases drift evenly in time" if drift.taken else "biases are constant"
    if drift.error_with is None or drift.error_without is None:
        return f"{taken}: there are too few rows to choose"
    masses = (
        f"; by plain least squares the mass is {_masses(drift.plain_mass_with_kg)} kg with a drift and "
        f"{_masses(drift.plain_mass_without_kg)} kg without"
    )
    why = "chosen by rows that were held out" if drift.chosen else "as stated; rows that were held out"
    return f"{taken}, {why}: error {drift.error_with:.2f} with, {drift.error_without:.2f} without drift{masses}"


FROM_FIRST_TO_LAST = "from its first sample to its last"
"""Time over which a drift is shown: rows of a table without a time have no hours."""


def fitted_drifts(session: BiasRow) -> Iterator[tuple[str, str, float, float]]:
    """Give the drift of the bias of a session.

    Yields:
        Name and unit of a component, its drift from the first sample to the last, and the half-width of its 95 %
        interval; N, N m. None where no drift was fitted, or where it is not identifiable.
    """
    length_s = session.length_s
    if session.drift_per_s is None or session.drift_half_width_95_per_s is None or length_s is None:
        return
    numbers = zip(session.drift_per_s, session.drift_half_width_95_per_s, strict=True)
    for name, unit, (drift, half_width) in zip(WRENCH_COMPONENTS, WRENCH_UNITS, numbers, strict=True):
        if drift is not None and half_width is not None:
            yield name, unit, length_s * drift, length_s * half_width


def _drift_text(session: BiasRow) -> str | None:
    drifts = [f"{name} by {plus_minus(drift, half, unit)}" for name, unit, drift, half in fitted_drifts(session)]
    return f"the bias of {session.session!r} drifts {FROM_FIRST_TO_LAST}: {', '.join(drifts)}" if drifts else None


def bias_words(test: BiasTestRow, loads: Sequence[LoadRow]) -> str:
    """Say whether one bias would do.

    Args:
        test: The test.
        loads: Loads as they were estimated.

    Returns:
        A sentence.
    """
    if test.p_value is None:
        return f"whether the biases of the {test.of} differ is not told"
    numbers = [value or 0.0 for value in test.largest_difference]
    difference = f"by up to {max(numbers[:3]):.3g} N and {max(numbers[3:]):.2g} N m (p = {test.p_value:.2g})"
    if test.of == "intervals":
        return f"the biases of the intervals within a session differ {difference}"
    errors = ", ".join(
        f"{one - load.mass_kg:+.3g}"
        for one, load in zip(test.plain_mass_with_one_bias_kg, loads, strict=True)
        if one is not None and load.mass_kg is not None and load.estimated
    )
    error = f"; with one bias for all the mass would be off by {errors} kg" if errors else ""
    return f"the biases of the sessions differ {difference}{error}"


_RARE = 0.01
"""How often recordings of one load are said to disagree."""


def disagreements(rows: Sequence[RecordingLoadRow]) -> Iterator[str]:
    """Name what recordings say of a load beyond their intervals.

    Args:
        rows: What each says by itself.

    Yields:
        A sentence for every two that differ.
    """
    pairs = [(first, second) for first, second in combinations(rows, 2) if first.load == second.load]
    # each of four numbers of every pair may be off by chance: together they are in one of a hundred
    allowance = statistics.NormalDist().inv_cdf(1.0 - 0.5 * _RARE / (4 * max(len(pairs), 1))) / NORMAL_95
    for first, second in pairs:
        halves = (first.mass_half_width_95_kg, second.mass_half_width_95_kg)
        named = [("mass", "kg", 1.0, _difference(first.mass_kg, second.mass_kg, *halves))]
        for k, axis in enumerate("xyz"):
            places = (first.centre_of_mass_m[k], second.centre_of_mass_m[k])
            halves = (first.centre_of_mass_half_width_95_m[k], second.centre_of_mass_half_width_95_m[k])
            named.append((f"centre of mass along {axis}", "mm", 1e3, _difference(*places, *halves)))
        words = [
            f"{name} by {factor * value[0]:.3g} {unit}, where {factor * value[1]:.2g} are expected"
            for name, unit, factor, value in named
            if value is not None and value[0] > allowance * value[1]
        ]
        if words:
            yield f"{first.recording} and {second.recording} disagree beyond their intervals: {'; '.join(words)}"


def _difference(
    first: float | None, second: float | None, first_half: float | None, second_half: float | None
) -> tuple[float, float] | None:
    """How far two numbers are apart and what their intervals allow; None where one is open."""
    if first is None or second is None or first_half is None or second_half is None:
        return None
    return abs(first - second), hypot(first_half, second_half)


def _masses(masses: Sequence[float | None]) -> str:
    return ", ".join("-" if mass is None else f"{mass:.4g}" for mass in masses)


class ArmLog(Row):
    """A log of an arm that was read without an experiment file."""

    controller: Annotated[str, Shown("controller")]
    """Kind of the controller, `ur` or `franka`; `ros` of a bag."""
    specified: tuple[str, ...]
    """Keys of `[recording]` with the values that were given beside the log, as `moment_about="flange"`."""
    assumed: tuple[str, ...]
    """What is taken from the format of the log, or from what is usual."""
    contradictions: tuple[str, ...]
    """What other fields of the log contradict."""


def gravity_words(gravity: float) -> str:
    """Say which gravity was taken, and what its error and that of the gain of the sensor do.

    Args:
        gravity: Its size; m/s2.

    Returns:
        The words.
    """
    return (
        f"gravity {gravity:.6g} m/s2 and the gain of the sensor, whose relative errors the mass has beside its interval"
    )


class WeighedLoad(DrawnResult):
    """What hangs on a wrist sensor or on a robot, and the sensor's biases."""

    drawn_by: ClassVar[str] = "forcetorque.payload.figures:load_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("loads", "recordings")

    answered_by: ClassVar[str | None] = "forcetorque.payload.answers:payload_answers"

    of_several: ClassVar[tuple[str, ...]] = ("recordings", "disagreements", "arms")
    interval_uses = ()

    schema_name: Literal["forcetorque/payload/3"] = Field(default="forcetorque/payload/3", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    frame: str | None = None
    """Frame of the loads on a wrist sensor; null on links of a robot."""
    observations: int
    """Number of means or poses that were fitted."""
    left_out: int
    """Samples that lack a finite reading or motion."""
    loads: tuple[LoadRow, ...]
    """Loads, in the order of the file."""
    sessions: tuple[BiasRow, ...]
    """Bias of every session, in the order of time."""
    variables: tuple[VariableRow, ...]
    """What the variables of the sensor add."""
    drift: DriftRow
    """Whether biases move evenly in time, and why."""
    bias_tests: tuple[BiasTestRow, ...]
    """Whether one bias would do."""
    mount_rad: tuple[float, float, float] | None
    """Rotation vector from the axes of the motion to those of the sensor; none where it was not asked for."""
    mount_half_width_rad: Three | None
    """Half-widths of 95 % intervals of small rotations about the sensor's axes; rad; None where `mount_rad` is."""
    tilt_rad: tuple[float, float] | None
    """Rotation vector of gravity about x and y of the world; none where it was not asked for."""
    tilt_half_width_rad: tuple[float | None, float | None] | None = None
    """Half-widths of its 95 % intervals; rad; None where it is open, or `tilt_rad` is."""
    undetermined: tuple[str, ...]
    """What the rows leave open, in sentences."""
    disagreeing: tuple[OutlierRow, ...]
    """Rows that disagree with all others."""
    hypotheses: tuple[HypothesisRow, ...]
    """Other accounts of the rows that explain them better, the best first."""
    validation: tuple[ValidationLoadRow, ...]
    """Validation intervals, held against the loads."""
    residual_rms: WrenchValues
    """Root mean square residual; N, N m."""
    spanned_directions: int
    """Directions of wrench, of six, that the loads move: one centre of mass moves three, two five."""
    assumed_gravity_m_per_s2: float | None = None
    """Gravity where orientations of the sensor give its direction alone; null where it was logged, or of a robot."""
    robot_file: str | None = Field(default=None, exclude=True, repr=False)
    """File for a robot that was written; None for none."""
    no_robot_file: str = Field(default="", exclude=True, repr=False)
    """Why no file for a robot can hold it; empty where one can."""
    recordings: tuple[RecordingLoadRow, ...] = ()
    """What each of several recordings says by itself."""
    disagreements: tuple[str, ...] = ()
    """Where they differ by more than their intervals, in sentences."""
    log_format: str = Field(default="", exclude=True, repr=False)
    """Format of the log of the first recording."""
    arms: tuple[ArmLog, ...] = ()
    """Logs that were read without an experiment file."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the loads, then biases, what is open and what disagrees.

        Yields:
            Sentences and tables.
        """
        source = f"{self.sensor} ({self.serial}), {self.observations} rows"
        for load in self.loads:
            yield f"{source}: {load_words(load)}"
            if (inertia := inertia_words(load)) is not None:
                yield inertia
        yield table_of(self.sessions, "bias: reading without load")
        yield from optional_table(self.variables, "what variables add to the reading, per unit")
        if self.mount_rad is not None:
            yield mount_words(self.mount_rad, self.mount_half_width_rad)
        if self.tilt_rad is not None:
            yield tilt_words(self.tilt_rad, self.tilt_half_width_rad)
        yield drift_words(self.drift)
        yield from (text for session in self.sessions if (text := _drift_text(session)) is not None)
        yield from (bias_words(test, self.loads) for test in self.bias_tests)
        yield from self.undetermined
        yield from optional_table(self.disagreeing, "rows that disagree with all others, and count less")
        if self.recordings:
            yield table_of(self.recordings, "what each recording says by itself, ± half a 95 % interval")
            yield from self.disagreements or ("the recordings agree within their intervals",)
        yield from optional_table(
            self.validation, "what the loads leave of intervals that were not fitted, about its middle"
        )
        rms = ", ".join(f"{value:.4f}" for value in self.residual_rms)
        yield f"residual RMS {rms} N, N m; the loads move {self.spanned_directions} of 6 directions of wrench"

    def records(self) -> list[dict[str, object]]:
        """Give a line for every load and session.

        Returns:
            The lines: a load beside the bias of a session.
        """
        return [load.flat() | session.flat() for load in self.loads for session in self.sessions]
