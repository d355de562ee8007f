# SPDX-License-Identifier: BSD-3-Clause
"""An error of a reading is borne by the joints between two contacts, by the transposed Jacobian, and by no other."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import RobotError, ShapeError
from forcetorque.base.noise.window_means import mean_error
from forcetorque.base.wrench import MeasureDirection
from forcetorque.evaluation.validation.joint_torque_errors import TorqueMap, joints_of_sensor, torque_errors, torque_map
from forcetorque.robot.contacts import Contact, Wrenches
from forcetorque.robot.dynamics import body_pose
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question, moving_joints
from forcetorque.robot.model import RobotModel, SensorFrame
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import sub_models
from forcetorque.robot.tree import BodyTree, build_tree
from tests.cases import some_cases
from tests.robot.mechanics.idyntree_oracle import IDynTree
from tests.robot.mechanics.random_robots import robots
from tests.robot.mechanics.simulated import Simulation, random_root
from tests.robot.mechanics.touched import humanoid
from tests.scenes.robots import icub, joint_xml, link_xml, read_text, robot_xml, sensor_xml

ROUNDING = 1e-12
"""Of the largest wrench: some 40 bodies of some 50 roundings each at eps = 2e-16 are 4e-13."""

EXACT = 1e-10
"""N m: torques of some 100 N m, sums over some 40 bodies, 1e-13 each by rounding, and a margin of ten."""

VISIBLE = 0.1
"""N m: what a negative control must exceed."""

SAMPLES = 5

CASES: dict[str, tuple[str, str, str | None, str, str, set[str]]] = {
    # seen from, sensor, contact; links that bear the contacts beyond and before the sensor; joints, or some of them
    "leg_of_a_robot_on_its_foot": ("l_sole", "r_leg_ft", None, "r_hip_3", "l_hip_2", {"r_hip_pitch", "l_hip_roll"}),
    "the_leg_that_stands": ("l_sole", "l_leg_ft", None, "l_hip_2", "l_ankle_2", {"l_knee", "l_hip_yaw"}),
    "its_foot": ("l_sole", "l_foot_ft", None, "l_ankle_2", "l_sole", set()),
    "arm": ("root_link", "r_arm_ft", None, "r_upper_arm", "root_link", {"torso_yaw", "r_shoulder_yaw"}),
    "arm_by_its_hand": ("root_link", "r_arm_ft", "r_hand", "r_hand", "root_link", {"torso_yaw", "r_elbow"}),
    "leg_by_the_torso": ("l_sole", "r_leg_ft", "chest", "r_hip_3", "chest", {"r_hip_roll", "torso_roll"}),
}


def _contacts(tree: BodyTree, cut_at: tuple[str, ...], moved: str | None) -> tuple[Contact, ...]:
    """A full wrench at the base of every sub-model, one of them on another link."""
    contacts = []
    for part in sub_models(tree, cut_at):
        here = moved is not None and tree.frames[moved][0] in part.bodies
        link = moved if here and moved is not None else tree.bodies[part.base].links[0]
        contacts.append(Contact(link=link, name=part.name))
    return tuple(contacts)


class _Robot:
    """A robot that errs at one sensor, and what it then estimates."""

    def __init__(
        self, tree: BodyTree, joints: JointMotion, root: RootMotion, sensor: str, contact: str | None, seed: int = 1
    ) -> None:
        self.tree, self.joints, self.root, self.sensor = tree, joints, root, sensor
        self.cut_at = tuple(tree.cuts)
        self.contacts = _contacts(tree, self.cut_at, contact)
        self.map = torque_map(tree, joints, sensor, cut_at=self.cut_at, contact=contact)
        self.error = np.random.default_rng(seed).normal(scale=5.0, size=(len(joints), 6))
        model = estimate(
            Question(tree=tree, expected=self.cut_at, torques=moving_joints(tree), equations=()), joints, root
        )
        self.model = {joint: model.torque(joint) for joint in model.layout.joints}
        self.expected = {name: model.expected_of(name) for name in self.cut_at}

    def estimated(self, error: FloatArray) -> Estimates:
        """What the scheme makes of the expected readings, with an error of the one."""
        readings = self.expected | {self.sensor: self.expected[self.sensor] + error}
        question = Question(
            tree=self.tree, measured=self.cut_at, contacts=self.contacts, torques=tuple(self.model), equations=()
        )
        return estimate(question, self.joints, self.root, measured=Wrenches.of(readings))

    def scale(self) -> float:
        """Largest wrench or torque that has to be added up; N, N m."""
        return float(max(5.0, *(np.abs(v).max() for v in (*self.expected.values(), *self.model.values()))))


def _named(map_of: TorqueMap, error: FloatArray) -> dict[str, FloatArray]:
    return dict(zip(map_of.joints, map_of.torques(error).T, strict=True))


def _case(name: str) -> tuple[RobotModel, _Robot]:
    root_link, sensor, contact, *_ = CASES[name]
    model, tree, joints, root = humanoid(root_link, SAMPLES)
    return model, _Robot(tree, joints, root, sensor, contact)


def _sensor_axes(model: RobotModel, sensor: str) -> FloatArray:
    """Pose of the reading's frame in the child link."""
    tag = model.sensors[sensor]
    inverse: FloatArray = np.linalg.inv(model.joints[tag.joint].parent_H_child)
    return {SensorFrame.CHILD: np.eye(4), SensorFrame.PARENT: inverse, SensorFrame.SENSOR: tag.child_H_sensor}[
        tag.frame
    ]


