# SPDX-License-Identifier: BSD-3-Clause
"""Sensors for stated loads, ranked, and what each sensing principle reads of the largest load."""

from __future__ import annotations

from collections.abc import Iterator
from enum import StrEnum
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, Values, WrenchValues, table_of
from forcetorque.sensor.catalogue import Technology


class Holds(StrEnum):
    """Whether a range holds a load."""

    HELD = "held"
    """The shares of all axes together stay below the limit: no channel saturates."""
    AXIS_BY_AXIS = "axis by axis"
    """Every axis stays below the limit, all together do not: whether a channel saturates is not known."""
    EXCEEDED = "exceeded"
    """An axis passes the limit, the range less the margin."""


class SensorRow(Row):
    """A range of a sensor under the load that uses most of it."""

    sensor: Annotated[str, Shown("sensor")]
    """Model."""
    maker: Annotated[str, Shown("maker")]
    """Company."""
    technology: Annotated[Technology | None, Shown("senses by")]
    """How it senses; null where it is not printed."""
    calibration: Annotated[int, Shown("range no.")]
    """Which of its ranges, from 1."""
    holds: Annotated[Holds, Shown("load")]
    """Whether it holds all loads."""
    load: Annotated[str, Shown("worst load")]
    """Load that uses most of the range."""
    axis_percent: Annotated[float, Shown("largest axis", "%", digits=0)]
    """Largest share of the range of an axis that a load uses."""
    combined_percent: Annotated[float, Shown("all axes", "%", digits=0)]
    """Sum of the shares of all axes under the load where it is largest."""
    error_force_N: Annotated[float | None, Shown("error", "N", digits=2)]
    """Largest force error by the stated accuracy; null where none is stated."""
    error_moment_Nm: Annotated[float | None, Shown("error", "N m", digits=3)]
    """Largest moment error by the stated accuracy."""
    error_of_load_percent: Annotated[float | None, Shown("of the load", "%", digits=1)]
    """The larger of force error over the largest force of all loads and moment error over the largest moment; of a
    negligible part, a moment below that of the force at 1 mm or a force below that of the moment at 1 m, over the
    range."""
    resolution_force_N: Annotated[float | None, Shown("step", "N", digits=3)]
    """Coarsest step of a force; null where none is stated."""
    resolution_moment_Nm: Annotated[float | None, Shown("step", "N m", digits=4)]
    """Coarsest step of a moment."""
    bandwidth_hz: Annotated[float | None, Shown("bandwidth", "Hz", digits=0)]
    """Largest bandwidth; null where none is stated."""
    mass_kg: Annotated[float | None, Shown("mass", "kg", digits=3)]
    """Mass; null where none is stated."""
    nonlinearity: Annotated[str | None, Shown("nonlinearity")]
    """As printed; not part of the error."""
    has_sign: Annotated[bool, Shown("range has sign")]
    """Whether the range is printed for both directions."""
    source: Annotated[tuple[str, ...], Shown("source")]
    """Where its figures are from."""

    @property
    def name(self) -> str:
        """The sensor, with the number of its range beyond the first."""
        return self.sensor + (f", range {self.calibration}" if self.calibration > 1 else "")


class PrincipleRow(Row):
    """A sensing principle as six channels of one elastic element."""

    principle: Annotated[str, Shown("principle")]
    """Principle."""
    noise_N: Annotated[float | None, Shown("noise at least", "N", digits=4)]
    """Largest standard deviation of a force of one sample by what the model has, a lower bound; null where it has
    nothing."""
    noise_Nm: Annotated[float | None, Shown("noise at least", "N m", digits=5)]
    """Largest standard deviation of a moment."""
    nonlinearity_percent: Annotated[float | None, Shown("nonlinear", "%", digits=3)]
    """Error of a linear reading under the load, as a share of it: the larger of force and moment, without a negligible
    part; null where the load leaves what the principle can sense: a gap closes, a converter saturates."""
    temperature_force_N_per_degC: Annotated[float | None, Shown("zero drift", "N/degC", digits=2)]
    """Size of the force that warming of all channels by one degree is read as; null where the model has none."""
    temperature_moment_Nm_per_degC: Annotated[float | None, Shown("zero drift", "N m/degC", digits=3)]
    """Size of the moment."""
    gain_percent_per_degC: Annotated[float | None, Shown("gain drift", "%/degC", digits=3)]
    """Change of the reading of the load per degree, as a share of the load; null where the model has none."""
    lost_percent_per_minute: Annotated[float, Shown("lost in a minute", "%", digits=1)]
    """Share of a constant load that is no longer read after a minute."""
    from_hz: Annotated[float, Shown("from", "Hz", digits=4)]
    """Frequency below which less than 1 / sqrt(2) of a load is read."""
    to_hz: Annotated[float, Shown("resonance", "Hz", digits=0)]
    """Lowest resonance of the element with a mass on it, the same for all principles."""
    noise_by: Annotated[str, Shown("noise by")]
    """What the noise consists of, or why there is none."""
    temperature_by: Annotated[str, Shown("drift by")]
    """What the temperature acts on, or why there is no figure."""


