# SPDX-License-Identifier: BSD-3-Clause
"""What balance amounts to: a row per phase, per foot, for the robot, and for the pendulum of (5.22)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.autocorrelation import autocorrelation
from forcetorque.base.noise.slow_noise import half_width
from forcetorque.base.noise.window_means import SampleStatistics, joined_times, sample_statistics
from forcetorque.locomotion.standing.centre_of_mass_and_pressure import ComAcceleration, PressureCentres
from forcetorque.locomotion.standing.interval_balance import FootPressure, IntervalBalance, RobotBalance, half_widths
from forcetorque.locomotion.standing.support_phases import SupportPhase
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import Row, Shown

_MM = 1e3
_FEWEST_STRETCHES = 3
"""Segments of which two differences at least show how much one differs from the next."""


class SupportPhaseRow(Row):
    """All phases of one name: what the ground bears in them."""

    phase: Annotated[str, Shown("down")]
    """Soles that are down."""
    intervals: Annotated[int, Shown("times")]
    """How often."""
    duration_s: Annotated[float, Shown("together", "s", digits=2)]
    """How long together, from first sample to last of each."""
    samples: Annotated[int, Shown("samples")]
    """Samples with a known force."""
    net_N: Annotated[float | None, Shown("net force", "N", digits=1, error="half_width_95_N")]
    """Mean upward force on all feet together."""
    half_width_95_N: float | None
    """Half of its 95 % interval: of stationary noise, and of three segments or more that each have an offset of their
    own, as of another foothold, the wider; None where there are fewer and the force is no stationary noise."""
    logged_N: Annotated[float | None, Shown("logged", "N", digits=1, error="logged_half_width_95_N")] = None
    """Mean of the logged vertical forces together, beside a net force by the motion; None without."""
    logged_half_width_95_N: float | None = None
    """Half of its 95 % interval, as above."""
    deviation_N: Annotated[float | None, Shown("deviation", "N", digits=1)]
    """Standard deviation of a sample."""
    smallest_N: Annotated[float | None, Shown("smallest", "N", digits=1)]
    """Smallest sample."""
    largest_N: Annotated[float | None, Shown("largest", "N", digits=1)]
    """Largest sample."""
    independent: Annotated[float | None, Shown("independent", digits=0)]
    """How many independent samples they are worth."""
    from_weight_N: Annotated[float | None, Shown("from weight", "N", digits=1)]
    """That mean less the weight of the robot; None where it is unknown."""


class FootPressureRow(Row):
    """What presses on one foot over one interval."""

    recording: str
    """Name of the experiment."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    sole: Annotated[str, Shown("sole")]
    """Its frame."""
    sensors: Annotated[tuple[str, ...], Shown("by")]
    """Sensors that measure it."""
    samples: Annotated[int, Shown("points")]
    """Samples with a centre of pressure."""
    load_N: Annotated[float | None, Shown("load", "N", digits=1)]
    """Mean force along the normal of the sole in them."""
    x_mm: Annotated[float | None, Shown("x", "mm", digits=1)]
    """Mean of the centre of pressure along x of the sole."""
    half_width_x_mm: Annotated[float | None, Shown("± of a point, x", "mm", digits=1)]
    """Half of the 95 % interval of one point, root mean square; None where the sensors' errors are not specified."""
    deviation_x_mm: Annotated[float | None, Shown("deviation x", "mm", digits=1)]
    """Standard deviation of the points along x."""
    y_mm: Annotated[float | None, Shown("y", "mm", digits=1)]
    """The same along y."""
    half_width_y_mm: Annotated[float | None, Shown("± of a point, y", "mm", digits=1)]
    """The same along y."""
    deviation_y_mm: Annotated[float | None, Shown("deviation y", "mm", digits=1)]
    """The same along y."""
    outside_percent: Annotated[float | None, Shown("outside", "%", digits=1)]
    """Share of points outside the outline; None where it is not specified."""
    beyond_mm: Annotated[float | None, Shown("furthest", "mm", digits=1)]
    """Furthest point from the outline, negative inside."""
    neglect_mm: Annotated[float | None, Shown("neglect", "mm", digits=1)]
    """Root mean square distance to what the reading alone gives, as if the sensor lay in the sole; None where several
    sensors bound the foot."""


