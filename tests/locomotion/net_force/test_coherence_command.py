# SPDX-License-Identifier: BSD-3-Clause
"""`coherence` and `estimate --offset`, typed, and the script of docs/locomotion/coherence.md."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.app.python.experiment import load_experiment
from forcetorque.experiment.calibration.calibration_file import write_calibration
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario
from tests.app.outcome import Run
from tests.page_scripts import unmarked
from tests.scenes.switchings import short_switching

PAGE = Path(__file__).parents[3] / "docs" / "locomotion" / "coherence.md"
FEET = ("l_foot_ft", "r_foot_ft")
DAY = "simulated/switching_day2.toml"


pytestmark = pytest.mark.long


@pytest.fixture(scope="module")
def walked(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with two simulated days and a folder of calibrations of the first."""
    folder = tmp_path_factory.mktemp("walked")
    content = short_switching(names=FEET)
    recordings = tuple(
        entry.model_copy(update={"motion": entry.motion.model_copy(update={"still_s": 2.0})})
        for entry in content.recording
    )
    write_scenario(build_scenario(content.model_copy(update={"recording": recordings})), folder / "simulated")
    day = folder / DAY
    text = day.read_text(encoding="utf-8")
    for label in ("double_1", "double_3"):  # for time
        head, tail = text.split(f'label = "{label}"')
        text = f'{head}label = "{label}"{tail.replace("validation", "ignore", 1)}'
    day.write_text(text, encoding="utf-8")
    experiment = load_experiment(folder / "simulated" / "switching_day1.toml")
    (folder / "feet").mkdir()
    for name in FEET:
        write_calibration(folder / "feet" / f"{name}.json", experiment[name].calibrate())
    return folder


@pytest.fixture
def inside(walked: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The folder, as the working folder."""
    monkeypatch.chdir(walked)
    return walked


def test_a_folder_of_calibrations_stands_beside_the_prior(inside: Path, run: Run) -> None:
    """Smaller errors than the prior's on the day that was not fitted; a picture is drawn where it is asked."""
    outcome = run(
        "robot",
        "coherence",
        DAY,
        "-c",
        "feet",
        "--offset",
        "one-link-imu:hanging",
        "--figure",
        "a.png",
        "--format",
        "json",
    )
    result = outcome.result()
    assert result["schema"] == "forcetorque/coherence/2"
    assert result["figure"] == "a.png"
    assert (inside / "a.png").read_bytes().startswith(b"\x89PNG")
    means = {row["calibration"]: row["force_error_mean_N"] for row in result["summary"]}
    assert list(means) == ["prior", "feet"]
    assert means["feet"] < 0.3 * means["prior"]
    assert [row["worse_than_prior"] for row in result["summary"]] == [None, False]
    assert [row["phase"] for row in result["rows"] if not row["evidence"]] == ["hanging", "hanging"]


def test_files_are_one_candidate_and_a_lone_one_says_what_it_lacks(inside: Path, run: Run) -> None:
    """Two files are called by what they are, one by its name; one alone leaves the other foot to the prior."""
    from forcetorque.calibration.joint.calibrate import read_candidates

    files = [Path("feet") / f"{name}.json" for name in FEET]
    candidates = read_candidates([*files, Path("feet")])
    assert list(candidates) == ["calibrations", "feet"]
    assert list(candidates["calibrations"]) == list(candidates["feet"]) == [str(file) for file in files]
    one = run("robot", "coherence", DAY, "-c", files[0], "--details")
    assert one.code == 0
    assert "has no calibration of r_foot_ft" in one.err
    # a matrix that errs by a sixth of the weight is judged, not refused
    assert "beyond 'r_foot_ft': a sensor errs by as much, or another link touches" in one.err
    assert "\n\noffset one-link-imu:hanging; weight" in one.out


def test_what_cannot_be_is_one_line(inside: Path, run: Run) -> None:
    """A folder without calibrations, an offset that is no way, a picture that is none."""
    (inside / "empty").mkdir(exist_ok=True)
    assert "holds none" in run("robot", "coherence", DAY, "-c", "empty").error()
    assert "no way is called 'imu'" in run("robot", "coherence", DAY, "--offset", "imu:hanging").error()
    assert "ends in .png" in run("robot", "coherence", DAY, "--figure", "a.jpg").error()
    assert "no interval is labelled 'left'" in run("estimate", DAY, "-o", "a.csv", "--offset", "tare:left").error()


def test_estimate_takes_offsets_and_says_where_there_is_none(inside: Path, run: Run) -> None:
    """The readings name the way; with `none` a warning does."""
    outcome = run("estimate", DAY, "-o", "a.csv", "--offset", "one-link-imu:hanging", "--format", "json")
    taken = outcome.result()
    assert all(words.endswith("offset one-link-imu:hanging") for words in taken["wrench_sources"].values())
    assert "no offset removed" not in outcome.err
    # a file of validation intervals alone gives the prior no offset
    left = run("estimate", DAY, "-o", "a.csv", "--details").err
    assert all(f"{name}: no offset removed" in left for name in FEET)
    forces = {row["interval"]: row["force_mean_N"] for row in taken["contacts"] if row["contact"] == row["interval"]}
    assert set(forces) == {"l_sole", "r_sole"}
    assert all(250.0 < force < 360.0 for force in forces.values())


def test_the_script_of_the_page_runs(inside: Path) -> None:
    """It gives what `analysis.coherence` does."""
    from forcetorque.locomotion.net_force.result import Coherence

    (code,) = unmarked(PAGE.read_text(encoding="utf-8"))
    names: dict[str, object] = {}
    exec(compile(code, "coherence.md", "exec"), names)
    result = names["result"]
    assert isinstance(result, Coherence)
    assert len(result.summary) == 4
    assert all(np.isfinite(row.force_error_N).all() for row in result.rows)
