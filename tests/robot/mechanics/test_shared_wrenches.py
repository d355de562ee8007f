# SPDX-License-Identifier: BSD-3-Clause
"""Expected wrenches of sensors with the same instants are computed at once, and are those of each by itself."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.recording.recording import Interval, Recording, Support, Use
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, SensorSamples, sensor_samples
from forcetorque.robot.mechanics.shared_wrenches import SharedWrenches
from forcetorque.robot.model import RobotModel
from forcetorque.robot.urdf import read_urdf
from tests.recording.recordings import recording, signal, stream
from tests.scenes.robots import icub

STREAMS = {"l_leg_ft": "left", "r_leg_ft": "right", "l_arm_ft": "arm"}
STAMPS = np.arange(100) * 10_000_000
ROUNDING = 1e-12
"""Share of the largest wrench: sums of the same bodies in another order."""


@cache
def _robot() -> RobotModel:
    return read_urdf(icub("iCubGazeboV2_7"))


def _recording(*without: str, late_ns: int = 0) -> Recording:
    """Joints, but for some, and three sensors, of which the last has stamps of its own."""
    names = tuple(name for name, joint in _robot().joints.items() if joint.type.moves and name not in without)
    rates = np.random.default_rng(2).uniform(1.0, 9.0, len(names))
    joints = stream(STAMPS, signal("position", 0.3 * np.sin(1e-9 * np.outer(STAMPS, rates)), names), name="joints")
    readings = signal("wrench", np.ones((len(STAMPS), 6)))
    stamps = {"left": STAMPS, "right": STAMPS, "arm": STAMPS + late_ns}
    return recording(joints, *(stream(own, readings, name=name) for name, own in stamps.items()))


def _samples(log: Recording, sensor: str, shared: SharedWrenches | None) -> SensorSamples:
    start, end = log.span_ns
    support = Support(frame="root_link", gravity_direction=np.array([0.0, 0.6, -0.8]))
    interval = Interval(label="all", start_ns=start, end_ns=end, use=Use.CALIBRATION, support=support)
    return sensor_samples(
        log,
        _robot(),
        sensor=sensor,
        stream=STREAMS[sensor],
        quantity="wrench",
        interval=interval,
        processing=Processing(),
        shared=shared,
    )


@pytest.mark.parametrize(("without", "late_ns"), [((), 0), ((), 5_000_000), (("r_knee",), 0)])
def test_samples_are_those_of_each_sensor_alone(without: tuple[str, ...], late_ns: int) -> None:
    """Also where stamps differ, and where a joint is missing that only one of them needs."""
    log = _recording(*without, late_ns=late_ns)
    shared = SharedWrenches(log, STREAMS)
    for sensor in STREAMS:
        if sensor == "r_leg_ft" and without:
            with pytest.raises(ValueError, match="no stream holds the position of joint 'r_knee'"):
                _samples(log, sensor, shared)
            continue
        own, alone = _samples(log, sensor, shared), _samples(log, sensor, None)
        size = np.abs(alone.reference).max()
        assert size > 1.0
        np.testing.assert_allclose(own.reference, alone.reference, atol=ROUNDING * size)
        np.testing.assert_allclose(own.flattening, alone.flattening, atol=ROUNDING * size)


def test_every_wrench_is_computed_once_and_let_go() -> None:
    """For the sensors with the same stamps at once; a sensor that asks again is computed alone."""
    log, computed = _recording(late_ns=1), []

    def compute(names: Sequence[str]) -> dict[str, FloatArray]:
        computed.append(tuple(names))
        return {name: np.full((len(STAMPS), 6), float(len(name))) for name in names}

    shared = SharedWrenches(log, STREAMS)
    for sensor in ("right", "left", "right"):
        name = next(key for key, value in STREAMS.items() if value == sensor)
        assert shared.of(name, "key", STAMPS, compute)[0, 0] == len(name)
    assert shared.of("r_leg_ft", "other key", STAMPS, compute).shape == (len(STAMPS), 6)
    assert shared.of("l_leg_ft", "key", STAMPS[:5], compute).shape == (len(STAMPS), 6)
    assert computed == [
        ("r_leg_ft", "l_leg_ft"),
        ("r_leg_ft",),
        ("r_leg_ft", "l_leg_ft"),
        ("l_leg_ft", "r_leg_ft"),
    ]