def _inboard_on_outboard(model: RobotModel, robot: _Robot) -> float:
    """1 where the sensor measures what the side of the root does to the other, else -1."""
    tag = model.sensors[robot.sensor]
    far_side = Simulation(model, robot.tree.root_link, robot.joints, robot.root).far_side[tag.joint]
    child_is_far = model.joints[tag.joint].child in far_side
    return 1.0 if child_is_far == (tag.direction is MeasureDirection.PARENT_TO_CHILD) else -1.0


@some_cases("name", CASES, quick=2)
def test_torque_is_the_transposed_jacobian_of_pinocchio(name: str) -> None:
    """Virtual work: the contact beyond the sensor gives -w and that before it w, so the joints bear (J - J')^T w.

    J and J' are Pinocchio's Jacobians of the two touched links, at the sensor's origin, of a robot whose
    base floats: the columns of the base cancel. Negative control: the other sign.
    """
    pin = pytest.importorskip("pinocchio")
    _, _, _, beyond, before, some = CASES[name]
    model, robot = _case(name)
    oracle = pin.buildModelFromUrdf(str(icub("iCubGazeboV2_7")), pin.JointModelFreeFlyer())
    data, found = oracle.createData(), _named(robot.map, robot.error)
    assert some <= set(found)
    compared = 0
    for k in range(SAMPLES):
        q = pin.neutral(oracle)
        for joint, value in zip(robot.joints.names, robot.joints.position[k], strict=True):
            q[oracle.joints[oracle.getJointId(joint)].idx_q] = value
        pin.computeJointJacobians(oracle, data, q)
        pin.updateFramePlacements(oracle, data)
        child = data.oMf[oracle.getFrameId(model.joints[model.sensors[robot.sensor].joint].child)].homogeneous
        world_H_sensor = child @ _sensor_axes(model, robot.sensor)
        jacobians = []
        for link in (beyond, before):
            frame = oracle.getFrameId(link)
            jacobian = pin.getFrameJacobian(oracle, data, frame, pin.LOCAL_WORLD_ALIGNED)
            lever = world_H_sensor[:3, 3] - data.oMf[frame].translation
            linear = jacobian[:3] + np.cross(jacobian[3:], lever, axisa=0, axisc=0)
            turned = world_H_sensor[:3, :3].T
            jacobians.append(np.vstack([turned @ linear, turned @ jacobian[3:]]))
        borne = (jacobians[0] - jacobians[1]).T @ (_inboard_on_outboard(model, robot) * robot.error[k])
        np.testing.assert_allclose(borne[:6], 0.0, atol=EXACT)  # nothing but joints bears it
        for joint in robot.model:
            wanted = borne[oracle.joints[oracle.getJointId(joint)].idx_v]
            assert found.get(joint, np.zeros(SAMPLES))[k] == pytest.approx(wanted, abs=EXACT)
            compared += abs(wanted) > VISIBLE
        if found:
            largest = max(found, key=lambda joint, k=k: abs(found[joint][k]))  # type: ignore[misc]
            other_sign = -found[largest][k]
            assert abs(other_sign - borne[oracle.joints[oracle.getJointId(largest)].idx_v]) > VISIBLE
    assert bool(compared) == bool(found)


