# SPDX-License-Identifier: BSD-3-Clause
"""Logs of a skinManager: contacts by patch, a heuristic that is never a wrench, and one clock."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.formats.yarp.log_format import PortKind, discover_ports, read_found_port
from forcetorque.formats.yarp.skin_ports import SkinPart, read_skin_events
from forcetorque.inspection.inspect import inspect_log
from forcetorque.recording.stream import QUANTITIES, Signal, Stream
from tests.cases import some_cases
from tests.formats.yarp.port_logs import INFO, INFO_TWO_STAMPS, write_port

_CONTACT = "((7 4 4 5) (0.1 0.2 0.3) (-0.5 0.25 -0.125) (0.0 0.0 0.0) (0.11 0.21 0.31) (1.0 0.0 0.0) (43 44) 10.5)"
_NAMED = _CONTACT[:-1] + ' ("r_forearm" "r_forearm_dh_frame") 3)'
_OTHER = _CONTACT.replace("(7 4 4 5)", "(8 3 4 2)")
_STAMP = "1457614036.921366"
_PART = SkinPart(number=5, name="forearm", frame="r_forearm_dh_frame")
_HEURISTIC_GAIN = 0.05
"""Of the skinManager, by the description of its messages."""
_GAIN_SHARE = 0.1
"""The log rounds normals to 3 digits; what is filtered besides is the skinManager's secret."""


def _signal(folder: Path, *lines: str, parts: tuple[SkinPart, ...] = (_PART,)) -> tuple[Stream, Signal]:
    (reading, *_) = read_skin_events(write_port(folder, "".join(f"{line}\n" for line in lines)), parts=parts)
    return reading.stream, reading.stream.signal("skin_event")


def test_a_message_by_hand(tmp_path: Path) -> None:
    """Every number of a contact is where its name says, and an empty message is a sample without any."""
    stream, signal = _signal(tmp_path, f"1 {_STAMP} ", f"2 1457614036.941366 {_OTHER} {_CONTACT} {_CONTACT}")
    assert stream.stamp_ns.tolist() == [1457614036_921366000, 1457614036_941366000]
    assert stream.sequence is not None
    assert stream.sequence.tolist() == [1, 2]
    assert np.isnan(signal.values[0]).all()
    assert signal.frame == "r_forearm_dh_frame"
    assert len(signal.columns) == 2 * 16
    for slot in ("1", "2"):
        row = {name.partition(".")[2]: signal.column(name)[1] for name in signal.columns if name.startswith(slot + ".")}
        assert (row["contact_id"], row["taxels"], row["mean_fall"]) == (7, 2, 10.5)
        assert [row[f"pressed_{axis}"] for axis in "xyz"] == [0.1, 0.2, 0.3]
        assert [row[f"heuristic_{axis}"] for axis in "xyz"] == [-0.5, 0.25, -0.125]
        assert [row[f"centre_{axis}"] for axis in "xyz"] == [0.11, 0.21, 0.31]
        assert [row[f"normal_{axis}"] for axis in "xyz"] == [1, 0, 0]
        assert np.isnan(row["confidence"])


def test_the_longer_messages_bring_a_confidence(tmp_path: Path) -> None:
    """Messages of ten elements name link and frame; the rest is the same."""
    _, signal = _signal(tmp_path, f"1 {_STAMP} {_NAMED}")
    assert signal.column("1.confidence").tolist() == [3]
    assert signal.column("1.mean_fall").tolist() == [10.5]


def test_the_heuristic_is_no_force(tmp_path: Path) -> None:
    """No unit is one of force, and nothing that reads wrenches finds one."""
    stream, signal = _signal(tmp_path, f"1 {_STAMP} {_CONTACT}")
    assert set(stream.signals) == {"skin_event"}
    assert {unit for name, unit in zip(signal.columns, signal.units, strict=True) if "heuristic" in name} == {
        "heuristic"
    }
    assert not {"N", "N m", "Pa"} & set(signal.units)
    assert "not newtons" in QUANTITIES["skin_event"].description
    with pytest.raises(RecordingError, match="no wrench"):
        stream.signal("wrench")


