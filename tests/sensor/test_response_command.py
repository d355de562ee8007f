# SPDX-License-Identifier: BSD-3-Clause
"""`response` shows events, numbers and filter in every form, draws them, and refuses what it cannot read."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.report.report_sections import result_figures
from forcetorque.results.document.content import Figure as FigureBlock, small_png
from tests.app.outcome import Run
from tests.scenes.excited_sensors import write_taps


@pytest.fixture(scope="module")
def taps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Five taps."""
    return write_taps(tmp_path_factory.mktemp("taps"))


@pytest.mark.long
def test_the_response_is_shown_and_drawn(taps: Path, run: Run) -> None:
    """JSON has the filter and the curve, CSV the numbers, and the figure is a PNG."""
    figure = taps.parent / "bode.png"
    words = ("bench", "response", taps, "--excitation", "impact", "--force", "log")
    result = run(*words, "--figure", figure, "--format", "json").result()
    assert result["schema"] == "forcetorque/response/2"
    assert len(result["inverse"]["numerator"]) == 3
    assert len(result["curve"]["coherence"]) == len(result["curve"]["frequency_hz"])
    assert figure.read_bytes().startswith(b"\x89PNG")
    # what a report draws of the JSON is what was drawn of the result
    (picture,) = result_figures(result)
    assert isinstance(picture, FigureBlock)
    assert picture.picture.png == small_png(figure.read_bytes())
    lines = run(*words, "--format", "csv").out.splitlines()
    assert (len(lines), lines[0].startswith("sensor,serial,quantity,source,value,half_width_95")) == (7, True)


def test_taps_of_a_sensor_by_itself_need_no_force(taps: Path, run: Run, tmp_path: Path) -> None:
    """Nothing says what it must read, and it rings all the same."""
    alone = tmp_path / "alone.toml"
    text = taps.read_text(encoding="utf-8").replace('path = "."', f'path = "{taps.parent}"')
    stated = 'applied = "log"\nmeasure_direction = "child_to_parent"'
    assert stated in text
    alone.write_text(text.replace(stated, 'motion = "none"'))
    words = ("--excitation", "impact", "--format", "csv")
    assert run("bench", "response", alone, *words).out == run("bench", "response", taps, *words).out != ""


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("-e", "shake"), "no excitation 'shake'; known: impact, pendulum, release"),
        (("-e", "impact", "--interval", "oven"), "no interval is labelled 'oven'"),
        (("-e", "impact", "--sensor", "leg"), "leg"),
        (("-e", "impact", "--force", "hammer"), "hammer"),
        (("-e", "impact", "--figure", "bode.bmp"), "ends in .png"),
    ],
)
def test_what_is_not_there_is_named(taps: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """One line and exit code 2."""
    outcome = run("bench", "response", taps, *words)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err
