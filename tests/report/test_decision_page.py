# SPDX-License-Identifier: BSD-3-Clause
"""The first page: what speaks against the predicted error stands beside it."""

from __future__ import annotations

from forcetorque.evaluation.load_cases.verdict import Reason
from forcetorque.report.decision_page import all_sensors_page, decision_page
from forcetorque.report.pooled_verdicts import NextSteps, Undecided
from forcetorque.report.sensor_assessment import VerdictLine
from forcetorque.results.document.content import Block, List, Verdict
from forcetorque.results.table import Table
from tests.report.drawing import use_of
from tests.scenes.calibrations import make_calibration

STEPS = NextSteps(sensor="leg_ft", serial="SN1", steps=())
OUTSIDE = VerdictLine(tone="caution", text="leg.json: 100 % of 7095 readings lie outside what was fitted")
SATURATED = VerdictLine(tone="bad", text="saturated or held in 1 interval(s), most in 'day 2': 5.07% of it")
BETTER = VerdictLine(tone="good", text="leg.json is accepted: all 3 criteria hold")


def _words(blocks: tuple[Block, ...]) -> list[str]:
    """Sentences and points, in their order."""
    words: list[str] = []
    for block in blocks:
        words += [block.text] if isinstance(block, Verdict) else list(block.points) if isinstance(block, List) else []
    return words


def _page(*lines: VerdictLine, measured: float | None, reasons: tuple[Reason, ...] = ()) -> list[str]:
    uses = [use_of("leg.json", force=2.0, measured=measured, reasons=reasons)]
    page = decision_page(STEPS, uses, [], {"leg.json": make_calibration()}, lines, explained=False)
    return _words(page.blocks)


def test_all_that_speaks_against_the_number_is_on_the_page() -> None:
    """A larger measured error, saturation, readings outside what was fitted, and other reasons, below the verdict."""
    other = Reason(against="data", text="the load hardly moved", remedy="judge data that move")
    first = Reason(against=None, text="it errs by some 2 N")
    verdict, *against = _page(OUTSIDE, BETTER, SATURATED, measured=6.2, reasons=(first, other))
    assert "it errs by some 2 N" in verdict
    assert (
        "errs by 6.2 N and 0.062 N m (RMS), more than is predicted at most for “push” (4.0 N, 0.040 N m)" in against[0]
    )
    assert against[1:] == [
        f"{SATURATED.text}.",
        "warning: the load hardly moved",
        f"warning: {OUTSIDE.text}",
    ]


def test_nothing_is_said_against_a_number_that_nothing_contradicts() -> None:
    """Negative control: a measured error within what is predicted, or none."""
    for measured in (3.9, None):
        assert len(_page(BETTER, measured=measured)) == 1


def test_page_one_of_several_sensors_has_all_of_them() -> None:
    """Those that must not be used come first, each with its error before and after and what to do next."""
    remedy = Reason(against="use", text="it errs too much", remedy="look for the cause")
    good = use_of("leg.json", force=2.0, reasons=(Reason(against=None, text="fine"),)).model_copy(
        update={"sensor": "leg_ft", "serial": "SN1"}
    )
    bad = use_of("arm.json", force=8.0, reasons=(remedy,)).model_copy(update={"sensor": "arm_ft", "serial": "SN2"})
    without = Undecided(sensor="foot_ft", serial="SN3", calibration=None, reason="no calibration was given")
    steps = (NextSteps(sensor="leg_ft", serial="SN1", steps=("put it on the robot",)),)
    page = all_sensors_page([good, bad], [without], steps)
    assert _words(page.blocks) == ["1: arm_ft.", "1: leg_ft.", "1: foot_ft."]
    (table,) = (block for block in page.blocks if isinstance(block, Table))
    assert [(row[0], row[2]) for row in table.rows] == [
        ("arm_ft (SN2)", "do not use"),
        ("leg_ft (SN1)", "use"),
        ("foot_ft (SN3)", "no verdict"),
    ]
    assert [row[4] for row in table.rows] == ["20 → 8 N (16; 8)", "20 → 2 N (4; 8)", ""]
    assert [row[-1] for row in table.rows] == ["look for the cause", "put it on the robot", "no calibration was given"]
