# SPDX-License-Identifier: BSD-3-Clause
"""Figures of layouts, calibrations of taxels, contacts and events of a skinManager; pressure over time as a GIF."""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from forcetorque.base.arrays import FloatArray, require_shape
from forcetorque.base.errors import ShapeError, needs_extra
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.results.figure_style import (
    COLOURS,
    GRID,
    PAPER,
    PLANES,
    REFERENCE_COLOUR,
    ROW_INCHES,
    SMALL_PANEL_POINTS,
    draw_over_time,
    drawable,
    headline,
    in_figure_style,
    instants,
    legend_below,
    look,
    new_figure,
    shown_name,
    thinned_cloud,
    thinned_line,
)
from forcetorque.skin.taxels.result import TaxelPicture
from forcetorque.skin.wrench.result import SkinEventPicture, SkinWrenchPicture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import TriMesh
    from matplotlib.figure import Figure

    from forcetorque.skin.wrench.skin_wrench import SkinWrench


_TAXEL, _NORMAL = look(1), look(0)
_ARROW_MM = 10.0
_UNIT = 1e-3
"""Largest difference of the length of a unit normal from 1: files give few digits."""


@in_figure_style
def skin_layout_figure(positions: FloatArray, normals: Mapping[str, FloatArray]) -> Figure:
    """Draw where taxels are and which way they look: in space, and as seen along the axes of the link [1].

    Args:
        positions: Taxels in the link frame; shape (n, 3); m.
        normals: Normals by what they are, such as `as written` and `rebuilt`; shape (n, 3) each. Those that are not of
            length 1 are drawn as long as they are.

    Returns:
        The figure, a row for each.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there are no normals, or of another shape.

    References:
        [1] F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019), figure 7.8.
    """
    if not normals:
        raise ShapeError("normals: expected at least one set to draw, got none")
    require_shape(positions, name="positions", shape=(None, 3))
    figure = new_figure(1.1 * ROW_INCHES[1] * len(normals))
    # the narrow column keeps the label of the third axis clear of the next panel
    grid = figure.add_gridspec(len(normals), 5, width_ratios=(1.5, 0.1, 1.0, 1.0, 1.0))
    places = 1e3 * positions
    for row, (name, vectors) in enumerate(normals.items()):
        require_shape(vectors, name=f"normals {name}", shape=(len(positions), 3))
        arrows = _ARROW_MM * vectors
        _draw_space(figure.add_subplot(grid[row, 0], projection="3d"), places, arrows, title=name)
        for column, plane in enumerate(PLANES):
            _draw_plane(figure.add_subplot(grid[row, column + 2]), places[:, plane], arrows[:, plane], plane)
    headline(figure, _unit_normals(normals))
    normal_key = {"color": _NORMAL.colour, "linestyle": "-"}
    taxel_key = {"color": _TAXEL.colour, "linestyle": "none", "marker": "o", "markerfacecolor": "none"}
    legend_below(figure, [("taxels", taxel_key), (f"normals, {_ARROW_MM:g} mm long", normal_key)])
    return figure


def _unit_normals(normals: Mapping[str, FloatArray]) -> str:
    """How many normals have a direction, by what they are."""
    lengths = {name: np.linalg.norm(vectors, axis=1) for name, vectors in normals.items()}
    return "Normals of length 1: " + ", ".join(
        f"{(np.abs(length - 1.0) < _UNIT).sum()} of {len(length)} {shown_name(name)}"
        for name, length in lengths.items()
    )


def _draw_space(panel: Any, places: FloatArray, arrows: FloatArray, *, title: str) -> None:
    panel.plot(*places.T, "o", color=_TAXEL.colour, markersize=2.2, markeredgewidth=0.6, markerfacecolor="none")
    if arrows.any():
        panel.quiver(*places.T, *arrows.T, color=_NORMAL.colour, linewidth=0.6, arrow_length_ratio=0.3)
    panel.set_title(shown_name(title))
    panel.set_box_aspect(np.maximum(np.ptp(places, axis=0), 2.0 * _ARROW_MM), zoom=0.9)
    panel.locator_params(nbins=4)
    for axis in "xyz":
        getattr(panel, f"set_{axis}label")(f"{axis}, mm")
        panel.tick_params(axis=axis, labelsize=SMALL_PANEL_POINTS)


def _draw_plane(panel: Axes, places: FloatArray, arrows: FloatArray, plane: tuple[int, int]) -> None:
    panel.plot(*places.T, "o", color=_TAXEL.colour, markersize=2.5, markeredgewidth=0.6, markerfacecolor="none")
    panel.quiver(
        *places.T, *arrows.T, color=_NORMAL.colour, angles="xy", scale_units="xy", scale=1.0, width=0.003, zorder=3.0
    )
    # an arrow is no data: without the margin those at the rim would be cut
    panel.update_datalim(np.concatenate([places - _ARROW_MM, places + _ARROW_MM]))
    panel.autoscale_view()
    panel.set_xlabel(f"{'xyz'[plane[0]]}, mm")
    panel.set_ylabel(f"{'xyz'[plane[1]]}, mm", labelpad=0.0)
    panel.set_aspect("equal", adjustable="datalim")
    panel.tick_params(labelsize=SMALL_PANEL_POINTS)
    panel.grid(visible=True, color=GRID, linewidth=0.6)
    panel.set_axisbelow(True)


