# SPDX-License-Identifier: BSD-3-Clause
"""The forms of priors that are known: to add one, write its file and add its line to `PRIOR_FORMATS`."""

from __future__ import annotations

import re
from pathlib import Path

from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.run_files import declare_input
from forcetorque.formats.prior.ati_cal import AtiCalibration
from forcetorque.formats.prior.firmware_updater import FirmwareUpdaterData
from forcetorque.formats.prior.matrix_files import ExportedTable, IcubMatrix, PlainTable, PolynomialModelFile
from forcetorque.formats.prior.prior_file import PriorFile, PriorFormat

LARGEST_FILE = 1 << 20
"""Bytes of a file with a matrix; what is larger is something else."""

PRIOR_FORMATS: tuple[PriorFormat, ...] = (
    IcubMatrix(),
    FirmwareUpdaterData(),
    AtiCalibration(),
    PolynomialModelFile(),
    ExportedTable(),
    PlainTable(),
)
"""Forms of prior calibrations, tried in their order; the first that recognises a file reads it."""

_KINDS = (
    (b"%PDF", "a PDF document"),
    (b"PK\x03\x04", "a ZIP archive or office document"),
    (b"\x89HDF", "an HDF5 file"),
    (b"MATLAB", "a MATLAB file"),
    (b"\x89PNG", "a picture"),
    (b"\xff\xd8", "a picture"),
    (b"\x1f\x8b", "a file packed with gzip"),
    (b"\xd0\xcf\x11\xe0", "an old office document"),
    (b"PAR1", "a Parquet table"),
)
_ROOT = re.compile(r"<([A-Za-z_][\w:.-]{0,60})")


def holds_prior(path: Path) -> bool:
    """Check whether a file is a calibration of any known form, damaged or not.

    Args:
        path: File; it exists.

    Returns:
        Whether a form knows it.
    """
    text = _text(path)
    return text is not None and any(form.recognises(path, text) for form in PRIOR_FORMATS)


def read_prior_file(path: Path | str, *, force_unit: str | None = None, moment_unit: str | None = None) -> PriorFile:
    """Read the calibration that a sensor came with, of any known form.

    Args:
        path: File.
        force_unit: Unit of the first three rows, for plain numbers, which specify none.
        moment_unit: Unit of the last three rows, for plain numbers.

    Returns:
        Its content, in SI units.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is of no known form, with what it seems to be, or damaged.
    """
    file = Path(path)
    if not file.is_file():
        raise MissingFileError(f"{file}: expected a calibration matrix file, there is none")
    declare_input(file)
    text = _text(file)
    known = [] if text is None else [form for form in PRIOR_FORMATS if form.recognises(file, text)]
    if text is None or not known:
        signs = ", ".join(form.sign for form in PRIOR_FORMATS)
        raise FormatError(f"{file}: expected a calibration: {signs}; got {_kind(file, text)}")
    if isinstance(known[0], PlainTable):
        return known[0].read(file, text, force_unit=force_unit, moment_unit=moment_unit)
    if force_unit or moment_unit:
        raise FormatError(
            f"{file}: expected no force_unit nor moment_unit: it is {known[0].sign}, which specifies its own"
        )
    return known[0].read(file, text)


def _text(file: Path) -> str | None:
    """Content of a small text; None for anything else."""
    if file.stat().st_size > LARGEST_FILE:
        return None
    data = file.read_bytes()
    if b"\0" in data:
        return None
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        # a matrix file with a damaged byte is reported as one
        return data.decode("latin-1") if IcubMatrix().recognises(file, "") else None


def _kind(file: Path, text: str | None) -> str:
    """What a file that is no calibration seems to be."""
    if text is None:
        with file.open("rb") as stream:
            head = stream.read(16)
        kinds = [kind for magic, kind in _KINDS if head.startswith(magic)]
        size = file.stat().st_size
        return kinds[0] if kinds else f"a file of {size} bytes that is no small text"
    stripped = text.lstrip()
    if not stripped:
        return "an empty file"
    if stripped[0] == "<":
        roots = [name for name in _ROOT.findall(stripped) if name.lower() != "xml"]
        return f"XML with the root {roots[0]!r}" if roots else "XML"
    if stripped[0] in "{[":
        schema = re.search(r'"schema": "(forcetorque/[\w/-]{1,40})"', stripped)
        return f"JSON of schema {schema[1]}" if schema else "JSON, or TOML"
    lines = [line for line in stripped.splitlines() if line.strip()]
    return f"a text of {len(lines)} lines that begins with {lines[0][:40]!r}"
