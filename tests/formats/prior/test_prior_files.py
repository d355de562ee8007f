# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations that sensors come with: what they say in SI units, back again where written, and what is refused."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ForceTorqueError, FormatError, MissingFileError, UnitError
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.formats.prior.firmware_updater import FirmwareFile, parsed_firmware
from forcetorque.formats.prior.matrix_files import PolynomialModel, read_polynomial_model
from forcetorque.formats.prior.prior_file import PriorFile, RawUnit
from forcetorque.formats.prior.registry import PRIOR_FORMATS, holds_prior, read_prior_file
from tests.formats.prior.written import write_firmware_file, write_polynomial_model

RNG = np.random.default_rng(5)
MATRIX = RNG.normal(0.0, 1.0, (6, 6)) * np.repeat([1e-2, 3e-4], 3)[:, None]
REGISTERS = ("0x00 0x80 0x02 0x64 0x29 0x62",) * 6
SI = {"force_unit": "N", "moment_unit": "N m"}


def ati_text(
    *,
    version: str = "1.0",
    dz: float = 0.012,
    force: str = "N",
    torque: str = "N-m",
    scale: float = 4.0,
    user: str = "",
) -> str:
    """A file of ATI whose scaled rows are `MATRIX` in units of the file, about a point that is off by dz."""
    names = ("Fx", "Fy", "Fz", "Tx", "Ty", "Tz")
    values = [" ".join(f"{scale * value:.12g}" for value in row) for row in MATRIX]
    rows = "".join(
        f'<Axis Name="{name}" values="{row}" max="65" scale="{scale}"/>\n'
        for name, row in zip(names, values, strict=True)
    )
    return (
        f'<?xml version="1.0" encoding="utf-8"?>\n<FTSensor Serial="FT7" BodyStyle="Gamma" NumGages="6" '
        f'CalFileVersion="{version}"><Calibration PartNumber="SI-65-5" CalDate="1/2/2020" ForceUnits="{force}" '
        f'TorqueUnits="{torque}" DistUnits="m" OutputRange="20" OutputBipolar="True" GainMultiplier="1">\n{rows}'
        f'<BasicTransform Dx="0" Dy="0" Dz="{dz}" Rx="0" Ry="0" Rz="0"/>{user}</Calibration></FTSensor>\n'
    )


def user_rows(matrix: np.ndarray) -> str:
    """UserAxis of version 1.1, of five digits as ATI writes them."""
    return "".join(
        f'<UserAxis Name="{name}" values="{" ".join(f"{value:.5f}" for value in row)}" max="20"/>'
        for name, row in zip(("Fx", "Fy", "Fz", "Tx", "Ty", "Tz"), matrix, strict=True)
    )


def about(dz: float) -> np.ndarray:
    """`MATRIX` about the point at z = dz, by hand: the moment loses r x f."""
    moved = MATRIX.copy()
    moved[3] += dz * MATRIX[1]
    moved[4] -= dz * MATRIX[0]
    return moved


def firmware(version: int) -> FirmwareFile:
    """What FirmwareUpdater saves of a strain (2) or a strain2 (3)."""
    return FirmwareFile(
        serial="SN0042",
        matrix=encode_matrix(MATRIX),
        tare=(0, -3, 0, 12, 0, 0),
        registers=REGISTERS if version == 3 else None,
        offsets=None if version == 3 else (511, 512, 510, 0, 1023, 511),
    )


def write_priors(folder: Path) -> dict[str, Path]:
    """A sound file of every form."""
    folder.mkdir(exist_ok=True)
    files = {name: folder / name for name in ("v3.dat", "v2.dat", "a.cal", "b.cal", "model.xml", "plain.txt", "sn.txt")}
    write_firmware_file(files["v3.dat"], firmware(3))
    write_firmware_file(files["v2.dat"], firmware(2))
    files["a.cal"].write_text(ati_text(), encoding="utf-8")
    files["b.cal"].write_text(ati_text(version="1.1", user=user_rows(about(0.012))), encoding="utf-8")
    write_polynomial_model(files["model.xml"], PolynomialModel(matrix=MATRIX, offset=np.arange(6.0)))
    np.savetxt(files["plain.txt"], MATRIX, delimiter=",", header="made by hand")
    write_matrix_file(files["sn.txt"], encode_matrix(MATRIX))
    return files


