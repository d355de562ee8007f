# SPDX-License-Identifier: BSD-3-Clause
"""A wrist sensor of a UR5 that swings tools of known mass, calibrated from the maker's matrix."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import DataSet, WindowMeans
from forcetorque.recording.recording import Interval, Support, Use
from forcetorque.robot.mechanics.estimate import Evaluator
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, sensor_samples
from forcetorque.robot.modified_robot import with_load
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import random_movement
from forcetorque.simulation.simulated_sensor import SimulatedSensor
from forcetorque.simulation.trace import Trace, trace_movement
from forcetorque.study.candidate_errors import pushes
from tests.calibration.push_error import LIMIT_COUNTS
from tests.scenes.robots import example_robot

SENSOR, JOINT, FLANGE, BASE = "wrist_ft", "ee_fixed_joint", "ee_link", "base_link"
PUSHES = pushes() / 5.0
"""Of 10 N."""
TOOL_KG = 1.7
CENTRES_M = ((0.0, 0.0, 0.06), (0.06, 0.0, 0.08), (0.0, 0.05, 0.1))
"""Centres of mass of three tools, not on a line."""
OFFSET = np.array([3.0, -2.0, 5.0, 0.1, 0.2, -0.1])
NEWTON_PER_COUNT = 0.005
DOWN = np.array([0.0, 0.0, -1.0])


@cache
def _swing(tool: int) -> tuple[Trace, FloatArray, FloatArray, FloatArray]:
    """A minute of a tool: its trace, which samples have a reference, that, and its flattening."""
    bare = read_urdf(example_robot("ur_description/urdf/ur5_robot.urdf"))
    model = with_load(
        bare.with_sensor(SENSOR, joint=JOINT, direction=MeasureDirection.CHILD_TO_PARENT),
        FLANGE,
        mass_kg=TOOL_KG,
        centre_of_mass_m=CENTRES_M[tool],
    )
    ranges = {name: (-1.5, 1.5) for name, joint in model.joints.items() if joint.type.moves}
    stand = Stand(model=model, support=BASE, gravity_direction=DOWN, ranges=ranges)
    movement = random_movement(stand, duration_s=60.0, slowest_hz=0.05, rng=np.random.default_rng(tool))
    trace = trace_movement(movement, [SENSOR], rate_hz=100.0, rng=np.random.default_rng(tool))
    still = SimulatedSensor(matrix=np.eye(6), offset=np.zeros(6), noise_counts=0.0)
    recording = trace.recorded({SENSOR: still}, rng=np.random.default_rng(0))
    start, end = recording.span_ns
    samples = sensor_samples(
        recording,
        model,
        sensor=SENSOR,
        stream=SENSOR,
        quantity="raw",
        interval=Interval(
            label="swing",
            start_ns=start + 10**9,
            end_ns=end - 10**9,
            use=Use.CALIBRATION,
            support=Support(frame=BASE, gravity_direction=DOWN),
        ),
        processing=Processing(),
        evaluator=Evaluator.COMPILED,
    )
    index = np.flatnonzero(np.isin(recording.stream(SENSOR).stamp_ns, samples.stamp_ns))
    return trace, index, samples.reference, samples.flattening


class Wrist:
    """A specimen that is 3 % off: every coefficient of the identity moves by 0.03, in N and N m."""

    def __init__(self, seed: int, *, length_m: float) -> None:
        """Draw a specimen.

        Args:
            seed: Of the specimen.
            length_m: Full scale of the moments over that of the forces.
        """
        self.prior = NEWTON_PER_COUNT * np.diag([1.0] * 3 + [length_m] * 3)
        self.truth = (np.eye(6) + 0.03 * np.random.default_rng([seed, 7]).normal(size=(6, 6))) @ self.prior
        self._seed = seed

    def fitted(self, tools: Sequence[int], *, accuracy: float) -> GenerativeFit:
        """Calibrate on a minute of each tool.

        Args:
            tools: Their numbers.
            accuracy: Of the reference, as a share of full scale.

        Returns:
            The fit.
        """
        limits = accuracy * LIMIT_COUNTS * np.diag(self.prior)
        assumed = Assumptions.of_counts(6, LIMIT_COUNTS, accuracy=limits)
        return fit_generative([self._means(tool) for tool in tools], self.prior, assumed)

    def push_error(self, matrix: FloatArray) -> FloatArray:
        """Mean error of a push of 10 N, force and moment; shape (2,); N, N m."""
        error = PUSHES @ (matrix @ np.linalg.inv(self.truth) - np.eye(6)).T
        return np.array([np.linalg.norm(error[:, part], axis=1).mean() for part in (slice(3), slice(3, 6))])

    def _means(self, tool: int) -> WindowMeans:
        trace, index, reference, flattening = _swing(tool)
        sensor = SimulatedSensor(matrix=self.truth, offset=OFFSET, noise_counts=5.0)
        stream = trace.recorded({SENSOR: sensor}, rng=np.random.default_rng([self._seed, tool])).stream(SENSOR)
        return WindowMeans.of(
            DataSet(
                label=f"tool {tool}",
                raw=stream.signal("raw").values[index],
                reference=reference,
                flattening=flattening,
                time_s=stream.stamp_ns[index] * 1e-9,
                session=f"tool {tool}",
                recording=f"tool {tool}",
            )
        )