class RobotPressureRow(Row):
    """Centre of pressure and of mass of the robot over one interval, in the frame of a sole."""

    recording: str
    """Name of the experiment."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    frame: Annotated[str, Shown("in")]
    """Sole whose plane is the ground."""
    samples: Annotated[int, Shown("points")]
    """Samples with a centre of pressure."""
    x_mm: Annotated[float | None, Shown("x", "mm", digits=1)]
    """Mean of the centre of pressure along x."""
    half_width_x_mm: Annotated[float | None, Shown("± of a point, x", "mm", digits=1)]
    """Half of the 95 % interval of one point, root mean square; None where the sensors' errors are not specified."""
    deviation_x_mm: Annotated[float | None, Shown("deviation x", "mm", digits=1)]
    """Standard deviation of the points along x."""
    y_mm: Annotated[float | None, Shown("y", "mm", digits=1)]
    """The same along y."""
    half_width_y_mm: Annotated[float | None, Shown("± of a point, y", "mm", digits=1)]
    """The same along y."""
    deviation_y_mm: Annotated[float | None, Shown("deviation y", "mm", digits=1)]
    """The same along y."""
    from_zmp_mm: Annotated[float | None, Shown("from ZMP", "mm", digits=1)]
    """Root mean square distance to the zero moment point of the joints' motion."""
    com_x_mm: Annotated[float | None, Shown("CoM x", "mm", digits=1)]
    """Mean of the centre of mass along x."""
    com_y_mm: Annotated[float | None, Shown("CoM y", "mm", digits=1)]
    """The same along y."""
    com_height_mm: Annotated[float | None, Shown("height", "mm", digits=1)]
    """Its mean height."""
    com_height_span_mm: Annotated[float | None, Shown("span", "mm", digits=1)]
    """Highest less lowest."""


class PendulumRow(Row):
    """Acceleration of the centre of mass by (5.22) over one interval, beside that of the joints."""

    recording: str
    """Name of the experiment."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    samples: Annotated[int, Shown("in band")]
    """Samples whose height stays in the band."""
    refused: Annotated[int, Shown("refused")]
    """Samples whose height does not."""
    rms_m_s2: Annotated[float | None, Shown("rms", "m/s2", digits=3)]
    """Root mean square acceleration."""
    half_width_95_m_s2: Annotated[float | None, Shown("± of a sample", "m/s2", digits=3)]
    """Half of the 95 % interval of one sample, root mean square; None where the sensors' errors are not specified."""
    from_joints_m_s2: Annotated[float | None, Shown("from joints", "m/s2", digits=3)]
    """Root mean square difference from what the joints' motion demands."""
    within_percent: Annotated[float | None, Shown("within", "%", digits=1)]
    """Share of samples in which that lies inside the interval."""


def phase_rows(intervals: Sequence[IntervalBalance]) -> Iterator[SupportPhaseRow]:
    """Pool the net force in phases of each name.

    Args:
        intervals: How the robot stood, over intervals that are all different.

    Yields:
        A row per name, in the order in which they first occur.
    """
    for name in dict.fromkeys(name for interval in intervals for name in interval.phases.names):
        parts = [(interval, interval.phases.holds(name)) for interval in intervals]
        parts = [(interval, inside) for interval, inside in parts if inside.any()]
        phases = [(interval, phase) for interval, _ in parts for phase in interval.phases.phases if phase.name == name]
        net = np.concatenate([interval.net_N[inside] for interval, inside in parts])
        time = joined_times([interval.time_s[inside] for interval, inside in parts])
        weights = {interval.weight_N for interval, _ in parts}
        weight_N = weights.pop() if len(weights) == 1 else None
        force = sample_statistics(net[:, None], time)
        mean = float(force.mean[0])
        half = _half_width(force, [_known_of(interval, interval.net_N, phase) for interval, phase in phases])
        logged = _logged(parts, phases, time)
        yield SupportPhaseRow(
            phase=name,
            intervals=len(phases),
            duration_s=sum(phase.duration_s for _, phase in phases),
            samples=len(net),
            net_N=mean,
            half_width_95_N=half,
            logged_N=logged[0],
            logged_half_width_95_N=logged[1],
            deviation_N=finite_or_none(float(force.deviation[0])),
            smallest_N=float(force.smallest[0]),
            largest_N=float(force.largest[0]),
            independent=finite_or_none(autocorrelation(net, time).effective_count) if len(net) > 1 else None,
            from_weight_N=None if weight_N is None else mean - weight_N,
        )


def _half_width(force: SampleStatistics, stretches: Sequence[FloatArray]) -> float | None:
    """Of noise, or of segments, the wider; None where there is neither."""
    return finite_or_none(float(np.fmax(float(force.half_width[0]), _half_width_of_stretches(stretches))))


def _known_of(interval: IntervalBalance, values: FloatArray, phase: SupportPhase) -> FloatArray:
    return values[phase.samples][interval.phases.known[phase.samples]]


def _logged(
    parts: Sequence[tuple[IntervalBalance, BoolArray]],
    phases: Sequence[tuple[IntervalBalance, SupportPhase]],
    time: FloatArray,
) -> tuple[float | None, float | None]:
    """Mean of the logged forces over phases, with half of its interval; None where one interval has none."""
    values = [interval.logged_net_N[inside] for interval, inside in parts if interval.logged_net_N is not None]
    if len(values) < len(parts):
        return None, None
    force = sample_statistics(np.concatenate(values)[:, None], time)
    stretches = [
        _known_of(interval, interval.logged_net_N, phase)
        for interval, phase in phases
        if interval.logged_net_N is not None
    ]
    return float(force.mean[0]), _half_width(force, stretches)


