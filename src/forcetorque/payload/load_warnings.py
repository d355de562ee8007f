# SPDX-License-Identifier: BSD-3-Clause
"""Warnings on loads: contradictions with the experiment file and the URDF, and unreliable results."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.wrench import MeasureDirection, reading_sign
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.formats.arm_log import FLANGE
from forcetorque.inspection.draft.gravity_fit import fit_gravity
from forcetorque.payload.identification.load_estimates import HypothesisRow, LoadEstimate, LoadSolution
from forcetorque.payload.identification.parameter_vector import six_of
from forcetorque.payload.load_on_wrist_sensor import inertia_of_stated, wrist_loads
from forcetorque.payload.loads_on_robot_links import LinkLoads, link_loads
from forcetorque.payload.result import LoadRow, WeighedLoad, bias_words
from forcetorque.recording.recording import Support, Use
from forcetorque.recording.stream import Stream
from forcetorque.results.number_text import amount, plus_minus


def reversed_sense(run: SensorRun) -> Iterator[str]:
    """Name the sense of a reading on an arm whose tool is a `[[load]]`, where the accelerations say the other one.

    Yields:
        A sentence where they do; none where the arm moves too slowly to tell, where the base moves, or for raw counts.
    """
    yield from run.once("reversed sense", lambda: tuple(_reversed_sense(run)))


def _reversed_sense(run: SensorRun) -> Iterator[str]:
    experiment = run.experiment
    if link_loads(experiment) is None or run.sensor.quantity != "wrench" or not run.has(Use.CALIBRATION):
        return
    supports = [interval.support for interval in experiment.intervals(Use.CALIBRATION)]
    frames = {support.frame if isinstance(support, Support) else None for support in supports}
    frame, *others = frames
    if others or frame is None:
        return
    sensor, stream = experiment.model.sensor(run.sensor.name), experiment.recording.stream(run.sensor.stream)
    felt = fit_gravity(experiment.model, sensor.joint, frame, experiment.recording, stream)
    if felt is None or not felt.is_significant or felt.direction in (None, sensor.direction):
        return
    down = felt.weight if felt.direction == MeasureDirection.CHILD_TO_PARENT else -felt.weight
    along = (np.round(down / np.linalg.norm(down), 1) + 0.0).tolist()
    yield (
        f"the accelerations in the log say measure_direction = {felt.direction!r}, with which things fall along "
        f"{along} of {frame!r}, and the file says {sensor.direction.value!r}; state both so: with both reversed "
        "weights are right, and every push comes out with the other sign"
    )


_BEHIND_M = 0.01
"""How far behind a flange the centre of mass of a tool may be, beyond its interval; m (heuristic)."""


def behind_flange(frame: str, loads: Sequence[LoadEstimate]) -> Iterator[HypothesisRow]:
    """Name a centre of mass behind the flange of an arm, where a moment about another point puts it.

    Args:
        frame: Frame of the wrench.
        loads: Loads on it.

    Yields:
        A row for each; none where the frame is not that of a flange, whose z axis points out of it.
    """
    for load in loads if frame == FLANGE else ():
        height, half_width = float(load.centre_of_mass[2]), float(load.centre_of_mass_half_width[2])
        is_known = load.estimated and load.is_determined and load.mass > load.mass_half_width
        if is_known and height + half_width < -_BEHIND_M:
            words = (
                f"the centre of mass lies {-1e3 * height:.0f} mm behind the flange, where no tool is: the moment is "
                "about the tool centre point and not about the flange, or the wrench is not in the frame of the flange"
            )
            yield HypothesisRow(
                name="moment about another point", description=words, residual_share=1.0, severity="caution"
            )


_ARM_M = 0.5
"""Distance of a wrist from the joint about which it turns; m (heuristic)."""
_TURNING_RAD_S = 0.05
"""Angular speed above which a sensor turns; rad/s (heuristic)."""
_TURNING_SHARE = 0.25
"""Share of samples in which a sensor turns, from which on they decide on the load (heuristic)."""
_ABOVE_NOISE = 4.0
"""Squared turn over that of noise, which is larger in 2 % of windows at rest, were the noise known."""
_STEP_S = 0.05
"""Length of a window in which a turn is differentiated; s."""
_MOST_WINDOWS = 20000
"""Windows of a recording, at most."""
_POSE_S = 0.2
"""Samples farther apart than this are single poses, between which nothing was recorded; s."""


def moving_without_acceleration(run: SensorRun, loads: Sequence[LoadEstimate]) -> Iterator[HypothesisRow]:
    """Name a wrist sensor that turns while it weighs, where the log has its orientation and no acceleration.

    Args:
        run: The sensor.
        loads: Loads on it, with their intervals.

    Yields:
        A row where the centripetal acceleration of a wrist that turns so fast makes more of the mass than its interval;
        none for single poses.
    """
    wrist = wrist_loads(run.experiment)
    half_widths = [load.mass_half_width / load.mass for load in loads if load.estimated and load.mass > 0.0]
    if wrist is None or not half_widths or not run.has(Use.CALIBRATION):
        return
    recording = run.experiment.recording
    motion = [recording.stream(name) for name in wrist.table.motion or ()]
    turned = next((stream for stream in motion if "gravity" in stream.signals), None)
    if turned is None or len(turned) < len("xyz"):
        return
    step_s = 1e-9 * float(np.median(np.diff(turned.stamp_ns)))
    if not 0.0 < step_s < _POSE_S:
        return
    used = np.zeros(len(turned), dtype=bool)
    for use in (Use.CALIBRATION, Use.IGNORE):
        for interval in recording.intervals:
            if interval.use is use:
                used[interval.holds(turned.stamp_ns)] = use is Use.CALIBRATION
    speeds = _turning_speeds(turned, used, max(len("xyz"), round(_STEP_S / step_s)))
    turning = speeds[speeds > _TURNING_RAD_S]
    if len(turning) <= _TURNING_SHARE * len(speeds):
        return
    share, speed = len(turning) / len(speeds), float(np.median(turning))
    of_weight = speed**2 * _ARM_M / run.experiment.processing.gravity
    if share * of_weight > min(half_widths):
        words = (
            f"the sensor turns in {100 * share:.0f} % of the samples, at {speed:.2g} rad/s in the median, and its "
            f"orientation gives gravity alone: the acceleration of the arm, {100 * of_weight:.2g} % of gravity at "
            f"{_ARM_M:g} m from the axis, passes for weight, and no interval holds it; give intervals at rest in "
            "several postures, or log proper_acceleration and angular_velocity of the sensor"
        )
        yield HypothesisRow(name="motion of the arm", description=words, residual_share=1.0, severity="caution")


def _turning_speeds(turned: Stream, used: BoolArray, steps: int) -> FloatArray:
    """How fast gravity turns in windows of so many steps, rad/s.

    A cut between two poses is one step, and no motion. Nor is a turn that noise of the orientation makes: of noise,
    squared second differences are three times the squared turn from first to last.

    Returns:
        Speeds of the windows whose samples are all used; 0 where noise explains the turn.
    """
    starts = np.arange(0, len(turned) - steps, max(1, len(turned) // _MOST_WINDOWS))
    rows = starts[:, None] + np.arange(steps + 1)
    rows = rows[used[rows].all(axis=1)]
    down = turned.signal("gravity").values[rows]
    down = down / np.linalg.norm(down, axis=2, keepdims=True)
    seconds = 1e-9 * np.diff(turned.stamp_ns[rows], axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        single = np.median(np.linalg.norm(np.diff(down, axis=1), axis=2) / seconds, axis=1)
        speeds: FloatArray = np.minimum(single, np.linalg.norm(down[:, -1] - down[:, 0], axis=1) / seconds.sum(axis=1))
    noise = (np.diff(down, n=2, axis=1) ** 2).sum(axis=2).mean(axis=1) / 3.0
    speeds[((down[:, -1] - down[:, 0]) ** 2).sum(axis=1) < _ABOVE_NOISE * noise] = 0.0
    return speeds[np.isfinite(speeds)]


_BETTER = 0.7
"""Share of the residual that is left where a load is in the URDF already (heuristic)."""


def load_doubts(run: SensorRun) -> Iterator[str]:
    """Say what makes loads on links of a robot doubtful.

    Yields:
        A sentence where loads are weighed with the sensor's own reading, one for every load that it weighed before, and
        one for every stated load without which the readings fit better.
    """
    loads = link_loads(run.experiment)
    if loads is None:
        return
    known = [load for own in (loads, *_beside(loads)) for load in own.loads if load.is_known and load.mass]
    names = ", ".join(repr(load.name) for load in loads.loads if not load.is_known and load.expected is None)
    if names:
        weighed = ", ".join(dict.fromkeys(repr(load.name) for load in known))
        yield (
            f"load {names}: estimated with this sensor's own reading, beside {weighed}, which is stated"
            if weighed
            else f"load {names}: estimated with this sensor's own reading, so its mass and the scale of the matrix are "
            "told apart by the prior alone; weigh one tool and state its mass_kg and centre_of_mass_m"
        )
    hung = {load.name for own in (loads, *_beside(loads)) for load in own.loads if load.mass != 0.0}
    if names and len(hung) == 1:
        yield (
            f"load {names}: one tool moves three of the six directions of a wrench, the others stay as the prior has "
            "them; record a second one, with its centre of mass elsewhere"
        )
    yield from run.circular_loads()
    if loads.sensor is not None and run.has(Use.CALIBRATION):
        yield from _doubled(run, loads)


def _beside(loads: LinkLoads) -> list[LinkLoads]:
    return [on_links for other in loads.pool.values() if (on_links := link_loads(other)) is not None]


def _doubled(run: SensorRun, loads: LinkLoads) -> Iterator[str]:
    """Name loads that the URDF has too: without them the readings fit better, about the means of intervals."""
    stated = [number for number, load in enumerate(loads.loads) if load.is_known and load.mass]
    if not stated:
        return
    try:
        problem = loads.problem(run.experiment)
    except ExperimentError:
        return  # raw counts without a prior weigh no load; what else is missing the fit names
    rows, sign = problem.rows, reading_sign(problem.direction, child_is_outboard=True)
    if rows.columns is None or rows.known is None:
        return
    for number in stated:
        load, mine = loads.loads[number], rows.load == number
        if not mine.any():
            continue
        inertia = inertia_of_stated(load)
        values = np.concatenate([[inertia.mass], inertia.first_moment, six_of(inertia.second_moment)])
        bare = (rows.wrench - rows.known)[mine, :3]
        weight = (sign * rows.columns[mine] @ values)[:, :3]
        with_it, without = (_about_means(part, rows.block[mine]) for part in (bare - weight, bare))
        if without < _BETTER * with_it:
            yield (
                f"load {load.name!r}: the readings fit the URDF better without it: the URDF seems to have it already; "
                f"take it out of one of the two (force residual {with_it:.3g} N with it, {without:.3g} N without)"
            )


def _about_means(values: FloatArray, block: IntArray) -> float:
    """Root mean square about the mean of every block."""
    about = values.copy()
    for number in np.unique(block):
        about[block == number] -= values[block == number].mean(axis=0)
    return float(np.sqrt((about**2).sum(axis=1).mean()))


def reference_doubts(run: SensorRun) -> tuple[str, ...]:
    """Say why what mechanics demands of a sensor may be wrong, so that it flatters the calibration fitted to it.

    Returns:
        A sentence for each statement that the readings contradict, and for each load that the sensor itself weighed;
        none for a bias that steps or a reading that comes late, which change a load little.
    """
    return (*contradicted_statements(run, cautions=False), *run.circular_loads())


def contradicted_statements(run: SensorRun, *, cautions: bool = True) -> Iterator[str]:
    """Name frames, senses and clocks with whose opposite the readings go better, where a load was estimated.

    Without this a load takes up part of a wrong statement, and a fit on it looks like any other.

    Args:
        run: The sensor.
        cautions: Whether accounts count that change a load little.

    Yields:
        A sentence for each.
    """
    solution = _estimated(run)
    for hypothesis in () if solution is None else solution.hypotheses:
        if cautions or hypothesis.severity == "contradiction":
            yield f"the load was estimated, and the readings contradict the file: {hypothesis.description}"
    if solution is not None:
        yield from (f"{row.name}: {row.description}" for row in moving_without_acceleration(run, solution.loads))
    yield from overweight_loads(run)
    yield from reversed_sense(run)


def overweight_loads(run: SensorRun) -> Iterator[str]:
    """Name loads that were estimated and weigh more than their sensor reads: a wrong unit makes a load of any size.

    Yields:
        A sentence for each.
    """
    solution, full_scale = _estimated(run), run.sensor.full_scale
    if solution is None or full_scale is None:
        return
    most = float(full_scale[:3].max())
    for load in solution.loads:
        weight = run.experiment.processing.gravity * abs(load.mass)
        if weight > most:
            yield (
                f"load {load.name!r}: {load.mass:.3g} kg weigh {weight:.3g} N, and the sensor reads {most:g} N "
                "at most; check units of the wrench (N m or N mm) and of the joints (deg or rad), and full_scale of "
                "[[sensor]]"
            )


def _estimated(run: SensorRun) -> LoadSolution | None:
    """The loads that were estimated; None where all are stated, or nothing estimates them."""
    experiment = run.experiment
    if not run.has(Use.CALIBRATION):
        return None
    if (wrist := wrist_loads(experiment)) is not None:
        return None if wrist.are_stated else wrist.solution(experiment)
    hung = link_loads(experiment)
    return None if hung is None or all(load.is_known for load in hung.loads) else hung.solution(experiment)


_MANY = 0.05
"""Share of samples that disagree with the others, from which on something else than the load acts (heuristic)."""


def samples_disagree(weighed: WeighedLoad) -> bool:
    """Decide whether recordings, or too many samples, disagree for one load to explain them.

    Returns:
        Whether they do.
    """
    return bool(weighed.disagreements) or len(weighed.disagreeing) > _MANY * weighed.observations


def reason_to_withhold(weighed: WeighedLoad) -> str | None:
    """Say why a robot is not to be told of a load.

    Returns:
        The first reason; None where there is none. That nothing hangs there is none where the file states it.
    """
    is_stated = not any(load.estimated for load in weighed.loads)
    for hypothesis in weighed.hypotheses:
        if not (is_stated and hypothesis.name == "no load"):
            return f"{hypothesis.name}: {hypothesis.description}"
    if samples_disagree(weighed):
        count = f"{len(weighed.disagreeing)} of {weighed.observations} samples disagree with the others"
        return "; ".join((*weighed.disagreements[:1], *((count,) if weighed.disagreeing else ())))
    return weighed.undetermined[0] if weighed.undetermined else None


_WIDE = 0.2
"""Share of a mass from which on its interval is too wide to use (heuristic)."""
_WIDE_CENTRE_M = 0.02
"""Half-width from which on the interval of a centre of mass is too wide to use; m (heuristic)."""


def torque_doubt(load: LoadRow) -> str | None:
    """Say why a robot is not to be told of a load that joint torques hold.

    Returns:
        What its postures leave too wide an interval of; None where they do not.
    """
    mass, half_width = load.mass_kg or 0.0, load.mass_half_width_95_kg or 0.0
    if half_width > _WIDE * mass:
        return f"the postures leave the mass at {plus_minus(mass, half_width, 'kg')}"
    widest = max(half or 0.0 for half in load.centre_of_mass_half_width_95_m)
    if widest > _WIDE_CENTRE_M:
        return f"the postures leave the centre of mass within {amount(1e3 * widest, 'mm')} to either side"
    return None


def overruled(doubt: str | None, override: str | None, *, where: str) -> str | None:
    """Refuse to tell a robot of something doubtful, unless a person gives a reason.

    Args:
        doubt: What is doubtful; None for nothing.
        override: The reason of a person; None for none.
        where: What is told, for the message.

    Returns:
        What the file has to say of it; None without doubt.

    Raises:
        ExperimentError: If there is a doubt without a reason, or the reason is empty.
    """
    if override is not None and not override.strip():
        raise ExperimentError("override: expected the reason to write a doubtful load, in words; got an empty one")
    if doubt is None:
        return None
    if override is None:
        raise ExperimentError(
            f"{where}: expected what the measurements agree on, got: {doubt}; correct it, or write it with --override "
            '"reason"'
        )
    return f"written by override ({' '.join(override.split())}), although: {' '.join(doubt.split())}"


_RARE = 0.01
"""Differences of biases that come from one bias more seldom are a warning."""


def payload_doubts(weighed: WeighedLoad) -> Iterator[str]:
    """Say what makes a weighed load doubtful.

    Yields:
        A sentence for each matter.
    """
    for hypothesis in weighed.hypotheses:
        yield f"{hypothesis.name}: {hypothesis.description}"
    for test in weighed.bias_tests:
        if test.of == "intervals" and test.p_value is not None and test.p_value < _RARE:
            yield (
                f"one bias for a session is wrong: {bias_words(test, weighed.loads)}; state a session for each "
                "interval after which the sensor was switched off, zeroed or warmed up"
            )
    yield from weighed.disagreements
    if weighed.left_out:
        yield f"{weighed.left_out} sample(s) lack a finite reading or motion, and are left out"
    if weighed.disagreeing:
        names = ", ".join(row.observation for row in weighed.disagreeing[:5])
        more = f" and {len(weighed.disagreeing) - 5} more" if len(weighed.disagreeing) > 5 else ""
        count = f"{len(weighed.disagreeing)} of {weighed.observations}"
        yield f"{count} rows disagree with the others and count less: {names}{more}"
    for row in weighed.validation:
        if row.contact:
            force = f"up to {row.largest_force_N:.3g} N"
            yield f"interval {row.interval!r}: {force} are not of the load: something touches it"
