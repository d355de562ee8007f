# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin wrench`: what it finds in a recording, and what it refuses."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.skin.simulation.objects_on_skin import ContactTruth
from forcetorque.skin.simulation.recordings import Loading
from tests.app.outcome import Run
from tests.report.drawing import size_of
from tests.scenes.touched import OBJECTS, write_table, write_touched

BROKEN = 25
WRENCH = ("skin", "wrench", "touched.toml", "--table", "shank.json")


@pytest.fixture(scope="module", name="made")
def made_folder(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[ContactTruth]]:
    """Folder with a chamber log and a recording, and what the objects in it truly do."""
    folder = tmp_path_factory.mktemp("shank")
    truths = list(write_touched(folder, broken=BROKEN))
    write_table(folder)
    return folder, truths


@pytest.fixture(name="truths")
def calibrated(made: tuple[Path, list[ContactTruth]], monkeypatch: pytest.MonkeyPatch) -> list[ContactTruth]:
    """The true contacts; the calibration of the patch is beside its recordings, in the working folder."""
    folder, truths = made
    monkeypatch.chdir(folder)
    return truths


def test_all_contacts_are_written(run: Run, truths: list[ContactTruth], tmp_path: Path) -> None:
    """As CSV prints them; the file is named, and no other ending is taken."""
    assert truths
    file = tmp_path / "contacts.csv"
    shown = run(*WRENCH, "-o", file)
    assert shown.code == 0
    assert f"written: {file}" in shown.out
    assert file.read_text(encoding="utf-8") == run(*WRENCH, "--format", "csv").out
    assert run(*WRENCH, "-o", tmp_path / "contacts.png").code == 2


def test_objects_are_found_while_they_rest(run: Run, truths: list[ContactTruth]) -> None:
    """Their forces within a fifth, no contact between them, and the broken taxel named."""
    ended = run(*WRENCH, "--format", "json")
    result = ended.result()
    assert result["schema"] == "forcetorque/skin_wrench/2"
    assert result["left_out"] == [BROKEN]
    loading = Loading()
    for number, truth in enumerate(truths):
        rests = loading.rest_s + number * loading.turn_s + loading.ramp_s
        held = [row for row in result["contacts"] if rests + 0.2 < row["time_s"] < rests + loading.hold_s - 0.2]
        assert held
        # an object may touch at two places
        wrench = np.sum([row["wrench"] for row in held], axis=0) / len({row["time_s"] for row in held})
        np.testing.assert_allclose(wrench[:3], truth.wrench[:3], atol=0.2 * truth.load_N)
        assert all(row["normal_force_N"] >= row["force_N"] for row in held)
        assert all(0.0 < row["force_sd_N"] < 0.5 for row in held)
        between = rests + loading.hold_s + 2.0 * loading.ramp_s + 0.2
        assert not [row for row in result["contacts"] if between < row["time_s"] < between + 1.0]
    assert len(truths) == OBJECTS
    # a warning counts the contacts that it is of, and without any there is none
    rows, warnings = result["contacts"], " ".join(ended.err.split())
    for text, number in (
        ("contacts have several hills", sum(row["lobes"] > 1 for row in rows)),
        ("contacts have over 10 % of their force at the edge", sum(row["edge_share"] > 0.1 for row in rows)),
        ("contacts press a taxel beyond", sum(row["beyond_range"] for row in rows)),
        ("contacts lasted so long", 0),
    ):
        assert (f"{number} of {len(rows)} {text}" in warnings) == (number > 0)
        assert (text in warnings) == (number > 0)


def test_a_known_weight_is_held_against_what_is_read(run: Run, truths: list[ContactTruth]) -> None:
    """Each object is a placement; objects of several masses are no one weight."""
    words = (*WRENCH, "--weight-kg", f"{truths[0].contact.mass_kg:g}")
    weight = run(*words, "--format", "json").result()["weight"]
    assert len(weight["placements"]) == len(truths)
    assert weight["placements"][0]["share"] == pytest.approx(1.0, abs=0.2)
    assert "known weight of" in run(*words).out
    assert "expected a mass above 0 kg" in run(*WRENCH, "--weight-kg", "0").err


