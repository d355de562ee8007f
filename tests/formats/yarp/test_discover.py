# SPDX-License-Identifier: BSD-3-Clause
"""Ports are found at any depth, their kind is told from their first message, and what is not known is said."""

from __future__ import annotations

import gzip
import math
import os
import re
from pathlib import Path

import pytest

from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.formats.yarp.log_format import FoundPort, PortKind, discover_ports, read_found_port
from tests.formats.yarp.port_logs import INFO, INFO_TWO_STAMPS, write_port
from tests.formats.yarp.test_measures import ONE_SENSOR, TWO_SENSORS

_SIX = "1 10.5 1 2 3 4 5 6\n"
_TWELVE = "1 10.5 1 2 3 4 5 6 90 8 9 10 11 12\n"
_BOARD = "1 10.5 " + "(1 2) [ok] " * 10 + "(3 4) [ok]\n"


def _only(folder: Path) -> FoundPort:
    (port,) = discover_ports(folder)
    return port


@pytest.mark.parametrize(
    ("name", "text", "kind", "joints"),
    [
        ("analog:o", _SIX, PortKind.ANALOG, 0),
        ("imu", _TWELVE, PortKind.INERTIAL, 0),
        ("state:o", _SIX, PortKind.STATE, 6),
        ("state:o_00001", _TWELVE, PortKind.STATE, 12),
        ("state:o", "1 10.5 7\n", PortKind.STATE, 1),
        ("stateExt:o", _BOARD, PortKind.STATE_EXT, 2),
        ("anything", _BOARD, PortKind.STATE_EXT, 2),
        ("anything", "1 10.5 (1) (2) (3) (4) (5) (6) (7)\n", PortKind.STATE_EXT, 1),
        ("anything", "1 10.5 " + "(1 2 3) " * 10 + "\n", PortKind.STATE_EXT, 3),
        ("anything", "1 10.5 () [fail] " + "(1 2) [ok] " * 9 + "(3 4) [ok]\n", PortKind.STATE_EXT, 2),
        ("anything", ONE_SENSOR, PortKind.MEASURES, 0),
        ("state:o", TWO_SENSORS, PortKind.MEASURES, 0),
    ],
)
@pytest.mark.parametrize("packed", [False, True])
def test_the_kind_of_a_port(tmp_path: Path, name: str, text: str, kind: PortKind, joints: int, packed: bool) -> None:
    """Lists tell it; of plain numbers the name decides whether they are positions. Every known kind can be read."""
    port = _only(write_port(tmp_path / name, text * 3, packed=packed).parent)
    assert (port.path, port.kind, len(getattr(port.table, "joints", ())), port.reason) == (name, kind, joints, None)
    readings = read_found_port(port)
    assert readings
    for reading in readings:
        assert len(reading.stream) == 3


@pytest.mark.parametrize(
    ("name", "text", "reason"),
    [
        ("port", "1 10.5 1 2 3 4 5\n", 'expected 6 or 12 numbers of a sensor, or a folder .* "state", got 5 numbers'),
        ("State:o", "1 10.5 1 2 3 4 5\n", "got 5 numbers"),
        ("state:o", "1 10.5 \n", "got 0 numbers"),
        (
            "port",
            "1 10.5 (1 2) (3)\n",
            "expected plain numbers, the lists of a board .*, got 2 elements of which 2 are",
        ),
        ("port", "1 10.5 1 (2)\n", "got 2 elements of which 1 are lists"),
        (
            "port",
            "1 10.5 " + "() " * 10 + "\n",
            "expected a device with a sensor .* read .gyroscope, .*, got no sensor",
        ),
        ("port", "1 10.5 () () (((1 2 3) 4)) () () () () (((1) 2)) ()\n", "got magnetometer, encoder"),
        ("port", "1 10.5 " + "() [fail] " * 11 + "\n", "got 22 elements"),
        ("port", "00000001.ppm [rgb]\n", "got '00000001.ppm'"),
        ("port", "", "empty log"),
        ("port", "1 10.5 1 2 3 4 5 6", "expected a line feed at the end"),
        ("port", "1 " * 40_000 + "\n", "expected lines of at most 65536 bytes"),
        ("port", "1 10.5 " + "(" * 30_000 + ")" * 30_000 + "\n", "got 1 elements of which 1 are lists"),
        ("port", "1 10.5 " + "(" * 60_000 + "\n", "got 60000 open"),
        ("port", b"\xff\n", "expected ASCII text, got the byte 0xff"),
    ],
    ids=range(15),
)
def test_what_is_not_known_has_a_reason(tmp_path: Path, name: str, text: str | bytes, reason: str) -> None:
    """Nothing is left out of the list; reading such a port repeats the reason."""
    port = _only(write_port(tmp_path / name, text).parent)
    assert port.kind is PortKind.UNKNOWN
    assert port.reason is not None
    assert re.search(reason, port.reason)
    assert "\n" not in port.reason
    with pytest.raises(FormatError, match="expected a port whose messages are known") as caught:
        read_found_port(port)
    assert str(caught.value).endswith(port.reason)


