# SPDX-License-Identifier: BSD-3-Clause
"""Estimates as one table, Parquet or comma-separated text: a row per instant, a column per number."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

import numpy as np
import numpy.typing as npt

from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.estimation.estimate import IntervalEstimates
from forcetorque.estimation.torque.experiment_fusion import IntervalFusion
from forcetorque.estimation.uncertain.estimate_with_covariance import UncertainEstimates
from forcetorque.experiment.experiment import Experiment
from forcetorque.formats.sample_table_writing import Column, SampleSpan, write_samples
from forcetorque.recording.alignment import seconds_since
from forcetorque.robot.model import JointType, RobotModel

SCHEMA = "forcetorque/estimates/1"
"""Name and version of the form."""


def write_estimates(
    path: Path | str,
    experiment: Experiment,
    spans: Sequence[IntervalEstimates],
    fusions: Sequence[IntervalFusion] = (),
) -> int:
    """Write estimates; on any error the file keeps what it held before.

    Columns are `interval`, `stamp_ns`, `time_s`, and then `contact.NAME.fx`, `torque.JOINT`, `torque_SOURCE.JOINT`,
    `expected.SENSOR.fx`, `measured.SENSOR.fx`, `outside.SENSOR`, `rank.PART`, `condition.PART` and `residual.PART.fx`;
    where there is skin `identity.PATCH 1`, `centre.PATCH 1.x`, and standard deviations `sd.contact.NAME.fx` and
    `sd.torque.JOINT`, and `determined`, whether nothing is hidden from all readings.
    Their units stand in the metadata of the Parquet fields. A cell is empty where an interval lacks the column, or a
    sample has a gap.

    Args:
        path: File to write or to replace, ending in .parquet or .csv, in an existing folder.
        experiment: The experiment.
        spans: Its estimates, one interval after the other.
        fusions: Fused torques over the same intervals.

    Returns:
        Number of rows.
    """
    fused = {fusion.interval.label: fusion for fusion in fusions}
    tables = [
        SampleSpan(
            label=span.interval.label,
            stamp_ns=span.stamp_ns,
            time_s=seconds_since(span.stamp_ns, experiment.recording.start_ns),
            columns=_columns(span, fused.get(span.interval.label), experiment.model),
        )
        for span in spans
    ]
    return write_samples(path, tables, schema=SCHEMA)


def _columns(span: IntervalEstimates, fused: IntervalFusion | None, model: RobotModel) -> Iterator[Column]:
    layout, estimates = span.estimates.layout, span.estimates
    yield from _wrenches("contact", layout.contacts, estimates.contact_wrenches)
    for k, joint in enumerate(layout.joints):
        yield f"torque.{joint}", _torque_unit(model, joint), estimates.torques[:, k]
    for source, torques in () if fused is None else fused.columns():
        for k, joint in enumerate(fused.fusion.joints if fused else ()):
            yield f"torque_{source}.{joint}", _torque_unit(model, joint), torques[:, k]
    yield from _wrenches("expected", layout.sensors, estimates.expected)
    yield from _wrenches("measured", span.measured.names, span.measured.values)
    for sensor, applied in span.applied.items():
        yield f"outside.{sensor}", "1", np.ma.masked_array(applied.outside, mask=~applied.known)
    for k, part in enumerate(layout.parts):
        yield f"rank.{part}", "1", estimates.rank[:, k]
        yield f"condition.{part}", "1", estimates.condition[:, k]
    yield from _wrenches("residual", layout.parts, estimates.residual)
    if span.uncertain is not None:
        yield from _of_skin(span, span.uncertain, model)


def _of_skin(span: IntervalEstimates, uncertain: UncertainEstimates, model: RobotModel) -> Iterator[Column]:
    """Contacts on skin, which other columns do not have, and standard deviations of everything."""
    for source in span.skin:
        name = source.contact.name
        yield from _wrenches("contact", [name], uncertain.contact(name)[:, None])
        yield f"identity.{name}", "1", np.ma.masked_array(source.identity, mask=source.identity == 0)
        for axis, values in zip("xyz", source.centre.T, strict=True):
            yield f"centre.{name}.{axis}", "m", values
    for name in uncertain.contacts:
        yield from _wrenches("sd.contact", [name], uncertain.contact_sd(name)[:, None])
    for joint, deviations in zip(uncertain.joints, uncertain.torque_sd.T, strict=True):
        # 0 says that nothing uncertain reaches the joint: the model, which is taken as exact, has an error all the same
        yield f"sd.torque.{joint}", _torque_unit(model, joint), np.ma.masked_equal(deviations, 0.0)
    yield "determined", "1", uncertain.determined


def _wrenches(what: str, names: Iterable[str], values: npt.NDArray[np.float64]) -> Iterator[Column]:
    for k, name in enumerate(names):
        for j, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
            yield f"{what}.{name}.{component}", unit, values[:, k, j]


def _torque_unit(model: RobotModel, joint: str) -> str:
    return "N" if model.joints[joint].type is JointType.PRISMATIC else "N m"
