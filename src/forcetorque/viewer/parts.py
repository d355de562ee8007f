# SPDX-License-Identifier: BSD-3-Clause
"""Parts of the robot that nothing touches: what their sensors leave unexplained together, before and after."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from forcetorque.analysis.joint.part_residuals import part_residuals
from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.calibration import Calibration
from forcetorque.calibration.joint import PartResidual
from forcetorque.calibration.joint.windows import WINDOW_S
from forcetorque.experiment import Experiment
from forcetorque.recording import Use
from forcetorque.recording.alignment import seconds_since
from forcetorque.viewer.block import Block
from forcetorque.viewer.draft import SceneDraft
from forcetorque.viewer.geometry import flat
from forcetorque.viewer.instants import Posture
from forcetorque.viewer.scene import Sensor, WrenchSeries

_BEFORE, _AFTER = "prior", "calibrations"
"""Names of the two series of a part."""


def scene_parts(
    experiment: Experiment,
    groups: Mapping[str, Mapping[str, Calibration]],
    posture: Posture,
    draft: SceneDraft,
) -> tuple[Sensor, ...]:
    """Collect what is left of the equation of every part between two sensors or more that are calibrated.

    A part with one sensor says no more than that sensor's expected wrench.

    Args:
        experiment: The experiment, without intervals that hold no sample.
        groups: Calibrations by sensor and name; of each sensor the first is used.
        posture: The instants.
        draft: Takes the arrays, and what the series are.

    Returns:
        The parts, shown as sensors are: what is left is a wrench at the link whose motion is known.
    """
    first = {sensor: next(iter(group.values())) for sensor, group in groups.items() if group}
    if len(first) < 2:
        return ()
    residuals = [
        residual
        for use in (Use.CALIBRATION, Use.VALIDATION)
        for residual in part_residuals(experiment, first, use)
        if len(residual.sensors) > 1
    ]
    if residuals:
        draft.sources.append(
            f"parts that nothing touches: what is left of their equations, means of {WINDOW_S:g} s, by the prior "
            "matrices with the offsets that suit best, and by the first calibration of every sensor"
        )
    seconds = seconds_since(posture.stamp_ns, experiment.recording.start_ns)
    places = dict.fromkeys((residual.part, residual.root_link) for residual in residuals)
    return tuple(
        _part(place, [one for one in residuals if (one.part, one.root_link) == place], seconds, draft.block)
        for place in places
    )


def _part(place: tuple[str, str], residuals: Sequence[PartResidual], seconds: FloatArray, block: Block) -> Sensor:
    name, link = place
    before, after = np.full((2, len(seconds), 6), np.nan)
    for residual in residuals:
        window, inside = _windows_at(residual.time_s, seconds)
        rows = np.where(residual.rows > 0, 1.0, np.nan)
        before[inside] = residual.before[window] * rows
        after[inside] = residual.after[window] * rows
    return Sensor(
        name=f"left over: {name}",
        serial="",
        link=link,
        link_H_sensor=flat(np.eye(4)),
        acting=None,
        acted_on=name,
        wrenches=tuple(
            WrenchSeries(
                name=series,
                role="measured",
                values=block.add(values, "float32"),
                reference_force=None,
                reference_moment=None,
                ellipsoid_force=None,
                ellipsoid_moment=None,
            )
            for series, values in ((_BEFORE, before), (_AFTER, after))
        ),
    )


def _windows_at(time_s: FloatArray, seconds: FloatArray) -> tuple[IntArray, BoolArray]:
    """Windows that instants lie in, and which instants lie in one."""
    nearest = np.clip(np.searchsorted((time_s[1:] + time_s[:-1]) / 2.0, seconds), 0, len(time_s) - 1)
    inside = np.abs(seconds - time_s[nearest]) <= WINDOW_S / 2.0
    return nearest[inside], inside
