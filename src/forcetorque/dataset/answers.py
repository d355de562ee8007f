# SPDX-License-Identifier: BSD-3-Clause
"""The answers of `dataset check` and `compensate` in a few lines: what is wrong, and the tool that was taken off."""

from __future__ import annotations

from forcetorque.dataset.result import CompensatedDataset, DatasetCheck, Kind
from forcetorque.payload.result import load_words
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.number_text import amount

_WORDS = {Kind.TOOL_CHANGE: "change of tool", Kind.UNITS: "implausible units"}


def check_answer(check: DatasetCheck) -> Answer:
    """Give the answer of a check.

    Args:
        check: The check.

    Returns:
        The worst findings first.
    """
    harm = [finding for finding in check.findings if finding.harm]
    remarks = [finding for finding in check.findings if not finding.harm]
    kinds = list(dict.fromkeys(_WORDS.get(finding.kind, finding.kind.value) for finding in harm))
    verdict = (
        f"HARM: {', '.join(kinds)}" if harm else f"NO HARM, {len(remarks)} remark(s)" if remarks else "NO HARM FOUND"
    )
    shown = [finding.text for finding in (harm or remarks)[:2]]
    rest = len(check.findings) - len(shown)
    if rest > 0:
        shown[-1] += f"; {rest} more finding(s)"
    lacking = (f"not checked: {check.not_checked[0]}",) if check.not_checked else ()
    named = sorted({number for finding in harm for number in finding.episodes})
    some = bool(named) and len(named) < check.episodes
    step = "leave out or repair these episodes; see them all with --details" if some else ""
    if harm and not some:
        step = "repair the log of the field, or do not train on it; see all findings with --details"
    return Answer(
        subject=f"{check.source}: {check.episodes} episodes, {check.frames} frames of {', '.join(check.fields)}",
        verdict=verdict,
        why=(*shown, *lacking)[:3],
        step=step,
        concern=Concern.BAD if harm else Concern.UNCERTAIN if check.findings else Concern.NONE,
    )


_CONTACTS = 0.2
"""Share of windows that disagree with the tool from which on the identification is doubtful (heuristic)."""


def compensation_answer(result: CompensatedDataset) -> Answer:
    """Give the answer of a compensation.

    Args:
        result: The result.

    Returns:
        What was added, what was taken off, and what that assumed.
    """
    origin = "identified from the dataset" if result.load_from == "dataset" else "as `payload` identified it"
    deviation = result.mean_standard_deviation
    sizes = f"{amount(float(max(deviation[:3])), 'N')}, {amount(float(max(deviation[3:])), 'N m')}"
    touched = f"{100 * result.contact_share:.0f} % of {result.windows} windows disagree, as contacts do, and count less"
    of = "each episode" if result.bias_of == "episode" else "all episodes"
    doubtful = result.contradicted or result.contact_share > _CONTACTS or bool(result.left_out_frames)
    stuck = (
        f"; {result.left_out_frames} frames of stuck components were not fitted, but are written"
        if result.left_out_frames
        else ""
    )
    return Answer(
        subject=f"{result.output}: {result.episodes} episodes, {result.frames} frames",
        verdict=f"{result.feature} ADDED",
        why=(
            f"taken off: {load_words(result.loads[0])}, {origin}; one bias for {of}",
            f"in the frame {result.frame!r}, {result.measure_direction}; standard deviation of a frame up to {sizes}, "
            f"in {result.standard_deviation_feature}",
            f"{touched}{stuck}",
        ),
        step="check the copy before a policy is trained on it",
        command=typed("dataset", "check", result.output),
        concern=Concern.BAD if result.contradicted else Concern.UNCERTAIN if doubtful else Concern.NONE,
    )
