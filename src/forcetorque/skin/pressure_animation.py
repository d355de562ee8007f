# SPDX-License-Identifier: BSD-3-Clause
"""The pressure of a patch over time, as an animated GIF."""

from __future__ import annotations

import io
from pathlib import Path
from typing import TYPE_CHECKING, Final

import numpy as np

from forcetorque.base.errors import needs_extra
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.results.figure_style import ROW_INCHES, in_figure_style, new_figure, shown_name
from forcetorque.skin.figures import draw_field, draw_forces

if TYPE_CHECKING:
    from forcetorque.skin.wrench.result import SkinWrenchPicture
    from forcetorque.skin.wrench.skin_wrench import SkinWrench

MOST_IMAGES: Final = 200
"""Images of a film; of a longer recording some frames are left out."""
_COLOURS: Final = 64
_SHORTEST_MS: Final = 20
"""Time that browsers show an image at least."""


def save_skin_film(result: SkinWrench, path: Path) -> None:
    """Write the field of pressure over time beside the forces, at the pace of the recording, as GIF.

    Args:
        result: The contacts.
        path: File to write or to replace.
    """
    write_bytes_atomically(path, skin_film(result.picture))


@in_figure_style
def skin_film(picture: SkinWrenchPicture) -> bytes:
    """Draw the field of pressure over time, on the one scale of the whole recording, beside the forces.

    Args:
        picture: Pressures and forces over time.

    Returns:
        A GIF that repeats, of at most `MOST_IMAGES` images.

    Raises:
        MissingExtraError: If matplotlib or Pillow is not installed.
    """
    with needs_extra("films are written by Pillow", "report"):
        from PIL import Image
    figure = new_figure(ROW_INCHES[1])
    panel, lines = figure.subplots(1, 2, width_ratios=(2.0, 3.0))
    field = draw_field(figure, panel, picture)
    draw_forces(lines, picture, None)
    now = lines.axvline(picture.seconds[0], linewidth=1.0)
    stride = -(-len(picture.seconds) // MOST_IMAGES)
    images = []
    for k in range(0, len(picture.seconds), stride):
        field.set_array(1e-3 * picture.pressures[k])
        now.set_xdata([picture.seconds[k]] * 2)
        panel.set_title(f"{shown_name(picture.patch)} at {picture.seconds[k]:.1f} s", loc="left")
        figure.canvas.draw()
        pixels = np.asarray(figure.canvas.buffer_rgba())[..., :3]  # type: ignore[attr-defined]
        images.append(Image.fromarray(pixels).quantize(_COLOURS))
    period_s = float(np.median(np.diff(picture.seconds))) if len(picture.seconds) > 1 else 1.0
    film = io.BytesIO()
    duration_ms = max(_SHORTEST_MS, round(1e3 * stride * period_s))
    images[0].save(film, "GIF", save_all=True, append_images=images[1:], duration=duration_ms, loop=0)
    return film.getvalue()
