# SPDX-License-Identifier: BSD-3-Clause
"""Two public logs of wrist sensors, from download to the mass of the tool, as docs/recipes.md shows them."""

from __future__ import annotations

from pathlib import Path

import pytest

from forcetorque.analysis import SensorRun, weigh_load
from forcetorque.errors import RecordingError
from forcetorque.experiment import Experiment, load_experiment

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"

pytestmark = pytest.mark.real_data


def _load(text: str, data_dir: Path, tmp_path: Path) -> Experiment:
    copy = tmp_path / "experiment.toml"
    copy.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    return load_experiment(copy)


def test_three_clocks_of_a_wrist(data_dir: Path, tmp_path: Path) -> None:
    """Of the IMU's clock the shaking tells the delay; the mass is that of still poses but for what one turn misses."""
    text = (EXAMPLES / "25_wrist_clocks.toml").read_text()
    experiment = _load(text, data_dir, tmp_path)
    imu, orientation = experiment.recording.clocks
    assert imu.delay_half_width_s is not None
    assert (imu.delay_s, imu.delay_half_width_s) == (pytest.approx(0.0059, abs=5e-4), pytest.approx(0.00045, abs=1e-4))
    assert (orientation.delay_s, orientation.delay_half_width_s) == (0.0, None)
    assert [len(experiment.recording.stream(name)) for name in ("wrench", "imu", "orientation")] == [13126, 4778, 1880]
    load = weigh_load(SensorRun(experiment, experiment.sensors[0])).loads[0]
    assert load.mass_kg == pytest.approx(0.932, abs=0.04)


def test_one_slow_turn_does_not_tell_the_clock_of_the_arm(data_dir: Path, tmp_path: Path) -> None:
    """Negative control: of the first run alone it cannot be told, and is refused."""
    text = (EXAMPLES / "25_wrist_clocks.toml").read_text().replace("delay_s = 0.0", 'delay_s = "estimate"')
    text = text.replace('use = "validation"', 'use = "ignore"')
    with pytest.raises(RecordingError, match=r"clock\[1\]: .*does not tell the delay"):
        _load(text, data_dir, tmp_path)


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
    assert abs((weigh_load(SensorRun(experiment, experiment.sensors[0])).loads[0].mass_kg or 0.0) - 1.164) > 0.5
