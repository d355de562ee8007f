# SPDX-License-Identifier: BSD-3-Clause
"""Questions of an experiment file that was begun from a log, asked one by one in a terminal."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.run_files import files_of_one_run
from forcetorque.base.toml_file import (
    OPEN,
    UnansweredKey,
    parsed_toml,
    toml_content,
    unanswered_keys,
    with_answer,
)
from forcetorque.inspection.draft.priors import serial_of
from forcetorque.inspection.draft.toml_lines import toml_value

OPEN_QUESTIONS = 4
"""Exit code of commands that end with questions, or proposals, that only a person can answer."""


def open_questions(file: Path) -> tuple[UnansweredKey, ...]:
    """Find what is still to be filled in.

    Args:
        file: Experiment file.

    Returns:
        The keys, in the order of the file.

    Raises:
        MissingFileError: If there is no such file.
        FormatError: If it is not TOML.
    """
    with files_of_one_run():  # the answers are written to the file
        return unanswered_keys(parsed_toml(file, what="an experiment file")[0])


def logs_of(file: Path) -> set[Path]:
    """Name the logs that an experiment file reads, also while questions are open.

    Args:
        file: Experiment file.

    Returns:
        Folder or file of the recording, and the files of its streams; absolute.
    """
    with files_of_one_run():  # the answers are written to the file
        recording = toml_content(file)[1].get("recording", {})
    folder = file.parent / recording.get("path", "")
    return {(folder / stream.get("file", "")).resolve() for stream in ({}, *recording.get("stream", ()))}


def answer_questions(file: Path, ask: Callable[[str], str]) -> bool:
    """Ask for every key that is still to be filled in, and write each answer to the file at once.

    Args:
        file: Experiment file.
        ask: Shows a question and gives the answer; an empty one leaves the question open.

    Returns:
        Whether all are answered.
    """
    skipped: set[tuple[int, str]] = set()
    while True:
        text = file.read_text(encoding="utf-8-sig")
        keys = [key for key in unanswered_keys(text) if (key.line, key.key) not in skipped]
        if not keys:
            return not skipped
        key = keys[0]
        answer = ask(f"line {key.line}, {key.key}: {key.words}").strip()
        if answer:
            write_bytes_atomically(file, with_serials(with_answer(text, key, answer), file.parent).encode())
        else:
            skipped.add((key.line, key.key))


def with_serials(text: str, folder: Path) -> str:
    """Fill in serial numbers that follow from the matrix files that the sensors are given.

    Args:
        text: Content of an experiment file.
        folder: Its folder, from which paths count.

    Returns:
        The content with them.
    """
    content = tomllib.loads(text)
    tables = [key for key in unanswered_keys(text) if key.key == "serial"]
    open_sensors = [one for one in content.get("sensor", ()) if one.get("serial") == OPEN]
    if len(tables) != len(open_sensors):
        return text
    for key, sensor in zip(tables, open_sensors, strict=True):
        prior = sensor.get("prior")
        path = folder / str(prior.get("path") if isinstance(prior, dict) else prior)
        serial = serial_of(path) if path.is_file() else None
        if serial is not None:
            text = with_answer(text, key, toml_value(serial))
    return text
