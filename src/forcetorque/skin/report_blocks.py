# SPDX-License-Identifier: BSD-3-Clause
"""The section on the skin of an experiment: pressure, contacts over time, and what a skinManager saw."""

from __future__ import annotations

from collections.abc import Iterator

from forcetorque.report.experiment_assessment import ExperimentAssessment
from forcetorque.results.document.content import Block, Figure, List, Picture, Section, Text
from forcetorque.results.table import Table, table_of
from forcetorque.skin.figures import skin_event_figure, skin_wrench_figure
from forcetorque.skin.wrench.skin_wrench import SkinWrench

_HEURISTIC = (
    "What a skinManager calls the force of a contact is a heuristic, -0.05 times the number of active taxels, their "
    "mean fall in counts and the normal: it is no newtons, and nothing here is compared with it."
)


def skin_section(experiment: ExperimentAssessment) -> Section:
    """Give the contacts on the skin of an experiment.

    Args:
        experiment: The results about it.

    Returns:
        The section; empty without skin.
    """
    return Section(title=f"Skin: {experiment.experiment}", blocks=tuple(_blocks(experiment)))


def _blocks(experiment: ExperimentAssessment) -> Iterator[Block]:
    for patch in experiment.skin:
        yield from _patch(patch)
    if experiment.skin_left_out:
        yield List(points=experiment.skin_left_out)
    if experiment.skin_events:
        yield Text(text=_HEURISTIC)
        yield table_of(experiment.skin_events, "Contacts that a skinManager saw; the heuristic is not newtons")
        yield Figure(
            picture=Picture(lambda: skin_event_figure(experiment.skin_event_pictures)),
            caption="What a skinManager saw over time, by its heuristic, which is not newtons.",
            description="A line over time for every stream of contacts.",
        )


def _patch(patch: SkinWrench) -> Iterator[Block]:
    for block in patch.blocks():
        yield block if isinstance(block, Table) else Text(text=block)
    if patch.warnings:
        yield List(points=patch.warnings)
    yield Figure(
        picture=Picture(lambda: skin_wrench_figure(patch.picture)),
        caption=f"{patch.patch}, laid flat: pressure when the force was largest, and the contacts' force over time.",
        description="The patch laid flat, coloured by pressure, beside lines of force over time.",
    )
