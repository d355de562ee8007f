# SPDX-License-Identifier: BSD-3-Clause
"""Logs of robometry: what the file labels is read by its labels, what it does not is refused until it is stated."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError, FormatError, UnitError
from forcetorque.experiment.named_files import ExperimentContext, Inputs
from forcetorque.formats.log_format import LogReading
from forcetorque.formats.registry import recognised_format
from forcetorque.formats.robometry.log_format import RobometryFormat, RobometryLog
from tests.formats.robometry.logger import JOINTS, Leaf, write_log

ROWS = 50
RNG = np.random.default_rng(3)
POSITIONS = RNG.uniform(-90.0, 90.0, (ROWS, 3))
VELOCITIES = RNG.normal(size=(ROWS, 3))
WRENCHES = RNG.normal(size=(ROWS, 6))
LEAVES = {
    "joints_state/positions": Leaf(values=POSITIONS, elements=JOINTS, units=["deg"]),
    "joints_state/velocities": Leaf(values=VELOCITIES, elements=JOINTS, units=["deg/s"]),
    "joints_state/control_mode": Leaf(values=VELOCITIES, elements=JOINTS),
    "FTs/r_leg_ft": Leaf(values=WRENCHES, units=["N", "N", "N", "Nm", "Nm", "Nm"]),
    "temperatures/r_leg_ft": Leaf(values=WRENCHES[:, :1], units=["C"]),
    "gyros/waist": Leaf(values=WRENCHES[:, :3], units=["rad/s"]),
    "accelerometers/waist": Leaf(values=WRENCHES[:, :3], units=["m/s^2"]),
}
JOINT_ENTRY = {"name": "joints", "channel": "joints_state"}
FT_ENTRY = {"name": "ft", "channel": "FTs/r_leg_ft"}


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A log with all that is read, and modes, which are not."""
    return write_log(tmp_path_factory.mktemp("robometry") / "log.mat", LEAVES)


def _read(file: Path, *streams: dict[str, Any], joint_units: dict[str, str] | None = None, **more: Any) -> LogReading:
    content = {"format": "robometry", "path": file.name, "stream": streams, **more}
    context = ExperimentContext(
        experiment=file.parent / "x.toml",
        inputs=Inputs(file.parent),
        sensors={"ft": "r_leg_ft"},
        joint_units=joint_units or {},
    )
    reading = RobometryFormat().read(RobometryLog.model_validate(content), context)
    assert context.inputs.names() == {file.name}
    return reading


def test_numbers_are_in_si_by_the_labels_of_the_file(file: Path) -> None:
    """Joints by name and in rad, wrenches in N and N m in the frame of their sensor, stamps in ns since 1970."""
    joints, wrench = _read(file, JOINT_ENTRY, FT_ENTRY).streams
    np.testing.assert_allclose(joints.signal("position").values, np.radians(POSITIONS), rtol=1e-15)
    np.testing.assert_allclose(joints.signal("velocity").values, np.radians(VELOCITIES), rtol=1e-15)
    assert joints.signal("position").columns == JOINTS
    assert set(joints.signals) == {"position", "velocity"}
    np.testing.assert_array_equal(wrench.signal("wrench").values, WRENCHES)
    assert wrench.signal("wrench").frame == "r_leg_ft"
    assert joints.clock == wrench.clock == "logger"
    # a float of seconds since 1970 resolves 0.24 microseconds
    assert abs(int(joints.stamp_ns[1]) - 1_706_000_000_010_000_000) < 240


def test_radians_are_told_from_degrees_by_the_label(tmp_path: Path) -> None:
    """The same numbers under another label are other angles."""
    radians = LEAVES | {"joints_state/positions": Leaf(values=POSITIONS, elements=JOINTS, units=["rad"])}
    (stream,) = _read(write_log(tmp_path / "log.mat", radians), JOINT_ENTRY).streams
    np.testing.assert_array_equal(stream.signal("position").values, POSITIONS)


def test_without_a_label_nothing_is_guessed(tmp_path: Path) -> None:
    """Older files have neither names nor units: names are those of the list, units must be stated."""
    bare = {name: Leaf(values=leaf.values) for name, leaf in LEAVES.items() if name != "joints_state/velocities"}
    file = write_log(tmp_path / "log.mat", bare)
    with pytest.raises(UnitError, match=r"joints_state/positions: expected a unit as label, .* none; specify"):
        _read(file, JOINT_ENTRY)
    (stream,) = _read(file, JOINT_ENTRY, units={"joints_state/positions": "deg"}).streams
    np.testing.assert_allclose(stream.signal("position").values, np.radians(POSITIONS), rtol=1e-15)
    assert stream.signal("position").columns == JOINTS


