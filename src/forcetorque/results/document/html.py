# SPDX-License-Identifier: BSD-3-Clause
"""Documents as one HTML file that needs nothing else: pictures inside, no script, fit for print."""

from __future__ import annotations

import base64
from importlib import resources

from forcetorque.base.errors import MissingExtraError, install_line
from forcetorque.results.document.content import (
    NO_ROWS,
    Block,
    Document,
    Figure,
    List,
    Page,
    Text,
    Verdict,
    without_undrawn,
)
from forcetorque.results.number_text import with_joined_units
from forcetorque.results.table import Table
from forcetorque.results.visual_roles import css_variables

_KINDS = {Verdict: "verdict", Text: "text", List: "list", Table: "table", Figure: "figure", Page: "page"}


def html_bytes(document: Document) -> bytes:
    """Write a document as HTML.

    Args:
        document: The document.

    Returns:
        The file, UTF-8. A page inside it runs its own scripts and cannot reach the document.

    Raises:
        MissingExtraError: If jinja2 is not installed.
    """
    try:
        from jinja2 import Environment, StrictUndefined
    except ImportError as error:
        raise MissingExtraError(f"reports are written by jinja2: {install_line('report')}") from error
    folder = resources.files("forcetorque.results.document")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {"kind": _kind, "data_url": _data_url, "pieces": _pieces, "joined": with_joined_units}
    template = environment.from_string((folder / "document.html.j2").read_text(encoding="utf-8"))
    rules = (folder / "document.css").read_text(encoding="utf-8")
    style = f":root {{\n{css_variables(dark=False)}\n}}\n{rules}"
    return template.render(document=without_undrawn(document), style=style, no_rows=NO_ROWS).encode(
        errors="backslashreplace"
    )


def _kind(block: Block) -> str:
    return _KINDS[type(block)]


def _pieces(text: str) -> list[tuple[str, bool]]:
    """Cut a text at backquotes: its pieces, and whether each is a command, which stands between two of them."""
    pieces = text.split("`")
    if len(pieces) % 2 == 0:  # one that has no other is a letter of a name
        return [(text, False)]
    return [(piece, bool(k % 2)) for k, piece in enumerate(pieces)]


def _data_url(png: bytes) -> str:
    return "data:image/png;base64," + base64.b64encode(png).decode("ascii")
