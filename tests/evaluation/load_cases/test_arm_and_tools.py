# SPDX-License-Identifier: BSD-3-Clause
"""A UR5 with tools on its flange: weighed by the sensor, shared by recordings, and calibrated from."""

from __future__ import annotations

import json
import re
import runpy
import shutil
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.calibration.calibrate import calibrate_for_file, calibrate_sensor, data_doubts
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.load_cases.load_case import operating_load_cases
from forcetorque.evaluation.load_cases.verdict import use_verdicts
from forcetorque.experiment.calibration.estimation_type import EstimationType, estimation_type
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.draft.draft import draft_experiment
from forcetorque.payload.identify import weigh_load
from forcetorque.payload.load_warnings import reversed_sense
from forcetorque.payload.result import WeighedLoad
from tests.scenes.robots import example_robot

EXAMPLE = Path(__file__).resolve().parents[3] / "examples" / "27_arm_and_tools.py"
UR5 = "ur_description/urdf/ur5_robot.urdf"
TRUTH = {"gripper": (1.3, [0.01, 0.02, 0.06]), "weight": (2.2, [-0.04, 0.05, 0.12])}
STATED = "mass_kg = 2.2\ncentre_of_mass_m = [-0.04, 0.05, 0.12]\n"


@pytest.fixture(scope="module")
def example() -> SimpleNamespace:
    """The example, which simulates."""
    return SimpleNamespace(**runpy.run_path(str(EXAMPLE)))


@pytest.fixture(scope="module")
def arm(example: SimpleNamespace, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, np.ndarray]:
    """Twenty seconds with each of two tools, of which the second is stated; and the truth about the sensor."""
    folder = tmp_path_factory.mktemp("ur5")
    truth = example.simulate(folder, example_robot(UR5), seed=4, weighed=("weight",), duration_s=20.0)
    return folder, truth


def _run(file: Path) -> SensorRun:
    return SensorRun(load_experiment(file), "wrist_ft")


def _edited(arm: tuple[Path, np.ndarray], folder: Path, tool: str, *changes: tuple[str, str]) -> Path:
    """A copy of an experiment with something else in its file."""
    copy = Path(shutil.copytree(arm[0], folder / "copy", dirs_exist_ok=True))
    text = (copy / f"{tool}.toml").read_text(encoding="utf-8")
    for old, new in changes:
        assert old in text
        text = text.replace(old, new)
    (copy / f"{tool}.toml").write_text(text, encoding="utf-8")
    return copy / f"{tool}.toml"


@pytest.fixture(scope="module")
def weighed(arm: tuple[Path, np.ndarray]) -> WeighedLoad:
    """Both recordings, weighed together."""
    return weigh_load([_run(arm[0] / f"{tool}.toml") for tool in TRUTH])


def test_a_tool_on_an_arm_without_mass_beyond_its_sensor_says_what_the_sensor_is_for(
    arm: tuple[Path, np.ndarray],
) -> None:
    """Pushes as strong as the tool is heavy: the URDF has nothing there, and without a use there is no verdict."""
    (case,) = operating_load_cases([_run(arm[0] / "weight.toml")])
    assert case.words.startswith("pushes of 21.6 N, the weight of the distal links")


@pytest.mark.long
def test_a_weighed_tool_weighs_the_other(weighed: WeighedLoad) -> None:
    """Mass and centre of mass lie in their intervals, which one recording by itself leaves twenty times as wide."""
    gripper, weight = weighed.loads
    mass, centre = TRUTH["gripper"]
    assert gripper.mass_kg == pytest.approx(mass, abs=1.5 * (gripper.mass_half_width_95_kg or 0.0))
    assert (gripper.mass_half_width_95_kg or 1.0) < 0.01
    halves = np.array(gripper.centre_of_mass_half_width_95_m, dtype=np.float64)
    assert (np.abs(np.subtract(gripper.centre_of_mass_m, centre)) < 2.0 * halves).all()
    assert (weight.estimated, gripper.link) == (False, "ee_link")
    alone = next(row for row in weighed.recordings if row.load == "gripper")
    assert (alone.mass_half_width_95_kg or 0.0) > 5.0 * (gripper.mass_half_width_95_kg or 0.0)
    assert any("beside 'weight', which is stated" in words for words in weighed.warnings)
    assert not any(row.contact for row in weighed.validation)


