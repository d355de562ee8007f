# SPDX-License-Identifier: BSD-3-Clause
"""Criteria: one measured number, its limit, and the side of it on which it is accepted."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from pydantic import computed_field

from forcetorque.analysis.acceptance.file import Component
from forcetorque.arrays import FloatArray
from forcetorque.errors import ExperimentError
from forcetorque.result import FloatOrNull, Row
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


class Bound(StrEnum):
    """On which side of its limit a number is accepted; on the limit it is."""

    AT_MOST = "at most"
    AT_LEAST = "at least"


class Criterion(Row):
    """One number and its limit."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file, or the prior."""
    criterion: str
    """Table, key and, where there are six limits, component of the acceptance file, such as `evaluate.rmse.fx`."""
    measured: FloatOrNull
    """What was measured; infinite for the condition of a singular matrix."""
    bound: Bound
    """Side of the limit on which it is accepted; on the limit it is."""
    limit: float
    """The limit."""
    unit: str
    """Unit of both; empty for a plain number."""
    count: int | None
    """Number of samples, sensors or intervals that it is made from; None for what needs none."""
    note: str
    """Where the worst was found: interval, component or feature."""

    @computed_field  # type: ignore[prop-decorator]
    @property
    def passed(self) -> bool:
        """Whether the number is accepted."""
        return self.measured <= self.limit if self.bound is Bound.AT_MOST else self.measured >= self.limit


class RecordingCriterion(Criterion):
    """The same on one of several recordings, for people: what is accepted is what they show together."""

    recording: str
    """Name of the recording, unique in the campaign: that of the experiment, with the file where several have it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Judge:
    """Holds what was measured of one candidate of a sensor to limits."""

    sensor: str
    """Sensor."""
    serial: str
    """Its serial number."""
    candidate: str
    """The calibration file, or the prior."""

    def at_limit(
        self,
        name: str,
        measured: float | None,
        limit: float | None,
        unit: str = "",
        *,
        bound: Bound = Bound.AT_MOST,
        count: int | None = None,
        note: str = "",
    ) -> Iterator[Criterion]:
        """Make the criterion of one limit, if it is stated.

        Args:
            name: Its name.
            measured: What was measured; None if nothing was.
            limit: The limit; None if none is stated.
            unit: Unit of both.
            bound: Side on which it is accepted.
            count: Number of samples, sensors or intervals.
            note: Where the worst was found.

        Yields:
            The criterion, or nothing.

        Raises:
            ExperimentError: If the limit is stated, but nothing was measured.
        """
        if limit is None:
            return
        if measured is None or np.isnan(measured):
            raise ExperimentError(f"{name} was not measured")
        yield Criterion(
            sensor=self.sensor,
            serial=self.serial,
            candidate=self.candidate,
            criterion=name,
            measured=float(measured),
            bound=bound,
            limit=float(limit),
            unit=unit,
            count=count,
            note=note,
        )

    def at_limits(
        self,
        name: str,
        measured: FloatArray | None,
        stated: Mapping[Component, float] | None,
        *,
        bound: Bound = Bound.AT_MOST,
        count: int | None = None,
        per: str = "",
    ) -> Iterator[Criterion]:
        """Make the criteria of limits per axis, as far as they are stated.

        Args:
            name: Name without the component.
            measured: What was measured; shape (6,); N, N m.
            stated: Limits by component; None if none is stated.
            bound: Side on which they are accepted.
            count: Number of samples, sensors or intervals.
            per: What follows the unit, such as `/degC`.

        Yields:
            One criterion per stated component, in the order of the wrench.

        Raises:
            ExperimentError: If a limit is stated, but nothing was measured.
        """
        if stated is None:
            return
        if measured is None:
            raise ExperimentError(f"{name} was not measured")
        limits = {str(component): limit for component, limit in stated.items()}
        for component, unit, value in zip(WRENCH_COMPONENTS, WRENCH_UNITS, measured.tolist(), strict=True):
            limit = limits.get(component)
            yield from self.at_limit(f"{name}.{component}", value, limit, unit + per, bound=bound, count=count)
