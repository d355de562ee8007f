# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `skin calibrate`, `skin check` and `skin wrench` in a few lines."""

from __future__ import annotations

from typing import TYPE_CHECKING

from forcetorque.results.answer import Answer, Concern
from forcetorque.results.number_text import amount, plus_minus, within
from forcetorque.skin.contact.contact_tracking import OFFERED

if TYPE_CHECKING:
    from forcetorque.skin.layout.check import SkinCheck
    from forcetorque.skin.taxels.calibrate import SkinCalibration
    from forcetorque.skin.wrench.known_weight import KnownWeight
    from forcetorque.skin.wrench.skin_wrench import SkinWrench

_TWO_SIGMA = 1.96
"""Standard deviations of a bound that holds with 95 %, of normal noise."""


_NOT_FELT = "intervals leave out shear, lag of pads, and covers that swell; --weight-kg shows the last two"
"""What skin does not show by itself."""


def skin_calibration_answer(result: SkinCalibration) -> Answer:
    """Say how many taxels have a curve, and by how much it errs where it was not fitted.

    Args:
        result: The curves.

    Returns:
        The answer.
    """
    kept = next((row for row in result.candidates if row.curve == result.curve and row.recording == "all"), None)
    kept = kept or next((row for row in result.candidates if row.curve == result.curve), None)
    better = result.least_inside not in (None, result.curve)
    serial = "" if result.serial is None else f" ({result.serial})"
    written = (result.file, result.table_file, result.figure_file)
    return Answer(
        subject=f"{result.patch}{serial}, curve {result.curve}",
        verdict=f"{result.valid_taxels} OF {len(result.taxels)} TAXELS HAVE A CURVE",
        why=(
            "no recording was kept back, so no error is known where it was not fitted"
            if kept is None or kept.inside_kPa is None
            else f"error where it was not fitted: {amount(kept.inside_kPa, 'kPa')} at fitted pressures, up to "
            f"{result.highest_kPa:.0f} kPa"
            + ("" if kept.above_kPa is None else f", {amount(kept.above_kPa, 'kPa')} above; medians over taxels"),
            *((f"the curve {result.least_inside} errs less there",) if better else ()),
        ),
        step=f"calibrate with --curve {result.least_inside}"
        if better
        else "compute contact wrenches by skin wrench, where the patch has a layout",
        written=written,
        concern=Concern.UNCERTAIN if better or kept is None else Concern.NONE,
    )


def skin_check_answer(result: SkinCheck) -> Answer:
    """Say what is wrong with a layout.

    Args:
        result: The findings.

    Returns:
        The answer.
    """
    findings = result.findings
    return Answer(
        subject=f"{result.patch} in {result.frame}, {result.taxels} taxels on {result.modules} modules",
        verdict=f"{len(findings)} FINDING{'S' * (len(findings) > 1)}" if findings else "NO FINDINGS",
        why=tuple(f"{row.defect}: {row.message}" for row in findings[:2]),
        step=findings[0].remedy if findings else "",
        written=(result.repaired_file, result.figure_file),
        concern=Concern.BAD if findings else Concern.NONE,
    )


def skin_wrench_answer(result: SkinWrench) -> Answer:
    """Say when a patch was touched, and how hard.

    Args:
        result: The contacts.

    Returns:
        The answer.
    """
    largest = max(result.contacts, key=lambda row: row.force_N, default=None)
    left_out = len(result.left_out)
    offered = any(row.re_tare == OFFERED for row in result.releases)
    return Answer(
        subject=f"{result.patch} on {result.link}, {result.taxels - left_out} of {result.taxels} taxels",
        verdict=f"TOUCHED in {result.frames_with_contact} of {result.frames} frames"
        if result.frames_with_contact
        else "NOT TOUCHED",
        why=()
        if largest is None
        else (
            *(() if result.weight is None else (_weight(result.weight),)),
            f"largest contact force {within(largest.force_N, _half_width(largest.force_sd_N), 'N')} at "
            f"{largest.time_s:.2f} s; mean of all contacts together {amount(result.mean_force_N, 'N')}",
            f"{len(result.lives)} contact{'s' * (len(result.lives) != 1)}, each from its first frame to its last; "
            f"method {result.method}, heat: {result.temperature}",
            *((_NOT_FELT,) if result.weight is None else ()),
        ),
        step="take what was left after a release as rest, by --re-tare" if offered else "",
        written=(result.output_file, result.figure_file, result.film_file),
        concern=Concern.BAD
        if result.weight is not None and result.weight.agreement.startswith("too")
        else Concern.UNCERTAIN
        if offered or (result.weight is not None and result.weight.agreement == "inconclusive")
        else Concern.NONE,
    )


def _weight(weight: KnownWeight) -> str:
    read = plus_minus(100.0 * weight.share, _percent(weight.share_half_width_95), "%")
    words = {
        "agrees": "it agrees",
        "too much": "TOO MUCH: the cover is softer under an object than in the chamber, or its curves do not hold",
        "too little": "TOO LITTLE: load is lost at the edge, on a slope or on dead taxels, or the curves do not hold",
        "inconclusive": "inconclusive: put it on again, three times or more, each time anew",
    }[weight.agreement]
    settled = max(row.settled_s for row in weight.placements)
    touches = ", ".join(f"{row.from_s:.1f}-{row.to_s:.1f} s" for row in weight.left_out)
    left = f" (left out: {touches}, less than half of the median)" if touches else ""
    return (
        f"known weight of {amount(weight.weight_N, 'N')}: {read} is read of it in {len(weight.placements)} placements"
        f"{left}, settled within {amount(settled, 's')}; {words}"
    )


def _percent(half_width: float | None) -> float | None:
    return None if half_width is None else 100.0 * half_width


def _half_width(deviation: float | None) -> float | None:
    return None if deviation is None else _TWO_SIGMA * deviation
