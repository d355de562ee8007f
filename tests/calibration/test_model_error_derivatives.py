# SPDX-License-Identifier: BSD-3-Clause
"""Derivatives of expected wrenches by the robot model, and the calibration that estimates its errors."""

from __future__ import annotations

import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.base.noise.window_means import means_over
from forcetorque.base.pose import rotation_about_z
from forcetorque.calibration.answers import calibration_answer
from forcetorque.calibration.calibrate import calibrate_sensor, fit_doubts
from forcetorque.calibration.generative.fit import GenerativeFit, SolvedRows, fit_generative
from forcetorque.calibration.model_error_derivatives import SAMPLES_PER_WINDOW, model_columns
from forcetorque.calibration.reduced_recordings import recording_moments
from forcetorque.experiment.calibration import expected_sensor_errors
from forcetorque.experiment.calibration.calibration_file import Calibration, read_calibration
from forcetorque.experiment.calibration.expected_sensor_errors import Scale
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.experiment.calibration.robot_model_error import (
    OF_CABLES,
    ErrorTerm,
    ModelError,
    ModelTolerance,
    TermKind,
)
from forcetorque.experiment.calibration.stored_moments import IntervalMoments, RecordingMoments, read_moments
from forcetorque.experiment.interval_samples import IntervalSamples
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Use
from forcetorque.robot.model import RobotModel
from forcetorque.robot.modified_robot import RobotErrors
from tests.calibration.synthetic import LIMIT_COUNTS, PRIOR, anyhow, assumptions as assumed, read_by
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET

HAND = ("hand", "tool")
"""Links of one body: the tool is at a fixed joint, with the axes of the hand."""
STEP = 1e-4
"""Step of the central differences: their own error is its square."""
EXACT = 'tolerance = "exact"\n'
"""Line of the scene's experiment file."""
ALL, SAMPLED = 1e-3, 0.1
"""Share of a column by which it may differ: at all samples by the steps of both, at ten of a window by sampling."""


def _run(folder: Path, robot: str = "tolerance = {}\n") -> SensorRun:
    text = (folder / PARQUET).read_text(encoding="utf-8").replace(EXACT, robot)
    (folder / "own.toml").write_text(text, encoding="utf-8")
    return SensorRun(load_experiment(folder / "own.toml"), "arm_ft")


def _expected(run: SensorRun, model: RobotModel) -> FloatArray:
    """Window means of what the sensor must read by another robot, its log being the same."""
    other = SensorRun(replace(run.experiment, model=model), run.sensor)
    (samples,) = other.samples(Use.CALIBRATION)
    return means_over(samples.data_set.time_s, samples.data_set.reference)[1]


@pytest.mark.parametrize(
    ("name", "kind"),
    [("mass of hand", "mass"), ("y of centre of hand", "centre"), ("zero of wrist", "zero"), ("zero of elbow", "zero")],
)
@pytest.mark.parametrize(("samples_per_window", "close"), [(1_000, ALL), (SAMPLES_PER_WINDOW, SAMPLED)])
def test_columns_are_differences_between_robots(
    arm: Path, monkeypatch: pytest.MonkeyPatch, name: str, kind: str, samples_per_window: int, close: float
) -> None:
    """By the readable dynamics of robots whose mass, centre or zero differs; a column of another name is no match."""
    monkeypatch.setattr("forcetorque.calibration.model_error_derivatives.SAMPLES_PER_WINDOW", samples_per_window)
    run = _run(arm)
    (samples,) = run.samples(Use.CALIBRATION)
    by_name = _columns(run, samples)

    def robot(step: float) -> RobotModel:
        model = run.experiment.model
        if kind == "centre":  # the second moment about the origin of the link stays
            own, mass = model.links[HAND[0]], sum(model.links[link].mass for link in HAND)
            moved = {HAND[0]: replace(own, first_moment=own.first_moment + mass * np.array([0.0, step, 0.0]))}
            return replace(model, links={**model.links, **moved})
        zero = {} if kind == "mass" else {name.removeprefix("zero of "): step}
        masses = dict.fromkeys(HAND, step) if kind == "mass" else {}
        return RobotErrors(mass=masses, centre_m={}, joint_zero_rad=zero).applied_to(model)

    difference = (_expected(run, robot(STEP)) - _expected(run, robot(-STEP))) / (2.0 * STEP)
    size = np.abs(difference).max()
    assert size > 0.0
    np.testing.assert_allclose(by_name.pop(name), difference, rtol=0.0, atol=close * size)
    assert all(np.abs(other - difference).max() > 3.0 * close * size for other in by_name.values())


