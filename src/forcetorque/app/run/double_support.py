# SPDX-License-Identifier: BSD-3-Clause
"""Validation phases in which several links bear the robot, held against calibrations of its sensors.

Alone no sensor is known there; all contacts together bear the weight, also at loads that no fit has seen.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np

from forcetorque.base.noise.paired_comparison import ALIKE
from forcetorque.experiment.applicability import one_per_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibrations_under_test import PRIOR
from forcetorque.experiment.contacts import contacts_in
from forcetorque.experiment.experiment import Experiment
from forcetorque.locomotion.net_force.net_force import net_force_errors
from forcetorque.locomotion.net_force.result import Coherence, PhaseForce
from forcetorque.recording.recording import Interval, Use
from forcetorque.results.number_text import amount

_NEW = "new"
_LEAST_SHARE = 0.01
"""Share of the weight by which calibrations err more than the priors, from which on they are contradicted."""


def double_support(experiment: Experiment, calibrations: Mapping[str, Calibration]) -> str | None:
    """Compare calibrations with their priors in the double support of an experiment.

    Args:
        experiment: The experiment.
        calibrations: Calibrations of its sensors, by name of their file.

    Returns:
        What contradicts them, with the errors of both; None where nothing does, there is no such validation phase, or
        fewer than two of the sensors are calibrated.

    Raises:
        ForceTorqueError: If the net force of the contacts cannot be computed; the message says why.
    """
    phases = [one for one in experiment.recording.intervals if _is_borne_by_several(experiment, one)]
    if not phases or len(one_per_sensor(experiment, calibrations)) < 2:
        return None
    used = [one for one in experiment.recording.intervals if one.use is not Use.IGNORE]
    alone = [one for one in used if one.support is not None and not contacts_in(one, experiment.contacts)]
    recording = replace(experiment.recording, intervals=(*alone[:1], *phases))
    return contradiction(net_force_errors(replace(experiment, recording=recording), {_NEW: calibrations}, ()))


def _is_borne_by_several(experiment: Experiment, interval: Interval) -> bool:
    touching = contacts_in(interval, experiment.contacts)
    return interval.use is Use.VALIDATION and len(touching) + (interval.support is not None) > 1


def contradiction(coherence: Coherence) -> str | None:
    """Say whether phases with several contacts speak against calibrations.

    Args:
        coherence: Net forces by the priors and by the calibrations.

    Returns:
        The phases with the mean errors of the net force, where that by the calibrations is larger by more than a
        hundredth of the weight; None else.
    """
    errors: dict[str, dict[str, PhaseForce]] = {}
    for row in coherence.rows:
        if len(row.contact_links) > 1 and row.evidence:
            errors.setdefault(PRIOR if row.calibration == PRIOR else _NEW, {})[row.phase] = row
    prior, new = errors.get(PRIOR, {}), errors.get(_NEW, {})
    common = [phase for phase in new if phase in prior]
    if not common:
        return None
    before, after = (_mean_norm([rows[phase] for phase in common]) for rows in (prior, new))
    if after <= ALIKE[1] * before or after - before <= _LEAST_SHARE * coherence.weight_N:
        return None
    return (
        f"while several links bear the robot ({', '.join(map(repr, common))}), the net force errs by "
        f"{amount(after, 'N')} with the calibrations and {amount(before, 'N')} with the priors, of a weight of "
        f"{amount(coherence.weight_N, 'N')}"
    )


def _mean_norm(rows: Sequence[PhaseForce]) -> float:
    return float(np.mean([np.linalg.norm(row.force_error_N) for row in rows]))
