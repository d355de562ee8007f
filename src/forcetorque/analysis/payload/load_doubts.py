# SPDX-License-Identifier: BSD-3-Clause
"""What makes loads on links of a robot doubtful: nobody weighed them, or the URDF has them already."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.arrays import FloatArray, IntArray
from forcetorque.experiment.loads.link_loads import LinkLoads, inertia_of_stated
from forcetorque.loads.unknowns import six_of
from forcetorque.recording import Use
from forcetorque.spatial import reading_sign

_BETTER = 0.7
"""Share of the residual that is left where a load is in the URDF already (heuristic)."""


def load_doubts(run: SensorRun) -> Iterator[str]:
    """Say what makes loads on links of a robot doubtful.

    Args:
        run: The sensor.

    Yields:
        A sentence where loads are weighed with the sensor's own reading, one for every load that it weighed before, and
        one for every stated load without which the readings fit better.
    """
    loads = run.experiment.link_loads
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
            f"load {names}: one tool moves three of the six directions of a wrench, and may leave moments worse than "
            "the maker's matrix; record a second one, with its centre of mass elsewhere"
        )
    yield from circular_loads(run)
    if loads.sensor is not None and run.has(Use.CALIBRATION):
        yield from _doubled(run, loads)


def circular_loads(run: SensorRun) -> Iterator[str]:
    """Name loads that the sensor itself weighed before, as if its matrix were right.

    Args:
        run: The sensor.

    Yields:
        A sentence for every load beside which nothing was stated then that would have told the scale of the matrix.
    """
    for weighed in () if run.experiment.link_loads is None else run.experiment.link_loads.weighed:
        if weighed.serial == run.sensor.serial and not weighed.beside:
            yield (
                f"load {weighed.load.name!r}: weighed before by this sensor itself ({weighed.serial}), beside nothing "
                "that was stated, so its mass has the error that the sensor has, which no calibration or verdict on it "
                "can see; weigh it on a scale, or by another sensor"
            )


def _beside(loads: LinkLoads) -> list[LinkLoads]:
    return [one.link_loads for one in loads.beside.values() if one.link_loads is not None]


def _doubled(run: SensorRun, loads: LinkLoads) -> Iterator[str]:
    """Name loads that the URDF has too: without them the readings fit better, about the means of intervals."""
    stated = [number for number, load in enumerate(loads.loads) if load.is_known and load.mass]
    if not stated:
        return
    problem = loads.problem(run.experiment)
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
