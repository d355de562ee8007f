# SPDX-License-Identifier: BSD-3-Clause
"""What was saved in the page becomes a table of joint configurations, and intervals that an experiment accepts."""

from __future__ import annotations

import csv
import io
import tomllib
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings, strategies as st
from pydantic import ValidationError

from forcetorque.base.errors import ForceTorqueError
from forcetorque.experiment.loading import load_experiment
from forcetorque.viewer.annotations import Annotations, intervals_toml, samples_csv, save_annotations
from forcetorque.viewer.scene_arrays import read_array
from forcetorque.viewer.scene_builder import BuiltScene, build_scene
from tests.fuzzing import examples
from tests.payload.test_wrist_load import _write as write_wrist
from tests.scenes.experiments import JOINTS, PARQUET, add, edit


def _sample(sample: int, **other: Any) -> dict[str, Any]:
    return {"sample": sample, "time_s": 0.0, "mark": "point", "label": "", "use": "ignore"} | other


def _interval(start_s: float, end_s: float, **other: Any) -> dict[str, Any]:
    return {"label": "new", "start_s": start_s, "end_s": end_s, "use": "validation"} | other


def _saved(samples: list[dict[str, Any]], intervals: list[dict[str, Any]]) -> Annotations:
    return Annotations.model_validate({"samples": samples, "intervals": intervals})


@pytest.mark.long
def test_samples_have_their_posture_in_degrees(built: BuiltScene) -> None:
    """A row per saved sample: number, time, mark, label and every joint, as in Table 4.2 of the thesis."""
    saved = _saved([_sample(3, mark="begin", label='covers, "touch"'), _sample(700, mark="end")], [])
    rows = list(csv.reader(io.StringIO(samples_csv(saved, built))))
    assert rows[0] == ["sample", "time_s", "mark", "label", *(f"{joint}_deg" for joint in JOINTS)]
    assert [row[:1] + row[2:4] for row in rows[1:]] == [["3", "begin", 'covers, "touch"'], ["700", "end", ""]]
    positions, times = (read_array(built.block, ref) for ref in (built.scene.positions, built.scene.time_s))
    for row, sample in zip(rows[1:], (3, 700), strict=True):
        assert float(row[1]) == pytest.approx(times[sample], abs=1e-9)
        shown = np.deg2rad([float(cell) for cell in row[4:]])
        np.testing.assert_allclose(shown, positions[sample], rtol=0, atol=1e-6)


def test_a_sample_that_is_not_there_is_refused(built: BuiltScene) -> None:
    """The page of another recording does not write postures of this one."""
    with pytest.raises(ForceTorqueError, match=f"sample 99999: expected a number below {built.scene.samples}"):
        samples_csv(_saved([_sample(99_999)], []), built)


@pytest.mark.parametrize(
    ("interval", "support"),
    [
        (_interval(1.0, 2.0), "base"),
        (_interval(0.5, 14.0), "base"),
        (_interval(1.0, 2.0, use="ignore"), "base"),
        (_interval(13.0, 15.0), None),
        (_interval(14.1, 14.2), None),
        (_interval(23.0, 23.49), "base"),
        (_interval(23.0, 23.8), None),
    ],
)
def test_the_support_is_that_of_the_interval_around(
    built: BuiltScene, interval: dict[str, Any], support: str | None
) -> None:
    """It is copied where an interval of the experiment holds the new one, and asked for where none does."""
    text = intervals_toml(_saved([], [interval]), built)
    (table,) = tomllib.loads(text)["interval"]
    assert table == interval | ({} if support is None else {"support": support})
    assert 23.8 < built.scene.end_s < 24.0, "the last one goes beyond the intervals, not beyond the log"
    assert ("state the link that stands still" in text) == (support is None)


def test_an_experiment_accepts_the_intervals(arm: Path, built: BuiltScene) -> None:
    """Appended to the experiment file, in place of the one that they divide, they are what was marked."""
    new = [_interval(1.0, 2.5, label="a"), _interval(3.0, 4.25, label='"b"\\ \n\x7f é', use="ignore")]
    text = intervals_toml(_saved([], new), built)
    edit(arm / PARQUET, "start_s = 0.5\nend_s = 14.0", "start_s = 5.0\nend_s = 14.0")
    experiment = load_experiment(add(arm / PARQUET, text))
    start = experiment.recording.start_ns
    found = {i.label: ((i.start_ns - start) * 1e-9, (i.end_ns - start) * 1e-9) for i in experiment.recording.intervals}
    assert found["a"] == pytest.approx((1.0, 2.5), abs=1e-8)
    assert found['"b"\\ \n\x7f é'] == pytest.approx((3.0, 4.25), abs=1e-8)


