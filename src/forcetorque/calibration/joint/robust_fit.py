# SPDX-License-Identifier: BSD-3-Clause
"""Robust joint fit: fit, leave out windows in contact, linearise, fit again; residuals before and after."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.calibration.contact_windows import FEWEST, disagreeing, minority, with_neighbours
from forcetorque.calibration.joint.fit import fit_jointly
from forcetorque.calibration.joint.model_error_columns import delay_terms, error_terms
from forcetorque.calibration.joint.unknowns import UNITS, JointFit, SensorPrior
from forcetorque.calibration.joint.window_nodes import Stretch
from forcetorque.calibration.joint.windows import WINDOW_S, PartWindows, part_windows
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm, ModelTolerance
from forcetorque.robot.sub_models import SubModel

_NEIGHBOURS = 2
"""Windows to either side that leave with it: a touch begins and ends gently."""
_LEAST = 1e-3
"""Smallest scale of a residual, in `UNITS`: below that it is rounding."""


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
    places = fit.places.of_part(windows.sensors, windows.stretch.session, windows.slopes, windows.terms)
    unknowns = fit.mean[places]
    return np.concatenate([block.columns @ unknowns - block.right for block in windows.blocks()])


def residuals_by(
    windows: PartWindows,
    factors: Mapping[str, FloatArray],
    offsets: Mapping[str, FloatArray] | None,
    slopes: Mapping[tuple[str, str], FloatArray] | None = None,
) -> FloatArray:
    """Give what is left of the equations of a part by given calibrations, of a model that is taken for exact.

    Args:
        windows: Its windows.
        factors: What wrenches by the prior matrix of a sensor are to be multiplied by; shape (6, 6); N, N m.
        offsets: What is to be added to them; shape (6,); N, N m; None for what suits these windows best.
        slopes: What is to be added besides per unit of every variable of the windows, by sensor and variable; shape
            (6,) each; N, N m per unit; None for nothing.

    Returns:
        Left side less right side; shape (w, 6); in `UNITS`.
    """
    changes = [(factors[name] * (UNITS / UNITS[:, None]) - np.eye(LOADS)).ravel() for name in windows.sensors]
    left = np.concatenate([block.changes @ np.concatenate(changes) - block.right for block in windows.blocks()])
    if slopes:
        per_unit = np.concatenate([slopes[pair] / UNITS for pair in windows.slopes])
        left = left + np.concatenate([block.of_slopes @ per_unit for block in windows.blocks()])
    of_offsets = np.concatenate([block.offsets for block in windows.blocks()])
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
    if len(windows) < FEWEST or windows.stretch.keeps_disagreeing:
        return np.ones(len(windows), dtype=bool)
    far = disagreeing(residuals(windows, fit)[:, windows.rows > 0.0], _LEAST)
    return ~minority(with_neighbours(far, _NEIGHBOURS))


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
    """By the prior matrices and what variables are expected to add, with the offsets that suit these windows best;
    shape (w, 6); N, N m."""
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
    def of(
        cls,
        windows: PartWindows,
        after: FloatArray,
        kept: BoolArray,
        expected: Mapping[tuple[str, str], FloatArray],
    ) -> PartResidual:
        """Take what is left in windows.

        Args:
            windows: Windows of a part.
            after: What is left of their equations; shape (w, 6); in `UNITS`.
            kept: Which of them were fitted; shape (w,).
            expected: What a unit of a variable is expected to add beside the prior matrices, by sensor and variable;
                shape (6,) each; N, N m per unit; nothing of one that is not there.

        Returns:
            The same in N and N m.
        """
        prior = {name: np.eye(LOADS) for name in windows.sensors}
        slopes = {pair: expected.get(pair, np.zeros(LOADS)) for pair in windows.slopes}
        count = len(windows.sensors)
        carried = np.full((len(windows), count, LOADS), np.nan)
        start = 0
        for block in windows.blocks() if windows.rows.all() else ():
            own = slice(start, start + len(block))
            transmission = block.offsets.reshape(-1, LOADS, count, LOADS).transpose(0, 2, 1, 3)
            carried[own] = np.linalg.solve(transmission, np.repeat(after[own, None, :, None], count, axis=1))[..., 0]
            start = own.stop
        stretch = windows.stretch
        return cls(
            part=windows.part,
            label=stretch.label,
            recording=stretch.recording,
            session=stretch.session,
            root_link=stretch.tree.root_link,
            sensors=windows.sensors,
            time_s=windows.time_s,
            before=residuals_by(windows, prior, None, slopes) * UNITS,
            after=after * UNITS,
            at_sensors=carried * UNITS,
            rows=windows.rows,
            mass_kg=windows.mass_kg,
            kept=kept,
        )


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
    left_out: tuple[str, ...]
    """Parts that nothing touches, but whose joints were not logged, in words."""
    without_windows: tuple[str, ...]
    """Parts and intervals that never have all that they need at a time, in words."""


def fit_stretches(
    stretches: Sequence[UntouchedStretch],
    tolerance: ModelTolerance | None = None,
    *,
    priors: Mapping[str, SensorPrior] | None = None,
    progress: Callable[[str], None] = lambda _: None,
) -> JointResult:
    """Calibrate all sensors of a robot at once.

    Args:
        stretches: What is known, of any number of recordings of one robot.
        tolerance: How far the robot model may be off; `ModelTolerance()` if None.
        priors: How far sensors may be from their prior matrices, by name; `EVEN` for sensors that are not there.
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
    if every > 1 and not all(
        len(one) for one in windows if one.rows.all()
    ):  # a part may have readings in the other pieces alone
        windows = _windows(stretches, terms, None, every := 1)
    empty = [one for one in windows if not len(one) and one.rows.all()]
    windows = _filled(windows)
    fit = _fit(windows, _agreeing(windows, None), terms, priors, None, widened=False)
    for number in range(2, ROUNDS + 1):
        progress(f"the same about the fit, round {number} of {ROUNDS}")
        windows = _filled(_windows(stretches, terms, fit, every if number < ROUNDS else 1))
        fit = _fit(windows, _agreeing(windows, fit), terms, priors, fit, widened=number == ROUNDS)
    kept = _agreeing(windows, fit)
    expected = {
        (name, variable): mean * UNITS
        for name, prior in (priors or {}).items()
        for variable, mean in prior.expected_slopes.items()
    }
    return JointResult(
        fit=fit,
        residuals=tuple(
            PartResidual.of(one, residuals(one, fit), marks, expected) for one, marks in zip(windows, kept, strict=True)
        ),
        left_out=tuple(dict.fromkeys(words for one in stretches for words in one.left_out)),
        without_windows=tuple(_without_windows(empty)),
    )


