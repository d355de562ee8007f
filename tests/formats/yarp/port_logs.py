# SPDX-License-Identifier: BSD-3-Clause
"""Port folders for tests, and a second, slow parser of their logs that shares nothing with the library."""

from __future__ import annotations

import gzip
import json
import re
from dataclasses import dataclass
from decimal import Decimal
from pathlib import Path
from typing import Any

INFO = "Type: Bottle;\nStamp: tx;\n[1457614036.915703] /icub/right_leg/analog:o [connected]\n"
INFO_TWO_STAMPS = INFO.replace("tx;", "tx+rx;")
STATE_NAMES = ("position", "velocity", "acceleration")
"""Lists that a reader of a control board keeps, in the order of the log."""


def write_port(folder: Path, text: str | bytes, *, info: str | None = INFO, packed: bool = False) -> Path:
    """Write a port folder and give it back."""
    folder.mkdir(parents=True, exist_ok=True)
    content = text.encode() if isinstance(text, str) else text
    for name in ("data.log", "data.log.gz", "info.log"):
        (folder / name).unlink(missing_ok=True)
    if packed:
        (folder / "data.log.gz").write_bytes(gzip.compress(content))
    else:
        (folder / "data.log").write_bytes(content)
    if info is not None:
        (folder / "info.log").write_text(info)
    return folder


def read_text(folder: Path) -> str:
    """Give the text of a port folder's log."""
    plain = folder / "data.log"
    content = plain.read_bytes() if plain.exists() else gzip.decompress((folder / "data.log.gz").read_bytes())
    return content.decode("ascii")


@dataclass(frozen=True)
class SlowLine:
    """One line, its numbers still as text."""

    sequence: int
    stamps_ns: tuple[int, ...]
    numbers: tuple[str, ...]
    lists: tuple[tuple[str, ...], ...]
    flags: tuple[str, ...]


def parse_slowly(text: str, *, n_stamps: int = 1) -> list[SlowLine]:
    """Parse every line token by token, stamps by exact decimal arithmetic."""
    return [_parse_line(line, n_stamps) for line in text.replace("\r\n", "\n").removesuffix("\n").split("\n")]


def _parse_line(line: str, n_stamps: int) -> SlowLine:
    for bracket in "()[]":
        line = line.replace(bracket, f" {bracket} ")
    tokens = line.split()
    head, tokens = tokens[: 1 + n_stamps], tokens[1 + n_stamps :]
    numbers: list[str] = []
    lists: list[tuple[str, ...]] = []
    flags: list[str] = []
    while tokens:
        token = tokens.pop(0)
        if token in "([":
            end = tokens.index(")" if token == "(" else "]")
            inside, tokens = tokens[:end], tokens[end + 1 :]
            (lists.append(tuple(inside)) if token == "(" else flags.append(" ".join(inside)))
        else:
            numbers.append(token)
    stamps = tuple(int(Decimal(stamp) * 10**9) for stamp in head[1:])
    return SlowLine(int(head[0]), stamps, tuple(numbers), tuple(lists), tuple(flags))


def parse_nested(line: str) -> list[Any]:
    """Parse a line of numbers and nested lists by way of JSON; the numbers stay text."""
    signs = {"(": "[", ")": "]"}
    text = ",".join(signs.get(token) or json.dumps(token) for token in re.findall(r"[()]|[^() ]+", line))
    return json.loads(f"[{text}]".replace("[,", "[").replace(",]", "]"))  # type: ignore[no-any-return]
