# SPDX-License-Identifier: BSD-3-Clause
"""What the judged intervals say of a calibration."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from forcetorque.analysis.runs.campaign import Campaign
from forcetorque.analysis.runs.judged import JudgedWrenches
from forcetorque.analysis.runs.sensor_run import SensorRun
from forcetorque.arrays import IntArray
from forcetorque.calibration import Calibration
from forcetorque.evaluation.use.evidence import Evidence, JudgedStretch, evidence
from forcetorque.recording import Use


def judged_evidence(campaign: Campaign, calibrations: Mapping[str, Calibration]) -> dict[str, Evidence]:
    """Sum up what every calibration measures on the validation intervals of all recordings.

    Args:
        campaign: The sensor in any number of recordings.
        calibrations: Its calibrations by name, which have not seen these intervals.

    Returns:
        Evidence by name of the calibration; none where no recording has such an interval.
    """
    stretches: dict[str, list[JudgedStretch]] = {name: [] for name in calibrations}
    for run in campaign.runs:
        if not run.has(Use.VALIDATION):
            continue
        judged = run.judged(calibrations)
        # the calibrations come last: a prior may have the name of one
        measured = dict(judged.measured[-len(calibrations) :])
        for session, samples in _sessions(campaign, run, judged).items():
            for name in calibrations:
                stretches[name].append(
                    JudgedStretch(
                        session=session,
                        time_s=judged.time_s[samples],
                        measured=measured[name][samples],
                        reference=judged.reference[samples],
                    )
                )
    return {name: evidence(parts) for name, parts in stretches.items() if parts}


def _sessions(campaign: Campaign, run: SensorRun, judged: JudgedWrenches) -> dict[str, IntArray]:
    """Samples by session, in the order of time."""
    indices: dict[str, list[IntArray]] = {}
    for label, samples in judged.intervals:
        own = np.arange(samples.start, samples.stop)
        indices.setdefault(campaign.session(run, label), []).append(own)
    return {session: np.concatenate(parts) for session, parts in indices.items()}
