# SPDX-License-Identifier: BSD-3-Clause
"""`gains` says the same as JSON, CSV and table, warns of what cannot be known, and draws where it is asked."""

from __future__ import annotations

import shutil
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.recording.storage import read_recording, write_recording
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, TWO, YARP, edit, snapshot
from tests.scenes.warm_experiments import TEMPERATURE

SERIAL = 'serial = "SIM001"\n'
GAINS = "amplifier_gain = [24, 24, 24, 36, 36, 36]\nallowed_gains = [8, 16, 24, 36, 48]\n"
EXAMPLES = Path(__file__).parents[2] / "examples"


def _saturate(arm: Path, channel: int, count: int) -> None:
    """Let a channel of the recording reach its limit at some samples of the first interval."""
    recording = read_recording(arm / "recording")
    stream = recording.stream("arm_ft")
    raw = np.array(stream.signal("raw").values)
    raw[300 : 300 + count, channel] = 32767.0
    changed = replace(stream, signals={"raw": replace(stream.signal("raw"), values=raw)})
    write_recording(arm / "recording", replace(recording, streams={**recording.streams, "arm_ft": changed}))


def _channels(result: dict[str, Any], sensor: int = 0) -> list[dict[str, Any]]:
    return list(result["sensors"][sensor]["channels"])


@pytest.mark.parametrize("form", [PARQUET, YARP, TWO])
def test_the_result_fits_its_schema(arm: Path, run: Run, form: str) -> None:
    """With and without gains; a damaged one does not fit."""
    schema = run("schema", "gains").result()
    result = run("bench", "gains", form, "--format", "json").result()
    assert faults(result, schema) == []
    assert result["schema"] == "forcetorque/gains/2"
    edit(arm / form, SERIAL, SERIAL + GAINS)
    assert faults(run("bench", "gains", form, "--format", "json").result(), schema) == []
    assert faults({**result, "margin": "wide"}, schema) != []


def test_without_gains_there_is_a_factor(arm: Path, run: Run) -> None:
    """Expected head-room is the margin on the nearer side; raising all channels improves every axis."""
    result = run("bench", "gains", PARQUET, "--margin", "0.3", "--format", "json").result()
    (sensor,) = result["sensors"]
    assert (sensor["sensor"], sensor["serial"], sensor["recovered"], sensor["repeat"]) == (
        "arm_ft",
        "SIM001",
        False,
        False,
    )
    assert (result["margin"], result["figure"]) == (0.3, None)
    for channel in _channels(result):
        assert channel["present_gain"] is channel["recommended_gain"] is None
        nearer = min(channel["expected_headroom_below"], channel["expected_headroom_above"])
        assert nearer == pytest.approx(0.3, abs=1e-9)
        assert channel["change"] == ("raise" if channel["largest_factor"] > 1.0 else "lower")
    assert len(sensor["resolution"]) == 6
    assert sensor["resolution"][3]["unit"] == "N m/count"
    assert len(sensor["strongest"]) == 7
    assert {joint["unit"] for joint in sensor["strongest"][6]["joints"]} == {"rad"}


def test_gains_of_the_options_replace_those_of_the_file(arm: Path, run: Run) -> None:
    """One number stands for all channels; the file's list is used where the option is absent."""
    edit(arm / PARQUET, SERIAL, SERIAL + GAINS)
    file = _channels(run("bench", "gains", PARQUET, "--format", "json").result())
    assert [channel["present_gain"] for channel in file] == [24, 24, 24, 36, 36, 36]
    words = ("--amplifier-gain", "8", "--allowed-gains", "8,9")
    both = _channels(run("bench", "gains", PARQUET, *words, "--format", "json").result())
    assert {channel["present_gain"] for channel in both} == {8.0}
    assert {channel["recommended_gain"] for channel in both} <= {8.0, 9.0}
    one = _channels(run("bench", "gains", PARQUET, "--amplifier-gain", "8,8,8,8,8,48", "--format", "json").result())
    assert [channel["present_gain"] for channel in one] == [8, 8, 8, 8, 8, 48]
    assert {channel["recommended_gain"] for channel in one} <= {8, 16, 24, 36, 48}


