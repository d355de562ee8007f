# SPDX-License-Identifier: BSD-3-Clause
"""The verdict on a use: what predicts the error, what judged data say against it, and what is refused."""

from __future__ import annotations

import re
import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, ForceTorqueError, FormatError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.acceptance.acceptance import accept
from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
from forcetorque.evaluation.commands import evaluate
from forcetorque.evaluation.load_cases.load_case import LOADS, LoadCase, operating_load_cases
from forcetorque.evaluation.load_cases.validation_evidence import (
    Evidence,
    SecondMeans,
    compare_with_prior,
    evidence,
    static_loads_text,
    validation_excitation,
)
from forcetorque.evaluation.load_cases.verdict import (
    ADVICE_BY_SOURCE,
    RECORDED,
    LoadCaseAssessment,
    LoadCaseVerdict,
    use_verdicts,
)
from forcetorque.evaluation.section import LOAD_CASES
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.robot.tree import build_tree, outboard_bodies
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, edit
from tests.scenes.robots import joint_xml, link_xml

PUSH = '\n[[load_case]]\nname = "push"\nforce_N = 20.0\nradius_m = 0.2\noffset = "tared"\n'


def _run(arm: Path, more: str = PUSH) -> SensorRun:
    file = arm / PARQUET
    file.write_text(file.read_text() + more)
    return SensorRun(load_experiment(file), "arm_ft")


def _fit(run: SensorRun) -> Calibration:
    return calibrate_sensor(run, code_version="test", created="2026-01-01T00:00:00+00:00")


def _verdict(run: SensorRun, calibration: Calibration) -> LoadCaseVerdict:
    (verdict,) = use_verdicts(run, {"new": calibration})
    return verdict


@pytest.mark.long
def test_a_fit_of_an_arm_that_moves_may_be_used_for_pushes(arm: Path) -> None:
    """The sentence names loads, errors and what is allowed; the parts of the error are those of the matrix."""
    run = _run(arm)
    verdict = _verdict(run, _fit(run))
    force, moment = verdict.errors
    assert verdict.decision == "use"
    assert verdict.message.startswith("use for pushes of 20 N anywhere within 0.2 m of the sensor: force error ")
    assert force.allowed == pytest.approx(1.0)
    assert force.after < force.after_at_most < force.allowed < (force.before or 0.0)
    assert moment.after_at_most < (moment.allowed or 0.0)
    assert force.from_matrix > force.from_noise
    assert force.from_offset == 0.0
    assert np.linalg.norm(force.axes) == pytest.approx(force.after, rel=0.3)


@some_cases(("allowed", "decision"), [(1e-3, "do not use"), (1.0, "use")])
def test_the_same_sensor_is_judged_by_what_is_allowed(arm: Path, allowed: float, decision: str) -> None:
    """An error that cannot be reached is refused, one that is allowed is not."""
    run = _run(arm, f"{PUSH}force_error_N = {allowed}\n")
    assert _verdict(run, _fit(run)).decision == decision


@pytest.mark.long
def test_between_the_two_there_are_not_enough_data(arm: Path) -> None:
    """A requirement at the median of the prediction has an even chance."""
    run = _run(arm)
    calibration = _fit(run)
    typical = _verdict(run, calibration).errors[0].after
    fresh = _run(arm, f"force_error_N = {typical}\n")
    verdict = _verdict(fresh, calibration)
    assert verdict.decision == "not enough data"
    assert verdict.within == pytest.approx(0.5, abs=0.1)
    assert "the chance that both are within what is allowed is" in verdict.message


def test_where_most_of_the_error_comes_from_the_offset_the_tared_load_case_is_given(arm: Path) -> None:
    """A small load makes hardly an error of the matrix; with a tared offset nothing is to be changed."""
    small = PUSH.replace("20.0", "0.5").replace("tared", "fitted")
    run = _run(arm, small)
    calibration = _fit(run)
    typical = _verdict(run, calibration).errors[0]
    assert typical.from_offset > typical.from_matrix
    allowed = f"force_error_N = {typical.after}\nmoment_error_Nm = 10.0\n"
    verdict = _verdict(_run(arm, allowed), calibration)
    assert (verdict.decision, verdict.limited_by) == ("not enough data", "offset")
    assert verdict.tared_load_case is not None
    assert tomllib.loads(verdict.tared_load_case) == tomllib.loads(small.replace("fitted", "tared") + allowed)
    edit(arm / PARQUET, 'offset = "fitted"', 'offset = "tared"')
    assert _verdict(_run(arm, ""), calibration).tared_load_case is None


