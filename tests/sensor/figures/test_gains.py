# SPDX-License-Identifier: BSD-3-Clause
"""Figures are whole PNG files of the documented size that show every channel before and after."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import MissingExtraError
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.results.figure_style import COLOURS, png_bytes
from forcetorque.sensor.figures import gain_figure
from forcetorque.sensor.gains.amplifier_gains import GainChange
from forcetorque.sensor.gains.gains import SensorGains, select_gains
from tests.report.drawing import count_of, pixels, size_of
from tests.scenes.experiments import PARQUET, write_experiments


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
    (drawn,) = select_gains(SensorRun(loaded, loaded.sensors[0])).drawn
    return drawn


@pytest.mark.parametrize("rows", [1, 2])
def test_a_png_of_the_right_size(gains: SensorGains, rows: int) -> None:
    """Signature, width and height as the format has them; a row per sensor."""
    png = png_bytes(gain_figure([gains] * rows))
    assert png[:8] == b"\x89PNG\r\n\x1a\n"
    assert png[-8:-4] == b"IEND"
    assert size_of(png) == (1200, 360 * rows)


def test_every_channel_is_drawn_before_and_after(gains: SensorGains) -> None:
    """Both halves hold the colour of each channel; one of the palette that no channel has is absent."""
    image = pixels(gain_figure([gains]))
    halves = np.array_split(image, 2, axis=1)
    for colour in COLOURS[: len(gains.channels)]:
        # the edges of a line are mixed with what is behind it, so that few of its pixels have the very colour
        assert all(count_of(half, colour) > 10 for half in halves), colour
    assert count_of(image, COLOURS[7]) == 0


@pytest.mark.long
def test_what_is_drawn_depends_on_the_gains(gains: SensorGains) -> None:
    """Factors of one draw the same lines on both sides; the recommended ones do not."""
    drawn = png_bytes(gain_figure([gains]))
    assert png_bytes(gain_figure([gains])) == drawn
    kept = {"recommended_gain": 1.0, "present_gain": 1.0, "change": GainChange.KEEP}
    same = replace(gains, channels=tuple(channel.model_copy(update=kept) for channel in gains.channels))
    assert png_bytes(gain_figure([same])) != drawn


@pytest.mark.parametrize("count", [1, 2, 3])
def test_a_few_samples_are_drawn(gains: SensorGains, count: int) -> None:
    """The shortest recordings make a figure too."""
    short = replace(gains, time_s=gains.time_s[:count], counts=gains.counts[:count])
    assert png_bytes(gain_figure([short]))[:4] == b"\x89PNG"


def test_without_matplotlib_the_error_says_what_to_install(gains: SensorGains, monkeypatch: pytest.MonkeyPatch) -> None:
    """One line with the command; nothing else of the package needs it."""
    for name in ("matplotlib", "matplotlib.figure", "matplotlib.backends.backend_agg"):
        monkeypatch.setitem(sys.modules, name, None)
    with pytest.raises(MissingExtraError, match=r"pip install 'forcetorque\[report\]'$"):
        gain_figure([gains])


@pytest.mark.long
def test_drawing_leaves_the_program_as_it_is(experiment: Path) -> None:
    """Matplotlib comes with the first figure and not before; pyplot, its windows and settings stay out of it."""
    code = f"""
import sys
from forcetorque.experiment import SensorRun, load_experiment
from forcetorque.sensor import select_gains
from forcetorque.sensor.figures import gain_figure
experiment = load_experiment({str(experiment)!r})
(gains,) = select_gains(SensorRun(experiment, experiment.sensors[0])).drawn
assert "matplotlib" not in sys.modules
gain_figure([gains])
import matplotlib
settings = matplotlib.rcParams.copy()
gain_figure([gains])
assert matplotlib.rcParams.copy() == settings
assert "matplotlib.pyplot" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", code], check=True)
