# SPDX-License-Identifier: BSD-3-Clause
"""What samples under loads determine: loads and biases with 95 % intervals, and what stays unobservable."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Annotated, Literal

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.inertia import Inertia
from forcetorque.payload.identification.estimation_problem import INERTIAL
from forcetorque.payload.identification.parameter_vector import Guess
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import Row, Shown, ShownWrench, WrenchValues

Three = tuple[float | None, float | None, float | None]
"""x, y, z; none where it is open."""
Six = tuple[float | None, float | None, float | None, float | None, float | None, float | None]
"""fx fy fz (N) tx ty tz (N m); none where it is open."""


def three(values: Iterable[float]) -> Three:
    """Give three numbers that JSON can hold.

    Args:
        values: Three numbers.

    Returns:
        Them; None for what is infinite or NaN.
    """
    x, y, z = (finite_or_none(value) for value in values)
    return x, y, z


def six(values: Iterable[float]) -> Six:
    """Give six numbers that JSON can hold.

    Args:
        values: Six numbers.

    Returns:
        Them; None for what is infinite or NaN.
    """
    fx, fy, fz, tx, ty, tz = (finite_or_none(value) for value in values)
    return fx, fy, fz, tx, ty, tz


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadEstimate(ArrayRecord):
    """A load, stated or estimated.

    Half-widths are of 95 % intervals: 0 for what was stated, infinite for what is open.
    """

    name: str
    """Name of the load."""
    mass: float
    """kg; NaN where it is open."""
    mass_half_width: float
    """kg."""
    first_moment: FloatArray = field(metadata=array(3))
    """Mass times centre of mass; shape (3,); kg m; NaN where it is open."""
    centre_of_mass: FloatArray = field(metadata=array(3))
    """In the sensor's frame; shape (3,); m; NaN where it is open."""
    centre_of_mass_half_width: FloatArray = field(metadata=array(3))
    """Shape (3,); m."""
    inertia: FloatArray = field(metadata=array(3, 3))
    """About the centre of mass, along the sensor's axes; shape (3, 3); kg m2; NaN where it is open."""
    inertia_half_width: FloatArray = field(metadata=array(3, 3))
    """Shape (3, 3); kg m2."""
    covariance: FloatArray = field(metadata=array(INERTIAL, INERTIAL))
    """Of mass, first moment and xx, yy, zz, xy, xz, yz of the inertia about the sensor's origin; shape (10, 10)."""
    estimated: bool
    """Whether anything of it was estimated."""

    @property
    def is_determined(self) -> bool:
        """Whether mass and centre of mass have values."""
        return bool(np.isfinite(self.mass) and np.isfinite(self.first_moment).all())

    def as_inertia(self) -> Inertia:
        """Give the load as an inertia in the sensor's frame."""
        return Inertia.about_centre_of_mass(
            mass=self.mass, centre_of_mass=self.centre_of_mass, second_moment=self.inertia
        )


class BiasRow(Row):
    """What the sensor reads without load in one session, from switching it on to switching it off."""

    session: Annotated[str, Shown("session")]
    """Name of the session."""
    observations: Annotated[int, Shown("observations")]
    """Number of means or poses in it."""
    at_s: Annotated[float | None, Shown("at", "s", digits=0)]
    """Instant of the bias; s from the earliest stamp."""
    length_s: float | None
    """Time from its first observation to its last; s."""
    bias: Annotated[Six, ShownWrench(digits=4)]
    """Bias; N, N m."""
    bias_half_width_95: Six
    """Half-widths of its 95 % intervals; N, N m."""
    drift_per_s: Six | None
    """Change of the bias; N/s, N m/s; none where it is constant."""
    drift_half_width_95_per_s: Six | None
    """Half-widths of its 95 % intervals; N/s, N m/s."""


