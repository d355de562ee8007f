# SPDX-License-Identifier: BSD-3-Clause
"""What the viewer says that it shows."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from forcetorque.base.errors import ForceTorqueError, FormatError
from forcetorque.viewer.scene_builder import View, view_source

VIEW = View(
    experiment="arm",
    sensors=("a_ft", "b_ft"),
    samples=1200,
    url=None,
    file="view.html",
    file_bytes=1_500_000,
    video=None,
    video_frames=None,
    notes=("no mesh",),
)


def test_a_view_says_what_is_shown_and_where() -> None:
    """A sentence for the experiment and one for every place; a line of CSV has what is single."""
    assert VIEW.details(60).splitlines() == [
        "arm: 1200 samples of a_ft, b_ft",
        "page of 1.5 MB written to view.html",
    ]
    assert "<p>page of 1.5 MB written to view.html</p>" in VIEW._repr_html_()
    assert len(repr(VIEW)) < 600
    served = VIEW.model_copy(update={"file": None, "url": "http://127.0.0.1/x/"})
    assert served.details(60).splitlines()[1:] == ["open http://127.0.0.1/x/"]
    assert [answer.step for answer in served.answers()] == ["open http://127.0.0.1/x/"]
    (record,) = VIEW.records()
    assert list(record) == ["experiment", "samples", "url", "file", "file_bytes", "video", "video_frames"]


def _numbers(folder: Path, *experiments: dict[str, object]) -> Path:
    path = folder / "report.numbers.json"
    path.write_text(json.dumps({"schema": "forcetorque/report/2", "experiments": experiments}), encoding="utf-8")
    return path


def test_a_report_is_viewed_by_its_experiment_and_calibrations(tmp_path: Path) -> None:
    """Each calibration once, those that are named beside the report last."""
    file, leg, other = (tmp_path / name for name in ("leg.toml", "leg.json", "other.json"))
    for path in (file, leg, other):
        path.touch()
    sensors = [{"calibrations": {str(leg): {}}}, {"calibrations": {str(leg): {}}}]
    numbers = _numbers(tmp_path, {"file": str(file), "sensors": sensors})
    assert view_source(numbers, [other, leg]) == (file, [leg, other])
    assert view_source(file, [other]) == (file, [other])


def test_what_is_no_report_of_one_experiment_is_refused(tmp_path: Path) -> None:
    """Several experiments, and JSON of another schema."""
    several = _numbers(tmp_path, {"file": "a.toml", "sensors": []}, {"file": "b.toml", "sensors": []})
    with pytest.raises(ForceTorqueError, match=r"expected a report of one experiment, got a.toml, b.toml"):
        view_source(several)
    several.write_text('{"schema": "forcetorque/study/2"}', encoding="utf-8")
    with pytest.raises(FormatError, match=r"expected the numbers of a report: schema: .*forcetorque/report/2"):
        view_source(several)
