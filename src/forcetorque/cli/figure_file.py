# SPDX-License-Identifier: BSD-3-Clause
"""The file that a figure is asked for in."""

from __future__ import annotations

from pathlib import Path

from forcetorque.errors import ForceTorqueError
from forcetorque.output_file import declare_outputs


def refuse_figure(figure: Path | None, *, force: bool | None = None) -> None:
    """Say what is wrong with the figure before hours are spent on what it is to show.

    Args:
        figure: PNG file to draw; None for none.
        force: As of `declare_outputs`.

    Raises:
        ForceTorqueError: If it is not called so, or has no folder to go to; MissingExtraError if nothing can draw it.
    """
    if figure is None:
        return
    from forcetorque.report.figures.canvas import new_figure

    if figure.suffix.lower() != ".png":
        raise ForceTorqueError(f"--figure {figure}: expected a name that ends in .png")
    if not figure.parent.is_dir():
        raise ForceTorqueError(f"--figure {figure}: expected an existing folder to write to, there is none")
    declare_outputs(figure, force=force)
    new_figure(1.0)
