# SPDX-License-Identifier: BSD-3-Clause
"""The contact wrench of a sub-model that nothing touches is the error of its sensors, and nothing else."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings, strategies as st

import forcetorque.evaluation.validation.contact_wrenches as module
from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import EstimationError, ForceTorqueError, RobotError, ShapeError
from forcetorque.base.pose import invert_pose
from forcetorque.base.wrench import MeasureDirection, transform_wrench
from forcetorque.evaluation.validation.contact_wrenches import EstimatedContactWrenches, estimate_contact_wrenches
from forcetorque.experiment.calibrations_under_test import errors_from_zero
from forcetorque.experiment.free_sub_model import ContactForceValidation, OtherSensors
from forcetorque.recording.alignment import interpolate
from forcetorque.recording.recording import Recording, Support
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from forcetorque.robot.mechanics.estimate import estimate
from forcetorque.robot.mechanics.estimate_arrays import Estimates
from forcetorque.robot.mechanics.estimated_quantities import Question
from forcetorque.robot.mechanics.measured_and_expected_wrench import Processing, robot_motion_at
from forcetorque.robot.model import RobotModel
from forcetorque.robot.motion import JointMotion, RootMotion
from forcetorque.robot.sub_models import SubModel
from forcetorque.robot.tree import build_tree, joints_between
from forcetorque.simulation.motions.joint_motions import random_movement
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.simulation.simulated_sensor import SimulatedSensor, distorted_by_mounting
from forcetorque.simulation.trace import record
from tests.robot.mechanics.random_robots import robots
from tests.robot.mechanics.simulated import Simulation, from_root, random_pose, random_root, to_root
from tests.robot.mechanics.touched import humanoid, touched
from tests.simulation.motions.stands import on_foot

SAME = 1e-12
"""Of the largest wrench: some 1e-15 is seen, from rounding at every link; a wrong contact on the way would be 1e-2."""

VISIBLE = 0.1
"""N, N m: what a negative control must exceed."""

EXAMPLES = 150

MODEL, MEASURED = OtherSensors


@dataclass(frozen=True)
class Free:
    """A robot that is touched at its support alone, and what its sensors then have to read."""

    validation: ContactForceValidation
    joints: JointMotion
    root: RootMotion
    simulation: Simulation
    expected: dict[str, FloatArray]

    @classmethod
    def of(cls, validation: ContactForceValidation, model: RobotModel, joints: JointMotion, root: RootMotion) -> Free:
        """Hold a robot at its support."""
        support = Contact(link=validation.support or validation.tree.root_link)
        simulation = Simulation(model, validation.tree.root_link, joints, root)
        simulation.touch(support, from_root(simulation.links[support.link].pose, simulation.total_needed()))
        expected = {sensor: simulation.reading(sensor) for sensor in validation.tree.cuts}
        return cls(validation, joints, root, simulation, expected)

    def reading(self, seed: int) -> FloatArray:
        """What a bad calibration makes of the expected reading."""
        error = np.random.default_rng(seed).normal(scale=5.0, size=(len(self.joints), 6))
        return self.expected[self.validation.sensor] + error

    def forces(self, **readings: FloatArray) -> EstimatedContactWrenches:
        """Validate, with perfect readings of the other sensors."""
        measured = Wrenches.of(self.expected)
        return estimate_contact_wrenches(self.validation, self.joints, self.root, readings, measured=measured)

    def direction(self) -> float:
        """1 where the reading is what the far side does to the near side, else -1."""
        tag = self.simulation.model.sensors[self.validation.sensor]
        child_is_far = self.simulation.model.joints[tag.joint].child in self.simulation.far_side[tag.joint]
        return 1.0 if child_is_far == (tag.direction is MeasureDirection.CHILD_TO_PARENT) else -1.0

    def carried_back(self, contact: Contact, wrench: FloatArray) -> FloatArray:
        """Equation (4.1) with the poses of the simulation."""
        at_root = to_root(self.simulation.links[contact.link].pose @ contact.link_H_contact, wrench)
        return from_root(self.simulation.sensor_pose(self.validation.sensor), at_root)


def _at_contact(found: EstimatedContactWrenches, candidate: str) -> FloatArray:
    """What the environment does to the robot, in and about the contact frame, as the estimator has it."""
    in_direction = transform_wrench(invert_pose(found.sensor_H_contact), found.of(candidate))
    return found.validation.direction * in_direction


def _require_same(found: FloatArray, wanted: FloatArray, *, scale: float) -> None:
    np.testing.assert_allclose(found, wanted, rtol=0, atol=SAME * scale)


CASES: dict[str, tuple[str, str, str | None, str | None, float]] = {
    # seen from, judged sensor, sub-model, support, whether the sensor is at its base (1) or at an outboard cut (-1)
    "leg": ("root_link", "l_leg_ft", None, None, 1.0),
    "leg_by_the_ankle": ("root_link", "l_foot_ft", "l_leg_ft", None, -1.0),
    "foot": ("root_link", "l_foot_ft", None, None, 1.0),
    "arm": ("root_link", "r_arm_ft", None, None, 1.0),
    "torso_of_a_robot_on_its_foot": ("head", "r_arm_ft", "head", "l_sole", -1.0),
    "leg_that_stands": ("head", "l_leg_ft", None, "l_sole", 1.0),
    "leg_that_stands_by_the_ankle": ("head", "l_foot_ft", "l_leg_ft", "l_sole", -1.0),
    "torso_seen_from_a_foot": ("l_sole", "l_leg_ft", None, None, 1.0),
    "torso_seen_from_a_foot_by_an_arm": ("l_sole", "l_arm_ft", "l_leg_ft", None, -1.0),
    "leg_seen_from_its_foot": ("l_sole", "l_leg_ft", "l_foot_ft", None, -1.0),
}


def _case(name: str, **more: object) -> Free:
    root_link, sensor, sub_model, support, _ = CASES[name]
    model, tree, joints, root = humanoid(root_link, 7)
    validation = ContactForceValidation(tree=tree, sensor=sensor, sub_model=sub_model, support=support, **more)  # type: ignore[arg-type]
    return Free.of(validation, model, joints, root)


@pytest.mark.parametrize("mode", OtherSensors)
@pytest.mark.parametrize("name", CASES)
def test_it_is_reading_minus_expected_at_the_base_and_the_negative_at_an_outboard_cut(
    name: str, mode: OtherSensors
) -> None:
    """Of a moving humanoid, with its base afloat; with the sign flipped it is not (negative control)."""
    free = _case(name, other_sensors=mode)
    reading, expected = free.reading(1), free.expected[free.validation.sensor]
    found = free.forces(bad=reading, right=expected)
    scale = max(np.abs(values).max() for values in free.expected.values())
    wanted = CASES[name][4] * (reading - expected)
    _require_same(found.of("bad"), wanted, scale=scale)
    _require_same(found.of("right"), np.zeros_like(expected), scale=scale)
    _require_same(found.free_reading, expected, scale=scale)
    with pytest.raises(AssertionError):
        _require_same(found.of("bad"), -wanted, scale=scale)


@pytest.mark.long
def test_it_is_so_on_any_robot() -> None:
    """Sensors of either direction, in any frame, at either end of the sub-model, whatever carries the robot."""
    seen = {(direction, sign): 0 for direction in (1.0, -1.0) for sign in (1.0, -1.0)}

    # the same examples in every run, as kinds of them are counted
    @settings(
        derandomize=True,
        max_examples=EXAMPLES,
        suppress_health_check=[HealthCheck.too_slow, HealthCheck.filter_too_much],
    )
    @given(robots(), st.data())
    def check(model: RobotModel, data: st.DataObject) -> None:
        assume(any(not model.joints[sensor.joint].type.moves for sensor in model.sensors.values()))
        tree = build_tree(model, data.draw(st.sampled_from(tuple(model.links))))
        sensor = data.draw(st.sampled_from(tuple(tree.cuts)))
        outboard = ContactForceValidation(tree=tree, sensor=sensor, other_sensors=MEASURED)
        inboard = next(part for part in _parts(outboard) if sensor in part.outboard_sensors)
        part = data.draw(st.sampled_from((outboard.part, inboard)))
        elsewhere = [link for link, (body, _) in tree.frames.items() if body not in part.bodies]
        support = data.draw(st.sampled_from(elsewhere))
        validation = ContactForceValidation(tree=tree, sensor=sensor, sub_model=part.name, support=support)
        names = tuple(joint for joint in model.joints if model.joints[joint].type.moves)
        position, velocity, acceleration = np.random.default_rng(1).uniform(-2.0, 2.0, size=(3, 3, len(names)))
        joints = JointMotion(names=names, position=position, velocity=velocity, acceleration=acceleration)
        free = Free.of(validation, model, joints, random_root(3, 2))
        reading = free.reading(3)
        wanted = (1.0 if part.sensor == sensor else -1.0) * (reading - free.expected[sensor])
        scale = max(10.0, *(np.abs(values).max() for values in free.expected.values()))
        found = free.forces(bad=reading)
        _require_same(found.of("bad"), wanted, scale=scale)
        on_robot = free.direction() * _at_contact(found, "bad")
        _require_same(free.carried_back(validation.point, on_robot), wanted, scale=scale)
        seen[free.direction(), validation.sign] += 1

    check()
    assert min(seen.values()) >= 5, seen


def _parts(validation: ContactForceValidation) -> tuple[SubModel, ...]:
    return Question(tree=validation.tree, measured=validation.cut_at or ()).parts


@pytest.mark.parametrize("mode", OtherSensors)
@pytest.mark.parametrize("name", CASES)
def test_every_candidate_is_as_if_the_estimator_had_run_for_it(name: str, mode: OtherSensors) -> None:
    """The contact wrench of the estimator of the whole robot, with all sensors, carried back by (4.1)."""
    free = _case(name, other_sensors=mode)
    links = [link for body in free.validation.part.bodies for link in free.validation.tree.bodies[body].links]
    rng = np.random.default_rng(4)
    contact = Contact(link=str(rng.choice(links)), name="somewhere", link_H_contact=random_pose(rng))
    validation = replace(free.validation, contact=contact)
    others = {
        sensor: values + (mode is MEASURED) * rng.normal(scale=3.0, size=values.shape)
        for sensor, values in free.expected.items()
    }
    candidates = np.stack([free.reading(seed) for seed in range(5)])
    found = estimate_contact_wrenches(validation, free.joints, free.root, candidates, measured=Wrenches.of(others))
    assert found.candidates == ("0", "1", "2", "3", "4")
    question = Question(tree=validation.tree, measured=tuple(validation.tree.cuts), contacts=(contact,), equations=())
    scale = max(np.abs(values).max() for values in others.values())
    for candidate, reading in zip(found.candidates, candidates, strict=True):
        measured = Wrenches.of(others | {validation.sensor: reading})
        alone = estimate(question, free.joints, free.root, measured=measured).contact("somewhere")
        _require_same(_at_contact(found, candidate), alone, scale=scale)
        wanted = free.direction() * free.carried_back(contact, alone)
        _require_same(found.of(candidate), wanted, scale=scale)
        assert np.abs(found.of(candidate)).max() > VISIBLE
    # seen from the foot the child of the hip's sensor is on the near side; elsewhere (4.1) stands as printed
    assert (free.direction() == -1.0) == (name in {"torso_seen_from_a_foot", "leg_seen_from_its_foot"})


def test_the_estimator_runs_once_for_all_candidates(monkeypatch: pytest.MonkeyPatch) -> None:
    """One pass for what the other sensors read and one for the contact, however many candidates there are."""
    calls = 0

    def counted(*arguments: object, **named: object) -> Estimates:
        nonlocal calls
        calls += 1
        return estimate(*arguments, **named)  # type: ignore[arg-type]

    monkeypatch.setattr(module, "estimate", counted)
    _case("leg").forces(**{f"c{seed}": np.zeros((7, 6)) for seed in range(40)})
    assert calls == 2


def test_the_contact_point_does_not_matter_at_the_sensor() -> None:
    """One full wrench takes up all that is left unexplained: the wrench at the contact differs, not at the sensor."""
    free, found = _case("leg"), []
    for link in ("l_upper_leg", "l_lower_leg", "l_ankle_1"):
        contact = Contact.at_point(link, [0.1, -0.2, 0.3])
        forces = replace(free, validation=replace(free.validation, contact=contact)).forces(bad=free.reading(1))
        found.append((forces.of("bad"), _at_contact(forces, "bad")))
    for at_sensor, at_contact in found[1:]:
        _require_same(at_sensor, found[0][0], scale=100.0)
        assert np.abs(at_contact - found[0][1]).max() > VISIBLE


@pytest.mark.parametrize("mode", OtherSensors)
def test_what_touches_the_sub_model_after_all_is_found(mode: OtherSensors) -> None:
    """The wrench at the contact is what the environment does to the robot."""
    shin = Contact.at_point("l_lower_leg", [0.05, 0.0, -0.1])
    robot = touched([shin])
    validation = ContactForceValidation(tree=robot.tree, sensor="l_leg_ft", contact=shin, other_sensors=mode)
    reading = {"perfect": robot.measured.of_name("l_leg_ft")}
    found = estimate_contact_wrenches(validation, robot.joints, robot.root, reading, measured=robot.measured)
    _require_same(_at_contact(found, "perfect"), robot.truth[shin.name], scale=100.0)


def test_a_contact_elsewhere_harms_the_mode_model_only() -> None:
    """A foot on the ground is a second contact: the model does not know it, the sensor of the foot does."""
    sole = Contact(link="l_sole")
    robot = touched([sole])
    reading = {"perfect": robot.measured.of_name("l_leg_ft")}
    found = {}
    for mode in OtherSensors:
        validation = ContactForceValidation(tree=robot.tree, sensor="l_leg_ft", other_sensors=mode)
        forces = estimate_contact_wrenches(validation, robot.joints, robot.root, reading, measured=robot.measured)
        found[mode] = forces.of("perfect")
    _require_same(found[MEASURED], np.zeros_like(found[MEASURED]), scale=100.0)
    assert np.abs(found[MODEL]).max() > VISIBLE


def test_an_error_of_another_sensor_is_in_the_mode_measured_only() -> None:
    """It comes with the opposite sign, carried from that sensor to the judged one; without it the modes agree."""
    error = np.random.default_rng(5).normal(scale=4.0, size=(7, 6))
    found: dict[tuple[OtherSensors, bool], FloatArray] = {}
    for mode in OtherSensors:
        free = _case("leg", other_sensors=mode)
        for wrong in (True, False):
            measured = Wrenches.of(free.expected | {"l_foot_ft": free.expected["l_foot_ft"] + wrong * error})
            readings = {"bad": free.reading(1)}
            forces = estimate_contact_wrenches(free.validation, free.joints, free.root, readings, measured=measured)
            found[mode, wrong] = forces.of("bad")
    np.testing.assert_array_equal(found[MODEL, True], found[MODEL, False])
    _require_same(found[MEASURED, False], found[MODEL, False], scale=500.0)
    at_root = to_root(free.simulation.sensor_pose("l_foot_ft"), error)
    carried = from_root(free.simulation.sensor_pose("l_leg_ft"), at_root)
    _require_same(found[MEASURED, True], found[MEASURED, False] - carried, scale=500.0)
    assert np.abs(carried).max() > VISIBLE


def test_a_sensor_that_is_left_out_is_no_cut() -> None:
    """Without the sensor of the foot the leg is one sub-model to the toes, and its reading is not asked for."""
    model, tree, joints, root = humanoid("root_link", 7)
    validation = ContactForceValidation(
        tree=tree, sensor="l_leg_ft", cut_at=("l_leg_ft", "l_arm_ft"), other_sensors=MEASURED
    )
    assert validation.others == ()
    assert tree.frames["l_sole"][0] in validation.part.bodies
    free = Free.of(validation, model, joints, root)
    found = estimate_contact_wrenches(validation, joints, root, {"bad": free.reading(1)})
    _require_same(found.of("bad"), free.reading(1) - free.expected["l_leg_ft"], scale=500.0)


def test_only_the_required_joints_are_looked_at() -> None:
    """They are enough, and without the model's help the legs and elbows may be absent."""
    needed = {}
    for mode in OtherSensors:
        free = _case("torso_of_a_robot_on_its_foot", other_sensors=mode)
        needed[mode] = free.validation.required_joints
        columns = [free.joints.names.index(joint) for joint in needed[mode]]
        arrays = (free.joints.position, free.joints.velocity, free.joints.acceleration)
        position, velocity, acceleration = (array[:, columns] for array in arrays)
        few = JointMotion(names=needed[mode], position=position, velocity=velocity, acceleration=acceleration)
        reading = free.reading(1)
        found = replace(free, joints=few).forces(bad=reading).of("bad")
        np.testing.assert_array_equal(found, free.forces(bad=reading).of("bad"))
    assert set(needed[MEASURED]) < set(needed[MODEL])
    assert not {"l_knee", "r_elbow"} & set(needed[MEASURED])


