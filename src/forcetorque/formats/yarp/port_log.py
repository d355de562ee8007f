# SPDX-License-Identifier: BSD-3-Clause
"""The log of one port: its folder and files, and sequence numbers, stamps and numbers of every line.

`info.log` is as `src/commands/yarpdatadumper/main.cpp` of YARP writes it: `Type: Bottle;`, then
`Stamp: tx;`, `Stamp: rx;` or `Stamp: tx+rx;` (absent before about 2017). `rx` is also written when
no option chose: then the sender's stamp was logged wherever there was one. Where `tx` was chosen,
messages without an envelope, whose sequence number is negative, carry both stamps all the same.

The file is read in blocks, so that a few tens of MB are held besides the result. The lines of a
block are grouped by skeleton; the first line of each new skeleton is parsed with care.
"""

from __future__ import annotations

import gzip
import re
import zlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from io import BufferedIOBase
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import BoolArray, FloatArray, IntArray
from forcetorque.base.errors import FormatError, MissingFileError
from forcetorque.base.input_file import require_unpacked
from forcetorque.formats.log_format import StreamReading
from forcetorque.formats.yarp.message import (
    Bottle,
    LineGroup,
    NumberLayout,
    Numbers,
    check_head,
    convert,
    group_lines,
    is_number,
    layout_of,
    parse_line,
    quote,
)
from forcetorque.recording.recording import Finding
from forcetorque.recording.stream import Signal, Stream

