# SPDX-License-Identifier: BSD-3-Clause
"""Tables of a report about spheres."""

from __future__ import annotations

from collections.abc import Sequence

from forcetorque.analysis import SphereRow
from forcetorque.result import Table, short_names


def sphere_table(rows: Sequence[SphereRow]) -> Table:
    """Show masses, errors and index in the form of thesis Table 4.1, with and without the model.

    Args:
        rows: Sphere analyses of a sensor.

    Returns:
        A row per candidate and fit.
    """
    names = short_names([row.candidate for row in rows])
    shown = []
    for row in rows:
        for label, fit in (("with model", row.with_reference), ("without", row.without_reference)):
            if fit is None:
                continue
            high = "any" if fit.index_high_kg is None else f"{fit.index_high_kg:.3f}"
            shown.append((
                names[row.candidate], label, *_three(fit.mass_kg, 3), *_three(fit.error_N, 2),
                "-" if fit.index_kg is None else f"{fit.index_kg:.3f}", f"{fit.index_low_kg:.3f} to {high}",
                "yes" if fit.identifiable else "no",
            ))  # fmt: skip
    return Table(
        caption="Apparent mass per axis, its error as a force, and the performance index; what is not identifiable "
        "cannot be compared",
        headings=(
            "candidate", "fit", "x, kg", "y, kg", "z, kg", "error x, N", "y, N", "z, N", "index, kg", "range", "known"
        ),
        rows=tuple(shown),
    )  # fmt: skip


def mass_table(rows: Sequence[SphereRow]) -> Table:
    """Show what the recording allows the masses to be.

    Args:
        rows: Sphere analyses of a sensor.

    Returns:
        A row per candidate and fit.
    """
    names = short_names([row.candidate for row in rows])
    return Table(
        caption="Intervals of 95 % of the apparent masses, kg; with the model, its masses and the joint angles are "
        "taken as exact",
        headings=("candidate", "fit", "x", "y", "z", "seen while fitting"),
        rows=tuple(
            (names[row.candidate], label,
             *(f"{low:.3f} to {'any' if high is None else f'{high:.3f}'}"
               for low, high in zip(fit.mass_low_kg, fit.mass_high_kg, strict=True)),
             ", ".join(row.fitted_on) or "nothing")
            for row in rows
            for label, fit in (("with model", row.with_reference), ("without", row.without_reference))
            if fit is not None
        ),
    )  # fmt: skip


def moment_table(rows: Sequence[SphereRow]) -> Table:
    """Show how far moments reach while the force goes over its sphere.

    Args:
        rows: Sphere analyses of a sensor.

    Returns:
        A row per candidate that was compared with the model.
    """
    names = short_names([row.candidate for row in rows])
    shown = [(names[row.candidate], row.moment_with_reference) for row in rows]
    return Table(
        caption="Largest moment about each axis while the force goes over its sphere, N m: measured, its interval, and "
        "by the model",
        headings=("candidate", "x", "by the model", "y", "by the model", "z", "by the model", "index", "known"),
        rows=tuple(
            (name,
             *(cell
               for value, low, high, wanted in zip(
                   fit.half_width_Nm, fit.low_Nm, fit.high_Nm, fit.expected_half_width_Nm, strict=True)
               for cell in (f"{value:.3f} ({low:.3f} to {high:.3f})", f"{wanted:.3f}")),
             f"{fit.index_Nm:.3f}", "yes" if fit.identifiable else "no")
            for name, fit in shown
            if fit is not None
        ),
    )  # fmt: skip


def _three(values: Sequence[float] | None, digits: int) -> list[str]:
    return ["-"] * 3 if values is None else [f"{value:.{digits}f}" for value in values]
