# SPDX-License-Identifier: BSD-3-Clause
"""`--view` beside results: what `view` writes of the same files, with the verdicts and the options of the command."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment import loading
from forcetorque.formats.ros.bag import opened_bag, typestore
from tests.app.outcome import Run
from tests.formats.ur_rtde.recordings import Tool, recorded, write_text
from tests.scenes.experiments import PARQUET
from tests.viewer.test_rerun_file import rrd_columns

pytest.importorskip("rosbags")
SOLVER_ROUNDING = 1e-9
"""N, N m: sums of wrenches of some 60 N in another order, at 1e-16 times the condition number."""


def _topics(file: Path) -> dict[str, int]:
    with opened_bag(file) as bag:
        return {topic: sum(len(stamps) for stamps, _ in bag.messages(topic)) for topic in bag.types}


def _events(file: Path) -> list[str]:
    types = typestore(file)
    with opened_bag(file) as bag:
        rows = [row for _, data in bag.messages("/rosout") for row in data]
        return [types.deserialize_cdr(row, bag.types["/rosout"]).msg for row in rows]


def _forces(file: Path, topic: str) -> FloatArray:
    """Forces of a topic; shape (n, 3); N."""
    types = typestore(file)
    with opened_bag(file) as bag:
        rows = [row for _, data in bag.messages(topic) for row in data]
        forces = [types.deserialize_cdr(row, bag.types[topic]).wrench.force for row in rows]
    return np.array([[force.x, force.y, force.z] for force in forces])


def _series(file: Path, name: str) -> tuple[list[int], FloatArray]:
    """Stamps of a wrench, and its numbers, shape (n, 6), as the library of the form reads them."""
    if file.suffix == ".rrd":
        columns = rrd_columns(file)[0]
        force, moment = (columns[f"/{name}/{half}"] for half in ("force", "torque"))
        assert force["time"] == moment["time"]
        return force["time"], np.hstack([half["Scalars:scalars"] for half in (force, moment)])
    types = typestore(file)
    with opened_bag(file) as bag:
        stamps, data = zip(*bag.messages(f"/{name}"), strict=True)
        wrenches = [types.deserialize_cdr(row, bag.types[f"/{name}"]).wrench for rows in data for row in rows]
    halves = (half for wrench in wrenches for half in (wrench.force, wrench.torque))
    return np.concatenate(stamps).tolist(), np.array([[half.x, half.y, half.z] for half in halves]).reshape(-1, 6)


def test_an_evaluation_is_written_for_viewers(run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Errors over time are topics; the verdict that is printed is an event; the log is read once."""
    logs: list[Path] = []
    read = loading.read_streams
    monkeypatch.setattr(loading, "read_streams", lambda *given: logs.append(given[1]) or read(*given))
    ended = run("evaluate", PARQUET, "-c", "fitted.json", "--view", "evaluated.mcap")
    assert ended.code == 0, ended.err
    assert any(line.startswith("INFO: written: evaluated.mcap, ") for line in ended.log)
    assert logs == [Path(PARQUET)]
    topics = _topics(arm / "evaluated.mcap")
    assert topics["/arm_ft/fitted_json/error"] > 0
    assert "/arm_ft/fitted_json/error.wrench.force.x" in (arm / "evaluated.foxglove.json").read_text(encoding="utf-8")
    assert "/hand/contact" not in topics
    (verdict,) = (text for text in _events(arm / "evaluated.mcap") if text.startswith("evaluate: "))
    subject, *_, decision = ended.out.splitlines()[0].split("  ")
    assert verdict.startswith(f"evaluate: {subject}: {decision.strip()}; ")


def test_a_load_is_written_for_viewers(run: Run, tmp_path: Path) -> None:
    """Of a log alone: what the arm measured, less the bias, is what the tool must weigh, within the noise."""
    tool, file = Tool(), tmp_path / "tool.mcap"
    log = write_text(tmp_path / "log.txt", recorded(tool, poses=10, samples=4, raw=True))
    ended = run("payload", log, "--view", file)
    assert ended.code == 0, ended.err
    expected, logged, error = (_forces(file, f"/wrist/{name}") for name in ("expected", "logged", "logged/error"))
    np.testing.assert_allclose(np.linalg.norm(expected, axis=1), tool.mass * STANDARD_GRAVITY, rtol=0.01)
    np.testing.assert_allclose(error, logged - expected, atol=1e-5)
    assert np.sqrt((error**2).mean()) < 0.2
    assert any(text.startswith("payload: wrist (not stated): 1.2") for text in _events(file))
    assert (tmp_path / "tool.foxglove.json").is_file()