def _positions(run: SensorRun, samples: IntervalSamples) -> dict[str, FloatArray]:
    """Mean position of every logged joint in windows; shape (w,) each; rad."""
    stream = run.experiment.recording.stream("joints")
    logged, at_s = stream.signal("position"), samples.data_set.time_s
    of_samples = np.column_stack([np.interp(at_s, stream.stamp_ns * 1e-9, own) for own in logged.values.T])
    return dict(zip(logged.columns, means_over(at_s, of_samples)[1].T, strict=True))


def test_cables_pull_and_twist_in_proportion_to_positions(arm: Path) -> None:
    """Along one axis each; of the joints near the sensor, and of none where the file says that there are no cables."""
    run = _run(arm)
    (samples,) = run.samples(Use.CALIBRATION)
    of_cables = {name: own for name, own in _columns(run, samples).items() if " of cables at " in name}
    positions = _positions(run, samples)
    assert {name.rpartition(" ")[2] for name in of_cables} <= positions.keys()
    for name, column in of_cables.items():
        component = "xyz".index(name[0]) + (3 if "twist" in name else 0)
        np.testing.assert_allclose(column[:, component], positions[name.rpartition(" ")[2]], atol=SAMPLED)
        assert not np.delete(column, component, axis=1).any()
    without = _run(arm, "tolerance = { cable_N_rad = 0 }\n")
    assert _columns(without, samples).keys() == _columns(run, samples).keys() - of_cables.keys()


def _with_pull(run: SensorRun, interval: IntervalMoments, pull: FloatArray) -> IntervalMoments:
    """An interval in which something pulls beside the load; pull of shape (w, 6); N, N m."""
    assert run.sensor.prior is not None
    return interval.model_copy(update={"raw": interval.raw + pull @ np.linalg.inv(run.sensor.prior).T})


def _with_terms(interval: IntervalMoments, kept: Callable[[ErrorTerm], bool]) -> IntervalMoments:
    """An interval with some of its terms of the robot model."""
    used, columns = [k for k, term in enumerate(interval.terms) if kept(term)], interval.means.model
    assert columns is not None
    return interval.with_model(tuple(interval.terms[k] for k in used), columns[:, :, used])


def _of_model(term: ErrorTerm) -> bool:
    return term.kind not in OF_CABLES


def test_a_cable_does_not_pass_for_response(arm: Path) -> None:
    """Cables of 2 N/rad change the matrix by a third of what they change where they are no unknowns, and are named."""
    run = _run(arm)
    (samples,) = run.samples(Use.CALIBRATION)
    (moments,) = recording_moments(run)
    (clean,) = moments.intervals
    rng = np.random.default_rng(3)
    pulls = [np.outer(own, rng.normal(size=6) * ([2.0] * 3 + [0.1] * 3)) for own in _positions(run, samples).values()]
    changes, named = [], []
    for known in (True, False):
        matrices = []
        for load in (np.zeros_like(pulls[0]), np.sum(pulls, axis=0)):
            one = _with_pull(run, clean if known else _with_terms(clean, _of_model), load)
            stored = moments.model_copy(update={"intervals": (one,)})
            fit = calibrate_sensor(None, moments=[stored], code_version="1", created="now")
            assert fit.secondary_matrix() is not None
            matrices.append(np.asarray(fit.secondary_matrix())[:3, :3])
        changes.append(np.abs(matrices[1] - matrices[0]).max())
        named.append(any(error.is_suspicious and "cables" in error.name for error in fit.model_errors))
    assert changes[0] < changes[1] / 3.0
    assert named == [True, False]


