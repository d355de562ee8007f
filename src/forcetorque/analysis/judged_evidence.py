# SPDX-License-Identifier: BSD-3-Clause
"""What the judged intervals of a campaign say of a calibration."""

from __future__ import annotations

from collections.abc import Mapping

from forcetorque.analysis.campaign import Campaign
from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.evaluation.use.evidence import Evidence, evidence
from forcetorque.recording import Use


def judged_evidence(campaign: Campaign, calibrations: Mapping[str, Calibration]) -> dict[str, Evidence]:
    """Sum up what every calibration measures on the validation intervals of all recordings.

    Args:
        campaign: The sensor.
        calibrations: Its calibrations by name, which have not seen these intervals.

    Returns:
        Evidence by name of the calibration; none where no recording has such an interval.
    """
    parts: dict[str, list[tuple[FloatArray, FloatArray, FloatArray]]] = {name: [] for name in calibrations}
    for run in campaign.runs:
        if not run.has(Use.VALIDATION):
            continue
        judged = run.judged(calibrations)
        # the calibrations come last: a prior may have the name of one
        own = dict(judged.measured[-len(calibrations) :])
        for name in calibrations:
            parts[name].append((judged.time_s, own[name], judged.reference))
    return {name: evidence(recordings) for name, recordings in parts.items() if recordings}
