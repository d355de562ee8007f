# SPDX-License-Identifier: BSD-3-Clause
"""Smaller pictures: figures have few colours, and a palette holds them in a third of the bytes."""

from __future__ import annotations

import io

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
