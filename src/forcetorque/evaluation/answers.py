# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `evaluate` in a few lines: may a calibration be used, at what error, what to do next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Final

from forcetorque.evaluation.load_cases.validation_evidence import PriorComparison
from forcetorque.evaluation.load_cases.verdict import (
    ADVICE_BY_SOURCE,
    CORRECT_DATA,
    KEEP_PRIOR,
    LOOK_FOR_CAUSE,
    RECORDED,
    Decision,
    LoadCaseVerdict,
)
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.answer import EXPERIMENT, FIRST_EXPERIMENT, Answer, Concern, typed
from forcetorque.results.number_text import amount, within
from forcetorque.results.table import short_names

if TYPE_CHECKING:
    from forcetorque.evaluation.evaluation import CalibrationErrors, Evaluation

CONCERN: Final[Mapping[Decision, Concern]] = {
    "use": Concern.NONE,
    "not enough data": Concern.UNCERTAIN,
    "do not use": Concern.BAD,
}
"""How much a decision asks for attention."""
RECORD_MORE: Final = "record more, and calibrate again"
"""Step where data do not determine enough."""


def evaluation_answers(evaluation: Evaluation) -> Iterator[Answer]:
    """Give the answer for every calibration; for the prior where there is no calibration.

    Args:
        evaluation: What was evaluated.

    Yields:
        One answer each.
    """
    names = short_names([row.calibration for row in evaluation.verdicts])
    for row in evaluation.verdicts:
        if row.offset is not Offset.JUDGED_MEAN:  # every candidate once
            continue
        uses = [use for use in evaluation.load_cases if (use.sensor, use.calibration) == (row.sensor, row.calibration)]
        subject = f"{row.sensor} ({row.serial})"
        if not names[row.calibration].startswith(f"{row.sensor}_{row.serial}."):  # the file has another name
            subject = f"{subject}, {names[row.calibration]}"
        if uses:
            compared = [
                one for one in evaluation.comparisons if (one.sensor, one.calibration) == (row.sensor, row.calibration)
            ]
            yield _of_uses(subject, row, uses, compared)
        elif not any(use.sensor == row.sensor for use in evaluation.load_cases):
            yield _of_errors(subject, row)


def _of_errors(subject: str, row: CalibrationErrors) -> Answer:
    """Of a candidate without a verdict: its error."""
    step, command = to_calibrate(row.sensor)
    return Answer(
        subject=subject,
        verdict=f"force error {_mean(row.force_error_mean_N, row.force_error_half_width_95_N, 'N')}",
        why=(
            f"moment error {_mean(row.moment_error_mean_Nm, row.moment_error_half_width_95_Nm, 'N m')}; {row.samples} "
            "samples that were not fitted, with their mean error removed",
        ),
        step=step,
        command=command,
    )


def _of_uses(
    subject: str, row: CalibrationErrors, uses: Sequence[LoadCaseVerdict], compared: Sequence[PriorComparison]
) -> Answer:
    """Of a calibration: the verdict on its load cases, the worst first."""
    worst = max(uses, key=lambda use: CONCERN[use.decision])
    agree = len({use.decision for use in uses}) == 1
    decision = worst.decision.upper()
    reason = worst.reasons[0]
    # what was measured speaks in the last line; other reasons, such as warnings, are said here
    said = "; ".join(error.text for error in worst.errors) or reason.text
    if worst.load_case != RECORDED:
        said = f"{worst.loads}: {said}"
    reasons = [said] if _is_said(worst) else [said, reason.text]
    if worst.decision == "do not use":  # of several sensors the first line alone is shown
        reasons.reverse()
    beyond = () if worst.beyond_range is None else (worst.beyond_range,)
    step, command = next_step(worst)
    return Answer(
        subject=subject,
        verdict=decision if agree and worst.load_case != RECORDED else f"{decision} for {worst.load_case}",
        why=(reasons[0], *beyond, *reasons[1:], *_measured(row, compared)),
        step=step,
        lines=next_lines(worst),
        command=command,
        concern=CONCERN[worst.decision],
    )


def _is_said(use: LoadCaseVerdict) -> bool:
    """Whether the first line states the reason: it is all there is, or the predicted numbers."""
    return not use.errors or use.reasons[0].text.startswith(use.errors[0].text)


def states_loads(use: LoadCaseVerdict) -> bool:
    """Find out whether loads that the sensor can read are to be stated first.

    Args:
        use: The verdict.

    Returns:
        Whether the stated ones are beyond its range, and data are not enough there.
    """
    return use.beyond_range is not None and use.decision == "not enough data"


def _is_offset_predicted(use: LoadCaseVerdict) -> bool:
    """Whether taring is next since an offset makes most of the predicted error, not one that data show."""
    return use.tared_load_case is not None and use.limited_by == "offset"