def _read(folder: Path, text: str, **units: str) -> PriorFile:
    path = folder / "file"
    path.write_text(text, encoding="utf-8")
    return read_prior_file(path, **units)


def test_each_form_is_known_by_its_content(tmp_path: Path) -> None:
    """Whatever the file is called, exactly one form knows it, and gives the matrix."""
    known = 0
    for name, path in write_priors(tmp_path / "priors").items():
        other = tmp_path / "unnamed"
        other.write_bytes(path.read_bytes())
        text = other.read_text(encoding="utf-8")
        assert [form.sign for form in PRIOR_FORMATS if form.recognises(other, text)], name
        assert sum(form.recognises(other, text) for form in PRIOR_FORMATS) == 1, name
        expected = about(0.012) if name.endswith("cal") else MATRIX
        rounding = 1e-3 if name in ("v3.dat", "v2.dat", "sn.txt", "b.cal") else 1e-10
        read = read_prior_file(other, **(SI if name == "plain.txt" else {}))
        np.testing.assert_allclose(read.matrix, expected, atol=rounding * np.abs(expected).max(), rtol=rounding)
        known += 1
    assert known == 7


@pytest.mark.parametrize("version", [2, 3])
def test_a_board_file_is_written_back_bit_by_bit(tmp_path: Path, version: int) -> None:
    """What is read is written as it was, and its matrix is that of the matrix file with the same codes."""
    path, copy = tmp_path / "a.dat", tmp_path / "b.dat"
    write_firmware_file(path, firmware(version))
    read = parsed_firmware(path, path.read_text(encoding="ascii"))
    write_firmware_file(copy, read)
    assert copy.read_bytes() == path.read_bytes()
    assert path.read_text(encoding="ascii").startswith(f"File version:\n{version}\n")
    prior = read_prior_file(path)
    np.testing.assert_array_equal(prior.matrix, encode_matrix(MATRIX).matrix)
    assert (prior.serial, prior.raw_unit) == ("SN0042", RawUnit.COUNTS)
    assert any("tare" in note for note in prior.notes)


def test_a_sign_extended_code_is_the_same_code(tmp_path: Path) -> None:
    """The program prints negative codes with eight digits where its type is wider."""
    path = tmp_path / "a.dat"
    write_firmware_file(path, firmware(3))
    lines = path.read_text(encoding="ascii").split("\n")
    start = lines.index("Calibration matrix:") + 1
    negative = next(k for k in range(start, start + 36) if int(lines[k], 16) >= 0x8000)
    lines[negative] = f"ffff{lines[negative]}"
    path.write_text("\n".join(lines), encoding="ascii")
    np.testing.assert_array_equal(
        parsed_firmware(path, path.read_text(encoding="ascii")).matrix.codes, firmware(3).matrix.codes
    )


def test_a_model_is_read_back_exactly(tmp_path: Path) -> None:
    """Every number of matrix and offset; its inputs are wrenches, so it is no prior of counts."""
    model = PolynomialModel(matrix=MATRIX, offset=RNG.normal(0.0, 9.0, 6), name="ironcub leg")
    write_polynomial_model(tmp_path / "m.xml", model)
    read = read_polynomial_model(tmp_path / "m.xml")
    np.testing.assert_array_equal(read.matrix, model.matrix)
    np.testing.assert_array_equal(read.offset, model.offset)
    assert read.name == model.name
    assert read_prior_file(tmp_path / "m.xml").raw_unit is RawUnit.WRENCH