def test_rows_are_contacts(run: Run, truths: list[ContactTruth]) -> None:
    """CSV has a line for each, with its wrench, its place and its taxels."""
    rows = run(*WRENCH, "--format", "csv").rows()
    assert {"wrench_fx_N", "wrench_tz_Nm", "centre_of_pressure_x_m", "taxels", "beyond_range"} <= set(rows[0])
    assert str(BROKEN) not in " ".join(row["taxels"] for row in rows).split()


@pytest.mark.long
def test_a_figure_is_drawn(run: Run, truths: list[ContactTruth], tmp_path: Path) -> None:
    """Field of pressure and forces over time, and the film of it."""
    png, gif = tmp_path / "contacts.png", tmp_path / "contacts.gif"
    files = ("--figure", str(png), "--film", str(gif))
    assert f"drawn to {png}" in run(
        *WRENCH, *files, "--average", "20", "--taxel-area-mm2", "39", "--details"
    ).out.replace("\n", " ")
    assert size_of(png.read_bytes())[0] == 1200
    assert gif.read_bytes()[:6] == b"GIF89a"


@pytest.mark.long
def test_methods_are_chosen_by_name(run: Run, truths: list[ContactTruth]) -> None:
    """A simple sum with a small area reads less, and has no standard deviation."""
    result = run(*WRENCH, "--method", "simple", "--taxel-area-mm2", "15.2", "--format", "json").result()
    ours = run(*WRENCH, "--format", "json").result()
    assert result["method"] == "simple"
    assert result["largest_force_N"] < 0.6 * ours["largest_force_N"]
    assert {row["force_sd_N"] for row in result["contacts"]} == {None}
    linear = run(*WRENCH, "--method", "linear", "--format", "json").result()
    assert linear["largest_force_N"] == pytest.approx(ours["largest_force_N"], rel=0.2)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--method", "simple"), "taxel_area_m2: expected a value for the method simple"),
        (("--method", "thesis"), "plane: expected a value for the method thesis"),
        (("--plan", "shank.csv"), "plane: expected none for the method kriging, got one"),
        (("--average", "0"), "expected at least 1 message"),
        (("--rest-s", "0.1"), "expected at least 10 messages"),
        (("--patch", "thigh"), "no patch is called 'thigh'"),
    ],
)
def test_what_cannot_be_is_refused(
    run: Run, truths: list[ContactTruth], options: tuple[str, ...], message: str
) -> None:
    """In one line, with exit code 2."""
    ended = run(*WRENCH, *options)
    assert ended.code == 2
    assert message in ended.err


def _changed(name: str, old: str, new: str, source: str = "touched.toml") -> None:
    text = Path(source).read_text(encoding="utf-8")
    assert old in text
    Path(name).write_text(text.replace(old, new), encoding="utf-8")


def test_a_table_of_another_patch_is_refused(run: Run, truths: list[ContactTruth]) -> None:
    """By its name or its serial number."""
    _changed("other.toml", 'serial = "S1"', 'serial = "S2"')
    ended = run("skin", "wrench", "other.toml", "--table", "shank.json")
    assert ended.code == 2
    assert "table of patch 'shank'" in ended.err
    assert "'S2' for 'S1'" in ended.err


def test_a_patch_without_layout_is_refused(run: Run, truths: list[ContactTruth]) -> None:
    """Nobody knows where its taxels are."""
    _changed("nowhere.toml", 'layout = "shank.csv"\n', "")
    ended = run("skin", "wrench", "nowhere.toml", "--table", "shank.json")
    assert ended.code == 2
    assert "layout: expected the file that says where the taxels are" in ended.err


def test_a_message_of_zeros_names_its_row(run: Run, truths: list[ContactTruth], tmp_path: Path) -> None:
    """The board had no power for a moment."""
    recording = read_recording(Path("touched"))
    stream = recording.stream("counts")
    counts = stream.signal("taxel_counts").values.copy()
    counts[400] = 0.0
    signals = {"taxel_counts": replace(stream.signal("taxel_counts"), values=counts)}
    empty = replace(recording, streams={"counts": replace(stream, signals=signals)})
    write_recording(Path("zeros"), empty)
    _changed("zeros.toml", 'path = "touched"', 'path = "zeros"')
    ended = run("skin", "wrench", "zeros.toml", "--table", "shank.json")
    assert ended.code == 2
    assert "row 400 of 'counts'" in ended.err
