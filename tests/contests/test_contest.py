# SPDX-License-Identifier: BSD-3-Clause
"""A contest on the calibration device: the better one wins, equals are equal, and nobody is favoured."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, RecordingError
from forcetorque.base.wrench import MeasureDirection
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.contests.commands import contest
from forcetorque.contests.contest_file import Contestant, ContestRun, Entries, Method
from forcetorque.contests.contest_scores import Contest
from forcetorque.experiment.validation_offset import Offset
from forcetorque.recording.recording import Use
from forcetorque.sensor.catalogue import find_sensor
from forcetorque.workbench.bench_recording import BenchRecording
from forcetorque.workbench.known_loads import THESIS_TABLE, read_loads
from forcetorque.workbench.position_means import Bench
from tests.device.device_contest import DEVICE, NOISE, maker, planted, run_of

JUDGED, FITTED = (10.0, 20.0), (5.0, 25.0)
BOUGHT, OURS, THIRD = DEVICE.sensor_names
WORSE = 0.02


@pytest.fixture(scope="module")
def entries() -> Entries:
    """Three stacked sensors, the second a third better, by runs that judge and runs to fit on."""
    rng = np.random.default_rng(11)
    priors = {name: planted(name, WORSE / 1.5 if name == OURS else WORSE, JUDGED, rng) for name in DEVICE.sensor_names}
    judged = [run_of(f"judge {load:g}, {k}", load, rng, priors=priors) for load in JUDGED for k in range(2)]
    fitted = [run_of(f"fit {load:g}", load, rng, priors=priors, use=Use.CALIBRATION) for load in FITTED]
    runs = tuple(replace(run, started_h=0.1 * k) for k, run in enumerate([*fitted, *judged]))
    return Entries(name="stack", runs=runs, contestants=tuple(map(maker, DEVICE.sensor_names)))


def _method(name: str, method: Method, sensor: str = THIRD, **more: object) -> Contestant:
    return Contestant(name=name, sensor=sensor, method=method, **more)  # type: ignore[arg-type]


@pytest.fixture(scope="module")
def answer(entries: Entries) -> Contest:
    """What they, methods on the third, and some that lack what they need, come to."""
    methods = (
        _method("in situ", Method.IN_SITU),
        _method("in situ, no prior", Method.IN_SITU_WITHOUT_PRIOR),
        _method("bench", Method.WORKBENCH),
        _method("file", Method.CALIBRATION),
        _method("masses", Method.KNOWN_MASSES),
        _method("reference", Method.REFERENCE_SENSOR),
        _method("unknown", Method.MAKER, sensor="elsewhere"),
    )
    return contest(replace(entries, contestants=(*entries.contestants, *methods)))


def test_the_planted_one_wins_and_the_others_are_equal(entries: Entries) -> None:
    """Of the bare three; its error is a third lower, of force and moment over the loads."""
    result = contest(entries)
    assert result.comparable
    assert result.winner == OURS
    by_name = {row.contestant: row for row in result.contestants}
    assert result.contestants[0].contestant == OURS
    for name in (BOUGHT, THIRD):
        assert by_name[OURS].error_percent / by_name[name].error_percent == pytest.approx(1.0 / 1.5, rel=0.05)
    (pair,) = (p for p in result.pairs if p.error_of == "wrench" and {p.contestant, p.other} == {BOUGHT, THIRD})
    assert pair.conclusion == "no difference"
    assert f"{OURS} errs least, significantly" in str(result)
    assert result.loads_kg == JUDGED


def test_unlike_loads_have_no_winner(entries: Entries, monkeypatch: pytest.MonkeyPatch) -> None:
    """The same stack, were moments about unlike levers no one load: errors in % of the loads of all rank nobody."""
    monkeypatch.setattr("forcetorque.contests.contest_scores._ONE_STACK", 1.2)
    result = contest(entries)
    assert (result.comparable, result.winner) == (False, None)
    assert next(iter(result.answers())).verdict == "NOT COMPARABLE"
    assert "not comparable: the contestants do not carry one load" in str(result)
    (words,) = (words for words in result.warnings if "one load" in words)
    assert "errs less in N m" in words


def test_methods_meet_and_what_lacks_something_is_named(answer: Contest) -> None:
    """The others go on; in situ, with or without a prior, finds the matrix, and the two are equal."""
    why = {row.contestant: row.why for row in answer.left_out}
    assert set(why) == {"bench", "file", "masses", "reference", "unknown"}
    assert "a workbench file" in why["bench"]
    assert "a calibration file" in why["file"]
    assert "an accelerometer" in why["masses"]
    assert "another sensor" in why["reference"]
    assert "no run with a validation interval has the sensor elsewhere" in why["unknown"]
    assert {row.contestant for row in answer.contestants if row.rank == 1} == {"in situ", "in situ, no prior"}
    assert answer.winner is None
    assert "no contestant wins" in str(answer)
    (pair,) = (p for p in answer.pairs if p.error_of == "wrench" and p.contestant == "in situ" and "no" in p.other)
    assert pair.conclusion == "no difference"
    by_name = {row.contestant: row for row in answer.contestants}
    assert by_name["in situ"].fitted_loads_kg == FITTED


def test_rows_hold_together(answer: Contest) -> None:
    """A row per contestant and load, a pair of each two; JSON and CSV have them; scores are of their size."""
    count = len(answer.contestants)
    assert len(answer.loads) == count * len(JUDGED)
    assert len(answer.pairs) == 3 * count * (count - 1) // 2
    for row in answer.loads:
        assert row.rmse_low is not None
        assert row.rmse_high is not None
        assert (row.rmse_low < row.rmse).all()
        assert (row.rmse < row.rmse_high).all()
    for contestant in answer.contestants:
        assert contestant.repeatability is not None
        # a phase has some ten samples, and the encoders move the reference
        assert (contestant.repeatability < 5.0 * NOISE).all()
        assert contestant.drift_per_hour is not None
        assert contestant.drift_per_degC is None
    assert Contest.model_validate_json(answer.json_text()).winner is None
    assert {line["row"] for line in answer.records()} == {"contestant", "pair"}


@pytest.mark.long
def test_loads_that_somebody_was_fitted_on_are_refused(entries: Entries) -> None:
    """By a run, by what is stated of a file; the message names who, the load and the run."""
    rng = np.random.default_rng(1)
    priors = {one.name: one.prior for one in entries.runs[0].experiment.sensors if one.prior is not None}
    more = run_of("fit 10", 10.0, rng, use=Use.CALIBRATION, priors=priors)
    fitted = replace(
        entries, runs=(*entries.runs, more), contestants=(maker(BOUGHT), _method("in situ", Method.IN_SITU))
    )
    with pytest.raises(ExperimentError, match=r"judge 10, 0: .* got 10 kg, on which 'in situ' was; .* favours it"):
        contest(fitted)
    apart = replace(fitted.contestants[1], fitted_on=("fit 5",))
    contest(replace(fitted, contestants=(fitted.contestants[0], apart)))
    stated = replace(maker(THIRD), fitted_loads_kg=(20.0,))
    with pytest.raises(ExperimentError, match="judge 20, 0: .* got 20 kg"):
        contest(replace(entries, contestants=(maker(BOUGHT), stated)))


def test_runs_of_another_motion_are_refused(entries: Entries) -> None:
    """One that goes backwards; the message says where it is elsewhere."""
    backwards = run_of("backwards", 20.0, np.random.default_rng(1), reverse=True)
    with pytest.raises(
        RecordingError, match=r"backwards, .*: expected the motion of judge 10, 0, .* phase by phase, got"
    ):
        contest(replace(entries, runs=(*entries.runs[:-1], backwards)))


def test_too_few_can_be_judged(entries: Entries) -> None:
    """The reasons of all that were left out are in the message; so is a load under which one was not judged."""
    lacking = (maker(BOUGHT), _method("bench", Method.WORKBENCH))
    with pytest.raises(ExperimentError, match=r"at least two contestants .* got 1; bench: it needs bench"):
        contest(replace(entries, contestants=lacking))


def test_sensors_that_take_turns_are_told_apart_by_serial() -> None:
    """Of two under one name each is judged in runs of its own; without a serial number neither is."""
    rng = np.random.default_rng(5)
    better, worse = (planted(BOUGHT, size, JUDGED, rng) for size in (0.01, 0.02))
    runs: list[ContestRun] = []
    for load in JUDGED:
        runs += [run_of(f"A {load}", load, rng, priors={BOUGHT: worse}, serial="A")]
        runs += [run_of(f"B {load}", load, rng, priors={BOUGHT: better}, serial="B")]
    pair = tuple(replace(maker(BOUGHT), name=name, serial=name) for name in "AB")
    result = contest(Entries(name="turns", runs=tuple(runs), contestants=pair))
    assert result.winner == "B"
    unclear = replace(pair[0], name="either", serial=None)
    (left,) = contest(Entries(name="turns", runs=tuple(runs), contestants=(*pair, unclear))).left_out
    assert "expected serial, one of" in left.why


@pytest.mark.parametrize("offset", [Offset.FIRST_SECOND, Offset.FITTED])
def test_offsets(entries: Entries, offset: Offset) -> None:
    """With their own offset, which no data gave, all have the offset of the board in their errors."""
    short = replace(entries, runs=entries.runs[2:4], contestants=entries.contestants[:2], offset=offset)
    by_mean = contest(replace(short, offset=Offset.JUDGED_MEAN))
    result = contest(short)
    assert result.offset == offset.value
    for row, other in zip(
        sorted(result.contestants, key=lambda r: r.contestant),
        sorted(by_mean.contestants, key=lambda r: r.contestant),
        strict=True,
    ):
        assert (row.rmse >= other.rmse - 1e-12).all()  # a mean is the best constant
        assert (row.rmse > other.rmse + 1e-6).any()


def test_percent_of_full_scale(entries: Entries) -> None:
    """Of the catalogue's range; a contestant without one is named."""
    axes = find_sensor("mini58").calibrations[0].range
    full_scale = np.array([axes.fxy, axes.fxy, axes.fz, axes.txy, axes.txy, axes.tz])
    pair = (replace(maker(BOUGHT), full_scale=full_scale), maker(OURS))
    result = contest(replace(entries, runs=entries.runs[2:4], contestants=pair))
    (row,) = (row for row in result.contestants if row.contestant == BOUGHT)
    np.testing.assert_allclose(row.rmse_percent_of_full_scale, 100.0 * row.rmse / full_scale)
    assert any(OURS in words and "full scale" in words for words in result.warnings)
    assert not any("one load" in words for words in result.warnings)


