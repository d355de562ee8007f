# SPDX-License-Identifier: BSD-3-Clause
"""The XML groups: the device reads from them what was meant, and so do we."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import example, given, settings, strategies as st
from hypothesis.extra import numpy as hnp

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError
from forcetorque.calibration.export.wholebodydynamics import (
    SensorCorrection,
    corrected,
    from_calibration,
    read_groups,
    write_groups,
)
from tests.calibration.export.wholebodydynamics.device import Processor, bottle, configured, use_pre_estimated_offset
from tests.fuzzing import examples
from tests.scenes.calibrations import FACTORY, make_calibration

TOUCHES_FILES = settings(deadline=None)
"""A busy disk is no failure."""
SUM_ROUNDING = 8 * np.finfo(np.float64).eps
"""Relative to the sum of magnitudes: eight terms added in another order."""
SOLVE_ROUNDING = 1e-10
"""Relative to the largest wrench: eps times the condition number of the prior, about 1e4 with rows in N and N m."""

ANY = st.floats(allow_nan=False, allow_infinity=False)
NAMES = st.text(st.characters(codec="utf-8"), min_size=1, max_size=12)


def written_text(*corrections: SensorCorrection) -> str:
    """Text of a file with these corrections."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "ft.xml"
        write_groups(path, corrections)
        assert list(Path(folder).iterdir()) == [path]
        return path.read_bytes().decode("utf-8")


def read_data(data: bytes) -> tuple[SensorCorrection, ...]:
    """Read a file with this content."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "ft.xml"
        path.write_bytes(data)
        return read_groups(path)


def same(a: SensorCorrection, b: SensorCorrection) -> bool:
    """Whether two corrections are equal to the last bit."""
    return (
        a.sensor == b.sensor
        and a.secondary_matrix.tobytes() == b.secondary_matrix.tobytes()
        and a.offset.tobytes() == b.offset.tobytes()
        and (a.temperature_coefficients is None) is (b.temperature_coefficients is None)
        and (
            a.temperature_coefficients is None
            or b.temperature_coefficients is None
            or a.temperature_coefficients.tobytes() == b.temperature_coefficients.tobytes()
        )
        and a.reference_temperature == b.reference_temperature
    )


@st.composite
def corrections(draw: st.DrawFn, elements: st.SearchStrategy[float] = ANY) -> SensorCorrection:
    """Any correction that can be held."""
    warm = draw(st.booleans())
    try:
        return SensorCorrection(
            sensor=draw(NAMES),
            secondary_matrix=draw(hnp.arrays(np.float64, (6, 6), elements=elements)),
            offset=draw(hnp.arrays(np.float64, 6, elements=elements)),
            temperature_coefficients=draw(hnp.arrays(np.float64, 6, elements=elements)) if warm else None,
            reference_temperature=draw(elements) if warm else None,
        )
    except FormatError:  # the name
        return SensorCorrection(sensor="a&b", secondary_matrix=np.eye(6), offset=np.zeros(6))


SEVERAL = st.lists(corrections(), min_size=1, max_size=3, unique_by=lambda c: c.sensor)
TAME = st.floats(-1e3, 1e3)
"""Sums of such numbers do not overflow."""


@TOUCHES_FILES
@given(SEVERAL)
def test_what_is_written_reads_back_to_the_last_bit(several: list[SensorCorrection]) -> None:
    """Every double, -0.0 and the smallest and largest too, comes back exactly, with every name and in order."""
    back = read_data(written_text(*several).encode())
    assert len(back) == len(several) > 0
    # sensors come in the order in which the groups name them, and the first group names all
    assert all(same(a, b) for a, b in zip(several, back, strict=True))


@TOUCHES_FILES
@given(SEVERAL)
def test_the_device_gets_every_number_as_a_float_and_to_the_last_bit(several: list[SensorCorrection]) -> None:
    """By YARP's rules every number is a float, none an integer or a word, and the names are those given."""
    sensors, numbers = configured(written_text(*several))
    assert list(sensors) == [correction.sensor for correction in several]
    assert len(numbers) >= 42
    assert all(isinstance(number, float) for number in numbers)
    for correction, processor in zip(several, sensors.values(), strict=True):
        assert np.array(processor.matrix).tobytes() == correction.secondary_matrix.tobytes()
        assert np.array(processor.estimated_offset).tobytes() == correction.offset.tobytes()