GAP = 4


def _gap_in_reading(free: Free) -> EstimatedContactWrenches:
    reading = free.reading(1)
    reading[GAP, 2] = np.nan  # one component
    return free.forces(bad=reading)


def _gap_in_joint(free: Free) -> EstimatedContactWrenches:
    position = np.array(free.joints.position)
    position[GAP, free.joints.names.index("l_knee")] = np.nan
    joints = replace(free.joints, position=position)
    return replace(free, joints=joints).forces(bad=free.reading(1))


def _gap_in_root(free: Free) -> EstimatedContactWrenches:
    omega = np.array(free.root.angular_velocity)
    omega[GAP] = np.nan
    return replace(free, root=replace(free.root, angular_velocity=omega)).forces(bad=free.reading(1))


def _gap_in_other_sensor(free: Free) -> EstimatedContactWrenches:
    foot = np.array(free.expected["l_foot_ft"])
    foot[GAP, 0] = np.nan
    return replace(free, expected=free.expected | {"l_foot_ft": foot}).forces(bad=free.reading(1))


@pytest.mark.parametrize("spoil", [_gap_in_reading, _gap_in_joint, _gap_in_root, _gap_in_other_sensor])
def test_a_gap_stays_in_its_sample(spoil: Callable[[Free], EstimatedContactWrenches]) -> None:
    """All of that sample is missing, and the others are what they were."""
    free = _case("leg", other_sensors=MEASURED)
    whole, found = free.forces(bad=free.reading(1)).of("bad"), spoil(free).of("bad")
    others = np.arange(len(whole)) != GAP
    assert np.isnan(found[GAP]).all()
    np.testing.assert_array_equal(found[others], whole[others])
    assert errors_from_zero(found, np.arange(float(len(found)))).count == len(whole) - 1


