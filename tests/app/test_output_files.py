# SPDX-License-Identifier: BSD-3-Clause
"""Files that commands write: standard output in place of a file, and outputs that are no files."""

from __future__ import annotations

from pathlib import Path

import pytest

from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, snapshot


def test_an_export_goes_to_standard_output_alone(arm: Path, run: Run) -> None:
    """Byte for byte what a file gets; no table is mixed in, and what the file does not hold is still said."""
    words = ("export", "fitted.json", "--to", "icub-matrix", "-o")
    assert run(*words, "file.txt").code == 0
    before = snapshot(arm)
    ended = run(*words, "-")
    assert ended.code == 0
    assert ended.out.encode() == Path("file.txt").read_bytes()
    assert any("not stored, a matrix file has no place for it" in line for line in ended.log)
    assert snapshot(arm) == before


def test_a_page_goes_to_standard_output_alone(arm: Path, run: Run) -> None:
    """It is the page from its first byte to its last."""
    assert run("view", PARQUET, "-o", "page.html").code == 0
    before = snapshot(arm)
    assert run("view", PARQUET, "-o", "-").out.encode() == Path("page.html").read_bytes()
    assert snapshot(arm) == before


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (
            "export fitted.json --to csv -o - --format json",
            "--output -: expected a file name beside --format json, got standard output for both",
        ),
        (f"view {PARQUET} -o - --format csv", "--output -: expected a file name beside --format csv"),
        (f"view {PARQUET} --video -", "--video -: expected a name, standard output takes the result only"),
        (f"calibrate {PARQUET} -o -", "--output -: expected a name, standard output takes the result only"),
        ("simulate icub-insitu -o -", "--output -: expected a name, standard output takes the result only"),
        (f"study fits {PARQUET} -o -", "--output -: expected a name, standard output takes the result only"),
        (f"estimate {PARQUET} -o -", "--output -: expected a name that ends in .parquet or .csv"),
        (f"report {PARQUET} -o -", "--output -: expected a name that ends in .html or .pdf"),
        (f"bench gains {PARQUET} --figure -", "--figure -: expected a name that ends in .png or .svg or .pdf"),
        ("export fitted.json --to csv -o round", "Too many levels of symbolic links: 'round'"),
        (f"view {PARQUET} -o round", "Too many levels of symbolic links: 'round'"),
        (f"calibrate {PARQUET} -o round.json", "Too many levels of symbolic links: 'round.json'"),
        (f"estimate {PARQUET} -o round.csv", "Too many levels of symbolic links: 'round.csv'"),
        (f"report {PARQUET} -o round.html", "Too many levels of symbolic links: 'round.html'"),
        (f"bench gains {PARQUET} --figure round.png", "Too many levels of symbolic links: 'round.png'"),
        (f"study fits {PARQUET} -o round", "--output round: expected a new folder, it is there already"),
        ("export round --to csv -o new.csv", "round: expected a calibration file, there is none"),
        ("report round -o new.html", "round"),
        ("study fits round round.csv -o new", "round"),
    ],
)
def test_an_output_that_makes_no_sense_is_one_line(arm: Path, run: Run, words: str, message: str) -> None:
    """Exit code 2, and nothing is written."""
    for name in ("round", "round.json", "round.csv", "round.html", "round.png"):
        Path(name).symlink_to(name)
    before = snapshot(arm)
    assert message in run(*words.split()).error()
    assert snapshot(arm) == before