def test_the_residual_is_stated_with_cables_and_without(arm: Path) -> None:
    """Cables stay in the residual against the robot model as stated; what the fit leaves of it is the sensor's noise.

    The noise of the simulated sensor is 4 counts, of which means over a second keep a seventh.
    """
    run = _run(arm)
    (samples,) = run.samples(Use.CALIBRATION)
    (moments,) = recording_moments(run)
    (clean,) = moments.intervals
    pull = np.outer(_positions(run, samples)["elbow"], [2.0, -2.0, 1.0, 0.1, 0.0, 0.1])
    pulled = _with_pull(run, clean, pull)
    unknown = _with_terms(pulled, _of_model)
    exact = clean.model_copy(update={"terms": (), "model": None})
    fits = [
        calibrate_sensor(None, moments=[moments.model_copy(update={"intervals": (one,)})], code_version="1", created="")
        for one in (clean, pulled, unknown, exact)
    ]
    residual = [float(np.linalg.norm(fit.residual_rms[:3])) for fit in fits]
    noise = [np.nan if fit.noise_rms is None else float(np.linalg.norm(fit.noise_rms[:3])) for fit in fits]
    assert residual[1] > 5.0 * residual[0]
    assert noise[1] < 0.1
    assert noise[1] < 3.0 * noise[0]
    assert noise[2] > 0.5 * residual[2] > 5.0 * noise[1]
    assert fits[3].noise_rms is None
    lines = [calibration_answer(fit, None, "own.json", saved=True, doubtful=False).why[0] for fit in fits]
    assert f"{residual[1]:.2f} N, " in lines[1]
    assert " (RMS of the norm) against the robot model as stated, " in lines[1]
    assert f", {noise[1]:.2f} N, " in lines[1]
    assert lines[1].endswith(" N m with its errors and cables as found")
    assert lines[2].endswith(" N m with its errors as found")
    assert lines[3].endswith("(RMS of the norm)")


def test_a_model_that_is_exact_has_no_columns(arm: Path) -> None:
    """Stated as exact, and with 0 for all, there are none; for one link or joint, its columns alone are missing."""
    none = "tolerance = { mass_relative = 0, centre_m = 0, joint_zero_deg = 0, tilt_deg = 0, delay_s = 0 }\n"
    for text in (EXACT, none):
        run = _run(arm, text)
        (samples,) = run.samples(Use.CALIBRATION)
        assert _columns(run, samples) == {}
        assert _calibrated(run).model_errors == ()
    one = _run(arm, "tolerance = { links = { hand = 0.0, tool = 0.0 }, joints = { wrist = 2.0 } }\n")
    terms = {term.name: term for term in model_columns(one, samples.interval, samples.data_set)[0]}
    assert "mass of hand" not in terms
    assert terms["zero of wrist"].deviation == pytest.approx(np.radians(2.0))
    assert terms["zero of elbow"].deviation == pytest.approx(np.radians(0.5))


@pytest.mark.long
def test_a_model_may_be_off_where_the_file_says_nothing(arm: Path) -> None:
    """By the same tolerances as with an empty table."""
    silent, stated = _run(arm, ""), _run(arm)
    assert silent.experiment.fit_options.tolerance == stated.experiment.fit_options.tolerance == ModelTolerance()
    assert _calibrated(silent).model_errors == _calibrated(stated).model_errors != ()


def test_a_link_and_a_joint_of_one_name_have_tolerances_of_their_own(arm: Path) -> None:
    """Neither overwrites the other."""
    run = _run(arm, "tolerance = { links = { hand = 0.01, tool = 0.01 }, joints = { wrist = 20.0 } }\n")
    tolerance = run.experiment.fit_options.tolerance
    assert (tolerance.links, tolerance.joints) == ({"hand": 0.01, "tool": 0.01}, {"wrist": np.radians(20.0)})


@pytest.mark.parametrize("load_kg", [0.5, 0.8, 1.6])
def test_an_attached_load_is_no_error_of_a_link(arm: Path, load_kg: float) -> None:
    """Masses and centres stay those of the robot, also where the load makes another link of the body the heaviest."""
    run = _run(arm)
    (samples,) = run.samples(Use.CALIBRATION)
    of_bare = _columns(run, samples)
    file = arm / "own.toml"
    load = f'\n[[load]]\nlink = "tool"\nmass_kg = {load_kg}\ncentre_of_mass_m = [0.0, 0.0, 0.0]\n'
    file.write_text(file.read_text(encoding="utf-8") + load, encoding="utf-8")
    run = SensorRun(load_experiment(file), "arm_ft")
    (samples,) = run.samples(Use.CALIBRATION)
    of_loaded = _columns(run, samples)
    np.testing.assert_allclose(of_loaded["mass of hand"], of_bare["mass of hand"], rtol=1e-9)
    assert np.abs(of_loaded["zero of wrist"]).max() > np.abs(of_bare["zero of wrist"]).max()


