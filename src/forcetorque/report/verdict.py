# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a sensor in sentences, from everything that was measured of it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Annotated

from forcetorque.calibration.summary import LITTLE_LEARNT, learnt_words
from forcetorque.evaluation.evaluation import CandidateErrors
from forcetorque.evaluation.load_cases.validation_evidence import OFFSET_WORDS, PriorComparison, prior_comparison_text
from forcetorque.evaluation.load_cases.verdict import Tone
from forcetorque.experiment.validation_offset import Offset
from forcetorque.results.number_text import with_error
from forcetorque.results.table import Row, Shown, short_names

if TYPE_CHECKING:
    from forcetorque.report.assessment import Assessment


_FEW_INDEPENDENT = 20.0
"""Independent samples below which a standard error from ten blocks is itself a guess."""


class VerdictLine(Row):
    """A sentence of the verdict."""

    tone: Annotated[Tone, Shown("")]
    """How good it is."""
    text: Annotated[str, Shown("verdict")]
    """The sentence."""


def verdict(assessment: Assessment) -> tuple[VerdictLine, ...]:
    """Say what the numbers of a sensor come to: acceptance, errors, and what makes them doubtful.

    Args:
        assessment: The numbers.

    Returns:
        Sentences, the most important first.
    """
    return tuple(VerdictLine(tone=tone, text=text) for tone, text in _lines(assessment))


def _lines(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    yield from _acceptance(assessment)
    yield from _errors(assessment)
    yield from _doubts(assessment)
    yield from _independence(assessment)
    for warning in assessment.warnings:
        yield "caution", warning
    yield from _excitation(assessment)
    yield from _learnt(assessment)
    yield from _saturation(assessment)
    yield from _sphere(assessment)
    for what, reason in assessment.not_judged.items():
        yield "unknown", f"not judged: {what}: {reason}"
    for words in assessment.left_out:
        yield "unknown", f"left out: {words}"


def _acceptance(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.candidate for row in assessment.criteria])
    for candidate, name in names.items():
        rows = [row for row in assessment.criteria if row.candidate == candidate]
        failed = [row.criterion for row in rows if not row.passed]
        if failed:
            yield "bad", f"{name} is not accepted: {len(failed)} of {len(rows)} criteria fail: {', '.join(failed)}"
        else:
            yield _unless_doubted("good", assessment, candidate), f"{name} is accepted: all {len(rows)} criteria hold"


def _errors(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.candidate for row in assessment.evaluation])
    for row in assessment.evaluation:
        name = names[row.candidate]
        start = f"{name} with {OFFSET_WORDS[row.offset]}, {row.samples} samples that were not fitted: "
        compared = [one for one in assessment.comparisons if (one.candidate, one.offset) == (row.candidate, row.offset)]
        if compared:
            yield _unless_doubted(_tone(compared), assessment, row.candidate), prior_comparison_text(name, compared)
        elif row.candidate in assessment.calibrations:
            yield "unknown", f"{start}{_plain(row)}; it has no prior to compare it with"
        elif not assessment.calibrations:
            yield "unknown", f"{start}{_plain(row)}; no calibration was given to compare it with"
    if any(row.offset is Offset.FITTED for row in assessment.comparisons):
        yield (
            "note",
            "its own offset is one draw: intervals say how the error scatters in these recordings, not how the offset "
            "changes from one switching on to the next",
        )


def _doubts(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names(list(assessment.calibrations))
    for file, calibration in assessment.calibrations.items():
        for doubt in calibration.doubts:
            yield "caution", f"{names[file]} was in doubt before it was fitted: {doubt}"


def _unless_doubted(tone: Tone, assessment: Assessment, candidate: str) -> Tone:
    """A reference that is wrong flatters the calibration that was fitted to it."""
    calibration = assessment.calibrations.get(candidate)
    return "caution" if tone == "good" and calibration is not None and calibration.doubts else tone


def _plain(row: CandidateErrors) -> str:
    force = with_error(row.force_error_mean_N, row.force_error_half_width_95_N, digits=2)
    moment = with_error(row.moment_error_mean_Nm, row.moment_error_half_width_95_Nm, digits=3)
    return f"force error {force} N, moment error {moment} N m"


def _tone(rows: Sequence[PriorComparison]) -> Tone:
    """Good needs neither of force and moment worse, and one better."""
    judgements = {row.judgement for row in rows}
    if "worse" in judgements:
        return "bad"
    return "good" if "better" in judgements else "caution"


def _independence(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    counts = [count for row in assessment.independence for count in row.independent if count is not None]
    if counts and min(counts) < _FEW_INDEPENDENT:
        yield (
            "caution",
            f"neighbouring errors repeat each other: some components are worth {min(counts):.0f} independent samples "
            "only, so standard errors are themselves uncertain",
        )


def _excitation(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names(list(assessment.calibrations))
    for file, calibration in assessment.calibrations.items():
        excited = calibration.validity.excited
        if calibration.posterior is None and not all(excited):
            yield (
                "caution",
                f"{names[file]}: the fitted loads moved {sum(excited)} of {len(excited)} raw directions; along the "
                "others the prior, or noise, decides",
            )


def _learnt(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names(list(assessment.calibrations))
    for file, rows in assessment.learnt.items():
        if any(row.learnt < LITTLE_LEARNT for row in rows):
            yield "caution", f"{names[file]}: {learnt_words(rows)}"


def _saturation(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    # every candidate is read from the same recording
    shares = {interval.label: interval.saturated_share for row in assessment.static for interval in row.recording}
    hit = {label: share for label, share in shares.items() if share > 0.0}
    if hit:
        worst = max(hit, key=hit.__getitem__)
        yield "bad", f"saturated or held in {len(hit)} interval(s), most in {worst!r}: {hit[worst]:.2%} of it"


def _sphere(assessment: Assessment) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.candidate for row in assessment.spheres])
    for row in assessment.spheres:
        fit = row.with_reference
        if fit is None or not fit.identifiable or fit.index_kg is None:
            continue
        high = "" if fit.index_high_kg is None else f" ({fit.index_low_kg:.3f} to {fit.index_high_kg:.3f})"
        text = f"{names[row.candidate]}: the three axes weigh the limb {fit.index_kg:.3f} kg apart{high}"
        if row.fitted_on:
            labels = ", ".join(map(repr, row.fitted_on))
            yield "caution", f"{text}, which flatters: it was fitted on {labels}"
        else:
            yield "note", text