_SAMPLES: dict[str, Any] = {"color": COLOURS[1], "marker": "o", "markersize": 2.5, "markerfacecolor": "none"}
"""Samples of the one taxel: red circles, as in the thesis."""
_POINTS = 800
"""Points of one taxel that are drawn."""
_FORMS = (0, 2, 3, 4)
"""Looks of the curves: the second is that of the samples."""


@in_figure_style
def taxel_figure(picture: TaxelPicture) -> Figure:
    """Draw what taxels were calibrated with, and their curves.

    From the left: pressure and mean fall of the counts over time [1], the pressure of some taxels over their own fall
    [2], and the samples of one taxel with every form of curve [3].

    Args:
        picture: Samples of one recording, and curves of the first of its taxels.

    Returns:
        The figure, one row.

    Raises:
        MissingExtraError: If matplotlib is not installed.

    References:
        F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019): [1] figure 7.5; [2] figure 7.2;
        [3] figure 7.6.
    """
    figure = new_figure(ROW_INCHES[1])
    over_time, taxels, one = figure.subplots(1, 3)
    _draw_time(over_time, picture)
    _draw_taxels(taxels, picture)
    _draw_curves(one, picture)
    for panel, title in (
        (over_time, picture.recording),
        (taxels, f"{len(picture.names)} taxels"),
        (one, picture.names[0]),
    ):
        panel.set_title(shown_name(title), loc="left")
    least, most = (one(picture.fall.max(axis=0)) for one in (np.min, np.max))
    highest = 1e-3 * float(picture.pressure.max())
    headline(figure, f"At up to {highest:.3g} kPa the taxels fall by {least:.0f} to {most:.0f} counts")
    legend_below(
        figure,
        [
            ("pressure", {"color": REFERENCE_COLOUR, "linestyle": "-"}),
            ("mean counts below rest", {"color": COLOURS[0], "linestyle": "--"}),
            (f"samples of {picture.names[0]}", _SAMPLES | {"linestyle": "none"}),
            *((form, _line(k)) for k, form in enumerate(picture.curves)),
            ("highest that was fitted", {"color": REFERENCE_COLOUR, "linestyle": ":"}),
        ],
    )
    return figure


def _draw_time(panel: Axes, picture: TaxelPicture) -> None:
    time, drawn = thinned_line(picture.seconds, np.column_stack([1e-3 * picture.pressure, picture.mean_fall]))
    panel.plot(time, drawn[:, 0], color=REFERENCE_COLOUR, linewidth=1.0)
    counts = panel.twinx()
    counts.plot(time, drawn[:, 1], color=COLOURS[0], linestyle="--", linewidth=1.0)
    counts.set_ylabel("mean fall, counts")
    panel.set(xlabel="time, s", ylabel="pressure, kPa")


def _draw_taxels(panel: Axes, picture: TaxelPicture) -> None:
    for k in range(len(picture.names)):
        cloud = thinned_cloud(np.column_stack([picture.fall[:, k], 1e-3 * picture.pressure]), _POINTS)
        style = look(k)
        panel.plot(cloud[:, 0], cloud[:, 1], linestyle="none", color=style.colour, marker=style.marker, markersize=1.5)
    panel.set(xlabel="counts below rest", ylabel="pressure, kPa")


def _draw_curves(panel: Axes, picture: TaxelPicture) -> None:
    cloud = thinned_cloud(np.column_stack([picture.fall[:, 0], 1e-3 * picture.pressure]), _POINTS)
    panel.plot(cloud[:, 0], cloud[:, 1], linestyle="none", **_SAMPLES)
    for k, curve in enumerate(picture.curves.values()):
        panel.plot(picture.levels, 1e-3 * curve, linewidth=1.4, **_line(k))
    panel.axhline(1e-3 * picture.highest, color=REFERENCE_COLOUR, linestyle=":", linewidth=1.0)
    # a polynomial beyond its range would else leave nothing to see of the samples
    highest = 1e-3 * float(picture.pressure.max())
    panel.set(ylim=(-0.1 * highest, 1.2 * highest), xlabel="counts below rest", ylabel="pressure, kPa")


def _line(k: int) -> dict[str, Any]:
    style = look(_FORMS[k % len(_FORMS)])
    return {"color": style.colour, "linestyle": style.dashes}


_REFERENCE: dict[str, Any] = {"color": REFERENCE_COLOUR, "linestyle": "-"}


