# SPDX-License-Identifier: BSD-3-Clause
"""Whether the sensors of a report may be used, pooled over all recordings, and what to do next about each."""

from __future__ import annotations

import shlex
from collections.abc import Collection, Hashable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from typing import TypeVar

from forcetorque.base.errors import ForceTorqueError
from forcetorque.calibration.summary import LITTLE_LEARNT, information_gains, to_learn
from forcetorque.evaluation.load_cases.predicted_error import CONFIDENCE
from forcetorque.evaluation.load_cases.verdict import KEEP_PRIOR, LoadCaseVerdict, use_verdicts
from forcetorque.evaluation.section import LOAD_CASES
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.campaign import Campaign
from forcetorque.experiment.seen_and_outside_samples import require_unseen_if_judged
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.planning.planning import plan_sentence
from forcetorque.planning.section import PLAN
from forcetorque.report.sensor_assessment import Demands
from forcetorque.results.table import RowOfSensor, short_names

SensorKey = tuple[str, str]
"""Name of a sensor, and its serial number: robots share names."""


class Undecided(RowOfSensor):
    """Why there is no verdict on a calibration."""

    calibration: str | None
    """The calibration file; None where the sensor has none."""
    reason: str
    """Why, and what was expected."""


def decide_uses(
    runs: Sequence[Mapping[str, SensorRun]],
    calibrations: Sequence[Mapping[str, Mapping[str, Calibration]]],
    demands: Demands,
) -> tuple[tuple[LoadCaseVerdict, ...], tuple[Undecided, ...]]:
    """Decide on every calibration over all recordings whose validation intervals were not fitted.

    Args:
        runs: For every experiment the runs of the evaluated sensors, by sensor.
        calibrations: For every experiment calibrations by name of their file, by sensor.
        demands: Limits, whose load cases are evaluated too.

    Returns:
        Verdicts, and calibrations and sensors on which there is none.
    """
    more = demands.acceptance.load_case if demands.acceptance is not None else ()
    verdicts: list[LoadCaseVerdict] = []
    undecided: list[Undecided] = []

    def refuse(key: SensorKey, file: str | None, reason: object) -> None:
        undecided.append(Undecided(sensor=key[0], serial=key[1], calibration=file, reason=str(reason)))

    for key, own in _by_sensor(runs).items():
        files = {
            file: one
            for run, groups in zip(runs, calibrations, strict=True)
            if key[0] in run and sensor_key(run[key[0]]) == key
            for file, one in groups.get(key[0], {}).items()
        }
        if not files:
            refuse(key, None, "no calibration was given; without one no error can be predicted")
        for file, calibration in files.items():
            try:
                campaign = Campaign(_unseen(own, file, calibration))
                # a load case that cannot be had leaves the others to be evaluated
                verdicts += use_verdicts(campaign, {file: calibration}, more, refuse=partial(refuse, key, file))
            except ForceTorqueError as error:
                refuse(key, file, error)
    return tuple(verdicts), tuple(undecided)


def sensor_keys(uses: Sequence[LoadCaseVerdict], undecided: Sequence[Undecided]) -> list[SensorKey]:
    """List the sensors that have a verdict or a reason for none.

    Args:
        uses: Verdicts.
        undecided: Calibrations and sensors on which there is none.

    Returns:
        Name and serial number of each, once.
    """
    keys = [*((row.sensor, row.serial) for row in uses), *((row.sensor, row.serial) for row in undecided)]
    return list(dict.fromkeys(keys))


def sensor_key(run: SensorRun) -> SensorKey:
    """Identify a sensor.

    Args:
        run: A sensor in a recording.

    Returns:
        Its name and serial number.
    """
    return run.sensor.name, run.sensor.serial


def _by_sensor(runs: Sequence[Mapping[str, SensorRun]]) -> dict[SensorKey, list[SensorRun]]:
    pooled: dict[SensorKey, list[SensorRun]] = {}
    for own in runs:
        for run in own.values():
            pooled.setdefault(sensor_key(run), []).append(run)
    return pooled


def _unseen(runs: Sequence[SensorRun], file: str, calibration: Calibration) -> list[SensorRun]:
    """The runs on which a calibration may be evaluated; the first reason where it is none of them."""
    left = list(_accepted(runs, file, calibration))
    if not left:
        require_unseen_if_judged(file, calibration, runs[0])
    return left


def _accepted(runs: Sequence[SensorRun], file: str, calibration: Calibration) -> Iterator[SensorRun]:
    for run in runs:
        try:
            require_unseen_if_judged(file, calibration, run)
        except ForceTorqueError:  # it was fitted on these data; other recordings may evaluate it
            continue
        yield run


