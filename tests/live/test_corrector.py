# SPDX-License-Identifier: BSD-3-Clause
"""A live corrector gives what the same calibration gives offline, and says what is wrong with each sample."""

from __future__ import annotations

import re
import tracemalloc
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from forcetorque.base.errors import FitError, RecordingError, ShapeError
from forcetorque.base.units import NORMAL_95
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior, RowNoise
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_reading import Correction, wrench_at
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.live.corrector import Corrector, CorrectorOptions
from forcetorque.live.gravity_and_tool_weight import Tool
from forcetorque.live.option_values import FaultPolicy, HeldQuantity, OffsetSource
from forcetorque.live.sample_status import FAULTS, Status, status_of_device, status_text
from forcetorque.live.sources import replayed_groups
from tests.scenes.calibrations import FACTORY, make_calibration, make_variable
from tests.scenes.experiments import PARQUET

EQUAL = 1e-12
"""Of numbers of up to 1e3: products are added up in another order."""
EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
MS = 1_000_000
RAW = np.array([100.0, -200.0, 300.0, -400.0, 500.0, -600.0])


def _fitted(file: Path, sensor: str | None = None) -> tuple[SensorRun, Calibration]:
    experiment = load_experiment(file)
    run = SensorRun(experiment, sensor or experiment.sensors[0])
    return run, calibrate_sensor(run, code_version="test", created="test")


def _as_offline(run: SensorRun, calibration: Calibration, step: int = 1) -> int:
    """Compare every sample of a log, or as many as are left by a step; the number of them."""
    (group,) = replayed_groups(run.experiment, [calibration])
    stamps = np.unique(group.stamp_ns)
    offline = wrench_at(run.experiment, run.sensor, Correction.of("live", calibration), stamps)
    options = CorrectorOptions(quantity=group.quantity, limit_counts=run.sensor.limit_counts)
    corrector = Corrector(calibration, options)
    posterior = calibration.posterior
    compared = 0
    for values, variables, stamp in zip(
        group.values[::step], group.variables[::step], group.stamp_ns[::step], strict=True
    ):
        live = corrector.correct(values, variables=variables, stamp_ns=int(stamp))
        wrench = offline[np.searchsorted(stamps, stamp)]
        if live.status[0] & FAULTS or not np.isfinite(wrench).all():
            continue
        assert np.abs(live.wrench[0] - wrench).max() < EQUAL * max(1.0, np.abs(wrench).max())
        if posterior is not None and compared % 50 == 0:
            change = variables[0] - calibration.model.reference_values
            session = calibration.sessions[-1].name
            covariance = posterior.error_covariance(wrench, variables=change, session=session)
            half_width = NORMAL_95 * np.sqrt(np.diag(covariance))
            assert np.allclose(live.half_width[0], half_width, rtol=1e-9, atol=0.0)
        compared += 1
    return compared


def test_samples_are_read_as_offline(arm: Path) -> None:
    """Wrenches of a small log to 1e-12, their intervals by the same posterior."""
    assert _as_offline(*_fitted(arm / PARQUET), 2) > 550


def _yoga(data_dir: Path, folder: Path) -> Path:
    file = folder / "yoga.toml"
    text = next(EXAMPLES.glob("02_*.toml")).read_text(encoding="utf-8")
    file.write_text(text.replace("../../shared/data", data_dir.as_posix()), encoding="utf-8")
    return file


@pytest.mark.real_data
def test_a_real_log_is_read_as_offline(data_dir: Path, tmp_path: Path) -> None:
    """The calibrated stream of an iCub's leg, whose counts come back through the prior."""
    experiment = load_experiment(_yoga(data_dir, tmp_path))
    run = SensorRun(experiment, experiment.sensors[0])
    assert run.sensor.prior is not None
    name, serial = run.sensor.name, run.sensor.serial
    matrix = run.sensor.prior * np.linspace(0.9, 1.1, 36).reshape(6, 6)
    assert _as_offline(run, make_calibration(name=name, serial=serial, matrix=matrix, prior=run.sensor.prior), 5) > 1000


@pytest.mark.long
@pytest.mark.real_data
def test_a_fit_of_a_real_log_is_read_as_offline(data_dir: Path, tmp_path: Path) -> None:
    """All samples, with the intervals of its posterior."""
    assert _as_offline(*_fitted(_yoga(data_dir, tmp_path))) > 5000