@pytest.mark.long
def test_the_calibration_reads_pushes_better_than_the_maker(
    example: SimpleNamespace, arm: tuple[Path, np.ndarray], tmp_path: Path
) -> None:
    """With one weighed tool, and with none; a mass that is stated a fifth too large is seen to harm."""
    folder, truth = arm
    inverse = np.linalg.inv(truth)
    before = np.array(example.push_errors(inverse))
    unknown = _edited(arm, tmp_path, "weight", (STATED, "")).parent
    right, after = (
        np.array(example.push_errors(example.calibrated(files, tuple(TRUTH)) @ inverse)) for files in (folder, unknown)
    )
    assert (right < 0.95 * before).all()
    assert (after < 0.95 * before).all()
    wrong = _edited(arm, tmp_path / "wrong", "weight", ("mass_kg = 2.2", "mass_kg = 2.64")).parent
    try:
        heavy = np.array(example.push_errors(example.calibrated(wrong, tuple(TRUTH)) @ inverse))
    except ForceTorqueError as refusal:  # the gate sees a factor
        assert "factor" in str(refusal) or "gain" in str(refusal)  # noqa: PT017
    else:
        assert heavy[0] > 1.3 * right[0]


def test_a_stated_tool_is_a_reference_as_any_other(arm: tuple[Path, np.ndarray]) -> None:
    """Held-out loads judge a calibration; without the tool, the reference lacks 22 N."""
    run = _run(arm[0] / "weight.toml")
    calibration = calibrate_sensor(run, code_version="", created="2026-01-01T00:00:00")
    prior, new = evaluate(run, {"new": calibration}).verdicts[:2]
    assert new.force_error_mean_N < prior.force_error_mean_N < 3.0


@pytest.mark.long
def test_a_weighed_tool_is_named_by_its_result(
    arm: tuple[Path, np.ndarray], weighed: WeighedLoad, tmp_path: Path
) -> None:
    """What a run told of a tool enters the next with its covariance; the same result of another link is refused."""
    file = _edited(arm, tmp_path, "gripper", ('link = "ee_link"\n', 'link = "ee_link"\nfrom = "tool.json"\n'))
    (file.parent / "tool.json").write_text(weighed.model_dump_json(by_alias=True), encoding="utf-8")
    (again,) = weigh_load(_run(file)).loads
    first = weighed.loads[0]
    assert again.mass_kg == pytest.approx(first.mass_kg, abs=2.0 * (first.mass_half_width_95_kg or 0.0))
    assert (again.mass_half_width_95_kg or 1.0) < 2.0 * (first.mass_half_width_95_kg or 0.0)
    elsewhere = json.loads((file.parent / "tool.json").read_text(encoding="utf-8"))
    elsewhere["loads"][0]["link"] = "wrist_3_link"
    (file.parent / "tool.json").write_text(json.dumps(elsewhere), encoding="utf-8")
    with pytest.raises(ForceTorqueError, match="on the link 'ee_link', got 'gripper' on 'wrist_3_link'"):
        load_experiment(file)


@pytest.mark.long
def test_a_tool_that_the_sensor_itself_weighed_is_named(
    arm: tuple[Path, np.ndarray], weighed: WeighedLoad, tmp_path: Path
) -> None:
    """Not where a stated tool told the scale, nor of another sensor: the negative controls."""
    file = _edited(arm, tmp_path, "gripper", ('link = "ee_link"\n', 'link = "ee_link"\nfrom = "tool.json"\n'))
    beside = json.loads(weighed.model_dump_json(by_alias=True))
    alone = {**beside, "loads": beside["loads"][:1]}
    for content, named in ((beside, False), (alone, True), ({**alone, "serial": "FT-99"}, False)):
        (file.parent / "tool.json").write_text(json.dumps(content), encoding="utf-8")
        sentences = list(_run(file).circular_loads())
        assert [words[: words.index(" (")] for words in sentences] == [
            "load 'gripper': weighed before by this sensor itself"
        ] * named


@pytest.mark.parametrize("kind", [None, estimation_type("OnTdTO")])
@pytest.mark.long
def test_calibration_and_verdict_from_python_name_a_circular_load(
    arm: tuple[Path, np.ndarray], weighed: WeighedLoad, tmp_path: Path, kind: EstimationType | None
) -> None:
    """As the command line does, which says it once; not where a stated tool told the scale: the negative control."""
    file = _edited(arm, tmp_path, "gripper", ('link = "ee_link"\n', 'link = "ee_link"\nfrom = "tool.json"\n'))
    beside = json.loads(weighed.model_dump_json(by_alias=True))
    for content, named in ((beside, False), ({**beside, "loads": beside["loads"][:1]}, True)):
        (file.parent / "tool.json").write_text(json.dumps(content), encoding="utf-8")
        run = _run(file)
        written = calibrate_for_file(run, tmp_path / "new.json", code_version="", created="2026-01-01", kind=kind)
        calibration = written.calibrations[0].calibration
        (verdict,) = use_verdicts(run, {"new": calibration})
        reasons = [reason.text for reason in verdict.reasons]
        for words in (calibration.warnings, reasons, written.warnings):
            assert sum("weighed before by this sensor itself" in sentence for sentence in words) == named
        assert (verdict.decision == "use") <= (not named)
        unaware = calibration.model_copy(update={"warnings": ()})  # fitted elsewhere, and judged by the circular load
        (verdict,) = use_verdicts(run, {"new": unaware})
        informing = [reason.text for reason in verdict.reasons if reason.against is None]
        assert sum("weighed before by this sensor itself" in sentence for sentence in informing) == named