def test_a_candidate_with_a_gap_leaves_the_others_whole() -> None:
    """A gap in one candidate's reading is no gap of another's."""
    free = _case("leg")
    gappy = free.reading(1)
    gappy[GAP] = np.nan
    found = free.forces(gappy=gappy, whole=free.reading(1))
    assert np.isfinite(found.of("whole")).all()
    assert np.isnan(found.of("gappy")).any(axis=1).tolist() == [index == GAP for index in range(7)]


def _ask(**fields: object) -> Callable[[Free], object]:
    return lambda free: replace(free.validation, **fields)  # type: ignore[arg-type]


def _answer(
    readings: object, *, mode: OtherSensors = MODEL, measured: Wrenches | None = None
) -> Callable[[Free], object]:
    def answer(free: Free) -> EstimatedContactWrenches:
        validation = replace(free.validation, other_sensors=mode)
        return estimate_contact_wrenches(validation, free.joints, free.root, readings, measured=measured)  # type: ignore[arg-type]

    return answer


ZEROS = np.zeros((7, 6))

REFUSED: dict[str, tuple[Callable[[Free], object], type[ForceTorqueError], str]] = {
    "unknown_sensor": (_ask(sensor="l_leg"), RobotError, 'no force-torque sensor.*did you mean "l_leg_ft"'),
    "sensor_not_cut": (_ask(cut_at=("l_foot_ft",)), EstimationError, "evaluated sensor 'l_leg_ft' among the cuts"),
    "unknown_sub_model": (_ask(sub_model="leg"), EstimationError, "'root_link' or 'l_leg_ft', got 'leg'"),
    "sub_model_elsewhere": (_ask(sub_model="l_foot_ft"), EstimationError, "sensor 'l_leg_ft' bounds.*got 'l_foot_ft'"),
    "unknown_link": (_ask(contact=Contact(link="l_lower_lag")), RobotError, 'did you mean "l_lower_leg"'),
    "contact_elsewhere": (
        _ask(contact=Contact(link="l_sole")),
        EstimationError,
        "a link of sub-model 'l_leg_ft', got 'l_sole'.*known: .*l_lower_leg",
    ),
    "pure_force": (
        _ask(contact=Contact(link="l_lower_leg", type=ContactType.FORCE)),
        EstimationError,
        "expected the type wrench.*got force",
    ),
    "support_on_the_sub_model": (_ask(sub_model="root_link"), EstimationError, "bears the support 'root_link'"),
    "support_named_there": (_ask(support="l_lower_leg"), EstimationError, "bears the support 'l_lower_leg'"),
    "support_named_there_though_measured": (
        _ask(support="l_lower_leg", other_sensors=MEASURED),
        EstimationError,
        "bears the support",
    ),
    "unknown_support": (_ask(support="l_sle"), RobotError, 'did you mean "l_sole"'),
    "unknown_mode": (_ask(other_sensors="guess"), ValueError, "guess"),  # type: ignore[dict-item]
    "no_candidate": (_answer({}), ShapeError, "at least one candidate"),
    "one_candidate_unstacked": (_answer(ZEROS), ShapeError, r"readings: expected an array of shape \(n, 7, 6\)"),
    "reading_of_other_length": (_answer({"bad": ZEROS[:5]}), ShapeError, r"readings of 'bad'.*\(7, 6\), got \(5, 6\)"),
    "infinite_reading": (
        _answer({"bad": np.where(np.arange(7)[:, None] == GAP, np.inf, ZEROS)}),
        EstimationError,
        "readings of 'bad'.*fx is inf in sample 4",
    ),
    "nothing_measured": (
        _answer({"bad": ZEROS}, mode=MEASURED),
        EstimationError,
        "reading of sensor 'l_foot_ft', which bounds sub-model 'l_leg_ft', is missing; known: none",
    ),
    "other_sensor_missing": (
        _answer({"bad": ZEROS}, mode=MEASURED, measured=Wrenches.of({"r_foot_ft": ZEROS})),
        EstimationError,
        "'l_foot_ft'.*is missing.*known: r_foot_ft; .*cut_at",
    ),
    "others_of_other_length": (
        _answer({"bad": ZEROS}, mode=MEASURED, measured=Wrenches.of({"l_foot_ft": ZEROS[:5]})),
        ShapeError,
        r"'l_foot_ft': \(5, 6\)",
    ),
    "unknown_candidate": (lambda free: free.forces(good=ZEROS).of("god"), EstimationError, 'did you mean "good"'),
}


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case: str) -> None:
    """Each mistake has its error, whose message names what was expected."""
    attempt, error, message = REFUSED[case]
    free = _case("leg")
    with pytest.raises(error, match=message):
        attempt(free)


