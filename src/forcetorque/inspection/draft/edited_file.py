# SPDX-License-Identifier: BSD-3-Clause
"""An experiment file whose text is changed: its byte-order mark and its line ends stay."""

from __future__ import annotations

import codecs
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.run_files import files_of_one_run
from forcetorque.base.toml_file import parsed_toml


def text_of(file: Path) -> str:
    r"""Read the text of an experiment file, whose keys may still be to be filled in.

    Args:
        file: The file.

    Returns:
        The text without a byte-order mark, its line ends `\n`.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not TOML.
    """
    with files_of_one_run():  # the file is rewritten, so that it is no input of what goes on after this
        return parsed_toml(file, what="an experiment file")[0]


def write_text_of(file: Path, text: str) -> None:
    r"""Replace the text of an experiment file, in the form that the file has.

    Args:
        file: The file; with a byte-order mark, and with `\r\n` at the ends of lines, if it has these in most lines.
        text: The text, its line ends `\n`.
    """
    before = file.read_bytes()
    if 2 * before.count(b"\r\n") > before.count(b"\n"):
        text = text.replace("\n", "\r\n")
    mark = codecs.BOM_UTF8 if before.startswith(codecs.BOM_UTF8) else b""
    write_bytes_atomically(file, mark + text.encode())


def tables_of(content: Mapping[str, Any], name: str) -> Sequence[Mapping[str, Any]]:
    """Find the tables of a list.

    Args:
        content: Tables of a file, not checked.
        name: Name of the list.

    Returns:
        The tables; none where the key is no list of tables.
    """
    tables = content.get(name)
    return tables if isinstance(tables, list) and all(isinstance(one, dict) for one in tables) else ()
