# SPDX-License-Identifier: BSD-3-Clause
"""The section on joint torques by what they were estimated from: skin, force-torque sensors, motors, all together."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.estimation.figures import torque_figure
from forcetorque.report.experiment_assessment import ExperimentAssessment
from forcetorque.results.document.content import Block, Figure, List, Picture, Section, Text
from forcetorque.results.table import Table


def torque_section(experiment: ExperimentAssessment) -> Section:
    """Show what every source says of joint torques, over time.

    Args:
        experiment: The results about it.

    Returns:
        The section; empty without skin and without `[fusion]`.
    """
    return Section(title=f"Joint torques by source: {experiment.experiment}", blocks=tuple(_blocks(experiment)))


def _blocks(experiment: ExperimentAssessment) -> Iterator[Block]:
    if experiment.torques_left_out:
        yield List(points=experiment.torques_left_out)
    if experiment.fusion is not None:
        for block in experiment.fusion.blocks():
            yield block if isinstance(block, Table) else Text(text=block)
        if warnings := tuple(experiment.fusion.warnings()):
            yield List(points=warnings)
    picture = experiment.torque_picture
    if picture is None:
        return
    joints = f"the {len(picture.joints)} joints whose torques change most" if picture.left_out else "all joints"
    yield Figure(
        picture=Picture(
            lambda: torque_figure(picture.seconds, picture.joints, picture.torques, deviations=picture.deviations)
        ),
        caption=f"Torques of {joints} over time, by {', '.join(picture.torques)}; bands are intervals of 95 %.",
        description=f"A plot over time for each of {', '.join(picture.joints)}, with a line for every source.",
    )
