# SPDX-License-Identifier: BSD-3-Clause
"""Which calibrations may be used for the loads to come."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Final

from forcetorque.analysis.payload.load_doubts import circular_loads
from forcetorque.analysis.runs.campaign import Campaign, Runs
from forcetorque.analysis.runs.named import Calibrations, named
from forcetorque.analysis.runs.unseen import doubts_about_choice, require_unseen_if_judged
from forcetorque.analysis.use.judge import UseJudge
from forcetorque.analysis.use.judged_evidence import judged_evidence
from forcetorque.analysis.use.loads_of_use import Refuse, loads_of_use, raise_refused
from forcetorque.analysis.use.prior_comparison import compare_with_prior
from forcetorque.analysis.use.verdict import Reason, UseVerdict
from forcetorque.calibration import Calibration
from forcetorque.errors import FitError
from forcetorque.evaluation import Offset
from forcetorque.evaluation.use import UseOffset
from forcetorque.experiment.tables.load_case import LoadCaseTable
from forcetorque.recording import Use


def use_verdicts(
    runs: Runs,
    calibrations: Calibrations,
    more: Sequence[LoadCaseTable] = (),
    *,
    refuse: Refuse = raise_refused,
) -> tuple[UseVerdict, ...]:
    """Say of every calibration whether it may be used for the loads to come.

    It may where the predicted error is within what is allowed with 95 %, and data that were not fitted moved and do
    not speak against it. It may not where that has a probability of at most 10 %, or the judged data say so.

    Args:
        runs: The sensor in one recording, or in several.
        calibrations: Its calibrations by name, or one, which have not seen the validation intervals.
        more: Load cases beside those of the experiments, such as those of an acceptance file.
        refuse: Called with what is wrong with a load case, on which there is then no verdict; raises it if left out.

    Returns:
        A verdict for every calibration and load case.

    Raises:
        ExperimentError: If a load case cannot be had at the sensor, or a calibration has seen a judged interval.
        SerialNumberError: If a calibration is of another sensor.
        FitError: If a load case changes a variable that the calibration does not know.
    """
    campaign, judged = Campaign.of(runs), named(calibrations)
    for name, calibration in judged.items():
        for run in campaign.runs:
            require_unseen_if_judged(name, calibration, run)
    measured = judged_evidence(campaign, judged)
    compared = compare_with_prior(campaign, judged) if measured else ()
    worse = [row for row in compared if row.judgement == "worse"]
    verdicts = []
    for name, calibration in judged.items():
        informing = tuple(dict.fromkeys(_informing(campaign, name, calibration)))
        for case in loads_of_use(campaign.runs, more, matrix=calibration.matrix, refuse=refuse):
            try:
                judge = UseJudge(
                    case,
                    calibration,
                    measured.get(name),
                    worse=[row for row in worse if (row.candidate, row.offset) == (name, _COMPARED[case.offset])],
                )
            except FitError as error:
                refuse(error)
            else:
                verdicts.append(_verdict(campaign, name, judge, informing))
    return tuple(verdicts)


def _informing(campaign: Campaign, name: str, calibration: Calibration) -> Iterator[Reason]:
    """What no judged data can show: that what judges is not independent of what is judged."""
    for run in campaign.runs:
        circular = circular_loads(run)
        chosen = doubts_about_choice(run, name, calibration) if run.has(Use.VALIDATION) else ()
        for sentence in (*circular, *chosen):
            if sentence not in calibration.doubts:  # of which the judge speaks
                yield Reason(against=None, text=sentence)


_COMPARED: Final = {UseOffset.FITTED: Offset.FITTED, UseOffset.TARED: Offset.JUDGED_MEAN}
"""With which offset judged data compare a calibration and its prior for a use."""


def _verdict(campaign: Campaign, name: str, judge: UseJudge, informing: tuple[Reason, ...]) -> UseVerdict:
    decision, reasons = judge.verdict()
    case = judge.case
    return UseVerdict(
        sensor=campaign.sensor.name,
        serial=campaign.sensor.serial,
        candidate=name,
        load_case=case.name,
        loads=case.words,
        offset=case.offset.value,
        stated=case.is_stated,
        decision=decision,
        sentence=f"{decision} for {case.words}: {reasons[0].text}",
        reasons=(*reasons, *informing),
        within=judge.within,
        errors=tuple(judge.errors()),
    )