@pytest.mark.long
def test_recordings_with_and_without_tolerances_are_a_warning(arm: Path) -> None:
    """By the names of the intervals in which the model is taken as exact."""
    uncertain, exact = recording_moments(_run(arm))[0], recording_moments(_run(arm, EXACT))[0]
    (interval,) = exact.intervals
    # without a content nobody tells that its readings are the same
    named = interval.interval.model_copy(update={"label": "other", "content": None})
    apart = interval.model_copy(update={"interval": named, "recording": "other day"})
    both = [uncertain, exact.model_copy(update={"intervals": (apart,)})]
    fit = calibrate_sensor(None, moments=both, code_version="1", created="now")
    assert any("taken as exact in other day: other" in doubt for doubt in fit.warnings)


def test_moments_without_cables_beside_others_are_a_warning(arm: Path) -> None:
    """As an earlier version stored them; not where all are without, nor where one recording has no joint that turns."""
    (moments,) = recording_moments(_run(arm))
    (interval,) = moments.intervals

    def beside(kept: Callable[[ErrorTerm], bool]) -> RecordingMoments:
        named = interval.interval.model_copy(update={"label": "other", "content": None})
        apart = _with_terms(interval, kept).model_copy(update={"interval": named, "recording": "other day"})
        return moments.model_copy(update={"intervals": (apart,), "experiment": "other day"})

    def said(*recordings: RecordingMoments) -> list[str]:
        fit = calibrate_sensor(None, moments=recordings, code_version="1", created="now")
        return [warning for warning in fit.warnings if "cables" in warning]

    before = beside(_of_model)
    before.save(arm / "before.json")
    (warning,) = said(moments, read_moments(arm / "before.json"))
    assert "the moments of other day: other have no pulls of cables" in warning
    assert "calibrate from the recordings anew" in warning
    assert not said(moments, beside(lambda _: True))
    assert not said(before)
    assert not said(moments, beside(lambda term: term.kind is TermKind.MASS))


def test_joints_at_zero_have_cables(arm: Path) -> None:
    """Which pull nothing there; moments without them would be taken for those of an earlier version."""
    run = _run(arm)
    (samples,) = run.samples(Use.CALIBRATION)
    expected = set(_columns(run, samples))
    stream = run.experiment.recording.stream("joints")
    still = {name: replace(own, values=np.zeros_like(own.values)) for name, own in stream.signals.items()}
    recording = replace(
        run.experiment.recording, streams={**run.experiment.recording.streams, "joints": replace(stream, signals=still)}
    )
    at_zero = SensorRun(replace(run.experiment, recording=recording), run.sensor)
    (samples,) = at_zero.samples(Use.CALIBRATION)
    columns = _columns(at_zero, samples)
    of_cables = [name for name in expected if " of cables at " in name]
    assert of_cables
    assert expected - columns.keys()
    for name in of_cables:
        assert not columns[name].any()


@pytest.mark.parametrize(
    ("key", "known"),
    [
        ("links = { hend = 0.0 }", "hand"),
        ("joints = { wrst = 1.0 }", "wrist"),
        ("sensors = { leg_ft = { mount_deg = 1.0 } }", "arm_ft"),
    ],
)
def test_a_tolerance_of_something_unknown_is_refused(arm: Path, key: str, known: str) -> None:
    """With the names that there are."""
    with pytest.raises(ExperimentError, match=rf"\[robot\] tolerance.*{known}"):
        _run(arm, f"tolerance = {{ {key} }}\n")


def test_a_tolerance_of_a_joint_that_mimics_is_refused(arm: Path) -> None:
    """It has no zero of its own; the joint to state is named."""
    urdf = arm / "arm.urdf"
    robot = ElementTree.parse(urdf)  # noqa: S314 - the scene wrote it
    (wrist,) = (joint for joint in robot.iter("joint") if joint.get("name") == "wrist")
    ElementTree.SubElement(wrist, "mimic", joint="elbow")
    robot.write(urdf)
    with pytest.raises(ExperimentError, match=r"tolerance.joints: .* got 'wrist', which mimics 'elbow'; .* of 'elbow'"):
        _run(arm, "tolerance = { joints = { wrist = 1.0 } }\n")
    _run(arm, "tolerance = { joints = { elbow = 1.0 } }\n")


