# SPDX-License-Identifier: BSD-3-Clause
"""One force field over all episodes of a dataset: faults by component, and what changes from episode to episode."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator, Sequence

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import MAD_TO_DEVIATION, SI_FACTORS, STANDARD_GRAVITY, si_factor
from forcetorque.dataset.episode_checks import EpisodeField, EqualRun
from forcetorque.dataset.force_fields import ForceField
from forcetorque.dataset.result import DatasetFinding, Kind
from forcetorque.results.number_text import amount

_NOISY, _NOISIER = 5.0, 10.0
"""Noise of an episode over that of the others, and of a component over its neighbours, from which on it is named."""
_FEWEST = 4
"""Episodes from which on one is compared with the others."""
_BEYOND = 6.0
"""Standard errors beyond which episodes differ."""
_OF_WEIGHT, _OF_FORCE = 0.05, 0.1
"""Shares of the weight and of the force below which a difference does no harm (heuristic)."""
_SIDE = 5
"""Episodes on either side of a change whose medians are compared."""
_TREND_EPISODES, _TREND = 8, 4.0
"""Episodes that a drift needs, and its test statistic by Kendall's rank correlation, normal where there is none."""
_LATE_SHARE = 0.6
"""Share of the episodes in which the same lag is found."""
_LONGEST_LEVER_M, _SHORTEST_LEVER_M = 5.0, 1e-3
"""Spread of moments over that of forces beyond which units are named: no tool reaches as far, none is as short."""
_LARGEST_FORCE = 3000.0
"""95 % quantile of the force from which on it is no force of an arm in N."""
_MASS_BAND = 1.5
"""Factor by which the weight may differ from that of the stated mass."""
_UNITS_OF_FORCE = {unit: 1.0 / factor for unit, (si_unit, factor) in SI_FACTORS.items() if si_unit == "N"}
"""Number that 1 N is in each unit that loggers write."""


def set_findings(
    field: ForceField,
    episodes: Sequence[EpisodeField],
    *,
    orientation: str | None,
    rate_hz: float,
    mass_kg: float | None,
) -> Iterator[DatasetFinding]:
    """Examine a field over all episodes.

    Args:
        field: The field.
        episodes: What is in each episode, in their order, at least one.
        orientation: Name of the orientation that gives gravity; None for none.
        rate_hz: Frames per second.
        mass_kg: Known mass of the tool; kg; None if it is not known.

    Yields:
        Findings, harm first within each check.
    """
    yield from _missing(field, episodes)
    yield from _dead(field, episodes)
    yield from _stuck_and_saturated(field, episodes)
    yield from _noisy(field, episodes)
    if field.is_wrench:
        yield from _units(field, episodes, mass_kg)
        yield from _late(field, episodes, orientation, rate_hz)
        yield from _tool_changes(field, episodes)
        yield from _biased(field, episodes)
    yield from _drifting(field, episodes)


def _finding(
    field: ForceField,
    kind: Kind,
    message: str,
    episodes: Sequence[int],
    *,
    harm: bool = True,
    component: int | None = None,
    frames: int = 0,
    size: float | None = None,
    unit: str | None = None,
) -> DatasetFinding:
    return DatasetFinding(
        field=field.name,
        component=None if component is None else field.components[component],
        kind=kind,
        harm=harm,
        episodes=tuple(episodes),
        frames=frames,
        size=size,
        unit=unit,
        message=message,
    )


def _missing(field: ForceField, episodes: Sequence[EpisodeField]) -> Iterator[DatasetFinding]:
    missing = np.array([one.missing for one in episodes])
    for k in np.flatnonzero(missing.any(axis=0)):
        where = [one.episode for one, count in zip(episodes, missing[:, k], strict=True) if count]
        count = int(missing[:, k].sum())
        message = f"{field.components[k]} has no finite number in {count} frames"
        yield _finding(field, Kind.MISSING, message, where, component=int(k), frames=count)


def _dead(field: ForceField, episodes: Sequence[EpisodeField]) -> Iterator[DatasetFinding]:
    """Components with one value in an episode; those of the same episodes and value together."""
    groups: dict[tuple[tuple[int, ...], float], list[int]] = defaultdict(list)
    frames = {one.episode: one.frames for one in episodes}
    for k in range(len(field.labels)):
        by_value: dict[float, list[int]] = defaultdict(list)
        for one in episodes:
            if one.frames > 1 and not np.isnan(one.constant[k]):
                by_value[float(one.constant[k])].append(one.episode)
        for value, where in by_value.items():
            groups[tuple(where), value].append(k)
    for (numbers, value), components in groups.items():
        every = len(components) == len(field.labels)
        names = "all components" if every else ", ".join(field.components[k] for k in components)
        everywhere = " of the dataset" if len(numbers) == len(episodes) else ""
        verb = "are" if len(components) > 1 else "is"
        yield _finding(
            field,
            Kind.DEAD,
            f"{names} {verb} {value:g} in every frame{everywhere}",
            numbers,
            component=components[0] if len(components) == 1 else None,
            frames=sum(frames[number] for number in numbers),
        )