def test_a_number_without_a_point_would_be_an_integer() -> None:
    """Negative control of the oracle: it tells floats, integers and words apart."""
    assert bottle("(l_leg_ft (1.0, 1 -0.5e-3 1e5)), 0x1F 1.2.3 true") == [
        ["l_leg_ft", [1.0, 1, -0.0005, 1e5]],
        31,
        "1.2.3",
        True,
    ]
    kinds = [type(word) for word in bottle("1.0 1")]
    assert kinds == [float, int]


def test_numbers_have_a_point_and_no_exponent() -> None:
    """Early versions of YARP took a number with a negative exponent for a word, which counts as zero."""
    correction = SensorCorrection(sensor="ft", secondary_matrix=np.full((6, 6), 1e-17), offset=np.full(6, -1e22))
    text = written_text(correction)
    assert "0.00000000000000001," in text
    assert "-10000000000000000000000.0," in text
    assert repr(1e-17) == "1e-17"  # what the writer must not use


def _largest_difference(
    processor: Processor, correction: SensorCorrection, reading: np.ndarray, degrees: float
) -> float:
    """Largest difference between the device and us, in parts of the sum of magnitudes."""
    ours = corrected(correction, reading, degrees)
    device = np.array(processor.filt(reading.tolist(), degrees))
    magnitude = np.abs(correction.secondary_matrix) @ np.abs(reading) + np.abs(correction.offset)
    if correction.temperature_coefficients is not None and correction.reference_temperature is not None:
        span = abs(degrees) + abs(correction.reference_temperature)
        magnitude = magnitude + np.abs(correction.temperature_coefficients) * span
    return float((np.abs(ours - device) / np.maximum(magnitude, np.finfo(np.float64).tiny)).max())


@TOUCHES_FILES
@given(corrections(TAME), hnp.arrays(np.float64, 6, elements=TAME), st.floats(-50, 100))
def test_the_device_computes_what_corrected_does(
    correction: SensorCorrection, reading: np.ndarray, degrees: float
) -> None:
    """The arithmetic of the device on the written file agrees with ours, temperature and offset included."""
    sensors, _ = configured(written_text(correction))
    use_pre_estimated_offset(sensors)
    assert _largest_difference(sensors[correction.sensor], correction, reading, degrees) <= SUM_ROUNDING


def test_the_device_gives_the_wrenches_of_the_calibration() -> None:
    """From calibration to file to device: the prior's stream becomes matrix raw + offset.

    Controls: subtracting FT_OFFSET as the device's README has it, and reading the matrix by columns.
    """
    calibration = make_calibration()
    text = written_text(from_calibration(calibration, sensor_name="l_leg_ft"))
    raw = np.random.default_rng(5).normal(size=(20, 6)) * 1000
    expected = calibration.apply(raw, serial="SN001")

    def worst(change: str) -> float:
        sensors, _ = configured(text)
        use_pre_estimated_offset(sensors)
        processor = sensors["l_leg_ft"]
        if change == "as the README says":
            processor.offset = list(processor.estimated_offset)
        elif change == "by columns":
            processor.matrix = [list(column) for column in zip(*processor.matrix, strict=True)]
        device = np.array([processor.filt(row) for row in (raw @ FACTORY.T).tolist()])
        return float(np.abs(device - expected).max() / np.abs(expected).max())

    assert worst("") < SOLVE_ROUNDING
    assert worst("as the README says") > 0.01
    assert worst("by columns") > 0.01


def test_six_zeros_leave_the_device_with_its_own_offset() -> None:
    """The device skips an FT_OFFSET of six zeros: what it found itself stays."""
    correction = SensorCorrection(sensor="ft", secondary_matrix=np.eye(6), offset=np.zeros(6))
    sensors, _ = configured(written_text(correction))
    sensors["ft"].offset = [7.0] * 6
    use_pre_estimated_offset(sensors)
    assert sensors["ft"].offset == [7.0] * 6


