# SPDX-License-Identifier: BSD-3-Clause
"""An experiment file that was begun before: its questions are asked, then changes of it are proposed."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from pathlib import Path

from forcetorque.inspection.draft.bench import is_bench
from forcetorque.inspection.draft.draft import Draft, ProposalRow, QuestionRow
from forcetorque.inspection.draft.proposals import Proposal, proposals, settle
from forcetorque.inspection.draft.questions import answer_questions, open_questions
from forcetorque.inspection.draft.toml_lines import text_of


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
    """
    path = Path(file)
    open_questions(path)  # what is no TOML file is refused before anything is asked
    if ask is not None:
        answer_questions(path, ask)
    questions = open_questions(path)
    is_whole = bool(questions) or is_bench(tomllib.loads(text_of(path)))  # nothing is proposed of a bench
    left = () if is_whole else proposals(path) if accepts is None else settle(path, accepts)
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
