# SPDX-License-Identifier: BSD-3-Clause
"""Matrices as files: those of iCub, plain numbers in six rows, and linear models of Mohamed et al. 2023.

Of the polynomials `modelClassParams` only the linear one is read, a matrix and an offset. Its inputs are wrenches as
another calibration gives them, so it corrects a calibrated stream and is not per count.
"""

from __future__ import annotations

import csv
import io
import re
from dataclasses import dataclass, field
from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.base.arrays import ArrayRecord, FloatArray, array
from forcetorque.base.errors import FormatError, MissingFileError, UnitError
from forcetorque.base.input_file import read_xml
from forcetorque.base.units import parsed_number, parsed_numbers, si_factor
from forcetorque.base.wrench import WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.formats.icub_matrix import read_matrix_file, serial_number_in_name
from forcetorque.formats.prior.prior_file import PriorFile, RawUnit

_CODES = 36
_MOST_CODES_LOOKED_AT, _FEWEST_CODES = 12, 10


class IcubMatrix:
    """Files `matrix_SN026.txt`: 36 codes of one to four hex digits a line, a gain, six full scales."""

    sign = "a matrix file of iCub (36 lines of hex)"

    def recognises(self, path: Path, text: str) -> bool:
        """Look for one number of hex digits a line; a short or damaged file is one too, by its name."""
        lines = text.split("\n")
        codes = [line.strip() for line in lines[:_MOST_CODES_LOOKED_AT]]
        # nearly all: its reader reports what is wrong with one of them, line by line
        hex_only = sum(re.fullmatch("[0-9A-Fa-f]{1,4}", code) is not None for code in codes) >= _FEWEST_CODES
        return (hex_only and len(lines) > _CODES) or serial_number_in_name(path) is not None

    def read(self, path: Path, text: str) -> PriorFile:
        """Read it."""
        file = read_matrix_file(path)
        return PriorFile(
            form="matrix file of iCub",
            matrix=file.matrix,
            raw_unit=RawUnit.COUNTS,
            full_scale=np.array(file.full_scale, dtype=np.float64),
            serial=serial_number_in_name(path),
        )


_HEADINGS = ["sensor", "serial", "component", "unit", "c0_per_count"]
_MOST_CHANNELS = 64
_LARGEST = 1e12


class PlainTable:
    """Six lines of numbers between commas, semicolons, tabs or blanks; lines with # are comments."""

    sign = "six rows of numbers"

    def recognises(self, path: Path, text: str) -> bool:
        """Look for six rows of as many numbers."""
        return _rows(text) is not None

    def read(
        self, path: Path, text: str, *, force_unit: str | None = None, moment_unit: str | None = None
    ) -> PriorFile:
        """Read it, in the units that are specified."""
        rows = _rows(text)
        if rows is None:
            raise FormatError(f"{path}: expected {self.sign}")
        if force_unit is None or moment_unit is None:
            raise FormatError(
                f"{path}: expected its units, which plain numbers do not specify; write "
                f'prior = {{ path = "{path.name}", force_unit = "N", moment_unit = "N m" }}'
            )
        factors = [_factor(path, unit, si) for unit, si in ((force_unit, "N"), (moment_unit, "N m"))]
        matrix = np.repeat(factors, 3)[:, None] * rows
        return PriorFile(form="plain table", matrix=matrix, raw_unit=RawUnit.COUNTS)


class ExportedTable:
    """What `forcetorque export --to csv` writes, of one sensor."""

    sign = "a table of `forcetorque export --to csv`"

    def recognises(self, path: Path, text: str) -> bool:
        """Look at the headings."""
        return text.split("\n", 1)[0].strip().split(",")[: len(_HEADINGS)] == _HEADINGS

    def read(self, path: Path, text: str) -> PriorFile:
        """Read it."""
        try:
            lines = list(csv.DictReader(io.StringIO(text), strict=True))
        except csv.Error as error:
            raise FormatError(f"{path}: expected a table with commas, got {error}") from error
        serials = sorted({str(line.get("serial")) for line in lines})
        if len(lines) != 6 or len(serials) != 1:
            raise FormatError(f"{path}: expected six rows of one sensor, got {len(lines)} of {', '.join(serials)[:80]}")
        channels = [name for name in lines[0] if name and name.startswith("c") and name.endswith("_per_count")]
        for line, component, unit in zip(lines, WRENCH_COMPONENTS, WRENCH_UNITS, strict=True):
            if (line["component"], line["unit"]) != (component, unit):
                raise FormatError(
                    f"{path}: expected {component} in {unit}, got {str(line['component'])[:20]!r} in "
                    f"{str(line['unit'])[:20]!r}"
                )
        matrix = np.array([[_number(path, line[name]) for name in channels] for line in lines])
        offset = np.array([_number(path, line.get("offset")) for line in lines])
        return PriorFile(
            form="table of a calibration", matrix=matrix, raw_unit=RawUnit.COUNTS, offset=offset, serial=serials[0]
        )