@pytest.mark.long
def test_stored_moments_carry_the_model(arm: Path) -> None:
    """A calibration from a file of moments is that from the recording, errors of the model included."""
    run = _run(arm)
    (moments,) = recording_moments(run)
    moments.save(arm / "moments.json")
    stored = calibrate_sensor(None, moments=[read_moments(arm / "moments.json")], code_version="1", created="now")
    direct = _calibrated(run)
    assert direct.model_errors
    assert stored.model_errors == direct.model_errors
    np.testing.assert_array_equal(stored.matrix, direct.matrix)


def _columns(run: SensorRun, samples: IntervalSamples) -> dict[str, FloatArray]:
    """Derivatives in windows by the name of the term; shape (w, 6) each."""
    terms, columns = model_columns(run, samples.interval, samples.data_set)
    return {term.name: columns[:, :, k] for k, term in enumerate(terms)}


def _calibrated(run: SensorRun) -> Calibration:
    return calibrate_sensor(run, code_version="1", created="now")


def test_a_mass_that_is_wrong_is_named(arm: Path) -> None:
    """A hand of twice its weight, known to 3 %, is a warning with value and interval; the right one is none."""
    right, run = _calibrated(_run(arm)), _run(arm)
    heavy = RobotErrors(mass=dict.fromkeys(HAND, 1.0), centre_m={}, joint_zero_rad={}).applied_to(run.experiment.model)
    wrong = _calibrated(SensorRun(replace(run.experiment, model=heavy), run.sensor))
    assert not [doubt for doubt in fit_doubts(right) if "robot model" in doubt]
    (warning,) = [doubt for doubt in fit_doubts(wrong) if "robot model" in doubt]
    assert "mass of hand: off by" in warning
    assert "95 %" in warning
    (error,) = [error for error in wrong.model_errors if error.name == "mass of hand"]
    assert error.value < -3.0 * error.tolerance


def test_cables_are_named_apart_from_the_robot_model(arm: Path) -> None:
    """A pull beyond its tolerance is a warning of its own, which sends nobody to the URDF; one within it is none."""
    fit = _calibrated(_run(arm))
    pull, twist, mass = (
        ModelError(name=name, unit=unit, value=5.0 * size, standard_error=0.1 * size, tolerance=size)
        for name, unit, size in (
            ("x pull of cables at wrist", "N/rad", 1.0),
            ("z twist of cables at elbow", "N m/rad", 0.05),
            ("mass of hand", "", 0.03),
        )
    )
    within = pull.model_copy(update={"value": 2.0})
    assert not [doubt for doubt in fit_doubts(fit.model_copy(update={"model_errors": (within,)})) if "cables" in doubt]
    doubts = [*fit_doubts(fit.model_copy(update={"model_errors": (pull, mass, twist)}))]
    (of_cables,) = (doubt for doubt in doubts if "cables" in doubt)
    (of_model,) = (doubt for doubt in doubts if "robot model" in doubt)
    assert "x pull of cables at wrist: off by +5 N/rad (95 %: +4.8 to +5.2), tolerance 1 N/rad" in of_cables
    assert "z twist of cables at elbow: off by +0.25 N m/rad" in of_cables
    assert "cable_N_rad" in of_cables
    assert "URDF" not in of_cables
    assert "mass of hand" in of_model
    assert "mass of hand" not in of_cables


@some_cases(
    ("tolerance", "least_deg", "most_deg"),
    [
        ("mount_deg = 5.0", 0.0, 0.3),
        ("sensors = { arm_ft = { mount_deg = 5.0 } }", 0.0, 0.3),
        ("mount_deg = 0.0, mount_m = 0.0", 1.0, 3.0),
    ],
)
def test_a_mount_is_turned_as_far_as_its_tolerance_lets_it(
    arm: Path, tolerance: str, least_deg: float, most_deg: float
) -> None:
    """The prior matrix reads in axes that are turned by 3 degrees about z: what the calibration leaves of that.

    Where the file says that the mount is exact, other unknowns take only a part of it.
    """
    run = _run(arm, f"tolerance = {{ {tolerance} }}\n")
    true = run.sensor.prior
    assert true is not None
    turned = replace(run.sensor, prior=np.kron(np.eye(2), rotation_about_z(np.radians(3.0))) @ true)
    turned_run = SensorRun(run.experiment, turned)
    (moments,) = recording_moments(turned_run)
    moments.save(arm / "moments.json")
    stored = calibrate_sensor(None, moments=[read_moments(arm / "moments.json")], code_version="1", created="now")
    forces = (stored.matrix @ np.linalg.pinv(true))[:3, :3]
    left_deg = abs(np.degrees(np.arctan2(forces[1, 0] - forces[0, 1], forces[0, 0] + forces[1, 1])))
    assert least_deg <= left_deg < most_deg
    np.testing.assert_array_equal(stored.matrix, _calibrated(turned_run).matrix)