def test_several_sensors_are_read_in_one_call() -> None:
    """Sensors with more channels, with and without a variable, each as alone."""
    wide = make_calibration(name="wide", matrix=np.hstack([FACTORY, FACTORY[:, :2]]), prior=None)
    warm = make_calibration(variables=(make_variable(),))
    samples = np.zeros((2, 8))
    samples[0], samples[1, :6] = np.arange(8) * 100.0, RAW
    both = Corrector([wide, warm]).correct(samples, variables=[[0.0], [31.0]])
    assert np.allclose(both.wrench[0], wide.apply(samples[0], serial="SN001"), rtol=0, atol=EQUAL)
    expected = warm.apply(RAW, serial="SN001", variables={"temperature": 31.0})
    assert np.allclose(both.wrench[1], expected, rtol=0, atol=EQUAL)
    assert np.isnan(both.half_width).all()  # neither has a posterior


def test_wrenches_go_through_the_secondary_matrix() -> None:
    """A stream by the prior is corrected as its counts would be; without a prior it is refused."""
    calibration = make_calibration()
    corrector = Corrector(calibration, CorrectorOptions(quantity=HeldQuantity.WRENCH, limit_counts=1000.0))
    given = corrector.correct(FACTORY @ RAW)
    assert np.allclose(given.wrench[0], calibration.apply(RAW, serial="SN001"), rtol=0, atol=1e-11)
    assert given.status[0] == 0
    assert corrector.correct(FACTORY @ RAW * 2.0).status[0] == Status.SATURATED
    with pytest.raises(FitError, match="prior matrix"):
        Corrector(make_calibration(prior=None), CorrectorOptions(quantity=HeldQuantity.WRENCH))


def test_each_fault_is_named() -> None:
    """Not finite, saturated, frozen, repeated, late, and what the device says."""
    corrector = Corrector(make_calibration(), CorrectorOptions(limit_counts=32768.0))
    broken = np.where(np.arange(6) == 2, np.inf, RAW)
    assert corrector.correct(broken).status[0] == Status.NOT_FINITE
    assert corrector.correct(np.where(np.arange(6) == 1, 32767.0, RAW)).status[0] == Status.SATURATED
    assert corrector.correct(RAW, faults=[int(status_of_device(2))]).status[0] == Status.SATURATED
    assert corrector.correct(RAW, faults=[int(status_of_device(1))]).status[0] == Status.DEVICE
    statuses = [int(corrector.correct(RAW, stamp_ns=k * 100 * MS).status[0]) for k in range(8)]
    assert statuses == [0] * 6 + [Status.FROZEN] * 2
    assert corrector.correct(RAW + 1.0, stamp_ns=700 * MS).status[0] == Status.REPEATED
    assert corrector.correct(RAW + 1.0, stamp_ns=650 * MS).status[0] == Status.LATE
    assert corrector.correct(RAW + 1.0, stamp_ns=800 * MS).status[0] == 0
    assert status_text(int(Status.SATURATED | Status.LATE)) == "saturated|late"
    assert status_text(0) == "ok"


@pytest.mark.parametrize("offset", OffsetSource)
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_gravity_that_is_not_finite_is_a_fault_of_its_sample(offset: OffsetSource, bad: float) -> None:
    """During a tare and after it: that sample alone has the fault, and the bias is learnt from the others."""
    tool, rng = Tool(mass_kg=0.8, centre_m=np.array([0.01, 0.0, 0.05])), np.random.default_rng(0)
    options = CorrectorOptions(offset=offset, tare_s=0.1, tool=tool, take_tool_off=True)
    corrector, faulty = Corrector(make_calibration(), options), []
    for k in range(100):
        gravity = np.array([bad if k in (5, 50) else 0.0, 0.0, -9.81])
        sample = corrector.correct(RAW + rng.normal(0.0, 1.0, 6), stamp_ns=k * 10 * MS, gravity=gravity)
        if sample.status[0] & FAULTS:
            faulty.append((k, sample.status[0] & FAULTS))
        assert np.isfinite(sample.wrench).all() == (k not in (5, 50))
    assert faulty == [(5, Status.NOT_FINITE), (50, Status.NOT_FINITE)]
    assert np.isfinite(corrector.bias).all()
    assert np.abs(corrector.bias).max() > 1.0 or offset is OffsetSource.FITTED


@pytest.mark.parametrize("policy", FaultPolicy)
def test_faults_are_treated_as_stated(policy: FaultPolicy) -> None:
    """A fault of one sensor leaves the other alone."""
    corrector = Corrector([make_calibration(), make_calibration(name="other")], CorrectorOptions(policy=policy))
    good = corrector.correct([RAW, RAW]).wrench.copy()
    faulty = corrector.correct([RAW * 2.0, RAW * 2.0], faults=[int(Status.DEVICE), 0])
    expected = {"flag": faulty.wrench[1], "hold": good[0], "refuse": np.full(6, np.nan)}[policy]
    assert np.array_equal(faulty.wrench[0], expected, equal_nan=True)
    assert np.abs(faulty.wrench[1] - good[1]).max() > 1.0


