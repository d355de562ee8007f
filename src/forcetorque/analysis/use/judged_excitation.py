# SPDX-License-Identifier: BSD-3-Clause
"""How much the loads moved while a sensor was judged: an error that was measured at rest says nothing of the matrix.

An offset takes up whatever a wrong matrix makes of a load that stands still. What is left is its relative error times
the movement of the load: of a matrix that is wrong altogether, such as that of a sensor turned by 90 degrees, about as
much as the load moved. Where that is below a twentieth of the loads that the sensor bears, it would pass for a good
one.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from forcetorque.arrays import FloatArray
from forcetorque.calibration import Calibration
from forcetorque.evaluation import autocorrelation
from forcetorque.spatial import FORCE_AND_MOMENT

HARDLY = 0.05
"""Share of the load below which it hardly moved."""


@dataclass(frozen=True, slots=True, kw_only=True)
class JudgedExcitation:
    """How much the judged loads moved, and how large loads are."""

    force: float
    """Standard deviation of the reference force, all three components together; N."""
    moment: float
    """The same of the moment; N m."""
    load_force: float
    """The larger of the root mean square judged force and the standard deviation of the fitted ones; N."""
    load_moment: float
    """The same of the moment; N m."""

    @classmethod
    def of(
        cls, reference: FloatArray, calibrations: Iterable[Calibration], *, moved: FloatArray | None = None
    ) -> JudgedExcitation:
        """Sum up judged loads.

        Args:
            reference: Expected wrenches of the judged samples; shape (n, 6); N, N m.
            calibrations: Calibrations that are judged, for the loads that they were fitted to.
            moved: The same about their means in each of several recordings; shape (n, 6); about one mean if left out.

        Returns:
            Their size and movement.
        """
        moving = np.sqrt((reference if moved is None else moved).var(axis=0))
        load = np.sqrt((reference**2).mean(axis=0))
        fitted = [calibration.validity.reference_deviation for calibration in calibrations]
        force, moment = (
            (float(np.linalg.norm(moving[part])), max(float(np.linalg.norm(one[part])) for one in (load, *fitted)))
            for part in FORCE_AND_MOMENT
        )
        return cls(force=force[0], moment=moment[0], load_force=force[1], load_moment=moment[1])

    @property
    def words(self) -> str | None:
        """That the loads hardly moved, in words; None where they moved."""
        return still_words(self.force, self.load_force, self.moment, self.load_moment)


def still_words(force: float, load_force: float, moment: float, load_moment: float) -> str | None:
    """Say that loads hardly moved while errors were measured.

    Args:
        force: Standard deviation of the force; N.
        load_force: Size of the force; N.
        moment: Standard deviation of the moment; N m.
        load_moment: Size of the moment; N m.

    Returns:
        Words; None where both moved.
    """
    kinds = {"forces": (force, load_force, "N"), "moments": (moment, load_moment, "N m")}
    still = {kind: sizes for kind, sizes in kinds.items() if hardly_moved(sizes[0], sizes[1])}
    if not still:
        return None
    of = ", ".join(f"{moved:.2g} {unit} of {load:.2g} {unit}" for moved, load, unit in still.values())
    what = "loads" if len(still) == len(kinds) else next(iter(still))
    wrong = "a wrong matrix" if what == "loads" else f"a matrix that is wrong for {what}"
    return f"the {what} hardly moved in the judged samples ({of}): {wrong} would show nothing"


def hardly_moved(moved: float, load: float) -> bool:
    """Tell whether a load moved so little that a wrong matrix would show nothing.

    Args:
        moved: Standard deviation of the load.
        load: Size of loads, in the same unit.

    Returns:
        Whether it did.
    """
    return moved <= HARDLY * load


def fewest_independent(error: FloatArray, time_s: FloatArray) -> float | None:
    """Count the independent samples that errors are worth, of the component that is worth the fewest.

    Args:
        error: Errors in the order of time; shape (n, 6); N, N m; NaN in gaps.
        time_s: Instants of the samples, not falling; shape (n,); s.

    Returns:
        The number; None where no component changes.
    """
    counts = [autocorrelation(component, time_s).effective_count for component in error.T]
    return min((count for count in counts if np.isfinite(count)), default=None)