@pytest.mark.parametrize("name", CASES)
def test_the_scheme_of_idyntree_errs_by_it(name: str) -> None:
    """Torques of iDynTree's estimator, with the error less without it, at all joints; the other sign is not it."""
    _, robot = _case(name)
    oracle, found = IDynTree(icub("iCubGazeboV2_7"), robot.joints), _named(robot.map, robot.error)
    known = []
    for contact in robot.contacts:
        body = robot.tree.frames[contact.link][0]
        links = [
            link for link in robot.tree.bodies[body].links if oracle.link_of(link) in robot.tree.bodies[body].links
        ]
        known.append(Contact(link=links[0], name=contact.name))
    for k in range(SAMPLES):
        oracle.float(k, robot.tree.root_link, robot.root)
        right = {name: reading[k] for name, reading in robot.expected.items()}
        wrong = right | {robot.sensor: right[robot.sensor] + robot.error[k]}
        without, with_error = (oracle.estimate(readings, known)[1] for readings in (right, wrong))
        ours = np.array([found[joint][k] if joint in found else 0.0 for joint in robot.joints.names])
        np.testing.assert_allclose(ours, with_error - without, rtol=0, atol=ROUNDING * robot.scale())
        if found:
            assert np.abs(-ours - (with_error - without)).max() > VISIBLE


@pytest.mark.parametrize("name", CASES)
def test_without_error_the_torques_are_those_of_the_model(name: str) -> None:
    """Expected readings give the torques of inverse dynamics, and the map of no error is no torque."""
    _, robot = _case(name)
    none = np.zeros((SAMPLES, 6))
    found = robot.estimated(none)
    for joint, wanted in robot.model.items():
        np.testing.assert_allclose(found.torque(joint), wanted, rtol=0, atol=EXACT)
    assert not robot.map.torques(none).any()


@pytest.mark.long
def test_it_is_what_the_estimator_makes_of_the_error_on_any_robot() -> None:
    """Rotary and prismatic joints that may mimic, sensors of either direction in any frame, a contact anywhere."""
    seen = {"borne": 0, "prismatic": 0, "negative": 0, "spared": 0}

    # the same examples in every run, as kinds of them are counted
    @settings(
        derandomize=True, max_examples=100, suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much]
    )
    @given(robots(), st.data())
    def check(model: RobotModel, data: st.DataObject) -> None:
        assume(any(not model.joints[sensor.joint].type.moves for sensor in model.sensors.values()))
        tree = build_tree(model, data.draw(st.sampled_from(tuple(model.links))))
        sensor = data.draw(st.sampled_from(tuple(tree.cuts)))
        contact = data.draw(st.sampled_from((None, *tree.frames)))
        names = tuple(joint for joint in model.joints if model.joints[joint].type.moves)
        position, velocity, acceleration = np.random.default_rng(1).uniform(-2.0, 2.0, size=(3, 3, len(names)))
        joints = JointMotion(names=names, position=position, velocity=velocity, acceleration=acceleration)
        robot = _Robot(tree, joints, random_root(3, 2), sensor, contact)
        borne = _named(robot.map, robot.error)
        # not less the model's: a contact beside the root takes up the support there
        found, right = robot.estimated(robot.error), robot.estimated(np.zeros((3, 6)))
        for joint in robot.model:
            wanted = found.torque(joint) - right.torque(joint)
            tolerance = ROUNDING * max(robot.scale(), float(np.abs(found.torques).max()))
            np.testing.assert_allclose(borne.get(joint, np.zeros(3)), wanted, rtol=0, atol=tolerance)
            seen["borne" if joint in borne else "spared"] += 1
            seen["prismatic"] += joint in borne and model.joints[joint].type == "prismatic"
        signs = joints_of_sensor(tree, sensor, cut_at=robot.cut_at, contact=contact)
        assert tuple(signs) == robot.map.joints
        seen["negative"] += -1.0 in signs.values()

    check()
    assert min(seen.values()) > 0