NOISE_COUNTS = 3.0
"""Standard deviation of the noise of simulated sensors."""


@pytest.fixture(scope="module")
def specimens() -> dict[str, SimulatedSensor]:
    """Sensors of a leg and its foot."""
    rng = np.random.default_rng(6)
    return {
        sensor: SimulatedSensor(
            matrix=np.linalg.inv(FAMILIES["standard"].draw(rng)), offset=rng.normal(size=6), noise_counts=NOISE_COUNTS
        )
        for sensor in ("r_leg_ft", "r_foot_ft")
    }


@pytest.fixture(scope="module")
def recording(specimens: dict[str, SimulatedSensor]) -> Recording:
    """A robot on its left foot that swings everything else."""
    movement = random_movement(on_foot("biped"), rng=np.random.default_rng(7), duration_s=20.0, slowest_hz=0.2)
    return record(movement, specimens, rate_hz=100.0, rng=np.random.default_rng(8))


@pytest.mark.parametrize("mode", OtherSensors)
def test_a_wrong_matrix_shows_in_a_simulated_recording(
    recording: Recording, specimens: dict[str, SimulatedSensor], mode: OtherSensors
) -> None:
    """The true matrix leaves noise, a wrong one its error times the counts, and that of the foot shows if measured."""
    model, support = on_foot("biped").model, Support(frame="l_sole", gravity_direction=np.array([0.0, 0.0, -1.0]))
    tree = build_tree(model, "l_sole")
    validation = ContactForceValidation(tree=tree, sensor="r_leg_ft", other_sensors=mode)
    assert "r_knee" in joints_between(tree, tree.bodies[validation.part.bodies[-1]].links[0])
    at_ns = recording.stream("r_leg_ft").stamp_ns[50:-50]
    joints, root = robot_motion_at(
        recording,
        model,
        support,
        validation.required_joints,
        recording.stream("r_leg_ft"),
        at_ns,
        processing=Processing(),
    )
    rng = np.random.default_rng(9)
    counts = {
        sensor: interpolate(recording.stream(sensor), recording.stream(sensor).signal("raw").values, at_ns)
        for sensor in specimens
    }
    wrong = {
        sensor: distorted_by_mounting(specimen.matrix, relative=0.05, rng=rng) for sensor, specimen in specimens.items()
    }

    def forces(foot: FloatArray) -> EstimatedContactWrenches:
        leg = {"true": specimens["r_leg_ft"].matrix, "wrong": wrong["r_leg_ft"]}
        readings = {name: counts["r_leg_ft"] @ c.T + specimens["r_leg_ft"].offset for name, c in leg.items()}
        measured = Wrenches.of({"r_foot_ft": counts["r_foot_ft"] @ foot.T + specimens["r_foot_ft"].offset})
        return estimate_contact_wrenches(validation, joints, root, readings, measured=measured)

    found, lame = forces(specimens["r_foot_ft"].matrix), forces(wrong["r_foot_ft"])
    added = counts["r_leg_ft"] @ (wrong["r_leg_ft"] - specimens["r_leg_ft"].matrix).T
    whole = np.isfinite(found.of("true")).all(axis=1)
    assert whole.mean() > 0.9
    _require_same((found.of("wrong") - found.of("true"))[whole], added[whole], scale=500.0)
    time = 0.01 * np.arange(len(whole))
    judged = {name: errors_from_zero(found.of(name), time) for name in found.candidates}
    assert judged["wrong"].force_mean > 50.0 * judged["true"].force_mean
    # 19 s of slow motion, with which the error changes: a third of the mean is open
    assert 0.0 < judged["wrong"].force_mean_error < 0.5 * judged["wrong"].force_mean
    of_foot = errors_from_zero(lame.of("true"), time).force_mean / judged["true"].force_mean
    if mode is MEASURED:
        assert of_foot > 10.0
        return
    assert of_foot == 1.0
    # mean of the magnitude of normal noise and rounding; in the moments the encoders' steps show too
    noise = np.linalg.norm(specimens["r_leg_ft"].matrix, axis=1) * np.hypot(NOISE_COUNTS, np.sqrt(1.0 / 12.0))
    np.testing.assert_allclose(judged["true"].mean_absolute[:3], np.sqrt(2.0 / np.pi) * noise[:3], rtol=0.1)
