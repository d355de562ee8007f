# SPDX-License-Identifier: BSD-3-Clause
"""Sensors that measure fewer than six components: the others disturb them, and the errors that are stated say so."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ForceTorqueError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.evaluation.evaluation import validation_errors
from forcetorque.evaluation.load_cases.verdict import LOOK_FOR_CAUSE, UNMEASURED, use_verdicts
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.sensor_model import measured_components
from forcetorque.experiment.evaluated_wrenches import evaluated_wrenches
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.inspection.findings import inspect_experiment
from forcetorque.recording.storage import write_recording
from tests.app.outcome import Run
from tests.calibration.synthetic import LIMIT_COUNTS, MOUNTED, PRIOR, anyhow, assumptions, read_by
from tests.cases import some_cases
from tests.scenes.experiments import PARQUET, edit

FULL_SCALE = np.array([500.0, 500.0, 1000.0, 20.0, 20.0, 10.0])
CROSS_TALK = 0.02
"""What a load of full scale in any component adds to a channel, as a share of its full scale."""
STATED = "full_scale = [800.0, 800.0, 800.0, 20.0, 20.0, 20.0]\n"


def _cell(measured: list[int], seed: int) -> tuple[FloatArray, FloatArray]:
    """Prior matrix, shape (6, k), and true response, shape (k, 6), of a sensor with a channel for each component."""
    rng, places = np.random.default_rng(seed), range(len(measured))
    response = CROSS_TALK * rng.standard_normal((len(measured), 6)) / FULL_SCALE
    response[places, measured] += 1.0 / FULL_SCALE[measured]
    prior = np.zeros((6, len(measured)))
    prior[measured, places] = FULL_SCALE[measured] / LIMIT_COUNTS
    return prior, LIMIT_COUNTS * response


def _fitted(prior: FloatArray, response: FloatArray, *, seed: int = 0) -> GenerativeFit:
    wrench = 0.1 * FULL_SCALE * np.random.default_rng([seed, 2]).standard_normal((200, 6))
    known = Assumptions(
        full_scale=np.full(len(response), LIMIT_COUNTS),
        accuracy=np.zeros(6),
        repeatability=0.0,
        load_full_scale=FULL_SCALE,
    )
    return fit_generative([read_by(wrench, response=response, seed=seed)], prior, known)


@some_cases("measured", [[2], [0, 1, 2], [2, 3]])
def test_stated_errors_are_those_of_loads_that_disturb_it(measured: list[int]) -> None:
    """Errors over 8 sensors are as large as stated, mostly by cross-talk that no matrix takes away."""
    load = FULL_SCALE * np.random.default_rng(3).uniform(-0.5, 0.5, (200, 6))
    squares = []
    for seed in range(8):
        prior, response = _cell(measured, seed)
        fit = _fitted(prior, response, seed=seed)
        matrix = fit.model.matrix
        assert measured_components(matrix).nonzero()[0].tolist() == measured
        # its own components are read right, the others leave what the posterior says
        np.testing.assert_allclose((matrix @ response)[np.ix_(measured, measured)], np.eye(len(measured)), atol=0.002)
        error = load @ (matrix @ response).T - fit.model.expected_reading(load)
        np.testing.assert_allclose(
            load @ fit.posterior.cross_talk.T, error, atol=0.002 * float(FULL_SCALE[measured].max())
        )
        stated = np.einsum("nii->ni", fit.posterior.error_covariance(load))
        squares.append(np.stack([error[:, measured] ** 2, stated[:, measured]]).mean(axis=1))
        assert not stated[:, ~measured_components(matrix)].any()
    true, said = np.mean(squares, axis=0)
    assert (true > (0.005 * FULL_SCALE[measured]) ** 2).all()  # there is something to state
    np.testing.assert_allclose(said, true, rtol=0.1)


def test_sensor_of_six_components_has_no_cross_talk() -> None:
    """Its matrix corrects all of it, and a full scale of loads changes nothing."""
    means = read_by(anyhow())
    fit = fit_generative([means], PRIOR, assumptions())
    again = fit_generative([means], PRIOR, replace(assumptions(), load_full_scale=FULL_SCALE))
    assert not fit.posterior.cross_talk.any()
    np.testing.assert_allclose(again.model.matrix, fit.model.matrix, rtol=1e-9)


def test_more_channels_than_components_take_the_cross_talk_away() -> None:
    """Six gauges of which only forces are wanted: moments are weighed against each other by the channels."""
    prior = np.where(np.arange(6)[:, None] < 3, PRIOR, 0.0)
    response = np.linalg.inv(MOUNTED)
    fit = _fitted(prior, response)
    wrong = prior @ response
    assert np.abs(wrong[:3, 3:]).max() > 0.5
    np.testing.assert_allclose(fit.model.matrix @ response, np.eye(6) * (np.arange(6) < 3), atol=0.02)


def test_fewer_channels_than_components_are_refused() -> None:
    """One channel cannot tell three components."""
    prior, response = _cell([2], 0)
    with pytest.raises(FitError, match="at least 3 channels, one for each component, got 1"):
        _fitted(prior + np.eye(6)[:, :1] + np.eye(6)[:, 1:2], response)


@pytest.fixture
def axis(arm: Path) -> Path:
    """The small arm with a load cell along fz: the prior's reading of it, in N."""
    return _with_components(["fz"])


