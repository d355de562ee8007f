# SPDX-License-Identifier: BSD-3-Clause
"""Tables and sentences about the spheres of a sensor, for the terminal and the report."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from forcetorque.analysis.sphere.rows import EllipsoidRow, SphereRow
from forcetorque.arrays import FloatArray
from forcetorque.result import Table, interval, number, short_names

MEANING = (
    "mass: where an axis leaves the ellipsoid, over gravity; error: that force minus the weight by the model; "
    "index: standard deviation of the three masses; known: whether they are worth comparing"
)
"""What the columns of the masses are."""


def mass_table(rows: Sequence[SphereRow], caption: str) -> Table:
    """Show masses, errors and index in the form of thesis Table 4.1, with and without the model.

    Args:
        rows: Spheres of one sensor.
        caption: What the table shows.

    Returns:
        A line per candidate and fit.
    """
    return Table(
        caption=caption,
        headings=("candidate", "fit", "x, kg", "y, kg", "z, kg", "error x, N", "y, N", "z, N", "index, kg", "known"),
        rows=tuple(
            (candidate, words, *_three(fit.mass_kg, 3), *_three(fit.error_N, 2), number(fit.index_kg, 3),
             _known(fit.identifiable))
            for candidate, words, _, fit in _fits(rows)
        ),
    )  # fmt: skip


def interval_table(rows: Sequence[SphereRow]) -> Table:
    """Show what the recording allows masses and index to be.

    Args:
        rows: Spheres of one sensor.

    Returns:
        A line per candidate and fit.
    """
    return Table(
        caption="what the recording allows: intervals of 95 %, which with the model take its masses and the joint "
        "angles as exact",
        headings=("candidate", "fit", "x, kg", "y, kg", "z, kg", "index, kg", "fitted on"),
        rows=tuple(
            (candidate, words,
             *(interval(low, high, digits=3) for low, high in zip(fit.mass_low_kg, fit.mass_high_kg, strict=True)),
             interval(fit.index_low_kg, fit.index_high_kg, digits=3), ", ".join(row.fitted_on) or "nothing of these")
            for candidate, words, row, fit in _fits(rows)
        ),
    )  # fmt: skip


def moment_table(rows: Sequence[SphereRow]) -> Table | None:
    """Show how far moments reach while the force goes over its sphere.

    Args:
        rows: Spheres of one sensor.

    Returns:
        Three lines per candidate; None where nothing was compared with the model.
    """
    names = short_names([row.candidate for row in rows])
    lines: list[tuple[str, ...]] = []
    for row in rows:
        fit, name = row.moment_with_reference, names[row.candidate]
        if fit is not None:
            ends = (interval(low, high, digits=3) for low, high in zip(fit.low_Nm, fit.high_Nm, strict=True))
            measured = (*_three(fit.half_width_Nm, 3), number(fit.index_Nm, 3), _known(fit.identifiable))
            lines.append((name, "measured", *measured))
            lines.append((name, "interval", *ends, "", ""))
            lines.append((name, "by the model", *_three(fit.expected_half_width_Nm, 3), "", ""))
    if not lines:
        return None
    return Table(
        caption="largest moment about each axis while the force goes over its sphere",
        headings=("candidate", "moment", "x, N m", "y, N m", "z, N m", "index, N m", "known"),
        rows=tuple(lines),
    )


def remarks(rows: Sequence[SphereRow], gravity: float) -> Iterator[str]:
    """Say what the masses rest on, and why something is not known.

    Args:
        rows: Spheres of one sensor, at least one.
        gravity: Magnitude of gravity; m/s2.

    Yields:
        Sentences.
    """
    first, names = rows[0], short_names([row.candidate for row in rows])
    if first.model_mass_kg is not None:
        yield f"the model has {first.model_mass_kg:.3f} kg on the sensor; gravity {gravity:g} m/s2"
    if first.no_reference is not None:
        yield f"no fit with the model: {first.no_reference}"
    for row in rows:
        name, one = names[row.candidate], row.one_radius
        mass = "none" if one.geometric_mass_kg is None else f"{one.geometric_mass_kg:.3f} kg"
        verdict = "" if one.identifiable else f", not identifiable: {'; '.join(one.why)}"
        yield f"{name}, one radius: {mass}, {interval(one.mass_low_kg, one.mass_high_kg, digits=2)} kg{verdict}"
        if row.with_reference is not None and row.with_reference.why:
            yield f"{name}, with the model: not identifiable: {'; '.join(row.with_reference.why)}"
        if row.without_reference.why:
            share = row.directions_covered
            covered = "" if share is None else f", {100.0 * share:.0f} % of all directions"
            yield f"{name}, without: a {row.form}{covered}; not identifiable: {'; '.join(row.without_reference.why)}"
        if row.moment_with_reference is not None and row.moment_with_reference.why:
            yield f"{name}, moments: not identifiable: {'; '.join(row.moment_with_reference.why)}"
        for words, fit in (("with the model", row.with_reference), ("without", row.without_reference)):
            if fit is not None and fit.identifiable and not fit.tilt_identifiable:
                yield f"{name}, {words}: half-widths and principal radii, which lie between the axes, are not known"


def _fits(rows: Sequence[SphereRow]) -> Iterator[tuple[str, str, SphereRow, EllipsoidRow]]:
    names = short_names([row.candidate for row in rows])
    for row in rows:
        for words, fit in (("with model", row.with_reference), ("without", row.without_reference)):
            if fit is not None:
                yield names[row.candidate], words, row, fit


def _three(values: FloatArray | None, digits: int) -> tuple[str, ...]:
    return ("-",) * 3 if values is None else tuple(number(value, digits) for value in values)


def _known(identifiable: bool) -> str:
    return "yes" if identifiable else "no"
