# SPDX-License-Identifier: BSD-3-Clause
"""The folder that yarpdatadumper writes for a port: which file holds the messages and how they are stamped.

`info.log` is as `src/commands/yarpdatadumper/main.cpp` of YARP writes it: `Type: Bottle;`, then
`Stamp: tx;`, `Stamp: rx;` or `Stamp: tx+rx;` (absent before about 2017). `rx` is also written when
no option chose: then the sender's stamp was logged wherever there was one. Where `tx` was chosen,
messages without an envelope, whose sequence number is negative, carry both stamps all the same.
"""

from __future__ import annotations

import gzip
import re
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import BufferedIOBase
from pathlib import Path

from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.input_file import require_unpacked
from forcetorque.formats.yarp.message import Bottle, is_number, quote

LOG_NAMES = ("data.log", "data.log.gz")
"""Names that the file of messages may have."""

BLOCK_SIZE = 1 << 21
"""Bytes per read, which bounds what is held besides the result."""

LINE_LIMIT = 1 << 16
"""Bytes of a line: ten times those of a board with fifty joints; it stops files that are not logs."""

_UNKNOWN = ("unknown",)
_INFO_SIZE = 4096
"""Bytes of `info.log` that are read: what matters is in its first two lines."""
_TYPE = re.compile(r"^Type: *([^;\r\n]*)", re.MULTILINE)
_STAMP = re.compile(r"^Stamp: *([^;\r\n]*)", re.MULTILINE)
_STAMPS = {"tx": ("tx",), "rx": ("rx",), "tx+rx": ("tx", "rx"), "rx+tx": ("rx", "tx")}


@dataclass(frozen=True, slots=True, kw_only=True)
class PortFolder:
    """What a port folder says about its log before a message is read."""

    data: Path
    """The file of messages, `data.log` or `data.log.gz`."""
    stamps: tuple[str, ...]
    """Stamps of a message in their order: of the sender, `tx`, of the dumper, `rx`, or `unknown`."""
    has_info: bool
    """Whether there is an `info.log`."""

    def possible_stamps(self, line: Bottle) -> tuple[tuple[str, ...], ...]:
        """Tell which stamps a message may carry.

        Args:
            line: The elements of its line.

        Returns:
            The stamps in their order, first those of a message without an envelope if it may be one.
        """
        head = [value for value in line[:3] if is_number(value)]
        without_envelope = len(head) == 3 and head[0] < 0
        return (("tx", "rx"), self.stamps) if without_envelope and self.stamps == ("tx",) else (self.stamps,)


def find_port(port_dir: str | Path) -> PortFolder:
    """Look into a port folder.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.

    Returns:
        The file of messages and how they are stamped.

    Raises:
        MissingFileError: If the folder or its file of messages is not there.
        FormatError: If both files of messages are there, or `info.log` is not one of a bottle port.
    """
    folder = Path(port_dir)
    info = folder / "info.log"
    try:
        is_file, is_folder, has_info = folder.is_file(), folder.is_dir(), info.is_file()
        logs = [folder / name for name in LOG_NAMES if (folder / name).is_file()]
        header = _first_bytes(info) if has_info else ""
    except OSError as error:
        raise FormatError(f"{folder}: expected a readable port folder, got: {error.strerror}") from error
    if is_file:
        raise FormatError(f"{folder}: expected a port folder, got a file; give the folder that holds it")
    if not is_folder:
        raise MissingFileError(f"{folder}: expected a port folder with data.log and info.log, got nothing there")
    if not logs:
        raise MissingFileError(f"{folder}: expected data.log or data.log.gz in the port folder, got neither")
    if len(logs) > 1:
        raise FormatError(f"{folder}: expected data.log or data.log.gz, got both; delete the one that is not wanted")
    return PortFolder(data=logs[0], stamps=_stamps(info, header) if has_info else _UNKNOWN, has_info=has_info)


def read_blocks(path: Path) -> Iterator[bytes]:
    """Read a log in blocks of complete lines, unpacking it if its name ends in `.gz`.

    Args:
        path: File of messages.

    Yields:
        Texts of complete lines, each ended by a line feed. A text without a line feed is the last:
        the line in which the log ends, or the beginning of one that is too long.

    Raises:
        MissingFileError: If the file vanished.
        FormatError: If the file cannot be read or unpacked.
    """
    size = 0
    rest = b""
    with _opened(path) as file:
        while chunk := file.read(BLOCK_SIZE):
            size += len(chunk)
            if path.suffix == ".gz":
                require_unpacked(path, size)
            end = chunk.rfind(b"\n") + 1
            if end:
                yield _unix_lines(b"".join((rest, memoryview(chunk)[:end])))
                rest = chunk[end:]
            else:
                rest += chunk
                if len(rest) > LINE_LIMIT:
                    break
    if rest:
        yield rest


def read_first_line(path: Path) -> bytes:
    """Read the first line of a log and nothing more, unpacking it if its name ends in `.gz`.

    Args:
        path: File of messages.

    Returns:
        The line with its line feed; without one if it is cut off or too long; nothing for an empty log.

    Raises:
        MissingFileError: If the file vanished.
        FormatError: If the file cannot be read or unpacked.
    """
    with _opened(path) as file:
        return _unix_lines(file.readline(LINE_LIMIT + 1))


@contextmanager
def _opened(path: Path) -> Iterator[BufferedIOBase]:
    packed = path.suffix == ".gz"
    try:
        with gzip.GzipFile(path) if packed else path.open("rb") as file:
            yield file
    except FileNotFoundError as error:
        raise MissingFileError(f"{path}: expected a log, got nothing there") from error
    except EOFError as error:
        raise FormatError(
            f"{path}: expected a complete gzip file, got one that ends early; copy it again, or unpack what is left "
            "with gunzip and delete the last line"
        ) from error
    except (OSError, zlib.error) as error:
        wanted = "a gzip file" if packed else "a readable file"
        raise FormatError(f"{path}: expected {wanted}, got: {error}; copy it again") from error


def _unix_lines(text: bytes) -> bytes:
    # A dumper on Windows ends its lines with carriage return and line feed.
    return text.replace(b"\r\n", b"\n") if b"\r" in text else text


def _first_bytes(path: Path) -> str:
    with path.open("rb") as file:
        return file.read(_INFO_SIZE).decode("ascii", "backslashreplace")


def _stamps(info: Path, header: str) -> tuple[str, ...]:
    kind = _TYPE.search(header)
    if kind is None or kind[1] != "Bottle":
        got = "no such line" if kind is None else f'"Type: {quote(kind[1])[1:-1]};"'
        raise FormatError(f'{info}: expected "Type: Bottle;", got {got}; name the folder of a port that sends numbers')
    stamp = _STAMP.search(header)
    if stamp is None:
        return _UNKNOWN
    if stamp[1] not in _STAMPS:
        raise FormatError(f"{info}: expected a Stamp out of {', '.join(_STAMPS)}, got {quote(stamp[1])}")
    return _STAMPS[stamp[1]]
