# SPDX-License-Identifier: BSD-3-Clause
"""Recordings with the most information for a joint calibration of all sensors."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.calibration.joint.calibrate import JointData
from forcetorque.calibration.joint.result import JointOutcome
from forcetorque.evaluation.load_cases.load_case import LoadCase, operating_load_cases
from forcetorque.evaluation.load_cases.predicted_error import predict, predict_prior
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.recording_notes import with_recording_notes
from forcetorque.planning.posture_search import HELPS
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import FloatOrNull, Row, Shown, Table, table_of


class JointPlanStep(Row):
    """One recording, added to those before it."""

    step: Annotated[int, Shown("recording")]
    """Its number, from 1."""
    recording: Annotated[str, Shown("motion")]
    """Which of the given recordings has the motion."""
    sensors: Annotated[int, Shown("sensors")]
    """Sensors with a use that the recordings so far tell something of."""
    excess_before: Annotated[float, Shown("error over allowed before", digits=2)]
    """Predicted error over what is allowed, geometric mean over sensors and uses."""
    excess_after: Annotated[float, Shown("after", digits=2)]
    """The same with this recording."""


class SensorForecast(Row):
    """What one sensor is expected to err by at the loads of one use; root mean square over the loads."""

    step: int
    """Number of the recording after which this holds."""
    sensor: Annotated[str, Shown("sensor")]
    """Name of the sensor."""
    load_case: Annotated[str, Shown("use")]
    """The use."""
    force_before_N: Annotated[float, Shown("force by the prior", "N", digits=2)]
    """Predicted force error of the prior matrix, typically."""
    force_after_N: Annotated[float, Shown("after", "N", digits=2)]
    """Predicted force error of a calibration from the recordings so far."""
    force_after_at_most_N: Annotated[float, Shown("at most", "N", digits=2)]
    """With 95 % it is no more than that."""
    force_allowed_N: Annotated[FloatOrNull, Shown("allowed", "N", digits=2)]
    """What is allowed; infinite where it is not evaluated."""
    moment_before_Nm: Annotated[float, Shown("moment by the prior", "N m", digits=3)]
    """Predicted moment error of the prior matrix."""
    moment_after_Nm: Annotated[float, Shown("after", "N m", digits=3)]
    """Predicted moment error of a calibration."""
    moment_after_at_most_Nm: Annotated[float, Shown("at most", "N m", digits=3)]
    """With 95 % it is no more than that."""
    moment_allowed_Nm: Annotated[FloatOrNull, Shown("allowed", "N m", digits=3)]
    """What is allowed; infinite where it is not evaluated."""

    @property
    def excess(self) -> float:
        """Error over what is allowed, the larger of force and moment."""
        return max(self.force_after_N / self.force_allowed_N, self.moment_after_Nm / self.moment_allowed_Nm)

    @property
    def excess_before(self) -> float:
        """The same by the prior matrix."""
        return max(self.force_before_N / self.force_allowed_N, self.moment_before_Nm / self.moment_allowed_Nm)


_PROVISIONAL = "planned"
"""What stands for version and date in calibrations that are compared and thrown away."""


class JointPlan(DrawnResult):
    """Recordings, the most useful first, and what every sensor is expected to err by after each."""

    drawn_by: ClassVar[str] = "forcetorque.planning.figures:joint_plan_figure"

    answered_by: ClassVar[str | None] = "forcetorque.planning.answers:joint_plan_answer"

    schema_name: Literal["forcetorque/plan_jointly/1"] = Field(default="forcetorque/plan_jointly/1", alias="schema")
    """Form of the result."""
    steps: tuple[JointPlanStep, ...]
    """What to record, in this order."""
    sensors: tuple[SensorForecast, ...]
    """Errors of every sensor at the loads of its uses, after every step."""
    advice: str
    """What to record, in a sentence."""
    warnings: tuple[str, ...] = ()
    """What even all of these recordings do not tell."""

    def blocks(self) -> Iterator[Table | str]:
        """Give what people read.

        Yields:
            Tables and sentences.
        """
        yield table_of(self.steps, "predicted errors over what is allowed, geometric mean over sensors and their uses")
        last = [row for row in self.sensors if row.step == len(self.steps)]
        yield table_of(last, "after all of these: predicted root mean square error at the loads of use")
        yield self.advice


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class _Outcome:
    """What a choice of recordings comes to."""

    added: str
    forecasts: tuple[SensorForecast, ...]
    joint: JointOutcome

    @property
    def excess(self) -> float:
        """Geometric mean of the errors over what is allowed: to halve any of them counts alike."""
        return float(np.exp(np.mean([np.log(row.excess) for row in self.forecasts])))

    @property
    def excess_before(self) -> float:
        """The same by the prior matrices."""
        return float(np.exp(np.mean([np.log(row.excess_before) for row in self.forecasts])))


@with_recording_notes
def plan_jointly(
    experiments: Sequence[Experiment],
    sensors: Sequence[str] | None = None,
    *,
    recordings: int = 3,
    progress: Callable[[str], None] = lambda _: None,
) -> JointPlan:
    """Order recordings by the information gained on all sensors of a robot at once.

    The information of a recording depends on its motion, and hardly on its measurements: recordings of another
    day, or simulated ones of motions that are to be recorded, stand for those to come.

    Args:
        experiments: Motions to choose from, of one robot with the same sensors; their calibration intervals count.
        sensors: Sensors to plan for, which have a prior matrix; all of the first file if None.
        recordings: How many to choose.
        progress: Called with what is being done.

    Returns:
        The recordings in order, until no other lowers the errors.

    Raises:
        ExperimentError: If the files do not belong together, or no sensor has a use.
        FitError: If no recording has an equation of every sensor that has a use.
    """
    data = JointData.of(experiments, sensors, progress)
    cases = {name: operating_load_cases(campaign.runs) for name, campaign in data.campaigns.items()}
    if not any(cases.values()):
        raise ExperimentError(
            "a plan needs loads of use: no distal link of any sensor has a mass; state a [[load_case]]"
        )
    chosen: list[_Outcome] = []
    while len(chosen) < min(recordings, len(data.recordings)):
        taken = [outcome.added for outcome in chosen]
        trials = []
        for name in data.recordings:
            if name not in taken:
                progress(f"recording {len(chosen) + 1}: what {name} adds")
                trials.append(_outcome(data, cases, [*taken, name], step=len(chosen) + 1))
        chosen.append(min(trials, key=lambda trial: (-len(trial.forecasts), trial.excess)))
    return JointPlan(
        steps=tuple(_step(number, chosen) for number in range(1, len(chosen) + 1)),
        sensors=tuple(row for outcome in chosen for row in outcome.forecasts),
        advice=_advice(chosen),
        warnings=tuple(chosen[-1].joint.doubts()),
    )


def _outcome(
    data: JointData, cases: Mapping[str, Sequence[LoadCase]], recordings: Sequence[str], *, step: int
) -> _Outcome:
    intervals = data.of_recordings(recordings)
    result = data.fit(intervals)
    calibrations = data.calibrations(intervals, result, code_version=_PROVISIONAL, created=_PROVISIONAL)
    forecasts = tuple(
        _forecast(step, name, calibration, case) for name, calibration in calibrations.items() for case in cases[name]
    )
    if not forecasts:
        raise FitError(f"{recordings[-1]}: no sensor with a use is beside an untouched part whose joints were logged")
    return _Outcome(added=recordings[-1], forecasts=forecasts, joint=JointOutcome.of(result, calibrations))


def _forecast(step: int, sensor: str, calibration: Calibration, case: LoadCase) -> SensorForecast:
    before, after = predict_prior(calibration, case), predict(calibration, case)
    if before is None:
        raise FitError(f"{sensor}: expected a prior matrix, which a joint calibration changes")
    force, moment = case.requirement
    return SensorForecast(
        step=step,
        sensor=sensor,
        load_case=case.name,
        force_before_N=before.force.typical,
        force_after_N=after.force.typical,
        force_after_at_most_N=after.force.at_most,
        force_allowed_N=force,
        moment_before_Nm=before.moment.typical,
        moment_after_Nm=after.moment.typical,
        moment_after_at_most_Nm=after.moment.at_most,
        moment_allowed_Nm=moment,
    )


def _step(number: int, chosen: Sequence[_Outcome]) -> JointPlanStep:
    outcome = chosen[number - 1]
    return JointPlanStep(
        step=number,
        recording=outcome.added,
        excess_before=outcome.excess_before if number == 1 else chosen[number - 2].excess,
        excess_after=outcome.excess,
        sensors=len({row.sensor for row in outcome.forecasts}),
    )


def _advice(chosen: Sequence[_Outcome]) -> str:
    excess = [chosen[0].excess_before, *(outcome.excess for outcome in chosen)]
    names, count = [outcome.added for outcome in chosen], useful_steps(excess)
    useful, rest = names[:count], names[count:]
    if not useful:
        return (
            "none of these recordings is expected to lower the errors; move more joints, or change what the feet bear"
        )
    words = (
        f"record {', then '.join(useful)}: errors over what is allowed are expected to fall from {excess[0]:.2f} to "
    )
    words += f"{excess[len(useful)]:.2f}"
    return words + (f"; {', '.join(rest)} would add less than {100 * HELPS:.0f} %" if rest else "")


def useful_steps(excess: Sequence[float]) -> int:
    """Number of recordings that help: one that helps little by itself may be needed by the next."""
    steps = [number for number in range(1, len(excess)) if excess[number] < (1.0 - HELPS) * excess[number - 1]]
    return steps[-1] if steps else 0
