# SPDX-License-Identifier: BSD-3-Clause
"""All sensors of a robot in one fit, from equations of link groups without contact: the inference of one sensor.

The rows of the inference are the components of the equation of every group in every interval. Unknowns and priors are
those of a fit of one sensor, of all sensors of the group: coefficients, gains, rotation and shift of the frame, and
errors of the robot model; offsets besides.

    sum over sensors of X (D reading + offset + slopes variables) + J nu = demand - sum of X reading
    wrench = (1 + D) reading + offset + slopes variables

The reading that stands beside D is the one that the last fit expects: that of the wrenches that are nearest to the
fitted ones and add up to what the bodies of all groups demand. Beyond which nothing is touched, that is what the bodies
demand, as in the fit of one sensor. With measured readings in its place, noise in them would shrink all sensors alike,
and in directions that loads hardly move draw sensors and zeros of joints far away.

The noise of a row is white, and four windows count as one, because residuals of neighbouring windows are alike. Sizes
of changes are held at the expected ones: on a real robot misfit of its model passes for changes of the matrices, and
sizes by evidence would open directions that the motion does not determine. Evidence only widens what is predicted.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import FitError
from forcetorque.base.noise.slow_noise import CANDIDATES
from forcetorque.calibration.generative.model import Maximum, RowData, Sizes, infer, sizes_of_terms
from forcetorque.calibration.generative.whitening import Border, Whitened
from forcetorque.calibration.joint.unknowns import CHANGES, EVEN, JointFit, Places, SensorPrior
from forcetorque.calibration.joint.windows import PartWindows
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS, Scale
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm

_OFFSET: Final = Scale(expected=1e3, weight=np.inf)
"""An offset before any data, in `UNITS`: hardly anything is known of it.