@pytest.mark.parametrize(
    ("line", "match"),
    [
        ("", "blank line"),
        (f"1 {_STAMP} {_CONTACT[:-8]}", 'expected "[)]"'),
        (f"1 {_STAMP} ((7 4 4 5) (0.1 0.2 0.3))", "list of 8 or 10 elements, got a list of 2"),
        (f"1 {_STAMP} 3.0", "list of 8 or 10 elements, got no list"),
        (
            f"1 {_STAMP} {_CONTACT.replace('(0.1 0.2 0.3)', '(0.1 0.2)')}",
            "contact 1: expected a list of 3",
        ),
        (f"1 {_STAMP} {_CONTACT.replace('(7 4 4 5)', '(7 4 4)')}", "list of 4 numbers for contactId"),
        (f"1 {_STAMP} {_CONTACT.replace('(7 4 4 5)', '(7 4 4.5 5)')}", "whole numbers"),
        (f"1 {_STAMP} {_CONTACT.replace('10.5', 'high')}", "a pressure"),
        (f"1 {_STAMP} {_CONTACT.replace('(43 44)', '(43 x)')}", "list of numbers for active taxels"),
        (f"1 {_STAMP} {_CONTACT.replace('10.5', '1e999')}", "beyond the range of float64"),
        (f"1 {_STAMP} {_NAMED.replace(' 3)', ' x)')}", "expected a confidence"),
        (f"1.5 {_STAMP} {_CONTACT}", "integer sequence number"),
        (f"1 {_CONTACT}", "expected a sequence number and one stamp"),
    ],
)
def test_damaged_lines_are_refused_with_their_place(tmp_path: Path, line: str, match: str) -> None:
    """The good line before is read; the message names file, line and what to do."""
    folder = write_port(tmp_path, f"1 {_STAMP} {_CONTACT}\n{line}\n")
    with pytest.raises(FormatError, match=rf"data\.log:2: .*{match}"):
        read_skin_events(folder, parts=[_PART])


def test_a_log_that_ends_in_a_line_is_refused(tmp_path: Path) -> None:
    """The last line may be half a contact."""
    folder = write_port(tmp_path, f"1 {_STAMP} {_CONTACT}\n2 {_STAMP} {_CONTACT}")
    with pytest.raises(FormatError, match=r"data\.log:2: .*delete this line"):
        read_skin_events(folder, parts=[_PART])
    with pytest.raises(FormatError, match="empty log"):
        read_skin_events(write_port(tmp_path, ""), parts=[_PART])


def test_a_patch_on_two_links_is_refused(tmp_path: Path) -> None:
    """Vectors of two frames are no one signal."""
    folder = write_port(tmp_path, f"1 {_STAMP} {_CONTACT}\n2 {_STAMP} {_CONTACT.replace('(7 4 4 5)', '(7 4 5 5)')}\n")
    with pytest.raises(FormatError, match="body part 4 link 4 and body part 4 link 5"):
        read_skin_events(folder, parts=[_PART])


def test_patches_are_named_once(tmp_path: Path) -> None:
    """Two of one number or one name, or none, are refused."""
    folder = write_port(tmp_path, f"1 {_STAMP} {_CONTACT}\n")
    twice = SkinPart(number=5, name="again", frame="f")
    namesake = SkinPart(number=6, name="forearm", frame="f")
    for parts, match in (((_PART, twice), "each number once"), ((_PART, namesake), "each stream once"), ((), "none")):
        with pytest.raises(RecordingError, match=match):
            read_skin_events(folder, parts=parts)


def test_the_clocks_of_sender_and_dumper_are_never_mixed(tmp_path: Path) -> None:
    """Without the sender's stamp a message is left out; the clocks are years apart, which is said and named."""
    sent = [f"{k} {1204508983 + k}.5 {1373891463 + k}.5 {_CONTACT}" for k in range(4)]
    folder = write_port(tmp_path, "\n".join([*sent, f"4 0 1373891470.5 {_CONTACT}"]) + "\n", info=INFO_TWO_STAMPS)
    (reading,) = read_skin_events(folder, parts=[_PART])
    assert reading.stream.stamp_ns.tolist() == [(1204508983 + k) * 10**9 + 5 * 10**8 for k in range(4)]
    assert reading.stream.clock == "yarp sender"
    sizes = {finding.kind: finding.size for finding in reading.findings}
    assert sizes == {"left_out": None, "two_clocks": 1373891463 - 1204508983, "heuristic": None}


def test_messages_without_an_envelope_are_left_out(tmp_path: Path) -> None:
    """Where the sender's stamp was asked for they carry both, and the only good one is the dumper's."""
    lines = [f"1 {_STAMP} {_CONTACT}", f"-1 0 1457614037.5 {_CONTACT}", "2 1457614037.9 "]
    folder = write_port(tmp_path, "\n".join(lines) + "\n")
    (reading,) = read_skin_events(folder, parts=[_PART])
    assert reading.stream.sequence is not None
    assert reading.stream.sequence.tolist() == [1, 2]
    assert [(finding.kind, finding.count) for finding in reading.findings] == [("left_out", 1), ("heuristic", 2)]