def test_a_tare_keeps_the_tool() -> None:
    """Once tared in one posture, the sensor reads the tool in another; taken off, it reads nothing."""
    calibration = make_calibration()
    tool = Tool(mass_kg=0.8, centre_m=np.array([0.01, 0.0, 0.05]))
    weight = tool.per_gravity(calibration.sensor.measure_direction)
    inverse = np.linalg.inv(calibration.matrix)
    postures = [np.array([0.0, 0.0, -9.81]), np.array([9.81, 0.0, 0.0])]
    bias = np.array([3.0, -2.0, 1.0, 0.1, 0.2, -0.1])
    for take_off in (False, True):
        options = CorrectorOptions(offset=OffsetSource.TARE, tare_s=0.1, tool=tool, take_tool_off=take_off)
        corrector = Corrector(calibration, options)
        for k in range(20):
            raw = inverse @ (weight @ postures[0] + bias) + (-1.0) ** k
            status = corrector.correct(raw, stamp_ns=k * 10 * MS, gravity=postures[0]).status[0]
            assert bool(status & Status.TARING) == (k <= 10)
        after = corrector.correct(inverse @ (weight @ postures[1] + bias), stamp_ns=MS * 10**6, gravity=postures[1])
        expected = np.zeros(6) if take_off else weight @ postures[1]
        # a mean of eleven alternating counts is off by an eleventh of one
        assert np.abs(after.wrench[0] - expected).max() < np.abs(calibration.matrix).sum(axis=1).max() / 10.0


@pytest.mark.parametrize("offset", [OffsetSource.TARE, OffsetSource.TRACKED])
@pytest.mark.parametrize("moves_N", [0.0, 30.0])
def test_a_tare_of_a_load_that_moves_is_named_and_begins_no_tracking(offset: OffsetSource, moves_N: float) -> None:
    """A force that swings for half a second, in noise of 2 N; tracking begins in the first time without it."""
    calibration, rng = make_calibration(), np.random.default_rng(3)
    inverse = np.linalg.inv(calibration.matrix)
    corrector = Corrector(calibration, CorrectorOptions(offset=offset, tare_s=0.2))
    moved, is_tracked = [], []
    for k in range(1000):
        force = np.zeros(6)
        force[0] = moves_N * np.sin(k / 50.0) * (k < 500)
        force[:3] += 2.0 * rng.standard_normal(3)
        corrector.correct(inverse @ force, stamp_ns=k * MS)
        moved.append(corrector.tare_moved_N[0])
        is_tracked.append(corrector.tracker is not None)
    assert (max(moved) > 0.5 * moves_N) == (moves_N > 0.0)
    assert max(moved) < 3.0 * moves_N + 1e-9
    begun = 0 if not any(is_tracked) else is_tracked.index(True)
    expected = {OffsetSource.TARE: range(1), OffsetSource.TRACKED: range(500, 850) if moves_N else range(200, 202)}
    assert begun in expected[offset]


@pytest.mark.parametrize("offset", OffsetSource)
@pytest.mark.parametrize("take_off", [False, True])
def test_intervals_hold_in_another_posture(offset: OffsetSource, take_off: bool) -> None:
    """The error of the matrix acts on the load since the tare, also where the weight is taken off."""
    rng, half = np.random.default_rng(0), 0.05
    covariance = np.zeros((6, 7, 7))
    covariance[:, range(6), range(6)] = (half / NORMAL_95) ** 2
    posterior = Posterior(
        space="wrench", variables=(), sessions=("first",), drift=False, mean=np.zeros((6, 7)), covariance=covariance,
        mean_covariance=covariance[:, :6, :6], prior_covariance=None, to_wrench=np.eye(6), accuracy=np.zeros(6),
        noise=(RowNoise(white=0.01, time_constant_s=0.0, ratio=0.0),) * 6, repeatability=0.0, load_centre=np.zeros(6),
    )  # fmt: skip
    calibration = make_calibration().model_copy(update={"posterior": posterior})
    tool = Tool(mass_kg=4.0, centre_m=np.zeros(3))
    weight, inverse = tool.per_gravity(calibration.sensor.measure_direction), np.linalg.inv(calibration.matrix)
    down = np.array([0.0, 0.0, -9.81])
    inside = []
    for _ in range(50):
        options = CorrectorOptions(offset=offset, tare_s=0.08, tool=tool, take_tool_off=take_off)
        corrector = Corrector(calibration, options)
        error = np.eye(6) + rng.normal(0.0, half / NORMAL_95, (6, 6))
        for k in range(11):
            gravity = down if k < 10 else -down
            raw = inverse @ (error @ weight @ gravity - calibration.offset + rng.normal(0.0, 0.001, 6))
            given = corrector.correct(raw, stamp_ns=k * 10 * MS, gravity=gravity)
        expected = np.zeros(6) if take_off else weight @ -down
        inside.append(np.abs(given.wrench[0] - expected) <= given.half_width[0])
    assert 0.92 < np.mean(inside) < 0.98


