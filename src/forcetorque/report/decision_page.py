# SPDX-License-Identifier: BSD-3-Clause
"""The page to decide by: may the sensor be used, how large will its errors be, what is to be done next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from forcetorque.analysis import UseVerdict
from forcetorque.calibration import Calibration
from forcetorque.evaluation.use import CONFIDENCE
from forcetorque.report import figures
from forcetorque.report.calibration_sections import origin_words
from forcetorque.report.document import Block, Figure, List, Picture, Place, Section, Tone, Verdict
from forcetorque.report.next_steps import NextSteps
from forcetorque.report.repeated import said_once
from forcetorque.report.uses import Undecided
from forcetorque.result import Table, short_names, table_of, with_first_column

_WORDS = (
    "use: with 95 % probability the predicted errors are within what is allowed, and data that were not fitted, with a "
    "load that moved, do not speak against it.",
    "do not use: that probability is 10 % or less, or such data speak against it.",
    "not enough data: neither of the two.",
    "What is allowed is stated with the load case; where it is not, it is a twentieth of the loads.",
)
"""What the words of a verdict mean."""
_MOST_SENTENCES = 4
"""Verdicts that are said in whole sentences; of more the reasons stand in a list below the page."""


def decision_page(
    steps: NextSteps,
    uses: Sequence[UseVerdict],
    undecided: Sequence[Undecided],
    calibrations: Mapping[str, Calibration],
    *,
    explained: bool,
) -> Section:
    """Put what is said of a sensor on one page.

    Args:
        steps: What to do next.
        uses: Verdicts on its calibrations.
        undecided: Calibrations on which there is none, or the sensor itself.
        calibrations: Its calibrations by name of their file.
        explained: Whether to say what the words mean.

    Returns:
        A section with a page of its own: sentences, a figure, and what to do next; reasons and numbers where there is
        room.
    """
    names = short_names(list(calibrations))
    spare = [
        Section(title=title, blocks=tuple(blocks), place=Place.SPARE)
        for title, blocks in (
            ("What else speaks for and against it", _other_reasons(uses, names)),
            ("The predicted errors in numbers", _numbers(uses, names)),
            ("What this rests on", _basis(calibrations, names)),
            ("How to read this page", [List(points=_WORDS)] if explained and uses else []),
        )
        if blocks
    ]
    next_section = Section(title="What to do next", blocks=(List(points=steps.steps, numbered=True),))
    return Section(
        title=f"{steps.sensor} ({steps.serial})",
        blocks=(*_verdicts(uses, undecided, names), *_figure(uses, names)),
        sections=(next_section, *spare) if steps.steps else tuple(spare),
        place=Place.PAGE,
    )


def _verdicts(
    uses: Sequence[UseVerdict], undecided: Sequence[Undecided], names: Mapping[str, str]
) -> Iterator[Verdict]:
    whole = len(uses) <= _MOST_SENTENCES
    for verdict in uses:
        sentence = verdict.sentence.removeprefix(verdict.decision).strip() if whole else _briefly(verdict)
        yield Verdict(tone=Tone(verdict.tone), word=verdict.decision, text=f"{names[verdict.candidate]}, {sentence}.")
    for row in undecided:
        name = "" if row.candidate is None else f"{names[row.candidate]}: "
        yield Verdict(tone=Tone.UNKNOWN, word="no verdict", text=f"{name}{row.reason}.")


def _briefly(verdict: UseVerdict) -> str:
    """The use alone; how much error there is shows the figure."""
    return f"for “{verdict.load_case}”"


def _figure(uses: Sequence[UseVerdict], names: Mapping[str, str]) -> Iterator[Block]:
    drawn = [verdict for verdict in uses if verdict.errors]
    if not drawn:
        return
    cases = "; “".join(dict.fromkeys(f"{verdict.load_case}”: {verdict.loads}" for verdict in drawn))
    sizes = ", ".join(
        f"{names[verdict.candidate]} for {verdict.load_case} "
        + " and ".join(f"{row.after:.2g} {row.unit}" for row in verdict.errors)
        for verdict in drawn
    )
    yield Figure(
        picture=Picture(lambda: figures.use_figure(drawn, names)),
        caption="How much readings are predicted to err, root mean square over the loads of the use. Before: with the "
        f"matrix that the calibration came from. After: with the calibration. Loads of “{cases}.{_beside(drawn)}",
        description=f"Predicted force and moment errors with the prior and after calibration: {sizes}.",
    )


def _other_reasons(uses: Sequence[UseVerdict], names: Mapping[str, str]) -> list[Block]:
    """Reasons that neither a sentence above nor a step has."""
    first = 1 if len(uses) <= _MOST_SENTENCES else 0
    reasons = (
        (names[verdict.candidate], reason.text)
        for verdict in uses
        for reason in verdict.reasons[first:]
        if reason.against is None or reason.remedy is not None
    )
    points = said_once(reasons, names.values())
    return [List(points=tuple(points))] if points else []


def _beside(uses: Sequence[UseVerdict]) -> str:
    """That a picture of what is predicted does not show what was measured, where that decides."""
    decided = any(
        verdict.decision != "use" and verdict.within is not None and verdict.within >= CONFIDENCE for verdict in uses
    )
    return " What was measured speaks against the use where the picture does not: see the sentence." if decided else ""


def _basis(calibrations: Mapping[str, Calibration], names: Mapping[str, str]) -> list[Block]:
    """Where the calibrations come from."""
    points = [origin_words(names[file], one) for file, one in calibrations.items()]
    return [List(points=tuple(points))] if points else []


def _numbers(uses: Sequence[UseVerdict], names: Mapping[str, str]) -> list[Block]:
    rows = [row for verdict in uses for row in verdict.errors]
    if not rows:
        return []
    table: Table = table_of(
        rows,
        "Root mean square: of the loads, of the error with the prior and with the calibration (half of such sensors "
        "err less, and 97.5 % less than `at most`), what is allowed, and what matrix, offset, variables and noise add",
    )
    for heading, cells in (
        ("use", [verdict.load_case for verdict in uses for _ in verdict.errors]),
        ("calibration", [names[verdict.candidate] for verdict in uses for _ in verdict.errors]),
    ):
        if len(set(cells)) > 1:
            table = with_first_column(table, heading, cells)
    return [table]