def test_an_error_is_suspicious_beyond_three_tolerances() -> None:
    """And only where its interval excludes zero."""
    error = ModelError(name="mass of hand", unit="", value=0.1, standard_error=0.01, tolerance=0.03)
    assert error.is_suspicious
    assert error.message == "mass of hand: off by +10 % (95 %: +8.04 to +12), tolerance 3 %"
    assert not error.model_copy(update={"value": 0.08}).is_suspicious
    assert not error.model_copy(update={"standard_error": 0.06}).is_suspicious


SIZES = {"COEFFICIENTS": 0.06, "GAIN": 0.02, "ROTATION": 0.012, "SHIFT": 0.002, "MODEL": 1.0, "QUADRATIC": 0.05}
TERMS = (
    ErrorTerm(name="mass of tool", kind=TermKind.MASS, deviation=0.03, nominal=2.0),
    ErrorTerm(name="zero of wrist", kind=TermKind.ZERO, deviation=0.01),
)


def _means_with_model() -> WindowMeans:
    rng = np.random.default_rng(5)
    load = anyhow(n=50, seed=6)
    derivatives = np.stack([load, rng.normal(size=load.shape) * [20.0, 20.0, 20.0, 2.0, 2.0, 2.0]], axis=2)
    return replace(read_by(load, noise_counts=5.0), terms=TERMS, model=derivatives)


