# SPDX-License-Identifier: BSD-3-Clause
"""Estimates as one table, Parquet or comma-separated text: a row per instant, a column per number."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.estimation.uncertain.estimate import UncertainEstimates
from forcetorque.formats.sample_table import Column, SampleSpan, write_samples
from forcetorque.robot.contacts import Wrenches
from forcetorque.robot.mechanics.estimates import Estimates
from forcetorque.robot.model import JointType, RobotModel

SCHEMA = "forcetorque/estimates/1"
"""Name and version of the form."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class EstimatedSpan:
    """Estimates of one span of time."""

    label: str
    """Name of the span."""
    stamp_ns: IntArray
    """Instants; shape (n,); ns."""
    time_s: npt.NDArray[np.float64]
    """The same from the start of the recording; shape (n,); s."""
    measured: Wrenches
    """What the sensors measured."""
    estimates: Estimates
    """What was estimated."""
    outside: Mapping[str, npt.NDArray[Any]] = field(default_factory=dict)
    """By sensor that a calibration reads, whether its reading lies outside what was fitted; shape (n,) each; masked in
    gaps."""
    fused_joints: tuple[str, ...] = ()
    """Joints of `torques`."""
    torques: Mapping[str, npt.NDArray[np.float64]] = field(default_factory=dict)
    """Torques by source of a fusion, or of all together; shape (n, joints) each; N m, N where prismatic."""
    uncertain: UncertainEstimates | None = None
    """Contacts and torques with covariances, where there is skin."""
    centres: Mapping[str, FloatArray] = field(default_factory=dict)
    """By contact on skin its centre of pressure, NaN where it does not touch; shape (n, 3) each; m."""
    identities: Mapping[str, IntArray] = field(default_factory=dict)
    """By contact on skin the number that it keeps, 0 where it does not touch; shape (n,) each."""


def write_estimates(path: Path | str, spans: Sequence[EstimatedSpan], model: RobotModel) -> int:
    """Write estimates; on any error the file keeps what it held before.

    Columns are `interval`, `stamp_ns`, `time_s`, and then `contact.NAME.fx`, `torque.JOINT`, `torque_SOURCE.JOINT`,
    `expected.SENSOR.fx`, `measured.SENSOR.fx`, `outside.SENSOR`, `rank.PART`, `condition.PART` and `residual.PART.fx`;
    where there is skin `identity.PATCH 1`, `centre.PATCH 1.x`, and standard deviations `sd.contact.NAME.fx` and
    `sd.torque.JOINT`, and `determined`, whether nothing is hidden from all readings.
    Their units stand in the metadata of the Parquet fields. A cell is empty where an interval lacks the column, or a
    sample has a gap.

    Args:
        path: File to write or to replace, ending in .parquet or .csv, in an existing folder.
        spans: Spans, one after the other.
        model: The robot, for the units of its joints.

    Returns:
        Number of rows.
    """
    tables = [
        SampleSpan(label=span.label, stamp_ns=span.stamp_ns, time_s=span.time_s, columns=_columns(span, model))
        for span in spans
    ]
    return write_samples(path, tables, schema=SCHEMA)


def _columns(span: EstimatedSpan, model: RobotModel) -> Iterator[Column]:
    layout, estimates = span.estimates.layout, span.estimates
    yield from _wrenches("contact", layout.contacts, estimates.contact_wrenches)
    for k, joint in enumerate(layout.joints):
        yield f"torque.{joint}", _torque_unit(model, joint), estimates.torques[:, k]
    for source, torques in span.torques.items():
        for k, joint in enumerate(span.fused_joints):
            yield f"torque_{source}.{joint}", _torque_unit(model, joint), torques[:, k]
    yield from _wrenches("expected", layout.sensors, estimates.expected)
    yield from _wrenches("measured", span.measured.names, span.measured.values)
    for sensor, outside in span.outside.items():
        yield f"outside.{sensor}", "1", outside
    for k, part in enumerate(layout.parts):
        yield f"rank.{part}", "1", estimates.rank[:, k]
        yield f"condition.{part}", "1", estimates.condition[:, k]
    yield from _wrenches("residual", layout.parts, estimates.residual)
    if span.uncertain is not None:
        yield from _of_skin(span, span.uncertain, model)


def _of_skin(span: EstimatedSpan, answer: UncertainEstimates, model: RobotModel) -> Iterator[Column]:
    """Contacts on skin, which other columns do not have, and standard deviations of everything."""
    for name, centre in span.centres.items():
        yield from _wrenches("contact", [name], answer.contact(name)[:, None])
        identity = span.identities[name]
        yield f"identity.{name}", "1", np.ma.masked_array(identity, mask=identity == 0)
        for axis, values in zip("xyz", centre.T, strict=True):
            yield f"centre.{name}.{axis}", "m", values
    for name in answer.contacts:
        yield from _wrenches("sd.contact", [name], answer.contact_sd(name)[:, None])
    for k, joint in enumerate(answer.joints):
        unit = "N" if model.joints[joint].type is JointType.PRISMATIC else "N m"
        yield f"sd.torque.{joint}", unit, answer.torque_sd[:, k]
    yield "determined", "1", answer.determined


def _wrenches(what: str, names: Iterable[str], values: npt.NDArray[np.float64]) -> Iterator[Column]:
    for k, name in enumerate(names):
        for j, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
            yield f"{what}.{name}.{component}", unit, values[:, k, j]


def _torque_unit(model: RobotModel, joint: str) -> str:
    return "N" if model.joints[joint].type is JointType.PRISMATIC else "N m"