def test_damaged_folders_are_unknown_too(tmp_path: Path) -> None:
    """Images, two logs, a damaged gzip file: each is listed with its reason, beside a good one."""
    write_port(tmp_path / "good", _SIX)
    write_port(tmp_path / "image", _SIX, info="Type: Image;\n")
    write_port(tmp_path / "both", _SIX)
    (tmp_path / "both" / "data.log.gz").write_bytes(b"")
    write_port(tmp_path / "packed", "")
    (tmp_path / "packed" / "data.log").rename(tmp_path / "packed" / "data.log.gz")
    (tmp_path / "packed" / "data.log.gz").write_bytes(gzip.compress(_SIX.encode())[:-12])
    found = {port.path: (port.kind, port.reason or "") for port in discover_ports(tmp_path)}
    assert list(found) == ["both", "good", "image", "packed"]
    assert [kind for kind, _ in found.values()].count(PortKind.UNKNOWN) == 3
    assert "got both" in found["both"][1]
    assert 'expected "Type: Bottle;"' in found["image"][1]
    assert "expected a complete gzip file" in found["packed"][1]


def test_ports_are_found_at_any_depth_and_sorted(tmp_path: Path) -> None:
    """Folders without a log are passed through, also below a port; only files of the right names count."""
    for path in ("b/icub/leg/analog:o", "a/analog:o", "a", "b/icub/arm/analog:o", "/".join("x" * 300)):
        write_port(tmp_path / path, _SIX)
    (tmp_path / "empty").mkdir()
    (tmp_path / "folder" / "data.log").mkdir(parents=True)
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / "data.txt").write_text(_SIX)
    found = discover_ports(str(tmp_path))
    assert [port.path for port in found] == [
        "a", "a/analog:o", "b/icub/arm/analog:o", "b/icub/leg/analog:o", "/".join("x" * 300),
    ]  # fmt: skip
    assert all(port.folder == tmp_path / port.path for port in found)


