# SPDX-License-Identifier: BSD-3-Clause
"""The messages of a port: sequence numbers, exact stamps and chosen numbers of every line.

The file is read in blocks, so that no more than a few MB are held besides the result. The lines of
a block are grouped by skeleton; the first line of each new skeleton is parsed with care.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, IntArray
from forcetorque.errors import FormatError
from forcetorque.exchange.yarp.bottle import Bottle
from forcetorque.exchange.yarp.conversion import NumberLayout, Numbers, convert, layout_of
from forcetorque.exchange.yarp.message_line import check_head, is_number, parse_line
from forcetorque.exchange.yarp.port_folder import LINE_LIMIT, PortFolder, find_port, read_blocks
from forcetorque.exchange.yarp.skeleton import LineGroup, group_lines
from forcetorque.recording import Finding

Choose = Callable[[Bottle], Sequence[int | None]]
"""Tells for each value that is wanted which number of a message it is, None where the message has
none; raises `FormatError` without a place if the message is not of the expected kind."""

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


def read_port_log(port_dir: str | Path, *, stream: str, choose: Choose) -> PortLog:
    """Read chosen numbers of every message of a port.

    Where messages carry the sender's and the dumper's stamp, the sender's is taken if it is
    positive and else the dumper's, as the dumper itself does where it writes only one.

    Every line is checked for its structure and every wanted number for being one; numbers that are
    not wanted are converted in the first line of each skeleton only.

    Args:
        port_dir: Folder with `data.log` or `data.log.gz`, and `info.log`.
        stream: Name of the stream, for the findings.
        choose: Tells which numbers of a message are wanted.

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
        raise FormatError(f"{port.data}: expected at least one message, got an empty log")
    sequence = np.concatenate([block.sequence for block in blocks])
    stamps = np.concatenate([block.stamps_ns for block in blocks], axis=1)
    stamp_ns = np.where(stamps[0] > 0, stamps[0], stamps[-1])
    return PortLog(
        sequence=sequence,
        stamp_ns=stamp_ns,
        values=np.concatenate([block.values for block in blocks]),
        findings=_stamp_findings(stream, port, stamp_ns, by_dumper=stamp_ns != stamps[0]),
    )


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
    text: bytes, port: PortFolder, n_before: int, layouts: dict[bytes, NumberLayout], choose: Choose
) -> Numbers:
    groups = group_lines(text)
    for group in groups:
        if group.skeleton not in layouts:
            line = group.text[: group.text.index(b"\n")]
            try:
                layouts[group.skeleton] = _layout(line, port.n_stamps, choose, first=not layouts)
            except FormatError as error:
                raise FormatError(f"{port.data}:{n_before + int(group.rows[0]) + 1}: {error}") from error
    parts = [_convert(group, layouts[group.skeleton], port, n_before) for group in groups]
    if len(parts) == 1:
        return parts[0]
    order = np.argsort(np.concatenate([group.rows for group in groups]))
    return Numbers(
        sequence=np.concatenate([part.sequence for part in parts])[order],
        stamps_ns=np.concatenate([part.stamps_ns for part in parts], axis=1)[:, order],
        values=np.concatenate([part.values for part in parts])[order],
    )


def _layout(line: bytes, n_stamps: int, choose: Choose, *, first: bool) -> NumberLayout:
    if len(line) > LINE_LIMIT:
        raise FormatError(_TOO_LONG)
    bottle = parse_line(line)
    try:
        check_head(line, bottle, n_stamps=n_stamps)
        chosen = choose(bottle[1 + n_stamps :])
    except FormatError as error:
        if first and _fits(bottle, 3 - n_stamps, choose):
            fitting = "two stamps" if n_stamps == 1 else "one stamp"
            raise FormatError(
                f"{error}; with {fitting} the line would fit: if that is so, correct the line Stamp: of info.log"
            ) from error
        raise
    return layout_of(line, bottle, n_stamps=n_stamps, chosen=chosen)


def _fits(bottle: Bottle, n_stamps: int, choose: Choose) -> bool:
    try:
        choose(bottle[1 + n_stamps :])
    except FormatError:
        return False
    return all(is_number(value) for value in bottle[: 1 + n_stamps])


def _convert(group: LineGroup, layout: NumberLayout, port: PortFolder, n_before: int) -> Numbers:
    numbers = convert(group.text, layout)
    if numbers is not None:
        return numbers
    for row, line in zip(group.rows.tolist(), group.text.split(b"\n"), strict=False):
        try:
            check_head(line, parse_line(line), n_stamps=port.n_stamps)
        except FormatError as error:
            raise FormatError(f"{port.data}:{n_before + row + 1}: {error}") from error
    raise FormatError(
        f"{port.data}:{n_before + int(group.rows[0]) + 1}: expected plain numbers in this line and those like it, "
        "got some that cannot be converted; log the port again"
    )


def _stamp_findings(stream: str, port: PortFolder, stamp_ns: IntArray, *, by_dumper: BoolArray) -> tuple[Finding, ...]:
    findings = []
    if not port.has_info:
        findings.append(
            Finding(
                stream=stream,
                kind="unknown_stamp",
                message="there is no info.log; the sender or the dumper may have stamped the messages",
                count=len(stamp_ns),
                start_ns=int(stamp_ns[0]),
                end_ns=int(stamp_ns[-1]),
            )
        )
    rows = np.flatnonzero(by_dumper)
    if len(rows):
        findings.append(
            Finding(
                stream=stream,
                kind="dumper_stamp",
                message=f"{len(rows)} of {len(stamp_ns)} messages have no stamp of the sender; the dumper's is used",
                count=len(rows),
                start_ns=int(stamp_ns[rows[0]]),
                end_ns=int(stamp_ns[rows[-1]]),
            )
        )
    return tuple(findings)
