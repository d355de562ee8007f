# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a foot sensor that was calibrated while the foot was free, for the day when the robot stands on it."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.load_cases.load_case import LoadCase, operating_load_cases
from forcetorque.evaluation.load_cases.predicted_error import predict, predict_prior
from forcetorque.evaluation.load_cases.verdict import use_verdicts
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from tests.examples.test_yoga_generative import EXAMPLES

pytestmark = pytest.mark.real_data

MEASURED_N = {"fitted": 49.3, "prior": 37.0}
"""Force error where the robot stands on it, as `test_yoga_generative` has it from the log with the other foot."""
FREE = """[[support]]
frame = "l_sole"
gravity_direction = [0.0, 0.0, -1.0]

[[interval]]
label = "free"
start_s = 25.0
end_s = 56.0
use = "calibration"
support = "l_sole"
"""


@pytest.fixture(scope="module")
def run(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> SensorRun:
    """The right foot while it is free."""
    text = (EXAMPLES / "08_icub_yoga_contacts.toml").read_text(encoding="utf-8")
    file = tmp_path_factory.mktemp("foot") / "free.toml"
    head = text[: text.index("[[support]]")].replace("../../shared/data", data_dir.as_posix())
    file.write_text(head + FREE, encoding="utf-8")
    return SensorRun(load_experiment(file), "r_foot_ft_sensor")


def test_a_foot_that_was_free_is_not_to_be_stood_upon(run: SensorRun) -> None:
    """Without a stated use it is asked for the weight of the robot: not enough data; the 99 % interval holds the truth.

    The error is predicted as 28 to 84 N with 95 %, that of the prior as 29 to 81 N.
    """
    calibration = calibrate_sensor(run, code_version="test", created="2026-01-01T00:00:00+00:00")
    (case,) = operating_load_cases([run])
    assert case.words.startswith("the weight of the robot, 324 N, on r_sole")
    (verdict,) = use_verdicts(run, {"new": calibration})
    assert verdict.decision == "not enough data"
    assert verdict.within == 0.0
    after, before = predict(calibration, case), predict_prior(calibration, case)
    assert before is not None
    for error, measured in ((after, MEASURED_N["fitted"]), (before, MEASURED_N["prior"])):
        low, high = np.quantile(error.force.draws, [0.005, 0.995])
        assert low < measured < high
    # negative control: a small push is another matter
    push = LoadCase(name="push", words="", wrench=case.wrench / 100.0)
    assert predict(calibration, push).force.at_most < 0.2 * after.force.at_most
