# SPDX-License-Identifier: BSD-3-Clause
"""Calibration matrix files of iCub: every byte kept, every code decoded and encoded as the DSP reads it."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import pytest
from hypothesis import assume, example, given, settings, strategies as st
from hypothesis.extra import numpy as hnp

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError, ShapeError
from forcetorque.formats.icub_matrix import (
    MatrixFile,
    MatrixLayout,
    encode_matrix,
    read_matrix_file,
    serial_number_in_name,
    write_matrix_file,
)

HALF_LSB_SLACK = 2 * np.finfo(np.float64).eps
"""Relative: decoding rounds once, in the division by 32767; comparing with a bound rounds once more."""
BY_HAND = 1e-17
"""Absolute, N/count: the values worked out by hand are about 3e-4 and written with 17 decimals."""

TOUCHES_FILES = settings(deadline=None)
"""A busy disk is no failure."""

FULL_SCALES = (1587, 1823, 2113, 37, 38, 24)


def lines_of(*, first: str = "FF1E", gain: str = "1", full_scales: tuple[int, ...] = FULL_SCALES) -> list[str]:
    """Lines of a file with one coefficient and 35 zeros."""
    return [first, *["0"] * 35, gain, *(str(scale) for scale in full_scales)]


def text_of(lines: list[str], newline: str = "\r\n") -> bytes:
    """Bytes of a file whose lines all end."""
    return "".join(line + newline for line in lines).encode("ascii")


VALID = text_of(lines_of())


def read_bytes(data: bytes) -> MatrixFile:
    """Read a file with this content."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "matrix.txt"
        path.write_bytes(data)
        return read_matrix_file(path)


def read_unless_refused(data: bytes) -> MatrixFile | None:
    """Read a file with this content, None if it is refused with an error of ours."""
    try:
        return read_bytes(data)
    except ForceTorqueError:
        return None


def written_bytes(file: MatrixFile) -> bytes:
    """Bytes of the file once written."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / "matrix.txt"
        write_matrix_file(path, file)
        assert list(Path(folder).iterdir()) == [path]
        return path.read_bytes()


def half_lsb(full_scale: np.ndarray) -> np.ndarray:
    """Half of what one code is worth in each row; shape (6, 1); N/count, N m/count."""
    return full_scale[:, np.newaxis] / 32767 / 2**16


def excess_over_half_lsb(file: MatrixFile, matrix: np.ndarray) -> float:
    """Largest error of the decoded matrix beyond half a least significant bit; at most 0 is right."""
    bound = half_lsb(np.array(file.full_scale, dtype=np.float64)) + HALF_LSB_SLACK * np.abs(matrix)
    return float((np.abs(file.matrix - matrix) - bound).max())


def test_a_file_decodes_to_the_values_computed_by_hand() -> None:
    """FF1E is 65310 - 65536 = -226; C = 1587 * -226 / (32768 * 32767) = -358662 / 1073709056.

    The order is row-major, so line 14 is row fz, channel 1: 304272 / 1073709056; and line 36 is row tz,
    channel 5: 252384 / 1073709056. The quotients were worked out to more digits than are written.
    """
    lines = lines_of()
    lines[13] = "90"  # row 2, column 1: 144, full scale 2113
    lines[35] = "2914"  # row 5, column 5: 10516, full scale 24
    file = read_bytes(text_of(lines))
    expected = np.zeros((6, 6))
    expected[0, 0] = -0.00033404021135498
    expected[2, 1] = 0.00028338403061769
    expected[5, 5] = 0.00023505809007538
    np.testing.assert_allclose(file.matrix, expected, rtol=0, atol=BY_HAND)
    assert file.codes[0, 0] == -226
    assert file.full_scale == FULL_SCALES
    assert file.gain == 1


def test_without_sign_extension_the_value_by_hand_is_missed() -> None:
    """Negative control: reading FF1E as 65310 gives another matrix."""
    unsigned = 1587 * (0xFF1E / 2**15) / 32767
    assert abs(unsigned - read_bytes(VALID).matrix[0, 0]) > 1000 * BY_HAND


def test_the_most_negative_code_decodes_to_exactly_minus_one_full_scale() -> None:
    """8000 is -1, not +1; 7FFF is one code below +1."""
    assert read_bytes(text_of(lines_of(first="8000"))).matrix[0, 0] == -1587 / 32767
    assert read_bytes(text_of(lines_of(first="7FFF"))).matrix[0, 0] == 1587 * (32767 / 32768) / 32767


@pytest.mark.parametrize("newline", ["\r\n", "\n"])
@pytest.mark.parametrize("ending", [0, 1, 2, 5])
@pytest.mark.parametrize("first", ["ff1e", "FF1E", "00FF", "000c", "0000", "0"])
def test_line_ends_case_padding_and_last_newlines_are_kept(newline: str, ending: int, first: str) -> None:
    """Writing what was read gives the same bytes for every layout."""
    data = (newline.join(lines_of(first=first)) + newline * ending).encode("ascii")
    file = read_bytes(data)
    assert written_bytes(file) == data
    assert (file.layout.newline, file.layout.final_newlines) == (newline, ending)


@pytest.mark.real_data
def test_every_file_of_the_workbench_is_kept_byte_for_byte(data_dir: Path) -> None:
    """The files of 32 sensors and the identity, CRLF and LF, upper and lower case, one with an empty line."""
    paths = sorted((data_dir / "icub_workbench_matrices").glob("matrix_*.txt"))
    layouts = []
    for path in paths:
        file = read_matrix_file(path)
        assert written_bytes(file) == path.read_bytes(), path.name
        layouts.append(file.layout)
    assert len(layouts) == 33
    assert {layout.newline for layout in layouts} == {"\r\n", "\n"}
    assert {layout.final_newlines for layout in layouts} == {1, 2}
    assert sum(any(layout.lower_case) for layout in layouts) == 1


@pytest.mark.real_data
def test_the_copies_of_the_yoga_data_set_are_kept_and_equal(data_dir: Path) -> None:
    """The six sensors of that robot have the bytes and the matrix of the workbench's files."""
    paths = sorted((data_dir / "icub_genova02_yoga" / "sensorCalibMatrices").glob("matrix_*.txt"))
    for path in paths:
        file = read_matrix_file(path)
        assert written_bytes(file) == path.read_bytes(), path.name
        workbench = read_matrix_file(data_dir / "icub_workbench_matrices" / path.name)
        np.testing.assert_array_equal(file.matrix, workbench.matrix)
    assert len(paths) == 6