@pytest.mark.long
def test_a_constant_error_is_red_unless_the_use_allows_it(arm: Path) -> None:
    """An offset that is 6 N off forbids readings with the fitted offset, and not those that are tared."""
    run = _run(arm, PUSH + PUSH.replace('"push"', '"kept"').replace("tared", "fitted"))
    calibration = _fit(run)
    offset = calibration.offset + [0.0, 6.05, 0.0, 0.0, 0.0, 0.0]
    sessions = tuple(one.model_copy(update={"offset": offset}) for one in calibration.sessions)
    shifted = calibration.model_copy(update={"offset": offset, "sessions": sessions})
    tared, kept = use_verdicts(run, {"new": shifted})
    assert (tared.decision, kept.decision) == ("use", "do not use")
    assert re.search(r"6(\.\d)? N of its force error are constant, 0.2 N allowed", kept.message)
    assert 'state offset = "tared"' in kept.message
    # the lines are the load case with that offset
    assert kept.tared_load_case == PUSH.replace('"push"', '"kept"').strip()
    assert tared.tared_load_case is None
    (answer,) = evaluate(run, {"new": shifted}).answers()
    assert answer.why[0] == kept.reasons[0].text  # of several sensors this line alone is shown
    assert answer.why[1].startswith(f"{kept.loads}: force error")
    # negative control: as it was fitted, the predicted errors come first
    (answer,) = evaluate(run, {"new": calibration}).answers()
    assert "force error" in answer.why[0]
    assert "do not use" not in [one.decision for one in use_verdicts(run, {"new": calibration})]