def _half_width_of_stretches(stretches: Sequence[FloatArray]) -> float:
    """Half of the 95 % interval of the mean over all samples if every segment has an offset of its own; NaN for few."""
    if len(stretches) < _FEWEST_STRETCHES:
        return np.nan
    means, shares = np.array([(net.mean(), len(net)) for net in stretches]).T
    # the deviation of means has their own noise in it too, so that it is rather too wide than too narrow
    error = means.std(ddof=1) * np.linalg.norm(shares / shares.sum())
    return float(half_width(np.array([error]), np.array([len(stretches) - 1.0]))[0])


def foot_row(interval: IntervalBalance, foot: FootPressure) -> FootPressureRow:
    """Sum up what presses on a foot.

    Args:
        interval: The interval.
        foot: One of its feet.

    Returns:
        The row.
    """
    known = foot.pressure.known
    beyond = foot.beyond_m[known]
    stated = foot.sole.outline is not None and known.any()
    neglect = None
    if foot.reading_alone is not None:
        neglect = _rms_distance(foot.reading_alone, foot.pressure.points)
    return FootPressureRow(
        recording=interval.recording,
        interval=interval.label,
        sole=foot.sole.frame,
        sensors=foot.sensors,
        samples=int(known.sum()),
        load_N=float(foot.wrench[known, 2].mean()) if known.any() else None,
        **_points(foot.pressure),
        outside_percent=100.0 * float(np.mean(beyond > 0.0)) if stated else None,
        beyond_mm=_MM * float(beyond.max()) if stated else None,
        neglect_mm=neglect,
    )


def robot_row(interval: IntervalBalance, robot: RobotBalance) -> RobotPressureRow:
    """Sum up the centre of pressure and of mass of a robot.

    Args:
        interval: The interval.
        robot: The robot over it.

    Returns:
        The row.
    """
    com = None if robot.com is None else robot.com[np.all(np.isfinite(robot.com), axis=1)]
    mean = None if com is None or not len(com) else _MM * com.mean(axis=0)
    zmp = robot.zero_moment_point
    return RobotPressureRow(
        recording=interval.recording,
        interval=interval.label,
        frame=robot.frame,
        samples=int(robot.pressure.known.sum()),
        **_points(robot.pressure),
        from_zmp_mm=None if zmp is None else _rms_distance(zmp, robot.pressure.points),
        com_x_mm=None if mean is None else float(mean[0]),
        com_y_mm=None if mean is None else float(mean[1]),
        com_height_mm=None if mean is None else float(mean[2]),
        com_height_span_mm=None if com is None or mean is None else _MM * float(np.ptp(com[:, 2])),
    )


def pendulum_row(interval: IntervalBalance, pendulum: ComAcceleration, of_joints: FloatArray | None) -> PendulumRow:
    """Sum up the acceleration by (5.22).

    Args:
        interval: The interval.
        pendulum: The acceleration.
        of_joints: The same as the joints' motion has it; shape (n, 2); m/s2.

    Returns:
        The row.
    """
    known: BoolArray = np.all(np.isfinite(pendulum.acceleration), axis=1)
    half = None if pendulum.half_width_95 is None else pendulum.half_width_95[known]
    off = None if of_joints is None else (pendulum.acceleration - of_joints)[known]
    return PendulumRow(
        recording=interval.recording,
        interval=interval.label,
        samples=int(known.sum()),
        refused=int((~known).sum()),
        rms_m_s2=_rms(pendulum.acceleration[known]),
        half_width_95_m_s2=None if half is None else _rms(half),
        from_joints_m_s2=None if off is None else _rms(off),
        within_percent=None if off is None or half is None else 100.0 * float(np.mean(np.abs(off) <= half)),
    )


def _points(pressure: PressureCentres) -> Mapping[str, float | None]:
    known = pressure.known
    if not known.any():
        return dict.fromkeys(f"{number}{axis}_mm" for axis in "xy" for number in ("", "half_width_", "deviation_"))
    x, y = _MM * pressure.points[known].mean(axis=0)
    numbers: dict[str, float | None] = {"x_mm": float(x), "y_mm": float(y)}
    half = None if pressure.covariance is None else half_widths(pressure.covariance[known])
    for k, axis in enumerate("xy"):
        size = None if half is None else _rms(half[:, k])
        numbers[f"half_width_{axis}_mm"] = None if size is None else _MM * size
        numbers[f"deviation_{axis}_mm"] = (
            _MM * float(pressure.points[known, k].std(ddof=1)) if known.sum() > 1 else None
        )
    return numbers


def _rms(values: FloatArray) -> float | None:
    known = values[np.isfinite(values)]
    return float(np.sqrt(np.mean(known**2))) if len(known) else None


def _rms_distance(first: FloatArray, second: FloatArray) -> float | None:
    size = _rms(np.linalg.norm(first - second, axis=1))
    return None if size is None else _MM * size