def _stuck_and_saturated(field: ForceField, episodes: Sequence[EpisodeField]) -> Iterator[DatasetFinding]:
    for k, name in enumerate(field.components):
        low = min((one.smallest[k] for one in episodes if np.isfinite(one.smallest[k])), default=np.nan)
        high = max((one.largest[k] for one in episodes if np.isfinite(one.largest[k])), default=np.nan)
        runs = [(one, run) for one in episodes for run in one.runs if run.component == k]
        clipped = [(one, int(one.clipped[k])) for one in episodes if one.clipped[k]]
        for end in (low, high):
            reached = [(one, run) for one, run in runs if run.at_end and run.value == end]
            if len(reached) > 1:  # once may be a value that got stuck there
                runs = [entry for entry in runs if entry not in reached]
                yield _run_finding(field, Kind.SATURATED, f"{name} stays at {end:.6g}, an end of its range", reached)
        if clipped:
            numbers, count = [one.episode for one, _ in clipped], sum(count for _, count in clipped)
            message = f"{name} jumps to an end of its range and stays there for {count} frames"
            yield _finding(field, Kind.SATURATED, message, numbers, component=k, frames=count)
        if runs:
            values = sorted({run.value for _, run in runs})
            shown = f"{values[0]:.6g}" if len(values) == 1 else f"{len(values)} values"
            yield _run_finding(field, Kind.STUCK, f"{name} repeats {shown} for longer than by chance", runs)


def _run_finding(
    field: ForceField, kind: Kind, message: str, runs: Sequence[tuple[EpisodeField, EqualRun]]
) -> DatasetFinding:
    numbers = list(dict.fromkeys(one.episode for one, _ in runs))
    frames = sum(run.frames for _, run in runs)
    text = f"{message}: {frames} frames"
    return _finding(field, kind, text, numbers, component=runs[0][1].component, frames=frames)


def usual_noise(episodes: Sequence[EpisodeField]) -> FloatArray:
    """Give the noise of a field.

    Args:
        episodes: What is in each episode.

    Returns:
        Median over episodes, NaN where none shows it; shape (k,).
    """
    noise = np.array([one.noise for one in episodes])
    usual = np.full(noise.shape[1], np.nan)
    known = np.isfinite(noise).any(axis=0)
    usual[known] = np.nanmedian(noise[:, known], axis=0)
    return usual


def _noisy(field: ForceField, episodes: Sequence[EpisodeField]) -> Iterator[DatasetFinding]:
    noise, usual = np.array([one.noise for one in episodes]), usual_noise(episodes)
    for k, name in enumerate(field.components):
        known = np.isfinite(noise[:, k])
        if np.count_nonzero(known) < _FEWEST:
            continue
        noisy = [one.episode for one, value in zip(episodes, noise[:, k], strict=True) if value > _NOISY * usual[k]]
        if noisy:
            factor = float(np.nanmax(noise[:, k])) / float(usual[k])
            message = f"noise of {name} is up to {factor:.3g} times that of the other episodes"
            yield _finding(field, Kind.NOISY, message, noisy, harm=False, component=k, size=factor)
    for part in (range(3), range(3, 6)) if field.is_wrench else ():
        own = usual[list(part)]
        for k in part:
            others = own[[j for j in range(3) if part[j] != k]]
            if np.isfinite(others).all() and usual[k] > _NOISIER * others.max():
                factor = float(usual[k] / others.max())
                message = f"noise of {field.components[k]} is {factor:.3g} times that of the other axes"
                numbers = [one.episode for one in episodes]
                yield _finding(field, Kind.NOISY, message, numbers, harm=False, component=k, size=factor)


