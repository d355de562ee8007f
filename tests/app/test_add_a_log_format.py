# SPDX-License-Identifier: BSD-3-Clause
"""A format of logs is one file and one line: schema, loading, `inspect` and their messages know it from then on.

This is the recipe of docs/architecture.md, followed with `tests/toys/log.py`.
"""

from __future__ import annotations

import hashlib
import tomllib
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.loading import load_experiment
from forcetorque.formats import registry as formats
from forcetorque.recording.storage import read_recording
from tests.app.json_schema import faults
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, YARP, edit
from tests.toys.log import FILE, write_toy

TOY = 'format = "toy"\npath = "toy"\nstream = ["arm_ft", "joints"]\n'


@pytest.fixture
def added(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """The line of the registry."""
    with monkeypatch.context() as patch:
        patch.setattr(formats, "LOG_FORMATS", {**formats.LOG_FORMATS, "toy": "tests.toys.log:ToyFormat"})
        yield


@pytest.fixture
def toy(arm: Path) -> Path:
    """The arm's experiment with its log in the form of the toy."""
    write_toy(arm / "toy", read_recording(arm / "recording"))
    return edit(arm / PARQUET, 'format = "parquet"\npath = "recording"\n', TOY)


@pytest.mark.usefixtures("added")
def test_an_experiment_is_loaded_from_it(arm: Path, toy: Path) -> None:
    """The streams are those of the log, its findings arrive, and its file is an input and a log by its hash."""
    loaded = load_experiment(toy)
    whole = read_recording(arm / "recording")
    assert list(loaded.recording.streams) == ["arm_ft", "joints"]
    for name, stream in loaded.recording.streams.items():
        assert stream.clock == "toy"
        np.testing.assert_array_equal(stream.stamp_ns, whole.stream(name).stamp_ns)
        (signal,) = stream.signals.values()
        np.testing.assert_array_equal(signal.values, whole.stream(name).signal(signal.quantity).values)
    assert [finding.kind for finding in loaded.recording.findings] == ["toy"]
    digest = hashlib.sha256((arm / "toy" / FILE).read_bytes()).hexdigest()
    assert loaded.inputs_sha256[f"toy/{FILE}"] == digest
    assert loaded.log_sha256 == {digest}


@pytest.mark.usefixtures("added")
def test_the_schema_has_its_table(run: Run, toy: Path) -> None:
    """Files of the new format fit, damaged ones do not, and those of the other formats still do."""
    schema = run("schema", "experiment").result()
    known = set(schema["properties"]["recording"]["discriminator"]["mapping"])
    assert known == {*formats.LOG_FORMATS} >= {"yarp", "matlab", "toy"}
    content = tomllib.loads(toy.read_text(encoding="utf-8"))
    assert faults(content, schema) == []
    assert faults({**content, "recording": {**content["recording"], "stream": []}}, schema) != []
    assert faults(tomllib.loads((toy.parent / YARP).read_text(encoding="utf-8")), schema) == []


@pytest.mark.usefixtures("added")
@pytest.mark.parametrize("log", ["toy", f"toy/{FILE}"])
def test_it_is_inspected(run: Run, toy: Path, log: str) -> None:
    """By its folder, or by the file, as a format of single files would be."""
    result = run("inspect", toy.parent / log, "--format", "json").result()
    assert set(result["streams"]) == {"arm_ft", "joints", "tool_ft"}
    assert [finding["kind"] for finding in result["findings"]] == ["toy"]


@pytest.mark.usefixtures("added")
def test_messages_name_it(run: Run, toy: Path, arm: Path) -> None:
    """An unknown format, an unknown key of its table, a folder of no log and one of two."""
    edit(arm / YARP, 'format = "yarp"', 'format = "rosbag"')
    names = ", ".join(map(repr, formats.LOG_FORMATS))
    assert names.endswith(", 'toy'")
    assert names in run("inspect", arm / YARP).error()
    (arm / "empty").mkdir()
    error = run("inspect", "empty").error()
    assert "expected ports with data.log, or recording.json, or " in error
    assert f", or {FILE}; found none" in error
    (arm / "recording" / FILE).write_text("{}", encoding="utf-8")
    both = run("inspect", "recording").error()
    assert f"recording: expected a log of one format, got signs of parquet and toy (recording.json, {FILE})" in both
    edit(toy, "stream = [", "streams = [")
    assert (
        "recording: unknown key 'streams'; did you mean \"stream\"? known: continued_in, format, path"
        in run("inspect", toy).error()
    )


def test_without_the_line_nobody_knows_it(run: Run, toy: Path) -> None:
    """Negative control: it is the line that does it."""
    content = tomllib.loads(toy.read_text(encoding="utf-8"))
    assert faults(content, run("schema", "experiment").result()) != []
    assert "recording.format: expected one of 'yarp', " in run("inspect", toy).error()
    error = run("inspect", "toy").error()
    assert "expected ports with data.log, or recording.json, or " in error
    assert f"{FILE}; found none" not in error
    assert "toy.json: expected ports with data.log" in run("inspect", f"toy/{FILE}").error()