def test_an_interval_to_the_last_sample_ends_with_the_log(arm: Path, built: BuiltScene) -> None:
    """A period after the last sample is later than the log; the experiment file takes what is written, not that."""
    late = built.scene.end_s + 0.02
    text = intervals_toml(_saved([], [_interval(20.0, late, use="ignore")]), built)
    (interval,) = tomllib.loads(text)["interval"]
    assert interval["end_s"] == pytest.approx(built.scene.end_s, abs=1e-9)
    original = (arm / PARQUET).read_text(encoding="utf-8")
    experiment = load_experiment(add(arm / PARQUET, text))
    assert experiment.recording.intervals[-1].end_ns == experiment.recording.span_ns[1] + 1, "the last sample is inside"
    (arm / PARQUET).write_text(original, encoding="utf-8")
    with pytest.raises(ForceTorqueError, match="expected a span inside the log"):  # the check can fail
        load_experiment(add(arm / PARQUET, text.replace(str(interval["end_s"]), str(late))))
    with pytest.raises(ForceTorqueError, match="a start inside the log"):
        intervals_toml(_saved([], [_interval(late, late + 1.0)]), built)


@pytest.mark.long
def test_a_wrist_sensor_states_no_support(tmp_path: Path) -> None:
    """Its own frame carries it in every interval, and the experiment file knows no other."""
    file = write_wrist(tmp_path)
    built = build_scene(load_experiment(file), {})
    assert [interval.support for interval in built.scene.intervals] == ["tool", "tool"]
    text = intervals_toml(_saved([], [_interval(3.0, 5.0, use="ignore")]), built)
    assert "support" not in text
    experiment = load_experiment(add(file, text))
    assert experiment.recording.intervals[-1].label == "new"
    assert "support" not in intervals_toml(_saved([], [_interval(39.5, 40.5)]), built)


def test_what_would_be_used_twice_is_named(arm: Path, built: BuiltScene) -> None:
    """A comment says which interval of the experiment must give way; one that is ignored may lie anywhere."""
    text = intervals_toml(_saved([], [_interval(13.0, 14.0), _interval(13.0, 15.0, label="b", use="ignore")]), built)
    assert text.count("# overlaps") == 1
    assert '# overlaps "fit": shorten those' in text
    assert "# overlaps" not in intervals_toml(_saved([], [_interval(14.0, 14.5)]), built)
    with pytest.raises(ForceTorqueError, match="'fit' .* and 'new' .* overlap"):
        load_experiment(add(arm / PARQUET, text))


@given(st.text(max_size=200), st.floats(-1e6, 20.0))
@settings(max_examples=examples(50))
def test_any_label_survives_toml(built: BuiltScene, label: str, start: float) -> None:
    """Quotes, control characters, emoji: what is read is what was written; times to the nanosecond."""
    if any(0xD800 <= ord(character) < 0xE000 for character in label):
        return  # no text of JSON
    text = intervals_toml(_saved([], [_interval(start, start + 1.0, label=label)]), built)
    (table,) = tomllib.loads(text.encode().decode())["interval"]
    assert table["label"] == label
    assert table["start_s"] == pytest.approx(start, abs=1e-9)


def test_an_interval_that_ends_before_it_begins_is_refused(built: BuiltScene) -> None:
    """Nothing is written of it."""
    with pytest.raises(ForceTorqueError, match="interval 'new': expected an end after its start"):
        intervals_toml(_saved([], [_interval(2.0, 2.0)]), built)


def test_both_files_are_written_or_none(tmp_path: Path, built: BuiltScene) -> None:
    """A bad interval leaves no table of samples behind."""
    experiment = tmp_path / "day.one.toml"
    with pytest.raises(ForceTorqueError):
        save_annotations(_saved([_sample(1)], [_interval(2.0, 1.0)]), built, experiment)
    assert list(tmp_path.iterdir()) == []
    written = save_annotations(_saved([_sample(1)], []), built, experiment)
    assert [file.name for file in written] == ["day.one.samples.csv", "day.one.intervals.toml"]
    assert tomllib.loads(written[1].read_text(encoding="utf-8")) == {}


@pytest.mark.parametrize(
    "change",
    [
        {"sample": -1},
        {"sample": 1.5},
        {"mark": "middle"},
        {"label": "x" * 201},
        {"use": "sometimes"},
        {"time_s": float("nan")},
        {"unknown": 1},
    ],
)
def test_what_the_page_never_sends_is_refused(change: dict[str, Any]) -> None:
    """Numbers, marks and uses are checked, and unknown keys are errors."""
    with pytest.raises(ValidationError):
        _saved([_sample(1) | change], [])