def _with_components(components: list[str]) -> Path:
    whole = load_experiment(PARQUET)
    stream, prior = whole.recording.stream("arm_ft"), whole.sensors[0].prior
    assert prior is not None
    raw = stream.signal("raw")
    places = [("fx", "fy", "fz", "tx", "ty", "tz").index(name) for name in components]
    values = (raw.values @ prior.T)[:, places]
    signal = replace(raw, values=values, columns=tuple(components), units=("counts",) * len(components))
    streams = {**whole.recording.streams, "arm_ft": replace(stream, signals={"raw": signal})}
    write_recording("recording_of_cell", replace(whole.recording, streams=streams))
    text = Path(PARQUET).read_text(encoding="utf-8").replace('path = "recording"', 'path = "recording_of_cell"')
    stated = f'prior = "identity"\ncomponents = {json.dumps(components)}\n{STATED}'
    file = Path("cell.toml")
    file.write_text(text.replace('prior = "matrix_SIM001.txt"\n', stated), encoding="utf-8")
    return file


def _run(file: Path) -> tuple[Experiment, SensorRun]:
    experiment = load_experiment(file)
    return experiment, SensorRun(experiment, "arm_ft")


def test_load_cell_is_calibrated_and_evaluated(axis: Path, run: Run) -> None:
    """The way of a new user: fit, verdict and report speak of fz alone; the error is that of the readings."""
    fitted = run("calibrate", str(axis), "-o", "cell.json").out
    assert " N (RMS of the norm)" in fitted
    assert " N m (RMS" not in fitted
    done = run("evaluate", str(axis), "-c", "cell.json", "--details")
    assert done.code == 0
    assert "fz, N" in done.out
    assert not any(word in done.out for word in ("fx, N", "tx, N m", "moment error"))
    _, own = _run(axis)
    calibration = calibrate_sensor(own, code_version="test", created="now")
    (prior, _, mine, _) = validation_errors(own, {"cell.json": calibration}).verdicts
    part = evaluated_wrenches(own, {"cell.json": calibration})
    error = dict(part.measured)["cell.json"][:, 2] - part.load[:, 2]
    assert mine.rmse[2] == pytest.approx(np.sqrt((error**2).mean()))
    assert mine.rmse[2] < prior.rmse[2]
    assert mine.components == ("fz",)
    assert mine.excitation_Nm > 0.0


def test_verdict_names_the_components_that_are_not_measured(axis: Path) -> None:
    """Their cross-talk is most of the error, which no recording lowers; without it the cause is another."""
    with axis.open("a", encoding="utf-8") as file:
        file.write('\n[[load_case]]\nname = "push"\nforce_N = 20.0\nradius_m = 0.2\n')
        file.write('offset = "tared"\nforce_error_N = 0.01\n')
    _, own = _run(axis)
    calibration = calibrate_sensor(own, code_version="test", created="now")
    (verdict,) = use_verdicts(own, {"cell.json": calibration})
    remedies = [reason.remedy for reason in verdict.reasons]
    assert verdict.decision == "do not use"
    assert remedies.count(UNMEASURED) == 2  # of the error that is measured, and that is predicted
    posterior = calibration.posterior
    assert posterior is not None
    mean = np.where(np.arange(posterior.mean.shape[1]) == 2, posterior.mean, 0.0)
    alone = calibration.model_copy(update={"posterior": posterior.model_copy(update={"mean": mean})})
    (verdict,) = use_verdicts(own, {"cell.json": alone})
    assert LOOK_FOR_CAUSE in [reason.remedy for reason in verdict.reasons]
    assert UNMEASURED not in [reason.remedy for reason in verdict.reasons]


def test_inspect_says_what_it_cannot_test(axis: Path) -> None:
    """No fault is named where six components would be needed; a reading that runs backwards is."""
    experiment, _ = _run(axis)
    assert [one.kind for one in inspect_experiment(experiment)] == ["not_compared"]
    text = axis.read_text(encoding="utf-8").replace(
        'prior = "identity"', "prior = { path = 'm.txt', force_unit = 'N', moment_unit = 'N m' }"
    )
    Path("m.txt").write_text("0\n0\n-1\n0\n0\n0\n", encoding="utf-8")
    axis.write_text(text.replace("components", "limit_counts = 800.0\ncomponents"), encoding="utf-8")
    experiment, _ = _run(axis)
    kinds = {one.kind: one.message for one in inspect_experiment(experiment)}
    assert "is opposite to the expected force" in kinds["implausible"]


