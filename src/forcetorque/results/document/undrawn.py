# SPDX-License-Identifier: BSD-3-Clause
"""Pictures that cannot be drawn: that is said in their place, and does not cost the document."""

from __future__ import annotations

from dataclasses import replace

from forcetorque.base.errors import ForceTorqueError
from forcetorque.results.document.content import Block, Document, Figure, Section, Text


def without_undrawn(document: Document) -> Document:
    """Draw every picture, and say of those that cannot be drawn why.

    Args:
        document: The document.

    Returns:
        It with a sentence in the place of every figure that its data do not make.
    """
    return replace(document, sections=tuple(map(_section, document.sections)))


def _section(section: Section) -> Section:
    return replace(section, blocks=tuple(map(_block, section.blocks)), sections=tuple(map(_section, section.sections)))


def _block(block: Block) -> Block:
    if isinstance(block, Figure):
        try:
            block.picture.png  # noqa: B018 - drawn here, where its error becomes a sentence
        except ForceTorqueError as error:
            return Text(text=f"A figure could not be drawn: {error}")
    return block