@in_figure_style
def skin_wrench_figure(picture: SkinWrenchPicture, reference: FloatArray | None = None) -> Figure:
    """Draw the pressures of a patch, laid flat, when the force was largest [1], and forces over time [2].

    Args:
        picture: Forces over time, and one field of pressure.
        reference: What the force truly is, where that is known; shape (k,); N.

    Returns:
        The figure, one row.

    Raises:
        MissingExtraError: If matplotlib is not installed.

    References:
        F. J. Andrade Chavez, Force-torque sensing in robotics, thesis (2019): [1] figure 7.9; [2] figure 7.11.
    """
    figure = new_figure(ROW_INCHES[1])
    field, lines = figure.subplots(1, 2, width_ratios=(2.0, 3.0))
    draw_field(figure, field, picture)
    draw_forces(lines, picture, reference)
    headline(figure, _force_message(picture, reference))
    keys = [(shown_name(name), _style(k)) for k, name in enumerate(picture.forces)]
    legend_below(figure, [*keys, *([] if reference is None else [("true force", _REFERENCE)])])
    return figure


def _force_message(picture: SkinWrenchPicture, reference: FloatArray | None) -> str:
    """What errs least; without a reference, the largest force."""
    what = "force" if reference is None else "RMS error"
    sizes = {
        name: np.nanmax(force) if reference is None else np.sqrt(np.nanmean((force - reference) ** 2))
        for name, force in picture.forces.items()
        if np.isfinite(force).any()
    }
    if not sizes:
        return "No force is known"
    best = (max if reference is None else min)(sizes, key=sizes.__getitem__)
    return f"{'Largest' if reference is None else 'Least'} {what}: {sizes[best]:.3g} N ({shown_name(best)})"


def draw_field(figure: Figure, panel: Axes, picture: SkinWrenchPicture) -> TriMesh:
    """Draw the pressures when the force was largest.

    Args:
        figure: Figure of the panel.
        panel: Where to draw.
        picture: Pressures.

    Returns:
        The coloured facets, whose array is the pressure on each taxel in kPa; the scale is that of all times.
    """
    from matplotlib.tri import Triangulation

    across, along = 1e3 * picture.places.T
    facets = Triangulation(across, along, picture.triangles)
    pressures = 1e-3 * picture.pressures
    drawn: TriMesh = panel.tripcolor(
        facets,
        pressures[picture.strongest],
        shading="gouraud",
        cmap="cividis",
        vmin=0.0,
        vmax=max(float(pressures.max()), float(np.finfo(np.float32).tiny)),
    )
    panel.plot(across, along, linestyle="none", marker=".", markersize=1.5, color=PAPER)
    bar = figure.colorbar(drawn, ax=panel)
    bar.set_label("pressure, kPa")
    panel.set(aspect="equal", xlabel="around, mm", ylabel="along, mm")
    panel.set_title(f"{shown_name(picture.patch)} at {picture.seconds[picture.strongest]:.1f} s", loc="left")
    return drawn


def draw_forces(panel: Axes, picture: SkinWrenchPicture, reference: FloatArray | None) -> None:
    """Draw forces over time.

    Args:
        panel: Where to draw.
        picture: Forces.
        reference: What the force truly is, where that is known; shape (k,); N.
    """
    if reference is not None:
        time, drawn = thinned_line(picture.seconds, np.asarray(reference)[:, None])
        panel.plot(time, drawn[:, 0], linewidth=1.4, **_REFERENCE)
    for k, force in enumerate(picture.forces.values()):
        time, drawn = thinned_line(picture.seconds, force[:, None])
        panel.plot(time, drawn[:, 0], linewidth=1.4, **_style(k))
    panel.set(xlabel="time, s", ylabel="force, N")


def _style(k: int) -> dict[str, Any]:
    return {"color": look(k).colour, "linestyle": look(k).dashes}


@in_figure_style
def skin_event_figure(pictures: Sequence[SkinEventPicture]) -> Figure:
    """Draw the heuristic of every stream of contacts over time.

    Args:
        pictures: The streams, at least one.

    Returns:
        The figure, one panel.

    Raises:
        MissingExtraError: If matplotlib is not installed.
        ShapeError: If there is no stream, or the shapes of one differ.
    """
    if not pictures:
        raise ShapeError("pictures: expected at least one stream of contacts, got none")
    figure = new_figure(0.8 * ROW_INCHES[1])
    panel = figure.subplots()
    for k, picture in enumerate(pictures):
        seconds = instants(picture.seconds, name=f"{picture.stream}: seconds")
        sizes = drawable(picture.heuristic, name=f"{picture.stream}: heuristic", shape=(len(seconds),))
        time, lines = thinned_line(seconds, sizes[:, None])
        draw_over_time(panel, time, lines[:, 0], look(k), turn=k, count=len(pictures))
    largest = max(pictures, key=lambda picture: float(np.nanmax(picture.heuristic, initial=0.0)))
    value = float(np.nanmax(largest.heuristic, initial=0.0))
    headline(figure, f"Largest heuristic, not newtons: {value:.3g} ({shown_name(largest.stream)})")
    panel.set(xlabel="time, s", ylabel="heuristic, not newtons", ylim=(0.0, None))
    legend_below(figure, [(shown_name(one.stream), look(k).key | {"linestyle": "-"}) for k, one in enumerate(pictures)])
    return figure


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
