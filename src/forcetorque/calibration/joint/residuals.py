# SPDX-License-Identifier: BSD-3-Clause
"""What is left of the equations of parts, before and after a joint fit."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.calibration.joint.contact_windows import residuals
from forcetorque.calibration.joint.windows import UNITS, PartWindows
from forcetorque.experiment.calibration.assumptions import LOADS


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartResidual:
    """What is left of the equation of one part in w windows of one stretch: sensors less what moves its bodies."""

    part: str
    """Name of the part."""
    label: str
    """Label of the interval."""
    recording: str
    """Recording that it is of."""
    session: str
    """Session that it is of."""
    root_link: str
    """Link whose motion is known."""
    sensors: tuple[str, ...]
    """The k sensors of the part."""
    time_s: FloatArray
    """Mean instants; shape (w,); s on the clock of the recording."""
    before: FloatArray
    """By the prior matrices, with the offsets that suit these windows best; shape (w, 6); N, N m."""
    after: FloatArray
    """By the fit, or by calibrations; shape (w, 6); N, N m."""
    at_sensors: FloatArray
    """What is left by the fit, carried to every sensor: by how much it reads too much if it alone is to blame; shape
    (w, k, 6); N, N m; NaN where the equation has forces only."""
    rows: FloatArray
    """1 for a row that the equation has, 0 for one that is left out; shape (6,)."""
    mass_kg: float
    """Mass of its bodies."""
    kept: BoolArray
    """Windows that were fitted: the others disagree with them; shape (w,)."""

    @classmethod
    def of(cls, windows: PartWindows, after: FloatArray, kept: BoolArray) -> PartResidual:
        """Take what is left in windows.

        Args:
            windows: Windows of a part.
            after: What is left of their equations; shape (w, 6); in `UNITS`.
            kept: Which of them were fitted; shape (w,).

        Returns:
            The same in N and N m.
        """
        count = len(windows.sensors)
        carried = np.full((len(windows), count, LOADS), np.nan)
        if windows.rows.all():
            transmission = windows.offsets.reshape(-1, LOADS, count, LOADS).transpose(0, 2, 1, 3)
            carried = np.linalg.solve(transmission, np.repeat(after[:, None, :, None], count, axis=1))[..., 0]
        stretch = windows.stretch
        return cls(
            part=windows.part,
            label=stretch.label,
            recording=stretch.recording,
            session=stretch.session,
            root_link=stretch.tree.root_link,
            sensors=windows.sensors,
            time_s=windows.time_s,
            before=residuals(windows, None) * UNITS,
            after=after * UNITS,
            at_sensors=carried * UNITS,
            rows=windows.rows,
            mass_kg=windows.mass_kg,
            kept=kept,
        )