class VariableRow(Row):
    """What a variable, such as the temperature, adds to the reading."""

    variable: Annotated[str, Shown("variable")]
    """Its name and unit."""
    coefficients: Annotated[Six, ShownWrench(digits=5)]
    """What a unit adds; N, N m per unit."""
    half_width_95: Six
    """Half-widths of their 95 % intervals."""


class DriftRow(Row):
    """Whether biases move evenly in time, and why."""

    taken: bool
    """Whether a drift was taken."""
    chosen: bool
    """Whether rows that were held out chose; else the file states it, or there were too few rows."""
    error_without: float | None
    """Root mean square error of rows that were held out, over their noise, with a constant bias."""
    error_with: float | None
    """The same with a drift."""
    plain_mass_without_kg: tuple[float | None, ...]
    """Mass of each load by plain least squares with a constant bias."""
    plain_mass_with_kg: tuple[float | None, ...]
    """The same with a drift."""


class BiasTestRow(Row):
    """Whether one bias would do."""

    of: str
    """`sessions`, each with a bias; or `intervals` of one session, which has one."""
    p_value: float | None
    """How often differences as large come from one bias; none where biases are open."""
    largest_difference: Six
    """Largest difference of biases; N, N m."""
    plain_mass_with_one_bias_kg: tuple[float | None, ...]
    """Mass of each load by plain least squares with one bias."""


class OutlierRow(Row):
    """A row that disagrees with all others, and was weighed down."""

    observation: Annotated[str, Shown("observation")]
    """Where it is from."""
    session: str
    """Name of its session."""
    weight: Annotated[float, Shown("weight", digits=3)]
    """What it counts, from 0 to 1."""
    residual: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Reading less what is expected; N, N m."""


class HypothesisRow(Row):
    """Another account of the rows that explains them better."""

    name: str
    """Such as `swapped columns`."""
    description: str
    """What is to be changed."""
    residual_share: float
    """What it leaves of the residual of the file as it is; 1 where it is told by sizes alone."""
    severity: Literal["contradiction", "caution"]
    """`caution` where it changes a load little, such as a bias that steps or a reading that comes late."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadSolution:
    """What the rows of a problem tell."""

    loads: tuple[LoadEstimate, ...]
    """In the order of the problem."""
    sessions: tuple[BiasRow, ...]
    """In the order of the problem."""
    variables: tuple[VariableRow, ...]
    """In the order of the problem."""
    mount: FloatArray
    """`sensor_R_motion`, by which the sensor is turned against the axes of the motion; shape (3, 3)."""
    mount_half_width: FloatArray
    """Of small rotations about the sensor's axes; shape (3,); rad; 0 where the mount was not asked for."""
    tilt: FloatArray
    """Rotation vector of gravity about x and y of the world; shape (2,); rad."""
    tilt_half_width: FloatArray
    """Shape (2,); rad."""
    response: FloatArray
    """What the reading says of a load; shape (6, 6); one where the matrix is exact."""
    guess: Guess
    """Values of all unknowns, for `load_wrench`; those that are open are the smallest."""
    parameters: tuple[str, ...]
    """Names of all p that were estimated."""
    covariance: FloatArray
    """Their covariance; shape (p, p); infinite where open."""
    residual: FloatArray
    """Reading less what is expected of it; shape (n, 6); N, N m."""
    weight: FloatArray
    """What every row counts, from 0 to 1; shape (n,)."""
    open_directions: tuple[str, ...]
    """What the rows leave open."""
    disagreeing: tuple[OutlierRow, ...]
    """Rows that disagree with the others."""
    drift: DriftRow
    """Whether a drift was taken, and why."""
    bias_tests: tuple[BiasTestRow, ...]
    """Whether one bias would do."""
    hypotheses: tuple[HypothesisRow, ...]
    """Accounts of the rows that are better than the one stated, the best first."""
    spanned: int
    """How many of the six directions of wrench the loads move: what they could tell of a matrix."""

    @property
    def residual_rms(self) -> FloatArray:
        """Root mean square residual of each component; shape (6,); N, N m."""
        return np.sqrt((self.residual**2).mean(axis=0))
