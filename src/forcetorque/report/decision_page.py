# SPDX-License-Identifier: BSD-3-Clause
"""Page one of a report: whether a sensor may be used, its errors, and why; several sensors in one table."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Final

from forcetorque.calibration.report_blocks import origin_words
from forcetorque.evaluation.answers import CONCERN
from forcetorque.evaluation.load_cases.predicted_error import CONFIDENCE
from forcetorque.evaluation.load_cases.verdict import TONES, Decision, LoadCaseError, LoadCaseVerdict
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.report.experiment_assessment import ExperimentAssessment
from forcetorque.report.pooled_verdicts import NextSteps, Undecided, grouped_by_text, texts_with_names
from forcetorque.report.sensor_assessment import Assessment, VerdictLine
from forcetorque.results.document.content import Block, Figure, List, Picture, Place, Section, Tone, Verdict
from forcetorque.results.figure_style import two_digits
from forcetorque.results.number_text import amount
from forcetorque.results.table import Table, short_names, table_of, with_first_column

_WORDS = (
    "use: with 95 % probability the predicted errors are within what is allowed, and data that were not fitted, with a "
    "load that moved, do not speak against it.",
    "do not use: on data that were not fitted the errors are beyond what is allowed, or above those of the prior.",
    "not enough data: neither of the two.",
    "The allowed error is specified with the load case; by default it is a twentieth of the loads.",
)
"""What the words of a verdict mean."""
_MOST_SENTENCES = 4
"""Verdicts that are said in whole sentences; of more the reasons stand in a list below the page."""


def decision_page(
    steps: NextSteps,
    uses: Sequence[LoadCaseVerdict],
    undecided: Sequence[Undecided],
    calibrations: Mapping[str, Calibration],
    assessed: Sequence[VerdictLine],
    *,
    explained: bool,
) -> Section:
    """Put what is said of a sensor on one page.

    Args:
        steps: What to do next.
        uses: Verdicts on its calibrations.
        undecided: Calibrations on which there is none, or the sensor itself.
        calibrations: Its calibrations by name of their file.
        assessed: What was found in its recordings.
        explained: Whether to say what the words mean.

    Returns:
        A section with a page of its own: sentences, all that speaks against them, a figure, and what to do next; other
        reasons and numbers where there is room.
    """
    names = short_names(list(calibrations))
    against = tuple(_against(uses, names, calibrations, assessed))
    spare = [
        Section(title=title, blocks=tuple(blocks), place=Place.SPARE)
        for title, blocks in (
            ("What else was found", _other_reasons(uses, names, against)),
            ("The predicted errors in numbers", _numbers(uses, names)),
            ("What this rests on", _basis(calibrations, names)),
            ("How to read this page", [List(points=_WORDS)] if explained and uses else []),
        )
        if blocks
    ]
    next_section = Section(title="What to do next", blocks=(List(points=steps.steps, numbered=True),))
    return Section(
        title=f"{steps.sensor} ({steps.serial})",
        blocks=(*_verdicts(uses, undecided, names), *against, *_figure(uses, names)),
        sections=(next_section, *spare) if steps.steps else tuple(spare),
        place=Place.PAGE,
    )


def _verdicts(
    uses: Sequence[LoadCaseVerdict], undecided: Sequence[Undecided], names: Mapping[str, str]
) -> Iterator[Verdict]:
    whole = len(uses) <= _MOST_SENTENCES
    for verdict in uses:
        sentence = verdict.message.removeprefix(verdict.decision).strip() if whole else _briefly(verdict)
        yield Verdict(tone=Tone(verdict.tone), word=verdict.decision, text=f"{names[verdict.calibration]}, {sentence}.")
    for row in undecided:
        name = "" if row.calibration is None else f"{names[row.calibration]}: "
        yield Verdict(tone=Tone.UNKNOWN, word="no verdict", text=f"{name}{row.reason}.")


def _against(
    uses: Sequence[LoadCaseVerdict],
    names: Mapping[str, str],
    calibrations: Mapping[str, Calibration],
    assessed: Sequence[VerdictLine],
) -> Iterator[Verdict | List]:
    """All that speaks against what the sentences above predict: measured errors, what is bad, and other warnings."""
    for text in texts_with_names(_beyond_predicted(uses, names), names.values()):
        yield Verdict(tone=Tone.CAUTION, word="measured", text=f"{text}.")
    # doubts about fitted data are reasons of every verdict
    reasoned = [doubt for one in calibrations.values() for doubt in one.warnings] if uses else []
    lines = [line for line in assessed if not any(doubt in line.text for doubt in reasoned)]
    for text in dict.fromkeys(line.text for line in lines if line.tone == "bad"):
        yield Verdict(tone=Tone.BAD, word="warning", text=f"{text}.")
    first = 1 if len(uses) <= _MOST_SENTENCES else 0
    reasons = [
        (names[verdict.calibration], reason.text)
        for verdict in uses
        for reason in verdict.reasons[first:]
        if reason.against is not None and reason.remedy is not None
    ]
    warnings = [*texts_with_names(reasons, names.values()), *(line.text for line in lines if line.tone == "caution")]
    if warnings:
        yield List(points=tuple(dict.fromkeys(f"warning: {text}" for text in warnings)))


def _beyond_predicted(uses: Sequence[LoadCaseVerdict], names: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    """Calibrations that err by more on other data than is predicted for a use, with both."""
    beyond: dict[tuple[str, str], list[str]] = {}
    for verdict in uses:
        rows = [row for row in verdict.errors if row.measured is not None and row.measured > row.after_at_most]
        if rows:
            errors = " and ".join(f"{two_digits(row.measured or 0.0)} {row.unit}" for row in rows)
            most = ", ".join(f"{two_digits(row.after_at_most)} {row.unit}" for row in rows)
            beyond.setdefault((verdict.calibration, errors), []).append(f"“{verdict.load_case}” ({most})")
    for (candidate, errors), cases in beyond.items():
        yield (
            names[candidate],
            f"on data that were not fitted it errs by {errors} (RMS), more than is predicted at most for "
            f"{' and '.join(cases)}",
        )


def _briefly(verdict: LoadCaseVerdict) -> str:
    """The use alone; how much error there is shows the figure."""
    return f"for “{verdict.load_case}”"


def _figure(uses: Sequence[LoadCaseVerdict], names: Mapping[str, str]) -> Iterator[Block]:
    from forcetorque.evaluation.figures.load_cases import use_figure

    drawn = [verdict for verdict in uses if verdict.errors]
    if not drawn:
        return
    cases = "; “".join(dict.fromkeys(f"{verdict.load_case}”: {verdict.loads}" for verdict in drawn))
    sizes = ", ".join(
        f"{names[verdict.calibration]} for {verdict.load_case} "
        + " and ".join(f"{row.after:.2g} {row.unit}" for row in verdict.errors)
        for verdict in drawn
    )
    yield Figure(
        picture=Picture(lambda: use_figure(drawn, names)),
        caption="How much readings are predicted to err, root mean square over the loads of the use. Before: with the "
        "matrix that the calibration came from. After: with the calibration. Measured: with the calibration, on data "
        f"that were not fitted, at their own loads. Loads of “{cases}.{_beside(drawn)}",
        description=f"Predicted force and moment errors with the prior and after calibration: {sizes}."
        f"{_measured_words(drawn, names)}",
    )


def _measured_words(uses: Sequence[LoadCaseVerdict], names: Mapping[str, str]) -> str:
    sizes = [
        f"{names[verdict.calibration]} {' and '.join(f'{row.measured:.2g} {row.unit}' for row in verdict.errors)}"
        for verdict in uses
        if all(row.measured is not None for row in verdict.errors)
    ]
    return f" Measured on data that were not fitted: {', '.join(dict.fromkeys(sizes))}." if sizes else ""


def _other_reasons(uses: Sequence[LoadCaseVerdict], names: Mapping[str, str], against: Sequence[Block]) -> list[Block]:
    """Reasons for it, and what only informs, that stand nowhere else."""
    shown = [point for block in against if isinstance(block, List) for point in block.points]
    first = 1 if len(uses) <= _MOST_SENTENCES else 0
    reasons = (
        (names[verdict.calibration], reason.text)
        for verdict in uses
        for reason in verdict.reasons[first:]
        if reason.against is None and not any(reason.text in text for text in shown)
    )
    points = texts_with_names(reasons, names.values())
    return [List(points=tuple(points))] if points else []


def _beside(uses: Sequence[LoadCaseVerdict]) -> str:
    """That a picture of what is predicted does not show what was measured, where that decides."""
    decided = any(
        verdict.decision != "use" and verdict.within is not None and verdict.within >= CONFIDENCE for verdict in uses
    )
    return " What was measured speaks against the use where the picture does not: see the sentence." if decided else ""


def _basis(calibrations: Mapping[str, Calibration], names: Mapping[str, str]) -> list[Block]:
    """Where the calibrations come from."""
    points = [origin_words(names[file], one) for file, one in calibrations.items()]
    return [List(points=tuple(points))] if points else []


def _numbers(uses: Sequence[LoadCaseVerdict], names: Mapping[str, str]) -> list[Block]:
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
        ("calibration", [names[verdict.calibration] for verdict in uses for _ in verdict.errors]),
    ):
        if len(set(cells)) > 1:
            table = with_first_column(table, heading, cells)
    return [table]


TITLE = "Better than the prior?"
"""Title of the section."""


def prior_comparison_section(experiments: Sequence[ExperimentAssessment]) -> Section:
    """Compare every calibration with its prior on the validation data.

    Args:
        experiments: What is said about every experiment.

    Returns:
        A section: sentences, each once with the names of those whom it is about, then the numbers of each sensor.
    """
    assessments = {
        f"{sensor.sensor}, {experiment.experiment}": sensor
        for experiment in experiments
        for sensor in experiment.sensors
    }
    sentences = grouped_by_text(
        pair
        for name, assessment in assessments.items()
        for pair in _sentences(name if len(assessments) > 1 else "", assessment)
    )
    blocks: list[Block] = [
        Verdict(tone=tone, text=f"{', '.join(names)}: {text}" if any(names) else text)
        for names, (tone, text) in sentences
    ]
    for name, assessment in assessments.items():
        if assessment.comparisons:
            whose = f"{name}: " if len(assessments) > 1 else ""
            blocks.append(
                table_of(
                    assessment.comparisons,
                    f"{whose}mean norm of the error (not the root mean square, by which the verdict on the first page "
                    "goes) against that of the prior on the same samples, and the ratio of the errors with its 95 % "
                    "interval over independent segments of time; another offset would take away what is constant",
                )
            )
    return Section(title=TITLE, blocks=tuple(blocks))


def _sentences(whose: str, assessment: Assessment) -> Iterator[tuple[str, tuple[Tone, str]]]:
    """By whom they are about: a calibration that stands in front of a sentence, or the sensor."""
    calibrations = short_names(list(assessment.calibrations)).values()
    for line in assessment.verdict:
        name = next((one for one in calibrations if line.text.startswith(f"{one}: ")), None)
        if name is None:
            yield whose, (Tone(line.tone), line.text)
        else:
            about = f"{whose}, {name}" if whose else name
            yield about, (Tone(line.tone), line.text.removeprefix(f"{name}: "))


_ORDER: Final[Sequence[Decision]] = sorted(CONCERN, key=CONCERN.__getitem__, reverse=True)
"""Verdicts, the one that asks most for attention first."""
_HEADINGS = ("sensor", "calibration", "may it be used?", "for", "force error", "moment error", "do next, or why not")


def all_sensors_page(
    uses: Sequence[LoadCaseVerdict], undecided: Sequence[Undecided], steps: Sequence[NextSteps]
) -> Section:
    """Put all sensors on one page.

    Args:
        uses: Verdicts on all calibrations.
        undecided: Calibrations and sensors without a verdict.
        steps: What to do next about every sensor.

    Returns:
        A section with a page of its own: how many may be used, and a line per verdict.
    """
    unjudged = [row.calibration for row in undecided if row.calibration is not None]
    names = short_names([*(use.calibration for use in uses), *unjudged])
    first = {(row.sensor, row.serial): next(iter(row.steps), "") for row in steps}
    rows = [_row(use, names, first) for use in sorted(uses, key=lambda use: _ORDER.index(use.decision))]
    for row in undecided:
        name = "" if row.calibration is None else names[row.calibration]
        rows.append((f"{row.sensor} ({row.serial})", name, "no verdict", "", "", "", row.reason))
    caption = "Predicted errors: prior → calibration (at most with 95 %; allowed)"
    table = Table(caption=caption, headings=_HEADINGS, rows=tuple(rows))
    return Section(title="All sensors", blocks=(*_counts(uses, undecided), table), place=Place.PAGE)


def _row(use: LoadCaseVerdict, names: Mapping[str, str], first: Mapping[tuple[str, str], str]) -> tuple[str, ...]:
    errors = {error.quantity: _error(error) for error in use.errors}
    remedy = next((reason.remedy for reason in use.reasons if reason.remedy is not None), None)
    return (
        f"{use.sensor} ({use.serial})",
        names[use.calibration],
        use.decision,
        use.loads,
        errors.get("force", ""),
        errors.get("moment", ""),
        remedy or first.get((use.sensor, use.serial), ""),
    )


def _error(error: LoadCaseError) -> str:
    before = "" if error.before is None else f"{amount(error.before, '')} → "
    allowed = "" if error.allowed is None else f"; {amount(error.allowed, '')}"
    return f"{before}{amount(error.after, error.unit)} ({amount(error.after_at_most, '')}{allowed})"


def _counts(uses: Sequence[LoadCaseVerdict], undecided: Sequence[Undecided]) -> Iterator[Verdict]:
    """Name the sensors by their worst verdict."""
    worst: dict[tuple[str, str], Decision] = {}
    for use in uses:
        key = (use.sensor, use.serial)
        worst[key] = min(worst.get(key, "use"), use.decision, key=_ORDER.index)
    for decision in _ORDER:
        sensors = [sensor for (sensor, _), one in worst.items() if one == decision]
        if sensors:
            yield Verdict(tone=Tone(TONES[decision]), word=decision, text=f"{len(sensors)}: {', '.join(sensors)}.")
    without = dict.fromkeys(row.sensor for row in undecided if (row.sensor, row.serial) not in worst)
    if without:
        yield Verdict(tone=Tone.UNKNOWN, word="no verdict", text=f"{len(without)}: {', '.join(without)}.")
