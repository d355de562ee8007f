# SPDX-License-Identifier: BSD-3-Clause
"""Identify the payload of a wrist sensor, or of a robot beyond a sensor, from the sensor's own measurements."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.base.noise.window_means import means_over
from forcetorque.base.rows_on_disk import row_blocks
from forcetorque.experiment.campaign import Campaign, Runs
from forcetorque.experiment.experiment import Experiment, ExperimentSensor
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.held_load import held_load
from forcetorque.payload.identification.estimation_problem import LoadProblem, together
from forcetorque.payload.identification.load_estimates import HypothesisRow, LoadEstimate, LoadSolution, three
from forcetorque.payload.identification.loads_with_intervals import solve
from forcetorque.payload.identification.measurement_model import instants, load_wrench
from forcetorque.payload.load_on_wrist_sensor import WristLoads, wrist_loads
from forcetorque.payload.load_warnings import (
    behind_flange,
    load_doubts,
    moving_without_acceleration,
    overweight_loads,
    payload_doubts,
    reversed_sense,
)
from forcetorque.payload.loads_on_robot_links import LinkLoads, joined_problem, link_loads
from forcetorque.payload.result import LoadRow, RecordingLoadRow, ValidationLoadRow, WeighedLoad, disagreements
from forcetorque.recording.recording import Use
from forcetorque.results.number_text import finite_or_none, plus_minus
from forcetorque.robot.mount_estimate import rotation_vector


def hanging_on(run: SensorRun) -> WristLoads | LinkLoads:
    """Give what hangs on a wrist sensor, or on the robot.

    Returns:
        The loads.

    Raises:
        ExperimentError: If nothing hangs on either.
    """
    hanging = wrist_loads(run.experiment) or link_loads(run.experiment)
    if hanging is None:
        raise ExperimentError(
            "expected [[load]], what hangs on the sensor, got [robot] alone; add [[load]] with link, the link of the "
            "URDF that it is fastened to, or give [load] in place of [robot]; of the tool of the URDF itself "
            "`forcetorque tare --to` writes a file for a robot"
        )
    return hanging


def weighing_sensor(experiment: Experiment) -> ExperimentSensor:
    """Give the sensor that weighs the loads.

    Args:
        experiment: Experiment with its loads.

    Returns:
        The nearest sensor inboard of the loads on a robot; else the first.
    """
    loads = link_loads(experiment)
    return experiment.sensors[0] if loads is None or loads.sensor is None else loads.sensor


def links_of(campaign: Campaign) -> dict[str, str]:
    """Name the links of the loads on a robot.

    Args:
        campaign: The recordings.

    Returns:
        Link by name of the load; none for loads on a wrist sensor.
    """
    return {
        load.name: link
        for run in campaign.runs
        if (hanging := link_loads(run.experiment)) is not None
        for load, link in zip(hanging.loads, hanging.links, strict=True)
    }


def weighed(campaign: Campaign) -> LoadSolution:
    """Weigh the loads by all recordings together.

    Args:
        campaign: The recordings.

    Returns:
        Loads and biases.

    Raises:
        ExperimentError: If some have a wrist sensor and others a robot.
    """
    first, hanging = campaign.runs[0], [hanging_on(run) for run in campaign.runs]
    if len({type(one) for one in hanging}) > 1:
        raise ExperimentError(
            "expected recordings that all have [robot], or all a wrist sensor without it, got some of both; state the "
            "loads in one way"
        )
    if len(hanging) == 1 or isinstance(hanging[0], LinkLoads):
        return hanging[0].solution(first.experiment)
    named = zip(campaign.recordings, campaign.runs, hanging, strict=True)
    return solve(together({name: own.problem(run.experiment) for name, run, own in named}))


def weighed_alone(campaign: Campaign) -> Iterator[tuple[str, LoadEstimate]]:
    """Weigh the loads by each of several recordings by itself.

    Args:
        campaign: The recordings.

    Yields:
        Name of the recording, and a load.
    """
    if len(campaign.runs) < 2:
        return
    for name, run in zip(campaign.recordings, campaign.runs, strict=True):
        experiment = run.experiment
        if (hanging := link_loads(experiment)) is not None:
            experiment = hanging.pool.get(name, experiment)
        if (wrist := wrist_loads(experiment)) is not None:
            yield from ((name, load) for load in wrist.solution(experiment).loads)
        elif (hanging := link_loads(experiment)) is not None and run.has(Use.CALIBRATION):
            yield from ((name, load) for load in hanging.solution(experiment).loads)


def problem_among(campaign: Campaign, run: SensorRun, use: Use) -> LoadProblem:
    """Ask what a recording tells of the loads, numbered as `weighed` numbers them.

    Args:
        campaign: The recordings.
        run: One of them.
        use: Use of the intervals.

    Returns:
        The problem.
    """
    hanging, name = hanging_on(run), campaign.recording(run)
    if isinstance(hanging, LinkLoads):
        return joined_problem({name: run.experiment}, use=use, among=hanging.pool or None)
    return hanging.problem(run.experiment, use=use)


_TOUCHED = 0.2
"""Share of the weight of a load that nothing but a contact leaves, on intervals that were not fitted (heuristic)."""
_LASTING_S = 0.25
"""What lasts shorter is a jerk of the motion, or a tap; s."""


@with_recording_notes
def weigh_load(runs: Runs) -> WeighedLoad:
    """Give the loads that the calibration intervals of one or several experiments tell.

    Args:
        runs: The sensor; of several experiments, all under the same loads for a wrist sensor without a robot, while
            on a robot loads of one name are one load.

    Returns:
        Loads, biases, their 95 % intervals, what stays open, and what makes it doubtful.

    Raises:
        ExperimentError: If another sensor weighs the loads.
        FitError: If a load has a mass below zero.
    """
    campaign = Campaign.of(runs)
    for run in campaign.runs:
        if (weigher := weighing_sensor(run.experiment).name) != run.sensor.name:
            raise ExperimentError(
                f"expected the sensor {weigher!r}, the nearest one inboard of the loads, which weighs them, got "
                f"{run.sensor.name!r}"
            )
    solution, first, links = weighed(campaign), campaign.runs[0], links_of(campaign)
    table = None if (wrist := wrist_loads(first.experiment)) is None else wrist.table
    with_mount = first.sensor.mount_is_unknown or (table is not None and table.mount is not None)
    with_tilt = table is not None and table.tilt is not None
    placed = () if table is None or solution.hypotheses else tuple(behind_flange(table.frame, solution.loads))
    alone = [RecordingLoadRow.by(name, load, links.get(load.name)) for name, load in weighed_alone(campaign)]
    moving = () if solution.hypotheses else _moving(campaign, solution, disagree=any(disagreements(alone)))
    accounts = (*solution.hypotheses, *placed, *moving)
    result = WeighedLoad(
        experiment=", ".join(campaign.experiments),
        sensor=first.sensor.name,
        serial=first.sensor.serial,
        frame=None if table is None else table.frame,
        log_format=str(first.experiment.recording.origin.get("format", "")),
        observations=len(solution.residual),
        left_out=sum(hanging_on(run).left_out(run.experiment) for run in campaign.runs if run.has(Use.CALIBRATION)),
        loads=tuple(LoadRow.of(load, links.get(load.name)) for load in solution.loads),
        sessions=solution.sessions,
        variables=solution.variables,
        drift=solution.drift,
        bias_tests=solution.bias_tests,
        mount_rad=_vector(solution) if with_mount else None,
        mount_half_width_rad=three(solution.mount_half_width) if with_mount else None,
        tilt_rad=(float(solution.tilt[0]), float(solution.tilt[1])) if with_tilt else None,
        tilt_half_width_rad=_two(solution.tilt_half_width) if with_tilt else None,
        undetermined=solution.open_directions,
        disagreeing=solution.disagreeing,
        hypotheses=accounts,
        validation=tuple(row for run in campaign.runs for row in _judged(campaign, run, solution)),
        residual_rms=solution.residual_rms,
        spanned_directions=solution.spanned,
        assumed_gravity_m_per_s2=None if wrist is None else _assumed_gravity(first.experiment, wrist),
        recordings=tuple(alone),
        disagreements=tuple(disagreements(alone)),
    )
    _require_weight(result)
    of_runs = (
        words for run in campaign.runs for words in (*overweight_loads(run), *reversed_sense(run), *load_doubts(run))
    )
    doubts = (*payload_doubts(result), *of_runs)
    return result.model_copy(update={"warnings": doubts, "no_robot_file": _no_robot_file(first, result)})


def _moving(campaign: Campaign, solution: LoadSolution, *, disagree: bool) -> tuple[HypothesisRow, ...]:
    """Recordings in which the arm moves, where all of them do, or do not agree on a load."""
    rows = {
        name: row
        for name, run in zip(campaign.recordings, campaign.runs, strict=True)
        for row in moving_without_acceleration(run, solution.loads)
    }
    if not disagree and len(rows) < len(campaign.runs):
        return ()
    of = {name: f"{name!r}: " if len(campaign.runs) > 1 else "" for name in rows}
    return tuple(row.model_copy(update={"description": f"{of[name]}{row.description}"}) for name, row in rows.items())


def _no_robot_file(run: SensorRun, weighed: WeighedLoad) -> str:
    try:
        held_load(run, weighed)
    except ExperimentError as error:
        return str(error)
    return ""


def _assumed_gravity(experiment: Experiment, wrist: WristLoads) -> float | None:
    """The size of gravity that is not measured; m/s2. Beside an orientation, gravity is what its reader made of it."""
    streams = [experiment.recording.stream(name) for name in wrist.table.motion or ()]
    turned = next((stream for stream in streams if {"orientation", "gravity"} <= set(stream.signals)), None)
    if turned is None:
        return None
    blocks = row_blocks(turned.signal("gravity").values)
    return max(float(np.linalg.norm(np.nan_to_num(rows), axis=1).max()) for (rows,) in blocks)


def _require_weight(weighed: WeighedLoad) -> None:
    """Refuse a load below zero: signs, axes or units are wrong, or nothing hangs there."""
    for load in weighed.loads:
        if load.mass_kg is None or load.mass_kg >= 0.0:
            continue
        mass = plus_minus(load.mass_kg, load.mass_half_width_95_kg, "kg")
        accounts = "; ".join(f"{row.name}: {row.description}" for row in weighed.hypotheses)
        remedy = (
            f"{accounts}; mend that, and weigh again"
            if accounts
            else (
                "check measure_direction, gravity_direction and the orientation, whose signs decide it, or whether "
                "anything is attached"
            )
        )
        raise FitError(
            f"sensor {weighed.sensor!r}, load {load.load!r}: expected a mass above 0 kg, got {mass}; {remedy}"
        )


def _vector(solution: LoadSolution) -> tuple[float, float, float]:
    x, y, z = rotation_vector(solution.mount)
    return float(x), float(y), float(z)


def _two(values: FloatArray) -> tuple[float | None, float | None]:
    x, y = map(finite_or_none, values.tolist())
    return x, y


def _judged(campaign: Campaign, run: SensorRun, solution: LoadSolution) -> Iterator[ValidationLoadRow]:
    """What the loads leave of validation intervals, about the middle of each: its bias is not known."""
    if not run.has(Use.VALIDATION) or not all(load.is_determined for load in solution.loads):
        return
    problem = problem_among(campaign, run, Use.VALIDATION)
    wrench = load_wrench(problem, solution.guess) @ solution.response.T
    left = problem.rows.wrench - wrench
    for number, label in enumerate(problem.blocks):
        mine = problem.rows.block == number
        if not mine.any():
            continue
        about = left[mine] - np.median(left[mine], axis=0)
        _, lasting, _ = means_over(instants(problem.rows)[mine], about, _LASTING_S)
        force, largest = (np.linalg.norm(one[:, :3], axis=1) for one in (about, lasting))
        weight = float(np.median(np.linalg.norm(wrench[mine, :3], axis=1)))
        yield ValidationLoadRow(
            interval=label,
            observations=int(mine.sum()),
            force_error_N=float(np.sqrt((force**2).mean())),
            moment_error_Nm=float(np.sqrt((about[:, 3:] ** 2).sum(axis=1).mean())),
            largest_force_N=float(largest.max()),
            contact=bool(largest.max() > _TOUCHED * weight),
        )