def test_units_of_ati_become_si(tmp_path: Path) -> None:
    """Pounds and inches, with the lever of the transform in metres; the scale of every row is divided out."""
    read = _read(tmp_path, ati_text(force="lbf", torque="lbf-in", scale=7.0, dz=0.0254))
    pound, inch = 4.4482216152605, 0.0254
    expected = about(1.0)  # an inch, in inches
    expected[:3] *= pound
    expected[3:] *= pound * inch
    np.testing.assert_allclose(read.matrix, expected, rtol=1e-9)
    np.testing.assert_allclose(read.full_scale, np.repeat([65 * pound, 65 * pound * inch], 3))
    assert (read.serial, read.date, read.raw_unit) == ("FT7", "1/2/2020", RawUnit.VOLTS)


@pytest.mark.real_data
def test_real_ati_files_agree_with_themselves(data_dir: Path, tmp_path: Path) -> None:
    """In the real file of 1.1 UserAxis is what Axis and the transform give; with the other sign it is refused."""
    folder = data_dir / "ati_cal"
    mini = read_prior_file(folder / "FT35366.cal")
    np.testing.assert_allclose(mini.matrix[3, 3], 0.01395)
    assert mini.full_scale.tolist() == [20.0, 20.0, 60.0, 1.0, 1.0, 1.0]
    text = (folder / "FT35366.cal").read_text(encoding="utf-8")
    with pytest.raises(FormatError, match="UserAxis T[xy]: expected what Axis and BasicTransform give"):
        _read(tmp_path, text.replace('Dz="0.0053594"', 'Dz="-0.0053594"'))
    gamma = read_prior_file(folder / "FT11712.cal")
    axis = np.array([37.96679, -0.16168, -19.02595, -0.18345, -18.41859, -0.18145]) / 85.1075567214177
    force = np.array([-0.12239, 0.13538, -0.78699, -33.65165, -0.03363, 31.99164]) / 4.44326834940099
    np.testing.assert_allclose(gamma.matrix[4], axis - 0.0120142 * force, rtol=1e-12)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda t: t.replace('Rx="0"', 'Rx="0.1"'), "BasicTransform: expected no rotation"),
        (lambda t: t.replace('GainMultiplier="1"', 'GainMultiplier="2"'), "GainMultiplier: expected 1, got 2"),
        (lambda t: t.replace('"1.0"', '"2.0"', 2).replace('"2.0"', '"1.0"', 1), "CalFileVersion: expected 1.0 or 1.1"),
        (lambda t: t.replace('ForceUnits="N"', 'ForceUnits="stone"'), "ForceUnits: .*got 'stone'"),
        (lambda t: t.replace('TorqueUnits="N-m"', ""), "expected the attribute TorqueUnits"),
        (lambda t: t.replace('DistUnits="m"', 'DistUnits="ell"'), "DistUnits: .*got 'ell'"),
        (lambda t: t.replace('Name="Tz"', 'Name="Ty"'), "expected Axis of Fx, Fy, Fz, Tx, Ty, Tz"),
        (lambda t: t.replace('NumGages="6"', 'NumGages="7"'), "a value for each of 7 gauges, got 6"),
        (lambda t: t.replace('scale="4.0"', 'scale="0"', 1), "scale: expected more than 0"),
        (lambda t: t.replace("<BasicTransform", "<TempComp/><BasicTransform"), "got 'TempComp'; what it does"),
        (lambda t: t.replace("</FTSensor>", ""), "expected XML"),
        (lambda t: t.replace('max="65"', 'max="many"', 1), "max: expected a number, got 'many'"),
    ],
)
def test_what_ati_does_not_document_is_refused(tmp_path: Path, change: Callable[[str], str], words: str) -> None:
    """And what is damaged, with the element."""
    assert change(ati_text()) != ati_text()
    with pytest.raises(FormatError, match=words):
        _read(tmp_path, change(ati_text()))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("\nstrain2\n", "\nstrain9\n", ":4: expected the board strain2"),
        ("File version:\n3", "File version:\n4", ":2: expected version 2 or 3"),
        ("Matrix gain:\n1", "Matrix gain:\n2", "expected the matrix gain 1"),
        ("0x00 0x80 0x02 0x64 0x29 0x62\nCal", "0x00 0x80\nCal", "expected six bytes"),
        ("Tare:\n0", "Tare:\nnil", "expected the tare of a component, got 'nil'"),
        ("Full scale values:\n", "Full scale values:\n0\n", ":67: expected the end of the file"),
    ],
)
def test_a_damaged_board_file_is_refused_by_its_line(tmp_path: Path, old: str, new: str, words: str) -> None:
    """Where it is not what the program writes."""
    path = tmp_path / "a.dat"
    write_firmware_file(path, firmware(3))
    text = path.read_text(encoding="ascii")
    assert text.count(old) == 1
    with pytest.raises(FormatError, match=words):
        _read(tmp_path, text.replace(old, new))


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('name="np">1<', 'name="np">2<', "expected a linear model .*got np 2"),
        ('name="na">0<', 'name="na">1<', "without memory"),
        ('name="row7"', 'name="row9"', "expected a row for each of 6 inputs"),
        ('name="nu">6<', 'name="nu">x<', "nu: expected a small number"),
        ("(", "[", "row1: expected six numbers in parentheses"),
    ],
)
def test_a_model_that_no_matrix_does_is_refused(tmp_path: Path, old: str, new: str, words: str) -> None:
    """Powers and memory are nothing that a matrix does."""
    write_polynomial_model(tmp_path / "m.xml", PolynomialModel(matrix=MATRIX, offset=np.zeros(6)))
    text = (tmp_path / "m.xml").read_text(encoding="utf-8")
    assert old in text
    with pytest.raises(FormatError, match=words):
        _read(tmp_path, text.replace(old, new, 1))


