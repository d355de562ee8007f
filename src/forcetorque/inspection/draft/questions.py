# SPDX-License-Identifier: BSD-3-Clause
"""Questions of an experiment file that was begun from a log, asked in a terminal now or later."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from forcetorque.base.run_files import files_of_one_run
from forcetorque.base.toml_file import (
    OPEN,
    UnansweredKey,
    answer_error,
    read_toml,
    toml_content,
    unanswered_keys,
    with_answer,
)
from forcetorque.experiment.experiment_file import experiment_file
from forcetorque.experiment.workbench_file import BenchFile
from forcetorque.inspection.draft.draft import LEFT_OUT, Draft, ProposalRow, QuestionRow
from forcetorque.inspection.draft.priors import MatrixFile
from forcetorque.inspection.draft.proposals import Proposal, proposals, settle
from forcetorque.inspection.draft.toml_lines import tables_of, text_of, toml_value, write_text_of
from forcetorque.inspection.draft.workbench_file import is_bench, logs_of_bench

OPEN_QUESTIONS = 4
"""Exit code of commands that end with questions, or proposals, that only a person can answer."""


_ATTEMPTS = 3
"""How often in a row a question is asked again, after an answer that cannot be written."""


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
    return unanswered_keys(text_of(file))


def logs_of(file: Path) -> set[Path]:
    """Name the logs that an experiment file reads, also while questions are open.

    Args:
        file: Experiment file.

    Returns:
        Folder or file of the recording, and the files of its streams; absolute.
    """
    with files_of_one_run():  # the answers are written to the file
        content = toml_content(file)[1]
    if is_bench(content):
        return {(file.parent / name).resolve() for name in logs_of_bench(content)}
    recording = content.get("recording", {})
    folder = file.parent / recording.get("path", "")
    return {(folder / stream.get("file", "")).resolve() for stream in ({}, *recording.get("stream", ()))}


def logs_left_out(file: Path) -> set[Path]:
    """Name the logs that an experiment file was begun with and does not read.

    Args:
        file: Experiment file.

    Returns:
        The logs, by the comments of its draft; absolute.
    """
    names: list[str] = []
    for text in text_of(file).split("\n"):
        if text.startswith(LEFT_OUT):
            with suppress(tomllib.TOMLDecodeError):  # a comment that was changed
                names.append(str(tomllib.loads(f"log = {text.removeprefix(LEFT_OUT)}")["log"]))
    return {(file.parent / name).resolve() for name in names}


def answer_questions(file: Path, ask: Callable[[str], str]) -> bool:
    """Ask for every key that is still to be filled in, and write each answer to the file at once.

    An answer that leaves no TOML, that the form of the file does not take at its key, or that comes after another
    program changed the file, is not written; the question is asked again with the reason in front, three times at most.
    A list needs no brackets.

    Args:
        file: Experiment file.
        ask: Shows a question and gives the answer; an empty one leaves the question open.

    Returns:
        Whether all are answered.

    Raises:
        FormatError: If the file is not TOML.
    """
    skipped: set[tuple[int, str]] = set()
    refusals: list[str] = []
    while len(refusals) < _ATTEMPTS:
        text = text_of(file)
        keys = [key for key in unanswered_keys(text) if (key.line, key.key) not in skipped]
        if not keys:
            return not skipped
        key = keys[0]
        question = f"line {key.line}, {key.key}: {key.words}"
        answer = ask("\n".join([*refusals[-1:], question])).strip()
        if not answer:
            skipped.add((key.line, key.key))
            refusals = []
        elif text_of(file) != text:
            refusals.append(f"{file}: was changed meanwhile; the answer was not written")
        else:
            # as it is; a list without brackets; a number that is a name
            others = [_as_list(answer)] if "," in answer else [toml_value(answer)] if answer.isalnum() else []
            forms = (answer, *others)
            tried = [(with_answer(text, key, form), _error_of(text, with_answer(text, key, form))) for form in forms]
            taken = next((answered for answered, error in tried if error is None), None)
            if taken is None:
                refusals.append(f"{file}:{key.line}: {key.key}: {tried[0][1]}, got {answer}")
            else:
                write_text_of(file, with_serials(taken, file.parent))
                refusals = []
    return False


def _as_list(answer: str) -> str:
    """A list of an answer without its brackets: of numbers, or of words."""
    try:
        tomllib.loads(f"answer = [{answer}]")
    except tomllib.TOMLDecodeError:
        return toml_value([one.strip().strip("\"'") for one in answer.split(",")])
    return f"[{answer}]"


def _error_of(text: str, answered: str) -> str | None:
    """What was expected in place of an answer; None where the form of the file takes it."""
    try:
        content = tomllib.loads(answered)
    except tomllib.TOMLDecodeError as error:
        return f"expected a value without a comment, which leaves TOML ({error})"
    return answer_error(tomllib.loads(text), content, BenchFile if is_bench(content) else experiment_file())


def with_serials(text: str, folder: Path) -> str:
    """Fill in serial numbers that follow from the matrix files that the sensors are given.

    Args:
        text: Content of an experiment file; TOML.
        folder: Its folder, from which paths count.

    Returns:
        The content with them.
    """
    keys = [key for key in unanswered_keys(text) if key.key == "serial"]
    open_sensors = [one for one in tables_of(tomllib.loads(text), "sensor") if one.get("serial") == OPEN]
    if len(keys) != len(open_sensors):
        return text
    for key, sensor in zip(keys, open_sensors, strict=True):
        prior = sensor.get("prior")
        path = folder / str(prior.get("path") if isinstance(prior, dict) else prior)
        serial = MatrixFile.of(path).serial if path.is_file() else None
        if serial is not None:
            text = with_answer(text, key, toml_value(serial))
    return text


def resume_experiment(
    file: Path | str, *, ask: Callable[[str], str] | None = None, accepts: Callable[[str], bool] | None = None
) -> Draft:
    """Take up an experiment file again.

    Args:
        file: The file; it is rewritten at every answer and accepted proposal, and keeps its comments.
        ask: Shows a question and gives the answer, empty to leave it open; None to ask nothing.
        accepts: Shows a proposal and gives whether it is accepted; None to list all and change nothing.

    Returns:
        The file with the questions that are open; with those that are answered, the proposals that are left.

    Raises:
        FormatError: If the file is not TOML, or is a workbench file without questions that does not have its form.
    """
    path = Path(file)
    open_questions(path)  # what is no TOML file is refused before anything is asked
    if ask is not None:
        answer_questions(path, ask)
    questions = open_questions(path)
    of_bench = is_bench(tomllib.loads(text_of(path)))
    if of_bench and not questions:
        read_toml(path, BenchFile, what="a workbench file")
    left = () if questions or of_bench else proposals(path) if accepts is None else settle(path, accepts)
    return Draft(
        file=str(path),
        format="toml",
        streams={},
        questions=tuple(QuestionRow(line=one.line, key=one.key, question=one.words) for one in questions),
        proposals=tuple(map(_row, left)),
        notes=(),
        content=path.read_text(encoding="utf-8-sig"),
    )


def _row(proposal: Proposal) -> ProposalRow:
    residuals = proposal.residuals
    return ProposalRow(
        line=None if proposal.edit is None else proposal.edit.line,
        kind=proposal.kind,
        proposal=proposal.sentence,
        residual_before_N=None if residuals is None else float(residuals.before[0]),
        residual_after_N=None if residuals is None else float(residuals.after[0]),
    )