def _units(field: ForceField, episodes: Sequence[EpisodeField], mass_kg: float | None) -> Iterator[DatasetFinding]:
    numbers = [one.episode for one in episodes]
    levers = np.array([one.lever for one in episodes])
    lever = float(np.median(levers[np.isfinite(levers)])) if np.isfinite(levers).any() else np.nan
    stated = field.units
    factor = 1.0 if stated[0] is None or stated[3] is None else _lever_factor(stated[0], stated[3])
    if lever * factor > _LONGEST_LEVER_M:
        message = (
            f"moments change by {lever * factor:.3g} m times as much as forces, if those are in N and N m: as if "
            "moments were in N mm"
        )
        yield _finding(field, Kind.UNITS, message, numbers, size=lever * factor, unit="m")
    if lever * factor < _SHORTEST_LEVER_M and lever > 0.0:
        message = (
            f"moments change by {1e3 * lever * factor:.3g} mm times as much as forces, if those are in N and N m: as "
            "if forces were in mN"
        )
        yield _finding(field, Kind.UNITS, message, numbers, size=lever * factor, unit="m")
    weights = np.array([abs(one.weight.weight) for one in episodes if one.weight is not None])
    if mass_kg is not None and len(weights):
        yield from _weight_units(field, float(np.median(weights)), mass_kg, numbers)
        return
    sizes = np.array([one.force_size for one in episodes])
    force = float(np.median(sizes[np.isfinite(sizes)])) if np.isfinite(sizes).any() else 0.0
    if force > _LARGEST_FORCE and stated[0] in (None, "N"):
        message = f"forces reach {force:.4g}: too large for N on an arm, as if they were in mN, or counts"
        yield _finding(field, Kind.UNITS, message, numbers, size=force, unit="N")


def _lever_factor(force: str, moment: str) -> float:
    """From the quotient of moment and force in stated units to m."""
    return si_factor(moment)[1] / si_factor(force)[1]


def _weight_units(field: ForceField, weight: float, mass_kg: float, numbers: Sequence[int]) -> Iterator[DatasetFinding]:
    ratio = weight / (mass_kg * STANDARD_GRAVITY)
    stated = field.units[0] or "N"
    expected = ratio / _UNITS_OF_FORCE.get(stated, 1.0)
    if 1.0 / _MASS_BAND < expected < _MASS_BAND:
        return
    likely = min(_UNITS_OF_FORCE, key=lambda unit: abs(np.log(ratio / _UNITS_OF_FORCE[unit])))
    fits = 1.0 / _MASS_BAND < ratio / _UNITS_OF_FORCE[likely] < _MASS_BAND
    as_if = f"as if forces were in {likely}" if fits else "no unit of force fits: another tool, or another frame"
    message = f"the tool weighs {weight:.4g}, expected {mass_kg * STANDARD_GRAVITY:.4g} N of {mass_kg:g} kg: {as_if}"
    yield _finding(field, Kind.UNITS, message, numbers, size=ratio)


def _late(
    field: ForceField, episodes: Sequence[EpisodeField], orientation: str | None, rate_hz: float
) -> Iterator[DatasetFinding]:
    fits = [(one.episode, one.weight) for one in episodes if one.weight is not None]
    lags = [weight.late_frames for _, weight in fits if not weight.at_end_of_lags]
    if not fits or not lags or orientation is None:
        return
    lag = round(float(np.median(lags)))
    late = [number for number, weight in fits if weight.late_frames and abs(weight.late_frames - lag) <= 1]
    if lag == 0 or len(late) < _LATE_SHARE * len(fits):
        return
    side = "follows" if lag > 0 else "leads"
    message = (
        f"the force {side} {orientation} by {abs(lag)} frame(s), {abs(lag) / rate_hz:.3g} s if frames are even; the "
        "dataset has no true times to tell"
    )
    yield _finding(field, Kind.LATE, message, late, size=float(lag), unit="frames")


def _tool_changes(field: ForceField, episodes: Sequence[EpisodeField]) -> Iterator[DatasetFinding]:
    fits = [(one.episode, one.weight) for one in episodes if one.weight is not None]
    if len(fits) < 2:
        return
    weight = np.array([fit.weight for _, fit in fits])
    error = np.array([fit.error for _, fit in fits])
    unit = field.units[0] or ""
    for k in changes(weight, error, share=_OF_WEIGHT):
        before, after = (
            abs(float(np.median(weight[part]))) for part in (slice(max(0, k - _SIDE), k), slice(k, k + _SIDE))
        )
        number = fits[k][0]
        message = (
            f"the weight along gravity changes from {amount(before, unit)} to {amount(after, unit)} between episodes "
            f"{fits[k - 1][0]} and {number}: another tool, or its load"
        )
        yield _finding(field, Kind.TOOL_CHANGE, message, [number], size=after - before, unit=unit or None)


