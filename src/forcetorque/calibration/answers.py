# SPDX-License-Identifier: BSD-3-Clause
"""The answer of `calibrate` in a few lines: what recordings taught of a sensor, and how to evaluate it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import FORCE_AND_MOMENT
from forcetorque.calibration.summary import InformationGain, learnt_words
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.sensor_model import measured_components
from forcetorque.results.answer import EXPERIMENT, FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import counted

_MOST_INTERVALS = 6
"""Intervals that an answer names; more are counted."""


def calibration_answer(
    calibration: Calibration,
    learnt: Sequence[InformationGain] | None,
    file: str,
    *,
    saved: bool,
    doubtful: bool,
    has_validation: bool = True,
) -> Answer:
    """Say in a few lines what was fitted, and how to evaluate it.

    Args:
        calibration: The calibration.
        learnt: What the recordings taught; None where it is not known.
        file: Its file.
        saved: Whether the file is written.
        doubtful: Whether there are warnings about it.
        has_validation: Whether the recordings have data that are not fitted.

    Returns:
        The answer.
    """
    sensor, source = calibration.sensor, calibration.provenance
    labels = [interval.label for interval in source.intervals]
    intervals = ", ".join(map(repr, labels)) if len(labels) <= _MOST_INTERVALS else counted(len(labels), "interval")
    residual = f"residual {_norms(calibration, calibration.residual_rms)} (RMS of the norm)"
    if calibration.noise_rms is not None:
        cables = " and cables" if any(error.is_of_cables for error in calibration.model_errors) else ""
        left = _norms(calibration, calibration.noise_rms)
        residual += f" against the robot model as stated, {left} with its errors{cables} as found"
    fitted = f"{source.samples} samples" if source.means is None else f"{counted(source.means, 'mean')} of 1 s"
    unknowns = 0 if calibration.posterior is None else calibration.posterior.mean.shape[1]
    if source.means is not None and source.means <= unknowns:
        residual = f"too few to leave a residual, with {unknowns} unknowns per component: record longer"
    step, command = "evaluate it on data that were not fitted", typed("evaluate", EXPERIMENT, "-c", file)
    if not has_validation:
        step = 'add an [[interval]] with use = "validation", or evaluate it on another recording that has one'
        # it divides the only one, where a prior matrix tells which times are free of contact
        is_divided = len(labels) == 1 and calibration.prior is not None
        command = typed("init", "--resume", FIRST_EXPERIMENT) if is_divided else ""
    return Answer(
        subject=f"{sensor.name} ({sensor.serial}), {file}",
        verdict=("FITTED, WITH WARNINGS" if doubtful else "FITTED") if saved else "FITTED, NOT WRITTEN YET",
        why=(f"{fitted} of {intervals}: {residual}", *((learnt_words(learnt),) if learnt else ())),
        step=step,
        command=command,
        concern=Concern.UNCERTAIN if doubtful else Concern.NONE,
    )


def _norms(calibration: Calibration, components: FloatArray) -> str:
    """Norms of force and moment, as far as they are measured."""
    measured = measured_components(calibration.matrix)
    return ", ".join(
        f"{np.linalg.norm(components[part]):.{digits}f} {unit}"
        for part, digits, unit in zip(FORCE_AND_MOMENT, (2, 3), ("N", "N m"), strict=True)
        if measured[part].any()
    )
