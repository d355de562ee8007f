# SPDX-License-Identifier: BSD-3-Clause
"""Forms of curves compared on recordings that were not fitted."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import add

import numpy as np

from forcetorque.analysis.skin.fit import HeldOutErrors, held_out_errors
from forcetorque.analysis.skin.recording import PatchRecording
from forcetorque.analysis.skin.rows import CandidateRow, in_kPa, recording_name
from forcetorque.arrays import FloatArray
from forcetorque.skin.pressure_table import ROWS
from forcetorque.skin.taxels import CurveKind, TaxelCurve

ALL = "all"
"""Name of all recordings together, where squares of a taxel are pooled before they are averaged."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class CurveComparison:
    """What every form of curve is worth where it was not fitted."""

    rows: tuple[CandidateRow, ...]
    """A row for each form and recording, and for each form and all recordings."""
    pooled: Mapping[CurveKind, HeldOutErrors]
    """Errors of each form over the recordings in which a taxel is sound; empty without recordings."""
    taxels: int
    """Number of taxels."""

    def rmse(self, kind: CurveKind) -> list[list[float]]:
        """Give the errors of every taxel.

        Args:
            kind: Form of the curves.

        Returns:
            Errors at fitted pressures, and at higher ones; Pa; NaN where there is none.
        """
        errors = self.pooled.get(kind)
        nothing: FloatArray = np.full((2, self.taxels), np.nan)
        values: list[list[float]] = (nothing if errors is None else errors.rmse).tolist()
        return values

    @property
    def least_inside(self) -> str | None:
        """Form with the least error at fitted pressures; None where nothing was kept back."""
        return _least({row.curve: row.inside_kPa for row in self.rows if row.recording == ALL})

    @property
    def least_above(self) -> str | None:
        """Form with the least error at higher ones, among those that nowhere fall."""
        return _least({row.curve: row.above_kPa for row in self.rows if row.recording == ALL and not row.falling})


def compare_curves(
    curves: Mapping[CurveKind, Sequence[TaxelCurve | None]], held_out: Sequence[PatchRecording], highest: float
) -> CurveComparison:
    """Judge forms of curves on recordings that were not fitted.

    Args:
        curves: Curves of every taxel by their forms.
        held_out: The recordings.
        highest: Highest fitted pressure above rest; Pa.

    Returns:
        The comparison.
    """
    rows: list[CandidateRow] = []
    pooled = {}
    for kind, own in curves.items():
        falling = _falling(own)
        errors = [held_out_errors(own, log, highest) for log in held_out]
        sound = [error.of(log.sound) for error, log in zip(errors, held_out, strict=True)]
        for log, error, kept in zip(held_out, errors, sound, strict=True):
            rows.append(_row(kind, recording_name(log), kept, error, falling))
        if held_out:
            pooled[kind] = reduce(add, sound)
            rows.append(_row(kind, ALL, pooled[kind], reduce(add, errors), falling))
    return CurveComparison(rows=tuple(rows), pooled=pooled, taxels=len(next(iter(curves.values()))))


def _falling(curves: Sequence[TaxelCurve | None]) -> int:
    fall = np.arange(float(ROWS))
    return sum(bool(np.any(np.diff(curve.pressure(fall)) < 0.0)) for curve in curves if curve is not None)


def _row(kind: CurveKind, name: str, kept: HeldOutErrors, errors: HeldOutErrors, falling: int) -> CandidateRow:
    taxels = int(np.count_nonzero(np.isfinite(kept.rmse).any(axis=0)))
    inside, above = kept.median()
    inside_any, above_any = errors.median()
    return CandidateRow(
        curve=kind.value,
        recording=name,
        taxels=taxels,
        left_out=kept.squares.shape[1] - taxels,
        inside_kPa=in_kPa(inside),
        above_kPa=in_kPa(above),
        inside_any_kPa=in_kPa(inside_any),
        above_any_kPa=in_kPa(above_any),
        falling=falling,
    )


def _least(errors: Mapping[str, float | None]) -> str | None:
    known = {name: error for name, error in errors.items() if error is not None}
    return min(known, key=known.__getitem__) if known else None