@pytest.mark.long
def test_a_sensor_that_was_turned_is_not_good(arm: Path) -> None:
    """Turned by a quarter after it was calibrated: where the judged data move, and where they stand still."""
    run = _run(arm)
    calibration = _fit(run)
    quarter = np.kron(np.eye(2), [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    turned = calibration.model_copy(update={"matrix": quarter @ calibration.matrix})
    verdict = _verdict(run, turned)
    assert verdict.decision == "do not use"
    assert any("of its force error" in reason.text or "force error is" in reason.text for reason in verdict.reasons)


def test_a_thesis_type_knows_no_error_at_other_loads(arm: Path) -> None:
    """Without a covariance nothing can be said of loads to come."""
    run = _run(arm)
    calibration = calibrate_sensor(run, code_version="test", created="2026-01-01T00:00:00+00:00", regularisation=100.0)
    verdict = _verdict(run, calibration)
    assert (verdict.decision, verdict.errors, verdict.within) == ("not enough data", (), None)
    assert "fit it by the generative model" in verdict.message


@pytest.mark.long
def test_doubts_about_the_fitted_data_forbid_a_plain_use(arm: Path) -> None:
    """A calibration that carries a doubt is never called good."""
    run = _run(arm)
    calibration = _fit(run)
    doubted = calibration.model_copy(update={"warnings": ("gains of 12 %",)})
    assert _verdict(run, calibration).decision == "use"
    assert _verdict(run, doubted).decision == "not enough data"


@pytest.mark.long
def test_without_a_load_case_the_default_is_stated(arm: Path) -> None:
    """An arm is pushed as strongly as what hangs on it."""
    run = _run(arm, "")
    (case,) = operating_load_cases([run])
    assert not case.is_stated
    assert "the weight of the distal links" in case.words
    verdict = _verdict(run, _fit(run))
    assert case.words in verdict.message
    assert not verdict.specified


@pytest.mark.parametrize("gravity", [9.81, 0.02])
def test_the_default_pushes_are_as_heavy_as_the_outboard_links(arm: Path, gravity: float) -> None:
    """However little that is: masses beyond the sensor times gravity, within 0.3 m of it."""
    edit(arm / PARQUET, 'urdf = "arm.urdf"\n', f'urdf = "arm.urdf"\ngravity = {gravity}\n')
    run = _run(arm, "")
    model = run.experiment.model
    tree = build_tree(model, model.root_link)
    beyond = outboard_bodies(tree, tree.cuts["arm_ft"].body)
    mass = sum(inertia.mass for link, inertia in model.links.items() if beyond[tree.frames[link][0]])
    assert 0.1 < mass < sum(inertia.mass for inertia in model.links.values())
    (case,) = operating_load_cases([run])
    assert case.force_N == pytest.approx(mass * gravity, rel=1e-9)
    lever = np.linalg.norm(case.wrench[:, 3:], axis=1) / case.force_N
    assert 0.2 < lever.max() <= 0.3


def test_a_sensor_above_one_of_two_soles_bears_the_robot_by_default(arm: Path) -> None:
    """Its whole weight along the sole, within 5 cm; negative control: one sole alone may be anything."""
    urdf = (arm / "arm.urdf").read_text(encoding="utf-8")
    own = link_xml("l_sole", mass=0.1) + joint_xml("l_sole_joint", "hand", "l_sole", xyz="0 0 -0.1")
    other = link_xml("r_sole", mass=0.1) + joint_xml("r_sole_joint", "base", "r_sole", xyz="0 0.2 0")
    named = []
    for soles in (own, own + other):
        (arm / "arm.urdf").write_text(urdf.replace("</robot>", f"{soles}</robot>"), encoding="utf-8")
        run = _run(arm, "")
        (case,) = operating_load_cases([run])
        named.append(case.name)
    assert named == ["push", "weight of the robot"]
    mass = sum(inertia.mass for inertia in run.experiment.model.links.values())
    np.testing.assert_allclose(case.wrench[:, :3], case.wrench[[0], :3].repeat(len(case.wrench), axis=0), rtol=1e-12)
    assert case.force_N == pytest.approx(mass * run.experiment.processing.gravity, rel=1e-9)
    spread = case.wrench[:, 3:] - case.wrench[:, 3:].mean(axis=0)
    assert 0.5 * 0.05 < np.linalg.norm(spread, axis=1).max() / case.force_N < 1.2 * 0.05


def test_acceptance_holds_the_verdict_to_use(arm: Path) -> None:
    """A load case of its file is accepted where its verdict is `use`; one of the experiment decides nothing."""
    run = _run(arm, f"{PUSH}force_error_N = 1e-6\n")
    calibration = _fit(run)
    for allowed, accepted in ((1.0, True), (1e-3, False)):
        case = {"name": "mine", "force_N": 20.0, "radius_m": 0.2, "offset": "tared", "force_error_N": allowed}
        spec = AcceptanceFile.model_validate({"schema": "forcetorque/acceptance/1", "name": "x", "load_case": [case]})
        result = accept(run, spec, ("new", calibration))
        assert result.accepted is accepted
        assert {row.criterion for row in result.criteria} == {"load_case.mine.force_error", "load_case.mine.use"}


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        (
            'name = "a"\nforce_N = 5000.0\nradius_m = 0.3',
            "load case 'a': reaches .* counts in a channel .* reads up to",
        ),
        ('name = "a"\nforce_N = 5.0\nframe = "hnd"', "frame: robot .* has no link 'hnd'.*hand"),
        ('name = "a"\nforce_N = 5.0\nframe = "hand"\nsensor = "leg"', "sensor: robot .* has no sensor 'leg'"),
        ('name = "a"\nforce_N = 5.0', "force_N needs a frame, or radius_m"),
        ('name = "a"', "expected one of force_N, weight_on, mass_kg, full_scale_share, got none"),
        ('name = "a"\nforce_N = 5.0\nmass_kg = 1.0', "expected one of .*, got force_N, mass_kg"),
        ('name = "a"\nforce_N = 5.0\nradius_m = 0.1\ncentre_of_mass_m = [0, 0, 0.1]', "does not belong to force_N"),
        ('name = "a"\nmass_kg = 1.0', "mass_kg needs centre_of_mass_m"),
        ('name = "a"\nfull_scale_share = 1.5', "at most 1"),
        ('name = "a"\nforce_N = 5.0\nradius_m = 0.1\noffset = "none"', "offset: expected 'fitted' or 'tared'"),
        ('name = "a"\nforce_N = 5.0\nframe = "hand"\ndirection = [0, 0, 0]', "may not be zero"),
    ],
)
def test_a_use_that_cannot_be_is_refused(arm: Path, keys: str, message: str) -> None:
    """In one line that names the table and the key."""
    with pytest.raises((ExperimentError, FormatError), match=message):
        operating_load_cases([_run(arm, f"\n[[load_case]]\n{keys}\n")])


