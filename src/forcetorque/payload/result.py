# SPDX-License-Identifier: BSD-3-Clause
"""Rows of what the readings of a wrist sensor tell of its loads and biases."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any, Literal, Self

import numpy as np

from forcetorque.payload.identification.load_estimates import (
    BiasTest,
    DisagreeingRow,
    DriftChoice,
    Hypothesis,
    LoadEstimate,
    SessionEstimate,
)
from forcetorque.payload.identification.parameters import six_of
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


class LoadRow(Row):
    """A load; half-widths are of 95 % intervals."""

    load: Annotated[str, Shown("load")]
    """Its name."""
    estimated: Annotated[bool, Shown("estimated")]
    """Whether anything of it was estimated; else it is as stated."""
    mass_kg: Annotated[float | None, Shown("mass", "kg", digits=4, error="mass_half_width_95_kg")]
    """Mass; none where it is open."""
    mass_half_width_95_kg: float | None
    """Half-width of its interval; none where it is open."""
    centre_of_mass_m: Three
    """Centre of mass in the frame of the sensor, or of the link; none where it is open."""
    centre_of_mass_half_width_95_m: Three
    """Half-widths of its intervals; none where they are open."""
    inertia_kgm2: tuple[Three, Three, Three] | None
    """About the centre of mass, along the same axes; none of a point mass."""
    inertia_half_width_95_kgm2: tuple[Three, Three, Three] | None
    """Half-widths of its intervals; none of a point mass."""
    link: str | None = None
    """Link of the robot that it hangs on; none on a wrist sensor."""
    inertial: tuple[float, ...] | None = None
    """On a link: mass, first moment, and inertia xx, yy, zz, xy, xz, yz about the origin of the link's frame; kg, kg m,
    kg m2; none where any of it is open."""
    covariance: tuple[tuple[float, ...], ...] | None = None
    """Of these ten, one standard error squared; none where they are."""

    @classmethod
    def of(cls, load: LoadEstimate, link: str | None = None) -> Self:
        """Tell an estimate.

        Args:
            load: The estimate.
            link: Link of the robot that it hangs on; none on a wrist sensor.

        Returns:
            Its row.
        """
        point = not load.inertia.any()
        return cls(
            load=load.name,
            estimated=load.estimated,
            mass_kg=finite_or_none(load.mass),
            mass_half_width_95_kg=finite_or_none(load.mass_half_width),
            centre_of_mass_m=three(load.centre_of_mass),
            centre_of_mass_half_width_95_m=three(load.centre_of_mass_half_width),
            inertia_kgm2=None if point else _matrix(load.inertia),
            inertia_half_width_95_kgm2=None if point else _matrix(load.inertia_half_width),
            link=link,
            **({} if link is None or not np.isfinite(load.covariance).all() else _inertial(load)),
        )


def _inertial(load: LoadEstimate) -> dict[str, Any]:
    about_origin = load.as_inertia()
    values = np.concatenate([[about_origin.mass], about_origin.first_moment, six_of(about_origin.second_moment)])
    covariance = 0.5 * (load.covariance + load.covariance.T)
    return {"inertial": tuple(values.tolist()), "covariance": tuple(map(tuple, covariance.tolist()))}


def _matrix(values: Iterable[Iterable[float]]) -> tuple[Three, Three, Three]:
    first, second, third = (three(row) for row in values)
    return first, second, third


class BiasRow(Row):
    """What the sensor reads without load in one session, from switching it on to switching it off."""

    session: Annotated[str, Shown("session")]
    """Name of the session."""
    rows: Annotated[int, Shown("rows")]
    """Number of means or poses in it."""
    at_s: Annotated[float | None, Shown("at", "s", digits=0)]
    """Instant of the bias; s from the earliest stamp."""
    bias: Annotated[Six, ShownWrench(digits=4)]
    """Bias; N, N m."""
    bias_half_width_95: Six
    """Half-widths of its 95 % intervals; N, N m."""
    drift_per_s: Six | None
    """Change of the bias; N/s, N m/s; none where it is constant."""
    drift_half_width_95_per_s: Six | None
    """Half-widths of its 95 % intervals; N/s, N m/s."""

    @classmethod
    def of(cls, session: SessionEstimate) -> Self:
        """Tell an estimate.

        Args:
            session: The estimate.

        Returns:
            Its row.
        """
        return cls(
            session=session.name,
            rows=session.rows,
            at_s=finite_or_none(session.at_s),
            bias=six(session.bias),
            bias_half_width_95=six(session.bias_half_width),
            drift_per_s=None if session.drift is None else six(session.drift),
            drift_half_width_95_per_s=None if session.drift_half_width is None else six(session.drift_half_width),
        )


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

    @classmethod
    def of(cls, choice: DriftChoice) -> Self:
        """Tell a choice.

        Args:
            choice: The choice.

        Returns:
            Its row.
        """
        return cls(
            taken=choice.taken,
            chosen=choice.chosen,
            error_without=finite_or_none(choice.error_without),
            error_with=finite_or_none(choice.error_with),
            plain_mass_without_kg=tuple(finite_or_none(mass) for mass in choice.mass_without),
            plain_mass_with_kg=tuple(finite_or_none(mass) for mass in choice.mass_with),
        )


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

    @classmethod
    def of_test(cls, test: BiasTest) -> Self:
        """Tell a test.

        Args:
            test: The test.

        Returns:
            Its row.
        """
        return cls(
            of=test.of,
            p_value=finite_or_none(test.p_value),
            largest_difference=six(test.largest_difference),
            plain_mass_with_one_bias_kg=tuple(finite_or_none(mass) for mass in test.mass_with_one),
        )


class RowThatDisagrees(Row):
    """A row that disagrees with all others, and was weighed down."""

    row: Annotated[str, Shown("row")]
    """Where it is from."""
    weight: Annotated[float, Shown("weight", digits=3)]
    """What it counts, from 0 to 1."""
    residual: Annotated[WrenchValues, ShownWrench(digits=3)]
    """Reading less what is expected; N, N m."""

    @classmethod
    def of(cls, row: DisagreeingRow) -> Self:
        """Tell a row.

        Args:
            row: The row.

        Returns:
            Its row.
        """
        return cls(row=row.name, weight=row.weight, residual=row.residual)


class RecordingLoadRow(LoadRow):
    """What one of several recordings says of a load by itself."""

    recording: Annotated[str, Shown("recording")]
    """Name of the recording."""

    @classmethod
    def by(cls, recording: str, load: LoadEstimate, link: str | None = None) -> Self:
        """Tell an estimate.

        Args:
            recording: Name of the recording.
            load: The estimate.
            link: Link of the robot that it hangs on; none on a wrist sensor.

        Returns:
            Its row.
        """
        return cls(recording=recording, **dict(LoadRow.of(load, link)))


class HypothesisRow(Row):
    """Another account of the rows that explains them better."""

    name: str
    """Such as `swapped columns`."""
    words: str
    """What is to be changed."""
    residual_share: float
    """What it leaves of the residual of the file as it is; 1 where it is told by sizes alone."""
    severity: Literal["contradiction", "caution"]
    """`caution` where it changes a load little, such as a bias that steps or a reading that comes late."""

    @classmethod
    def of(cls, hypothesis: Hypothesis) -> Self:
        """Tell a hypothesis.

        Args:
            hypothesis: The hypothesis.

        Returns:
            Its row.
        """
        return cls(
            name=hypothesis.name,
            words=hypothesis.words,
            residual_share=hypothesis.residual_share,
            severity=hypothesis.severity,
        )


class JudgedLoadRow(Row):
    """An interval that was not fitted, held against the loads that were."""

    interval: Annotated[str, Shown("interval")]
    """Its label."""
    rows: Annotated[int, Shown("rows")]
    """Number of means or poses in it."""
    force_error_N: Annotated[float, Shown("force", "N", digits=3)]
    """Root mean square of what the loads leave of the force about its middle."""
    moment_error_Nm: Annotated[float, Shown("moment", "N m", digits=4)]
    """The same of the moment."""
    largest_force_N: Annotated[float, Shown("largest", "N", digits=2)]
    """Largest of what the loads leave of the force about its middle, in means over a quarter of a second."""
    touched: Annotated[bool, Shown("touched")]
    """Whether that is over a fifth of the weight of the load: something else than the load pulls (a heuristic)."""
