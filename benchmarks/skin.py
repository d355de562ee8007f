# SPDX-License-Identifier: BSD-3-Clause
"""A frame of skin from counts to wrenches of contacts, against interpolating the field anew in every frame.

And on to the joint torques of a whole robot, beside what the estimator takes by itself.
"""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable

import icub_models
import numpy as np

from benchmarks.harness import arguments, interleaved, median_ratio, write_result
from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.estimation.skin_contacts import SkinSource, skin_sources
from forcetorque.estimation.uncertain.estimate_with_covariance import UncertainEstimates, estimate_with_covariance
from forcetorque.estimation.uncertain.input_errors import Uncertainty
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.mechanics.estimate import Evaluator, estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, TorqueSum, moving_joints
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.skin.contact.contact_clusters import SkinContacts, find_contacts
from forcetorque.skin.contact.pressure_frame import PatchReader
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PressureTable
from forcetorque.skin.wrench.patch_sensor import SkinPatch
from forcetorque.skin.wrench.pressure_to_wrench import DISC_POINTS, DISC_RADIUS_M

PITCH_M = 6.6e-3
FEW, MANY = 380, 4000
"""Taxels of a lower leg, and of a whole robot."""
GRID_M = 1e-3
"""Grid on which the thesis interpolates."""
CONTACTS = 4
ROBOT, LINK, ANGLE_RAD = "iCubGazeboV2_7", "r_lower_leg", 0.1
REPEATS = 20
"""Calls that are timed together: one takes microseconds."""


def main() -> None:
    """Time both, and write ratios, microseconds and how far both agree."""
    options = arguments(__doc__ or "")
    rounds = 3 if options.quick else 30
    few, many = _Skin(FEW), _Skin(MANY)
    operator = few.patch.operator()
    robot = _Robot(few)
    tasks: dict[str, Callable[[], object]] = {
        "product, 380 taxels": lambda: _repeated(lambda: operator.wrench(few.pressures)),
        "frame, 380 taxels": lambda: _repeated(few.frame),
        "frame, 4000 taxels": lambda: _repeated(many.frame),
        "frame to joint torques": lambda: _repeated(robot.torques),
        "frame to joint torques with covariance": lambda: _repeated(robot.torques_with_covariance),
        "estimator alone": lambda: _repeated(robot.estimator_alone),
        "estimator alone with covariance": lambda: _repeated(robot.alone_with_covariance),
        "interpolated anew, 380 taxels": few.interpolated,
    }
    seconds = interleaved(tasks, rounds=rounds)
    for name in list(tasks)[:-1]:
        seconds[name] = [value / REPEATS for value in seconds[name]]
    build = few.build_seconds()
    peer = seconds["interpolated anew, 380 taxels"]
    whole = float(few.patch.operator().normal_force(few.pressures))
    write_result(
        options.json,
        ratios={
            "frame to interpolating anew, 380 taxels": median_ratio(seconds["frame, 380 taxels"], peer),
            "product to interpolating anew, 380 taxels": median_ratio(seconds["product, 380 taxels"], peer),
            "frame to joint torques to estimator alone": median_ratio(
                seconds["frame to joint torques"], seconds["estimator alone"]
            ),
            "the same with covariance": median_ratio(
                seconds["frame to joint torques with covariance"], seconds["estimator alone with covariance"]
            ),
        },
        seconds=seconds,
        accuracy={
            "force over interpolated force": whole / few.interpolated(),
            "contacts": len(many.frame().wrench),
            "torques, largest difference between both ways, N m": robot.difference(),
        },
        rounds=rounds,
        packages=("numpy", "scipy", "icub-models"),
        figures={
            **{f"{name}_us": 1e6 * statistics.median(values) for name, values in seconds.items()},
            "build_380_taxels_s": build,
            "times_faster_than_interpolating": statistics.median(peer)
            / statistics.median(seconds["frame, 380 taxels"]),
        },
    )


