# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a sensor in sentences, from the numbers of its report."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Literal

from forcetorque.cli.evaluate_result import VerdictRow
from forcetorque.cli.report.result import SensorReport, VerdictLine
from forcetorque.cli.words import with_error
from forcetorque.experiment.candidate_names import short_names

_APART = 2.0
"""Standard errors by which two means must differ before one is called better."""

_FEW_INDEPENDENT = 20.0
"""Independent samples below which a standard error from ten blocks is itself a guess."""

Tone = Literal["good", "caution", "bad", "unknown"]


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
    for offset in dict.fromkeys(row.offset for row in report.evaluation):
        rows = [row for row in report.evaluation if row.offset == offset]
        priors = [row for row in rows if row.candidate not in report.calibrations]
        fitted = [row for row in rows if row.candidate in report.calibrations]
        condition = "its own offset" if offset == "fitted" else "the offset re-estimated"
        for row in fitted or priors:
            name = names[row.candidate]
            text = f"{name} with {condition}: mean force error {_force(row)} N over {row.samples} unseen samples"
            if not fitted:
                yield "unknown", f"{text}; no calibration was given to compare it with"
            elif not priors:
                yield "unknown", f"{text}; it has no prior to compare it with"
            else:
                tone, words = _compared(row, priors[0])
                yield tone, f"{text}, {_force(priors[0])} N with the prior: {words}"


def _force(row: VerdictRow) -> str:
    return with_error(row.force_error_mean_N, row.force_error_standard_error_N, digits=2)


def _compared(new: VerdictRow, prior: VerdictRow) -> tuple[Tone, str]:
    errors = (new.force_error_standard_error_N, prior.force_error_standard_error_N)
    if None in errors:
        return "caution", "too few samples to tell them apart"
    uncertainty = math.hypot(*(error for error in errors if error is not None))
    gain = prior.force_error_mean_N - new.force_error_mean_N
    if abs(gain) <= _APART * uncertainty:
        return "caution", f"a difference that the recording does not tell from none ({gain:.2f} ±{uncertainty:.2f} N)"
    if gain < 0.0:
        return "bad", "worse"
    return "good", f"better, {new.force_error_mean_N / prior.force_error_mean_N:.0%} of it is left"


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
    for row in report.static[:1]:
        shares = {one.label: one.saturated_share for one in row.recording if one.saturated_share > 0.0}
        if shares:
            worst = max(shares, key=shares.__getitem__)
            yield "bad", f"saturated or held in {len(shares)} interval(s), most in {worst!r}: {shares[worst]:.2%} of it"


def _sphere(report: SensorReport) -> Iterator[tuple[Tone, str]]:
    names = short_names([row.candidate for row in report.spheres])
    for row in report.spheres:
        fit = row.with_reference
        if fit is None or not fit.identifiable or fit.index_kg is None:
            continue
        high = "" if fit.index_high_kg is None else f" ({fit.index_low_kg:.3f} to {fit.index_high_kg:.3f})"
        yield "unknown", f"{names[row.candidate]}: the three axes weigh the limb {fit.index_kg:.3f} kg apart{high}"