@pytest.mark.real_data
def test_the_codes_of_every_real_file_are_encoded_again(data_dir: Path) -> None:
    """Decoding, then encoding against the file's own full scale, gives the same codes."""
    paths = sorted((data_dir / "icub_workbench_matrices").glob("matrix_*.txt"))
    for path in paths:
        file = read_matrix_file(path)
        again = encode_matrix(file.matrix, full_scale=file.full_scale)
        np.testing.assert_array_equal(again.codes, file.codes, err_msg=path.name)
    assert len(paths) == 33


@pytest.mark.real_data
def test_the_factory_layout_is_the_default_one(data_dir: Path) -> None:
    """A new file encoded from a factory matrix has the bytes of the factory's file."""
    path = data_dir / "icub_workbench_matrices" / "matrix_SN026.txt"
    file = read_matrix_file(path)
    assert written_bytes(encode_matrix(file.matrix, full_scale=file.full_scale)) == path.read_bytes()


@pytest.mark.real_data
def test_full_scales_chosen_here_are_those_of_the_factory(data_dir: Path) -> None:
    """The full scale is the ceiling of 32767 times the row sum.

    Rounding of the factory's codes moves a row sum by at most 6 half codes, so by less than one unit
    of these full scales: a full scale can differ by one where the sum was next to an integer.
    """
    paths = sorted((data_dir / "icub_workbench_matrices").glob("matrix_SN*.txt"))
    differences = []
    for path in paths:
        file = read_matrix_file(path)
        differences.append(np.subtract(encode_matrix(file.matrix).full_scale, file.full_scale))
    assert len(differences) == 32
    assert np.abs(differences).max() <= 1


ROW_SCALES = st.lists(st.sampled_from([1.0, 1e-2, 1e-5, 1e-12, 0.0]), min_size=6, max_size=6)
# 0.33 times 6 coefficients times 32767 counts is just below the largest full scale, 65535.
COEFFICIENTS = hnp.arrays(np.float64, (6, 6), elements=st.floats(-0.33, 0.33))