def _without_windows(windows: Iterable[PartWindows]) -> Iterator[str]:
    for part, own in groupby(sorted(windows, key=lambda one: one.part), key=lambda one: one.part):
        first, *others = own
        names = ", ".join((*first.sensors, *dict.fromkeys(name for _, name in first.slopes)))
        more = f" and {len(others)} more intervals" if others else ""
        yield (
            f"part {part!r} is left out of {first.stretch.label!r}{more}: in no window of {WINDOW_S:g} s all that it "
            f"needs was logged, so {names} may know nothing of that session; look for gaps in these, joints and IMU"
        )


def _filled(windows: Iterable[PartWindows]) -> tuple[PartWindows, ...]:
    return tuple(one for one in windows if len(one))


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
    priors: Mapping[str, SensorPrior] | None,
    about: JointFit | None,
    *,
    widened: bool,
) -> JointFit:
    return fit_jointly(
        (one.kept(marks) for one, marks in zip(windows, kept, strict=True)), terms, priors, about=about, widened=widened
    )


def _all_terms(stretches: Sequence[UntouchedStretch], tolerance: ModelTolerance) -> tuple[ErrorTerm, ...]:
    terms = (
        term for one in stretches for term in error_terms(one.stretch.tree, one.parts, tolerance, weighed=one.weighed)
    )
    delays = delay_terms([one.stretch.recording for one in stretches], tolerance)
    return (*{term.name: term for term in terms}.values(), *delays)
