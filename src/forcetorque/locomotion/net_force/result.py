# SPDX-License-Identifier: BSD-3-Clause
"""Rows of the coherence of contact forces: net force by phase, calibration and offset, in the form of the thesis."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import ClassVar, Literal

from pydantic import Field

from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.number_text import interval, number, with_error
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import AxisValues, Row, Table, WrenchValues, short_names

NOT_EVIDENCE = "not evidence"
"""What a table says of a phase that gave the offset, or the matrix."""
_NAMES = "xyz"
ThreeOrNull = tuple[float | None, float | None, float | None]
"""x, y, z; null where there is none."""


class PhaseForce(Row):
    """Net contact force over one phase, as read by one candidate with one offset; z up, x the support's, level."""

    phase: str
    """Label of the interval."""
    contact_links: tuple[str, ...]
    """Links that touch the world in it."""
    calibration: str
    """What reads the sensors: `prior`, or the name of the calibrations."""
    offset: Offset
    """Where the offset is from."""
    offset_interval: str | None
    """Interval that gave it; null where none did."""
    samples: int
    """Samples without a gap."""
    force_N: AxisValues
    """Mean of the forces of all contacts together."""
    force_error_N: AxisValues
    """The same less the weight, which points down and is borne upwards."""
    force_half_width_95_N: ThreeOrNull
    """Half-width of its 95 % interval, of noise in phase and offset; null along an axis where the error of the phase is
    no stationary noise (`noise.is_stationary`), or the offset has no interval."""
    force_deviation_N: ThreeOrNull
    """Standard deviation of the error from sample to sample."""
    force_smallest_N: AxisValues
    """Smallest error of a sample, with its sign."""
    force_largest_N: AxisValues
    """Largest error of a sample, with its sign."""
    moment_error_Nm: AxisValues | None
    """Mean moment of all contacts together, less that which mechanics demands, about the point of the support's level
    that is below the centre of mass; null where a joint or the offset of a moment is not known."""
    moment_half_width_95_Nm: ThreeOrNull | None
    """Half-width of its 95 % interval; null as that of the force, and where the moment is not known."""
    moment_deviation_Nm: ThreeOrNull | None
    """Standard deviation of the error from sample to sample."""
    moment_smallest_Nm: AxisValues | None
    """Smallest error of a sample, with its sign."""
    moment_largest_Nm: AxisValues | None
    """Largest error of a sample, with its sign."""
    force_predicted_N: float | None = None
    """Root mean square norm of the force error that the calibrations predict of their matrices, or of their priors, by
    the loads that moved since the offset was taken; null where no interval gave it, or a calibration predicts none.
    Sensors are taken as independent."""
    evidence: bool
    """Whether the phase carries information: in one that gave the offset, or the matrix, the error is near zero by
    construction."""


class OffsetOfSensor(Row):
    """The offset of one sensor that a policy gave."""

    calibration: str
    """What reads the sensors."""
    sensor: str
    """Sensor."""
    offset: Offset
    """Where the offset is from."""
    offset_interval: str
    """Interval that gave it."""
    link: str
    """The one link that touched the world in it, as far as the sensor is concerned."""
    samples: int
    """Samples that gave it."""
    value: WrenchValues
    """To be added; N, N m; zero for moments that are not known."""
    half_width_95: WrenchValues | None
    """Half-width of its 95 % interval; null where it cannot be determined."""
    moments_known: bool
    """Whether the log holds all joints that the moments depend on."""


class CoherenceSummary(Row):
    """What is left over all phases that are evidence."""

    calibration: str
    """What reads the sensors."""
    offset: Offset
    """Where the offset is from."""
    offset_interval: str | None
    """Interval that gave it; null where none did."""
    phases: int
    """Phases that are evidence."""
    force_error_mean_N: float | None
    """Mean over these phases of the norm of the error; null for none."""
    force_error_largest_N: float | None
    """Largest of these norms."""
    force_predicted_N: float | None = None
    """Root mean square of what is predicted for them; null where one is not."""
    prior_force_error_mean_N: float | None = None
    """Mean over the same phases, as far as they are evidence of the prior too, with its offset; null for the prior."""
    common_phases: int | None = None
    """Number of these phases; null for the prior."""
    common_force_error_mean_N: float | None = None
    """Mean over them of what reads the sensors here; null for the prior."""

    worse_than_prior: bool | None = None
    """Whether a calibration errs by 5 % more than the prior over the same phases; null for the prior, and without such
    a phase. Both are read from the same samples, whose noise they share."""


