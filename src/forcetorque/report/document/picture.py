# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of documents: drawn when a document is written, and not before."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from typing import TYPE_CHECKING

from forcetorque.report.document.small_png import small_png
from forcetorque.report.figures.canvas import png_bytes

if TYPE_CHECKING:
    from matplotlib.figure import Figure


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
