# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of documents: drawn when a document is written, and made small."""

from __future__ import annotations

import io
from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING

from forcetorque.results.figures import png_bytes

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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

    def __init__(self, draw: Callable[[], Figure]) -> None:
        """Keep what draws the picture.

        Args:
            draw: Makes the figure; called when the picture is first asked for.
        """
        self._draw = draw

    @cached_property
    def png(self) -> bytes:
        """The picture as small PNG, drawn once."""
        return small_png(png_bytes(self._draw()))
