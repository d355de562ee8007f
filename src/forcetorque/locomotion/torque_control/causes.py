# SPDX-License-Identifier: BSD-3-Clause
"""What makes sensor errors oscillate a robot: each property of a loop is worsened alone until the loop is unstable."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Final, Literal, TypeVar

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ControlError
from forcetorque.locomotion.torque_control.balancing import Balance, Phase, standing
from forcetorque.locomotion.torque_control.closed_loop import LoopSetting, drawn_matrices
from forcetorque.locomotion.torque_control.controller import TorqueGains
from forcetorque.locomotion.torque_control.file import PERIOD_S, TorqueLoopFile
from forcetorque.locomotion.torque_control.linear_robot import (
    linear_robot,
    massless_drives,
    require_stable,
    with_springs,
)
from forcetorque.locomotion.torque_control.stability import Stability
from forcetorque.locomotion.torque_control.study import share_interval
from forcetorque.locomotion.torque_control.walking_loop import WalkingController, zmp_sensitivity
from forcetorque.locomotion.torque_control.world import JOINTS, SENSORS, Biped
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, table_of

TORQUES: Final = "joint torques"
"""Loop of the torque controllers."""
ZMP: Final = "zero moment point"
"""Loop of the walking controller."""
_MOST_HIT_PERCENT: Final = 5.0
"""Share of the smaller errors that may oscillate where larger ones are counted; percent."""


class CauseRow(Row):
    """One property of one loop, worsened as far as the smaller errors leave the robot standing."""

    loop: Annotated[str, Shown("fed back")]
    """What the sensors measure for the loop."""
    tilt_deg: Annotated[float, Shown("sole", "deg", digits=0)]
    """How far the sole is turned."""
    cause: Annotated[str, Shown("cause")]
    """What is worsened, with the unit of its values; without one it is a factor of the value in the file."""
    value: Annotated[float, Shown("in the file", digits=2)]
    """Value of the file."""
    limit: Annotated[float | None, Shown("limit", digits=2)]
    """Value from which the loop is unstable without errors; None if it is stable up to the largest looked at."""
    at: Annotated[float | None, Shown("at", digits=2)]
    """Value that is counted at: beside the one from which on more than 5 % of other draws of the smaller errors are
    unstable, at most the limit; of whole numbers the one before it. None where nothing is unstable."""
    larger: Annotated[int, Shown("larger")]
    """Draws of the larger errors that are unstable there."""
    larger_least_percent: Annotated[float, Shown("at least", "%", digits=0)]
    """Lower end of the 95 % interval of their share (Clopper and Pearson)."""
    larger_most_percent: Annotated[float, Shown("at most", "%", digits=0)]
    """Its upper end."""
    smaller: Annotated[int, Shown("smaller")]
    """Draws of the smaller errors that are."""
    smaller_most_percent: Annotated[float, Shown("at most", "%", digits=0)]
    """Upper end of the 95 % interval of their share."""
    draws: Annotated[int, Shown("draws")]
    """Draws of either."""
    in_file: Annotated[int, Shown("in the file")]
    """Draws of the larger errors that are unstable with the value of the file."""
    median_limit: Annotated[float | None, Shown("median limit", digits=2)]
    """Median over draws of the value from which the larger errors are unstable; None beyond the largest looked at."""
    frequency_hz: Annotated[float | None, Shown("frequency", "Hz", digits=1)]
    """Median frequency of the modes that begin to grow with the larger errors; 0 is a fall without oscillation."""

    @property
    def tells_apart(self) -> bool:
        """Whether the 95 % intervals of both shares are disjoint, that of the larger errors above."""
        return self.larger_least_percent > self.smaller_most_percent

    @property
    def share(self) -> float:
        """Share of the larger errors that oscillates where the smaller ones hardly do."""
        return self.larger / self.draws


class OscillationCauses(DrawnResult):
    """What makes sensor errors oscillate a robot."""

    answered_by: ClassVar[str | None] = "forcetorque.locomotion.answers:oscillation_causes_answers"
    drawn_by: ClassVar[str] = "forcetorque.locomotion.figures:oscillation_causes_figure"

    schema_name: Literal["forcetorque/oscillation_causes/1"] = Field(
        default="forcetorque/oscillation_causes/1", alias="schema"
    )
    """Form of the result."""
    name: str
    """What the file is called."""
    larger: str
    """Name of the largest errors."""
    smaller: str
    """Name of the smallest."""
    rows: tuple[CauseRow, ...]
    """One per loop, sole and cause."""

    def blocks(self) -> Iterator[Table | str]:
        """Give the table.

        Yields:
            It and a sentence.
        """
        yield table_of(
            self.rows,
            f"{self.name}: unstable draws, on one foot; larger errors are '{self.larger}', smaller '{self.smaller}'",
        )
        yield "all but the cause is as in the file; the loops are linear: no limits, no dry friction, no foot that tips"


@dataclass(frozen=True, slots=True, eq=False)
class _Cause:
    """One property: values to try, and how stable the loop is there with E of the four sensors."""

    loop: str
    name: str
    value: float
    grid: FloatArray
    """Values from that of the file on, worse each time."""
    stability: Callable[[float, FloatArray], Stability]
    whole: bool = False
    """Whether values are whole numbers."""

    def limit(self, matrix: FloatArray) -> float:
        """Least value of the grid's range that is unstable, bisected within its interval; inf if there is none."""
        stable = self.grid[0]
        for value in self.grid:
            if not self.stability(value, matrix).stable:
                return self._bisected(stable, value, matrix)
            stable = value
        return np.inf

    def _bisected(self, stable: float, unstable: float, matrix: FloatArray) -> float:
        while unstable - stable > 2e-3 * unstable:
            middle = 0.5 * (stable + unstable)
            if self.whole:
                middle = float(round(middle))
                if middle in (stable, unstable):
                    break
            if self.stability(middle, matrix).stable:
                stable = middle
            else:
                unstable = middle
        return float(unstable)


