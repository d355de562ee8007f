# SPDX-License-Identifier: BSD-3-Clause
"""Windows in which something touched a part that nothing should have touched: they disagree with all others."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.calibration.disagreement import FEWEST, disagreeing, minority, with_neighbours
from forcetorque.calibration.joint.fit import JointFit
from forcetorque.calibration.joint.windows import UNITS, WINDOW_S, PartWindows
from forcetorque.experiment.calibration.assumptions import LOADS

_NEIGHBOURS = 2
"""Windows to either side that leave with it: a touch begins and ends gently."""
_LEAST = 1e-3
"""Smallest scale of a residual, in `UNITS`: below that it is rounding."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Touch:
    """A span of time in which a part was touched, or in which its equation does not hold for another reason."""

    part: str
    """Name of the part."""
    label: str
    """Label of the interval."""
    start_s: float
    """Start; s on the clock of the recording."""
    end_s: float
    """End; s."""


def residuals(windows: PartWindows, fit: JointFit | None) -> FloatArray:
    """Give what is left of the equations of a part.

    Args:
        windows: Its windows.
        fit: The fit; None for the prior matrices, with the offsets that suit these windows best.

    Returns:
        Left side less right side; shape (w, 6); in `UNITS`.
    """
    if fit is None:
        return residuals_by(windows, {name: np.eye(LOADS) for name in windows.sensors}, None)
    unknowns = fit.mean[fit.places.of_part(windows.sensors, windows.stretch.session, windows.terms)]
    return np.concatenate([block.columns @ unknowns - block.right for block in windows.blocks()])


def residuals_by(
    windows: PartWindows, factors: Mapping[str, FloatArray], offsets: Mapping[str, FloatArray] | None
) -> FloatArray:
    """Give what is left of the equations of a part by given calibrations, of a model that is taken for exact.

    Args:
        windows: Its windows.
        factors: What wrenches by the prior matrix of a sensor are to be multiplied by; shape (6, 6); N, N m.
        offsets: What is to be added to them; shape (6,); N, N m; None for what suits these windows best.

    Returns:
        Left side less right side; shape (w, 6); in `UNITS`.
    """
    changes = [(factors[name] * (UNITS / UNITS[:, None]) - np.eye(LOADS)).ravel() for name in windows.sensors]
    left = np.concatenate([block.changes @ np.concatenate(changes) - block.right for block in windows.blocks()])
    of_offsets = windows.offsets
    if offsets is None:
        columns = of_offsets.reshape(-1, of_offsets.shape[2])
        added = -np.linalg.lstsq(columns, left.ravel(), rcond=None)[0]
    else:
        added = np.concatenate([offsets[name] / UNITS for name in windows.sensors])
    return np.asarray(left + of_offsets @ added)


def untouched(windows: PartWindows, fit: JointFit | None) -> BoolArray:
    """Tell which windows agree with the others.

    Args:
        windows: Windows of a part.
        fit: As of `residuals`.

    Returns:
        Marks; shape (w,).
    """
    if len(windows) < FEWEST:
        return np.ones(len(windows), dtype=bool)
    far = disagreeing(residuals(windows, fit)[:, windows.rows > 0.0], _LEAST)
    return ~minority(with_neighbours(far, _NEIGHBOURS))


def touches_of(windows: PartWindows, kept: BoolArray) -> list[Touch]:
    """List the spans that were left out.

    Args:
        windows: Windows of a part.
        kept: Which of them agree; shape (w,).

    Returns:
        Spans of windows that follow each other.
    """
    edges = np.flatnonzero(np.diff(np.r_[True, kept, True].astype(int)))
    half = 0.5 * WINDOW_S
    return [
        Touch(
            part=windows.part,
            label=windows.stretch.label,
            start_s=float(windows.time_s[start]) - half,
            end_s=float(windows.time_s[end - 1]) + half,
        )
        for start, end in zip(edges[::2], edges[1::2], strict=True)
    ]


def all_touches(windows: Sequence[PartWindows], kept: Sequence[BoolArray]) -> tuple[Touch, ...]:
    """List the spans that were left out of all parts.

    Args:
        windows: Windows of the parts.
        kept: Which of them agree.

    Returns:
        The spans, part by part.
    """
    return tuple(touch for one, marks in zip(windows, kept, strict=True) for touch in touches_of(one, marks))
