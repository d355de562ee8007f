# SPDX-License-Identifier: BSD-3-Clause
"""Pictures of the documentation are small, each on a page, and what the commands draw today."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError
from forcetorque.viewer.video import find_browser

pytest.importorskip("matplotlib", reason="figures need matplotlib")
from docs import pictures

ROOT = Path(__file__).resolve().parents[1]
VIEWER_BYTES = 80_000
ARRAYS = ("dataset", "fusion", "motion")
"""Pictures that no command draws, but a line of Python."""
MOST_DIFFERENT = 0.03
"""Share of pixels that may differ from the stored picture: letters do, by the versions of fonts and matplotlib."""
NOTICED = 48
"""Difference of a pixel that counts; of 255."""


def _different(one: Path, other: Path) -> float:
    """Share of pixels that differ; 1 where the sizes do."""
    from PIL import Image

    first, second = (np.asarray(Image.open(file).convert("RGB"), dtype=np.int16) for file in (one, other))
    if first.shape != second.shape:
        return 1.0
    return float((np.abs(first - second).max(axis=2) > NOTICED).mean())


def test_each_is_small_and_on_a_page() -> None:
    """With words for who does not see it."""
    pages = "\n".join(file.read_text(encoding="utf-8") for file in (ROOT / "docs").rglob("*.md"))
    assert len(pictures.PICTURES) >= 5
    assert sorted(pictures.IMAGES.iterdir())
    for file in pictures.IMAGES.iterdir():
        most = VIEWER_BYTES if file.name == "viewer.png" else pictures.MOST_BYTES
        assert file.stat().st_size <= most, file.name
    for name in [*pictures.PICTURES, *pictures.SKETCHES, *ARRAYS, "viewer"]:
        before, found, _ = pages.partition(f"images/{name}.png)")
        assert found, f"no page shows {name}.png"
        assert len(before.rpartition("![")[2].partition("]")[0]) > 20


@pytest.mark.long
def test_the_viewer_is_that_of_today(tmp_path: Path) -> None:
    """Drawn again by a browser, with the meshes of an iCub; colours differ by the drawing of the browser."""
    pytest.importorskip("playwright", reason="a page is drawn by playwright")
    pytest.importorskip("icub_models", reason="the robot is of icub-models")
    try:
        find_browser()
    except ForceTorqueError as error:
        pytest.skip(str(error))
    pictures.draw_viewer(tmp_path)
    assert _different(tmp_path / "viewer.png", pictures.IMAGES / "viewer.png") < MOST_DIFFERENT


@pytest.mark.long
def test_each_is_what_its_command_draws(tmp_path: Path) -> None:
    """Drawn again, pixel by pixel; two pictures are far more different than is allowed."""
    pictures.draw(tmp_path)
    pictures.draw_arrays(tmp_path)
    pictures.draw_sketches(tmp_path)
    names = [*pictures.PICTURES, *pictures.SKETCHES, *ARRAYS]
    different = {name: _different(tmp_path / f"{name}.png", pictures.IMAGES / f"{name}.png") for name in names}
    assert different == {name: pytest.approx(0.0, abs=MOST_DIFFERENT) for name in names}
    drawn = tmp_path / "sphere.png"
    flipped = tmp_path / "flipped.png"
    from PIL import Image, ImageOps

    ImageOps.mirror(Image.open(drawn).convert("RGB")).save(flipped)
    assert _different(drawn, flipped) > MOST_DIFFERENT