def test_the_file_says_that_the_offset_is_added() -> None:
    """Whoever opens the file reads the sign, the command that is needed, and where to put the file."""
    text = written_text(from_calibration(make_calibration()))
    comment = text[text.index("<!--") : text.index("-->")]
    for words in ("FT_OFFSET is ADDED", "usePreEstimatedOffset", "six zeros", "xi:include"):
        assert words in comment
    assert "TEMPERATURE" not in text
    warm = SensorCorrection(
        sensor="ft",
        secondary_matrix=np.eye(6),
        offset=np.ones(6),
        temperature_coefficients=np.ones(6),
        reference_temperature=20.0,
    )
    assert "f = S f_in + FT_OFFSET + c (T - T0)" in written_text(warm)


CONFIGURATION = """\
<?xml version="1.0" encoding="UTF-8"?>
<!DOCTYPE devices PUBLIC "-//YARP//DTD yarprobotinterface 3.0//EN" "http://www.yarp.it/DTD/yarprobotinterfaceV3.0.dtd">
<devices robot="arm" build="1">
  <device name="wholebodydynamics" type="wholebodydynamics">
    <param name="axesNames">(torso_pitch,torso_roll)</param>
    <group name="GRAVITY_COMPENSATION"><param name="enableGravityCompensation">true</param></group>
    <!-- measured by hand -->
    <group name="FT_OFFSET">
      <param name="l_leg_ft">( 24.5  , -6.25 ,
                              -62, -5.5e-2 ,  -0.25  ,  .125) </param>
      <!-- <param name="r_leg_ft">(0.0,0.0,0.0,0.0,0.0,0.0)</param> -->
    </group>
    <group name="FT_TEMPERATURE_COEFFICIENTS">
      <param name="r_leg_ft">(-0.5 0.25 1.25 -0.0625 0.5 0.75 30.5)</param>
    </group>
    <group name="FT_OFFSET"><param name="r_leg_ft">(1.0,2.0,3.0,4.0,5.0,6.0)</param></group>
  </device>
</devices>
"""


def test_a_configuration_by_hand() -> None:
    """Groups inside the device, blanks and line breaks in lists, a group in two parts, and the defaults."""
    left, right = sorted(read_data(CONFIGURATION.encode()), key=lambda correction: correction.sensor)
    assert left.offset.tolist() == [24.5, -6.25, -62.0, -0.055, -0.25, 0.125]
    np.testing.assert_array_equal(left.secondary_matrix, np.eye(6))
    assert left.temperature_coefficients is None
    assert right.temperature_coefficients is not None
    assert right.temperature_coefficients.tolist() == [-0.5, 0.25, 1.25, -0.0625, 0.5, 0.75]
    assert right.reference_temperature == 30.5
    assert right.offset.tolist() == [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]


def test_a_sensor_without_offset_has_six_zeros() -> None:
    """A group that lacks a sensor leaves it as the device has it at the start."""
    (only,) = read_data(f'<group name="FT_SECONDARY_CALIBRATION">{_param("ft", ["2.0"] * 36)}</group>'.encode())
    np.testing.assert_array_equal(only.secondary_matrix, np.full((6, 6), 2.0))
    assert not only.offset.any()


def test_the_matrix_is_row_major() -> None:
    """The second number of the list is row fx, column fy; by columns it would be the other way round."""
    numbers = [f"{k}.0" for k in range(36)]
    (only,) = read_data(f'<group name="FT_SECONDARY_CALIBRATION">{_param("ft", numbers)}</group>'.encode())
    assert only.secondary_matrix[0, 1] == 1.0
    assert only.secondary_matrix[1, 0] == 6.0


def _param(name: str, numbers: list[str]) -> str:
    return f'<param name="{name}">({", ".join(numbers)})</param>'


def _offset(numbers: str, name: str = "ft") -> str:
    return f'<params><group name="FT_OFFSET"><param name="{name}">{numbers}</param></group></params>'