def _written_out(means: WindowMeans, result: GenerativeFit, reading: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean and covariance of coefficients E of all rows and of the two errors, by one dense system of all readings.

    Errors of loads are read by `reading`; shape (6, 6).
    """
    n, load, inverse = len(means), means.reference, np.linalg.inv(PRIOR)
    size = LIMIT_COUNTS * np.sqrt((PRIOR**2).mean(axis=1))
    root = np.linalg.cholesky(inverse.T @ inverse)
    changes, deviations = [], []
    for row in range(6):
        for column in range(6):
            changes.append(np.outer(np.eye(6)[row], size[row] / LIMIT_COUNTS * root[:, column]))
            deviations.append(SIZES["COEFFICIENTS"])
    for channel in range(6):
        changes.append(np.outer(PRIOR[:, channel], inverse[channel]))
        deviations.append(SIZES["GAIN"])
    for axis in np.eye(3):
        skew = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
        changes.append(np.block([[skew, np.zeros((3, 3))], [np.zeros((3, 3)), skew]]))
        deviations.append(SIZES["ROTATION"])
    for axis in np.eye(3):
        skew = np.array([[0.0, -axis[2], axis[1]], [axis[2], 0.0, -axis[0]], [-axis[1], axis[0], 0.0]])
        changes.append(np.block([[np.zeros((3, 3)), np.zeros((3, 3))], [skew, np.zeros((3, 3))]]))
        deviations.append(SIZES["SHIFT"])
    assert means.model is not None
    columns = [load @ change.T for change in changes] + [means.model[:, :, k] @ reading.T for k in range(2)]
    deviations += [term.deviation for term in TERMS]
    counts = load @ inverse.T / LIMIT_COUNTS
    about = counts - counts.mean(axis=0)
    first, second = np.triu_indices(6)
    for row in range(6):
        for term in (about[:, first] * about[:, second]).T:
            columns.append(np.outer(term, np.eye(6)[row]))
            deviations.append(SIZES["QUADRATIC"] * size[row])
    for row in range(6):
        columns.append(np.outer(np.ones(n), np.eye(6)[row]))
        deviations.append(1e7)  # an offset of which nothing is known
    design = np.stack([column.ravel() for column in columns], axis=1)
    time = means.time_s
    blocks = []
    for noise in result.posterior.noise:
        apart = np.abs(time[:, None] - time)
        slow = noise.ratio * np.exp(-apart / noise.time_constant_s) if noise.ratio else np.zeros((n, n))
        blocks.append(np.linalg.inv(noise.white**2 * (np.eye(n) + slow)))
    precision = np.zeros((6 * n, 6 * n))
    for row, block in enumerate(blocks):
        precision[row::6, row::6] = block
    weighed = precision @ design
    # in units of the deviations, for the sake of the condition
    scale = np.array(deviations)
    known = np.linalg.inv(scale[:, None] * (design.T @ weighed) * scale + np.eye(len(scale)))
    measured = (means.raw @ PRIOR.T - load).ravel()
    mean, covariance = scale * (known @ (scale * (weighed.T @ measured))), known * np.outer(scale, scale)
    told = np.zeros((38, len(scale)))
    told[:36, : len(changes)] = np.stack([change.ravel() for change in changes], axis=1)
    told[36:, len(changes) : len(changes) + 2] = np.eye(2)
    return told @ mean, told @ covariance @ told.T


@some_cases("as_they_are", [True, False])
def test_rows_with_a_common_model_are_one_gaussian_inference(
    monkeypatch: pytest.MonkeyPatch, as_they_are: bool
) -> None:
    """Coefficients of all rows and errors of the model, the noise being given; other sizes give another result."""
    for name, size in SIZES.items():
        taken = size if as_they_are or name != "GAIN" else 3.0 * size
        monkeypatch.setattr(expected_sensor_errors, name, Scale(expected=taken, weight=np.inf))
    means = _means_with_model()
    readings: list[FloatArray] = []
    given = SolvedRows.reading

    def kept(solved: SolvedRows) -> FloatArray:
        readings.append(given(solved))
        return readings[-1]

    monkeypatch.setattr(SolvedRows, "reading", kept)
    result = fit_generative([means], PRIOR, assumed())
    (reading,) = readings
    reading *= LIMIT_COUNTS * np.sqrt((PRIOR**2).mean(axis=1))[:, None]
    mean, covariance = _written_out(means, result, reading)
    spread = np.sqrt(np.diag(covariance))
    found = np.r_[result.posterior.mean[:, :6].ravel(), [error.value for error in result.model_errors]]
    deviations = np.sqrt(np.r_[np.einsum("kii->ki", result.posterior.covariance[:, :6, :6]).ravel(), np.zeros(2)])
    deviations[36:] = [error.standard_error for error in result.model_errors]
    close = np.allclose(found / spread, mean / spread, atol=1e-5) and np.allclose(deviations / spread, 1.0, atol=1e-5)
    assert close is as_they_are
    # the prior matrix reads an error of the load as it reads the load, by a first fit with the same noise
    first, _ = _written_out(means, result, np.eye(6))
    assert np.allclose((reading - np.eye(6)).ravel() / spread[:36], first[:36] / spread[:36], atol=0.05) is as_they_are
    assert np.abs((first - mean) / spread).max() > 0.5
    # what would go if both errors were known: covariance less that given the errors
    shared = covariance[:36, 36:]
    by_model = np.diag(shared @ np.linalg.solve(covariance[36:, 36:], shared.T))
    of_model = result.posterior.model_covariance
    assert of_model is not None
    own = np.einsum("kii->ki", of_model[:, :6, :6]).ravel()
    assert np.allclose(own / spread[:36] ** 2, by_model / spread[:36] ** 2, atol=1e-5) is as_they_are
    assert by_model.max() > 0.05 * (spread[:36] ** 2)[by_model.argmax()]


def test_the_errors_of_the_model_are_in_the_file(arm: Path) -> None:
    """Name, unit, value, standard error and tolerance of each, and a file without them is read as before."""
    calibration = _calibrated(_run(arm))
    calibration.save(arm / "own.json")
    content = json.loads((arm / "own.json").read_text(encoding="utf-8"))
    assert {"name", "unit", "value", "standard_error", "tolerance"} == set(content["model_errors"][0])
    assert read_calibration(arm / "own.json") == calibration
    covariance = content["posterior"]["model"]["term_covariance"]
    assert [len(row) for row in covariance] == list(range(1, len(calibration.model_errors) + 1))
    del content["model_errors"]
    assert Calibration.model_validate(content).model_errors == ()