def test_a_statement_against_the_label_is_refused(file: Path) -> None:
    """The file says deg; who says rad must say why by deleting one of them."""
    with pytest.raises(UnitError, match="the file labels it deg, units has rad"):
        _read(file, JOINT_ENTRY, units={"joints_state/positions": "rad"})
    _read(file, JOINT_ENTRY, units={"joints_state/positions": "deg"})


def test_degrees_that_look_like_radians_are_doubted(tmp_path: Path) -> None:
    """The dumper writes `deg` in any case; a robot that moves by degrees is not doubted."""
    small = LEAVES | {"joints_state/positions": Leaf(values=np.radians(POSITIONS), elements=JOINTS, units=["deg"])}
    reading = _read(write_log(tmp_path / "log.mat", small), JOINT_ENTRY)
    assert [finding.kind for finding in reading.findings] == ["angle_units"]
    large = write_log(tmp_path / "large.mat", LEAVES)
    assert _read(large, JOINT_ENTRY).findings == ()


WRONG: list[tuple[dict[str, Any], type[ForceTorqueError], str]] = [
    ({"name": "a", "channel": "FTs/left"}, FormatError, r"stream\[0\]: .*channel: no channel 'FTs/left'"),
    (
        {"name": "a", "channel": "joints_state/control_mode"},
        FormatError,
        "expected a channel of a sensor or joints",
    ),
    ({"name": "a", "channel": "gyros/waist"}, FormatError, r"expected a frame, or a \[\[sensor\]\] that reads 'a'"),
]


@pytest.mark.parametrize(("entry", "error", "message"), WRONG)
def test_what_the_file_does_not_hold_is_refused(
    file: Path, entry: dict[str, Any], error: type[ForceTorqueError], message: str
) -> None:
    """By channel, with the known ones."""
    with pytest.raises(error, match=message):
        _read(file, entry)


def test_a_prismatic_joint_is_refused(file: Path) -> None:
    """A label of angles stands for all joints; the robot knows better."""
    with pytest.raises(FormatError, match="joint r_knee: the robot has it in m, the log in rad"):
        _read(file, JOINT_ENTRY, joint_units={"r_knee": "m"})
    _read(file, JOINT_ENTRY, joint_units={"r_knee": "rad"})


def test_it_is_described_and_read_back(file: Path) -> None:
    """All that is labelled is a stream; modes are a finding; the table is what a file may state."""
    known = recognised_format(file)
    assert isinstance(known, RobometryFormat)
    description = known.describe(file)
    names = [stream.name for stream in description.reading.streams]
    assert names == ["FTs/r_leg_ft", "accelerometers/waist", "gyros/waist", "joints_state", "temperatures/r_leg_ft"]
    assert [(f.kind, f.stream) for f in description.reading.findings] == [("not_read", "joints_state/control_mode")]
    assert description.reading.origin == {"format": "robometry", "path": str(file), "robot": "ergoCubSN001"}
    stated = [entry.model_dump() for entry in description.table.stream]
    again = _read(file, *(entry | {"frame": entry["frame"] or "x"} for entry in stated))
    for stream, other in zip(description.reading.streams, again.streams, strict=True):
        np.testing.assert_array_equal(stream.stamp_ns, other.stamp_ns)
        for quantity, signal in stream.signals.items():
            np.testing.assert_array_equal(signal.values, other.signal(quantity).values)


def test_the_group_may_have_any_name(tmp_path: Path) -> None:
    """TelemetryDeviceDumper calls it as the experiment."""
    file = write_log(tmp_path / "log.mat", LEAVES, root="left_leg_grid")
    assert isinstance(recognised_format(file), RobometryFormat)
    assert len(_read(file, JOINT_ENTRY).streams) == 1


def test_another_number_of_times_is_refused(tmp_path: Path) -> None:
    """A channel whose times and samples differ in number is damaged."""
    file = write_log(tmp_path / "log.mat", LEAVES)
    with h5py.File(file, "r+") as log:
        group = log["robot_logger_device/FTs/r_leg_ft"]
        del group["timestamps"]
        group["timestamps"] = np.arange(ROWS - 1.0)[:, None]
    with pytest.raises(FormatError, match=f"a time for each, got .*{ROWS - 1} times"):
        _read(file, FT_ENTRY)