@pytest.mark.parametrize("offset", [OffsetSource.TARE, OffsetSource.TRACKED])
def test_a_dead_sensor_keeps_no_other_from_its_tare(offset: OffsetSource) -> None:
    """Nor is more and more kept for it; it is tared when it comes alive."""
    corrector = Corrector([make_calibration(), make_calibration(name="b")], CorrectorOptions(offset=offset, tare_s=0.1))
    rng, dead = np.random.default_rng(0), np.full(6, np.nan)
    held = set()
    for k in range(90):
        samples = np.array([RAW, RAW + 50.0 if k >= 60 else dead]) + rng.normal(0.0, 1.0, (2, 6))
        given = corrector.correct(samples, stamp_ns=k * 10 * MS)
        assert (given.status & Status.TARING != 0).tolist() == [k <= 10, k <= 70]
        if 10 < k < 60:
            held.add(sum(map(len, corrector._tare._samples)) if corrector._tare else 0)
    assert held == {11}
    expected = [make_calibration().apply(raw, serial="SN001") for raw in (RAW, RAW + 50.0)]
    assert np.abs(corrector.bias - expected).max() < 0.05
    assert (corrector.bias_variance > 0.0).all()


def test_what_is_missing_is_refused() -> None:
    """Shapes, variables, time and gravity are asked for by name."""
    warm = make_calibration(variables=(make_variable(),))
    with pytest.raises(ShapeError, match="temperature"):
        Corrector(warm).correct(RAW)
    with pytest.raises(ShapeError, match="expected samples of shape"):
        Corrector(make_calibration()).correct(RAW[:5])
    with pytest.raises(RecordingError, match="time of every sample"):
        Corrector(make_calibration(), CorrectorOptions(offset=OffsetSource.TARE)).correct(RAW)
    carried = CorrectorOptions(tool=Tool(mass_kg=1.0, centre_m=np.zeros(3)), take_tool_off=True)
    with pytest.raises(RecordingError, match="gravity"):
        Corrector(make_calibration(), carried).correct(RAW)
    with pytest.raises(ShapeError, match=r"expected shape \(2, 3\)"):
        Corrector([make_calibration()] * 2, carried).correct([RAW, RAW], gravity=np.zeros(3))
    with pytest.raises(RecordingError, match="got 'fitted'"):
        Corrector(make_calibration()).tare()
    with pytest.raises(RecordingError, match="expected a tool"):
        replace(carried, tool=None)
    with pytest.raises(RecordingError, match="no session"):
        Corrector(make_calibration(), CorrectorOptions(session="monday"))
    with pytest.raises(RecordingError, match="at least one"):
        Corrector([])


def test_a_call_allocates_nothing_that_stays() -> None:
    """With all that a sample may meet: a tool, a tracked bias, faults that are held."""
    tool = Tool(mass_kg=0.8, centre_m=np.array([0.01, 0.0, 0.05]))
    options = CorrectorOptions(offset=OffsetSource.TRACKED, tare_s=0.05, tool=tool, policy=FaultPolicy.HOLD)
    corrector, gravity, rng = (
        Corrector(make_calibration(), options),
        np.array([0.0, 0.0, -9.81]),
        np.random.default_rng(0),
    )
    samples, sizes = RAW + rng.normal(0.0, 1.0, (400, 6)), []
    samples[300] = np.nan
    tracemalloc.start()
    for k, sample in enumerate(samples):
        corrector.correct(sample, stamp_ns=k * 10 * MS, gravity=gravity)
        if k in (199, 399):
            sizes.append(tracemalloc.get_traced_memory()[0])
    tracemalloc.stop()
    assert corrector.tracker is not None
    assert sizes[1] - sizes[0] < 1000  # of an array per sample it would be 20 kB


def test_a_time_beyond_64_bits_is_refused() -> None:
    """By its name."""
    with pytest.raises(RecordingError, match="64 bits"):
        Corrector(make_calibration()).correct(RAW, stamp_ns=1 << 63)


def test_the_program_of_the_page_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The block of docs/live.md, with two sensors that have a thermometer."""
    monkeypatch.chdir(tmp_path)
    for name in ("left", "right"):
        make_calibration(name=name, variables=(make_variable(),)).save(f"{name}.json")
    page = (EXAMPLES.parent / "docs" / "live.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    names: dict[str, Any] = {"left_counts": RAW, "right_counts": 2.0 * RAW, "now_ns": 0}
    exec(compile(block, "live.md", "exec"), names)
    assert np.allclose(
        names["sample"].wrench[0], names["corrector"].correct([RAW, RAW], variables=[[31.5], [30.2]]).wrench[0]
    )