def test_a_slide_and_a_hinge_work_as_the_sensor_moves(tmp_path: Path) -> None:
    """Virtual work: torques are the force times how the sensor moves with each joint, by differences of its pose."""
    model = read_text(
        robot_xml(
            *(link_xml(name, mass=1.0, moments="0.02 0 0 0.02 0 0.02") for name in ("base", "upper", "fore", "hand")),
            joint_xml("slide", "base", "upper", type="prismatic", xyz="0 0.2 0.1", rpy="0 0.5 0", axis="0 1 1"),
            joint_xml("turn", "upper", "fore", type="continuous", xyz="0.1 0.1 0", rpy="-0.6 0 0.2", axis="0 -3 1"),
            joint_xml("ft_joint", "fore", "hand", xyz="0.3 0 0.2", rpy="0.4 0 0"),
            sensor_xml("ft", "ft_joint"),
        ),
        tmp_path,
    )
    tree, names, position = build_tree(model, "base"), ("slide", "turn"), np.array([[0.3, -0.7], [-0.1, 1.9]])
    found = torque_map(tree, JointMotion.at_rest(names, position), "ft", cut_at=("ft",))
    cut, step = tree.cuts["ft"], 1e-6

    def poses(change: FloatArray) -> FloatArray:
        return body_pose(tree, JointMotion.at_rest(names, position + change), cut.body) @ cut.body_H_sensor

    rows = []
    for change in step * np.eye(2):
        moved, rotation = (poses(change) - poses(-change)) / (2.0 * step), poses(0.0 * change)[:, :3, :3]
        spin = np.swapaxes(rotation, 1, 2) @ moved[:, :3, :3]  # of the axes of the sensor, in them
        turned = np.stack([spin[:, 2, 1], spin[:, 0, 2], spin[:, 1, 0]], axis=1)
        rows.append(np.hstack([np.einsum("nji,nj->ni", rotation, moved[:, :3, 3]), turned]))
    assert found.joints == names
    # what the hand does to the arm is borne by the motors against it
    np.testing.assert_allclose(found.rows, -np.stack(rows, axis=1), atol=1e-8)
    assert np.abs(found.rows[:, 0, :3]).max() > VISIBLE


def test_a_gap_makes_nan_of_that_sample_only() -> None:
    """NaN in one component of the error."""
    _, robot = _case("arm")
    error = np.array(robot.error)
    error[2, 4] = np.nan
    found = np.isnan(robot.map.torques(error))
    assert found[2].all()
    assert np.count_nonzero(found) == len(robot.map.joints)


def test_statistics_by_hand() -> None:
    """Of 3, -4 and a gap: mean square 12.5, mean -0.5, largest 4; two values say little of their mean."""
    found = torque_errors([3.0, np.nan, -4.0], [0.0, 1.0, 2.0])
    assert found.samples == 2
    assert found.rmse == pytest.approx(np.sqrt(12.5))
    assert found.mean == pytest.approx(-0.5)
    assert found.largest == 4.0
    known = mean_error([[3.0, 9.0], [-4.0, 16.0]], [0.0, 2.0])
    assert found.mean_error == pytest.approx(known.standard_error[0])
    assert found.mean_error > 3.5  # deviation 7 / sqrt 2, over the root of two: were they independent
    assert found.rmse_error == pytest.approx(known.standard_error[1] / (2.0 * np.sqrt(12.5)))
    assert found.rmse_half_width_95 == pytest.approx(known.half_width[1] / (2.0 * np.sqrt(12.5)))
    assert torque_errors([1.0], [0.0]).mean_error is None
    assert torque_errors([0.0, 0.0], [0.0, 1.0]).rmse_error == 0.0


@pytest.mark.long
def test_standard_errors_are_those_of_repeated_noise() -> None:
    """White noise of deviation one: the mean scatters by 1 / sqrt(n), the root mean square by 1 / sqrt(2 n)."""
    rng, n = np.random.default_rng(1), 1000
    time = 0.3 * np.arange(n)
    found = [torque_errors(rng.normal(size=n), time) for _ in range(200)]
    for field, wanted in (("mean", 1.0 / np.sqrt(n)), ("rmse", 1.0 / np.sqrt(2 * n))):
        scatter = np.std([getattr(one, field) for one in found])
        told = np.median([getattr(one, f"{field}_error") for one in found])
        assert scatter == pytest.approx(wanted, rel=0.2)  # 200 repetitions give it to 5 %
        assert 0.95 * wanted < told < 1.4 * wanted  # slow noise that 300 s would hardly show is allowed for


def test_what_makes_no_sense_is_refused() -> None:
    """Unknown links, sensors that are not cut, wrong shapes, nothing but gaps."""
    _, robot = _case("arm")
    with pytest.raises(RobotError, match="contact: no link 'r_hnad'"):
        joints_of_sensor(robot.tree, "r_arm_ft", cut_at=robot.cut_at, contact="r_hnad")
    with pytest.raises(RobotError, match="expected the sensor 'r_arm_ft' among the cuts"):
        joints_of_sensor(robot.tree, "r_arm_ft", cut_at=("l_arm_ft",))
    with pytest.raises(ShapeError, match="wrench"):
        robot.map.torques(np.zeros((SAMPLES + 1, 6)))
    with pytest.raises(ShapeError, match="none among 2"):
        torque_errors([np.nan, np.nan], [0.0, 1.0])
