# SPDX-License-Identifier: BSD-3-Clause
"""All sensors at once, feet on the ground: against true wrenches of other motions, and against the prior matrices."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.calibration.joint.fit import fit_jointly
from forcetorque.calibration.joint.model_error_columns import (
    delay_terms,
    error_terms,
    model_error_columns,
    weight_error_columns,
)
from forcetorque.calibration.joint.robust_fit import (
    ROUNDS,
    JointResult,
    PartResidual,
    UntouchedStretch,
    fit_stretches,
    residuals,
    residuals_by,
)
from forcetorque.calibration.joint.unknowns import EVEN, UNITS, JointFit
from forcetorque.calibration.joint.windows import part_windows
from forcetorque.experiment.calibration.robot_model_error import EXACT, MASS, ModelTolerance
from forcetorque.robot.mechanics.sub_model_equations import untouched_parts, weight_equations
from forcetorque.robot.motion import JointMotion, RootMotion
from tests.calibration.joint.swaying import FEET, SENSORS, Swaying, swaying, touches

WRONG = {"mass": 0.02, "centre_m": 0.002, "joint_zero_rad": float(np.radians(0.3)), "acceleration": 0.05}
"""A robot that is not quite that of its file."""


def _calibrated(*motions: Swaying, tolerance: ModelTolerance | None = None) -> JointResult:
    parts = untouched_parts(motions[0].stretch.tree, SENSORS, FEET)
    return fit_stretches([UntouchedStretch(stretch=one.stretch, parts=parts) for one in motions], tolerance)


def _fit(*motions: Swaying, tolerance: ModelTolerance | None = None) -> JointFit:
    return _calibrated(*motions, tolerance=tolerance).fit


@cache
def _of_wrong_model(seed: int) -> JointFit:
    """The fit of one motion of a robot that is not quite that of its file."""
    return _fit(swaying(seed, **WRONG))


def _errors(fit: JointFit, motion: Swaying) -> np.ndarray:
    """Error over that of the prior, by sensor, of force and moment; shape (6, 2)."""
    return np.array(
        [motion.error(name, fit.change(name), fit.offset(name, "day")) / motion.prior_error(name) for name in SENSORS]
    )


def test_without_noise_the_truth_is_found_in_any_motion() -> None:
    """All six matrices and offsets, from one motion with unknown foot wrenches, judged in another."""
    fit = _fit(swaying(1, noise=0.0), tolerance=EXACT)
    assert _errors(fit, swaying(2, sensor_seed=1, noise=0.0)).max() < 0.02
    true = swaying(1, noise=0.0)
    for name in SENSORS[:4]:
        np.testing.assert_allclose(
            fit.change(name) / UNITS[:, None] * UNITS, true.change[name] / UNITS[:, None] * UNITS, atol=2e-3
        )
        np.testing.assert_allclose(fit.offset(name, "day") / UNITS, true.offset[name] / UNITS, atol=0.1)


@pytest.mark.parametrize("seed", [11, pytest.param(12, marks=pytest.mark.long)])
@pytest.mark.long
def test_with_a_wrong_model_other_motions_are_read_better_than_by_the_prior(seed: int) -> None:
    """Noise, masses, centres, joint zeros and accelerometer off: no sensor is worse, legs and feet far better."""
    fit = _of_wrong_model(seed)
    ratios = _errors(fit, swaying(seed + 100, sensor_seed=seed, **WRONG))
    assert ratios.max() < 1.0
    assert np.median(ratios[:4]) < 0.35


@pytest.mark.long
def test_more_motions_teach_more_where_the_mass_is_known() -> None:
    """Moments of recordings add up. Where it is not, more data leave the share of gain and mass as it was."""
    motions = [swaying(11 + 100 * k, sensor_seed=11, joint_zero_rad=WRONG["joint_zero_rad"]) for k in range(3)]
    known = ModelTolerance(mass=0.0, centre_m=0.0)
    other = swaying(911, sensor_seed=11, joint_zero_rad=WRONG["joint_zero_rad"])
    three, one = (_errors(_fit(*motions[:count], tolerance=known), other) for count in (3, 1))
    assert np.mean(three[:4]) < np.mean(one[:4])


@pytest.mark.long
def test_the_predicted_error_is_about_the_true_one() -> None:
    """Over six specimens, of loads of 50 N and 5 N m along every axis; 1 would be exact."""
    motions = [swaying(seed, **WRONG) for seed in range(21, 27)]
    ratios = [_push_error_over_predicted(_fit(motion), motion) for motion in motions]
    assert 0.5 < float(np.sqrt(np.mean(np.square(ratios)))) < 1.5


@pytest.mark.long
def test_a_model_that_is_taken_for_exact_is_believed_too_much() -> None:
    """Negative control of the tolerances: without them the predicted error is far too small."""
    motion = swaying(21, **WRONG)
    assert _push_error_over_predicted(_fit(motion, tolerance=EXACT), motion) > 2.0


def _push_error_over_predicted(fit: JointFit, motion: Swaying) -> float:
    """Of loads of 50 N and 5 N m along every axis of every sensor, root mean square."""
    squares, loads = [], 50.0 * np.diag(UNITS)
    for name in SENSORS:
        error = ((fit.change(name) @ np.linalg.inv(motion.change[name]) - np.eye(6)) @ loads).T
        spread = np.sqrt(np.einsum("kii->ki", fit.error_covariance(name, loads)))
        squares.append((error / spread) ** 2)
    return float(np.sqrt(np.mean(squares)))


@pytest.mark.long
def test_a_touch_is_left_out_and_does_little_harm() -> None:
    """A push of 40 N for a second on a hand, which should be free: its arm leaves, for that time, and nothing else."""
    push = np.zeros((2000, 6))
    push[900:1000, 0] = 40.0 * np.sin(np.linspace(0.0, np.pi, 100))
    pushed = swaying(11, touches={"l_hand": push}, **WRONG)
    other = swaying(151, sensor_seed=11, **WRONG)
    result = _calibrated(pushed)
    spans = touches(result)
    assert any(one.start_s < 9.5 < one.end_s for one in spans if one.sub_model == "l_arm_ft")
    assert sum(one.end_s - one.start_s for one in spans) < 8.0
    assert _errors(result.fit, other).mean() < 1.2 * _errors(_of_wrong_model(11), other).mean()
    # negative control: a fit that believes all windows errs more at that arm
    windows = part_windows(pushed.stretch, untouched_parts(pushed.stretch.tree, SENSORS, FEET), ())
    believing = fit_jointly(windows)
    assert _errors(believing, other)[4].max() > 2.0 * _errors(result.fit, other)[4].max()


@pytest.mark.long
def test_a_body_that_is_heavier_than_its_file_says_is_found() -> None:
    """A mass is told where the sensors do not stand for it: the posterior is narrower than the prior."""
    terms = _of_wrong_model(11).model_errors()
    assert {"mass of root_link", "zero of l_knee"} <= {term.name for term, _, _ in terms}
    assert all(deviation <= term.deviation * (1.0 + 1e-9) for term, _, deviation in terms)
    assert min(deviation / term.deviation for term, _, deviation in terms) < 0.5


@pytest.mark.long
def test_masses_of_what_is_weighed_add_up_to_its_weight() -> None:
    """Along the axes of the root, also of bodies that joints between the sensors turn."""
    stretch = swaying(1).stretch
    for part in untouched_parts(stretch.tree, SENSORS, FEET):
        (equation,) = weight_equations(stretch.tree, [part], stretch.joints, stretch.root)
        columns = weight_error_columns(stretch.tree, part, stretch.root, len(stretch))
        assert np.abs(equation.demand[:, :3]).max() > 1.0
        of_masses = sum(values for name, values in columns.items() if name.startswith(MASS))
        np.testing.assert_allclose(-of_masses, equation.demand, atol=1e-9)


def test_errors_of_a_weight_are_those_of_the_whole_equation_at_rest() -> None:
    """Forces of masses, acceleration and joint zeros by closed form, and by the derivatives of the dynamics."""
    stretch = swaying(51, duration_s=0.1).stretch
    joints, compared = JointMotion.at_rest(stretch.joints.names, stretch.joints.position), 0
    for part in untouched_parts(stretch.tree, SENSORS, FEET):
        root = RootMotion.fixed([0.48, -0.6, -0.64], gravity=9.81)
        whole = model_error_columns(stretch.tree, part, joints, root)
        for name, values in weight_error_columns(stretch.tree, part, root, len(stretch)).items():
            np.testing.assert_allclose(values[:, :3], whole[name][:, :3], atol=1e-9)
            compared += bool(np.abs(values).max() > 1.0)
    assert compared > 6


def test_a_robot_that_hardly_moves_keeps_its_priors() -> None:
    """Nothing is learnt of what no load tells, and nothing gets worse."""
    stretch = swaying(41, duration_s=0.6, **WRONG).stretch
    parts = untouched_parts(stretch.tree, SENSORS, FEET)
    terms = error_terms(stretch.tree, parts, ModelTolerance())
    fit = fit_jointly(part_windows(stretch, parts, terms), terms)
    for name in SENSORS:
        assert np.abs((fit.change(name) - np.eye(6)) / UNITS[:, None] * UNITS).max() < 0.1
    with pytest.raises(FitError, match="no window of any part"):
        fit_jointly([])


@pytest.mark.long
def test_equations_about_fits_that_are_near_to_each_other_leave_the_same() -> None:
    """To second order: what a fiftieth of the errors of the model does is the same by both but for a small part."""
    stretch = swaying(11, duration_s=2.0, **WRONG).stretch
    parts = untouched_parts(stretch.tree, SENSORS, FEET)
    terms = error_terms(stretch.tree, parts, ModelTolerance())[::4]
    fit = None
    for _ in range(2):
        fit = fit_jointly(part_windows(stretch, parts, terms, about=fit), terms, about=fit)
    mean = fit.mean.copy()
    mean[fit.places.errors] *= 1.02
    near = replace(fit, mean=mean)
    of_fits = (part_windows(stretch, parts, terms, about=one) for one in (fit, near))
    for by_fit, by_near in zip(*of_fits, strict=True):
        first, second = residuals(by_fit, near), residuals(by_near, near)
        assert np.abs(second - first).max() < 0.05 * np.abs(residuals(by_fit, fit) - first).max()


def test_what_is_left_is_carried_to_the_sensor_that_alone_is_to_blame() -> None:
    """An error of 3 N and -0.7 N m of one reading comes back as that, in N and N m, at that sensor."""
    stretch = swaying(1, duration_s=2.0).stretch
    parts = untouched_parts(stretch.tree, SENSORS, FEET)
    error = np.array([3.0, 0.0, -1.0, 0.2, -0.7, 0.0])
    seen = 0
    for windows in part_windows(stretch, parts, ()):
        kept = np.ones(len(windows), dtype=np.bool_)
        blocks = windows.offsets.reshape(len(windows), 6, len(windows.sensors), 6)
        for place in range(len(windows.sensors)):
            left = PartResidual.of(windows, blocks[:, :, place] @ (error / UNITS), kept, {})
            if windows.rows.all():
                np.testing.assert_allclose(left.at_sensors[:, place], np.tile(error, (len(windows), 1)), atol=1e-9)
                seen += 1
    assert seen >= 4


def test_a_fit_leaves_what_its_matrices_and_offsets_do() -> None:
    """Of an exact model, in N and N m as in the units of the fit; offsets that suit best leave less yet."""
    stretch = swaying(1, duration_s=2.0).stretch
    windows = tuple(part_windows(stretch, untouched_parts(stretch.tree, SENSORS, FEET), ()))
    fit = fit_jointly(windows)
    for one in windows:
        factors = {name: fit.change(name) for name in one.sensors}
        offsets = {name: fit.offset(name, "day") for name in one.sensors}
        left = residuals_by(one, factors, offsets)
        np.testing.assert_allclose(left, residuals(one, fit), atol=1e-9)
        assert (residuals_by(one, factors, None) ** 2).sum() <= (left**2).sum() * (1.0 + 1e-9)
        # negative control: without offsets some newtons are left
        nothing = {name: np.zeros(6) for name in one.sensors}
        assert np.abs(residuals_by(one, factors, nothing) - left).max() > 0.5


@pytest.mark.long
def test_equations_are_made_linear_three_times() -> None:
    """About the model, and twice about the fit before."""
    stretch = swaying(1, duration_s=1.0).stretch
    parts = untouched_parts(stretch.tree, SENSORS, FEET)
    said: list[str] = []
    fit_stretches([UntouchedStretch(stretch=stretch, parts=parts)], EXACT, progress=said.append)
    assert [words[-12:] for words in said[1:]] == ["round 2 of 3", "round 3 of 3"]


def test_a_recording_has_a_delay_where_one_may_be() -> None:
    """Once, however many intervals it has; none where clocks are exact."""
    (first, second) = delay_terms(["a", "b", "a"], ModelTolerance(delay_s=0.01))
    assert (first.deviation, first.unit, second.deviation) == (0.01, "s", 0.01)
    assert (first.name[-1], second.name[-1]) == ("a", "b")
    assert delay_terms(["a", "b"], ModelTolerance(delay_s=0.0)) == ()


@pytest.mark.long
def test_evidence_widens_the_predicted_error_but_not_the_estimate() -> None:
    """Changes of 2.5 times the expected size: the estimate is that of the expected size, its error that of the true."""
    motion = swaying(51, duration_s=8.0, noise=0.3, error=0.15)
    parts, about = untouched_parts(motion.stretch.tree, SENSORS, FEET), None
    for _ in range(ROUNDS):
        windows = list(part_windows(motion.stretch, parts, (), about=about))
        fit, held = fit_jointly(windows, about=about), fit_jointly(windows, about=about, widened=False)
        about = held
    expected = EVEN.scales[0].expected
    for name in SENSORS:
        assert np.diag(fit.prior_covariance(name)).mean() > (1.9 * expected) ** 2
        np.testing.assert_allclose(_changes(fit, name), _changes(held, name), rtol=1e-12)
    assert 0.7 < _error_over_predicted(fit, motion) < 1.3
    # negative control: as if the changes were as small as expected
    assert _error_over_predicted(held, motion) > 1.7


def _changes(fit: JointFit, sensor: str) -> FloatArray:
    return fit.mean[fit.places.changes(sensor)]


def _error_over_predicted(fit: JointFit, motion: Swaying) -> float:
    """Of all changes, root mean square."""
    ratios = []
    for name in SENSORS:
        error = _changes(fit, name) - ((motion.change[name] - np.eye(6)) / UNITS[:, None] * UNITS).ravel()
        ratios.append(error**2 / np.diag(fit.covariance)[fit.places.changes(name)])
    return float(np.sqrt(np.mean(ratios)))
