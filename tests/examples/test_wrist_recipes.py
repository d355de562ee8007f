# SPDX-License-Identifier: BSD-3-Clause
"""Two public logs of wrist sensors, from download to the mass of the tool, as docs/recipes.md shows them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FitError, RecordingError
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.load_on_wrist_sensor import wrist_loads

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"

pytestmark = pytest.mark.real_data

AT_REST = """schema = "forcetorque/experiment/1"
name = "wrist sensor at rest"

[load]
frame = "wrist_ft"
motion = ["imu"]
measure_direction = "child_to_parent"

[recording]
format = "tabular"
path = "../../shared/data/ati_gamma_kuka_med14_skrede"

[[recording.stream]]
name = "wrench"
file = "0-steady-state_wrench.csv"
rate_hz = 698.0
start_s = 0.0

[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx", "fy", "fz", "tx", "ty", "tz"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "wrist_ft"

[[recording.stream]]
name = "imu"
file = "0-steady-state_accel.csv"
rate_hz = 254.0
start_s = 0.0

[[recording.stream.signal]]
quantity = "proper_acceleration"
columns = ["ax", "ay", "az"]
units = ["g", "g", "g"]
frame = "imu"

[[sensor]]
name = "wrist"
stream = "wrench"
serial = "ATI Gamma"
prior = "identity"

[[interval]]
label = "at rest"
start_s = 0.0
use = "validation"
"""
"""The two files without a time and without a pose."""


def _load(text: str, data_dir: Path, tmp_path: Path) -> Experiment:
    copy = tmp_path / "experiment.toml"
    copy.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    return load_experiment(copy)


@pytest.mark.long
def test_three_clocks_of_a_wrist(data_dir: Path, tmp_path: Path) -> None:
    """Of the IMU's clock the shaking tells the delay; the mass is that of still poses but for what one turn misses."""
    text = (EXAMPLES / "25_wrist_clocks.toml").read_text()
    experiment = _load(text, data_dir, tmp_path)
    imu, orientation = experiment.recording.clocks
    assert imu.delay_half_width_s is not None
    assert (imu.delay_s, imu.delay_half_width_s) == (pytest.approx(0.0059, abs=5e-4), pytest.approx(0.00028, abs=1e-4))
    assert (orientation.delay_s, orientation.delay_half_width_s) == (0.0, None)
    assert [len(experiment.recording.stream(name)) for name in ("wrench", "imu", "orientation")] == [13126, 4778, 1880]
    weighed = weigh_load(SensorRun(experiment, experiment.sensors[0]))
    assert weighed.loads[0].mass_kg == pytest.approx(0.932, abs=0.04)  # twice its interval away from still poses
    assert [row.name for row in weighed.hypotheses] == ["motion of the arm"]


@pytest.mark.long
def test_slow_turns_tell_the_clock_of_the_arm(data_dir: Path, tmp_path: Path) -> None:
    """Each of two runs alone agrees with the other within their intervals, and by the IMU as by the sensor."""
    text = (EXAMPLES / "25_wrist_clocks.toml").read_text().replace("delay_s = 0.0", 'delay_s = "estimate"')
    first, second = (_only(text, label) for label in ("baseline", "vibrations"))
    told = [_load(one, data_dir, tmp_path).recording.clocks[1] for one in (first, second)]
    (imu, _) = _load(second, data_dir, tmp_path).recording.clocks
    begin, end = second.index("[[clock]]"), second.index("[[sensor]]")
    by_imu = '[[clock]]\nstream = "orientation"\nto = "imu"\ndelay_s = "estimate"\n\n'
    (around,) = _load(second[:begin] + by_imu + second[end:], data_dir, tmp_path).recording.clocks
    pairs = [(told[0].delay_s, told[1].delay_s), (told[1].delay_s, imu.delay_s + around.delay_s)]
    allowed = [sum(one.delay_half_width_s or np.inf for one in ends) for ends in (told, (told[1], around))]
    assert max(allowed) < 0.03
    assert all(abs(one - other) < most for (one, other), most in zip(pairs, allowed, strict=True))


def test_a_run_that_touches_something_tells_no_clock(data_dir: Path, tmp_path: Path) -> None:
    """Negative control: the orientation does not show what pushes."""
    text = _only((EXAMPLES / "25_wrist_clocks.toml").read_text(), "contact")
    stated = text.replace('delay_s = "estimate"', "delay_s = 0.006").replace(
        "delay_s = 0.0\n", 'delay_s = "estimate"\n'
    )
    with pytest.raises(RecordingError, match=r"clock\[1\]: .*the delay is not identifiable"):
        _load(stated, data_dir, tmp_path)


def _only(text: str, label: str) -> str:
    """The experiment with one interval that is used."""
    head, *intervals = text.split("[[interval]]")
    used = (
        one.replace('use = "ignore"', 'use = "validation"')
        if f'label = "{label}"' in one
        else re.sub(r'use = "\w+"', 'use = "ignore"', one)
        for one in intervals
    )
    return "[[interval]]".join([head, *used])


@pytest.mark.long
def test_a_wrench_of_the_base_frame(data_dir: Path, tmp_path: Path) -> None:
    """Turned into the sensor, another series of poses agrees; along the axes as they are logged it does not."""
    text = (EXAMPLES / "26_wrist_base_frame.toml").read_text()
    experiment = _load(text, data_dir, tmp_path)
    weighed = weigh_load(SensorRun(experiment, experiment.sensors[0]))
    assert weighed.loads[0].mass_kg == pytest.approx(1.164, abs=0.005)
    start, end = text.index("[[transform]]"), text.index("[[sensor]]")
    begin = text.rindex("# turned", 0, start)
    untold = (text[:begin] + text[end:]).replace('frame = "base"', 'frame = "wrist_ft"')
    experiment = _load(untold, data_dir, tmp_path)
    with pytest.raises(FitError, match="expected a mass above 0 kg.*the wrench is along the axes of the world"):
        weigh_load(SensorRun(experiment, experiment.sensors[0]))


def test_a_second_at_rest_is_read_without_time_or_pose(data_dir: Path, tmp_path: Path) -> None:
    """Its force less the bias weighs what the poses say, about the same point; with the bias of no load it does not."""
    still = _load(AT_REST, data_dir, tmp_path).recording
    assert [len(still.stream(name)) for name in ("wrench", "imu")] == [698, 256]
    reading = still.stream("wrench").signal("wrench").values.mean(axis=0)
    experiment = _load((EXAMPLES / "07_wrist_payload.toml").read_text(), data_dir, tmp_path)
    loads = wrist_loads(experiment)
    assert loads is not None
    solution = loads.solution(experiment)
    (load,), (session,) = solution.loads, solution.sessions
    wrench = reading - session.bias
    gravity = 9.82085
    assert np.linalg.norm(wrench[:3]) == pytest.approx(gravity * load.mass, abs=0.1)
    np.testing.assert_allclose(wrench[3:], np.cross(load.centre_of_mass, wrench[:3]), atol=0.01)
    assert abs(np.linalg.norm(reading[:3]) - gravity * load.mass) > 5.0
