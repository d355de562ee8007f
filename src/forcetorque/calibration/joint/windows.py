# SPDX-License-Identifier: BSD-3-Clause
"""Equations of parts as means over windows, linear in what is unknown of the sensors and of the model.

    sum over sensors of X (D y + o + S v) + J nu = demand - sum of X y     calibrated wrench = (1 + D) y + o + S v

Equations are averaged, not signals: a mean of equations is an equation, whatever moves meanwhile. Readings carry noise,
which stands in their own coefficients; what it adds to the products of these is kept beside them.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import chain, islice
from typing import Any, Final, Self

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.rows_on_disk import RowsOnDisk, forget_pages, rows_where
from forcetorque.calibration.joint.model_error_columns import model_error_columns, weight_error_columns
from forcetorque.calibration.joint.unknowns import CHANGES, UNITS, JointFit
from forcetorque.calibration.joint.window_nodes import NODES, WEIGHTS, Stretch, WindowNodes
from forcetorque.experiment.calibration.expected_sensor_errors import LOADS
from forcetorque.experiment.calibration.robot_model_error import DELAY, ZERO, ErrorTerm
from forcetorque.robot.mechanics.sub_model_equations import PartEquation, part_equations, weight_equations
from forcetorque.robot.sub_models import SubModel

WINDOW_S: Final = 0.25
"""Length of a window; s."""
PIECE_S: Final = 500 * WINDOW_S
"""Length of what is worked on at a time; s: samples take more room than what is kept of them."""
STILL_RAD_S: Final = 0.1
"""Speed of joints and root below which a robot is at rest; rad/s."""
_BLOCK = 500
"""Windows whose coefficients are written out at a time."""
_UNUSUAL = 5.0
"""Times the median of what an equation is left with in a piece, beyond which it holds no more."""
_MIDDLE = 1.25
"""Times the median of these medians that one counts for at most: that of a part in touch all along is larger."""
_SINGULAR = 1e-9
"""Added to the products of equations, which depend on each other where nothing touches the robot at all."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartWindows:
    """Means of the equation of one part over w windows of a stretch; rows in `UNITS`."""

    part: str
    """Name of the part."""
    stretch: Stretch
    """Where they come from."""
    sensors: tuple[str, ...]
    """The k sensors of the part."""
    terms: tuple[str, ...]
    """Names of the errors of the model that the part depends on."""
    slopes: tuple[tuple[str, str], ...]
    """Sensor and name of the m linear variables of its sensors."""
    time_s: FloatArray
    """Mean instants; shape (w,); s."""
    counts: IntArray
    """Samples of every window; shape (w,)."""
    transmission: FloatArray
    """What carries a reading to the left side, at the nodes of every window; shape (w, 3, k, 6, 6)."""
    readings: FloatArray
    """Wrenches by the prior matrices at the nodes; shape (w, 3, k, 6)."""
    expected: FloatArray
    """Readings of wrenches that are nearest to those of the fit that is known and make the equation hold; shape
    (w, 3, k, 6)."""
    variables: FloatArray
    """Variables less their reference values, at the nodes; shape (w, 3, m)."""
    errors: FloatArray
    """Coefficients of the errors of the model; shape (w, 6, terms)."""
    right: FloatArray
    """Right side; shape (w, 6)."""
    rows: FloatArray
    """1 for a row that the equation has, 0 for one that is left out; shape (6,)."""
    mass_kg: float
    """Mass of the bodies of the part."""

    def __len__(self) -> int:
        return len(self.time_s)

    @property
    def changes(self) -> FloatArray:
        """Coefficients of D, row by row, of every sensor; shape (w, 6, 36 k)."""
        return self._products(self.readings)

    def _products(self, wrenches: FloatArray) -> FloatArray:
        products = np.einsum("wnkia,wnkb->wikab", self.transmission, WEIGHTS[:, None, None] * wrenches, optimize=True)
        return products.reshape(len(self), LOADS, CHANGES * len(self.sensors))

    @property
    def expected_changes(self) -> FloatArray:
        """The same with the expected readings in place of the measured ones; shape (w, 6, 36 k)."""
        return self._products(self.expected)

    @property
    def offsets(self) -> FloatArray:
        """Coefficients of the offsets; shape (w, 6, 6 k)."""
        means = np.einsum("n,wnkia->wika", WEIGHTS, self.transmission)
        return means.reshape(len(self), LOADS, LOADS * len(self.sensors))

    @property
    def of_slopes(self) -> FloatArray:
        """Coefficients of what a unit of every variable adds; shape (w, 6, 6 m)."""
        own = self.transmission[:, :, [self.sensors.index(sensor) for sensor, _ in self.slopes]]
        means = np.einsum("wnmia,wnm->wima", own, WEIGHTS[:, None] * self.variables)
        return means.reshape(len(self), LOADS, LOADS * len(self.slopes))

    @property
    def columns(self) -> FloatArray:
        """Coefficients of all that is unknown: changes, offsets, slopes, errors of the model; shape (w, 6, p)."""
        return np.concatenate([self.changes, self.offsets, self.of_slopes, self.errors], axis=2)

    def blocks(self) -> Iterator[PartWindows]:
        """Cut the windows into blocks, whose coefficients take little room.

        Yields:
            Windows that follow each other.
        """
        for start in range(0, len(self), _BLOCK):
            yield self.kept(slice(start, start + _BLOCK))
            forget_pages([getattr(self, name) for name in _BY_WINDOW])

    def kept(self, marks: BoolArray | slice) -> PartWindows:
        """Keep some of the windows.

        Args:
            marks: Which; shape (w,), or a range.

        Returns:
            The others left out.
        """
        arrays = [getattr(self, name) for name in _BY_WINDOW]
        kept = [values[marks] for values in arrays] if isinstance(marks, slice) else rows_where(marks, arrays)
        return replace(self, **dict(zip(_BY_WINDOW, kept, strict=True)))