def test_a_saturated_channel_is_lowered_and_to_be_repeated(arm: Path, run: Run) -> None:
    """Two samples at the limit: the next lower gain, a warning, and the share; the other channels stay as they were."""
    edit(arm / PARQUET, SERIAL, SERIAL + GAINS)
    before = _channels(run("bench", "gains", PARQUET, "--format", "json").result())
    _saturate(arm, 4, 2)
    ended = run("bench", "gains", PARQUET, "--format", "json")
    result = ended.result()
    after = _channels(result)
    samples = result["sensors"][0]["samples"]
    assert (after[4]["change"], after[4]["recommended_gain"]) == ("lower_and_repeat", 24.0)
    assert after[4]["saturated_share"] == pytest.approx(2 / samples)
    assert result["sensors"][0]["repeat"]
    assert after[:4] + after[5:] == before[:4] + before[5:]
    (warning,) = [line for line in ended.log if line.startswith("WARNING")]
    assert "arm_ft: ch4 saturates in" in warning
    assert "lower its gain and repeat the motion" in warning
    shown = run("bench", "gains", PARQUET, "--details")
    assert "repeat at 24" in " ".join(shown.out.split())


def test_recovered_counts_are_said_to_be(arm: Path, run: Run) -> None:
    """Wrenches of a log become counts through the prior, with a warning about offsets."""
    ended = run("bench", "gains", YARP, "--format", "json")
    assert ended.result()["sensors"][0]["recovered"]
    assert any("arm_ft: counts were recovered through matrix_SIM001.txt" in line for line in ended.log)


def test_rows_and_table_say_the_same(arm: Path, run: Run) -> None:
    """CSV has a row per sensor and channel; the table names every channel, axis and joint."""
    result = run("bench", "gains", TWO, "--format", "json").result()
    rows = run("bench", "gains", TWO, "--format", "csv").rows()
    assert [(row["sensor"], row["channel"]) for row in rows] == [
        (sensor["sensor"], channel["channel"]) for sensor in result["sensors"] for channel in sensor["channels"]
    ]
    assert len(rows) == 12
    for row, channel in zip(rows, [*_channels(result), *_channels(result, 1)], strict=True):
        assert float(row["largest_counts"]) == channel["largest_counts"]
        assert (row["change"], row["present_gain"]) == (channel["change"], "")
    shown = run("bench", "gains", TWO, "--details")
    assert shown.code == 0
    for word in ("arm_ft (SIM001)", "tool_ft (SIM/002)", "ch5", "tz, mN m", "rms, after", "wrist", "above 20 %"):
        assert word in shown.out
    one = run("bench", "gains", TWO, "--sensor", "tool_ft", "--sensor", "tool_ft", "--format", "csv").rows()
    assert {row["sensor"] for row in one} == {"tool_ft"}
    assert len(one) == 6


def test_a_calibration_tells_what_a_count_is_worth(arm: Path, run: Run) -> None:
    """The file's name stands beside the resolution, which is not the prior's."""
    prior = run("bench", "gains", PARQUET, "--format", "json").result()["sensors"][0]
    fitted = run("bench", "gains", PARQUET, "-c", "fitted.json", "--format", "json").result()["sensors"][0]
    assert (prior["matrix"], fitted["matrix"]) == ("matrix_SIM001.txt", "fitted.json")
    assert prior["resolution"] != fitted["resolution"]
    assert prior["channels"] == fitted["channels"]


