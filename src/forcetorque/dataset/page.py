# SPDX-License-Identifier: BSD-3-Clause
"""The check of a dataset as one HTML page."""

from __future__ import annotations

from pathlib import Path

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.dataset.result import DatasetCheck, check_answer
from forcetorque.results.answer import Concern
from forcetorque.results.document.content import Document, List, Section, Text, Tone, Verdict, html_bytes
from forcetorque.results.result import created_now
from forcetorque.results.table import Table

_TONES = {Concern.NONE: Tone.GOOD, Concern.UNCERTAIN: Tone.CAUTION, Concern.BAD: Tone.BAD}


def write_page(check: DatasetCheck, path: Path) -> None:
    """Write a check for a browser.

    Args:
        check: The check.
        path: HTML file to write or to replace.

    Raises:
        MissingExtraError: If the extra `report` is not installed.
    """
    answer = check_answer(check)
    blocks = [block if isinstance(block, Table) else Text(text=block) for block in check.blocks()]
    summary = Section(
        title="Result",
        blocks=(Verdict(tone=_TONES[answer.concern], text=answer.verdict), List(points=answer.why)),
    )
    document = Document(
        title="Forces of a dataset",
        subtitle=answer.subject,
        created=created_now(),
        sections=(summary, Section(title="Findings and episodes", blocks=tuple(blocks))),
    )
    write_bytes_atomically(path, html_bytes(document))
