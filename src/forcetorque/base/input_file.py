# SPDX-License-Identifier: BSD-3-Clause
"""Files of the user: regular ones only, each an input of the run; XML files are parsed without entities."""

from __future__ import annotations

import stat
from io import BytesIO
from pathlib import Path
from xml.etree.ElementTree import Element, ParseError, TreeBuilder

from defusedxml.common import DefusedXmlException
from defusedxml.ElementTree import DefusedXMLParser, parse

from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.run_files import declare_input

ALWAYS_UNPACKED = 512 << 20
"""Bytes that every file may unpack to, however small it is: 18 channels of 1 kHz for an hour as float64."""
UNPACKED_RATIO = 32
"""Bytes that a file may unpack to for each of its own, beyond that: numbers that are not packed need eight at most,
those of a log at rest some twenty; a file that was made to fill the memory has a thousand."""

READ_ERRORS = (ArithmeticError, AttributeError, LookupError, MemoryError, OSError, RuntimeError, TypeError, ValueError)
"""What readers of other libraries raise on damaged files, beside errors of their own."""

_KINDS = (
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
)


def accept_input(path: Path) -> None:
    """Remember a file or folder as an input of the run; a pipe, a socket or a device would keep its reader waiting.

    Args:
        path: Path of a file or a folder, which need not be there.

    Raises:
        FormatError: If something else is there.
        OutputError: If it is to be written too.
    """
    if path.exists() and not (path.is_file() or path.is_dir()):
        require_file(path, "a file or a folder")
    declare_input(path)


def require_file(path: Path, expected: str) -> None:
    """Remember a file as an input of the run; what is no regular file, such as a pipe, is refused.

    Args:
        path: Path of a file to open.
        expected: What it should be, such as `an HDF5 file`.

    Raises:
        MissingFileError: If nothing is there.
        FormatError: If a folder, a pipe, a socket or a device is there.
        OutputError: If it is to be written too.
    """
    try:
        mode = path.stat().st_mode
    except (OSError, ValueError) as error:
        raise MissingFileError(f"{path}: expected {expected}, there is none") from error
    kind = next((name for is_kind, name in _KINDS if is_kind(mode)), None)
    if kind is not None:
        raise FormatError(f"{path}: expected {expected}, got {kind}; name a file")
    declare_input(path)


def read_text(path: Path, expected: str) -> str:
    """Read a file of text.

    Args:
        path: Path of a file.
        expected: What it should be, such as `a plan of a patch`.

    Returns:
        Its text.

    Raises:
        MissingFileError: If nothing is there.
        FormatError: If it is no file, or no text in UTF-8.
    """
    require_file(path, expected)
    try:
        return path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise FormatError(
            f"{path}: expected {expected} in UTF-8, got bytes that are no text at byte {error.start}; save it as UTF-8"
        ) from error
    except OSError as error:
        raise FormatError(f"{path}: expected {expected}, got: {error.strerror}") from error


def unpacked_limit(path: Path) -> int:
    """Give the number of bytes that a file may unpack to.

    Args:
        path: The file, or a folder whose files are one log.

    Returns:
        `ALWAYS_UNPACKED`, or `UNPACKED_RATIO` for each byte of it where that is more.
    """
    files = path.iterdir() if path.is_dir() else (path,)
    return max(ALWAYS_UNPACKED, UNPACKED_RATIO * sum(file.stat().st_size for file in files if file.is_file()))


def require_unpacked(path: Path, size: int, *, where: str = "") -> None:
    """Refuse a file that unpacks to much more than it is, before that fills the memory.

    Args:
        path: As of `unpacked_limit`.
        size: Bytes that it unpacks to, of numbers those of float64, or of what is read of it.
        where: Place in the file, such as a name of an array.

    Raises:
        FormatError: If that is more than the limit.
    """
    if size <= ALWAYS_UNPACKED:
        return
    limit = unpacked_limit(path)
    if size > limit:
        place = f"{path}: {where}" if where else str(path)
        raise FormatError(
            f"{place}: expected a file that unpacks to at most {limit >> 20} MiB ({ALWAYS_UNPACKED >> 20} MiB, or "
            f"{UNPACKED_RATIO} times its size), got {size >> 20} MiB; copy it again if it is damaged, else save it "
            "without compression or split it"
        )


def read_xml(file: Path, *, comments: bool = False) -> Element | None:
    """Parse an XML file that exists.

    Args:
        file: The file.
        comments: Whether comments inside the root element are kept, to write it again.

    Returns:
        Its root element.

    Raises:
        FormatError: If it is not XML, or uses entities or external files.
    """
    declare_input(file)
    return _parsed_xml(file, str(file), comments=comments)


def xml_of_text(text: str | bytes, *, where: str) -> Element | None:
    """Parse XML that is no file.

    Args:
        text: The XML; bytes in the encoding that it declares.
        where: What has it, for messages.

    Returns:
        Its root element.
    """
    return _parsed_xml(BytesIO(text if isinstance(text, bytes) else text.encode()), where, comments=False)


def _parsed_xml(source: Path | BytesIO, where: str, *, comments: bool) -> Element | None:
    try:
        parser = DefusedXMLParser(target=TreeBuilder(insert_comments=comments))
        root: Element | None = parse(source, parser=parser).getroot()
    except ParseError as error:
        raise FormatError(f"{where}:{error.position[0]}: expected XML, got {error.msg}") from error
    except (DefusedXmlException, ValueError, LookupError) as error:
        raise FormatError(f"{where}: expected plain XML, got {error!r}") from error
    return root