def next_lines(use: LoadCaseVerdict) -> tuple[str, ...]:
    """Give the lines of a file that the next step is about.

    Args:
        use: The verdict.

    Returns:
        A load case that the sensor can read, where the default one is beyond its range; that with a tared offset, where
        data show a constant error. Where it is predicted, the step names its keys.
    """
    stated = use.readable_load_case if states_loads(use) else None if _is_offset_predicted(use) else use.tared_load_case
    return tuple((stated or "").splitlines())


def _measured(row: CalibrationErrors, compared: Sequence[PriorComparison]) -> Iterator[str]:
    """What data that were not fitted measured, with the calibration's own offset where it has one."""
    own = [one for one in compared if one.offset is Offset.FITTED] or list(compared)
    if not own:
        yield f"{row.samples} samples not fitted: mean force error {amount(row.force_error_mean_N, 'N')}"
        return
    errors = ", ".join(
        f"mean {one.quantity} error {amount(one.mean, one.unit)} "
        f"(prior {amount(one.prior_mean, one.unit)}: {one.conclusion})"
        for one in own
    )
    still = (
        f"; loads hardly moved there: {amount(row.excitation_N, 'N')} of {amount(row.load_N, 'N')}, "
        f"{amount(row.excitation_Nm, 'N m')} of {amount(row.load_Nm, 'N m')}"
    )
    yield f"{row.samples} samples not fitted: {errors}{still if row.hardly_moved else ''}"


def next_step(use: LoadCaseVerdict) -> tuple[str, str]:
    """Give the step that follows from a verdict.

    Args:
        use: The verdict.

    Returns:
        The step, and the command for it; empty where there is none.
    """
    if states_loads(use):
        such = ", such as these, which it can read," if use.readable_load_case else ""
        command = to_evaluate(use.calibration)[1]
        return f"state your loads{such} in the experiment file", command
    remedy = next((reason.remedy for reason in use.reasons if reason.remedy is not None), None)
    if remedy is None and use.decision == "use":
        return to_export(use.calibration, use.sensor)
    if remedy is None:
        return RECORD_MORE, to_plan(use.calibration)
    if is_for_inspect(use):
        return remedy, typed("inspect", FIRST_EXPERIMENT)
    if use.tared_load_case is not None:
        if _is_offset_predicted(use):
            header, *keys = use.tared_load_case.splitlines()
            remedy = (
                f"tare it before use and state it (most of the error comes from the offset): {header} {', '.join(keys)}"
            )
        return remedy, to_evaluate(use.calibration)[1]
    records = any(ADVICE_BY_SOURCE[source] in remedy for source in ("matrix", "model"))
    return remedy, to_plan(use.calibration) if records else ""


def is_for_inspect(use: LoadCaseVerdict) -> bool:
    """Find out whether `inspect` shows what is to be corrected.

    Args:
        use: The verdict.

    Returns:
        Whether the first remedy of its reasons is the cause of an error, not a further recording.
    """
    remedy = next((reason.remedy for reason in use.reasons if reason.remedy is not None), None)
    return remedy in (LOOK_FOR_CAUSE, KEEP_PRIOR, CORRECT_DATA)


def _mean(value: float, half_width: float | None, unit: str) -> str:
    return amount(value, unit) if half_width is None else within(value, half_width, unit)


def to_plan(calibration: str) -> str:
    """Give the command that says what to record next.

    Args:
        calibration: File of the calibration.

    Returns:
        The command, with a distance from joint limits, which it needs; empty for a calibration that is in no file.
    """
    if not _is_file(calibration):
        return ""
    return typed("plan", EXPERIMENT, "-c", calibration, "--clearance-deg", "10")


def to_calibrate(sensor: str) -> tuple[str, str]:
    """Give the step that follows where there is no calibration.

    Args:
        sensor: Name of the sensor.

    Returns:
        The step and its command.
    """
    return "calibrate the sensor", typed("calibrate", EXPERIMENT, "--sensor", sensor, "-o", f"{sensor}.json")


def to_evaluate(calibration: str, *options: str) -> tuple[str, str]:
    """Give the step that follows where a calibration has no verdict yet.

    Args:
        calibration: Its file.
        *options: Further words of the command.

    Returns:
        The step and its command.
    """
    command = typed("evaluate", EXPERIMENT, "-c", calibration, *options) if _is_file(calibration) else ""
    return "evaluate its errors at the loads to come", command


def to_export(calibration: str, sensor: str) -> tuple[str, str]:
    """Give the step that follows where a calibration may be used.

    Args:
        calibration: Its file.
        sensor: Name of the sensor.

    Returns:
        The step and its command.
    """
    if not _is_file(calibration):
        return "save the calibration, and export its matrix to the robot", ""
    return "export the matrix to the robot", typed("export", calibration, "--to", "csv", "-o", f"{sensor}.csv")


def _is_file(calibration: str) -> bool:
    """Whether a calibration is in a file that is found from here, as a command needs it; in Python it has any name."""
    try:
        return Path(calibration).is_file()
    except OSError:  # too long for the name of a file
        return False