def test_a_port_folder_itself_has_its_own_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Also where it is the current folder; its name decides as it would below another folder."""
    folder = write_port(tmp_path / "state:o", _SIX)
    assert (_only(folder).path, _only(folder).kind) == ("state:o", PortKind.STATE)
    monkeypatch.chdir(folder)
    assert (_only(Path()).path, _only(Path()).kind) == ("state:o", PortKind.STATE)


def test_links_to_folders_are_not_followed(tmp_path: Path) -> None:
    """A link to a folder above would be followed for ever; a linked log is a log."""
    folder = write_port(tmp_path / "logs" / "analog:o", _SIX)
    (folder / "up").symlink_to(tmp_path, target_is_directory=True)
    store = tmp_path / "store"
    (folder / "data.log").rename(store)
    (folder / "data.log").symlink_to(store)
    assert [port.path for port in discover_ports(tmp_path / "logs")] == ["analog:o"]
    assert len(read_found_port(_only(tmp_path / "logs"))) == 1


def test_pipes_are_not_opened(tmp_path: Path) -> None:
    """Opening one would wait for ever."""
    os.mkfifo(tmp_path / "data.log")
    assert discover_ports(tmp_path) == ()


def test_a_folder_must_be_there(tmp_path: Path) -> None:
    """A missing folder, a file and a name that the system refuses are errors; a folder without ports is none."""
    assert discover_ports(tmp_path) == ()
    with pytest.raises(MissingFileError, match="nowhere: expected a folder of logs, got nothing there"):
        discover_ports(tmp_path / "nowhere")
    file = tmp_path / "file"
    file.write_text(_SIX)
    with pytest.raises(FormatError, match="file: expected a folder of logs, got a file"):
        discover_ports(file)
    with pytest.raises(FormatError, match="expected a readable folder of logs"):
        discover_ports(tmp_path / ("x" * 5000))


def test_only_the_first_line_is_looked_at(tmp_path: Path) -> None:
    """What is wrong further down is found by reading, not by looking."""
    port = _only(write_port(tmp_path, _SIX + "rubbish\n"))
    assert port.kind is PortKind.ANALOG
    with pytest.raises(FormatError, match=r"data\.log:2: .*'rubbish'"):
        read_found_port(port)
    (tmp_path / "data.log").unlink()
    with pytest.raises(MissingFileError, match="got neither"):
        read_found_port(port)


@pytest.mark.parametrize(
    ("text", "kind", "joints"),
    [
        (_SIX, PortKind.ANALOG, 0),
        ("-1 0.0 10.5 1 2 3 4 5 6\n", PortKind.ANALOG, 0),
        ("-1 0.0 1 2 3 4 5 6\n", PortKind.ANALOG, 0),
        ("-1 0.0 10.5 " + _BOARD.partition("10.5 ")[2], PortKind.STATE_EXT, 2),
        ("-1 10.5 " + _BOARD.partition("10.5 ")[2], PortKind.STATE_EXT, 2),
        ("-1 0.0 " + TWO_SENSORS.partition("847330 ")[2], PortKind.MEASURES, 0),
    ],
)
def test_stamps_are_no_part_of_the_message(tmp_path: Path, text: str, kind: PortKind, joints: int) -> None:
    """Messages without an envelope may have one more; the lists that follow are not taken for it."""
    port = _only(write_port(tmp_path / "port", text))
    assert (port.kind, len(getattr(port.table, "joints", ())), port.reason) == (kind, joints, None)
    (stream, *_) = (reading.stream for reading in read_found_port(port))
    assert len(stream) == 1


def test_with_two_stamps_the_message_is_shorter(tmp_path: Path) -> None:
    """Eight numbers after the sequence number are a wrench with two stamps, or unknown with one."""
    text = "1 10.25 10.5 1 2 3 4 5 6\n"
    assert _only(write_port(tmp_path, text, info=INFO_TWO_STAMPS)).kind is PortKind.ANALOG
    assert _only(write_port(tmp_path, text, info=INFO)).kind is PortKind.UNKNOWN


def test_names_are_made_up(tmp_path: Path) -> None:
    """Streams and frames are called as the path, joints by their number, sensors of a device by their place."""
    for name, text in (("analog:o", _SIX), ("state:o", _SIX), ("imu", _TWELVE), ("x/ext", _BOARD), ("y", TWO_SENSORS)):
        write_port(tmp_path / "robot" / name, text)
    ports = {port.path: port for port in discover_ports(tmp_path)}
    streams = {path: [reading.stream for reading in read_found_port(port)] for path, port in ports.items()}
    assert {path: [stream.name for stream in found] for path, found in streams.items()} == {
        "robot/analog:o": ["robot/analog:o"],
        "robot/imu": ["robot/imu"],
        "robot/state:o": ["robot/state:o"],
        "robot/x/ext": ["robot/x/ext"],
        "robot/y": [
            "robot/y#temperature[0]",
            "robot/y#temperature[1]",
            "robot/y#six_axis_force_torque[0]",
            "robot/y#six_axis_force_torque[1]",
        ],
    }
    assert streams["robot/analog:o"][0].signal("wrench").frame == "robot/analog:o"
    assert streams["robot/imu"][0].signal("angular_velocity").frame == "robot/imu"
    assert streams["robot/y"][2].signal("wrench").frame == "robot/y#six_axis_force_torque[0]"
    assert streams["robot/x/ext"][0].signal("position").columns == ("joint_0", "joint_1")
    position = streams["robot/state:o"][0].signal("position")
    assert position.columns == tuple(f"joint_{k}" for k in range(6))
    assert position.values[0, 5] == math.radians(6)


@pytest.mark.real_data
def test_the_ports_of_real_logs(data_dir: Path) -> None:
    """Plain and packed logs of two recordings: every port is found, known and readable."""
    legs = ("left_arm", "left_foot", "left_leg", "right_arm", "right_foot", "right_leg")
    analog = {f"icub/{leg}/analog:o": (PortKind.ANALOG, 0) for leg in legs}
    boards = {
        f"icub/{board}/stateExt:o": (PortKind.STATE_EXT, joints)
        for board, joints in (("head", 6), ("left_leg", 6), ("right_leg", 6), ("torso", 3))
    }
    expected = {"dumperLeftLegNoIMU": analog | boards, "dumperRightLeg": analog}
    for folder, ports in expected.items():
        found = discover_ports(data_dir / "icub_genova02_yoga" / folder)
        assert {port.path: (port.kind, len(getattr(port.table, "joints", ()))) for port in found} == ports
        assert [port.path for port in found] == sorted(ports)
        for port in found:
            (reading,) = read_found_port(port)
            assert len(reading.stream) > 7000
            assert reading.stream.name == port.path
