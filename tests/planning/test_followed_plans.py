# SPDX-License-Identifier: BSD-3-Clause
"""What becomes of sensors that may not be used once the recordings are made that a plan for the use asks for."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import pytest

from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.planning.information import Knowledge, Nuisance
from forcetorque.planning.posture_search import Criterion
from forcetorque.planning.proposed_recordings import Demand, Effort, Workplace, proposals, supports_of, workplaces
from forcetorque.planning.section import PLAN, PlanTable
from forcetorque.simulation.scenario.scenario import Scenario, load_scenario
from forcetorque.simulation.scenario.scenario_file import bundled_scenario
from tests.evaluation.load_cases.simulated_uses import FOOT, LEG, Outcome, outcome_of, outcomes
from tests.planning.planned_sensors import LIMIT_COUNTS, planned_motions, planned_run

RECORDINGS, SECONDS = 3, 70.0
_CLEARANCE_DEG = 5.0
_POLE = """
[plan]
clearance_deg = 5
support = "root_link"
"""
_WEIGHTS = """
[[plan.tool]]
name = "weight in front"
frame = "l_sole"
mass_kg = 5.0
centre_of_mass_m = [0.1, 0.0, -0.05]
[[plan.tool]]
name = "weight beside"
frame = "l_sole"
mass_kg = 5.0
centre_of_mass_m = [0.0, 0.15, 0.05]
"""
_FIRST = 100
"""Number of the first planned recording, which none of the scenario has."""


@dataclass(frozen=True, kw_only=True)
class Lab:
    """A robot on a pole, and what may be attached to its foot."""

    folder: Path
    rest: str

    @cached_property
    def scenario(self) -> Scenario:
        """The scenario whose robot it is."""
        return load_scenario(bundled_scenario("icub-insitu"))

    def follow(self, outcome: Outcome) -> Outcome:
        """Plan recordings for the use by what is known of the sensor, make them, calibrate on all and judge again."""
        case = outcome.case
        wanted = proposals(
            self._places(outcome),
            _known(outcome),
            Demand(
                criterion=Criterion(case=outcome.use),
                seconds=SECONDS,
                hold_s=1.0,
                effort=Effort(postures=150, swaps=20),
            ),
            recordings=RECORDINGS,
        )
        motions = planned_motions(list(wanted), case.sensor, first=_FIRST)
        data = [motion.recorded(case.sensor, case.specimen, case.seed) for motion in motions]
        longer = replace(case, data=[*case.data, *data])
        return outcome_of(longer, longer.generative(), outcome.use, outcome.judged)

    def _places(self, outcome: Outcome) -> list[Workplace]:
        case = outcome.case
        run = planned_run(self.folder, self.scenario, case.sensor, ("root_link",), self.rest, case.specimen)
        table = run.experiment.section(PLAN) or PlanTable()
        return workplaces(run, table, _CLEARANCE_DEG, supports_of([run], table))


def _known(outcome: Outcome) -> Knowledge:
    case = outcome.case
    assumptions = Assumptions.of_counts(6, LIMIT_COUNTS, accuracy=np.zeros(6))
    return Knowledge.of(
        outcome.fit.posterior,
        seconds=sum(float(np.ptp(data.time_s)) for data in case.data),
        nuisance=Nuisance.of(case.prior, assumptions, with_prior=True),
    )


@pytest.fixture(scope="module")
def refused() -> list[Outcome]:
    """Of 20 sensors in four motions for three uses those that may not be used."""
    return [one for one in outcomes(range(811, 821)) if one.decision != "use"]


@pytest.mark.long
def test_a_foot_that_hung_free_may_be_used_after_recordings_with_weights(tmp_path: Path) -> None:
    """And not after recordings without: a foot by itself is too light to teach what the use needs."""
    judged = outcomes(range(811, 812), fitted={"tz": ["tz"]})
    (push,) = (one for one in judged if (one.case.sensor, one.use.name) == (FOOT, "push"))
    assert push.decision == "not enough data"
    assert push.within < 0.1
    followed = Lab(folder=tmp_path, rest=_POLE + _WEIGHTS).follow(push)
    assert followed.decision == "use"
    assert followed.good
    assert Lab(folder=tmp_path, rest=_POLE).follow(push).decision == "not enough data"


@pytest.mark.long
@pytest.mark.parametrize(
    ("sensor", "rest", "least", "most"),
    [
        pytest.param(LEG, _POLE, 0.8, 1.0, id="leg"),
        pytest.param(FOOT, _POLE + _WEIGHTS, 0.8, 1.0, id="foot with weights"),
        # negative control: recordings that cannot teach what is asked do not make a sensor good, nor is it called so
        pytest.param(FOOT, _POLE, 0.0, 0.4, id="foot alone"),
    ],
)
def test_planned_recordings_bring_refused_sensors_to_use(
    refused: list[Outcome], tmp_path: Path, sensor: str, rest: str, least: float, most: float
) -> None:
    """All 31 legs, all 100 feet with weights, 20 of 100 feet without; all are good, none errs more than stated."""
    lab = Lab(folder=tmp_path, rest=rest)
    followed = [(one, lab.follow(one)) for one in refused if one.case.sensor == sensor]
    for unlikely in (False, True):
        used = [after.decision == "use" for one, after in followed if (one.within <= 0.1) == unlikely]
        assert least * len(used) <= sum(used) <= most * len(used)
    good = [after for _, after in followed if after.decision == "use"]
    assert sum(not one.good for one in good) <= 0.05 * len(good)
    assert sum(one.above for one in good) <= 0.05 * len(good)
