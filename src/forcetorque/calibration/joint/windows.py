# SPDX-License-Identifier: BSD-3-Clause
"""Equations of parts as means over windows, linear in what is unknown of the sensors and of the model.

    sum over sensors of X (D y + o) + J nu = demand - sum of X y           calibrated wrench = (1 + D) y + o

Equations are averaged, not signals: a mean of equations is an equation, whatever moves meanwhile. Readings carry noise,
which stands in their own coefficients; what it adds to the products of these is kept beside them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.calibration.joint.model_error import ZERO, ErrorTerm, body_columns, demand_columns, mass_shares
from forcetorque.calibration.joint.stretch import Stretch
from forcetorque.estimation.part_equations import PartEquation, part_equations
from forcetorque.robot import JointMotion, RootMotion
from forcetorque.robot.sub_model import SubModel

if TYPE_CHECKING:
    from forcetorque.calibration.joint.fit import JointFit

LENGTH_M: Final = 0.1
"""Moment over force that weigh alike: 0.1 N m is as much as 1 N."""
UNITS: Final = np.array([1.0, 1.0, 1.0, LENGTH_M, LENGTH_M, LENGTH_M])
"""Unit of every component; N, N m."""
WINDOW_S: Final = 0.25
"""Length of a window; s."""
_LOADS, _NODES = 6, 2
_CHANGES = 36


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PartWindows:
    """Means of the equation of one part over w windows of a stretch; rows in `UNITS`."""

    part: str
    """Name of the part."""
    stretch: Stretch
    """Where they come from."""
    sensors: tuple[str, ...]
    """The k sensors of the part."""
    time_s: FloatArray
    """Mean instants; shape (w,); s."""
    changes: FloatArray
    """Coefficients of D, row by row, of every sensor; shape (w, 6, 36 k)."""
    offsets: FloatArray
    """Coefficients of the offsets; shape (w, 6, 6 k)."""
    errors: FloatArray
    """Coefficients of the errors of the model; shape (w, 6, terms)."""
    right: FloatArray
    """Right side; shape (w, 6)."""
    spread: FloatArray
    """What white noise adds, by sensor and row: mean of X X^T over the samples; shape (w, k, 6, 6, 6)."""

    mass_shares: FloatArray
    """Of every error of the model the share of the mass of the part that it scales; shape (terms,)."""
    load_shares: FloatArray
    """Mean squares of what every sensor transmits and, last, of what the bodies demand, over their sum; (k + 1,)."""

    def __len__(self) -> int:
        return len(self.time_s)

    @property
    def columns(self) -> FloatArray:
        """Coefficients of all that is unknown: changes, offsets, errors of the model; shape (w, 6, p)."""
        return np.concatenate([self.changes, self.offsets, self.errors], axis=2)

    def kept(self, marks: BoolArray) -> PartWindows:
        """Keep some of the windows.

        Args:
            marks: Which; shape (w,).

        Returns:
            The others left out.
        """
        values = {name: getattr(self, name)[marks] for name in _BY_WINDOW}
        return replace(self, **values)


_BY_WINDOW = ("time_s", "changes", "offsets", "errors", "right", "spread")


def part_windows(
    stretch: Stretch,
    parts: Sequence[SubModel],
    terms: Sequence[ErrorTerm],
    *,
    about: JointFit | None = None,
    window_s: float = WINDOW_S,
) -> Iterator[PartWindows]:
    """Average the equations of parts over windows.

    A window with a gap in anything that its part needs is left out.

    Args:
        stretch: Readings and motion.
        parts: Parts that nothing touches.
        terms: Errors of the model to allow for.
        about: Fit that is known already, about which the equations are made linear: what the zero of a joint does
            depends on the wrenches that go through it, and on where it is. The prior matrices and zeros if None.
        window_s: Length of a window; s.

    Yields:
        The windows of every part, as long as there are any.
    """
    if not len(stretch):
        return
    tree, zeros = stretch.tree, {} if about is None else about.joint_zeros()
    joints, root = stretch.joints.shifted(zeros), stretch.root
    windows = _Windows(stretch.time_s, window_s)
    turned = [term for term in terms if term.name.startswith(ZERO)]
    nodes = windows.nodes
    of_demand = (
        demand_columns(tree, parts, _samples(joints, nodes), _root_samples(root, nodes, len(stretch)))
        if turned
        else [{} for _ in parts]
    )
    known = np.array([zeros.get(term.name.removeprefix(ZERO), 0.0) for term in terms])
    for equation, demanded in zip(part_equations(tree, parts, joints, root), of_demand, strict=True):
        logged = np.stack([stretch.readings[name] for name in equation.sensors], axis=1)
        through = (
            logged
            if about is None
            else np.stack(
                [about.wrench(name, stretch.session, stretch.readings[name]) for name in equation.sensors], axis=1
            )
        )
        columns = body_columns(tree, equation) if len(terms) > len(turned) else {}
        errors = np.zeros((len(windows), _LOADS, len(terms)))
        for k, term in enumerate(terms):
            if term.name in columns:
                errors[:, :, k] = windows.means(columns[term.name]) / UNITS
            elif term.name in demanded:
                joint = term.name.removeprefix(ZERO)
                added = windows.means(equation.turned(tree, joint, through))
                errors[:, :, k] = (added + demanded[term.name].reshape(-1, _NODES, _LOADS).mean(axis=1)) / UNITS
        shares = mass_shares(tree, equation.part, terms)
        yield _averaged(stretch, equation, windows, logged, errors, known, shares)


def _averaged(
    stretch: Stretch,
    equation: PartEquation,
    windows: _Windows,
    logged: FloatArray,
    errors: FloatArray,
    known: FloatArray,
    shares: FloatArray,
) -> PartWindows:
    w, k = len(windows), len(equation.sensors)
    transmission, readings = equation.transmission * (UNITS / UNITS[:, None]), logged / UNITS
    right = equation.demand / UNITS - np.einsum("nkij,nkj->ni", transmission, readings)
    changes = np.einsum("nkia,nkb->nikab", transmission, readings).reshape(len(stretch), -1)
    spread = np.einsum("nkia,nkib->nkiab", transmission, transmission).reshape(len(stretch), -1)
    result = PartWindows(
        part=equation.part.name,
        stretch=stretch,
        sensors=equation.sensors,
        time_s=windows.means(stretch.time_s[:, None])[:, 0],
        changes=windows.means(changes).reshape(w, _LOADS, _CHANGES * k),
        offsets=windows.means(transmission.reshape(len(stretch), -1))
        .reshape(w, k, _LOADS, _LOADS)
        .transpose(0, 2, 1, 3)
        .reshape(w, _LOADS, _LOADS * k),
        errors=errors,
        # unknown is the whole error of a zero, some of which the equation has already
        right=windows.means(right) + errors @ known,
        mass_shares=shares,
        load_shares=_shares(
            [*np.moveaxis(np.einsum("nkij,nkj->nki", transmission, readings), 1, 0), equation.demand / UNITS]
        ),
        spread=(windows.means(spread) / windows.counts[:, None]).reshape(w, k, _LOADS, _LOADS, _LOADS),
    )
    flat = [result.right, *(values.reshape(w, -1) for values in (result.changes, result.offsets, result.errors))]
    return result.kept(np.asarray(np.isfinite(np.hstack(flat)).all(axis=1)))


def _shares(loads: Sequence[FloatArray]) -> FloatArray:
    """Shares of loads in the sum of their mean squares, over samples that have all of them."""
    whole = np.isfinite(np.hstack(loads)).all(axis=1)
    squares = np.array([(load[whole] ** 2).sum() for load in loads])
    shares: FloatArray = squares / max(squares.sum(), np.finfo(float).tiny)
    return shares


class _Windows:
    """Samples that follow each other, window by window."""

    def __init__(self, time_s: FloatArray, window_s: float) -> None:
        number = np.floor((time_s - time_s[0]) / window_s + 1e-9).astype(np.int64)
        self.starts = np.flatnonzero(np.diff(number, prepend=-1))
        self.counts = np.diff(self.starts, append=len(time_s))

    def __len__(self) -> int:
        return len(self.starts)

    def means(self, values: FloatArray) -> FloatArray:
        """Means of columns (n, k) over every window; shape (w, k)."""
        means: FloatArray = np.add.reduceat(values, self.starts, axis=0) / self.counts[:, None]
        return means

    @property
    def nodes(self) -> IntArray:
        """Two samples of every window whose mean is that of a smooth signal over it (Gauss and Legendre)."""
        offset = np.rint((self.counts[:, None] - 1) * (0.5 + np.array([-0.5, 0.5]) / np.sqrt(3.0)))
        nodes: IntArray = (self.starts[:, None] + offset.astype(np.int64)).ravel()
        return nodes


def _samples(joints: JointMotion, rows: IntArray) -> JointMotion:
    return JointMotion(
        names=joints.names,
        position=joints.position[rows],
        velocity=joints.velocity[rows],
        acceleration=joints.acceleration[rows],
    )


def _root_samples(root: RootMotion, rows: IntArray, n: int) -> RootMotion:
    vectors = (root.proper_acceleration, root.angular_velocity, root.angular_acceleration)
    proper, velocity, rate = (np.broadcast_to(values, (n, 3))[rows] for values in vectors)
    return RootMotion(proper_acceleration=proper, angular_velocity=velocity, angular_acceleration=rate)