@pytest.mark.long
def test_a_tool_weighed_by_a_wrong_sensor_hides_that_it_is_wrong(example: SimpleNamespace, tmp_path: Path) -> None:
    """A sensor 3 % off weighs the tool by as much wrong, and calibrated by that stays so; by the true mass not.

    What two sensors that differ by 6 % in everything read of the tool's weight is compared.
    """
    mass, centre = TRUTH["weight"]
    weight = np.concatenate([[0.0, 0.0, mass], np.cross(centre, [0.0, 0.0, mass])])
    stated = f"mass_kg = {mass}\ncentre_of_mass_m = {centre}\n"
    sizes = []
    for gain in (0.97, 1.03):
        folder = tmp_path / str(gain)
        example.simulate(
            folder, example_robot(UR5), seed=3, tools={"weight": (mass, centre)}, relative=0.0, duration_s=12.0
        )
        log = folder / "weight.csv"
        table = np.loadtxt(log, delimiter=",", skiprows=1)
        table[:, -6:] *= gain
        head = log.read_text(encoding="utf-8").splitlines()[0]
        np.savetxt(log, table, fmt="%.6f", delimiter=",", header=head, comments="")
        file = folder / "weight.toml"
        text = file.read_text(encoding="utf-8")
        (folder / "tool.json").write_text(weigh_load(_run(file)).model_dump_json(by_alias=True), encoding="utf-8")
        for words in ('from = "tool.json"\n', stated):
            file.write_text(text.replace('link = "ee_link"\n', f'link = "ee_link"\n{words}'), encoding="utf-8")
            run = _run(file)
            result = calibrate_for_file(run, folder / "new.json", code_version="", created="2026-01-01T00:00:00")
            calibration = result.calibrations[0].calibration
            warned = [words for words in result.warnings if "weighed before by this sensor itself" in words]
            assert len(warned) == ("from" in words)
            assert warned == [one for one in evaluate(run, {"new": calibration}).warnings if one in warned]
            sizes.append(float(np.linalg.norm(gain * calibration.matrix @ weight) / np.linalg.norm(weight)))
    circular, right = np.reshape(sizes, (2, 2)).T
    np.testing.assert_allclose(right, 1.0, atol=0.01)
    assert circular[1] / circular[0] == pytest.approx(1.03 / 0.97, abs=0.01)


DOWN = {"ceiling": (0.0, 0.0, 1.0), "wall": (0.0, -1.0, 0.0)}


@pytest.mark.parametrize("place", DOWN)
@pytest.mark.long
def test_an_arm_that_does_not_stand_upright_is_weighed(example: SimpleNamespace, tmp_path: Path, place: str) -> None:
    """Gravity is that of the support; an arm on the wall that is said to stand upright is refused."""
    tool = {"gripper": TRUTH["gripper"]}
    example.simulate(
        tmp_path, example_robot(UR5), seed=5, tools=tool, gravity=DOWN[place], relative=0.0, duration_s=10.0
    )
    file = tmp_path / "gripper.toml"
    (load,) = weigh_load(_run(file)).loads
    assert load.mass_kg == pytest.approx(1.3, rel=0.03)
    np.testing.assert_allclose(load.centre_of_mass_m, TRUTH["gripper"][1], atol=0.003)
    if place == "wall":
        text = file.read_text(encoding="utf-8")
        stated = f"gravity_direction = {list(DOWN[place])}"
        assert stated in text
        file.write_text(text.replace(stated, "gravity_direction = [0.0, 0.0, -1.0]"), encoding="utf-8")
        with pytest.raises(FitError, match="no matrix near its prior explains the readings.*gravity_direction"):
            weigh_load(_run(file))