@pytest.mark.long
def test_a_figure_is_written_where_it_is_asked(arm: Path, run: Run) -> None:
    """A PNG with a row per sensor, named in the result; the log and everything else stay as they are."""
    before = snapshot(arm)
    result = run("bench", "gains", TWO, "--figure", "gains.png", "--format", "json").result()
    assert result["figure"] == "gains.png"
    assert (arm / "gains.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
    after = snapshot(arm)
    assert after.keys() - before.keys() == {"gains.png"}
    assert before.items() <= after.items()
    assert "drawn to gains.png" in run("bench", "gains", PARQUET, "--figure", "gains.png", "--details").out


def test_without_matplotlib_only_figures_are_refused(arm: Path, run: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    """The numbers need nothing more; the error says what to install, and nothing is written."""
    for name in ("matplotlib", "matplotlib.figure", "matplotlib.backends.backend_agg"):
        monkeypatch.setitem(sys.modules, name, None)
    before = snapshot(arm)
    assert "pip install 'forcetorque[report]'" in run("bench", "gains", PARQUET, "--figure", "gains.png").error()
    assert snapshot(arm) == before
    assert run("bench", "gains", PARQUET).code == 0


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("--margin", "1"), "margin: expected a share of the limit, 0 or more and below 1, got 1"),
        (("--margin", "-0.1"), "margin: expected a share of the limit"),
        (("--amplifier-gain", "8,8"), "expected one number, or one for each of the 6 channels of 'arm_ft', got 2"),
        (("--amplifier-gain", "8,x"), "--amplifier-gain 8,x: expected numbers with commas between them"),
        (("--amplifier-gain", "0"), "--amplifier-gain 0: expected finite numbers above 0"),
        (("--allowed-gains", "8,nan"), "--allowed-gains 8,nan: expected finite numbers above 0"),
        (("--allowed-gains", "8,16"), "give --amplifier-gain, or amplifier_gain in the experiment file"),
        (("--figure", "gains.bmp"), "--figure gains.bmp: expected a name that ends in .png"),
        (("--figure", "nowhere/gains.png"), "expected an existing folder to write to"),
        (("--sensor", "arm_tf"), "has no sensor 'arm_tf'; did you mean \"arm_ft\"?"),
        (("-c", "fitted.json", "-c", "copy.json"), "copy.json: fitted.json calibrates 'arm_ft' too; give one"),
    ],
)
def test_wrong_words_are_refused_in_one_line(arm: Path, run: Run, words: tuple[str, ...], message: str) -> None:
    """The option is named, and nothing is written."""
    shutil.copy("fitted.json", "copy.json")
    before = snapshot(arm)
    assert message in run("bench", "gains", PARQUET, *words).error()
    assert snapshot(arm) == before


def test_a_calibration_of_a_sensor_that_is_left_out_is_refused(arm: Path, run: Run) -> None:
    """It would be read for nothing."""
    assert (
        "calibrates 'arm_ft', which --sensor leaves out"
        in run("bench", "gains", TWO, "--sensor", "tool_ft", "-c", "fitted.json").error()
    )


def test_the_file_says_where_a_wrong_gain_stands(arm: Path, run: Run) -> None:
    """Its table and key are named."""
    edit(arm / PARQUET, SERIAL, SERIAL + "allowed_gains = [8]\n")
    assert "sensor[0]: allowed_gains needs amplifier_gain" in run("bench", "gains", PARQUET).error()
    edit(arm / YARP, SERIAL, SERIAL + "amplifier_gain = [8, 8]\n")
    assert "sensor[0]: expected amplifier_gain of 6 numbers" in run("bench", "gains", YARP).error()


@pytest.mark.long
@pytest.mark.real_data
def test_the_yoga_log(run: Run, data_dir: Path, tmp_path: Path) -> None:
    """A channel of the real leg sensor has 6 % left: the command says so, draws it, and warns of recovered counts."""
    path = tmp_path / "yoga.toml"
    text = (EXAMPLES / "02_icub_yoga_forward.toml").read_text(encoding="utf-8")
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    figure = tmp_path / "yoga.png"
    ended = run("bench", "gains", path, "--figure", figure, "--format", "json")
    (low,) = [channel for channel in _channels(ended.result()) if channel["change"] == "lower"]
    assert (low["channel"], low["largest_factor"]) == ("ch3", pytest.approx(0.85, abs=0.01))
    assert any("counts were recovered through" in line for line in ended.log)
    assert figure.read_bytes()[:4] == b"\x89PNG"
    (wrist,) = EXAMPLES.glob("07_*.toml")
    path.write_text(wrist.read_text(encoding="utf-8").replace("../../shared/data", data_dir.as_posix()))
    assert "expected raw counts, or the matrix file" in run("bench", "gains", path).error()


def test_a_calibration_with_temperature_tells_what_a_count_is_worth(warm: Path, run: Run) -> None:
    """Its matrix is used; where the file states no temperature the calibration is refused, as everywhere."""
    result = run("bench", "gains", PARQUET, "-c", "warm.json", "--format", "json").result()
    matrix = read_calibration("warm.json").matrix
    worst = [row["worst"] for row in result["sensors"][0]["resolution"]]
    np.testing.assert_allclose(worst, np.abs(matrix).sum(axis=1))
    edit(warm / PARQUET, TEMPERATURE, "")
    assert "expected the variable 'temperature', the experiment specifies none" in (
        run("bench", "gains", PARQUET, "-c", "warm.json").error()
    )