@pytest.mark.parametrize(
    ("command", "words"),
    [
        (("calibrate", "--jointly", "cell.toml", "-o", "joint"), "a joint calibration expects a sensor of six"),
        (("robot", "collisions", "cell.toml"), "a search for collisions expects a sensor of six"),
        (("study", "sphere", "cell.toml"), "the sphere of the weight expects a sensor of six"),
        (
            ("study", "validate", "cell.toml"),
            "by contact forces and joint torques expects a sensor of six",
        ),
        (("study", "fits", "cell.toml", "-o", "fits"), "a study of estimation types expects a sensor of six"),
        (("plan", "cell.toml", "--clearance-deg", "10"), "a plan expects a sensor of six"),
        (("fleet", "add", "cell.toml", "--into", "set"), "a dataset expects a sensor of six"),
        (("estimate", "cell.toml", "-o", "out.csv"), "expects a sensor of six components, this one measures fz"),
    ],
)
def test_what_needs_six_components_says_so(axis: Path, run: Run, command: tuple[str, ...], words: str) -> None:
    """No command takes what is not measured for zero."""
    done = run(*command)
    assert done.code != 0
    assert words in " ".join(done.err.split())


def test_exports_have_the_measured_components_alone(axis: Path, run: Run) -> None:
    """No zero stands for a load that is not measured, and what has no place for their names is refused."""
    fitted = run("calibrate", str(axis), "-o", "cell.json")
    assert "information gained: fz " in fitted.out
    assert "of the cross-talk of others: fx " in " ".join(fitted.out.split())
    done = run("export", "cell.json", "--to", "csv", "-o", "cell.csv", "--details")
    assert [line.split(",")[2] for line in Path("cell.csv").read_text(encoding="utf-8").splitlines()[1:]] == ["fz"]
    assert "fitted loads, outside which it extrapolates: fz " in " ".join(done.out.split())
    assert "fx" not in done.out
    assert run("export", "cell.json", "--to", "numpy", "-o", "cell.npz").code == 0
    with np.load("cell.npz") as sensor:
        assert sensor["components"].tolist() == ["fz"]
        assert (sensor["matrix"].shape, sensor["offset"].shape) == ((1, 1), (1,))
    for words in (("ros2", "--frame-id", "tool"), ("wholebodydynamics",)):
        refused = run("export", "cell.json", "--to", *words, "-o", "cell.out")
        assert refused.code == 2
        assert f"expected a sensor of six components for --to {words[0]}" in " ".join(refused.err.split())


def test_calibration_of_other_components_is_refused(axis: Path, run: Run) -> None:
    """A channel that is fz is not read as fx, whatever the serial number; the same components are."""
    assert run("calibrate", str(axis), "-o", "cell.json").code == 0
    assert run("evaluate", str(axis), "-c", "cell.json").code == 0
    edit(axis, '["fz"]', '["fx"]')
    done = run("evaluate", str(axis), "-c", "cell.json")
    assert done.code == 2
    assert "expected the components fx that the sensor 'arm_ft' measures, got fz" in " ".join(done.err.split())


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        (STATED, "", "fewer than six components need prior, and full_scale of all six"),
        (STATED, "full_scale = 800.0\n", "expected a number for each of fx, fy, fz, tx, ty, tz with fewer than six"),
        ('["fz"]', '["fz", "fx"]', "each once, in the order fx to tz"),
        ('["fz"]', '["fz", "tz"]', "expected a channel for each of 2 components"),
        ('prior = "identity"', 'prior = "matrix_SIM001.txt"', "rows are zero just where components names none"),
    ],
)
def test_contradictions_are_refused(axis: Path, old: str, new: str, words: str) -> None:
    """File, prior and log name the same components."""
    edit(axis, old, new)
    with pytest.raises(ForceTorqueError, match=words):
        calibrate_sensor(_run(axis)[1], code_version="test", created="now")


def test_the_lines_of_the_page_are_read(tmp_path: Path) -> None:
    """They state a load cell along fz whose log is in newtons; nothing reads those without its sensor."""
    page = (Path(__file__).resolve().parents[2] / "docs/calibration/arm.md").read_text(encoding="utf-8")
    lines = page.split("## A sensor of fewer components")[1].split("```toml\n")[1].split("```")[0]
    head = (
        'schema = "forcetorque/experiment/1"\nname = "foot"\nload = { frame = "foot_ft", motion = "none" }\n'
        '[recording]\nformat = "tabular"\npath = "."\n'
    )
    (tmp_path / "log.csv").write_text("time,fz\n" + "".join(f"{0.01 * k},{-40.0 - k}\n" for k in range(300)))
    (tmp_path / "foot.toml").write_text(f'{head}{lines}[[interval]]\nlabel = "all"\nuse = "ignore"\nstart_s = 0.0\n')
    experiment = load_experiment(tmp_path / "foot.toml")
    (sensor,) = experiment.sensors
    assert sensor.prior is not None
    assert np.array_equal(measured_components(sensor.prior), np.arange(6) == 2)
    assert experiment.recording.stream("foot").signal("raw").values[:2].ravel().tolist() == [-40.0, -41.0]
