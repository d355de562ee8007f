# SPDX-License-Identifier: BSD-3-Clause
"""Recordings that contradict each other, and loads that do not determine a matrix."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS
from forcetorque.experiment.calibration.expected_sensor_errors import FLATTENED
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.experiment.calibration.sensor_model import WrenchModel

DISAGREEMENT = 5.0
"""Residual of one matrix for all over that of a line through the recording's own data, from which it is said."""
_FEWEST = 20
"""Means below which a line through a recording's own data says nothing."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Disagreement:
    """A recording that one matrix for all does not explain."""

    recording: str
    """The recording."""
    residual: FloatArray
    """Root mean square residual of force and moment with the matrix for all; shape (2,); N, N m."""
    own: FloatArray
    """The same by a line through its own data; shape (2,); N, N m."""


def disagreements(
    stretches: Sequence[WindowMeans], model: WrenchModel, accuracy: FloatArray
) -> tuple[Disagreement, ...]:
    """Compare what one matrix leaves of every recording with what a line through its own data leaves.

    Args:
        stretches: Means of the fitted intervals.
        model: The fit of all.
        accuracy: Accuracy of the reference, below which no residual counts; shape (6,); N, N m.

    Returns:
        Recordings whose residual is more than `DISAGREEMENT` times what their own data leave, the worst first; none of
        a single recording.
    """
    recordings: dict[str, list[WindowMeans]] = {}
    for stretch in stretches:
        recordings.setdefault(stretch.recording, []).append(stretch)
    if len(recordings) < 2:
        return ()
    ranked = []
    floor = np.array([np.linalg.norm(accuracy[part]) for part in FORCE_AND_MOMENT])
    for name, parts in recordings.items():
        residual, own, ratio = _compared(parts, model, floor)
        if ratio > DISAGREEMENT:
            ranked.append((ratio, Disagreement(recording=name, residual=residual, own=own)))
    return tuple(one for _, one in sorted(ranked, key=lambda pair: -pair[0]))


def _compared(
    parts: Sequence[WindowMeans], model: WrenchModel, floor: FloatArray
) -> tuple[FloatArray, FloatArray, float]:
    sessions = {part.session for part in parts}
    member = np.concatenate([np.full(len(part), sorted(sessions).index(part.session)) for part in parts])
    ones = (member[:, None] == np.arange(len(sessions))).astype(np.float64)
    raw = np.concatenate([part.raw for part in parts])
    reference = np.concatenate([part.unflattened(FLATTENED).reference for part in parts])
    variables = np.concatenate([part.variables for part in parts])
    reference = model.expected_reading(reference)
    error = reference - model.wrench(raw, variables if variables.shape[1] else None)
    left = error - ones @ np.linalg.lstsq(ones, error, rcond=None)[0]
    design = np.hstack([raw - raw.mean(axis=0), ones])
    freedom = len(raw) - design.shape[1]
    line = reference - design @ np.linalg.lstsq(design, reference, rcond=None)[0]
    residual = _sizes(left, len(raw))
    own = _sizes(line, max(freedom, 1))
    if freedom < _FEWEST:
        return residual, own, 0.0
    ratio = residual / np.maximum(own, np.maximum(floor, np.finfo(float).tiny))
    return residual, own, float(ratio.max())


def _sizes(error: FloatArray, freedom: int) -> FloatArray:
    """Root mean square of force and moment; shape (2,)."""
    return np.sqrt([(error[:, part] ** 2).sum() / freedom for part in FORCE_AND_MOMENT])


_RANK = 1e-6
"""Share of the largest change of load below which a direction does not move."""
_UNKNOWN = 0.5
"""Share of its response that the standard deviation of it may be, where no prior helps."""
_REMEDY = (
    "what its prior says; mounting does not do that: check prior and serial, the masses of the model, "
    "measure_direction and the support"
)
_LEAST_GAIN = 0.3
"""Least singular value of measured over prior response; mounting takes up to half of it, not more."""


ALL_COMPONENTS: Final[BoolArray] = np.ones(6, dtype=np.bool_)
"""Components that a six-axis sensor measures; shape (6,)."""


def unmoved_directions(
    wrench: FloatArray, lengths: Sequence[int], measured: BoolArray = ALL_COMPONENTS
) -> tuple[str, ...]:
    """Name the directions that loads do not move.

    Args:
        wrench: Loads of all stretches; shape (n, 6); N, N m.
        lengths: Number of means in each stretch.
        measured: Components that the sensor measures; shape (6,).

    Returns:
        Directions of these components, such as `fz`; none where the loads move all.
    """
    parts = np.split(wrench, np.cumsum(lengths)[:-1])
    moved = np.concatenate([part - part.mean(axis=0) for part in parts])
    size = _load_sizes(moved)
    axes = np.eye(6)[measured]
    _, strengths, directions = np.linalg.svd(
        np.vstack([moved / size @ axes.T, np.zeros((len(axes), len(axes)))]), full_matrices=False
    )
    weak = directions[strengths < _RANK * strengths[0]] @ axes
    return tuple(direction_words(direction / size) for direction in weak)


def require_rank(wrench: FloatArray, lengths: Sequence[int], measured: BoolArray = ALL_COMPONENTS) -> None:
    """Refuse loads that do not move all directions that the sensor measures.

    Args:
        wrench: Loads of all stretches; shape (n, 6); N, N m.
        lengths: Number of means in each stretch.
        measured: Components that the sensor measures; shape (6,).

    Raises:
        FitError: If a direction does not move; the message names it.
    """
    if weak := unmoved_directions(wrench, lengths, measured):
        count = int(measured.sum())
        raise FitError(
            f"the loads move {count - len(weak)} of {count} directions, not {'; '.join(weak)}; without a prior matrix "
            f"all {count} are needed: give prior, or {_load_words(weak)}"
        )


def _load_words(directions: Sequence[str]) -> str:
    """What to load, where directions are not moved."""
    moments_alone = all(name in WRENCH_COMPONENTS[3:] for name in directions)
    elsewhere = "record a load with its centre of mass elsewhere"
    if not all(name in WRENCH_COMPONENTS for name in directions):
        return elsewhere
    return f"load {', '.join(directions)}{f': {elsewhere}' if moments_alone else ''}"


def require_response(
    response: FloatArray, covariance: FloatArray, wrench: FloatArray, measured: BoolArray = ALL_COMPONENTS
) -> None:
    """Refuse a matrix that is not known by half in some direction of load.

    Args:
        response: Response of every row to loads; shape (rows, 6).
        covariance: Its covariance; shape (rows, 6, 6).
        wrench: Loads, in whose sizes the direction is told; shape (n, 6); N, N m.
        measured: Components that the sensor measures; shape (6,).

    Raises:
        FitError: If a direction is not known; the message names it.
    """
    axes = np.eye(6)[measured]
    own = response @ axes.T
    inverse_root = np.linalg.inv(np.linalg.cholesky(own.T @ own))
    total = axes @ covariance.sum(axis=0) @ axes.T
    if np.linalg.eigvalsh(inverse_root @ total @ inverse_root.T)[-1] > _UNKNOWN**2:
        # the ratio is largest where a wild response to one load cancels that to others, so it does not name the load
        size = _load_sizes(wrench) @ axes.T
        # said as what hardly changes from load to load, which `unmoved_directions` says too
        least_known = np.linalg.eigh(total * np.outer(size, size))[1][:, -1] / size @ axes
        raise FitError(
            f"the loads hardly move {direction_words(least_known)}, the response to it is not known by half; without a "
            f"prior matrix all {int(measured.sum())} directions are needed: give prior, or record a load with "
            "its centre of mass elsewhere"
        )


def require_sensor(response: FloatArray) -> None:
    """Refuse data by which a sensor would hardly answer to some load that its prior says it answers to.

    Args:
        response: Measured over prior response, in units of the size of every row; shape (6, 6).

    Raises:
        FitError: If it is so.
    """
    _, strengths, directions = np.linalg.svd(response)
    if strengths[-1] < _LEAST_GAIN:
        raise FitError(
            f"by the data the sensor answers to {direction_words(directions[-1])} with {strengths[-1]:.2f} of {_REMEDY}"
        )


def require_unmirrored(response: FloatArray) -> None:
    """Refuse data by which a sensor answers to forces or to moments as in a mirror, which no mounting does.

    Args:
        response: Measured over prior response, or its inverse, in any units; shape (6, 6).

    Raises:
        FitError: If it is so.
    """
    for part, name in zip(FORCE_AND_MOMENT, ("forces", "moments"), strict=True):
        block = response[part, part]
        if block.any(axis=1).all() and np.linalg.det(block) < 0.0:  # rows of components without a channel are zero
            named = [axis for axis, own in zip(WRENCH_COMPONENTS[part], np.diag(block), strict=True) if own < 0.0]
            which = f"{', '.join(named)} with the reverse of" if named else f"{name} as in a mirror, other than"
            raise FitError(f"by the data the sensor answers to {which} {_REMEDY}")


def _load_sizes(wrench: FloatArray) -> FloatArray:
    """Spread of forces and of moments, to compare both; shape (6,); N, N m."""
    moved = wrench - wrench.mean(axis=0)
    return np.repeat([max(float(moved[:, part].std()), 1e-12) for part in FORCE_AND_MOMENT], 3)


def direction_words(load: FloatArray) -> str:
    """Name a direction of load by its largest components.

    Args:
        load: The direction; shape (6,).

    Returns:
        Words such as `fx - 0.12 ty`.
    """
    scaled = load / np.abs(load).max()
    names = [(float(value), name) for value, name in zip(scaled, WRENCH_COMPONENTS, strict=True) if abs(value) > 0.05]
    sign = -1.0 if names[0][0] < 0.0 else 1.0
    words = [
        f"{'- ' if sign * value < 0.0 else '+ '}{'' if abs(value) > 0.995 else f'{abs(value):.2g} '}{name}"
        for value, name in names
    ]
    return " ".join(words).removeprefix("+ ")