_NONE: Final = np.zeros((len(SENSORS), 6, 6))


def _milliseconds(first: float, further: float) -> FloatArray:
    """Whole milliseconds from the file's on, finer where they are few."""
    return np.unique(np.round(first + np.geomspace(1.0, 1.0 + further, 16) - 1.0))


def _torque_causes(file: TorqueLoopFile, biped: Biped) -> Iterator[_Cause]:
    """Properties of the loop of the torque controllers."""
    setting = file.setting(biped, 1.0)
    still = standing(biped, Phase.LEFT, 2, file.motion.lift_m, setting.period_s)
    robot = linear_robot(biped, setting, still, 0)
    require_stable(robot)
    doubled = linear_robot(biped, replace(setting, balance=_times(setting.balance, 2.0, *_BALANCE_GAINS)), still, 0)
    links = massless_drives(biped, setting, still, 0)

    def of_setting(changed: Callable[[float], LoopSetting]) -> Callable[[float, FloatArray], Stability]:
        return lambda value, matrix: replace(robot, setting=changed(value)).stability(matrix)

    def balanced(factor: float, matrix: FloatArray) -> Stability:
        demand = robot.plant.demand + (factor - 1.0) * (doubled.plant.demand - robot.plant.demand)
        return replace(robot, plant=replace(robot.plant, demand=demand)).stability(matrix)

    def elastic(joints: FloatArray) -> Callable[[float, FloatArray], Stability]:
        return lambda compliance, matrix: with_springs(links, 1e3 / np.where(joints, compliance, _STIFFEST)).stability(
            matrix
        )

    gains = setting.gains
    factors, compliances = np.geomspace(1.0, 20.0, 16), np.geomspace(_STIFFEST, 100.0, 20)
    ankles = np.array(["ankle" in joint for joint in JOINTS])
    late, hold = float(setting.delay_steps), float(setting.hold_steps)
    delayed = of_setting(lambda value: replace(setting, delay_steps=round(value)))
    yield _Cause(TORQUES, "delay of the estimate, ms", late, _milliseconds(late, 60.0), delayed, whole=True)
    held = of_setting(lambda value: replace(setting, hold_steps=round(value)))
    yield _Cause(TORQUES, "interval between estimates, ms", hold, _milliseconds(hold, 100.0), held, whole=True)
    stiffer = of_setting(
        lambda value: replace(setting, gains=_times(gains, value, "proportional", "integral", "derivative"))
    )
    yield _Cause(TORQUES, "gains of the torque controllers", 1.0, factors, stiffer)
    if np.any(gains.bemf):  # none of it cannot be worsened by a factor
        viscous = of_setting(lambda value: replace(setting, gains=_times(gains, value, "bemf")))
        yield _Cause(TORQUES, "compensation of viscous friction", 1.0, np.geomspace(1.0, 100.0, 20), viscous)
    yield _Cause(TORQUES, "gains of the balancing controller", 1.0, factors, balanced)
    every = np.ones(len(JOINTS), dtype=bool)
    yield _Cause(TORQUES, "compliance of the ankles, rad/(kN m)", 0.0, compliances, elastic(ankles))
    yield _Cause(TORQUES, "compliance of all joints, rad/(kN m)", 0.0, compliances, elastic(every))


_STIFFEST: Final = 0.01
"""Compliance of what is called rigid; rad/(kN m)."""
_BALANCE_GAINS: Final = ("centre_stiffness", "centre_damping", "posture_stiffness", "posture_damping")


_Scaled = TypeVar("_Scaled", TorqueGains, Balance)


def _times(values: _Scaled, factor: float, *keys: str) -> _Scaled:
    return replace(values, **{key: factor * getattr(values, key) for key in keys})


