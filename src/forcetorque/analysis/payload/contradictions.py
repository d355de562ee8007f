# SPDX-License-Identifier: BSD-3-Clause
"""What readings contradict of the statements by which a load was estimated."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.analysis.payload.load_doubts import circular_loads
from forcetorque.analysis.payload.sense import reversed_sense
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.loads import LoadSolution
from forcetorque.recording import Use


def reference_doubts(run: SensorRun) -> tuple[str, ...]:
    """Say why what mechanics demands of a sensor may be wrong, so that it flatters the calibration fitted to it.

    Args:
        run: The sensor.

    Returns:
        A sentence for each statement that the readings contradict, and for each load that the sensor itself weighed;
        none for a bias that steps or a reading that comes late, which change a load little.
    """
    return (*contradicted_statements(run, cautions=False), *circular_loads(run))


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
            yield f"the load was estimated, and the readings contradict the file: {hypothesis.words}"
    yield from overweight_loads(run)
    yield from reversed_sense(run)


def overweight_loads(run: SensorRun) -> Iterator[str]:
    """Name loads that were estimated and weigh more than their sensor reads: a wrong unit makes a load of any size.

    Args:
        run: The sensor.

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
    if experiment.wrist is not None:
        return None if experiment.wrist.are_stated else experiment.wrist.solution(experiment)
    hung = experiment.link_loads
    return None if hung is None or all(load.is_known for load in hung.loads) else hung.solution(experiment)
