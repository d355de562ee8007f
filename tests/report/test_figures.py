# SPDX-License-Identifier: BSD-3-Clause
"""Figures are whole PNG files of the documented size that show every channel before and after."""

from __future__ import annotations

import io
import struct
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.errors import MissingExtraError
from forcetorque.experiment import SensorGains, load_experiment, select_gains
from forcetorque.report import figures, gain_figure
from tests.experiments import PARQUET, write_experiments


@pytest.fixture(scope="module")
def experiment(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Experiment file of the simulated arm."""
    folder = tmp_path_factory.mktemp("arm")
    write_experiments(folder)
    return folder / PARQUET


@pytest.fixture(scope="module")
def gains(experiment: Path) -> SensorGains:
    """Gains of its sensor."""
    loaded = load_experiment(experiment)
    return select_gains(loaded, loaded.sensors[0])


def _pixels(png: bytes) -> np.ndarray:
    from matplotlib.image import imread

    return np.rint(255 * np.asarray(imread(io.BytesIO(png), format="png"))[:, :, :3]).astype(int)


def _count(pixels: np.ndarray, colour: str) -> int:
    return int((pixels == [int(colour[k : k + 2], 16) for k in (1, 3, 5)]).all(axis=2).sum())


@pytest.mark.parametrize("rows", [1, 2])
def test_a_png_of_the_right_size(gains: SensorGains, rows: int) -> None:
    """Signature, width and height as the format has them; a row per sensor."""
    png = gain_figure([gains] * rows)
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert png[-8:-4] == b"IEND"
    assert struct.unpack(">II", png[16:24]) == (1200, 360 * rows)


def test_every_channel_is_drawn_before_and_after(gains: SensorGains) -> None:
    """Both halves hold the colour of each channel; one of the palette that no channel has is absent."""
    pixels = _pixels(gain_figure([gains]))
    halves = np.array_split(pixels, 2, axis=1)
    for colour in figures.COLOURS[: len(gains.ranges)]:
        assert all(_count(half, colour) > 20 for half in halves), colour
    assert _count(pixels, figures.COLOURS[7]) == 0


def test_what_is_drawn_depends_on_the_gains(gains: SensorGains) -> None:
    """Factors of one draw the same lines on both sides; the recommended ones do not."""
    assert gain_figure([gains]) == gain_figure([gains])
    same = replace(gains, advice=tuple(replace(each, factor=1.0) for each in gains.advice))
    assert gain_figure([same]) != gain_figure([gains])


def test_the_colours_are_told_apart_without_colour_vision() -> None:
    """Seen with red- and green-blind eyes [1], no two of the first six channels look alike; red and green do.

    References:
        [1] F. Vienot, H. Brettel, J. Mollon, Digital video colourmaps for checking the legibility of
            displays by dichromats, 1999: linear RGB projected for protanopes and deuteranopes.
    """
    to_lms = np.array([[17.8824, 43.5161, 4.11935], [3.45565, 27.1554, 3.86714], [0.0299566, 0.184309, 1.46709]])
    blind = {
        "protanope": np.array([[0.0, 2.02344, -2.52581], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]),
        "deuteranope": np.array([[1.0, 0.0, 0.0], [0.494207, 0.0, 1.24827], [0.0, 0.0, 1.0]]),
    }

    def seen(colour: str, eye: np.ndarray) -> np.ndarray:
        linear = (np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0) ** 2.2
        through = np.linalg.solve(to_lms, eye @ to_lms @ linear)
        return np.clip(through, 0.0, 1.0) ** (1 / 2.2)

    for eye in blind.values():
        looks = [seen(colour, eye) for colour in figures.COLOURS[:6]]
        apart = [np.linalg.norm(a - b) for k, a in enumerate(looks) for b in looks[:k]]
        assert len(apart) == 15
        assert min(apart) > 0.1
    red, green = (seen(colour, blind["deuteranope"]) for colour in ("#a84d00", "#5f7a00"))
    assert np.linalg.norm(red - green) < 0.1


def test_long_recordings_keep_their_peaks(gains: SensorGains) -> None:
    """A single sample among a hundred thousand is still in the line, which is short; a pause breaks it."""
    time = np.arange(100_000) * 0.01
    time[60_000:] += 50.0
    counts = np.zeros((100_000, 6))
    counts[12_345, 2], counts[70_001, 4] = 5000.0, -7000.0
    drawn_time, drawn = figures._line(time, counts)
    assert len(drawn) < 2100
    assert len(drawn_time) == len(drawn)
    assert (np.nanmax(drawn[:, 2]), np.nanmin(drawn[:, 4])) == (5000.0, -7000.0)
    assert np.count_nonzero(np.isnan(drawn[:, 0])) == 2
    assert drawn_time[np.nanargmax(drawn[:, 2])] == pytest.approx(123.45, abs=1.1)


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_few_samples_are_drawn(gains: SensorGains, count: int) -> None:
    """The shortest recordings make a figure too."""
    short = replace(gains, time_s=gains.time_s[:count], counts=gains.counts[:count])
    assert gain_figure([short])[:4] == b"\x89PNG"


def test_without_matplotlib_the_error_says_what_to_install(gains: SensorGains, monkeypatch: pytest.MonkeyPatch) -> None:
    """One line with the command; nothing else of the package needs it."""
    for name in ("matplotlib", "matplotlib.figure", "matplotlib.backends.backend_agg"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MissingExtraError, match=r"pip install forcetorque\[report\]$"):
        gain_figure([gains])


def test_drawing_leaves_the_program_as_it_is(experiment: Path) -> None:
    """Matplotlib comes with the first figure and not before; pyplot, its windows and settings stay out of it."""
    code = f"""
import sys
from forcetorque.experiment import load_experiment, select_gains
from forcetorque.report import gain_figure
experiment = load_experiment({str(experiment)!r})
found = select_gains(experiment, experiment.sensors[0])
assert "matplotlib" not in sys.modules
gain_figure([found])
import matplotlib
settings = matplotlib.rcParams.copy()
gain_figure([found])
assert matplotlib.rcParams.copy() == settings
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)