Much more would cost the digits that directions need which only the prior tells, such as a joint's zero from the frame
of the sensor beside it.
"""
_SLOPE: Final = Scale(expected=1.0, weight=np.inf)
"""A slope, over what it may be."""
_WHITE: Final = CANDIDATES[0]
_REPEATS: Final = 4.0
"""Windows that count as one."""
_LEAST: Final = 0.01
"""Smallest noise of a window, in `UNITS`: below that it is rounding and what is not modelled."""
_NO_CELLS: Final = Border(
    own=np.zeros((0, 0, 0)), columns=np.zeros((0, 0)), free=np.zeros((0, 0)), response=np.zeros(0)
)


def fit_jointly(
    windows: Iterable[PartWindows],
    terms: Sequence[ErrorTerm] = (),
    priors: Mapping[str, SensorPrior] | None = None,
    *,
    about: JointFit | None = None,
    widened: bool = True,
) -> JointFit:
    """Find what is most probable.

    Args:
        windows: The equations.
        terms: Errors of the model that their coefficients allow for.
        priors: How far the sensors may be from their prior matrices, by name; `EVEN` for sensors that are not there.
        about: The fit that the windows were made with; None for the prior matrices.
        widened: Whether predicted errors are those of changes that are as large as evidence says, which takes as long
            again.

    Returns:
        The fit.

    Raises:
        FitError: If there are no equations.
    """
    used = [one for one in windows if len(one)]
    if not used:
        raise FitError("joint calibration: no window of any part has readings and motion; look for gaps in the log")
    offsets = [(name, one.stretch.session) for one in used for name in one.sensors]
    places = Places.of(offsets, terms, [pair for one in used for pair in one.slopes])
    unknowns = _Unknowns.of(places, [(priors or {}).get(name, EVEN) for name in places.sensors])
    rows = [row for one in used for row in _rows(one, unknowns, about)]
    data, sizes = [row for row, _ in rows], unknowns.sizes([own for _, own in rows])
    held = infer(data, replace(sizes, weight=np.where(unknowns.of_sensors(sizes), np.inf, sizes.weight)))
    return unknowns.fit(
        held, np.maximum(infer(data, sizes).deviations, held.deviations) if widened else held.deviations
    )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Unknowns:
    """Where the unknowns of the inference stand: those of every sensor, offsets, slopes, errors of the model."""

    places: Places
    """The same by changes of the sensors in place of their unknowns."""
    priors: Sequence[SensorPrior]
    """Of every sensor."""
    starts: IntArray
    """First unknown of every sensor, and of the offsets; shape (sensors + 1,)."""

    @classmethod
    def of(cls, places: Places, priors: Sequence[SensorPrior]) -> _Unknowns:
        return cls(places=places, priors=priors, starts=np.cumsum([0, *(prior.basis.shape[1] for prior in priors)]))

    @property
    def basis(self) -> FloatArray:
        """What the unknowns are worth at their places; shape (p, unknowns)."""
        places = self.places
        deviations = [self.priors[places.sensors.index(sensor)].slopes[name] for sensor, name in places.slopes]
        of_terms = np.array([term.deviation for term in places.terms])
        rest = np.concatenate([np.ones(LOADS * len(places.offsets)), *deviations, of_terms])
        first = self.starts[-1]
        basis = np.zeros((len(places), first + len(rest)))
        for number, (name, prior) in enumerate(zip(places.sensors, self.priors, strict=True)):
            basis[places.changes(name), self.starts[number] : self.starts[number + 1]] = prior.basis
        basis[len(places) - len(rest) :, first:] = np.diag(rest)
        return basis

    def of_part(self, windows: PartWindows) -> tuple[FloatArray, IntArray]:
        """What the coefficients of a part without those of terms are worth in its unknowns, and places of these."""
        own = self.places.of_part(windows.sensors, windows.stretch.session, windows.slopes, windows.terms)
        basis, terms = self.basis[own], len(windows.terms)
        used = np.flatnonzero(basis.any(axis=0))
        return basis[: len(own) - terms, used[: len(used) - terms]], used

    def expected(self, slopes: Iterable[tuple[str, str]]) -> FloatArray:
        """What slopes are expected to be, one after the other; in `UNITS` per unit."""
        means = (self.priors[self.places.sensors.index(sensor)].expected_slopes.get(name) for sensor, name in slopes)
        return np.concatenate([np.empty(0), *(np.zeros(LOADS) if mean is None else mean for mean in means)])

    def sizes(self, rows: Sequence[IntArray]) -> Sizes:
        """Kinds of the unknowns: of every sensor its own, offsets, slopes, and errors of the model of one kind."""
        scales: list[Scale] = []
        size: list[int] = []
        for prior in self.priors:
            size += [len(scales) + kind for kind in prior.kinds]
            scales += prior.scales
        size += [len(scales)] * (LOADS * len(self.places.offsets))
        size += [len(scales) + 1] * (LOADS * len(self.places.slopes))
        scales += [_OFFSET, _SLOPE]
        of_terms, of_kinds = sizes_of_terms(self.places.terms, len(scales))
        return Sizes.scaled([*scales, *of_kinds], np.array([*size, *of_terms]), places=rows, own=0)

    def of_sensors(self, sizes: Sizes) -> BoolArray:
        """Which sizes are those of sensors; shape (sizes,)."""
        return np.arange(len(sizes.expected)) < sum(len(prior.scales) for prior in self.priors)

    def fit(self, best: Maximum, deviations: FloatArray) -> JointFit:
        """Give what the places are of, if unknowns scatter by `deviations`, no less than taken."""
        places, basis = self.places, self.basis
        mean = basis @ best.solution.coefficients
        for pair in places.slopes:
            mean[places.slope(*pair)] += self.expected([pair])
        covariance = best.solution.covariance()
        pulled = covariance / best.deviations**2 * np.sqrt(deviations**2 - best.deviations**2)
        return JointFit(
            places=places,
            mean=mean,
            covariance=basis @ (covariance + pulled @ pulled.T) @ basis.T,
            prior_root=basis * deviations,
        )


def _rows(windows: PartWindows, unknowns: _Unknowns, about: JointFit | None) -> list[tuple[RowData, IntArray]]:
    """The rows of one part in one interval, with the places of their unknowns."""
    basis, own = unknowns.of_part(windows)
    products = _products(windows, unknowns, about)
    offsets = CHANGES * len(windows.sensors) + np.arange(LOADS * len(windows.sensors))
    return [
        (
            RowData(
                data=[_whitened(products[row], len(windows))],
                basis=basis,
                terms=np.arange(len(windows.terms)),
                accuracy=0.0,
                freedom=max(round(len(windows) / _REPEATS), 1),
                start=_unexplained(products[row], offsets),
                least=_LEAST**2,
            ),
            own,
        )
        for row in np.flatnonzero(windows.rows)
    ]


def _products(windows: PartWindows, unknowns: _Unknowns, about: JointFit | None) -> FloatArray:
    """Products of the columns of every row, the right side last, each window counted for its share of one; by block."""
    deviations = {term.name: term.deviation for term in unknowns.places.terms}
    slopes = unknowns.expected(windows.slopes)
    size = np.array([deviations[name] for name in windows.terms])
    total: FloatArray | float = 0.0
    for block in windows.blocks():
        expected, right = block.expected_changes, block.right - block.of_slopes @ slopes
        if about is not None:
            known = np.concatenate([about.mean[about.places.changes(name)] for name in windows.sensors])
            right = right - (block.changes - expected) @ known
        columns = [expected, block.offsets, block.of_slopes, block.errors * size, right[:, :, None]]
        stacked = np.concatenate(columns, axis=2)
        by_row = stacked.transpose(1, 2, 0)
        total = total + by_row @ by_row.transpose(0, 2, 1)
    return np.asarray(total, dtype=np.float64) / _REPEATS


def _unexplained(products: FloatArray, columns: IntArray) -> float:
    """Share of a response that columns do not explain."""
    total, shared = float(products[-1, -1]), products[columns, -1]
    explained = float(shared @ np.linalg.pinv(products[np.ix_(columns, columns)], hermitian=True) @ shared)
    return max(1.0 - explained / total, 0.0) if total else 1.0


def _whitened(products: FloatArray, count: int) -> Whitened:
    """Products of columns, the response last, under white noise."""
    return Whitened(
        noise=_WHITE,
        log_determinant=count * float(np.log(_REPEATS)),
        columns=products[:-1, :-1],
        shared=products[:-1, -1],
        response=float(products[-1, -1]),
        free=np.zeros((0, 0)),
        border=_NO_CELLS,
    )