def changes(values: FloatArray, errors: FloatArray, *, share: float) -> list[int]:
    """Find where a series of levels changes and stays.

    Args:
        values: A level of each episode; shape (n,).
        errors: Standard errors; shape (n,).
        share: Share of the usual level below which a change does not count.

    Returns:
        Indices of the first values behind each change.
    """
    n = len(values)
    usual = abs(float(np.median(values)))
    steps = np.abs(np.diff(values))
    scatter = MAD_TO_DEVIATION * float(np.median(steps)) / np.sqrt(2.0) if n > 2 * _FEWEST else 0.0
    found: list[tuple[float, int]] = []
    for k in range(1, n):
        before, after = slice(max(0, k - _SIDE), k), slice(k, k + _SIDE)
        jump = abs(float(np.median(values[after]) - np.median(values[before])))
        spread = [max(float(np.median(errors[part])), scatter) / np.sqrt(len(values[part])) for part in (before, after)]
        if jump > max(_BEYOND * float(np.hypot(*spread)), share * usual):
            found.append((jump, k))
    kept: list[int] = []
    for _, k in sorted(found, reverse=True):
        if all(abs(k - other) > _SIDE for other in kept):
            kept.append(k)
    # where neighbouring windows see the same change, it is where the values themselves step most
    at = [max(range(max(1, k - 1), min(n, k + 2)), key=lambda j: steps[j - 1]) for k in kept]
    return sorted(set(at))


def _biased(field: ForceField, episodes: Sequence[EpisodeField]) -> Iterator[DatasetFinding]:
    fits = [(one, one.weight) for one in episodes if one.weight is not None]
    if len(fits) < _FEWEST:
        return
    bias = np.array([fit.bias for _, fit in fits])
    error = np.array([fit.bias_error for _, fit in fits])
    size = float(np.median([one.force_size for one, _ in fits]))
    middle = np.median(bias, axis=0)
    scatter = MAD_TO_DEVIATION * np.median(np.abs(bias - middle), axis=0)
    unit = field.units[0] or ""
    for k in range(3):
        away = np.abs(bias[:, k] - middle[k])
        beyond = away > np.maximum(_BEYOND * np.maximum(error[:, k], scatter[k]), _OF_FORCE * size)
        if beyond.any():
            numbers = [one.episode for (one, _), is_beyond in zip(fits, beyond, strict=True) if is_beyond]
            largest = float(away[beyond].max())
            message = f"the bias of {field.components[k]} differs by up to {amount(largest, unit)} from other episodes"
            yield _finding(field, Kind.BIASED, message, numbers, component=k, size=largest, unit=unit or None)


def _drifting(field: ForceField, episodes: Sequence[EpisodeField]) -> Iterator[DatasetFinding]:
    fitted = [one for one in episodes if one.weight is not None]
    by_gravity = len(fitted) >= _TREND_EPISODES
    used = fitted if by_gravity else [one for one in episodes if np.isfinite(one.rest).any()]
    if len(used) < _TREND_EPISODES:
        return
    sizes = np.array([np.fmax(np.abs(one.smallest), np.abs(one.largest)) for one in used])
    for k, name in enumerate(field.components[:3] if by_gravity else field.components):
        levels = np.array(
            [one.weight.bias[k] if by_gravity and one.weight is not None else one.rest[k] for one in used]
        )
        known = np.isfinite(levels)
        if np.count_nonzero(known) < _TREND_EPISODES:
            continue
        third = max(int(np.count_nonzero(known)) // 3, 1)
        change = float(np.median(levels[known][-third:]) - np.median(levels[known][:third]))
        if abs(change) < _OF_FORCE * float(np.nanmedian(sizes[:, k])) or abs(kendall(levels[known])) < _TREND:
            continue
        unit = field.units[k] or ""
        what = f"the bias of {name}" if by_gravity else f"the level of {name} at rest"
        doubt = "" if by_gravity else "; or the pose at rest does, which is not known without an orientation"
        message = f"{what} moves by {amount(change, unit)} from the first to the last episodes{doubt}"
        numbers = [one.episode for one in used]
        yield _finding(
            field, Kind.DRIFTING, message, numbers, harm=by_gravity, component=k, size=change, unit=unit or None
        )


def kendall(values: FloatArray) -> float:
    """Test whether a series rises or falls.

    Args:
        values: The series; shape (n,); of long ones medians of 400 blocks count.

    Returns:
        Kendall's statistic over its standard deviation: standard normal where the order is by chance.
    """
    if len(values) > 400:
        values = np.array([np.median(block) for block in np.array_split(values, 400)])
    n = len(values)
    pairs = float(np.sign(values[None, :] - values[:, None])[np.triu_indices(n, 1)].sum())
    return pairs / float(np.sqrt(n * (n - 1) * (2 * n + 5) / 18.0))