_BY_WINDOW = ("time_s", "counts", "transmission", "readings", "expected", "variables", "errors", "right")


def part_windows(
    stretch: Stretch,
    parts: Sequence[SubModel],
    terms: Sequence[ErrorTerm],
    *,
    weighed: Sequence[SubModel] = (),
    about: JointFit | None = None,
    every: int = 1,
) -> Iterator[PartWindows]:
    """Average the equations of parts over windows.

    A window with a gap in anything that its part needs is left out.

    Args:
        stretch: Readings and motion.
        parts: Parts that nothing touches.
        terms: Errors of the model to allow for.
        weighed: Parts of which only the weight is asked, in windows at rest.
        about: Fit that is known already, about which the equations are made linear: what the zero of a joint does
            depends on the wrenches that go through it, and on where it is. The prior matrices and zeros if None.
        every: Which pieces of `PIECE_S` are taken: 1 for all, 2 for every second.

    Yields:
        The windows of every part, as long as there are any.
    """
    first: list[PartWindows] = []
    rows: list[dict[str, RowsOnDisk]] = []
    for piece in islice(stretch.pieces(PIECE_S), 0, None, every):
        of_parts = list(_piece_windows(piece, parts, weighed, terms, about))
        if not first:
            first = [one.kept(slice(0, 0)) for one in of_parts]
            rows = [
                {name: RowsOnDisk(getattr(one, name).shape[1:], getattr(one, name).dtype) for name in _BY_WINDOW}
                for one in first
            ]
        for one, own in zip(of_parts, rows, strict=True):
            for name, values in own.items():
                values.append(getattr(one, name))
    for one, own in zip(first, rows, strict=True):
        joined: dict[str, Any] = {name: values.mapped() for name, values in own.items()}
        yield replace(one, stretch=stretch, **joined)