class _Skin:
    """A patch on a half pipe with some contacts, its table, and one message."""

    def __init__(self, number: int) -> None:
        rng = np.random.default_rng(1)
        self.layout, self.flat = _half_pipe(number)
        self.patch = SkinPatch.of(self.layout)
        fall = np.arange(256.0)[:, None] * rng.uniform(900.0, 1200.0, number)
        table = PressureTable(
            patch="pipe",
            columns=number,
            taxels=np.arange(number),
            live=np.ones(number, dtype=bool),
            values=fall,
            range_counts=np.full(number, 50.0),
            error=np.full(number, 200.0),
            hysteresis=np.full(number, 1500.0),
        )
        rest = 240.0 + np.rint(rng.normal(0.0, 0.65, (50, number)))
        self.reader = PatchReader.at_rest(table, rest)
        self.counts = np.rint(self.reader.rest - self._falls(rng))
        self.pressures = table.pressures(self.counts, self.reader.rest)
        angle = 2.0 * np.pi * np.arange(DISC_POINTS) / DISC_POINTS
        outline = DISC_RADIUS_M * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        self._discs = (self.flat[:, None] + outline).reshape(-1, 2)
        low, high = self.flat.min(axis=0), self.flat.max(axis=0)
        self._grid = tuple(np.meshgrid(*(np.arange(a, b, GRID_M) for a, b in zip(low, high, strict=True))))
        self.frame()

    def frame(self) -> SkinContacts:
        """Table, active taxels, ring, contacts and their wrenches."""
        return find_contacts(self.patch, self.reader.frame(self.counts))

    def interpolated(self) -> float:
        """Pressure between discs on a grid of 1 mm, as the thesis has it by `griddata` in every frame, and its sum."""
        from scipy.interpolate import griddata

        pressures = np.repeat(self.pressures, DISC_POINTS)
        field = griddata(self._discs, pressures, self._grid, method="linear", fill_value=0.0)
        return float(field.sum() * GRID_M**2)

    def build_seconds(self) -> float:
        """Surface and operators from nothing, the median of some."""
        taken = []
        for _ in range(5):
            start = time.perf_counter()
            patch = SkinPatch.of(self.layout)
            operator = patch.operator()
            patch.predicted_pressures(operator.live)
            taken.append(time.perf_counter() - start)
        return statistics.median(taken)

    def _falls(self, rng: np.random.Generator) -> FloatArray:
        falls = np.zeros(len(self.layout))
        for centre in rng.choice(len(self.layout), CONTACTS, replace=False):
            distance = np.linalg.norm(self.layout.positions - self.layout.positions[centre], axis=1)
            falls += 20.0 * np.exp(-0.5 * (distance / 0.012) ** 2)
        return falls


class _Robot:
    """An iCub at rest whose lower leg has the skin: no force-torque sensor, torques of all joints."""

    def __init__(self, skin: _Skin) -> None:
        self._skin = skin
        tree = build_tree(read_urdf(icub_models.get_model_file(ROBOT)), "root_link")
        joints = moving_joints(tree)
        self._motion = (
            JointMotion.at_rest(joints, np.full((1, len(joints)), ANGLE_RAD)),
            RootMotion.fixed([0.0, 0.0, -1.0]),
        )
        self._question = Question(
            tree=tree,
            contacts=(Contact(link="root_link"), *(source.contact for source in self._sources())),
            torques=joints,
            torque_sum=TorqueSum.SUB_MODEL,
        )
        self._felt = self._sources()

    def torques(self) -> Estimates:
        """From counts to the torques of all joints."""
        return self._estimated(self._sources())

    def torques_with_covariance(self) -> UncertainEstimates:
        """The same, and how far they may be off."""
        return self._uncertain(self._sources())

    def estimator_alone(self) -> Estimates:
        """From contacts that are known already."""
        return self._estimated(self._felt)

    def alone_with_covariance(self) -> UncertainEstimates:
        """The same with covariance."""
        return self._uncertain(self._felt)

    def difference(self) -> float:
        """By how much both ways differ; N m."""
        return float(np.abs(self.torques().torques - self.torques_with_covariance().torques).max())

    def _sources(self) -> tuple[SkinSource, ...]:
        return skin_sources("pipe", LINK, [self._skin.frame()], np.zeros(1, dtype=np.int64), friction=0.3)

    def _estimated(self, sources: tuple[SkinSource, ...]) -> Estimates:
        known = Wrenches.of({source.contact.name: source.wrench for source in sources})
        return estimate(self._question, *self._motion, known=known, evaluator=Evaluator.COMPILED, threads=1)

    def _uncertain(self, sources: tuple[SkinSource, ...]) -> UncertainEstimates:
        known = Wrenches.of({source.contact.name: source.wrench for source in sources})
        uncertainty = Uncertainty(
            known={source.contact.name: source.covariance for source in sources},
            tangents={source.contact.name: source.tangents for source in sources if source.tangents is not None},
        )
        return estimate_with_covariance(self._question, *self._motion, known=known, uncertainty=uncertainty)


def _repeated(task: Callable[[], object]) -> None:
    for _ in range(REPEATS):
        task()


def _half_pipe(number: int) -> tuple[SkinLayout, FloatArray]:
    """A triangular lattice on half a cylinder, and the same in a plane."""
    columns = int(np.sqrt(number))
    row, column = np.divmod(np.arange(number), columns)
    flat = PITCH_M * np.stack([column + 0.5 * (row % 2), np.sqrt(0.75) * row], axis=1)
    radius = PITCH_M * columns / np.pi
    angle = flat[:, 0] / radius
    normals = np.stack([np.cos(angle), np.sin(angle), np.zeros(number)], axis=1)
    positions = radius * normals + np.outer(flat[:, 1], [0.0, 0.0, 1.0])
    none: IntArray = np.zeros(0, dtype=np.int64)
    layout = SkinLayout(
        name="pipe",
        frame="link",
        columns=number,
        taxels=np.arange(number),
        modules=np.arange(number) // 10,
        positions=positions,
        normals=normals,
        thermal_pads=none,
        thermal_modules=none,
    )
    return layout, flat


if __name__ == "__main__":
    main()