CLOCK = "yarp"
"""Name of the clock of all streams of a YARP network, whose machines are assumed to be synchronised."""

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
    """What a port folder specifies about its log before a message is read."""

    data: Path
    """The file of messages, `data.log` or `data.log.gz`."""
    stamps: tuple[str, ...]
    """Stamps of a message in their order: of the sender, `tx`, of the dumper, `rx`, or `unknown`."""
    has_info: bool
    """Whether there is an `info.log`."""

    def possible_stamps(self, line: Bottle) -> tuple[tuple[str, ...], ...]:
        """Find which stamps a message may carry.

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


NumberChoice = Callable[[Bottle], Sequence[int | None]]
"""Gives for each value that is wanted which number of a message it is, None where the message has
none; raises `FormatError` without a place if the message is not of the expected kind."""

FORM_LIMIT = 8192
"""Skeletons of a log: twice as many as the mixtures of twelve flags; it stops files that are not logs."""

_EMPTY = "expected at least one message, got an empty log"
_TOO_LONG = f"expected lines of at most {LINE_LIMIT} bytes, got a longer one; is this the log of a port?"


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class PortLog:
    """The messages of one port."""

    sequence: IntArray
    """Sequence numbers as logged; shape (n,)."""
    stamp_ns: IntArray
    """Stamps, shape (n,); ns."""
    values: FloatArray
    """Chosen numbers; shape (n, width); NaN where a message has none."""
    findings: tuple[Finding, ...]
    """What is to be known about the stamps."""

    def reading(self, stream: str, signals: Mapping[str, Signal], *, findings: Sequence[Finding] = ()) -> StreamReading:
        """Make a stream of the messages.

        Args:
            stream: Name for the stream.
            signals: Signals by quantity, one sample per message.
            findings: Findings on the signals.

        Returns:
            The stream, with the findings on the stamps in front of those on the signals.
        """
        return StreamReading(
            Stream(name=stream, clock=CLOCK, stamp_ns=self.stamp_ns, signals=signals, sequence=self.sequence),
            (*self.findings, *findings),
        )


def read_port_log(port_dir: str | Path, *, stream: str, choose: NumberChoice) -> PortLog:
    """Read chosen numbers of every message of a port.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Every line is checked for its structure and every wanted number for being one; numbers that are
    not wanted are converted in the first line of each skeleton only.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name of the stream, for the findings.
        choose: Gives the numbers of a message that are wanted.

    Returns:
        The messages in the order of the log.

    Raises:
        MissingFileError: If the folder or its log is not there.
        FormatError: If the log is empty, cut off, or a line is not of the expected kind.
    """
    port = find_port(port_dir)
    layouts: dict[bytes, NumberLayout] = {}
    blocks: list[Numbers] = []
    n_lines = 0
    for text in read_blocks(port.data):
        _check_text(text, port.data, n_lines)
        blocks.append(_read_block(text, port, n_lines, layouts, choose))
        n_lines += len(blocks[-1].sequence)
    if not blocks:
        raise FormatError(f"{port.data}: {_EMPTY}")
    log = _joined(blocks)
    return PortLog(
        sequence=log.sequence,
        stamp_ns=log.stamp_ns,
        values=log.values,
        findings=_stamp_findings(stream, port, log.stamp_ns, by_dumper=log.by_dumper),
    )


def read_first_message(port: PortFolder) -> Bottle:
    """Read the first line of a log and nothing more.

    Args:
        port: The port folder.

    Returns:
        The elements of the line: sequence number, stamps and message.

    Raises:
        MissingFileError: If the log vanished.
        FormatError: If the log is empty, or its first line is cut off or no message.
    """
    text = read_first_line(port.data)
    if not text:
        raise FormatError(f"{port.data}: {_EMPTY}")
    _check_text(text, port.data, 0)
    line = text[:-1]
    try:
        bottle = parse_line(line)
        check_head(line, bottle, n_stamps=len(port.stamps))
    except FormatError as error:
        raise FormatError(f"{port.data}:1: {error}") from error
    return bottle


def _check_text(text: bytes, path: Path, n_before: int) -> None:
    if not text.endswith(b"\n"):
        where = f"{path}:{n_before + 1}"
        if len(text) > LINE_LIMIT:
            raise FormatError(f"{where}: {_TOO_LONG}")
        raise FormatError(
            f"{where}: expected a line feed at the end of the last line, got none: the dumper was stopped while "
            "writing; delete this line"
        )
    if not text.isascii():
        row, line = next((row, line) for row, line in enumerate(text.split(b"\n")) if not line.isascii())
        byte = next(byte for byte in line if byte > 0x7F)
        raise FormatError(
            f"{path}:{n_before + row + 1}: expected ASCII text, got the byte 0x{byte:02x}; "
            "a compressed log is to be named data.log.gz"
        )


def _read_block(
    text: bytes, port: PortFolder, n_before: int, layouts: dict[bytes, NumberLayout], choose: NumberChoice
) -> Numbers:
    (first,) = group_lines(text[: text.index(b"\n") + 1])
    _add_layout(first, port, n_before, layouts, choose)
    groups = group_lines(text, n_structure=layouts[first.skeleton].n_structure)
    for group in groups:
        _add_layout(group, port, n_before, layouts, choose)
    numbers = [_convert(group, layouts[group.skeleton], port, n_before) for group in groups]
    if len(numbers) == 1:
        return numbers[0]
    return _joined(numbers, order=np.argsort(np.concatenate([group.rows for group in groups])))


def _add_layout(
    group: LineGroup, port: PortFolder, n_before: int, layouts: dict[bytes, NumberLayout], choose: NumberChoice
) -> None:
    """Add the layout of the lines of a group, from the first of them, if it is not there."""
    if group.skeleton not in layouts:
        try:
            layouts[group.skeleton] = _layout(group, port, choose, n_known=len(layouts))
        except FormatError as error:
            raise FormatError(f"{port.data}:{n_before + int(group.rows[0]) + 1}: {error}") from error


def _joined(numbers: Sequence[Numbers], *, order: IntArray | slice = slice(None)) -> Numbers:
    return Numbers(
        sequence=np.concatenate([part.sequence for part in numbers])[order],
        stamp_ns=np.concatenate([part.stamp_ns for part in numbers])[order],
        by_dumper=np.concatenate([part.by_dumper for part in numbers])[order],
        values=np.concatenate([part.values for part in numbers])[order],
    )


def _layout(group: LineGroup, port: PortFolder, choose: NumberChoice, *, n_known: int) -> NumberLayout:
    line = group.text[: group.text.index(b"\n")]
    if len(line) > LINE_LIMIT:
        raise FormatError(_TOO_LONG)
    if n_known == FORM_LIMIT:
        raise FormatError(f"expected lines of at most {FORM_LIMIT} forms, got another; is this the log of a port?")
    bottle = parse_line(line)
    *others, stamps = port.possible_stamps(bottle)
    stamps = next((other for other in others if _fits(bottle, len(other), choose)), stamps)
    try:
        check_head(line, bottle, n_stamps=len(stamps))
        chosen = choose(bottle[1 + len(stamps) :])
    except FormatError as error:
        if n_known == 0 and _fits(bottle, 3 - len(stamps), choose):
            raise FormatError(f"{error}; {_advice(port, stamps)}") from error
        raise
    return layout_of(line, bottle, stamps=stamps, chosen=chosen)


def _advice(port: PortFolder, stamps: Sequence[str]) -> str:
    fitting = "two stamps" if len(stamps) == 1 else "one stamp"
    if port.has_info:
        return f"with {fitting} the line would fit: if that is so, correct the line Stamp: of info.log"
    return f'with {fitting} the line would fit: if that is so, write "Type: Bottle;" and "Stamp: tx+rx;" to info.log'


def _fits(bottle: Bottle, n_stamps: int, choose: NumberChoice) -> bool:
    try:
        choose(bottle[1 + n_stamps :])
    except FormatError:
        return False
    return all(is_number(value) for value in bottle[: 1 + n_stamps])


def _convert(group: LineGroup, layout: NumberLayout, port: PortFolder, n_before: int) -> Numbers:
    numbers = convert(group, layout)
    if numbers is not None:
        _check_envelopes(numbers, group, layout, port, n_before)
        return numbers
    for row, line in zip(group.rows.tolist(), group.text.split(b"\n"), strict=False):
        try:
            check_head(line, parse_line(line), n_stamps=len(layout.stamps))
        except FormatError as error:
            raise FormatError(f"{port.data}:{n_before + row + 1}: {error}") from error
    raise FormatError(
        f"{port.data}:{n_before + int(group.rows[0]) + 1}: expected plain numbers in this line and those like it, "
        "got some that cannot be converted; log the port again"
    )


def _check_envelopes(numbers: Numbers, group: LineGroup, layout: NumberLayout, port: PortFolder, n_before: int) -> None:
    """Check that lines with more stamps than requested are of messages without an envelope."""
    if len(layout.stamps) != len(port.stamps) and (numbers.sequence >= 0).any():
        row = group.rows[np.flatnonzero(numbers.sequence >= 0)[0]]
        raise FormatError(
            f"{port.data}:{n_before + row + 1}: expected one stamp as info.log states, got two although the sequence "
            "number is not negative; delete the line"
        )


def _stamp_findings(stream: str, port: PortFolder, stamp_ns: IntArray, *, by_dumper: BoolArray) -> tuple[Finding, ...]:
    findings = []
    if not port.has_info:
        text = "there is no info.log; the sender or the dumper may have stamped the messages"
        findings.append(Finding.over(stream, stamp_ns, "unknown_stamp", text))
    rows = np.flatnonzero(by_dumper)
    if len(rows):
        text = f"{len(rows)} of {len(stamp_ns)} messages have no stamp of the sender; the dumper's is used"
        findings.append(Finding.over(stream, stamp_ns, "dumper_stamp", text, *rows[[0, -1]].tolist(), count=len(rows)))
    return tuple(findings)
