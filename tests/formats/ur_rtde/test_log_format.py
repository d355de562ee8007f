# SPDX-License-Identifier: BSD-3-Clause
"""Recordings of RTDE: the flange's wrench by the published conventions, what is asked, and wrong units refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.ur_rtde.log_format import MomentPoint, UrRtdeFormat, UrRtdeLog
from forcetorque.formats.ur_rtde.moment_point_axes_and_gravity import turned_by
from forcetorque.inspection.draft.draft import draft_experiment
from tests.formats.ur_rtde.recordings import GRAVITY, RATE_HZ, Tool, accelerometer, recorded, write_binary, write_text

TOOL = Tool()
ROUNDING = 1e-9
SIX_DECIMALS = 1e-4
"""What a rotation vector and a pose with six decimals make of a wrench; N, N m."""


def _read(path: Path, **stated: object) -> LogReading:
    context = ExperimentContext(
        experiment=path.parent / "x.toml", inputs=Inputs(path.parent), sensors={}, joint_units={}
    )
    return UrRtdeFormat().read(UrRtdeLog.model_validate({"format": "ur_rtde", "path": path.name, **stated}), context)


def _left(reading: LogReading, tool: Tool) -> FloatArray:
    """What a tool and the zero leave of the wrench at the flange; shape (n, 6)."""
    (wrist,) = (stream for stream in reading.streams if stream.name == "wrist")
    weight = tool.mass * wrist.signal("gravity").values
    return wrist.signal("wrench").values - np.hstack([weight, np.cross(tool.centre, weight)]) - tool.zero


@pytest.mark.parametrize("about_tcp", [False, True])
@pytest.mark.parametrize("form", ["blanks", "commas", "binary"])
def test_the_tool_explains_the_wrench_at_the_flange(tmp_path: Path, form: str, *, about_tcp: bool) -> None:
    """Weight and zero are all of it, in every form of file; about the other point they are not."""
    columns = recorded(TOOL, about_tcp=about_tcp, noise=0.0)
    path = tmp_path / "log"
    if form == "binary":
        write_binary(path, columns)
    else:
        write_text(path, columns, delimiter="," if form == "commas" else " ")
    assert isinstance(recognised_format(path), UrRtdeFormat)
    points = list(MomentPoint) if about_tcp else list(MomentPoint)[::-1]
    right = np.abs(_left(_read(path, moment_about=points[1]), TOOL)).max()
    assert right < (SIX_DECIMALS if form == "commas" else ROUNDING)
    without_raw = write_text(tmp_path / "other", recorded(TOOL, about_tcp=about_tcp, noise=0.0, raw=False))
    assert np.abs(_left(_read(without_raw, moment_about=points[0]), TOOL)).max() > 0.5
    with pytest.raises(FormatError, match=f"moment_about: expected {points[1]}, .* got {points[0]}"):
        _read(path, moment_about=points[0])
    described = UrRtdeFormat().describe(path)
    assert isinstance(described.table, UrRtdeLog)
    assert described.table.moment_about == points[1]  # ft_raw_wrench shows it
    assert not described.undetermined


def test_declared_payloads_are_added_and_divide_the_log(tmp_path: Path) -> None:
    """The whole load is left whatever the controller subtracts, and each payload is an interval and a session."""
    declared = ((0.5, (0.0, 0.0, 0.05)), (2.0, (0.01, 0.0, 0.03)))
    path = write_text(tmp_path / "log.txt", recorded(TOOL, declared=declared, noise=0.0))
    left = _left(_read(path, moment_about="flange"), TOOL)
    count = len(left) // 2
    np.testing.assert_allclose(left[:count], 0.0, atol=ROUNDING)
    np.testing.assert_allclose(left[count:], np.tile(TOOL.zero, (count, 1)), atol=ROUNDING)
    wrist = UrRtdeFormat().describe(path).wrist
    assert wrist is not None
    assert [load.mass for load in wrist.declared] == [0.5, 2.0]
    draft = draft_experiment(path).content
    assert draft.count('use = "calibration"') == 2
    assert "end_s = 0.956" in draft
    assert "start_s = 0.956" in draft
    assert 'session = "payload 2"' in draft


def test_what_neither_log_nor_format_says_is_asked(tmp_path: Path) -> None:
    """The reference point, and what the default recipe of record.py lacks, each by its key."""
    columns = recorded(TOOL, raw=False)
    few = {name: values for name, values in columns.items() if not name.startswith(("payload", "tcp_offset"))}
    path = write_text(tmp_path / "few.txt", few)
    description = UrRtdeFormat().describe(path)
    assert set(description.undetermined) == {"tcp_offset", "moment_about", "payload_kg"}
    assert {finding.kind for finding in description.reading.findings} == {"undetermined"}
    content = draft_experiment(path).content
    for key in ("tcp_offset", "moment_about", "payload_kg"):
        assert f'\n{key} = "?"' in content
    assert 'measure_direction = "child_to_parent"' in content
    with pytest.raises(FormatError, match="tcp_offset: expected pose of the TCP in the flange"):
        _read(path)
    offset = [float(columns[f"tcp_offset_{k}"][0]) for k in range(6)]
    reading = _read(path, tcp_offset=offset, moment_about="flange", payload_kg=0.0)
    assert np.abs(_left(reading, TOOL)).max() < 0.5
    assert set(UrRtdeFormat().describe(write_text(tmp_path / "log.txt", columns)).undetermined) == {"moment_about"}


def test_repeated_rows_are_left_out(tmp_path: Path) -> None:
    """A recorder faster than the controller writes each row twice: the stream has the rows of the controller."""
    columns = {name: np.repeat(values, 2) for name, values in recorded(TOOL).items()}
    reading = _read(write_text(tmp_path / "log.csv", columns, delimiter=","), moment_about="flange")
    stamps = reading.streams[0].stamp_ns
    assert set(np.diff(stamps)) == {round(1e9 / RATE_HZ)}
    (finding,) = reading.findings
    assert (finding.kind, finding.count) == ("repeated_rows", len(stamps))


def test_a_cut_row_of_a_binary_file_is_named(tmp_path: Path) -> None:
    """A recorder that was killed leaves part of a row."""
    path = write_binary(tmp_path / "log.dat", recorded(TOOL))
    path.write_bytes(path.read_bytes()[:-10])
    assert [finding.kind for finding in _read(path, moment_about="flange").findings] == ["cut_row"]


@pytest.mark.parametrize(
    ("field", "factor", "match"),
    [
        ("actual_TCP_pose_0", 1e5, "actual_TCP_pose: expected a position in m, got .* it is in mm"),
        ("tcp_offset_2", 1e3, "tcp_offset: expected a position in m, got 150"),
        ("tcp_offset_5", 57.3, "tcp_offset: expected a rotation vector in rad, got 68"),
        ("timestamp", -1.0, "row 2: expected a time after .* the controller was started again"),
    ],
)
def test_other_units_are_refused(tmp_path: Path, field: str, factor: float, match: str) -> None:
    """Values that no arm has are named with the unit that makes them."""
    columns = recorded(TOOL)
    columns[field] = columns[field] * factor
    with pytest.raises(FormatError, match=match):
        UrRtdeFormat().describe(write_text(tmp_path / "log.txt", columns))


def test_a_base_on_a_wall_is_noticed(tmp_path: Path) -> None:
    """The accelerometer of the tool contradicts gravity along -z of the base, and says where things fall."""
    columns = recorded(TOOL)
    for k, felt in enumerate(accelerometer(columns, up=np.array([0.0, GRAVITY, 0.0])).T):
        columns[f"actual_tool_accelerometer_{k}"] = felt
    path = write_text(tmp_path / "log.txt", columns)
    with pytest.raises(FormatError, match=r"gravity_direction: expected \[0.0, -1.0, 0.0\], in which things fall"):
        UrRtdeFormat().describe(path)
    _read(path, moment_about="flange", gravity_direction=[0.0, -1.0, 0.0])


def test_a_wrong_rotation_of_the_tcp_is_named(tmp_path: Path) -> None:
    """The force is turned against ft_raw_wrench by what tcp_offset is off, and by nothing where it is right."""
    columns = recorded(TOOL)
    wrist = UrRtdeFormat().describe(write_text(tmp_path / "log", columns)).wrist
    assert wrist is not None
    assert not wrist.contradictions
    columns["tcp_offset_5"] = columns["tcp_offset_5"] + np.pi / 2
    description = UrRtdeFormat().describe_specified(write_text(tmp_path / "log", columns), {"moment_about": "flange"})
    assert description.wrist is not None
    (words,) = description.wrist.contradictions
    assert "turned by (0, 0, 90) deg" in words.replace("-0,", "0,")
    assert [finding.kind for finding in description.reading.findings] == ["other_axes"]


def test_a_log_without_a_pose_is_refused(tmp_path: Path) -> None:
    """The field that lacks is named."""
    columns = {name: values for name, values in recorded(TOOL).items() if "TCP_pose" not in name}
    with pytest.raises(FormatError, match="expected the field actual_TCP_pose"):
        UrRtdeFormat().describe(write_text(tmp_path / "log.txt", columns))


@pytest.mark.real_data
@pytest.mark.parametrize("name", ["record_py.csv", "record_py_binary.dat", "ur_rtde_recorder.csv"])
def test_files_of_the_recorders_are_read(data_dir: Path, name: str) -> None:
    """Those of record.py and of ur_rtde agree with the truth of the sample."""
    folder = data_dir / "ur_rtde"
    if not folder.is_dir():
        pytest.skip("no ur_rtde in the folder of real measurements")
    stated = {"tcp_offset": [0.0, 0.0, 0.15, 0.0, 0.0, np.pi / 2]} if "recorder" in name else {}
    reading = _read(folder / name, moment_about="flange", gravity=9.82, **stated)
    assert np.abs(_left(reading, TOOL).mean(axis=0)).max() < 0.02
    assert len(reading.streams[0]) in (479, 448)
    assert GRAVITY < 9.82


def test_a_huge_force_does_not_hide_the_axes_by_an_error() -> None:
    """Damaged files hold them; without one the rotation is found."""
    rng = np.random.default_rng(1)
    raw = rng.normal(size=(50, 6))
    wrench = raw[:, [1, 0, 2, 4, 3, 5]] * [1, -1, 1, 1, -1, 1]
    np.testing.assert_allclose(turned_by(raw, wrench), [0.0, 0.0, -90.0], atol=1e-6)
    wrench[7, 0] = 1e308
    assert turned_by(100.0 * raw, wrench) is None