@given(COEFFICIENTS, ROW_SCALES)
@example(np.diag([1.0, -1.0, 0.5, -0.5, 2.0**-15, 0.0]), [1.0] * 6)
def test_decoding_is_within_half_a_bit_of_what_was_encoded(coefficients: np.ndarray, scales: list[float]) -> None:
    """The codes belong to the stored full scale, which holds the row sum and is the smallest that does."""
    matrix = coefficients * np.array(scales)[:, np.newaxis]
    file = encode_matrix(matrix)
    assert excess_over_half_lsb(file, matrix) <= 0.0
    largest = 32767 * np.abs(matrix).sum(axis=1)
    full_scale = np.array(file.full_scale)
    assert (full_scale >= largest * (1 - 8 * np.finfo(np.float64).eps)).all()
    assert (full_scale <= np.maximum(np.ceil(largest) + 1, 1)).all()


@TOUCHES_FILES
@given(COEFFICIENTS, ROW_SCALES)
def test_what_is_encoded_is_read_back(coefficients: np.ndarray, scales: list[float]) -> None:
    """Write, then read: the same codes and full scales, in the factory's layout."""
    file = encode_matrix(coefficients * np.array(scales)[:, np.newaxis])
    back = read_bytes(written_bytes(file))
    np.testing.assert_array_equal(back.codes, file.codes)
    assert back.full_scale == file.full_scale
    assert (back.layout.newline, back.layout.final_newlines) == ("\r\n", 1)
    assert not any(back.layout.lower_case)


def test_encoding_against_the_full_scale_before_its_ceiling_breaks_the_bound() -> None:
    """Negative control: codes for 20.5 stored with 21 are wrong by far more than half a bit."""
    matrix = np.full((6, 6), 20.5 / 32767 / 6)
    file = encode_matrix(matrix)
    assert set(file.full_scale) == {21}
    assert excess_over_half_lsb(file, matrix) <= 0.0
    unrounded = np.rint(matrix * 32767 / 20.5 * 2**15).astype(np.int64)
    wrong = MatrixFile(codes=unrounded, full_scale=file.full_scale)
    assert excess_over_half_lsb(wrong, matrix) > 50 * half_lsb(np.array(file.full_scale)).max()


def test_a_matrix_is_encoded_to_the_codes_computed_by_hand() -> None:
    """Row fx: 32767 * (.25 + .5) = 24575.25, so 24576; .25 * 32767 / 24576 * 32768 = 10922.33, .5: -21844.67."""
    matrix = np.zeros((6, 6))
    matrix[0, :2] = 0.25, -0.5
    file = encode_matrix(matrix)
    assert file.full_scale == (24576, 1, 1, 1, 1, 1)
    assert file.codes[0, :2].tolist() == [10922, -21845]
    assert not file.codes[1:].any()
    assert written_bytes(file).startswith(b"2AAA\r\nAAAB\r\n0\r\n")


def test_a_lone_coefficient_at_plus_one_raises_the_full_scale_by_one() -> None:
    """Code 32768 does not exist: 1 N/count needs 32768 N, but -1 N/count fits 32767 N as 8000."""
    file = encode_matrix(np.diag([1.0, -1.0, 0.0, 0.0, 0.0, 0.0]))
    assert file.full_scale[:2] == (32768, 32767)
    assert np.diag(file.codes)[:2].tolist() == [32767, -32768]
    assert file.matrix[1, 1] == -1.0


@given(st.floats(1e-6, 1.9), st.booleans())
def test_the_full_scale_named_in_a_refusal_is_the_smallest_that_works(magnitude: float, negative: bool) -> None:
    """One unit less is refused with the number that is then accepted."""
    matrix = np.zeros((6, 6))
    matrix[3, 4] = -magnitude if negative else magnitude
    too_small = int(magnitude * 32767 * 0.9)
    assume(too_small >= 1)
    with pytest.raises(FormatError, match=r"matrix\[3, 4\] \(tx\).*smallest full scale") as refusal:
        encode_matrix(matrix, full_scale=[1, 1, 1, too_small, 1, 1])
    assert repr(float(matrix[3, 4])) in str(refusal.value)
    smallest = int(str(refusal.value).rsplit(" ", 1)[1])
    file = encode_matrix(matrix, full_scale=[1, 1, 1, smallest, 1, 1])
    assert excess_over_half_lsb(file, matrix) <= 0.0
    with pytest.raises(FormatError):
        encode_matrix(matrix, full_scale=[1, 1, 1, smallest - 1, 1, 1])


