# SPDX-License-Identifier: BSD-3-Clause
"""Logs of control boards: five layouts, flags, units, and what the board did not estimate."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FormatError, RecordingError
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp import message as skeleton, port_log as port_folder
from forcetorque.formats.yarp.joint_and_sensor_ports import read_state_ext
from tests.formats.yarp.port_logs import INFO, INFO_TWO_STAMPS, write_port

_JOINTS = ("hip", "knee", "slide")
_LAYOUTS = {"2014": (7, False), "2015": (10, False), "flags": (10, True), "2017": (11, True), "2025": (12, True)}
"""Number of lists and whether flags follow them."""


def _line(
    k: int = 0,
    *,
    layout: str = "2017",
    lists: Mapping[int, str] | None = None,
    flags: Mapping[int, str] | None = None,
    stamps: str | None = None,
) -> str:
    """Write message k: list i holds the numbers i + k, i + k + 0.5, ... unless another text is given."""
    n_lists, has_flags = _LAYOUTS[layout]
    texts = {i: f"({i + k} {i + k}.5 -{i + k}e-1)" for i in range(n_lists)} | dict(lists or {})
    words = dict.fromkeys(range(n_lists), "[ok]") | dict(flags or {})
    body = " ".join(f"{texts[i]} {words[i]}" if has_flags else texts[i] for i in range(n_lists))
    return f"{k} {stamps or f'{10 + k}.250000'} {body}\n"


def _read(folder: Path, text: str, info: str = INFO, units: Mapping[str, str] | None = None) -> StreamReading:
    return read_state_ext(write_port(folder, text, info=info), stream="leg", joints=_JOINTS, joint_units=units)


@pytest.mark.parametrize("layout", _LAYOUTS)
def test_every_layout_gives_positions_velocities_accelerations(tmp_path: Path, layout: str) -> None:
    """The first three lists, degrees turned into radians; the control shows that the lists differ."""
    stream = _read(tmp_path, _line(0, layout=layout) + _line(1, layout=layout)).stream
    assert stream.stamp_ns.tolist() == [10_250000000, 11_250000000]
    assert list(stream.signals) == ["position", "velocity", "acceleration"]
    units = {"position": "rad", "velocity": "rad/s", "acceleration": "rad/s2"}
    for i, name in enumerate(units):
        signal = stream.signal(name)
        assert signal.columns == _JOINTS
        assert signal.units == (units[name],) * 3
        logged = [(i + k, i + k + 0.5, -(i + k) / 10) for k in range(2)]
        np.testing.assert_array_equal(signal.values, np.vectorize(math.radians)(logged))
    assert (stream.signal("position").values != stream.signal("velocity").values).any()


def test_prismatic_joints_are_in_metres(tmp_path: Path) -> None:
    """Their values are taken as they are, those of the other joints are not."""
    stream = _read(tmp_path, _line(0) + _line(1), units={"slide": "m", "hip": "rad"}).stream
    assert stream.signal("position").units == ("rad", "rad", "m")
    assert stream.signal("velocity").units == ("rad/s", "rad/s", "m/s")
    assert stream.signal("acceleration").units == ("rad/s2", "rad/s2", "m/s2")
    np.testing.assert_array_equal(stream.signal("position").column("slide"), [0.0, -0.1])
    np.testing.assert_array_equal(stream.signal("position").column("hip"), [0.0, math.radians(1)])


def test_joints_that_the_robot_lacks_are_left_out(tmp_path: Path) -> None:
    """Each of the others keeps its numbers and its unit, whichever group failed; all of the board are still counted."""
    folder = write_port(tmp_path, _line(0) + _line(1, flags={1: "[fail]"}))
    stream = read_state_ext(folder, stream="leg", joints=("-", "knee", "slide"), joint_units={"slide": "m"}).stream
    whole = _read(tmp_path, _line(0) + _line(1, flags={1: "[fail]"}), units={"slide": "m"}).stream
    for name, signal in stream.signals.items():
        assert signal.columns == ("knee", "slide")
        np.testing.assert_array_equal(signal.values, whole.signal(name).values[:, 1:])
    assert np.isnan(stream.signal("velocity").values[1]).all()
    with pytest.raises(
        FormatError, match=r'so many joints were named \(knee, -\), got 3; name all .* "-" for one that'
    ):
        read_state_ext(folder, stream="leg", joints=("knee", "-"))


def test_unknown_joints_and_units_are_refused(tmp_path: Path) -> None:
    """A unit for a joint that is not there, and degrees, which are what is logged, are mistakes."""
    with pytest.raises(RecordingError, match="no joint 'slid' was named; did you mean \"slide\""):
        _read(tmp_path, _line(), units={"slid": "m"})
    with pytest.raises(RecordingError, match="expected rad or m for 'hip', got 'deg'"):
        _read(tmp_path, _line(), units={"hip": "deg"})
    with pytest.raises(RecordingError, match="each name once"):
        read_state_ext(tmp_path, stream="leg", joints=("hip", "hip", "knee"))


@pytest.mark.parametrize("joints", [(), ("hip",), ("hip", "knee"), ("a", "b", "c", "d")])
def test_the_board_must_have_the_named_joints(tmp_path: Path, joints: tuple[str, ...]) -> None:
    """Too few or too many names would give joints the values of others."""
    folder = write_port(tmp_path, _line())
    with pytest.raises(FormatError, match=rf"data\.log:1: expected {len(joints)} numbers of position .*, got 3;"):
        read_state_ext(folder, stream="leg", joints=joints)


@pytest.mark.parametrize("group", [0, 1, 2])
@pytest.mark.parametrize("text", ["()", "(0.0 0.0 0.0)", "(1 2 3)"])
def test_failed_groups_are_missing_values(tmp_path: Path, group: int, text: str) -> None:
    """Whatever a failed list holds is NaN, only there and only then, and the finding counts it."""
    names = ("position", "velocity", "acceleration")
    failed = {"lists": {group: text}, "flags": {group: "[fail]"}}
    good = _read(tmp_path, "".join(_line(k) for k in range(6))).stream
    reading = _read(tmp_path, "".join(_line(k, **(failed if k in (2, 4) else {})) for k in range(6)))  # type: ignore[arg-type]
    for i, name in enumerate(names):
        expected = good.signal(name).values.copy()
        if i == group:
            expected[[2, 4]] = np.nan
        np.testing.assert_array_equal(reading.stream.signal(name).values, expected)
    (finding,) = reading.findings
    assert (finding.kind, finding.count, finding.channel) == ("failed_group", 2, names[group])
    assert (finding.start_ns, finding.end_ns) == (12_250000000, 14_250000000)


def test_a_log_may_begin_with_failures(tmp_path: Path) -> None:
    """The first message does not say how long a failed list would be; the next one does."""
    empty = dict.fromkeys(range(11), "()")
    text = _line(0, lists=empty, flags=dict.fromkeys(range(11), "[fail]")) + _line(1) + _line(2)
    reading = _read(tmp_path, text)
    positions = reading.stream.signal("position").values
    assert np.isnan(positions[0]).all()
    np.testing.assert_array_equal(positions[1:, 0], np.deg2rad([1, 2]))
    assert [finding.channel for finding in reading.findings] == ["position", "velocity", "acceleration"]


def test_failures_of_other_lists_change_nothing(tmp_path: Path) -> None:
    """Motors and torques have no reader yet, so their failures are nobody's."""
    others = range(3, 11)
    text = _line(0) + _line(1, lists=dict.fromkeys(others, "()"), flags=dict.fromkeys(others, "[fail]"))
    reading = _read(tmp_path, text)
    assert reading.findings == ()
    assert not np.isnan(reading.stream.signal("acceleration").values).any()


