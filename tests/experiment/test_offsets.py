# SPDX-License-Identifier: BSD-3-Clause
"""Offsets by every way are what mechanics demands less what is read, and their intervals hold the truth."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, ShapeError
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of, offset_policies, sensor_offset, still_seconds, with_policy
from forcetorque.experiment.sensor_reading import Correction
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.experiment.validation_offset import Offset, OffsetEstimate, OffsetPolicy, mean_offset
from forcetorque.payload.tare_offset import tare
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import build_scenario, simulate
from tests.scenes.switchings import short_switching

BIAS_N = 1e-6
"""Rounding of counts that stand for 500 N."""
DRAWS = 100


@pytest.fixture(scope="module")
def foot(tmp_path_factory: pytest.TempPathFactory) -> tuple[Experiment, Correction, FloatArray]:
    """A foot without noise, the correction by its true matrix, and its true offset, to be added."""
    folder = tmp_path_factory.mktemp("foot") / "out"
    content = short_switching(names=("r_foot_ft",)).exact()
    (entry, _) = content.recording
    motion = entry.motion.model_copy(update={"still_s": 2.0})
    scenario = build_scenario(content.model_copy(update={"recording": (entry.model_copy(update={"motion": motion}),)}))
    write_scenario(scenario, folder)
    (simulated,) = simulate(scenario)
    sensor = simulated.sensors["r_foot_ft"]
    experiment = load_experiment(folder / "switching_day1.toml")
    bare = Correction.without_offset(experiment.sensor("r_foot_ft"))
    model = type(bare.model)(matrix=sensor.matrix, offset=np.zeros(6))
    return experiment, Correction(model=model, source="truth", matrix_source="truth"), sensor.offset


@pytest.mark.parametrize(
    "words",
    [
        "one-link-imu:hanging",
        "one-link-imu:l_sole",
        "one-link-fixed-frame:l_sole",
        "one-link-imu:r_sole",
        "one-link-fixed-frame:r_sole",
        "tare:hanging",
    ],
)
def test_every_way_finds_the_planted_offset(foot: tuple[Experiment, Correction, FloatArray], words: str) -> None:
    """By the true matrix, whether the foot hangs, is in the air or bears the robot."""
    experiment, correction, offset = foot
    run = SensorRun(experiment, experiment.sensor("r_foot_ft"))
    estimate = sensor_offset(run, correction, OffsetPolicy.of(words)).estimate
    np.testing.assert_allclose(estimate.value, offset, rtol=0, atol=BIAS_N)
    assert estimate.half_width.max() < BIAS_N
    # negative control: by the prior it is another one where the foot bears the robot
    prior = Correction.without_offset(run.sensor)
    other = sensor_offset(run, prior, OffsetPolicy.of("one-link-imu:r_sole")).estimate.value
    assert np.abs(other - offset).max() > 1.0


def test_a_tare_is_the_offset_of_its_way(foot: tuple[Experiment, Correction, FloatArray]) -> None:
    """`tare` says the same as `--offset tare:LABEL`."""
    experiment, _, _ = foot
    run = SensorRun(experiment, experiment.sensor("r_foot_ft"))
    (row,) = tare(run, "hanging").sensors
    correction = corrections_of(experiment, {}, offset="tare:hanging")["r_foot_ft"]
    np.testing.assert_array_equal(row.offset, correction.model.offset)
    assert correction.source.endswith("offset tare:hanging")
    assert correction.removes_offset


@pytest.mark.parametrize("way", ["first-second", "judged-mean"])
def test_ways_of_every_interval_give_each_its_own(foot: tuple[Experiment, Correction, FloatArray], way: str) -> None:
    """The planted offset again, for each interval; refused on two feet, as nobody knows what a foot must read."""
    experiment, correction, offset = foot
    policy = OffsetPolicy.of(way)
    with pytest.raises(ExperimentError, match="interval 'double_1'.* nobody knows what the sensor must read"):
        with_policy(SensorRun(experiment, experiment.sensor("r_foot_ft")), correction, policy)
    known = tuple(one for one in experiment.recording.intervals if one.label in {"hanging", "r_sole"})
    alone = replace(experiment, recording=replace(experiment.recording, intervals=known))
    read, offsets = with_policy(SensorRun(alone, alone.sensor("r_foot_ft")), correction, policy)
    assert [one.interval.label for one in offsets] == list(read.intervals) == ["hanging", "r_sole"]
    for one in offsets:
        np.testing.assert_allclose(read.over(alone, one.interval.label).model.offset, offset, rtol=0, atol=BIAS_N)


def test_policies_are_typed_as_shown() -> None:
    """Each once, in their order, as the words that made them."""
    words = ["one-link-imu:a b", "none", "none", "tare:x:y"]
    assert [str(policy) for policy in offset_policies(words)] == ["one-link-imu:a b", "none", "tare:x:y"]
    assert OffsetPolicy.of("tare:x:y").interval == "x:y"
    assert OffsetPolicy.of("fitted") == OffsetPolicy(Offset.FITTED)
    with pytest.raises(ExperimentError, match=r"no way is called 'imu'"):
        offset_policies(["imu:hanging"])


def test_an_offset_needs_samples() -> None:
    """None give none; a sample with a gap is left out."""
    with pytest.raises(ShapeError, match="at least one sample"):
        OffsetEstimate.of(np.empty((0, 6)), np.empty(0))
    gap = np.array([[1.0, 2.0], [np.nan, 9.0], [3.0, 4.0]])
    np.testing.assert_array_equal(mean_offset(gap), [2.0, 3.0])


@pytest.mark.long
def test_the_interval_of_an_offset_holds_it() -> None:
    """In noise that is white and slow: 95 % intervals hold the truth in 92 to 98 %; of white noise alone too few."""
    rng, inside, naive = np.random.default_rng(5), 0, 0
    seconds = np.arange(400) * 0.01
    keep = np.exp(-0.01 / 0.1)  # forgets itself in 0.1 s
    for _ in range(DRAWS):
        slow = np.zeros((len(seconds), 6))
        slow[0] = rng.normal(size=6)
        for k in range(1, len(seconds)):
            slow[k] = keep * slow[k - 1] + np.sqrt(1.0 - keep**2) * rng.normal(size=6)
        samples = 3.0 + slow + rng.normal(0.0, 0.5, slow.shape)
        estimate = OffsetEstimate.of(samples, seconds)
        inside += int((np.abs(estimate.value - 3.0) < estimate.half_width).sum())
        naive += int((np.abs(estimate.value - 3.0) < 1.96 * samples.std(axis=0) / np.sqrt(len(samples))).sum())
    count = 6 * (DRAWS)
    assert 0.91 < inside / count < 0.985
    assert naive / count < 0.8  # negative control


def test_still_seconds_need_not_begin_at_the_interval(foot: tuple[Experiment, Correction, FloatArray]) -> None:
    """The robot rests 2 s at both ends of a phase, which seconds from its start alone would partly miss."""
    experiment, _, _ = foot
    interval = next(one for one in experiment.recording.intervals if one.label == "hanging")
    still = still_seconds(experiment.recording, interval)
    starts = (still.start_ns - interval.start_ns) * 1e-9
    assert starts.min() < 0.5
    assert starts.max() > (interval.end_ns - interval.start_ns) * 1e-9 - 1.3
    assert still.hold(still.start_ns).all()
    assert not still.hold(np.array([interval.start_ns - 1, interval.end_ns])).any()