BOMB = '<!DOCTYPE a [<!ENTITY b "cccccccc"><!ENTITY d "&b;&b;&b;&b;">]>'
EXTERNAL = '<!DOCTYPE a [<!ENTITY b SYSTEM "file:///etc/hostname">]>'


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", r":1: expected XML, got no element found"),
        ("<params>\n<group>\n</params>", r":3: expected XML, got mismatched tag"),
        ("<params/>", r": expected at least one of the groups FT_SECONDARY_CALIBRATION, .*FT_OFFSET, got none; "),
        ('<a><group name="GENERAL"><param name="x">1</param></group></a>', r": expected at least one of the groups"),
        ('<a><group name="FT_OFFSET"/></a>', r": FT_OFFSET: expected a <param> .*got none; remove the empty group"),
        (
            '<a><group name="FT_OFFSET"><b name="ft"/></group></a>',
            r": FT_OFFSET: .*got the element 'b' with the name 'ft'",
        ),
        ('<a><group name="FT_OFFSET"><param>(1.0)</param></group></a>', r": FT_OFFSET: expected <param name=.*None"),
        (_offset("<b/>(1,2,3,4,5,6)"), r": FT_OFFSET: 'ft': expected numbers in parentheses, got the element 'b'"),
        (_offset(""), r": FT_OFFSET: 'ft': expected 6 numbers in parentheses, got ''"),
        (_offset("1,2,3,4,5,6"), r": FT_OFFSET: 'ft': expected 6 numbers in parentheses, got '1,2,3,4,5,6'"),
        (_offset("(1,2,3,4,5,6"), r": FT_OFFSET: 'ft': expected 6 numbers in parentheses"),
        (_offset("(1,2,3,4,5,(6))"), r": FT_OFFSET: 'ft': expected 6 numbers in parentheses"),
        (_offset("(" + "7" * 500), r": FT_OFFSET: 'ft': .*got '\(7{39}\.\.\.'$"),
        (_offset("(1,2,3,4,5)"), r": FT_OFFSET: 'ft': expected 6 numbers, got 5; the device refuses"),
        (_offset("(1,2,3,4,5,6,7)"), r": FT_OFFSET: 'ft': expected 6 numbers, got 7; "),
        (_offset("(1,2,x,4,5,6)"), r": FT_OFFSET: 'ft': expected 6 finite numbers such as -0.5, got 'x'$"),
        (_offset("(1,2,nan,4,5,6)"), r": FT_OFFSET: 'ft': expected 6 finite numbers such as -0.5, got 'nan'$"),
        (_offset("(1,2,-inf,4,5,6)"), r": FT_OFFSET: 'ft': expected 6 finite numbers such as -0.5, got '-inf'$"),
        (
            _offset("(1,2,1e999,4,5,6)"),
            r": FT_OFFSET: 'ft': expected 6 finite numbers, got '1e999', which is too large",
        ),
        (_offset("(1,2,1_0,4,5,6)"), r": FT_OFFSET: 'ft': expected 6 finite numbers such as -0.5, got '1_0'$"),
        (_offset("(1,2,\u0663,4,5,6)"), r": FT_OFFSET: 'ft': expected 6 finite numbers such as -0.5, got '\u0663'$"),
        (_offset("(1,2,3,4,5,6)", name="l leg"), r": sensor: expected a name that YARP reads as one word"),
        (
            f'<a><group name="FT_SECONDARY_CALIBRATION">{_param("ft", ["1.0"] * 35)}</group></a>',
            r": FT_SECONDARY_CALIBRATION: 'ft': expected 36 numbers, got 35; ",
        ),
        (
            f'<a><group name="FT_TEMPERATURE_COEFFICIENTS">{_param("ft", ["1.0"] * 6)}</group></a>',
            r": FT_TEMPERATURE_COEFFICIENTS: 'ft': expected 7 numbers, got 6; ",
        ),
        (
            f"<a>{2 * _offset('(1,2,3,4,5,6)')}</a>",
            r": FT_OFFSET: 'ft': expected every sensor once, got it twice; the device would take the last",
        ),
        (BOMB + "<a>&d;</a>", r": expected plain XML, got EntitiesForbidden"),
        (EXTERNAL + "<a>&b;</a>", r": expected plain XML, got EntitiesForbidden"),
    ],
)
def test_wrong_content_is_refused_with_group_and_sensor(text: str, message: str) -> None:
    """One line: file, group, sensor, what was expected and what stands there."""
    with pytest.raises(FormatError, match=rf"ft\.xml{message}") as refusal:
        read_data(text.encode())
    assert "\n" not in str(refusal.value)