@pytest.mark.parametrize(("sign", "expected"), [(1.0, 32768), (-1.0, 32767)])
def test_the_tie_at_the_largest_code_is_decided_by_its_sign(sign: float, expected: int) -> None:
    """1 N/count with full scale 32767 is code 32768, which is refused; -1 N/count is code -32768, which fits."""
    matrix = np.diag([sign, 0, 0, 0, 0, 0])
    encode_matrix(matrix, full_scale=[expected, 1, 1, 1, 1, 1])
    with pytest.raises(FormatError, match=f"smallest full scale that holds it is {expected}$"):
        encode_matrix(matrix, full_scale=[expected - 1, 1, 1, 1, 1, 1])


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_a_matrix_that_is_not_finite_is_refused(value: float) -> None:
    """The message names the coefficient."""
    matrix = np.zeros((6, 6))
    matrix[2, 5] = value
    with pytest.raises(FormatError, match=r"matrix\[2, 5\]: expected a finite coefficient"):
        encode_matrix(matrix)


@pytest.mark.parametrize("magnitude", [2.1, 1e300, np.finfo(np.float64).max])
def test_a_matrix_beyond_every_full_scale_is_refused(magnitude: float) -> None:
    """The sensor stores full scales in 16 bits; such a matrix has other units."""
    matrix = np.zeros((6, 6))
    matrix[4, 0] = magnitude
    with pytest.raises(FormatError, match=r"row 4 \(ty\).*at most 65535 N m.*per raw count"):
        encode_matrix(matrix)
    with pytest.raises(FormatError, match=r"no full scale up to 65535 holds it; check the units"):
        encode_matrix(matrix, full_scale=[1, 1, 1, 1, 65535, 1])


def test_a_wrong_number_of_coefficients_or_full_scales_is_refused() -> None:
    """Shapes are checked before anything is computed."""
    with pytest.raises(ShapeError, match="matrix: expected an array of shape"):
        encode_matrix(np.zeros((6, 7)))
    with pytest.raises(ShapeError, match="full_scale: expected 6 integers"):
        encode_matrix(np.zeros((6, 6)), full_scale=[1] * 5)