def test_a_use_that_cannot_be_may_leave_the_others_to_be_judged(arm: Path) -> None:
    """By who asks for it; where no other is stated none is taken for granted."""
    giant = PUSH.replace('"push"', '"giant"').replace("force_N = 20.0", "force_N = 5000.0")
    warm = PUSH.replace('"push"', '"warm"') + "changes = { temperature = 5.0 }\n"
    text = (arm / PARQUET).read_text()
    calibration = _fit(_run(arm))
    for cases, judged, refused in ((PUSH + giant + warm, ["push"], ["giant", "warm"]), (giant, [], ["giant"])):
        (arm / PARQUET).write_text(text)
        run = _run(arm, cases)
        with pytest.raises(ForceTorqueError, match="load case 'giant'"):
            use_verdicts(run, {"new": calibration})
        errors: list[ForceTorqueError] = []
        verdicts = use_verdicts(run, {"new": calibration}, refuse=errors.append)
        assert [verdict.load_case for verdict in verdicts] == judged
        assert [str(error).split("'")[1] for error in errors] == refused


@pytest.mark.long
def test_a_default_load_case_that_the_sensor_cannot_read_is_no_part_of_the_verdict(arm: Path) -> None:
    """The answer names it, and the verdict is about the loads of the data that were not fitted, which it could read."""
    edit(arm / PARQUET, 'prior = "', 'full_scale = [300.0, 300.0, 300.0, 7.5, 7.5, 7.5]\nprior = "')
    run = _run(arm, "")
    evaluation = evaluate(run, {"new": _fit(run)})
    (verdict,), (answer,) = evaluation.load_cases, evaluation.answers()
    assert (verdict.load_case, verdict.specified) == ("recorded loads", False)
    assert answer.verdict.endswith("for recorded loads")
    reached = r"no verdict on pushes of \d.* N, .*, which reaches .* in t[xyz], the full scale of 'arm_ft' is 7.5: "
    assert re.match(reached, answer.why[1])
    assert answer.why[1].endswith("state your loads as [[load_case]]")


def test_loads_that_the_sensor_can_read_are_offered_and_lead_on(arm: Path) -> None:
    """The lines are a load case of the file: with them the verdict is on these loads, and the step is another one."""
    edit(arm / PARQUET, 'prior = "', 'full_scale = [300.0, 300.0, 300.0, 7.5, 7.5, 7.5]\nprior = "')
    run = _run(arm, "")
    (case,) = operating_load_cases([run])
    (offered,) = operating_load_cases([_run(arm, f"\n{case.readable}\n")])
    assert offered.is_stated
    assert 0.9 * 7.5 < np.abs(offered.wrench).max(axis=0)[3:].max() <= 7.5
    assert offered.readable == ""
    # negative control: the default load case is beyond the full scale
    assert np.abs(case.wrench).max(axis=0)[3:].max() > 7.5


def test_every_load_case_is_written_with_a_tared_offset(arm: Path) -> None:
    """The lines, read again, are the same loads, limits and changes; so are those of the default load case."""
    cases = (
        'name = "tool"\nmass_kg = 1.0\ncentre_of_mass_m = [0.0, 0.0, 0.1]\nforce_error_N = 2.0\n',
        'name = "hand \u00fc"\nforce_N = 5.0\nframe = "hand"\ndirection = [1, 0, 0]\nchanges = { "a b" = 2.0 }\n',
        None,
    )
    without = (arm / PARQUET).read_text()
    for text in cases:
        (case,) = operating_load_cases([_run(arm, "" if text is None else f"\n[[load_case]]\n{text}")])
        (arm / PARQUET).write_text(without)
        (again,) = operating_load_cases([_run(arm, f"\n{case.tared}\n")])
        assert (case.offset.value, again.offset.value) == ("fitted", "tared")
        # the weight of the default pushes is written with three digits
        np.testing.assert_allclose(again.wrench, case.wrench, rtol=0.0 if text else 5e-3, atol=1e-12)
        assert (again.name, again.changes, again.allowed_force_N) == (case.name, case.changes, case.allowed_force_N)
        (arm / PARQUET).write_text(without)


def test_two_load_cases_of_one_name_are_refused(arm: Path) -> None:
    """In one file, and in the file and the acceptance file."""
    with pytest.raises(ExperimentError, match=r"load_case\[1\]: two load cases are called 'push'"):
        _run(arm, PUSH + PUSH)