class PrincipleCurve(Row):
    """What a principle reads of a load that begins, while it warms, for the figure."""

    principle: str
    """Principle."""
    time_s: Values
    """Instants; shape (n,); s."""
    share: Values
    """Reading over the load, along the load; shape (n,)."""


_SHOWN = 5
"""Sensors that the answer names."""
_RANKED = "smallest stated error over load first, then narrowest range; the maker states the error, it is not measured"


class SensorChoice(DrawnResult):
    """Sensors for stated loads."""

    drawn_by: ClassVar[str] = "forcetorque.sensor.figures:choice_figure"

    schema_name: Literal["forcetorque/sensor/1"] = Field(default="forcetorque/sensor/1", alias="schema")
    """Form of the result."""
    loads: tuple[str, ...]
    """Names of the loads."""
    largest: str
    """Load that the principles are compared under: that which uses most of the ranges."""
    largest_wrench: WrenchValues
    """It in the sensor's frame; N, N m."""
    margin: float
    """Share of every range that is kept free."""
    sensors: tuple[SensorRow, ...]
    """Ranges of the catalogue, the best first."""
    without_range: tuple[str, ...]
    """Sensors whose range is not stated."""
    principles: tuple[PrincipleRow, ...]
    """Principles under the largest load."""
    curves: tuple[PrincipleCurve, ...] = Field(default=(), exclude=True, repr=False)
    """Simulated readings, for the figure."""

    def held(self, holds: Holds = Holds.HELD) -> tuple[SensorRow, ...]:
        """Give the sensors that hold the loads in one way.

        Args:
            holds: The way.

        Returns:
            Their rows, the best first.
        """
        return tuple(row for row in self.sensors if row.holds is holds)

    def answers(self) -> Iterator[Answer]:
        """Give the answer: a line for each of the best sensors.

        Yields:
            At most five sensors that hold the loads, or that hold them axis by axis; else one line.
        """
        held, by_axis = self.held(), self.held(Holds.AXIS_BY_AXIS)
        loads = self.loads[0] if len(self.loads) == 1 else f"{len(self.loads)} loads"
        counts = (
            f"{len(held)} of {len(self.sensors)} ranges hold {loads} with {100.0 * self.margin:g} % to spare, "
            f"{len(by_axis)} only axis by axis, {len(self.sensors) - len(held) - len(by_axis)} are exceeded"
        )
        shown = (held or by_axis)[:_SHOWN]
        if not shown:
            yield Answer(
                subject=loads,
                verdict="NO SENSOR HOLDS IT",
                why=(counts, f"nearest: {self.sensors[0].name}, {_used(self.sensors[0])}"),
                step="state further sensors by --catalogue, or keep less free by --margin",
                written=(self.figure_file,),
                concern=Concern.BAD,
            )
        for place, row in enumerate(shown, start=1):
            certain = row.holds is Holds.HELD
            yield Answer(
                subject=f"{place}. {row.name} ({row.maker})",
                verdict=f"{'HOLDS' if certain else 'MAY SATURATE'}, {_used(row)}, {_error(row)}",
                why=(counts, _RANKED),
                step="" if certain else "ask the maker whether the range holds for combined loads",
                written=(self.figure_file,),
                concern=Concern.NONE if certain else Concern.UNCERTAIN,
            )

    def blocks(self) -> Iterator[Table | str]:
        """Give sensors and principles.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.sensors, f"sensors, of whose range {100.0 * self.margin:g} % stay free; - where not stated")
        if self.without_range:
            yield f"no range is stated of {', '.join(self.without_range)}"
        yield table_of(self.principles, f"principles on one Y-shaped element under {self.largest}, by their models")


def _used(row: SensorRow) -> str:
    return (
        f"{row.combined_percent:.0f} % of range used"
        if row.holds is not Holds.EXCEEDED
        else (f"{row.axis_percent:.0f} % of the range of an axis")
    )


def _error(row: SensorRow) -> str:
    step = "" if row.resolution_force_N is None else f", step {amount(row.resolution_force_N, 'N')}"
    if row.error_of_load_percent is None:
        return f"no stated error{step}"
    return f"error {amount(row.error_of_load_percent, '%')} of the load{step}"
