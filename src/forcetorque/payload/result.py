# SPDX-License-Identifier: BSD-3-Clause
"""Rows of what the readings of a wrist sensor tell of its loads and biases."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Annotated, Any, Self

import numpy as np

from forcetorque.payload.identification.load_estimates import LoadEstimate, Three, three
from forcetorque.payload.identification.parameter_vector import six_of
from forcetorque.results.number_text import finite_or_none
from forcetorque.results.table import Row, Shown


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