@pytest.mark.long
def test_an_unknown_tool_is_no_point_mass(example: SimpleNamespace, tmp_path: Path) -> None:
    """Its inertia lies within its interval; taken for none it moves the centre of mass, and with that the matrix."""
    tool = {"gripper": TRUTH["gripper"]}
    example.simulate(tmp_path, example_robot(UR5), seed=6, tools=tool, relative=0.0, duration_s=20.0)
    file = tmp_path / "gripper.toml"
    (load,) = weigh_load(_run(file)).loads
    off = np.abs(np.array(load.inertia_kgm2) - 1.3 * 0.04**2 * np.eye(3))
    assert (off < 2.0 * np.array(load.inertia_half_width_95_kgm2)).all()
    point = f"inertia_kgm2 = {np.zeros((3, 3)).tolist()}"
    file.write_text(file.read_text(encoding="utf-8").replace('link = "ee_link"', f'link = "ee_link"\n{point}'))
    (taken,) = weigh_load(_run(file)).loads
    right, wrong = (np.linalg.norm(np.subtract(one.centre_of_mass_m, TRUTH["gripper"][1])) for one in (load, taken))
    assert right < 0.001 < 0.5 * wrong, (right, wrong)


@pytest.mark.parametrize("tool", TRUTH)
def test_accelerations_tell_a_reversed_sense_from_weight(
    arm: tuple[Path, np.ndarray], tmp_path: Path, tool: str
) -> None:
    """With gravity reversed as well weights agree, of a stated tool too; the file as it is has no such doubt."""
    changes = (('"child_to_parent"', '"parent_to_child"'), ("[0.0, 0.0, -1.0]", "[0.0, 0.0, 1.0]"))
    (words,) = reversed_sense(_run(_edited(arm, tmp_path, tool, *changes)))
    assert (
        "measure_direction = 'child_to_parent', with which things fall along [0.0, 0.0, -1.0] of 'base_link'" in words
    )
    assert not list(reversed_sense(_run(arm[0] / f"{tool}.toml")))


def test_a_tool_that_the_urdf_has_too_is_named(arm: tuple[Path, np.ndarray], tmp_path: Path) -> None:
    """Counted twice it is a warning; counted once it is none."""
    assert not any("have it already" in words for words in data_doubts(_run(arm[0] / "weight.toml")))
    file = _edited(arm, tmp_path, "weight", (str(example_robot(UR5).resolve()), "twice.urdf"))
    tool = (
        '<inertial><origin xyz="-0.04 0.05 0.12"/><mass value="2.2"/><inertia ixx="0.003" ixy="0" ixz="0" iyy="0.003" '
    )
    tool += 'iyz="0" izz="0.003"/></inertial>'
    urdf = example_robot(UR5).read_text(encoding="utf-8")
    assert '<link name="ee_link">' in urdf
    urdf = urdf.replace('<link name="ee_link">', f'<link name="ee_link">{tool}')
    (file.parent / "twice.urdf").write_text(urdf, encoding="utf-8")
    assert any("seems to have it already" in words for words in data_doubts(_run(file)))


SECOND = '[[load]]\nname = "other"\nlink = "ee_link"\nmass_kg = 1.0\n'


@pytest.mark.parametrize(
    ("old", "new", "match"),
    [
        ('link = "ee_link"', 'link = "ee_lnk"', "no link 'ee_lnk'; did you mean"),
        ('link = "ee_link"', 'link = "forearm_link"', "whose load no sensor feels"),
        ('link = "ee_link"\n', "", r"load\[0\].link: expected this key, there is none"),
        ('link = "ee_link"\n', 'link = "ee_link"\nframe = "wrist_ft"\n', "frame"),
        ('label = "fit"', 'label = "fit"\nload = "tool"', "no load|load 'tool'|'tool'"),
        ("[[interval]]", f"{SECOND}\n[[interval]]", "load"),
        ("[[interval]]", f'{SECOND.replace("other", "gripper")}\n[[interval]]', "names that differ"),
        ('link = "ee_link"\n', 'link = "ee_link"\nfrom = "x.json"\nmass_kg = 1.0\n', "from says what the load is"),
        ('link = "ee_link"\n', 'link = "ee_link"\nfrom = "none.json"\n', "none.json"),
        ("[[support]]", "[[suport]]", "support"),
    ],
)  # fmt: skip
def test_what_contradicts_is_refused(
    arm: tuple[Path, np.ndarray], tmp_path: Path, old: str, new: str, match: str
) -> None:
    """Each is one line that names the file."""
    text = (arm[0] / "gripper.toml").read_text(encoding="utf-8")
    assert old in text
    (tmp_path / "gripper.toml").write_text(text.replace(old, new, 1), encoding="utf-8")
    shutil.copy(arm[0] / "gripper.csv", tmp_path)
    with pytest.raises(ForceTorqueError, match=match) as caught:
        load_experiment(tmp_path / "gripper.toml")
    assert "\n" not in str(caught.value)