def test_boards_of_one_joint(tmp_path: Path) -> None:
    """A list of one number has no space in it: empty and full lists must not be confused."""
    one = {i: f"({i}.5)" for i in range(11)}
    text = _line(0, lists=one) + _line(1, lists=one | {0: "()"}, flags={0: "[fail]"}) + _line(2, lists=one)
    stream = read_state_ext(write_port(tmp_path, text), stream="leg", joints=["hip"]).stream
    np.testing.assert_array_equal(stream.signal("position").values, np.deg2rad([[0.5], [np.nan], [0.5]]))
    with pytest.raises(FormatError, match=r"data\.log:2: expected 11 lists with flags of 1 1"):
        read_state_ext(
            write_port(tmp_path, _line(0, lists=one) + _line(1, lists=one | {0: "()"})), stream="leg", joints=["hip"]
        )


def test_accelerations_of_zero_were_not_estimated(tmp_path: Path) -> None:
    """They are left out with a finding, also -0.0; a single number other than zero keeps them."""
    zeros = "".join(_line(k, lists={2: "(0.0 -0.0 0)"}) for k in range(3))
    reading = _read(tmp_path, zeros)
    assert list(reading.stream.signals) == ["position", "velocity"]
    (finding,) = reading.findings
    assert (finding.kind, finding.channel, finding.count) == ("not_estimated", "acceleration", 3)
    kept = _read(tmp_path, zeros + _line(4, lists={2: "(0.0 0.0 1e-9)"}))
    assert "acceleration" in kept.stream.signals
    assert kept.findings == ()


