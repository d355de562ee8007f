# SPDX-License-Identifier: BSD-3-Clause
"""Content of a document: text, tables, figures, messages for pictures that cannot be drawn; and it as HTML."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import datetime
from enum import StrEnum
from functools import cached_property
from importlib import resources
from typing import TYPE_CHECKING

from forcetorque.base.errors import ForceTorqueError, FormatError, needs_extra
from forcetorque.results.figure_style import png_bytes
from forcetorque.results.number_text import with_joined_units
from forcetorque.results.table import Table
from forcetorque.results.visual_roles import css_variables

if TYPE_CHECKING:
    import matplotlib.figure

_COLOURS = 96
"""Colours of the palette: eight hues and their shades against white, which smooth edges need."""


def small_png(png: bytes) -> bytes:
    """Give a picture with a palette of few colours.

    Args:
        png: A picture as PNG, opaque.

    Returns:
        The picture as PNG; the one given if that is smaller.
    """
    from PIL import Image

    with Image.open(io.BytesIO(png)) as picture:
        few = picture.convert("RGB").quantize(_COLOURS, dither=Image.Dither.NONE)
    packed = io.BytesIO()
    few.save(packed, format="png", optimize=True)
    return min(packed.getvalue(), png, key=len)


class Picture:
    """A figure that is still to be drawn.

    A figure of matplotlib takes some megabytes and its PNG a hundredth of that: a document of many pictures holds what
    draws them, and then the small PNG, which all its forms share.
    """

    def __init__(self, draw: Callable[[], matplotlib.figure.Figure]) -> None:
        """Keep what draws the picture.

        Args:
            draw: Makes the figure; called when the picture is first asked for.
        """
        self._draw = draw

    @cached_property
    def png(self) -> bytes:
        """The picture as small PNG, drawn once."""
        return small_png(png_bytes(self._draw()))


NO_ROWS = "no rows"
"""What stands below the headings of a table without rows."""


class Tone(StrEnum):
    """How good a verdict is; a word and a sign say it too, so that it does not hang on a colour."""

    GOOD = "good"
    CAUTION = "caution"
    BAD = "bad"
    UNKNOWN = "unknown"
    NOTE = "note"

    @property
    def sign(self) -> str:
        """A sign that stands before the verdict."""
        return {Tone.GOOD: "✓", Tone.CAUTION: "!", Tone.BAD: "✗", Tone.UNKNOWN: "?", Tone.NOTE: "·"}[self]


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """One sentence that matters more than what follows."""

    tone: Tone
    """How good it is."""
    text: str
    """The sentence."""
    word: str | None = None
    """The word beside the sign, such as `do not use`; that of the tone if left out."""

    @property
    def sign(self) -> str:
        """Sign and word that say what the colour says."""
        return f"{self.tone.sign} {self.word or self.tone.value}"


@dataclass(frozen=True, slots=True, kw_only=True)
class Text:
    """A paragraph."""

    text: str
    """Its words."""
    is_failure: bool = False
    """Whether it stands for what could not be made, and gives the reason."""


@dataclass(frozen=True, slots=True, kw_only=True)
class List:
    """Points one below the other."""

    points: tuple[str, ...]
    """The points."""
    numbered: bool = False
    """Whether they come one after the other, and have numbers."""

    @property
    def marks(self) -> tuple[str, ...]:
        """What stands before each."""
        return tuple(f"{k}." if self.numbered else "•" for k in range(1, len(self.points) + 1))


@dataclass(frozen=True, slots=True, kw_only=True)
class Figure:
    """A picture."""

    picture: Picture
    """The picture."""
    caption: str
    """What stands below it."""
    description: str
    """What it shows, for who cannot see it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Page:
    """A page of its own inside the document, to be worked with; only where a document can hold one."""

    html: bytes
    """The page, which needs nothing else."""
    title: str
    """What it is."""
    instead: str
    """What stands in its place where no page can be."""


Block = Verdict | Text | List | Table | Figure | Page
"""Anything that stands in a section."""


class Place(StrEnum):
    """Where a section stands on paper."""

    FLOW = "flow"
    """Below what comes before it."""
    PAGE = "page"
    """On a page of its own, which its first picture is made small enough for."""
    SPARE = "spare"
    """In a section with a page of its own: there if it is room enough, else behind these pages."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Section:
    """A heading and what stands below it."""

    title: str
    """The heading."""
    blocks: tuple[Block, ...] = ()
    """What stands below it."""
    sections: tuple[Section, ...] = ()
    """Sections inside it."""
    place: Place = Place.FLOW
    """Where it stands on paper."""
    folded: bool = False
    """Whether a screen shows its heading alone until it is opened; paper shows everything."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Document:
    """A document."""

    title: str
    """Its title."""
    subtitle: str
    """A line below the title."""
    created: str
    """When it was made, ISO 8601 with time zone."""
    sections: tuple[Section, ...]
    """Its sections."""

    @property
    def failures(self) -> tuple[str, ...]:
        """What could not be made, each with its section and the reason."""
        found, left = [], list(self.sections)
        while left:
            section = left.pop(0)
            left = [*section.sections, *left]
            found += [
                f"{section.title}: {block.text}"
                for block in section.blocks
                if isinstance(block, Text) and block.is_failure
            ]
        return tuple(found)

    def __post_init__(self) -> None:
        try:
            instant = datetime.fromisoformat(self.created)
        except ValueError:
            instant = None
        if instant is None or instant.tzinfo is None:
            raise FormatError(f"document: expected `created` as ISO 8601 with a time zone, got {self.created!r}")

    @property
    def instant(self) -> datetime:
        """When it was made."""
        return datetime.fromisoformat(self.created)


def without_undrawn(document: Document) -> Document:
    """Draw every picture, and say of those that cannot be drawn why.

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


_KINDS = {Verdict: "verdict", Text: "text", List: "list", Table: "table", Figure: "figure", Page: "page"}


def html_bytes(document: Document) -> bytes:
    """Write a document as HTML.

    Returns:
        The file, UTF-8. A page inside it runs its own scripts and cannot reach the document.

    Raises:
        MissingExtraError: If jinja2 is not installed.
    """
    with needs_extra("reports are written by jinja2", "report"):
        from jinja2 import Environment, StrictUndefined
    folder = resources.files("forcetorque.results.document")
    environment = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True, lstrip_blocks=True)
    environment.filters |= {"kind": _kind, "data_url": _data_url, "pieces": _pieces, "joined": with_joined_units}
    template = environment.from_string((folder / "document.html.j2").read_text(encoding="utf-8"))
    rules = (folder / "document.css").read_text(encoding="utf-8")
    style = (
        f":root {{\n  color-scheme: light dark;\n{css_variables(dark=False)}\n}}\n"
        f"@media screen and (prefers-color-scheme: dark) {{ :root {{\n{css_variables(dark=True)}\n}} }}\n{rules}"
    )
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
