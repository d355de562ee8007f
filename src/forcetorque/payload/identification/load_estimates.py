# SPDX-License-Identifier: BSD-3-Clause
"""What rows under loads tell: loads, biases, what else was asked for, intervals of all of it, and what stays open."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np

from forcetorque.base.arrays import FloatArray, read_only
from forcetorque.base.inertia import Inertia
from forcetorque.payload.identification.load_problem import INERTIAL
from forcetorque.payload.identification.parameters import Guess


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadEstimate:
    """A load, stated or estimated.

    Half-widths are of 95 % intervals: 0 for what was stated, infinite for what is open.
    """

    name: str
    """Name of the load."""
    mass: float
    """kg; NaN where it is open."""
    mass_half_width: float
    """kg."""
    first_moment: FloatArray
    """Mass times centre of mass; shape (3,); kg m; NaN where it is open."""
    centre_of_mass: FloatArray
    """In the sensor's frame; shape (3,); m; NaN where it is open."""
    centre_of_mass_half_width: FloatArray
    """Shape (3,); m."""
    inertia: FloatArray
    """About the centre of mass, along the sensor's axes; shape (3, 3); kg m2; NaN where it is open."""
    inertia_half_width: FloatArray
    """Shape (3, 3); kg m2."""
    covariance: FloatArray
    """Of mass, first moment and xx, yy, zz, xy, xz, yz of the inertia about the sensor's origin; shape (10, 10)."""
    estimated: bool
    """Whether anything of it was estimated."""

    def __post_init__(self) -> None:
        shapes: dict[str, tuple[int, ...]] = {
            "first_moment": (3,),
            "centre_of_mass": (3,),
            "centre_of_mass_half_width": (3,),
            "inertia": (3, 3),
            "inertia_half_width": (3, 3),
            "covariance": (INERTIAL, INERTIAL),
        }
        for field, shape in shapes.items():
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

    @property
    def is_determined(self) -> bool:
        """Whether mass and centre of mass have values."""
        return bool(np.isfinite(self.mass) and np.isfinite(self.first_moment).all())

    def as_inertia(self) -> Inertia:
        """Give the load as an inertia in the sensor's frame.

        Returns:
            The inertia.
        """
        return Inertia.about_centre_of_mass(
            mass=self.mass, centre_of_mass=self.centre_of_mass, second_moment=self.inertia
        )


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SessionEstimate:
    """What the sensor reads without load in one power-up."""

    name: str
    """Name of the session."""
    rows: int
    """Number of its rows."""
    bias: FloatArray
    """At the instant `at_s`; shape (6,); N, N m; NaN where it is open."""
    bias_half_width: FloatArray
    """Of its 95 % interval; shape (6,); N, N m."""
    at_s: float
    """Mean instant of its rows; s; of rows without instants the mean number of the row, from 0."""
    drift: FloatArray | None = None
    """Change of the bias; shape (6,); N/s, N m/s, of rows without instants per row; None where none was taken."""
    drift_half_width: FloatArray | None = None
    """Of its 95 % interval; shape (6,)."""

    def __post_init__(self) -> None:
        for field in ("bias", "bias_half_width", "drift", "drift_half_width"):
            if getattr(self, field) is not None:
                object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(6,)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class VariableEstimate:
    """What a variable such as the temperature adds to the reading."""

    name: str
    """Its name and unit."""
    coefficients: FloatArray
    """What a unit adds; shape (6,); N, N m per unit; NaN where it is open."""
    half_width: FloatArray
    """Of its 95 % interval; shape (6,)."""

    def __post_init__(self) -> None:
        for field in ("coefficients", "half_width"):
            object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=(6,)))


@dataclass(frozen=True, slots=True, kw_only=True)
class OpenDirection:
    """Parameters that the rows tell only together, or not at all."""

    parameters: tuple[str, ...]
    """Names of those that take part."""
    words: str
    """What is open, and what to do about it, in a sentence."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DisagreeingRow:
    """A row that disagrees with all others, and was weighed down."""

    row: int
    """Its number in the problem, from 0."""
    name: str
    """Where it is from."""
    residual: FloatArray
    """Reading less what the others expect of it; shape (6,); N, N m."""
    weight: float
    """What it counts, from 0 to 1."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Hypothesis:
    """Another account of the same rows that explains them better."""

    name: str
    """Such as `transposed rotation`."""
    words: str
    """What is to be changed, in a sentence."""
    residual_share: float
    """What it leaves of the residual of the problem as stated: root mean square over root mean square."""
    severity: Literal["contradiction", "caution"] = "contradiction"
    """`caution` where it changes a load little, such as a bias that steps or a reading that comes late."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DriftChoice:
    """Whether a drift was taken, and why."""

    taken: bool
    """Whether the bias of each session moves evenly in time."""
    error_without: float
    """Root mean square error of rows that were held out, over their noise, with a constant bias."""
    error_with: float
    """The same with a drift."""
    mass_without: tuple[float, ...]
    """Mass of each load by plain least squares, all axes alike, with a constant bias; kg."""
    mass_with: tuple[float, ...]
    """The same with a drift; kg."""
    chosen: bool
    """Whether rows that were held out chose; else the problem stated it, or there were too few rows."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class BiasTest:
    """Whether one bias would do for what has several: by Wald's test under the noise that was found."""

    of: Literal["sessions", "intervals"]
    """What was compared: the biases of sessions, or those of the intervals of one session."""
    largest_difference: FloatArray
    """Largest difference of biases, per axis; shape (6,); N, N m."""
    p_value: float
    """How often differences as large come from one bias."""
    mass_with_one: tuple[float, ...]
    """Mass of each load with one bias, by least squares under independent noise; kg."""

    def __post_init__(self) -> None:
        difference = read_only(self.largest_difference, name="largest_difference", shape=(6,))
        object.__setattr__(self, "largest_difference", difference)


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LoadSolution:
    """What the rows of a problem tell."""

    loads: tuple[LoadEstimate, ...]
    """In the order of the problem."""
    sessions: tuple[SessionEstimate, ...]
    """In the order of the problem."""
    variables: tuple[VariableEstimate, ...]
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
    open_directions: tuple[OpenDirection, ...]
    """What the rows leave open."""
    disagreeing: tuple[DisagreeingRow, ...]
    """Rows that disagree with the others."""
    drift: DriftChoice
    """Whether a drift was taken, and why."""
    bias_tests: tuple[BiasTest, ...]
    """Whether one bias would do."""
    hypotheses: tuple[Hypothesis, ...]
    """Accounts of the rows that are better than the one stated, the best first."""
    spanned: int
    """How many of the six directions of wrench the loads move: what they could tell of a matrix."""

    @property
    def residual_rms(self) -> FloatArray:
        """Root mean square residual of each component; shape (6,); N, N m."""
        return np.sqrt((self.residual**2).mean(axis=0))
