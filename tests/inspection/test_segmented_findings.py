# SPDX-License-Identifier: BSD-3-Clause
"""`inspect` looks at a long recording in one segment after the other."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.inspection.inspect import inspect_log, inspected
from forcetorque.recording.recording import Finding
from tests.scenes.segments import short_segments
from tests.scenes.studies import CALIBRATION, SENSOR


def test_what_goes_on_across_segments_is_one_finding(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With the time of all of it; what is found in one segment alone says so; no segment is the recording."""
    spans = []

    def found(experiment: Experiment, **_: object) -> tuple[Finding, ...]:
        stamps = experiment.recording.stream(SENSOR).stamp_ns
        spans.append((int(stamps[0]), int(stamps[-1])))
        lost = Finding(stream=SENSOR, kind="gap", message="lost", count=1, start_ns=spans[-1][0], end_ns=spans[-1][1])
        still = Finding(stream=SENSOR, kind="still", message="still", count=0)
        return (lost, still) if len(spans) == 1 else (lost,)

    monkeypatch.setattr("forcetorque.inspection.inspect.inspect_experiment", found)
    experiment = load_experiment(recorded / CALIBRATION[0])
    with short_segments():
        rows = inspected(experiment).findings
    assert len(spans) > 2
    (gap,) = (row for row in rows if row.kind == "gap")
    assert gap.start_s is not None
    assert gap.end_s == pytest.approx(gap.start_s + 1e-9 * (spans[-1][1] - spans[0][0]))
    (still,) = (row for row in rows if row.kind == "still")
    assert still.message.startswith(f"still (in 1 of {len(spans)} segments")


def test_outliers_of_every_segment_are_named(recorded: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where the largest of a segment lies beyond its end, where the next one counts it too."""
    largest: list[int] = []

    def found(experiment: Experiment, **_: object) -> tuple[Finding, ...]:
        stamps = experiment.recording.stream(SENSOR).stamp_ns
        at = int(stamps[-1] if not largest else stamps[len(stamps) // 2])
        largest.append(at)
        text = f"{len(largest)} outlier(s), the largest here"
        return (Finding(stream=SENSOR, kind="outlier", message=text, count=1, start_ns=at, end_ns=at),)

    monkeypatch.setattr("forcetorque.inspection.inspect.inspect_experiment", found)
    with short_segments():
        rows = inspected(load_experiment(recorded / CALIBRATION[0])).findings
    named = [row.message for row in rows if row.kind == "outlier"]
    assert len(named) == len(largest) > 2
    assert all("in one segment of" in message for message in named)


def test_contents_are_those_of_the_recording(recorded: Path) -> None:
    """Streams, their lengths and the duration do not depend on segments; findings do, and their postures with them."""
    whole = inspect_log(recorded / CALIBRATION[0])
    with short_segments():
        segmented = inspect_log(recorded / CALIBRATION[0])
    found = {"findings": (), "postures": ()}
    assert segmented.model_copy(update=found) == whole.model_copy(update=found)