class Coherence(DrawnResult):
    """Whether the contacts together bear the weight, whichever of them touch (thesis 5.6)."""

    drawn_by: ClassVar[str] = "forcetorque.locomotion.figures:coherence_figure"
    answered_by: ClassVar[str | None] = "forcetorque.locomotion.answers:coherence_answers"

    interval_uses = ()

    schema_name: Literal["forcetorque/coherence/2"] = Field(default="forcetorque/coherence/2", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    mass_kg: float
    """Mass of the robot model."""
    weight_N: float
    """Its weight."""
    rows: tuple[PhaseForce, ...]
    """One per offset, phase and calibration."""
    offsets: tuple[OffsetOfSensor, ...]
    """Offsets that intervals gave."""
    summary: tuple[CoherenceSummary, ...]
    """One per offset and calibration."""

    def blocks(self) -> Iterator[Table | str]:
        """Give a table per offset in the form of thesis Tables 5.9 and 5.10, and what is left over all phases.

        Yields:
            Tables and sentences.
        """
        for key in dict.fromkeys((row.offset, row.offset_interval) for row in self.rows):
            rows = [row for row in self.rows if (row.offset, row.offset_interval) == key]
            yield _table(rows, self.weight_N)
            if any(row.moment_error_Nm is not None for row in rows):
                yield _moment_table(rows)
            yield _samples_table(rows)
        yield _summary_table(self.summary)
        yield (
            "F: mean net contact force, z up; E: F less (0, 0, weight), ± half a 95 % interval of the mean where the "
            "phase is stationary noise (without ± it bears the error of the offset too); M: error of the net moment "
            f"about the ground below the centre of mass. {NOT_EVIDENCE}: the phase gave offset or matrix, so its error "
            "is near zero by construction. Forces of one foot against the other cancel in F: their size is not "
            "evaluated."
        )

    def records(self) -> list[dict[str, object]]:
        """Give the rows as lines.

        Returns:
            A line per offset, phase and candidate.
        """
        return [row.flat() for row in self.rows]


def policy_words(offset: Offset, interval: str | None) -> str:
    """Name an offset as the command line does.

    Args:
        offset: Where it is from.
        interval: Interval that gave it.

    Returns:
        Such as `one-link-imu:hanging`.
    """
    return offset.value if interval is None else f"{offset}:{interval}"


def _table(rows: Sequence[PhaseForce], weight: float) -> Table:
    names, first = short_names([row.calibration for row in rows]), rows[0]
    return Table(
        caption=f"offset {policy_words(first.offset, first.offset_interval)}; weight {weight:.2f} N",
        headings=(
            "phase",
            "read by",
            *(f"F{axis}, N" for axis in _NAMES),
            *(f"E{axis}, N" for axis in _NAMES),
            "",
        ),
        rows=tuple(
            (
                row.phase,
                names[row.calibration],
                *(number(float(force), 2) for force in row.force_N),
                *_cells(row.force_error_N, row.force_half_width_95_N, 2),
                "" if row.evidence else NOT_EVIDENCE,
            )
            for row in rows
        ),
    )


def _moment_table(rows: Sequence[PhaseForce]) -> Table:
    names, first = short_names([row.calibration for row in rows]), rows[0]
    return Table(
        caption=f"the same about moments, offset {policy_words(first.offset, first.offset_interval)}",
        headings=("phase", "read by", *(f"M{axis}, N m" for axis in _NAMES), ""),
        rows=tuple(
            (
                row.phase,
                names[row.calibration],
                *_cells(row.moment_error_Nm, row.moment_half_width_95_Nm, 2),
                "" if row.evidence else NOT_EVIDENCE,
            )
            for row in rows
        ),
    )


def _samples_table(rows: Sequence[PhaseForce]) -> Table:
    names, first = short_names([row.calibration for row in rows]), rows[0]
    moments = any(row.moment_error_Nm is not None for row in rows)
    headings = [f"E{axis}, N" for axis in _NAMES] + [f"M{axis}, N m" for axis in _NAMES if moments]
    table = []
    for row in rows:
        cells = [*_ranges(row.force_deviation_N, row.force_smallest_N, row.force_largest_N)]
        if moments:
            cells += _ranges(row.moment_deviation_Nm, row.moment_smallest_Nm, row.moment_largest_Nm)
        table.append((row.phase, names[row.calibration], *cells))
    return Table(
        caption="samples within the phase: standard deviation (smallest to largest), offset "
        + policy_words(first.offset, first.offset_interval),
        headings=("phase", "read by", *headings),
        rows=tuple(table),
    )


def _ranges(deviations: ThreeOrNull | None, smallest: AxisValues | None, largest: AxisValues | None) -> Iterator[str]:
    if deviations is None or smallest is None or largest is None:
        yield from ("-",) * 3
        return
    for deviation, low, high in zip(deviations, smallest, largest, strict=True):
        yield f"{number(deviation, 2)} ({interval(float(low), float(high), digits=2)})"


def _cells(values: AxisValues | None, half_widths: ThreeOrNull | None, digits: int) -> tuple[str, ...]:
    if values is None:
        return ("-",) * 3
    errors = half_widths or (None,) * 3
    return tuple(with_error(float(value), error, digits=digits) for value, error in zip(values, errors, strict=True))


def _summary_table(rows: Sequence[CoherenceSummary]) -> Table:
    names = short_names([row.calibration for row in rows])
    return Table(
        caption="norm of E over the phases that are evidence",
        headings=("offset", "read by", "phases", "mean, N", "largest, N"),
        rows=tuple(
            (
                policy_words(row.offset, row.offset_interval),
                names[row.calibration],
                str(row.phases),
                number(row.force_error_mean_N, 2),
                number(row.force_error_largest_N, 2),
            )
            for row in rows
        ),
    )