def _rows(text: str) -> FloatArray | None:
    """Six rows of as many numbers; None for anything else."""
    lines = [
        line.strip() for line in text.lstrip("\ufeff").splitlines() if line.strip() and line.strip()[0] not in "#%"
    ]
    if len(lines) != 6:
        return None
    cells = [line.replace(",", " ").replace(";", " ").split() for line in lines]
    if len({len(row) for row in cells}) != 1 or not 1 <= len(cells[0]) <= _MOST_CHANNELS:
        return None
    try:
        rows = np.array([[float(cell) for cell in row] for row in cells])
    except ValueError:
        return None
    return rows if (np.abs(rows) < _LARGEST).all() else None


def _factor(path: Path, unit: str, si: str) -> float:
    known, factor = si_factor(unit)
    if known != si:
        raise UnitError(f"{path}: expected a unit that converts to {si}, got {unit!r}")
    return factor


def _number(path: Path, cell: str | None) -> float:
    value = parsed_number(cell or "")
    if not abs(value) < _LARGEST:
        raise FormatError(f"{path}: expected a number, got {str(cell)[:40]!r}")
    return value


_GROUP = "modelClassParams"
_ROW = re.compile(r"row([0-9]{1,4})")
_LIST = re.compile(r"\(([^()]*)\)")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PolynomialModel(ArrayRecord):
    """A correction of calibrated wrenches: `wrench = matrix reading + offset`."""

    matrix: FloatArray = field(metadata=array(6, None))
    """Matrix; shape (6, c)."""
    offset: FloatArray = field(metadata=array(6))
    """Offset; shape (6,); N, N m."""
    name: str = "polynomial"
    """What the file calls the model."""


class PolynomialModelFile:
    """XML with the group `modelClassParams`."""

    sign = f"a model file of Mohamed 2023 (XML with {_GROUP})"

    def recognises(self, path: Path, text: str) -> bool:
        """Look for the name of the group."""
        return _GROUP in text and "<group" in text

    def read(self, path: Path, text: str) -> PriorFile:
        """Read it."""
        model = read_polynomial_model(path)
        return PriorFile(
            form=f"model file of Mohamed 2023 ({model.name})",
            matrix=model.matrix,
            raw_unit=RawUnit.WRENCH,
            offset=model.offset,
            notes=("corrects wrenches that another calibration made, and takes no counts",),
        )


def read_polynomial_model(path: Path | str) -> PolynomialModel:
    """Read a model file.

    Args:
        path: XML file.

    Returns:
        The model.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is another file, or a model that is not linear or looks back in time.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a model file, there is none")
    try:
        return _read(read_xml(file))
    except FormatError as error:
        message = str(error)
        raise FormatError(message if message.startswith(str(file)) else f"{file}: {message}") from error


def _read(root: Element | None) -> PolynomialModel:
    groups = [] if root is None else [group for group in root.iter("group") if group.get("name") == _GROUP]
    if len(groups) != 1:
        raise FormatError(f"expected one group {_GROUP}, got {len(groups)}")
    params = {str(param.get("name")): (param.text or "").strip() for param in groups[0].findall("param")}
    if len(params) != len(groups[0].findall("param")):
        raise FormatError("expected every param once")
    order, outputs, inputs = (_count(params, name) for name in ("np", "ny", "nu"))
    lags = _count(params, "na"), _count(params, "nb")
    if order != 1 or outputs != 6 or lags[0] != 0 or lags[1] > 1:
        raise FormatError(
            f"expected a linear model (np 1) of six outputs without memory (na 0, nb 0 or 1), got np {order}, "
            f"ny {outputs}, na {lags[0]}, nb {lags[1]}; no matrix does what that does: apply it to the log, "
            'and specify prior = "identity" for a stream of wrenches'
        )
    rows = sorted((int(match[1]), text) for name, text in params.items() if (match := _ROW.fullmatch(name)))
    if len(rows) != inputs + 1 or [k for k, _ in rows] != list(range(rows[0][0], rows[0][0] + len(rows))):
        raise FormatError(f"expected a row for each of {inputs} inputs and one of the offset, got {len(rows)}")
    values = np.array([_six(f"row{k}", text) for k, text in rows])
    return PolynomialModel(matrix=values[:-1].T, offset=values[-1], name=params.get("string", "")[:80] or "polynomial")


def _count(params: dict[str, str], name: str) -> int:
    text = params.get(name, "")
    if not re.fullmatch("[0-9]{1,3}", text):
        raise FormatError(f"{name}: expected a small number, got {text[:40]!r}")
    return int(text)


def _six(where: str, text: str) -> list[float]:
    match = _LIST.fullmatch(text)
    numbers = [] if match is None else match[1].replace(",", " ").split()
    values = parsed_numbers(numbers)
    if len(values) != 6 or not all(abs(value) < _LARGEST for value in values):
        raise FormatError(f"{where}: expected six numbers in parentheses, got {text[:40]!r}")
    return values