def test_a_missing_file_and_a_folder_are_named(tmp_path: Path) -> None:
    """There is nothing to read."""
    for path in (tmp_path / "none.xml", tmp_path):
        with pytest.raises(MissingFileError, match=f"{path.name}: expected a configuration"):
            read_groups(path)


VALID = written_text(
    from_calibration(make_calibration()),
    SensorCorrection(
        sensor="foot&ft",
        secondary_matrix=np.eye(6),
        offset=np.arange(6.0),
        temperature_coefficients=np.ones(6),
        reference_temperature=25.5,
    ),
).encode()
PAYLOAD = VALID[VALID.index(b"<params>") :]
"""Without the comment, in which most damage would do nothing."""


@pytest.mark.fuzz
@settings(deadline=None, max_examples=examples(400))
@given(st.data())
def test_damaged_bytes_give_our_errors_only(data: st.DataObject) -> None:
    """Truncated, overwritten and repeated bytes give corrections or our error in one line, nothing else."""
    content = bytearray(data.draw(st.sampled_from([VALID, PAYLOAD, CONFIGURATION.encode()])))
    for _ in range(data.draw(st.integers(0, 3))):
        content[data.draw(st.integers(0, len(content) - 1))] = data.draw(st.integers(0, 255))
    start, end = sorted(data.draw(st.tuples(st.integers(0, len(content)), st.integers(0, len(content)))))
    shape = data.draw(st.sampled_from(["whole", "cut", "repeated"]))
    damaged = {"whole": content, "cut": content[:end], "repeated": content[:end] + content[start:]}[shape]
    message, found = "", ()
    try:
        found = read_data(bytes(damaged))
    except ForceTorqueError as error:
        message = str(error)
    assert bool(message) is not bool(found)
    assert "\n" not in message


@TOUCHES_FILES
@given(st.binary(max_size=200))
@example(b"\x00")
@example(b"\xff\xfe<\x00a\x00")
@example(b'<?xml version="1.0" encoding="nonsense"?><a/>')
@example(b'<?xml version="1.0" encoding="utf-7"?><a/>')
@example(b"<a>" * 5000)
def test_any_bytes_are_refused(data: bytes) -> None:
    """Bytes that hold no groups are our error."""
    with pytest.raises(FormatError, match=r"ft\.xml"):
        read_data(data)


def test_only_readable_files_are_written(tmp_path: Path) -> None:
    """No sensor at all, or one sensor twice, is refused before anything is written."""
    path = tmp_path / "ft.xml"
    one = from_calibration(make_calibration())
    with pytest.raises(FormatError, match=r"ft\.xml: expected at least one sensor to write, got none"):
        write_groups(path, [])
    with pytest.raises(FormatError, match=r"ft\.xml: expected every sensor once, got 'leg_ft' 2 times"):
        write_groups(path, [one, one])
    assert not path.exists()


def test_a_failed_write_keeps_the_old_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """When writing fails, the old content stays and no temporary file is left."""
    path = tmp_path / "ft.xml"
    write_groups(path, [from_calibration(make_calibration())])
    before = path.read_bytes()
    monkeypatch.setattr(Path, "replace", lambda *_: (_ for _ in ()).throw(OSError("disk full")))
    with pytest.raises(OSError, match="disk full"):
        write_groups(path, [from_calibration(make_calibration(name="other"))])
    assert path.read_bytes() == before
    assert [p.name for p in tmp_path.iterdir()] == ["ft.xml"]
