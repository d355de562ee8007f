# SPDX-License-Identifier: BSD-3-Clause
"""What the judged intervals say of a calibration."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from forcetorque.analysis.sensor_run import SensorRun
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.evaluation.use.evidence import Evidence, evidence


def judged_evidence(runs: Sequence[SensorRun], calibrations: Mapping[str, Calibration]) -> dict[str, Evidence]:
    """Sum up what every calibration measures on the validation intervals of all recordings.

    Args:
        runs: The sensor in every recording that has such intervals.
        calibrations: Its calibrations by name, which have not seen these intervals.

    Returns:
        Evidence by name of the calibration; none where there is no such recording.
    """
    parts: dict[str, list[tuple[FloatArray, FloatArray, FloatArray]]] = {name: [] for name in calibrations}
    for run in runs:
        judged = run.judged(calibrations)
        # the calibrations come last: a prior may have the name of one
        own = dict(judged.measured[-len(calibrations) :])
        for name in calibrations:
            parts[name].append((judged.time_s, own[name], judged.reference))
    return {name: evidence(recordings) for name, recordings in parts.items() if recordings}