def test_recordings_that_say_different_things_of_one_tool_are_refused(
    arm: tuple[Path, np.ndarray], tmp_path: Path
) -> None:
    """A name is a tool."""
    other = _edited(arm, tmp_path, "gripper", ('name = "gripper"\nlink', 'name = "weight"\nlink'))
    with pytest.raises(ForceTorqueError, match="give another tool another name"):
        weigh_load([_run(arm[0] / "weight.toml"), _run(other)])


EXACT = "[robot]\ntolerance = " + (
    "{ mass_relative = 0, centre_m = 0, joint_zero_deg = 0, tilt_deg = 0, delay_s = 0, mount_deg = 0, mount_m = 0 }\n"
)


@pytest.mark.long
@pytest.mark.parametrize(
    ("tools", "weighed", "robot", "worse", "most"),
    [
        (("gripper",), (), EXACT, (5, 5), 1.25),
        (("gripper",), (), "[robot]\n", (5, 10), 1.2),
        (("gripper", "weight"), (), "[robot]\n", (0, 1), 1.05),
        (("gripper", "weight"), ("weight",), "[robot]\n", (0, 0), 1.0),
    ],
    ids=["exact robot", "one tool", "two tools", "one of two weighed"],
)
def test_pushes_are_read_better_on_many_sensors(
    example: SimpleNamespace,
    tmp_path: Path,
    tools: tuple[str, ...],
    weighed: tuple[str, ...],
    robot: str,
    worse: tuple[int, int],
    most: float,
) -> None:
    """Of forty sensors force and moment of few are read worse than by the maker's matrix, after one tool too.

    That nobody weighed it, on a robot stated as exact: of a rate of one in twenty, which was measured, six of forty or
    more in 1 of 70 runs; of one in four, as while the tool was taken for a point, five or fewer in 1 of 25. Where the
    robot may be wrong more moments stay as they were, within 5 %: eleven of forty or more of a rate of three in twenty
    in 1 of 35 runs, ten or fewer of one in two in 1 of 900.
    """
    ratios = []
    for seed in range(5000, 5040):
        truth = example.simulate(
            tmp_path / str(seed),
            example_robot(UR5),
            seed=seed,
            weighed=weighed,
            tools={tool: TRUTH[tool] for tool in tools},
        )
        for tool in tools:
            file = tmp_path / str(seed) / f"{tool}.toml"
            file.write_text(file.read_text(encoding="utf-8").replace("[robot]\n", robot), encoding="utf-8")
        inverse = np.linalg.inv(truth)
        matrix = example.calibrated(tmp_path / str(seed), tools)
        ratios.append(np.divide(example.push_errors(matrix @ inverse), example.push_errors(inverse)))
    ratio = np.array(ratios)
    assert ((ratio >= 1.0).sum(axis=0) <= worse).all(), (ratio >= 1.0).sum(axis=0)
    assert ratio.max() < most
    assert (ratio.mean(axis=0) < (0.9 if len(tools) == 1 else 0.6)).all(), ratio.mean(axis=0)


ANSWERS = {
    "serial": '"FT-17"',
    "full_scale": "[150, 150, 150, 10, 10, 10]",
    "joint": '"ee_fixed_joint"',
    "measure_direction": '"child_to_parent"',
    "gravity_direction": "[0.0, 0.0, -1.0]",
    "link": '"ee_link"',
}


@pytest.mark.long
def test_answers_to_a_draft_are_enough(example: SimpleNamespace, tmp_path: Path) -> None:
    """From the logs alone, by `init` and the answers to its questions, to a matrix that is better than the maker's."""
    truth = example.simulate(tmp_path, example_robot(UR5), seed=7)
    for tool in TRUTH:
        (tmp_path / f"{tool}.toml").unlink()
    for tool in TRUTH:
        file = tmp_path / f"{tool}.toml"
        text = draft_experiment([tmp_path / f"{tool}.csv"], file, urdf=example_robot(UR5)).content
        for key, answer in (ANSWERS | {"name": f'"{tool}"'}).items():
            text = re.sub(rf'^{key} = "\?"', f"{key} = {answer}", text, flags=re.MULTILINE)
        file.write_text(text.replace('"ft_sensor"', '"wrist_ft"'), encoding="utf-8")
    inverse = np.linalg.inv(truth)
    after = example.push_errors(example.calibrated(tmp_path, tuple(TRUTH)) @ inverse)
    assert (np.array(after) < example.push_errors(inverse)).all()
