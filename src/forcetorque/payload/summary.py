# SPDX-License-Identifier: BSD-3-Clause
"""What a weighed load says in sentences."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import combinations
from math import floor, hypot, log10
from typing import TYPE_CHECKING

from forcetorque.payload.identification.parameters import SECOND_MOMENTS, SIX_PLACES
from forcetorque.payload.result import BiasTestRow, DriftRow, LoadRow, RecordingLoadRow
from forcetorque.results.number_text import with_error

if TYPE_CHECKING:
    from forcetorque.payload.payload import WeighedLoad


_MOST_DIGITS = 9
"""Digits behind the point of an inertia; kg m2."""
_RARE = 0.01
"""Differences of biases that come from one bias more seldom are a warning."""


def load_words(load: LoadRow) -> str:
    """Say where a load is and what it weighs.

    Args:
        load: The load.

    Returns:
        A sentence without the sensor.
    """
    mass = with_error(load.mass_kg, load.mass_half_width_95_kg, digits=4)
    pairs = zip(load.centre_of_mass_m, load.centre_of_mass_half_width_95_m, strict=True)
    centre = ", ".join(
        with_error(None if place is None else 1e3 * place, None if half is None else 1e3 * half, digits=2)
        for place, half in pairs
    )
    name = "" if load.load == "load" else f"{load.load}: "
    half = "± half a 95 % interval" if load.estimated else "as stated"
    return f"{name}{mass} kg at ({centre}) mm, {half}"


def inertia_words(load: LoadRow) -> str | None:
    """Say what the inertia of a load is.

    Args:
        load: The load.

    Returns:
        A sentence; None where the inertia was not asked for.
    """
    values, halves = load.inertia_kgm2, load.inertia_half_width_95_kgm2
    if values is None or halves is None or all(half == 0.0 for row in halves for half in row):
        return None
    pairs = {SECOND_MOMENTS[k]: (values[i][j], halves[i][j]) for k, (i, j) in enumerate(zip(*SIX_PLACES, strict=True))}
    known = [half for _, half in pairs.values() if half]
    digits = min(max(1 - floor(log10(min(known))), 0), _MOST_DIGITS) if known else 0
    numbers = ", ".join(f"{pair} {with_error(*both, digits=digits)}" for pair, both in pairs.items())
    name = "" if load.load == "load" else f"{load.load}: "
    return f"{name}inertia about the centre of mass {numbers} kg m2"


def drift_words(drift: DriftRow) -> str:
    """Say whether a drift was taken, and why.

    Args:
        drift: The choice.

    Returns:
        A sentence.
    """
    taken = "biases drift evenly in time" if drift.taken else "biases are constant"
    if drift.error_with is None or drift.error_without is None:
        return f"{taken}: there are too few rows to choose"
    masses = (
        f"; by plain least squares the mass is {_masses(drift.plain_mass_with_kg)} kg with a drift and "
        f"{_masses(drift.plain_mass_without_kg)} kg without"
    )
    why = "chosen by rows that were held out" if drift.chosen else "as stated; rows that were held out"
    return f"{taken}, {why}: error {drift.error_with:.2f} with, {drift.error_without:.2f} without drift{masses}"


def bias_words(test: BiasTestRow, loads: Sequence[LoadRow]) -> str:
    """Say whether one bias would do.

    Args:
        test: The test.
        loads: Loads as they were estimated.

    Returns:
        A sentence.
    """
    if test.p_value is None:
        return f"whether the biases of the {test.of} differ is not told"
    numbers = [value or 0.0 for value in test.largest_difference]
    difference = f"by up to {max(numbers[:3]):.3g} N and {max(numbers[3:]):.2g} N m (p = {test.p_value:.2g})"
    if test.of == "intervals":
        return f"the biases of the intervals within a session differ {difference}"
    errors = ", ".join(
        f"{one - load.mass_kg:+.3g}"
        for one, load in zip(test.plain_mass_with_one_bias_kg, loads, strict=True)
        if one is not None and load.mass_kg is not None and load.estimated
    )
    error = f"; with one bias for all the mass would be off by {errors} kg" if errors else ""
    return f"the biases of the sessions differ {difference}{error}"


def disagreements(rows: Sequence[RecordingLoadRow]) -> Iterator[str]:
    """Name what recordings say of a load beyond their intervals.

    Args:
        rows: What each says by itself.

    Yields:
        A sentence for every two that differ.
    """
    for first, second in combinations(rows, 2):
        if first.load != second.load:
            continue
        halves = (first.mass_half_width_95_kg, second.mass_half_width_95_kg)
        named = [("mass", "kg", 1.0, _difference(first.mass_kg, second.mass_kg, *halves))]
        for k, axis in enumerate("xyz"):
            places = (first.centre_of_mass_m[k], second.centre_of_mass_m[k])
            halves = (first.centre_of_mass_half_width_95_m[k], second.centre_of_mass_half_width_95_m[k])
            named.append((f"centre of mass along {axis}", "mm", 1e3, _difference(*places, *halves)))
        words = [
            f"{name} by {factor * value[0]:.3g} {unit}, where {factor * value[1]:.2g} are expected"
            for name, unit, factor, value in named
            if value is not None
        ]
        if words:
            yield f"{first.recording} and {second.recording} disagree beyond their intervals: {'; '.join(words)}"


def _difference(
    first: float | None, second: float | None, first_half: float | None, second_half: float | None
) -> tuple[float, float] | None:
    """How far two numbers are apart and what their intervals allow; None where they allow it."""
    if first is None or second is None or first_half is None or second_half is None:
        return None
    apart, allowed = abs(first - second), hypot(first_half, second_half)
    return (apart, allowed) if apart > allowed else None


def payload_doubts(weighed: WeighedLoad) -> Iterator[str]:
    """Say what makes a weighed load doubtful.

    Args:
        weighed: The load.

    Yields:
        A sentence for each matter.
    """
    for hypothesis in weighed.hypotheses:
        yield f"{hypothesis.name}: {hypothesis.words}"
    for test in weighed.bias_tests:
        if test.of == "intervals" and test.p_value is not None and test.p_value < _RARE:
            yield (
                f"one bias for a session is wrong: {bias_words(test, weighed.loads)}; state a session for each "
                "interval after which the sensor was switched off, zeroed or warmed up"
            )
    yield from weighed.disagreements
    if weighed.left_out:
        yield f"{weighed.left_out} sample(s) lack a finite reading or motion, and are left out"
    if weighed.disagreeing:
        names = ", ".join(row.row for row in weighed.disagreeing[:5])
        more = f" and {len(weighed.disagreeing) - 5} more" if len(weighed.disagreeing) > 5 else ""
        count = f"{len(weighed.disagreeing)} of {weighed.rows}"
        yield f"{count} rows disagree with the others and count less: {names}{more}"
    for row in weighed.judged:
        if row.touched:
            force = f"up to {row.largest_force_N:.3g} N"
            yield f"interval {row.interval!r}: {force} are not of the load: something touches it"


def _masses(masses: Sequence[float | None]) -> str:
    return ", ".join("-" if mass is None else f"{mass:.4g}" for mass in masses)
