# SPDX-License-Identifier: BSD-3-Clause
"""Questions of an experiment file that was begun from a log, asked one by one in a terminal."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.toml_file import UnansweredKey, toml_content, unanswered_keys, with_answer


def open_questions(file: Path) -> tuple[UnansweredKey, ...]:
    """Find what is still to be filled in.

    Args:
        file: Experiment file.

    Returns:
        The keys, in the order of the file.
    """
    return unanswered_keys(file.read_text(encoding="utf-8-sig"))


def logs_of(file: Path) -> set[Path]:
    """Name the logs that an experiment file reads, also while questions are open.

    Args:
        file: Experiment file.

    Returns:
        Folder or file of the recording, and the files of its streams; absolute.
    """
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
            write_bytes_atomically(file, with_answer(text, key, answer).encode())
        else:
            skipped.add((key.line, key.key))