def test_velocities_of_zero_are_believed_at_rest_only(tmp_path: Path) -> None:
    """Where positions change, velocities that are all zero were not estimated."""
    still = {0: "(1 2 3)", 1: "(0.0 0.0 0.0)"}
    assert "velocity" in _read(tmp_path, "".join(_line(k, lists=still) for k in range(3))).stream.signals
    reading = _read(tmp_path, "".join(_line(k, lists={1: "(0.0 0.0 0.0)"}) for k in range(3)))
    assert list(reading.stream.signals) == ["position", "acceleration"]
    assert [(finding.kind, finding.channel) for finding in reading.findings] == [("not_estimated", "velocity")]


def test_of_two_stamps_the_senders_is_used(tmp_path: Path) -> None:
    """As for every other port."""
    text = _line(0, stamps="10.5 10.75") + _line(1, stamps="0.0 11.75")
    reading = _read(tmp_path, text, INFO_TWO_STAMPS)
    assert reading.stream.stamp_ns.tolist() == [10_500000000, 11_750000000]
    assert [finding.kind for finding in reading.findings] == ["dumper_stamp"]


@pytest.mark.parametrize(
    ("info", "stamps", "message"),
    [(INFO, "10.5 10.75", "with two stamps the line would fit"), (INFO_TWO_STAMPS, "10.5", "with one stamp the line")],
)
def test_info_file_and_lines_must_agree_on_stamps(tmp_path: Path, info: str, stamps: str, message: str) -> None:
    """A number too many before the lists, or too few, is no message."""
    with pytest.raises(FormatError, match=rf"data\.log:1: .*{message}"):
        _read(tmp_path, _line(stamps=stamps), info)


