# SPDX-License-Identifier: BSD-3-Clause
"""Pressure over time as a film."""

from __future__ import annotations

import io

import numpy as np
import pytest
from PIL import Image, ImageSequence

from forcetorque.base.arrays import FloatArray
from forcetorque.skin.figures import skin_film
from forcetorque.skin.surface import skin_surface, unrolled
from forcetorque.skin.wrench.result import SkinWrenchPicture
from tests.skin.layout.skins import cylinder


def _film(levels: FloatArray) -> bytes:
    """An even pressure of so many kPa at each time."""
    surface = skin_surface(cylinder())
    return skin_film(
        SkinWrenchPicture(
            patch="leg",
            seconds=0.4 * np.arange(len(levels)),
            forces={"force": levels},
            places=unrolled(surface),
            triangles=surface.triangles,
            pressures=1e3 * np.outer(levels, np.ones(len(surface.positions))),
            strongest=int(levels.argmax()),
        )
    )


def test_a_film_shows_the_pressure_of_each_time() -> None:
    """At the pace of the recording; on one scale an image with more pressure is brighter."""
    film = Image.open(io.BytesIO(_film(np.array([0.0, 10.0, 20.0]))))
    assert film.info["duration"] == 400
    width, height = film.size
    field = (0, height // 3, width // 3, 2 * height // 3)
    bright = [np.array(image.convert("RGB").crop(field)).mean() for image in ImageSequence.Iterator(film)]
    assert len(bright) == 3
    assert np.diff(bright).min() > 5.0


def test_a_long_film_leaves_images_out(monkeypatch: pytest.MonkeyPatch) -> None:
    """Every third of seven, shown three times as long."""
    monkeypatch.setattr("forcetorque.skin.figures.MOST_IMAGES", 3)
    film = Image.open(io.BytesIO(_film(np.arange(7.0))))
    assert (film.n_frames, film.info["duration"]) == (3, 1200)
