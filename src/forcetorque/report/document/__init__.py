# SPDX-License-Identifier: BSD-3-Clause
"""Documents: headings, verdicts, tables and figures, written as one HTML file or as PDF."""

from forcetorque.report.document.content import (
    Block,
    Document,
    Figure,
    List,
    Page,
    Place,
    Section,
    Text,
    Tone,
    Verdict,
)
from forcetorque.report.document.html import html_bytes
from forcetorque.report.document.pdf import pdf_bytes
from forcetorque.report.document.picture import Picture
from forcetorque.result import Table

__all__ = [
    "Block",
    "Document",
    "Figure",
    "List",
    "Page",
    "Picture",
    "Place",
    "Section",
    "Table",
    "Text",
    "Tone",
    "Verdict",
    "html_bytes",
    "pdf_bytes",
]