@pytest.mark.parametrize(
    ("line", "message"),
    [
        (_line(lists={5: "(1 2)"}), "expected 11 lists with flags of 3 3 3 3 3 3 3 .*got .* of 3 3 3 3 3 2"),
        (_line(lists={0: "(1 2 3 4)"}), "got 11 lists with flags of 4 3 3"),
        (_line(lists={0: "()"}), "got 11 lists with flags of 0 3 3"),
        (_line(lists={0: "(1 2)"}, flags={0: "[fail]"}), "got 11 lists with flags of 2 3 3"),
        (_line(layout="flags"), "got 10 lists with flags of 3 3"),
        (_line(layout="2015"), "got 10 lists of 3 3"),
        (_line(lists={0: "(1 (2) 3)"}), "expected only numbers in the list of position"),
        (_line(lists={8: "(1 [ok] 3)"}), "expected only numbers in the list of current"),
        (_line(lists={0: "(1 2 nan)"}), "got 'nan'"),
        (_line(lists={7: "(1 2 inf)"}), "got 'inf'"),
        (_line(lists={0: "(1 2 3-4)"}), "got '3-4'"),
        (_line(lists={0: "(1 2 3)4"}), "got 23 elements"),
        (_line(lists={0: "(1 2 3"}), r'expected "\)"'),
        (_line(lists={0: "1 2 3"}), "got 24 elements of which 10 are lists"),
        (_line(flags={0: "[maybe]"}), r"got '\[maybe\]'"),
        (_line(flags={0: "ok"}), "got 'ok'"),
        (_line(flags={0: "1"}), "got 22 elements"),
        (_line(flags={0: "[ok3]"}), r"got '\[ok3\]'"),
        (_line(lists={10: ""}, flags={10: ""}), "got 20 elements|got 10 lists with flags"),
        ("5 1.5 1 2 3 4 5 6\n", "got 6 elements of which 0 are lists"),
        ("5 1.5 (1 2 3)(4 5 6) (7 8 9) (1) (1) (1) (1)\n", "expected a space|got 7 lists"),
        ("\n", "blank line"),
    ],
)  # fmt: skip
@pytest.mark.parametrize("before", [1, 3])
def test_a_line_of_another_structure_is_refused(tmp_path: Path, line: str, message: str, before: int) -> None:
    """The line is named, and where the layout changed, both layouts are."""
    good = "".join(_line(k) for k in range(before))
    with pytest.raises(FormatError, match=rf"data\.log:{before + 1}: .*(?:{message})") as caught:
        _read(tmp_path, good + line + _line(9))
    assert "\n" not in str(caught.value)
    assert len(_read(tmp_path, good + _line(9)).stream) == before + 1


@pytest.mark.parametrize("layout", _LAYOUTS)
def test_brackets_separate_like_spaces(tmp_path: Path, layout: str) -> None:
    """`(1 2 3)(4 5 6)` does not hold the number 34; with and without spaces the same is read."""
    text = "".join(_line(k, layout=layout) for k in range(3))
    touching = text.replace(") (", ")(").replace(") [", ")[").replace("] (", "](")
    assert touching.count(" (") == 3
    spaced, tight = (_read(tmp_path, lines).stream for lines in (text, touching))
    assert spaced.stamp_ns.tolist() == tight.stamp_ns.tolist()
    for name in ("position", "velocity", "acceleration"):
        np.testing.assert_array_equal(tight.signal(name).values, spaced.signal(name).values)


def test_lines_of_one_form_are_read_as_among_others(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """There what stands behind the wanted numbers is cut off; neither that nor the pieces change a number."""
    good = [_line(k, stamps=f"{10 ** (k % 7)}.5") for k in range(300)]
    expected = _read(tmp_path, "".join(good)).stream
    other = _line(300, lists={10: "()"}, flags={10: "[fail]"})
    mixed = _read(tmp_path, "".join([*good, other])).stream
    monkeypatch.setattr(skeleton, "_PIECE_SIZE", 37)
    monkeypatch.setattr(port_folder, "BLOCK_SIZE", 5000)
    pieces = _read(tmp_path, "".join(good)).stream
    for name in ("position", "velocity", "acceleration"):
        np.testing.assert_array_equal(mixed.signal(name).values[:-1], expected.signal(name).values)
        np.testing.assert_array_equal(pieces.signal(name).values, expected.signal(name).values)
    assert pieces.stamp_ns.tolist() == mixed.stamp_ns.tolist()[:-1] == expected.stamp_ns.tolist()


def test_every_mixture_of_flags_is_read(tmp_path: Path) -> None:
    """All 256 mixtures of failures of eight lists in one log: each row is NaN where its flags say so."""
    mixtures = range(256)
    text = "".join(_line(k, flags={i: "[fail]" for i in range(8) if k >> i & 1}) for k in mixtures)
    stream = _read(tmp_path, text).stream
    for i, name in enumerate(("position", "velocity", "acceleration")):
        failed = np.array([bool(k >> i & 1) for k in mixtures])
        assert failed.sum() == 128
        values = stream.signal(name).values
        np.testing.assert_array_equal(np.isnan(values).all(axis=1), failed)
        np.testing.assert_array_equal(values[~failed, 0], np.deg2rad(np.arange(256)[~failed] + i))
    np.testing.assert_array_equal(stream.sequence, np.arange(256))