@pytest.mark.long
@pytest.mark.parametrize("ending", ["mcap", "rrd"])
def test_estimates_read_back_as_their_samples(run: Run, arm: Path, ending: str) -> None:
    """Contact, expected and measured wrenches at the stamps of the written samples; the error is their difference."""
    if ending == "rrd":
        pytest.importorskip("rerun")
    file = arm / f"view.{ending}"
    ended = run("estimate", PARQUET, "-c", "fitted.json", "-o", "samples.parquet", "--view", file)
    assert ended.code == 0, ended.err
    samples = pq.read_table(arm / "samples.parquet")
    read = {}
    for column, name in {
        "contact.arm_ft": "arm_ft/contact",
        "contact.base": "base/contact",
        "expected.arm_ft": "arm_ft/expected",
        "measured.arm_ft": "arm_ft/fitted_json",
    }.items():
        stamps, values = _series(file, name)
        rows = np.searchsorted(stamps, samples["stamp_ns"])  # the measurement goes on between intervals
        written = np.column_stack([samples[f"{column}.{component}"] for component in WRENCH_COMPONENTS])
        assert np.array(stamps)[rows].tolist() == samples["stamp_ns"].to_pylist()
        np.testing.assert_allclose(values[rows], written, atol=SOLVER_ROUNDING)
        assert np.abs(values[rows][1:] - written[:-1]).max() > 0.01  # negative control: the sample before
        read[column] = values[rows]
    stamps, error = _series(file, "arm_ft/fitted_json/error")
    assert stamps == samples["stamp_ns"].to_pylist()
    np.testing.assert_allclose(error, read["measured.arm_ft"] - read["expected.arm_ft"], atol=SOLVER_ROUNDING)


@pytest.mark.long
def test_an_evaluation_in_rerun_reads_back_as_in_mcap(run: Run, arm: Path) -> None:
    """The same stamps, errors to the last bit, and verdict."""
    pytest.importorskip("rerun")
    for ending in ("mcap", "rrd"):
        assert run("evaluate", PARQUET, "-c", "fitted.json", "--view", f"view.{ending}").code == 0
    for name in ("arm_ft/fitted_json/error", "arm_ft/prior/error"):
        (mcap_stamps, mcap_values), (stamps, values) = (_series(arm / f"view.{end}", name) for end in ("mcap", "rrd"))
        assert len(stamps) > 100
        assert stamps == mcap_stamps
        np.testing.assert_array_equal(values, mcap_values)
    texts = [text for (text,) in rrd_columns(arm / "view.rrd")[0]["/events"]["TextLog:text"]]
    assert sorted(texts) == sorted(_events(arm / "view.mcap"))


@pytest.mark.long
def test_contacts_are_those_that_are_estimated(run: Run, arm: Path) -> None:
    """A contact that an option names has its wrench, in place of that at the sensor."""
    words = ("--contacts", "hand:force", "-o", "samples.csv", "--view", "named.mcap")
    ended = run("estimate", PARQUET, "-c", "fitted.json", *words)
    assert ended.code == 0, ended.err
    topics = _topics(arm / "named.mcap")
    assert topics["/hand/contact"] > 0
    assert "/arm_ft/contact" not in topics


@pytest.mark.parametrize(
    ("view", "message"),
    [
        ("view.txt", "--view view.txt: expected a name that ends in .rrd, .mcap, .html"),
        ("other.mcap", "other.foxglove.json: expected a new file, or a result or figure to replace, got another"),
        ("nowhere/view.mcap", "nowhere/view.mcap: expected an existing folder to write to"),
    ],
)
def test_what_cannot_be_written_is_refused_first(run: Run, arm: Path, view: str, message: str) -> None:
    """One line, before anything is computed."""
    (arm / "other.foxglove.json").write_text("{}", encoding="utf-8")
    assert message in run("evaluate", PARQUET, "-c", "gone.json", "--view", view).error()


def test_a_dataset_has_no_samples_to_show(run: Run, arm: Path) -> None:
    """A folder in place of experiment files is refused."""
    (arm / "dataset").mkdir()
    error = run("evaluate", "dataset", "-c", "fitted.json", "--view", "view.mcap").error()
    assert "--view view.mcap: expected experiment files, whose samples it needs, got dataset" in error


@pytest.mark.long
def test_several_experiments_have_a_file_each(run: Run, arm: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Named as those of samples, with one verdict; every log is read once, also where the files are there already."""
    logs: list[Path] = []
    read = loading.read_streams
    monkeypatch.setattr(loading, "read_streams", lambda *given: logs.append(given[1]) or read(*given))
    (arm / "again.toml").write_bytes((arm / PARQUET).read_bytes())
    words = ("estimate", PARQUET, "again.toml", "-c", "fitted.json", "-o", "samples.parquet", "--view", "view.mcap")
    for more in ((), ("--force",)):
        assert run(*words, *more).code == 0
    names = {file.name for file in arm.glob("view.*.mcap")}
    assert names == {"view.parquet.mcap", "view.again.mcap"}
    assert len(logs) == 2 * 2
    assert sum(text.startswith("estimate: ") for text in _events(arm / "view.again.mcap")) == 1
    assert "--view" not in run("inspect", "--help").out