def _zmp_causes(file: TorqueLoopFile, biped: Biped) -> Iterator[_Cause]:
    """Properties of the loop of the walking controller."""
    controller = file.walking
    foot, late = SENSORS.index("l_foot_ft"), float(round(controller.delay_s / PERIOD_S))

    def of(changed: Callable[[float], WalkingController]) -> Callable[[float, FloatArray], Stability]:
        return lambda value, matrix: changed(value).stability(zmp_sensitivity(biped, matrix[foot]), biped.mass)

    def scaled(key: str) -> Callable[[float, FloatArray], Stability]:
        return of(lambda value: controller.model_copy(update={key: value * getattr(controller, key)}))

    hertz = np.geomspace(controller.sway_hz, 10.0 * controller.sway_hz, 20)
    delayed = of(lambda value: controller.model_copy(update={"delay_s": PERIOD_S * value}))
    yield _Cause(ZMP, "delay of the zero moment point, ms", late, _milliseconds(late, 100.0), delayed, whole=True)
    swaying = of(lambda value: controller.model_copy(update={"sway_hz": value}))
    yield _Cause(ZMP, "natural frequency on the compliance, Hz", controller.sway_hz, hertz, swaying)
    for name, key in (
        ("gain of the zero moment point", "zmp_gain"),
        ("gain of the centre of mass", "centre_gain"),
        ("gain of the divergent component", "dcm_gain"),
        ("lag of the joints", "lag_s"),
    ):
        yield _Cause(ZMP, name, 1.0, np.geomspace(1.0, 20.0, 20), scaled(key))


def study_causes(file: TorqueLoopFile, progress: Callable[[str], None]) -> OscillationCauses:
    """Worsen each property of both loops alone, with and without errors of the sensors.

    Args:
        file: The robot, both controllers, sizes and number of draws of E, tilts of the sole; motions are not run.
        progress: Called with a line for people as work goes on.

    Returns:
        Values from which the loops are unstable.

    Raises:
        ControlError: If a loop is unstable without any error, or there is one size of errors.
    """
    if len(set(file.errors.values())) < 2:
        raise ControlError(
            f"errors: expected at least two sizes to compare, got {', '.join(file.errors)}; state a larger and a "
            "smaller one"
        )
    rng = np.random.default_rng(file.seed)
    chosen, unit = (drawn_matrices(1.0, file.sensor.lever_m, rng, file.seeds) for _ in range(2))
    larger, smaller = (which(file.errors, key=file.errors.__getitem__) for which in (max, min))
    rows = []
    for tilt_deg in file.tilt_deg:
        biped = Biped.on_soles(tilt_deg)
        for causes in (_torque_causes, _zmp_causes):
            for cause in causes(file, biped):
                progress(f"sole at {tilt_deg:g} degrees: {cause.loop}, {cause.name}")
                rows.append(
                    _row(
                        cause,
                        tilt_deg,
                        larger=file.errors[larger] * unit,
                        smaller=file.errors[smaller] * unit,
                        chosen=file.errors[smaller] * chosen,
                    )
                )
    return OscillationCauses(name=file.name, larger=larger, smaller=smaller, rows=tuple(rows))


def _row(cause: _Cause, tilt_deg: float, *, larger: FloatArray, smaller: FloatArray, chosen: FloatArray) -> CauseRow:
    """Settle a value by some draws, and count others there."""
    alone = cause.limit(_NONE)
    if alone <= cause.grid[0]:
        raise ControlError(
            f"{cause.loop}: expected a loop that is stable without any sensor error, got one that is not; lower its "
            "gains or its delay"
        )
    at = min(alone, _quantile(np.array([cause.limit(matrix) for matrix in chosen]), _MOST_HIT_PERCENT / 100.0))
    large, small = (np.array([cause.limit(matrix) for matrix in drawn]) for drawn in (larger, smaller))
    draws, counts = len(large), [int((limits < at).sum()) if at < np.inf else 0 for limits in (large, small)]
    least, most = share_interval(counts[0], draws)
    begins = [
        cause.stability(limit, matrix).frequency_hz
        for limit, matrix in zip(large, larger, strict=True)
        if np.isfinite(limit)
    ]
    return CauseRow(
        loop=cause.loop,
        tilt_deg=tilt_deg,
        cause=cause.name,
        value=cause.value,
        limit=finite_or_none(alone),
        at=finite_or_none(at - cause.whole),
        larger=counts[0],
        larger_least_percent=least,
        larger_most_percent=most,
        smaller=counts[1],
        smaller_most_percent=share_interval(counts[1], draws)[1],
        draws=draws,
        in_file=int((large <= cause.grid[0]).sum()),
        median_limit=finite_or_none(_quantile(large, 0.5)),
        frequency_hz=float(np.median(begins)) if begins else None,
    )


def _quantile(values: FloatArray, share: float) -> float:
    """The value that at least the share does not exceed; inf counts."""
    return float(np.quantile(values, share, method="inverted_cdf"))