def test_a_plain_table_needs_its_units(tmp_path: Path) -> None:
    """They are stated or it is refused; millimetres become metres, and any number of channels is taken."""
    text = "\n".join("\t".join(map(repr, row)) for row in np.hstack([MATRIX, MATRIX]).tolist())
    with pytest.raises(FormatError, match="expected its units, which plain numbers do not specify"):
        _read(tmp_path, text)
    read = _read(tmp_path, text, force_unit="kN", moment_unit="N mm")
    np.testing.assert_allclose(read.matrix, np.hstack([MATRIX, MATRIX]) * np.repeat([1e3, 1e-3], 3)[:, None])
    with pytest.raises(UnitError, match="converts to N, got 'N m'"):
        _read(tmp_path, text, force_unit="N m", moment_unit="N m")
    with pytest.raises(FormatError, match="expected no force_unit"):
        _read(tmp_path, ati_text(), **SI)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"", "an empty file"),
        (b"%PDF-1.7 \0", "a PDF document"),
        (b"PK\x03\x04\0\0", "a ZIP archive"),
        (b"<robot><link/></robot>", "XML with the root 'robot'"),
        (b'{"schema": "forcetorque/calibration/4"}', "JSON of schema forcetorque/calibration/4"),
        (b"1 2 3\n4 5 6\n", "a text of 2 lines that begins with '1 2 3'"),
        (b"x\0" * 9, "a file of 18 bytes that is no small text"),
    ],
)
def test_what_is_no_calibration_is_called_by_its_name(tmp_path: Path, content: bytes, words: str) -> None:
    """The message lists what would be one, and says what the file is."""
    path = tmp_path / "thing"
    path.write_bytes(content)
    assert not holds_prior(path)
    with pytest.raises(FormatError, match=f"expected a calibration: .*; got {words}"):
        read_prior_file(path)
    with pytest.raises(MissingFileError):
        read_prior_file(tmp_path / "none")


def test_entities_are_refused(tmp_path: Path) -> None:
    """An XML that would grow without bound is refused before it does."""
    bomb = '<!DOCTYPE a [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;">]>'
    with pytest.raises(ForceTorqueError, match="expected plain XML"):
        _read(tmp_path, ati_text().replace("<FTSensor", f"{bomb}<FTSensor", 1))
