# SPDX-License-Identifier: BSD-3-Clause
"""What the choices of a study make of loads that were not fitted, and when that is a warning."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.evaluation.push_error import LEVER_M, PUSH_N, PushError, push_error
from forcetorque.experiment.offset_policy import KNOWN_BEFORE
from forcetorque.study.loads_not_fitted import FAR_SD
from forcetorque.study.one_sensor import Study
from forcetorque.study.records import UnfittedLoad
from forcetorque.study.study import SensorStudy

_WORSE = 1.05
"""Error of a push over that of the workbench matrix, from which on a matrix made the sensor worse."""


def unfitted_load(study: Study, rows: Sequence[int]) -> UnfittedLoad:
    """Judge a model that takes its six rows from models of a study.

    Args:
        study: The study.
        rows: Index of the model that gives each row.

    Returns:
        What it makes of loads that were not fitted.
    """
    push = _push(study, rows)
    deviation = max(_deviations(study, rows), default=None)
    return UnfittedLoad(
        push_force_N=None if push is None else push.force_N,
        push_moment_Nm=None if push is None else push.moment_Nm,
        deviation_sd=deviation,
    )


def unfitted_warnings(sensor: SensorStudy) -> Iterator[str]:
    """Say which choices make the sensor worse, or may, at loads that were not fitted.

    Args:
        sensor: The study of one sensor.

    Yields:
        A sentence per choice and reason.
    """
    study = sensor.study
    for offset in KNOWN_BEFORE:
        choice = study.choices[offset]
        for name, rows in (
            (f"best, offset {offset}", (choice.by_magnitude,) * 6),
            (f"best by axis, offset {offset}", choice.by_axis),
        ):
            for sentence in (*_harmful(study, rows), *_far(study, rows)):
                yield f"{sensor.data.identity.name}: {name}: {sentence}"


def _harmful(study: Study, rows: Sequence[int]) -> Iterator[str]:
    push = _push(study, rows)
    before = None if study.workbench is None else study.push_error(len(study.models) - 1)
    if push is None or before is None or push.over(before) <= _WORSE:
        return
    yield (
        f"a push of {PUSH_N:g} N with a lever up to {LEVER_M:g} m errs by {_words(push)}, with the workbench matrix by "
        f"{_words(before)}: it is worse than no calibration where loads were not fitted; {_instead(study, rows)}"
    )


def _far(study: Study, rows: Sequence[int]) -> Iterator[str]:
    deviations = dict(zip(WRENCH_COMPONENTS, _deviations(study, rows), strict=False))
    beyond = [name for name, value in deviations.items() if value > FAR_SD]
    if beyond:
        yield (
            f"a push of {PUSH_N:g} N reads {max(deviations.values()):.1f} standard deviations away from what prior and "
            f"data tell together ({', '.join(beyond)}): a load that was not fitted may be read wrong; "
            f"{_instead(study, rows)}"
        )


def _instead(study: Study, rows: Sequence[int]) -> str:
    """Name the generative fit of the same data, which keeps the prior where no load speaks."""
    used = {study.candidates[index].data_set for index in rows}
    fits = {fit.data_set: k for k, fit in enumerate(study.generative, start=len(study.fits.candidates))}
    # of the data sets of several rows the largest tells the most
    samples = {c.moments.count: c.name for c in study.fits.combinations if c.name in used and c.name in fits}
    if not samples:
        return "keep the workbench matrix, or record loads along the directions that lack them"
    index = fits[samples[max(samples)]]
    push = study.push_error(index)
    errs = "" if push is None else f" and errs by {_words(push)}"
    return f"the default, {study.name(index)!r}, keeps the prior there{errs}"


def _push(study: Study, rows: Sequence[int]) -> PushError | None:
    if study.truth is None:
        return None
    matrix = np.stack([study.models[index].matrix[axis] for axis, index in enumerate(rows)])
    return push_error(matrix, study.truth)


def _deviations(study: Study, rows: Sequence[int]) -> list[float]:
    """Deviation of every row from the generative fit of its data set; nothing where one has none."""
    if max(rows) >= len(study.candidates):
        return []
    values = [float(study.push_deviations[index, axis]) for axis, index in enumerate(rows)]
    return values if np.isfinite(values).all() else []


def _words(push: PushError) -> str:
    return f"{push.force_N:.3g} N and {push.moment_Nm:.3g} N m"
