# SPDX-License-Identifier: BSD-3-Clause
"""From stretches of recordings to all sensors: fit, leave out what was touched, make linear anew, fit again."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray
from forcetorque.calibration.joint.contact_windows import Touch, all_touches, residuals, untouched
from forcetorque.calibration.joint.fit import JointFit, fit_jointly
from forcetorque.calibration.joint.model_error import ErrorTerm, ModelTolerance, delay_terms, error_terms
from forcetorque.calibration.joint.nodes import Stretch
from forcetorque.calibration.joint.prior import ChangeSpread
from forcetorque.calibration.joint.residuals import PartResidual
from forcetorque.calibration.joint.sums import part_sums
from forcetorque.calibration.joint.windows import PartWindows, part_windows
from forcetorque.robot.sub_model import SubModel

ROUNDS: Final = 3
"""How often the equations are made linear: what the zero of a joint does depends on what goes through it."""
LINEAR_S: Final = 600.0
"""Time that the rounds before the last take, evenly out of more: it tells enough to make equations linear about."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class UntouchedStretch:
    """A stretch and the parts whose equations hold in it."""

    stretch: Stretch
    """Readings and motion."""
    parts: tuple[SubModel, ...]
    """Parts that nothing should touch and whose joints were logged."""
    weighed: tuple[SubModel, ...] = ()
    """Parts that nothing should touch, of whose joints only those between their sensors were logged."""
    left_out: tuple[str, ...] = ()
    """Parts that nothing touches either, but whose joints were not logged, in words."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class JointResult:
    """A joint fit and what was left out of it."""

    fit: JointFit
    """The fit."""
    residuals: tuple[PartResidual, ...]
    """What is left of the equation of every part in every stretch, windows that disagree too."""
    touches: tuple[Touch, ...]
    """Spans that were left out because they disagree."""
    left_out: tuple[str, ...]
    """Parts that nothing touches, but whose joints were not logged, in words."""


def fit_stretches(
    stretches: Sequence[UntouchedStretch],
    tolerance: ModelTolerance | None = None,
    *,
    spreads: Mapping[str, ChangeSpread] | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> JointResult:
    """Calibrate all sensors of a robot at once.

    Args:
        stretches: What is known, of any number of recordings of one robot.
        tolerance: How far the robot model may be off; `ModelTolerance()` if None.
        spreads: How the changes of a sensor scatter, by its name; `EVEN` for sensors that are not there.
        progress: Called with what is being done.

    Returns:
        The fit.

    Raises:
        FitError: If there are no equations.
    """
    terms = _all_terms(stretches, ModelTolerance() if tolerance is None else tolerance)
    progress(f"equations of {len(stretches)} intervals")
    duration = sum(float(np.ptp(one.stretch.time_s)) for one in stretches if len(one.stretch))
    every = max(round(duration / LINEAR_S), 1)
    windows = _windows(stretches, terms, None, every)
    fit = _fit(windows, _agreeing(windows, None), terms, spreads)
    for number in range(2, ROUNDS + 1):
        progress(f"the same about the fit, round {number} of {ROUNDS}")
        windows = _windows(stretches, terms, fit, every if number < ROUNDS else 1)
        fit = _fit(windows, _agreeing(windows, fit), terms, spreads)
    kept = _agreeing(windows, fit)
    return JointResult(
        fit=fit,
        residuals=tuple(
            PartResidual.of(one, residuals(one, fit), marks) for one, marks in zip(windows, kept, strict=True)
        ),
        touches=all_touches(windows, kept),
        left_out=tuple(dict.fromkeys(words for one in stretches for words in one.left_out)),
    )


def _windows(
    stretches: Sequence[UntouchedStretch], terms: Sequence[ErrorTerm], about: JointFit | None, every: int
) -> tuple[PartWindows, ...]:
    return tuple(
        windows
        for one in stretches
        for windows in part_windows(one.stretch, one.parts, terms, weighed=one.weighed, about=about, every=every)
    )


def _agreeing(windows: Sequence[PartWindows], fit: JointFit | None) -> list[BoolArray]:
    return [untouched(one, fit) for one in windows]


def _fit(
    windows: Sequence[PartWindows],
    kept: Sequence[BoolArray],
    terms: Sequence[ErrorTerm],
    spreads: Mapping[str, ChangeSpread] | None,
) -> JointFit:
    return fit_jointly(part_sums(one.kept(marks) for one, marks in zip(windows, kept, strict=True)), terms, spreads)


def _all_terms(stretches: Sequence[UntouchedStretch], tolerance: ModelTolerance) -> tuple[ErrorTerm, ...]:
    terms = (
        term for one in stretches for term in error_terms(one.stretch.tree, one.parts, tolerance, weighed=one.weighed)
    )
    delays = delay_terms([one.stretch.recording for one in stretches], tolerance)
    return (*{term.name: term for term in terms}.values(), *delays)