def _bench(rng: np.random.Generator) -> BenchRecording:
    """The 24 positions of the thesis under the third sensor, whose counts are newtons."""
    direction = MeasureDirection.CHILD_TO_PARENT
    loads = read_loads(THESIS_TABLE, measure_direction=direction)
    bench = Bench(
        sensor=THIRD,
        serial=f"SN {THIRD}",
        loads=loads,
        raw=loads.wrench + NOISE * rng.standard_normal(loads.wrench.shape),
        full_scale=np.full(6, 1000.0),
    )
    return BenchRecording.of(bench, measure_direction=direction, frame="child")


@pytest.mark.long
def test_a_workbench_and_a_file_meet_their_like(entries: Entries) -> None:
    """A bench beats what was bought; a file is what it was fitted as; weights of the bench may not judge."""
    bench = _method("bench", Method.WORKBENCH, bench=_bench(np.random.default_rng(2)))
    fit = entries.runs[1].sensor_run(THIRD, None)
    assert fit is not None
    file = calibrate_sensor(fit, code_version="0", created="2026-01-01")
    pair = (
        _method("file", Method.CALIBRATION, calibration=file),
        _method("fitted", Method.IN_SITU, fitted_on=(entries.runs[1].name,)),
    )
    answer = contest(replace(entries, contestants=(maker(THIRD), bench, *pair)))
    assert answer.left_out == ()
    rows = {row.contestant: row for row in answer.contestants}
    assert rows["bench"].rank < rows[THIRD].rank
    assert rows["bench"].fitted_loads_kg == (5.0, 25.0)
    np.testing.assert_array_equal(rows["file"].rmse, rows["fitted"].rmse)
    heavy = run_of("judge 25", 25.0, np.random.default_rng(3))
    with pytest.raises(ExperimentError, match="judge 25: .* got 25 kg, on which 'bench' was"):
        contest(replace(entries, runs=(*entries.runs[2:], heavy), contestants=(maker(THIRD), bench)))


@pytest.mark.long
def test_a_calibration_of_another_sensor_is_left_out(entries: Entries) -> None:
    """By its serial number, as everywhere."""
    fit = entries.runs[1].sensor_run(OURS, None)
    assert fit is not None
    file = calibrate_sensor(fit, code_version="0", created="2026-01-01")
    stranger = _method("stranger", Method.CALIBRATION, calibration=file)
    answer = contest(replace(entries, contestants=(maker(THIRD), maker(OURS), stranger)))
    (left,) = answer.left_out
    assert f"SN {OURS}" in left.why