@pytest.mark.parametrize("scale", [0, -5, 65536, 1.5])
def test_a_full_scale_the_sensor_cannot_hold_is_refused(scale: float) -> None:
    """Full scales are integers from 1 to 65535."""
    with pytest.raises(FormatError, match="full_scale"):
        encode_matrix(np.zeros((6, 6)), full_scale=[1, 1, scale, 1, 1, 1])  # type: ignore[list-item]


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"", r":1: expected 43 lines .* got 0; get a complete copy"),
        (text_of(lines_of()[:20]), r":20: expected 43 lines .* got 20; get a complete copy"),
        (text_of(lines_of()[:-1]), r":42: expected 43 lines .* got 42; get a complete copy"),
        (text_of([*lines_of(), "7"]), r":44: expected the end of the file after 43 lines, got '7'; remove"),
        (text_of(lines_of(first="10000")), r":1: expected 1 to 4 hex digits.* got '10000'"),
        (text_of(lines_of(first="XYZ")), r":1: expected 1 to 4 hex digits.* got 'XYZ'"),
        (text_of(lines_of(first="-1")), r":1: expected 1 to 4 hex digits.* got '-1'"),
        (text_of(lines_of(first="0x1F")), r":1: expected 1 to 4 hex digits.* got '0x1F'"),
        (text_of(lines_of(first="fF")), r":1: expected 1 to 4 hex digits, all upper-case or all lower-case, got 'fF'"),
        (text_of(lines_of(first="9" * 1000)), r":1: .* got '9{40}\.\.\.'; the first 36"),
        (text_of(["", *lines_of()]), r":1: expected 1 to 4 hex digits.* got ''"),
        (text_of(lines_of(gain="2")), r":37: expected the matrix gain 1, got '2'; what another gain means"),
        (text_of(lines_of(gain="1.0")), r":37: expected the matrix gain 1, got '1\.0'"),
        (text_of(lines_of(full_scales=(1, 1, 0, 1, 1, 1))), r":40: expected a full scale.* got '0'"),
        (text_of(lines_of(full_scales=(1, 1, 1, 1, 1, -3))), r":43: expected a full scale.* got '-3'"),
        (text_of(lines_of(full_scales=(65536, 1, 1, 1, 1, 1))), r":38: expected a full scale.* got '65536'"),
        (text_of([*lines_of()[:-1], "24.5"]), r":43: expected a full scale.* got '24\.5'"),
        (b"\xef\xbb\xbf" + VALID, r":1: expected ASCII text, got the byte 0xEF; save"),
        (VALID.replace(b"1823", b"18\xb23"), r":39: expected ASCII text, got the byte 0xB2; save"),
        (VALID.replace(b"0\r\n", b"0\n", 1), r":2: expected the line to end in CRLF as line 1 does, got LF; convert"),
        (
            VALID.replace(b"\r\n", b"\n").replace(b"0\n", b"0\r\n", 1),
            r":2: expected the line to end in LF as line 1 does, got CRLF; convert",
        ),
    ],
)
def test_wrong_content_is_refused_with_file_line_and_remedy(data: bytes, message: str) -> None:
    """One line: where, expected, got, what to do."""
    with pytest.raises(FormatError, match=rf"matrix\.txt{message}") as refusal:
        read_bytes(data)
    assert re.search(r"expected .*, got .*; .", str(refusal.value))
    assert "\n" not in str(refusal.value)


def test_a_missing_file_and_a_folder_are_refused(tmp_path: Path) -> None:
    """Both name the path."""
    with pytest.raises(MissingFileError, match=r"nowhere\.txt: expected a calibration matrix file"):
        read_matrix_file(tmp_path / "nowhere.txt")
    with pytest.raises(MissingFileError, match="expected a calibration matrix file"):
        read_matrix_file(tmp_path)


@TOUCHES_FILES
@given(
    st.one_of(
        st.binary(max_size=400),
        st.integers(0, len(VALID)).map(lambda length: VALID[:length]),
        st.tuples(st.integers(0, len(VALID) - 1), st.integers(0, 255)).map(
            lambda flip: VALID[: flip[0]] + bytes([flip[1]]) + VALID[flip[0] + 1 :]
        ),
        st.lists(st.sampled_from([b"0", b"f", b"F", b"1", b"\r", b"\n", b"\r\n", b" ", b"+"]), max_size=8).map(
            lambda tail: VALID[:-2] + b"".join(tail)
        ),
        st.lists(
            st.from_regex(r"[0-9a-f]{1,4}|[0-9A-F]{1,4}", fullmatch=True).map(lambda text: text.encode("ascii")),
            min_size=36,
            max_size=36,
        ).map(lambda entries: b"\n".join([*entries, b"1", *[b"7"] * 6])),
    )
)
@example(VALID)
def test_any_bytes_are_refused_or_kept(data: bytes) -> None:
    """Nothing but our own errors is raised, and what is accepted is written back byte for byte."""
    file = read_unless_refused(data)
    assert file is None or written_bytes(file) == data


@TOUCHES_FILES
@given(
    hnp.arrays(np.int64, (6, 6), elements=st.integers(-32768, 32767)),
    st.lists(st.integers(1, 65535), min_size=6, max_size=6),
    st.sampled_from(["\r\n", "\n"]),
    st.lists(st.integers(1, 4), min_size=36, max_size=36),
    st.lists(st.booleans(), min_size=36, max_size=36),
    st.integers(0, 3),
)
def test_every_valid_content_survives_the_file(
    codes: np.ndarray, scales: list[int], newline: str, widths: list[int], lower_case: list[bool], final_newlines: int
) -> None:
    """Reading what was written gives the numbers again, and writing them once more gives the same bytes."""
    layout = MatrixLayout(
        newline=newline, widths=tuple(widths), lower_case=tuple(lower_case), final_newlines=final_newlines
    )
    data = written_bytes(MatrixFile(codes=codes, full_scale=tuple(scales), layout=layout))
    back = read_bytes(data)
    np.testing.assert_array_equal(back.codes, codes)
    assert back.full_scale == tuple(scales)
    assert written_bytes(back) == data


