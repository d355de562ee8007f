# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a sensor in sentences, from the numbers of its report."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from forcetorque.analysis.reading import NO_OFFSET
from forcetorque.cli.evaluate_result import VerdictRow
from forcetorque.cli.report.result import ComparisonRow, SensorReport, VerdictLine
from forcetorque.cli.words import with_error
from forcetorque.result.names import short_names

_FEWEST = 20
"""Samples below which nothing is called good."""

_FEW_INDEPENDENT = 20.0
"""Independent samples below which a standard error from ten blocks is itself a guess."""

Tone = Literal["good", "caution", "bad", "unknown", "note"]


def sensor_verdict(report: SensorReport) -> list[VerdictLine]:
    """Say what the numbers of a sensor come to: acceptance, errors, and what makes them doubtful.

    Args:
        report: The numbers.

    Returns:
        Sentences, the most important first.
    """
    return [VerdictLine(tone=tone, text=text) for tone, text in _lines(report)]


def _lines(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    yield from _acceptance(report)
    yield from _errors(report)
    yield from _independence(report)
    for warning in report.warnings:
        yield "caution", warning
    yield from _excitation(report)
    yield from _saturation(report)
    yield from _sphere(report)
    for what, reason in report.not_judged.items():
        yield "unknown", f"not judged: {what}: {reason}"


def _acceptance(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.candidate for row in report.criteria])
    for candidate, name in names.items():
        rows = [row for row in report.criteria if row.candidate == candidate]
        failed = [row.criterion for row in rows if not row.passed]
        if failed:
            yield "bad", f"{name} is not accepted: {len(failed)} of {len(rows)} criteria fail: {', '.join(failed)}"
        else:
            yield "good", f"{name} is accepted: all {len(rows)} criteria hold"


def _errors(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.candidate for row in report.evaluation])
    for row in report.evaluation:
        condition = _offset_words(row)
        start = f"{names[row.candidate]} with {condition}, {row.samples} samples that were not fitted: "
        compared = [one for one in report.comparisons if (one.candidate, one.offset) == (row.candidate, row.offset)]
        if compared:
            constant = f"; {compared[0].constant:.2f} N is constant" if row.offset == "fitted" else ""
            words = "; ".join(f"{one.quantity} error {_compared(one)}" for one in compared)
            yield _tone(compared), start + words + constant
        elif row.candidate in report.calibrations:
            yield "unknown", f"{start}{_plain(row)}; it has no prior to compare it with"
        elif not report.calibrations:
            yield "unknown", f"{start}{_plain(row)}; no calibration was given to compare it with"
    if any(row.offset == "fitted" for row in report.comparisons):
        yield (
            "note",
            "its own offset is one draw: intervals say how the error scatters in these recordings, not how the offset "
            "changes from one switching on to the next",
        )


def _offset_words(row: VerdictRow) -> str:
    if row.offset == "re-estimated":
        return "the offset re-estimated"
    return NO_OFFSET if NO_OFFSET in row.offset_source else "its own offset"


def _plain(row: VerdictRow) -> str:
    force = with_error(row.force_error_mean_N, row.force_error_standard_error_N, digits=2)
    moment = with_error(row.moment_error_mean_Nm, row.moment_error_standard_error_Nm, digits=3)
    return f"force error {force} N, moment error {moment} N m"


def _verdict_of(row: ComparisonRow) -> Literal["better", "worse", "no difference that the recording shows"] | None:
    """What the interval of the difference says; None where the samples are too few to say anything."""
    if row.gain_low is None or row.gain_high is None or row.samples < _FEWEST:
        return None
    if row.gain_low <= 0.0 <= row.gain_high:
        return "no difference that the recording shows"
    return "better" if row.gain_low > 0.0 else "worse"


def _compared(row: ComparisonRow) -> str:
    digits = 2 if row.quantity == "force" else 3
    means = f"{row.mean:.{digits}f} {row.unit} against {row.prior_mean:.{digits}f} {row.unit} with the prior"
    verdict = _verdict_of(row)
    if verdict is None:
        return f"{means} (too few samples to tell them apart)"
    interval = f"less by {row.gain:.{digits}f}, {row.gain_low:.{digits}f} to {row.gain_high:.{digits}f}"
    return f"{means} ({verdict}: {interval})"


def _tone(rows: list[ComparisonRow]) -> Tone:
    found = {_verdict_of(row) for row in rows}
    if "worse" in found:
        return "bad"
    return "good" if "better" in found else "caution"


def _independence(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    counts = [count for row in report.independence for count in row.independent if count is not None]
    if counts and min(counts) < _FEW_INDEPENDENT:
        yield (
            "caution",
            f"neighbouring errors repeat each other: some components are worth {min(counts):.0f} independent samples "
            "only, so standard errors are themselves uncertain",
        )


def _excitation(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    names = short_names(list(report.calibrations))
    for file, calibration in report.calibrations.items():
        excited = calibration.validity.excited
        if not all(excited):
            yield (
                "caution",
                f"{names[file]}: the fitted loads moved {sum(excited)} of {len(excited)} raw directions; along the "
                "others the prior, or noise, decides",
            )


def _saturation(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    # every candidate is read from the same recording
    shares = {one.label: one.saturated_share for row in report.static for one in row.recording}
    hit = {label: share for label, share in shares.items() if share > 0.0}
    if hit:
        worst = max(hit, key=hit.__getitem__)
        yield "bad", f"saturated or held in {len(hit)} interval(s), most in {worst!r}: {hit[worst]:.2%} of it"


def _sphere(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.candidate for row in report.spheres])
    for row in report.spheres:
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
