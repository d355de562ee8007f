# SPDX-License-Identifier: BSD-3-Clause
"""`thermal` shows the drift in every form, draws it, and refuses what it cannot read."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.app.outcome import Run
from tests.scenes.thermal_cycles import PER_DEGREE, record, write_cycles


@pytest.fixture(scope="module")
def chamber(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Two short cycles in a chamber."""
    return write_cycles(tmp_path_factory.mktemp("chamber"), *record(np.random.default_rng(21), hours=0.5))


@pytest.mark.long
def test_drift_is_shown_and_drawn(chamber: Path, run: Run) -> None:
    """JSON has the numbers, the table the lines for an experiment file, and the figure is a PNG."""
    figure = chamber.parent / "drift.png"
    result = run("bench", "thermal", chamber, "--figure", figure, "--format", "json").result()
    assert result["schema"] == "forcetorque/thermal/2"
    (sensor,) = result["sensors"]
    assert "curve" not in sensor
    slopes = [row["drift_per_degC"] for row in sensor["components"]]
    np.testing.assert_allclose(slopes, PER_DEGREE, rtol=0.1)
    assert figure.read_bytes().startswith(b"\x89PNG")
    table = run("bench", "thermal", chamber, "--details").out
    assert "prior_coefficients = [" in table
    assert "heating - cooling" in table
    lines = run("bench", "thermal", chamber, "--format", "csv").out.splitlines()
    assert (len(lines), lines[0].startswith("sensor,serial,signal,unit,drift_per_degC")) == (7, True)


def test_a_sensor_by_itself_needs_no_motion(chamber: Path, run: Run, tmp_path: Path) -> None:
    """The drift is that of the file with a motion, whose streams it does not use; what needs a motion is refused."""
    text = chamber.read_text(encoding="utf-8")
    head, rest = text.split("[recording]")
    alone = tmp_path / "alone.toml"
    stated = head[: head.index("[load]")] + '[load]\nframe = "ft"\nmotion = "none"\n\n'
    alone.write_text(f"{stated}[recording]{rest}".replace('path = "."', f'path = "{chamber.parent}"'))
    drifts = [run("bench", "thermal", file, "--format", "json").result()["sensors"] for file in (chamber, alone)]
    assert drifts[0] == drifts[1]
    assert "nothing says what the sensor must read" in run("payload", alone).error()
    alone.write_text(alone.read_text().replace('motion = "none"', 'motion = ["log"]'))
    assert "expected measure_direction, child_to_parent or parent_to_child" in run("inspect", alone).error()


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--interval", "oven"), "no interval is labelled 'oven'"),
        (("--variable", "room"), "no variable 'room'"),
        (("--sensor", "leg"), "leg"),
        (("--figure", "drift.bmp"), "ends in .png"),
    ],
)
def test_what_is_not_there_is_named(chamber: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """One line and exit code 2."""
    outcome = run("bench", "thermal", chamber, *words)
    assert (outcome.code, outcome.out) == (2, "")
    assert message in outcome.err