_Text = TypeVar("_Text", bound=Hashable)


def grouped_by_text(pairs: Iterable[tuple[str, _Text]]) -> list[tuple[tuple[str, ...], _Text]]:
    """Group names with the same text.

    Args:
        pairs: Pairs of a name and a text.

    Returns:
        Names, each once, with their text; in the order of first occurrence.
    """
    names_of: dict[_Text, dict[str, None]] = {}
    for name, text in pairs:
        names_of.setdefault(text, {})[name] = None
    return [(tuple(names), text) for text, names in names_of.items()]


def texts_with_names(sentences: Iterable[tuple[str, str]], everyone: Collection[str]) -> list[str]:
    """List every text once.

    Args:
        sentences: Pairs of a name and a text.
        everyone: All names.

    Returns:
        A text by itself if it holds for all names, else behind its names.
    """
    return [
        sentence if set(names) == set(everyone) else f"{', '.join(names)}: {sentence}"
        for names, sentence in grouped_by_text(sentences)
    ]


class NextSteps(RowOfSensor):
    """What to do next about a sensor."""

    steps: tuple[str, ...]
    """Sentences, the first is done first."""


def next_steps(
    key: SensorKey,
    uses: Sequence[LoadCaseVerdict],
    undecided: Sequence[Undecided],
    calibrations: Mapping[str, Calibration],
    runs: Mapping[str, SensorRun],
) -> NextSteps:
    """List the next steps for a sensor.

    Args:
        key: Name of the sensor, and serial number.
        uses: Verdicts on its calibrations.
        undecided: Its calibrations on which there is none.
        calibrations: All of its calibrations by name of their file.
        runs: The sensor in every experiment that has it, by name of the file.

    Returns:
        The steps: what to do with the calibration today, what to mend, what to record, what to state.
    """
    names = short_names(list(calibrations))
    steps = [
        *_today(uses, names),
        *texts_with_names(
            ((names[verdict.calibration], step) for verdict in uses for step in _remedies(verdict)), names.values()
        ),
        *texts_with_names(_to_record(uses, calibrations, names), names.values()),
        *_plan(_to_plan(uses, [*runs.values()]), calibrations, runs, names),
        *_begin(undecided, key[0], [*runs], names),
        *_state_use(uses),
    ]
    return NextSteps(sensor=key[0], serial=key[1], steps=tuple(dict.fromkeys(steps)))


def _today(uses: Sequence[LoadCaseVerdict], names: Mapping[str, str]) -> Iterator[str]:
    """What to do with the calibrations as they are, those and those uses together of which it is the same."""
    by_calibration = grouped_by_text(
        (f"“{verdict.load_case}”", (names[verdict.calibration], _as_it_is(verdict))) for verdict in uses
    )
    by_cases = ((name, (cases, words)) for cases, (name, words) in by_calibration)
    for calibrations, (cases, words) in grouped_by_text(by_cases):
        yield words.format(calibration=" and ".join(calibrations), use=" and ".join(cases))


def _as_it_is(verdict: LoadCaseVerdict) -> str:
    """What to do with a calibration, with places for its name and for that of the use."""
    if verdict.decision == "use":
        offset = (
            "Tare the sensor under a known load each time before it is used."
            if verdict.offset == "tared"
            else "Its offset holds until the sensor is switched off or mounted anew."
        )
        return "Put {calibration} on the robot for {use}: `forcetorque export` writes what robots read. " + offset
    instead = ""
    if verdict.larger_than_prior:
        # measured errors rule over predicted ones; where they forbid the use, a remedy says to keep the prior
        if not any(reason.remedy == KEEP_PRIOR for reason in verdict.reasons):
            larger = " and ".join(verdict.larger_than_prior)
            instead = f" On data that were not fitted the matrix that it came from (the prior) errs less in {larger}."
    elif _predicts_too_much(verdict):
        instead = _instead(verdict)
    return "Do not rely on {calibration} for {use} yet." + instead


def _instead(verdict: LoadCaseVerdict) -> str:
    """Whether the prior is any better."""
    pairs = [(row, row.before_at_most) for row in verdict.errors if row.before_at_most is not None]
    if not pairs:
        return " Nothing is known of another matrix that could take its place."
    if all(row.allowed is None or most <= row.allowed for row, most in pairs):
        return (
            " The matrix that it came from (the prior) may be used there if the errors that it shows on "
            "validation intervals confirm it: its predicted errors are small enough."
        )
    judged = [(row, most) for row, most in pairs if row.allowed is not None] or pairs
    worse = all(most >= row.after_at_most for row, most in judged)
    more = "is predicted to err even more" if worse else "is predicted to err too much as well"
    return f" The matrix that it came from (the prior) {more}, so do not go back to it either."


