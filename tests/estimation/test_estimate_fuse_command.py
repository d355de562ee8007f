# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque estimate --fuse`: torques of every source, fused, in the file and in the answer."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET
from tests.scenes.motors import DRIVEN, FUSION, with_motors


def test_torques_of_all_sources_are_in_the_file(arm: Path, run: Run) -> None:
    """A column per source and joint, all together with half of its interval, and the tables say the same."""
    with_motors(arm)
    words = ("estimate", PARQUET, "-o", "out.parquet", "-c", "fitted.json", "--fuse")
    result = run(*words, "--format", "json").result()
    assert faults(result, run("schema", "estimate").result()) == []
    table = pq.read_table("out.parquet")
    for name in ("ft", "current", "fused", "fused_half_width"):
        for joint in DRIVEN:
            assert table.schema.field(f"torque_{name}.{joint}").metadata[b"unit"] == b"N m"
    fit = np.array(table.column("interval").to_pylist()) == "fit"
    (row,) = (
        row
        for row in result["fusion"]["torques"]
        if (row["interval"], row["joint"], row["source"]) == ("fit", "shoulder_roll", "fused")
    )
    assert table.column("torque_fused.shoulder_roll").to_numpy()[fit].mean() == row["mean"]
    shown = run(*words, "--figure", "torques.png", "--details").out
    assert shown.splitlines().count("drawn to torques.png") == 1
    assert Path("torques.png").read_bytes().startswith(b"\x89PNG")
    assert "sources of joint torques" in shown
    assert "at most 1.0% of intervals" in shown


def test_what_is_missing_is_one_line(arm: Path, run: Run) -> None:
    """A known error, with the key to state, and no file."""
    file = with_motors(arm)
    file.write_text(file.read_text(encoding="utf-8").replace(FUSION, ""), encoding="utf-8")
    outcome = run("estimate", PARQUET, "-o", "out.parquet", "-c", "fitted.json", "--fuse", "--figure", "torques.jpg")
    assert "--figure torques.jpg: expected a name that ends in .png" in outcome.error()
    outcome = run("estimate", PARQUET, "-o", "out.parquet", "-c", "fitted.json", "--fuse")
    assert outcome.code == 2
    assert "expected [fusion] with model_deviation" in outcome.err
    assert not Path("out.parquet").exists()