def window_means(stretch: Stretch, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Average what else was logged over the windows of a stretch.

    Args:
        stretch: The stretch.
        values: What was logged at its instants; shape (n, c); NaN in gaps.

    Returns:
        Mean instants, shape (w,), s; and means, shape (w, c), NaN where a window has a gap.
    """
    times, means, start = [np.empty(0)], [np.empty((0, values.shape[1]))], 0
    for piece in stretch.pieces(PIECE_S):  # as the equations are cut, or the windows would be others
        windows = WindowNodes(piece.time_s, WINDOW_S)
        times.append(windows.time_s)
        means.append(windows.means(values[start : start + len(piece)]))
        start += len(piece)
        forget_pages([values])
    return np.concatenate(times), np.concatenate(means)


def _piece_windows(
    stretch: Stretch,
    parts: Sequence[SubModel],
    weighed: Sequence[SubModel],
    terms: Sequence[ErrorTerm],
    about: JointFit | None,
) -> Iterator[PartWindows]:
    tree, zeros = stretch.tree, {} if about is None else about.joint_zeros()
    windows = WindowNodes(stretch.time_s, WINDOW_S)
    nodes = windows.condensed(stretch)
    joints = nodes.joints.shifted(zeros)
    moving = part_equations(tree, parts, joints, nodes.root)
    equations = [*moving, *weight_equations(tree, weighed, joints, nodes.root)]
    columns: list[dict[str, FloatArray]] = [{} for _ in equations]
    if terms:
        of_parts = (model_error_columns(tree, part, joints, nodes.root) for part in parts)
        # where the bodies of what is weighed are does not matter, nor does how joints turn them
        of_weights = (weight_error_columns(tree, part, nodes.root, len(nodes)) for part in weighed)
        columns = [
            {name: windows.node_means(values) for name, values in own.items()} | _delay(stretch, one, windows, about)
            for one, own in zip(equations, chain(of_parts, of_weights), strict=True)
        ]
    of_zeros = [{name: own.pop(name) for name in list(own) if name.startswith(ZERO)} for own in columns]
    without_zeros = [_Terms.of(one, terms, own) for one, own in zip(equations, columns, strict=True)]
    wrenches = _balanced([one for one in without_zeros if one.equation.part in parts], nodes, about)
    for equation, own, demanded in zip(equations, columns, of_zeros, strict=True):
        through = np.stack([wrenches[name] for name in equation.sensors], axis=1)
        for name, values in demanded.items():
            turned = equation.turned(tree, name.removeprefix(ZERO), through)
            own[name] = windows.node_means(turned) + values
        result = _averaged(_Terms.of(equation, terms, own), windows, nodes, wrenches, about)
        result = replace(result, stretch=stretch)
        touched = equation.part not in parts
        yield result.kept(np.isin(result.time_s, windows.time_s[_at_rest(nodes)])) if touched else result


def _delay(
    stretch: Stretch, equation: PartEquation, windows: WindowNodes, about: JointFit | None
) -> dict[str, FloatArray]:
    """Means of what a unit of the delay of the readings adds to the left side, by its name; shape (w, 6)."""
    rates = [windows.rates(stretch.readings[name]) for name in equation.sensors]
    if about is not None:
        known = [(name, one) for name, one in zip(equation.sensors, rates, strict=True)]
        rates = [one @ about.change(name).T if name in about.places.sensors else one for name, one in known]
    delayed = np.einsum("nkij,nkj->ni", equation.transmission, np.stack(rates, axis=1))
    return {DELAY + stretch.recording: windows.node_means(delayed)}


def _at_rest(nodes: Stretch) -> BoolArray:
    """Windows in which the root, and every joint that is known, hardly move; shape (w,)."""
    velocities = [nodes.joints.velocity, np.broadcast_to(nodes.root.angular_velocity, (len(nodes), 3))]
    fastest = np.abs(np.concatenate(velocities, axis=1)).max(axis=1)
    return np.asarray(fastest.reshape(-1, NODES).max(axis=1) < STILL_RAD_S)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Terms:
    """An equation at n nodes, with the errors of the model that it depends on."""

    equation: PartEquation
    terms: tuple[ErrorTerm, ...]
    errors: FloatArray
    """What a unit of each adds to the left side in the mean of a window; shape (w, 6, terms); in `UNITS`."""

    @classmethod
    def of(cls, equation: PartEquation, terms: Sequence[ErrorTerm], columns: Mapping[str, FloatArray]) -> Self:
        own = tuple(term for term in terms if term.name in columns)
        windows = len(equation.demand) // NODES
        errors = np.empty((windows, LOADS, len(own)))
        for k, term in enumerate(own):
            errors[:, :, k] = columns[term.name] / UNITS
        return cls(equation=equation, terms=own, errors=errors)

    @property
    def transmission(self) -> FloatArray:
        """Of every sensor; shape (n, 6, 6 k); in `UNITS`; zeros in a row that is left out."""
        scaled = self.equation.transmission * (UNITS / UNITS[:, None]) * self.equation.rows[:, None]
        return scaled.transpose(0, 2, 1, 3).reshape(len(scaled), LOADS, -1)

    def missing(self, wrenches: Mapping[str, FloatArray], about: JointFit | None) -> FloatArray:
        """What wrenches lack of the demand of the bodies, by what is known of the model; shape (n, 6); in `UNITS`."""
        left = self.equation.demand / UNITS
        if about is not None:
            # zeros of joints stand in the equation already
            found = {term.name: 0.0 if term.name.startswith(ZERO) else value for term, value, _ in about.model_errors()}
            known = self.errors @ np.array([found[term.name] for term in self.terms])
            left = left - np.repeat(known, NODES, axis=0)
        stacked = np.concatenate([wrenches[name] / UNITS for name in self.equation.sensors], axis=1)
        return left * self.equation.rows - np.einsum("nij,nj->ni", self.transmission, stacked)


def _balanced(equations: Sequence[_Terms], nodes: Stretch, about: JointFit | None) -> dict[str, FloatArray]:
    """Wrenches of the sensors that are nearest to the measured ones and make the equations hold; shape (n, 6) each.

    Where nothing is touched beyond a sensor they are what the bodies demand, without the noise of any reading. An
    equation that is left with much more than usual in this piece, or than most are by the last fit, as in a contact,
    decides nothing of the sensors of others.

    Args:
        equations: Equations of parts that nothing touches, without the columns of zeros of joints.
        nodes: What was logged at their n nodes.
        about: As of `part_windows`.

    Returns:
        By sensor.
    """
    wrenches = {
        name: values if about is None else about.wrench(name, nodes.session, values, nodes.variables)
        for name, values in nodes.readings.items()
    }
    if not equations:
        return wrenches
    names = list(wrenches)
    transmission = np.zeros((len(nodes), len(equations), LOADS, len(names), LOADS))
    missing = np.stack([one.missing(wrenches, about) for one in equations], axis=1)
    size = np.abs(missing).max(axis=2)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        usual = np.nanmedian(size, axis=0)
        if about is not None:  # before that all are left with offsets
            usual = np.minimum(usual, _MIDDLE * np.nanmedian(usual))
    holds = size <= _UNUSUAL * usual
    for place, one in enumerate(equations):
        of_sensors, own = one.transmission, [names.index(name) for name in one.equation.sensors]
        holds[:, place] &= np.isfinite(of_sensors).all(axis=(1, 2))
        transmission[np.ix_(holds[:, place], [place], range(LOADS), own)] = of_sensors[holds[:, place]].reshape(
            -1, 1, LOADS, len(own), LOADS
        )
    missing[~holds] = 0.0
    rows = LOADS * len(equations)
    stacked = transmission.reshape(len(nodes), rows, -1)
    whole = stacked @ stacked.transpose(0, 2, 1) + _SINGULAR * np.eye(rows)
    moved = np.einsum("nij,ni->nj", stacked, np.linalg.solve(whole, missing.reshape(-1, rows, 1))[..., 0])
    moved = moved.reshape(len(nodes), len(names), LOADS) * UNITS
    return {name: values + moved[:, place] for place, (name, values) in enumerate(wrenches.items())}


def _averaged(
    terms: _Terms,
    windows: WindowNodes,
    nodes: Stretch,
    wrenches: Mapping[str, FloatArray],
    about: JointFit | None,
) -> PartWindows:
    equation, errors = terms.equation, terms.errors
    w, k = len(windows), len(equation.sensors)
    zeros = {} if about is None else about.joint_zeros()
    known = np.array([zeros.get(term.name.removeprefix(ZERO), 0.0) for term in terms.terms])
    transmission = equation.transmission * (UNITS / UNITS[:, None])
    readings = np.stack([nodes.readings[name] for name in equation.sensors], axis=1) / UNITS
    slopes = tuple(pair for pair in nodes.variables if pair[0] in equation.sensors)
    variables = np.concatenate([np.empty((len(nodes), 0)), *(nodes.variables[pair] for pair in slopes)], axis=1)
    variables = variables.reshape(w, NODES, len(slopes))
    right = equation.demand / UNITS - np.einsum("nkij,nkj->ni", transmission, readings)
    result = PartWindows(
        part=equation.part.name,
        stretch=nodes,
        sensors=equation.sensors,
        terms=tuple(term.name for term in terms.terms),
        slopes=slopes,
        time_s=windows.time_s,
        counts=windows.counts,
        transmission=transmission.reshape(w, NODES, k, LOADS, LOADS),
        readings=readings.reshape(w, NODES, k, LOADS),
        expected=_expected(terms, nodes, wrenches, about).reshape(w, NODES, k, LOADS),
        variables=variables,
        errors=errors,
        # unknown is the whole error of a zero, some of which the equation has already
        right=windows.node_means(right) + errors @ known,
        rows=equation.rows,
        mass_kg=sum(nodes.tree.bodies[k].inertia.mass for k in equation.part.bodies),
    )
    whole = [
        np.isfinite(values).reshape(w, -1).all(axis=1)
        for values in (result.right, transmission, readings, result.expected, variables, errors)
    ]
    return result.kept(np.logical_and.reduce(whole))


def _expected(terms: _Terms, nodes: Stretch, wrenches: Mapping[str, FloatArray], about: JointFit | None) -> FloatArray:
    """Readings by the prior matrices of wrenches that add up to what the bodies demand; shape (n, k, 6); in `UNITS`."""
    transmission, missing = terms.transmission, terms.missing(wrenches, about)
    # the least change of all wrenches; by a row that is left out none
    whole = transmission @ transmission.transpose(0, 2, 1) + np.diag(1.0 - terms.equation.rows)
    moved = np.einsum("nij,ni->nj", transmission, np.linalg.solve(whole, missing[..., None])[..., 0])
    balanced = [
        wrenches[name] + moved[:, LOADS * k : LOADS * (k + 1)] * UNITS for k, name in enumerate(terms.equation.sensors)
    ]
    if about is not None:
        balanced = [
            about.reading(name, nodes.session, one, nodes.variables)
            for name, one in zip(terms.equation.sensors, balanced, strict=True)
        ]
    return np.stack(balanced, axis=1) / UNITS