def _remedies(verdict: LoadCaseVerdict) -> Iterator[str]:
    for reason in verdict.reasons:
        if reason.against is not None:
            yield reason.remedy or _sentence(reason.text)


def _sentence(text: str) -> str:
    return f"{text[:1].upper()}{text[1:]}."


def _to_record(
    uses: Sequence[LoadCaseVerdict], calibrations: Mapping[str, Calibration], names: Mapping[str, str]
) -> Iterator[tuple[str, str]]:
    """By name of a calibration what its recordings hardly taught, where its predicted error is too large."""
    for verdict in uses:
        rows = information_gains(calibrations[verdict.calibration]) if _predicts_too_much(verdict) else None
        advice = None if rows is None else to_learn(rows)
        if advice is not None:
            little = ", ".join(row.direction for row in rows or () if row.uncertainty_reduction < LITTLE_LEARNT)
            yield (
                names[verdict.calibration],
                f"The recordings gave little information on loads along {little}: {advice}.",
            )


def _predicts_too_much(verdict: LoadCaseVerdict) -> bool:
    return verdict.within is not None and verdict.within < CONFIDENCE


def _to_plan(uses: Sequence[LoadCaseVerdict], runs: Sequence[SensorRun]) -> dict[str, list[LoadCaseVerdict]]:
    """By file of a calibration the verdicts for which a plan can say what to record."""
    if not all(run.experiment.stands for run in runs):
        return {}
    known = {table.name for run in runs for table in run.experiment.section(LOAD_CASES)}
    wanted: dict[str, list[LoadCaseVerdict]] = {}
    for verdict in uses:
        # no plan reads the uses of an acceptance file
        if _predicts_too_much(verdict) and (not verdict.specified or verdict.load_case in known):
            wanted.setdefault(verdict.calibration, []).append(verdict)
    return wanted


def _plan(
    wanted: Mapping[str, Sequence[LoadCaseVerdict]],
    calibrations: Mapping[str, Calibration],
    runs: Mapping[str, SensorRun],
    names: Mapping[str, str],
) -> Iterator[str]:
    """The first recording for the load case that a calibration is farthest from, and the command for the others."""
    tables = [run.experiment.section(PLAN) for run in runs.values()]
    if any(table is not None and table.clearance_deg is not None for table in tables):
        first = [
            (names[file], _first_recording(calibrations[file], min(verdicts, key=_chance), [*runs.values()]))
            for file, verdicts in wanted.items()
        ]
        yield from texts_with_names(first, names.values())
        specified: list[str] = []
    else:
        specified = ["--clearance-deg", "10"]
    for file in wanted:
        command = shlex.join(["forcetorque", "plan", *runs, "-c", file, *specified])
        kept = "; joints keep 10 degrees away from their limits" if specified else ""
        yield f"`{command}` lists what to record next, and the error to expect after each recording{kept}."


def _first_recording(calibration: Calibration, verdict: LoadCaseVerdict, runs: Sequence[SensorRun]) -> str:
    try:
        words = plan_sentence(runs, calibration, load_case=verdict.load_case)
    except ForceTorqueError as error:
        words = f"no recording could be planned: {error}"
    return f"For “{verdict.load_case}”, {words}."


def _chance(verdict: LoadCaseVerdict) -> float:
    """Predicted probability of an error within what is allowed."""
    return 1.0 if verdict.within is None else verdict.within


def _begin(
    undecided: Sequence[Undecided], sensor: str, files: Sequence[str], names: Mapping[str, str]
) -> Iterator[str]:
    """What comes before there can be a verdict."""
    unjudged = [names[row.calibration] for row in undecided if row.calibration is not None]
    if unjudged:
        names_of = " and ".join(unjudged)
        yield f"Remove what prevents a verdict on {names_of}, as listed above, and write this report again."
    if len(unjudged) < len(undecided):
        command = shlex.join(["forcetorque", "calibrate", *files, "--sensor", sensor, "-o", f"{sensor}.json"])
        yield f"Calibrate it, `{command}`, and write this report again with the calibration."


def _state_use(uses: Sequence[LoadCaseVerdict]) -> Iterator[str]:
    """Ask for the load case where the default is used."""
    for loads in dict.fromkeys(verdict.loads for verdict in uses if not verdict.specified):
        yield (
            f"Check that this is your use. The experiment file specifies none, so it is about {loads}; specify your "
            "loads, and the error that you allow, as [[load_case]] in the experiment file, and write this report again."
        )