def test_the_codes_cannot_be_changed_from_outside() -> None:
    """The file holds a read-only copy."""
    codes = np.zeros((6, 6), dtype=np.int64)
    file = MatrixFile(codes=codes, full_scale=FULL_SCALES)
    codes[0, 0] = 1
    assert file.codes[0, 0] == 0
    with pytest.raises(ValueError, match="read-only"):
        file.codes[0, 0] = 1


@pytest.mark.parametrize(
    ("changes", "error", "message"),
    [
        ({"codes": np.zeros((6, 5), dtype=np.int64)}, ShapeError, "codes: expected an array of shape"),
        ({"codes": np.zeros((6, 6))}, ShapeError, "codes: expected integers, got float64; use encode_matrix"),
        ({"codes": np.full((6, 6), 32768)}, FormatError, "codes: expected signed numbers from -32768 to 32767"),
        ({"codes": np.full((6, 6), -32769)}, FormatError, "codes: expected signed numbers"),
        ({"codes": np.full((6, 6), 2**64 - 1, dtype=np.uint64)}, FormatError, "codes: expected signed numbers"),
        ({"gain": 2}, FormatError, "gain: expected the matrix gain 1, got 2"),
        ({"full_scale": (1, 2, 3)}, ShapeError, "full_scale: expected 6 integers"),
        ({"full_scale": (1, 1, 1, 1, 1, 2.5)}, FormatError, "full_scale: expected integers.*; round them up"),
    ],
)
def test_contents_the_sensor_cannot_hold_are_refused(
    changes: dict[str, object], error: type[ForceTorqueError], message: str
) -> None:
    """A data class in memory obeys the rules of the file."""
    file = MatrixFile(codes=np.zeros((6, 6), dtype=np.int64), full_scale=FULL_SCALES)
    with pytest.raises(error, match=message):
        replace(file, **changes)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    "changes", [{"newline": "\r"}, {"widths": (5,) * 36}, {"widths": ()}, {"lower_case": ()}, {"final_newlines": -1}]
)
def test_layouts_that_could_not_be_read_again_are_refused(changes: dict[str, object]) -> None:
    """Only what the reader accepts can be written; the message names the field."""
    with pytest.raises(FormatError, match=f"^{next(iter(changes))}: expected"):
        MatrixLayout(**changes)  # type: ignore[arg-type]


def test_a_failed_write_leaves_the_old_file_and_nothing_else(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The content is complete under a temporary name before the file is touched."""
    path = tmp_path / "matrix_SN026.txt"
    path.write_bytes(VALID)
    file = read_bytes(text_of(lines_of(first="1234")))

    def refuse(temporary: Path, target: Path) -> None:
        assert temporary.parent.parent == target.parent == tmp_path
        assert temporary.read_bytes().startswith(b"1234\r\n")
        raise OSError("the disk is full")

    with monkeypatch.context() as patch:
        patch.setattr(Path, "replace", refuse)
        with pytest.raises(OSError, match="the disk is full"):
            write_matrix_file(path, file)
    assert path.read_bytes() == VALID
    assert list(tmp_path.iterdir()) == [path]
    write_matrix_file(path, file)
    assert path.read_bytes().startswith(b"1234\r\n")


def test_writing_to_a_missing_folder_is_refused(tmp_path: Path) -> None:
    """Folders are not made by the way."""
    with pytest.raises(MissingFileError, match="expected an existing folder"):
        write_matrix_file(tmp_path / "nowhere" / "matrix.txt", read_bytes(VALID))
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("name", "serial_number"),
    [
        ("matrix_SN026.txt", "SN026"),
        ("folder/matrix_SN106571.txt", "SN106571"),
        ("matrix_identity.txt", None),
        ("matrix_SN026_extraCoeff.txt", None),
        ("SN026.txt", None),
    ],
)
def test_the_serial_number_is_read_from_factory_names_only(name: str, serial_number: str | None) -> None:
    """Any other name says nothing about the sensor."""
    assert serial_number_in_name(name) == serial_number