@pytest.mark.parametrize(("info", "kinds"), [("rx;", ["heuristic"]), (None, ["unknown_stamp", "heuristic"])])
def test_stamps_of_the_dumper_and_of_nobody_knows_whom(tmp_path: Path, info: str | None, kinds: list[str]) -> None:
    """Every message is kept with its one stamp."""
    text = None if info is None else INFO.replace("tx;", info)
    folder = write_port(tmp_path, f"1 {_STAMP} {_CONTACT}\n2 1457614037.5 \n", info=text)
    (reading,) = read_skin_events(folder, parts=[_PART])
    assert reading.stream.stamp_ns.tolist() == [1457614036_921366000, 1457614037_500000000]
    assert [finding.kind for finding in reading.findings] == kinds


def test_without_any_stamp_of_the_sender_all_are_the_dumpers(tmp_path: Path) -> None:
    """One clock for all, and a finding that says which."""
    lines = [f"{k} 0 {1373891463 + k}.5 {_CONTACT}" for k in range(3)]
    folder = write_port(tmp_path, "\n".join(lines) + "\n", info=INFO_TWO_STAMPS)
    (reading,) = read_skin_events(folder, parts=[_PART])
    assert reading.stream.stamp_ns.tolist() == [(1373891463 + k) * 10**9 + 5 * 10**8 for k in range(3)]
    assert [finding.kind for finding in reading.findings] == ["dumper_stamp", "heuristic"]


def test_the_port_is_recognised_by_its_first_contact(tmp_path: Path) -> None:
    """Empty messages may stand before it; a log without any contact is told by its name, and not read."""
    write_port(tmp_path / "a", f"1 {_STAMP} \n" * 3 + f"4 {_STAMP} {_NAMED} {_OTHER}\n")
    write_port(tmp_path / "skin_events", f"1 {_STAMP} \n" * 3)
    write_port(tmp_path / "ft", f"1 {_STAMP} 1 2 3 4 5 6\n")
    ports = {port.path: port for port in discover_ports(tmp_path)}
    assert {path: port.kind for path, port in ports.items()} == {
        "a": PortKind.SKIN_EVENTS,
        "ft": PortKind.ANALOG,
        "skin_events": PortKind.UNKNOWN,
    }
    assert ports["skin_events"].reason is not None
    assert "without any" in ports["skin_events"].reason
    assert [reading.stream.name for reading in read_found_port(ports["a"])] == ["a#skin_part[2]", "a#skin_part[5]"]


@pytest.mark.real_data
@some_cases(
    ("name", "contacts", "ahead_s"),
    [
        ("left", {2: 597, 5: 9, 6: 17}, 169382481),
        ("right", {5: 718, 6: 19}, None),
        ("both", {2: 439, 5: 384, 6: 29}, None),
        ("rightleftforearmshands", {1: 381, 2: 1045, 4: 277, 5: 924, 6: 8, 7: 127}, None),
    ],
    quick=3,
)
def test_logs_of_a_real_robot(
    data_dir: Path, tmp_path: Path, name: str, contacts: dict[int, int], ahead_s: float | None
) -> None:
    """As many contacts as a search of the text counts; the heuristic is what its formula says."""
    folder = tmp_path / "skin_events"
    folder.mkdir()
    for kind in ("data", "info"):
        (folder / f"{kind}.log").symlink_to(data_dir / "icub_skin_events_pps" / f"{name}_{kind}.log")
    parts = [SkinPart(number=number, name=str(number), frame=f"frame_{number}") for number in contacts]
    readings = read_skin_events(folder, parts=parts)
    text = (folder / "data.log").read_text()
    assert len(readings) == len(contacts)
    for part, reading in zip(parts, readings, strict=True):
        values = reading.stream.signal("skin_event").values.reshape(len(reading.stream), -1, 16)
        seen = values[~np.isnan(values[:, :, 0])]
        assert len(seen) == contacts[part.number] == len(re.findall(rf"\(\d+ \d+ \d+ {part.number}\) \(", text))
        length = np.linalg.norm(seen[:, 4:7], axis=1)
        median = float(np.median(length / (_HEURISTIC_GAIN * seen[:, 13] * seen[:, 14])))
        assert abs(median - 1.0) < _GAIN_SHARE
        ahead = [finding.size for finding in reading.findings if finding.kind == "two_clocks"]
        if ahead_s is not None:
            assert np.round(ahead).tolist() == [ahead_s]
    inspection = inspect_log(tmp_path)
    assert {f"skin_events#skin_part[{number}]" for number in contacts} == set(inspection.streams)
    assert "heuristic" in {finding.kind for finding in inspection.findings}
