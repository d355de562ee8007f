# SPDX-License-Identifier: BSD-3-Clause
"""Whether recordings agree: one that was made with another sensor, or another load, leaves residuals of its own."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration.generative.assumptions import FLATTENED
from forcetorque.calibration.generative.means import WindowMeans
from forcetorque.calibration.wrench_model import WrenchModel
from forcetorque.spatial import FORCE_AND_MOMENT

DISAGREEMENT = 5.0
"""Residual of one matrix for all over that of a line through the recording's own data, from which it is said."""
_FEWEST = 20
"""Means below which a line through a recording's own data says nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreement:
    """A recording that one matrix for all does not explain."""

    recording: str
    """The recording."""
    residual: FloatArray
    """Root mean square residual of force and moment with the matrix for all; shape (2,); N, N m."""
    own: FloatArray
    """The same by a line through its own data; shape (2,); N, N m."""


def disagreements(
    stretches: Sequence[WindowMeans], model: WrenchModel, accuracy: FloatArray
) -> tuple[Disagreement, ...]:
    """Compare what one matrix leaves of every recording with what a line through its own data leaves.

    Args:
        stretches: Means of the fitted intervals.
        model: The fit of all.
        accuracy: Accuracy of the reference, below which no residual counts; shape (6,); N, N m.

    Returns:
        Recordings whose residual is more than `DISAGREEMENT` times what their own data leave, the worst first; none of
        a single recording.
    """
    recordings: dict[str, list[WindowMeans]] = {}
    for stretch in stretches:
        recordings.setdefault(stretch.recording, []).append(stretch)
    if len(recordings) < 2:
        return ()
    ranked = []
    floor = np.array([np.linalg.norm(accuracy[part]) for part in FORCE_AND_MOMENT])
    for name, parts in recordings.items():
        residual, own, ratio = _compared(parts, model, floor)
        if ratio > DISAGREEMENT:
            ranked.append((ratio, Disagreement(recording=name, residual=residual, own=own)))
    return tuple(one for _, one in sorted(ranked, key=lambda pair: -pair[0]))


def _compared(
    parts: Sequence[WindowMeans], model: WrenchModel, floor: FloatArray
) -> tuple[FloatArray, FloatArray, float]:
    sessions = {part.session for part in parts}
    member = np.concatenate([np.full(len(part), sorted(sessions).index(part.session)) for part in parts])
    ones = (member[:, None] == np.arange(len(sessions))).astype(np.float64)
    raw = np.concatenate([part.raw for part in parts])
    reference = np.concatenate([part.unflattened(FLATTENED).reference for part in parts])
    variables = np.concatenate([part.variables for part in parts])
    error = reference - model.wrench(raw, variables if variables.shape[1] else None)
    left = error - ones @ np.linalg.lstsq(ones, error, rcond=None)[0]
    design = np.hstack([raw - raw.mean(axis=0), ones])
    freedom = len(raw) - design.shape[1]
    line = reference - design @ np.linalg.lstsq(design, reference, rcond=None)[0]
    residual = _sizes(left, len(raw))
    own = _sizes(line, max(freedom, 1))
    if freedom < _FEWEST:
        return residual, own, 0.0
    ratio = residual / np.maximum(own, np.maximum(floor, np.finfo(float).tiny))
    return residual, own, float(ratio.max())


def _sizes(error: FloatArray, freedom: int) -> FloatArray:
    """Root mean square of force and moment; shape (2,)."""
    return np.sqrt([(error[:, part] ** 2).sum() / freedom for part in FORCE_AND_MOMENT])
