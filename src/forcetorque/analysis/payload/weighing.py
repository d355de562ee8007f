# SPDX-License-Identifier: BSD-3-Clause
"""What hangs in the recordings of a campaign, on a wrist sensor or on links of a robot, and what they tell of it."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.analysis.runs.campaign import Campaign
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.errors import ExperimentError
from forcetorque.experiment.loads.link_loads import LinkLoads
from forcetorque.experiment.loads.loads_together import joined_problem
from forcetorque.experiment.loads.wrist_load import WristLoads
from forcetorque.loads import LoadEstimate, LoadProblem, LoadSolution, solve, together
from forcetorque.recording import Use


def hanging_on(run: SensorRun) -> WristLoads | LinkLoads:
    """Give what hangs on a wrist sensor, or on the robot.

    Args:
        run: The sensor.

    Returns:
        The loads.

    Raises:
        ExperimentError: If nothing hangs on either.
    """
    hanging = run.experiment.wrist or run.experiment.link_loads
    if hanging is None:
        raise ExperimentError(
            "expected [[load]], what hangs on the sensor, got [robot] alone; add [[load]] with link, the link of the "
            "URDF that it is fastened to, or give [load] in place of [robot]"
        )
    return hanging


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
        if run.experiment.link_loads is not None
        for load, link in zip(run.experiment.link_loads.loads, run.experiment.link_loads.links, strict=True)
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
        if experiment.link_loads is not None:
            experiment = experiment.link_loads.beside.get(name, experiment)
        if experiment.wrist is not None:
            yield from ((name, load) for load in experiment.wrist.solution(experiment).loads)
        elif experiment.link_loads is not None and run.has(Use.CALIBRATION):
            yield from ((name, load) for load in experiment.link_loads.solution(experiment).loads)


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
        return joined_problem({name: run.experiment}, use=use, among=hanging.beside or None)
    return hanging.problem(run.experiment, use=use)