def test_pushes_at_a_frame_that_does_not_pass_the_sensor_are_refused(arm: Path) -> None:
    """Where the sensor is named, and where no sensor of the experiment is passed."""
    stated = PUSH.replace("radius_m = 0.2", 'frame = "base"\nsensor = "arm_ft"')
    with pytest.raises(ExperimentError, match="what acts on 'base' does not pass the sensor 'arm_ft'"):
        operating_load_cases([_run(arm, stated)])
    # nor where no sensor is named and it passes none of the experiment's: it would be judged by nobody
    edit(arm / PARQUET, 'sensor = "arm_ft"\n', "")
    run = SensorRun(load_experiment(arm / PARQUET), "arm_ft")
    with pytest.raises(ExperimentError, match="what acts on 'base' does not pass the sensor 'arm_ft'"):
        operating_load_cases([run])


def test_one_name_for_two_uses_is_refused(arm: Path) -> None:
    """Also in the file and in what is asked for besides; the same use twice is one."""
    run = _run(arm)
    (stated,) = run.experiment.section(LOAD_CASES)
    assert len(operating_load_cases([run], [stated])) == 1
    with pytest.raises(ExperimentError, match="two different load cases are called 'push'"):
        operating_load_cases([run], [stated.model_copy(update={"force_error_N": 7.0})])


def test_a_prediction_that_is_too_large_names_what_limits_it(arm: Path) -> None:
    """Its largest source; negative control: nothing limits a load case whose allowed error is large."""
    run = _run(arm)
    calibration, (case,) = _fit(run), operating_load_cases([run])
    tight = LoadCaseAssessment(replace(case, allowed_force_N=1e-3), calibration, None)
    assert tight.after is not None
    sources = tight.after.force.sources
    assert tight.limited_by == max(ADVICE_BY_SOURCE, key=sources.__getitem__)
    wide = replace(case, allowed_force_N=1e6, allowed_moment_Nm=1e6)
    assert LoadCaseAssessment(wide, calibration, None).limited_by is None


def test_a_share_of_recorded_loads_that_hardly_move_forbids_nothing(arm: Path) -> None:
    """Noise is more than a twentieth of next to no load; negative control: loads of that size that a file states."""
    run = _run(arm)
    calibration, still = _fit(run), _evidence(0.0, sway=0.1)
    for name, decision in ((RECORDED, "not enough data"), ("stated", "do not use")):
        case = LoadCase(name=name, words="", wrench=still.moved, is_stated=name != RECORDED)
        assert still.force.rest_at_least > case.requirement[0]
        assessment = LoadCaseAssessment(case, calibration, still)
        assert assessment.verdict()[0] == decision
        force, _ = assessment.errors()
        assert (force.allowed is None) is (name == RECORDED)
        assert (assessment.within is None) is (name == RECORDED)


def _evidence(*offsets: float, sway: float = 10.0, sessions: str = "abc", turned: bool = False) -> Evidence:
    """Recordings of 30 s, each with its own constant error along x and a load that sways, read as along y if turned."""
    rng = np.random.default_rng(4)
    time = 0.1 * np.arange(300)
    stretches = []
    for k, (offset, session) in enumerate(zip(offsets, sessions, strict=False)):
        reference = np.zeros((300, 6))
        reference[:, 0] = 40.0 * (k + 1) + sway * np.sin(time)
        error = 0.01 * rng.normal(size=(300, 6)) + [offset, 0.0, 0.0, 0.0, 0.0, 0.0]
        measured = (reference[:, [1, 0, 2, 3, 4, 5]] if turned else reference) + error
        stretches.append(SecondMeans.of(session, [(time, measured - reference, reference)]))
    return evidence(stretches)


def test_constant_errors_of_two_recordings_do_not_cancel() -> None:
    """8 N and -8 N are 8 N; negative control: none is none."""
    assert _evidence(8.0, -8.0).force.constant_at_least > 7.5
    assert _evidence(8.0, 0.0).force.constant_at_least > 7.5
    assert _evidence(0.0, 0.0).force.constant_at_least < 0.05


def _static_loads(measured: Evidence) -> str | None:
    return static_loads_text(*validation_excitation(measured.reference, [], moved=measured.moved))


