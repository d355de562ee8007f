# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque skin calibrate`: what it writes, shows and refuses, and what `inspect` says of the same files."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path
from shutil import rmtree

import numpy as np
import pytest

from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import read_patch_calibration
from tests.app.outcome import Run
from tests.report.drawing import size_of
from tests.scenes.chambers import BROKEN, TAXELS, write_chambers


@pytest.fixture
def palm(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Folder with a recording to fit and one to judge by; it is the working folder."""
    write_chambers(tmp_path)
    monkeypatch.chdir(tmp_path)
    return tmp_path


CALIBRATE = ("skin", "calibrate", "fit.toml", "kept.toml", "-o", "palm.json")


def test_it_writes_curves_tables_and_a_figure(run: Run, palm: Path) -> None:
    """The result says where; JSON has every taxel, and the file those that are sound."""
    result = run(*CALIBRATE, "--table", "palm.csv", "--figure", "palm.png", "--format", "json").result()
    assert result["schema"] == "forcetorque/skin_calibrate/2"
    assert (result["valid_taxels"], result["left_out"]) == (TAXELS - len(BROKEN), len(BROKEN))
    assert len(result["taxels"]) == TAXELS
    assert (result["file"], result["figure"]) == ("palm.json", "palm.png")
    made = read_patch_calibration(palm / "palm.json")
    assert made.curve == "monotone"
    assert sum(taxel.coefficients is not None for taxel in made.taxels) == result["valid_taxels"]
    with (palm / "palm.csv").open(encoding="utf-8") as stream:
        assert len(list(csv.DictReader(stream))) == 256 * result["valid_taxels"]
    assert size_of((palm / "palm.png").read_bytes())[0] == 1200


def test_the_curve_is_chosen_by_name(run: Run, palm: Path) -> None:
    """Another form is kept; the comparison has all five all the same."""
    result = run(*CALIBRATE, "--curve", "polynomial", "--highest-kpa", "50", "--format", "json").result()
    assert result["curve"] == "polynomial"
    assert result["highest_kPa"] == pytest.approx(50.0, rel=0.01)
    assert {row["curve"] for row in result["candidates"]} == {
        "monotone",
        "line",
        "polynomial",
        "capacitor",
        "logarithmic",
    }
    assert read_patch_calibration(palm / "palm.json").table().falls().any()


def test_rows_are_taxels(run: Run, palm: Path) -> None:
    """CSV has a line for each, with why it was left out."""
    rows = run(*CALIBRATE, "--format", "csv").rows()
    assert [int(row["taxel"]) for row in rows] == list(range(TAXELS))
    assert "never moves" in rows[4]["left_out"]


def test_without_a_recording_that_was_kept_back_it_says_so(run: Run, palm: Path) -> None:
    """A warning, and no comparison."""
    ended = run("skin", "calibrate", "fit.toml", "-o", "palm.json", "--format", "json")
    assert ended.result()["candidates"] == []
    assert any("no interval for validation" in line for line in ended.log)


def test_bad_input_is_one_line(run: Run, palm: Path) -> None:
    """Outputs are refused before anything is read, a message of zeros by its row, a file twice by its name."""
    forced = run("skin", "calibrate", "fit.toml", "-o", "fit.toml", "--force")
    assert "fit.toml: expected a file to write that is not read, got an input" in forced.error()
    assert "expected an existing folder" in run("skin", "calibrate", "fit.toml", "-o", "none/palm.json").error()
    assert "ends in .png" in run(*CALIBRATE, "--figure", "palm.jpg").error()
    assert "fit.toml" in run("skin", "calibrate", "fit.toml", "fit.toml", "-o", "palm.json").error()
    assert "expected an experiment file, there is none" in run("skin", "calibrate", "no.toml", "-o", "a.json").error()
    assert not (palm / "palm.json").exists()
    recording = read_recording(palm / "fit")
    counts = recording.streams["counts"].signals["taxel_counts"].values.copy()
    counts[77] = 0.0
    _store(palm / "fit", counts)
    assert "row 77 of 'counts': expected counts, got a message of zeros (1 such" in run(*CALIBRATE).error()


def _store(folder: Path, counts: np.ndarray) -> None:
    recording = read_recording(folder)
    stream = recording.streams["counts"]
    signal = replace(stream.signals["taxel_counts"], values=counts)
    changed = replace(stream, signals={"taxel_counts": signal})
    rmtree(folder)
    write_recording(folder, replace(recording, streams={**recording.streams, "counts": changed}))


def test_inspect_names_broken_taxels(run: Run, palm: Path) -> None:
    """A finding for every fault, with the taxels that have it; a file of a patch alone is enough."""
    findings = run("inspect", "fit.toml", "--format", "json").result()["findings"]
    messages = {finding["kind"]: finding["message"] for finding in findings}
    for taxel, fault in BROKEN.items():
        assert str(taxel) in messages[f"taxel_{fault.name.lower()}"].partition("'cycle': ")[2].split(", ")


@pytest.mark.parametrize(
    "words",
    [
        ("calibrate", "fit.toml", "-o", "new.json"),
        ("bench", "gains", "fit.toml"),
        ("payload", "fit.toml"),
        ("plan", "fit.toml"),
        ("study", "sphere", "fit.toml"),
        ("study", "fits", "fit.toml", "-o", "study"),
        ("estimate", "fit.toml", "-o", "contacts.csv"),
    ],
)
def test_other_commands_refuse_a_patch_alone(run: Run, palm: Path, words: tuple[str, ...]) -> None:
    """In one line that says which commands read it."""
    error = run(*words).error()
    assert "fit.toml: expected [[sensor]], a force-torque sensor, got patches of skin only; `forcetorque skin`" in error


@pytest.mark.parametrize(
    "words", [("view", "fit.toml", "-o", "view.html"), ("report", "fit.toml", "-o", "report.html")]
)
def test_a_patch_that_is_on_no_link_is_not_shown(run: Run, palm: Path, words: tuple[str, ...]) -> None:
    """What shows patches alone needs to know on which link each is."""
    assert "fit.toml: expected [robot], or skin on links of some name: a [[patch]] with link" in run(*words).error()


def _as_bag(folder: Path, *, stated: bool, scale: float = 1.0) -> None:
    """Rewrite both logs with a gauge that reads the air left in a bag."""
    for name in ("fit", "kept"):
        log = read_recording(folder / name)
        chamber = log.streams["chamber"]
        signal = chamber.signal("pressure")
        left = replace(signal, values=101325.0 - scale * signal.values)
        rmtree(folder / name)
        chamber = replace(chamber, signals={"pressure": left})
        write_recording(folder / name, replace(log, streams={**log.streams, "chamber": chamber}))
        if stated:
            file = folder / f"{name}.toml"
            text = file.read_text(encoding="utf-8")
            file.write_text(text.replace('serial = "P7"', 'serial = "P7"\npressure_of = "bag"'), encoding="utf-8")


def test_a_vacuum_bag_gives_the_curves_of_the_chamber(run: Run, palm: Path) -> None:
    """Its gauge falls from the pressure of the air by what the skin feels; the logarithmic form is one of five."""
    asked = (*CALIBRATE, "--curve", "logarithmic", "--format", "json")
    chamber = run(*asked, "--force").result()
    _as_bag(palm, stated=True)
    bag = run(*asked, "--force").result()
    assert bag["highest_kPa"] == pytest.approx(chamber["highest_kPa"], rel=1e-6)
    assert len(bag["candidates"]) == len(chamber["candidates"]) > 0
    for one, other in zip(bag["candidates"], chamber["candidates"], strict=True):
        assert one["curve"] == other["curve"]
        assert one["inside_kPa"] == pytest.approx(other["inside_kPa"], rel=1e-6)


def test_a_bag_is_never_guessed(run: Run, palm: Path) -> None:
    """A pressure that falls from rest is refused with the key; one that falls by more than air presses, too."""
    _as_bag(palm, stated=False)
    assert 'state pressure_of = "bag"' in run(*CALIBRATE).error()
    _as_bag(palm, stated=True, scale=-10.0)
    assert "expected a bag that is at most emptied" in run(*CALIBRATE).error()
