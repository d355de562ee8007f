# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of one sensor that weigh what hangs on their robots together: a load of one name is one load."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from forcetorque.errors import ExperimentError
from forcetorque.experiment.content import Experiment
from forcetorque.loads import Load, LoadProblem, LoadSolution, together
from forcetorque.recording import Use


def weighed_together(experiments: Mapping[str, Experiment]) -> dict[str, Experiment]:
    """Let recordings weigh their loads together where one of them has a load that nobody stated.

    Two tools tell more of a matrix, and of each other, than one does.

    Args:
        experiments: Experiments with one sensor, by the names of their recordings.

    Returns:
        The same; those with loads on links share what is estimated.

    Raises:
        ExperimentError: If files say different things of a load.
    """
    hanging = {name: experiment for name, experiment in experiments.items() if experiment.link_loads is not None}
    loads = [experiment.link_loads for experiment in hanging.values() if experiment.link_loads is not None]
    if len(hanging) < 2 or all(own.are_stated for own in loads) or all(own.beside for own in loads):
        return dict(experiments)
    _loads_of(hanging)
    known: dict[str, LoadSolution] = {}
    return {
        name: experiment
        if experiment.link_loads is None
        else replace(experiment, link_loads=replace(experiment.link_loads, beside=hanging, _known=known))
        for name, experiment in experiments.items()
    }


def joined_problem(
    experiments: Mapping[str, Experiment],
    *,
    use: Use = Use.CALIBRATION,
    among: Mapping[str, Experiment] | None = None,
) -> LoadProblem:
    """Ask what recordings together tell of the loads on their robots.

    Args:
        experiments: Experiments with loads on links, by the names of their recordings.
        use: Use of the intervals; recordings without one are passed over.
        among: Recordings that number the loads, if those are more.

    Returns:
        The problem.

    Raises:
        ExperimentError: If no recording has such an interval, or files say different things of a load.
    """
    loads = _loads_of(among or experiments)
    problems: dict[str, LoadProblem] = {}
    for name, experiment in experiments.items():
        if experiment.link_loads is None or not any(one.use is use for one in experiment.recording.intervals):
            continue
        own = experiment.link_loads.problem(experiment, use=use)
        numbers = np.array([list(loads).index(load.name) for load in own.loads])
        rows = replace(own.rows, load=numbers[own.rows.load])
        problems[name] = replace(own, loads=tuple(loads.values()), rows=rows)
    if not problems:
        raise ExperimentError(
            f'{", ".join(experiments)}: expected an interval with use = "{use}", which weighs the loads, got none; '
            "state mass_kg and centre_of_mass_m"
        )
    return together(problems)


def _loads_of(experiments: Mapping[str, Experiment]) -> dict[str, Load]:
    """Loads by name, those of the first recording first."""
    loads: dict[str, tuple[Load, str]] = {}
    for name, experiment in experiments.items():
        if experiment.link_loads is None:
            continue
        for load, link in zip(experiment.link_loads.loads, experiment.link_loads.links, strict=True):
            first, on = loads.setdefault(load.name, (load, link))
            if on != link or not _alike(first, load):
                raise ExperimentError(
                    f"{name}: load {load.name!r}: expected the link, mass_kg, centre_of_mass_m and inertia_kgm2 that "
                    "another recording states of it, got others; give another tool another name, and state one alike"
                )
    return {name: load for name, (load, _) in loads.items()}


def _alike(first: Load, other: Load) -> bool:
    fields = ("mass", "centre_of_mass", "inertia", "expected", "precision")
    return all(np.array_equal(getattr(first, field), getattr(other, field)) for field in fields)