def test_recordings_of_two_sessions_at_rest_in_several_postures_do_not_move() -> None:
    """The load differs by 40 N between them, and moves in neither: each has its own offset, which takes that up."""
    still, swaying = (_evidence(0.0, 0.0, sway=sway) for sway in (0.0, 10.0))
    assert _static_loads(still) is not None
    assert "forces" not in (_static_loads(swaying) or "")
    # and a sensor that is turned passes there
    assert _evidence(0.0, 0.0, sway=0.0, turned=True).force.rest < 0.05


def test_postures_of_one_session_move_and_show_a_sensor_that_is_turned() -> None:
    """In one session the offset is the same, so 40 N from one recording to the next are 40 N more or an error."""
    moved = _evidence(0.0, 0.0, sway=0.0, sessions="aa")
    assert "forces" not in (_static_loads(moved) or "")
    assert moved.force.rest < 0.05
    assert _evidence(0.0, 0.0, sway=0.0, sessions="aa", turned=True).force.rest > 20.0
    # nor do constant errors hide that cancel each other in the mean of a session
    assert _evidence(8.0, -8.0, sessions="aa").force.rest > 7.5


@pytest.mark.long
def test_a_trifle_worse_than_the_prior_is_no_reason(arm: Path) -> None:
    """Neither is a quantity that is not judged; an error by a half larger is one."""
    run = _run(arm, f"{PUSH}force_error_N = 5.0\n")
    calibration = _fit(run)
    row = compare_with_prior(run, {"new": calibration})[0].model_copy(update={"prior_mean": 1.0})
    (case,) = operating_load_cases([run])
    for quantity, mean, forbidden in (("force", 1.1, False), ("force", 1.5, True), ("moment", 1.5, False)):
        worse = [row.model_copy(update={"mean": mean, "quantity": quantity})]
        decision, _ = LoadCaseAssessment(case, calibration, _evidence(0.0), worse=worse).verdict()
        assert (decision == "do not use") is forbidden


@pytest.mark.long
def test_judged_data_of_a_moment_test_nothing(arm: Path) -> None:
    """Less than five seconds are said to be too short, and do not stop the evaluation."""
    edit(arm / PARQUET, "end_s = 23.5", "end_s = 14.8")
    run = _run(arm)
    verdict = _verdict(run, _fit(run))
    assert verdict.decision == "not enough data"
    assert any("too short to test it" in reason.text for reason in verdict.reasons)


def test_loads_at_points_of_a_frame_have_the_levers_of_that_frame(arm: Path) -> None:
    """Tools at opposite points have their mean lever at the origin, where pushes along a direction act too."""
    postures = np.arange(LOADS) % 41

    def positions(keys: str) -> np.ndarray:
        (case,) = operating_load_cases([SensorRun(load_experiment(_written(keys)), "arm_ft")])
        levers = []
        for k in range(41):
            force, moment = np.split(case.wrench[postures == k], 2, axis=1)
            equations = np.concatenate([-np.cross(one, np.eye(3)).T for one in force])  # p x f
            solution, _, rank, _ = np.linalg.lstsq(equations, moment.reshape(-1))
            assert rank == 3
            np.testing.assert_allclose(equations @ solution, moment.reshape(-1), atol=1e-9)
            levers.append(solution)
        return np.array(levers)

    text = (arm / PARQUET).read_text()

    def _written(keys: str) -> Path:
        (arm / PARQUET).write_text(f'{text}\n[[load_case]]\nname = "a"\nframe = "hand"\n{keys}\n')
        return arm / PARQUET

    centre = np.array([0.02, -0.05, 0.1])
    origin = positions("force_N = 5.0")
    there, opposite = (positions(f"mass_kg = 0.5\ncentre_of_mass_m = {(s * centre).tolist()}") for s in (1.0, -1.0))
    np.testing.assert_allclose((there + opposite) / 2.0, origin, atol=1e-9)
    np.testing.assert_allclose(np.linalg.norm(there - origin, axis=1), np.linalg.norm(centre), atol=1e-9)
    (along,) = operating_load_cases(
        [SensorRun(load_experiment(_written("force_N = 5.0\ndirection = [1, 0, 0]")), "arm_ft")]
    )
    np.testing.assert_allclose(along.wrench[:, 3:], np.cross(origin[postures], along.wrench[:, :3]), atol=1e-9)
    assert np.linalg.norm(origin, axis=1).min() > 0.01  # else the sign of the position would not matter
