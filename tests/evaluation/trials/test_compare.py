# SPDX-License-Identifier: BSD-3-Clause
"""Trials of sensors: how they are sorted, numbered and pooled, and that one bad file costs nothing but itself."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import ExperimentError, FormatError, MissingFileError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.commands import compare
from forcetorque.evaluation.section import TRIAL as TRIAL_SECTION
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.evaluation.trials.comparison import Comparison, comparison_blocks
from forcetorque.evaluation.trials.trials import TrialGroup, TrialSphere, group_trials, mean_of_trials, read_trials
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.experiment_file import parse_experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.results.table import Table
from tests.evaluation.sphere.clouds import DEFORMED, WEIGHT, grid, map_of
from tests.report.drawing import sphere_of
from tests.scenes.experiments import PARQUET, TWO, add, edit

GRAVITY = 9.81
TRIAL = '\n[trial]\ncondition = "2 N m"\nnumber = {}\n'


def _trial(
    rng: np.random.Generator,
    offset: float,
    *,
    number: int | None = None,
    condition: str | None = "2 N m",
    **changes: float,
) -> TrialSphere:
    """A trial whose sensor read so much along each axis without force."""
    directions = grid(400, changes.get("half_deg", 110.0))
    stretched = np.array([1.0, changes.get("stretch", 1.0), 1.0])
    force = (directions @ map_of(DEFORMED).T) * stretched + offset + 0.3 * rng.normal(size=directions.shape)
    mass = changes.get("mass", WEIGHT / GRAVITY)
    return TrialSphere(
        file=f"{offset}.toml",
        experiment="bench",
        condition=condition,
        number=number,
        prior=np.eye(6) * changes.get("matrix", 1.0),
        sphere=sphere_of(force, WEIGHT * directions, mass=mass),
    )


def _group(trials: list[TrialSphere]) -> TrialGroup:
    (group,), warnings = group_trials(trials)
    assert warnings == []
    return group


def test_three_trials_of_which_one_drifts() -> None:
    """The pooled fit has each offset; mean and pooled fit stay apart; the axis that changed is named."""
    rng = np.random.default_rng(1)
    group = _group([_trial(rng, 0.0), _trial(rng, 40.0), _trial(rng, -20.0, stretch=1.06)])
    assert group.pooled is not None
    assert group.pooled.mapped_centres is not None
    np.testing.assert_allclose(group.pooled.mapped_centres, np.outer([0.0, 40.0, -20.0], np.ones(3)), atol=0.5)
    for mode in (True, False):
        indices = group.identifiable_indices(with_model=mode)
        mean, _, _ = mean_of_trials(indices)
        drift, fit = group.drift(with_model=mode), group.pooled_fit(with_model=mode)
        assert drift is not None
        assert fit is not None
        singles = [trial.fit(with_model=mode) for trial in group.trials]
        assert mean == pytest.approx(np.mean([one.index for one in singles if one is not None]) / GRAVITY)
        assert mean != fit.index / GRAVITY
        assert group.index(with_model=mode) == fit.index / GRAVITY
        assert (len(indices), drift.index_kg) == (3, pytest.approx(indices[-1] - indices[0]))
        assert drift.exceeds is not None
        assert [name for name in drift.exceeds if name.startswith("mass")] == ["mass y"]
        assert GRAVITY * drift.mass_kg[1] == pytest.approx(0.06 * DEFORMED.axis_intersections[1], abs=0.3)
        assert {"centre x", "centre y", "centre z"} <= set(drift.exceeds)


@pytest.mark.long
def test_only_the_direction_of_drift_depends_on_the_order() -> None:
    """Turned round, means and pooled fits are the same, and the drift has the other sign."""
    rng = np.random.default_rng(2)
    trials = [_trial(rng, 0.0), _trial(rng, 10.0), _trial(rng, 5.0, stretch=1.03)]
    there, back = _group(trials), _group(trials[::-1])
    for mode in (True, False):
        ours, theirs = there.pooled_fit(with_model=mode), back.pooled_fit(with_model=mode)
        assert ours is not None
        assert theirs is not None
        assert (ours.index, ours.index_low, ours.index_high) == (theirs.index, theirs.index_low, theirs.index_high)
        means = [mean_of_trials(group.identifiable_indices(with_model=mode))[0] for group in (there, back)]
        assert means[0] == pytest.approx(means[1], rel=1e-14)
        drifts = [group.drift(with_model=mode) for group in (there, back)]
        assert drifts[0] is not None
        assert drifts[1] is not None
        assert drifts[0].index_kg == -drifts[1].index_kg != 0.0
        np.testing.assert_array_equal(drifts[0].centre_N, -drifts[1].centre_N)


def test_numbers_order_trials_and_half_of_them_do_not() -> None:
    """Where each trial has its own number, that rules; else the order of the files does, with a warning."""
    rng = np.random.default_rng(3)
    numbered = [_trial(rng, 1.0, number=7), _trial(rng, 2.0, number=2)]
    assert [trial.number for trial in _group(numbered).trials] == [2, 7]
    for numbers in ((7, None), (2, 2)):
        trials = [replace(trial, number=number) for trial, number in zip(numbered, numbers, strict=True)]
        (group,), (warning,) = group_trials(trials)
        assert group.trials == tuple(trials)
        assert "leg_ft (SN1), 2 N m, prior: [trial] number is missing or double" in warning


def test_conditions_sensors_and_candidates_are_kept_apart() -> None:
    """What is not the same is neither averaged nor pooled."""
    rng = np.random.default_rng(4)
    one = _trial(rng, 1.0)
    others = [
        replace(one, condition=None),
        replace(one, sphere=replace(one.sphere, serial="SN2")),
        replace(one, sphere=replace(one.sphere, calibration="new.json")),
    ]
    groups, _ = group_trials([one, *others, _trial(rng, 2.0)])
    assert [len(group.trials) for group in groups] == [2, 1, 1, 1]
    assert [group.pooled is None for group in groups] == [False, True, True, True]
    for group in groups[1:]:
        assert group.drift(with_model=True) is None
        fit = group.first.fit(with_model=True)
        assert fit is not None
        assert group.index(with_model=True) == fit.index / GRAVITY


def test_what_is_not_known_is_not_averaged_nor_ranked() -> None:
    """A cap among the trials is left out of the mean without the model; alone it has neither mean nor rank."""
    rng = np.random.default_rng(5)
    whole, cap = _trial(rng, 1.0), _trial(rng, 2.0, half_deg=15.0)
    indices = _group([whole, cap]).identifiable_indices(with_model=False)
    assert indices == [whole.sphere.analysis.free.index / GRAVITY]
    alone = _group([cap])
    assert alone.identifiable_indices(with_model=False) == []
    assert alone.index(with_model=False) is None
    drift = _group([whole, cap]).drift(with_model=False)
    assert drift is None or not drift.identifiable


def _compared(*trials: TrialSphere) -> tuple[Comparison, dict[str, Table], list[str]]:
    """Trials compared: the result, its tables by caption, and its sentences."""
    result = Comparison.of(trials, (), lambda line: None)
    blocks = list(result.blocks())
    tables = {block.caption: block for block in blocks if isinstance(block, Table)}
    return result, tables, [block for block in blocks if isinstance(block, str)]


DRIFT = "drift: last trial minus first"
OF_CONDITIONS = "leg_ft (SN1), prior: index with the model, kg"


def test_trials_of_one_condition_stand_below_each_other_with_their_drift() -> None:
    """Every cell from the trials themselves; the sensor read 30 N more in the last one; one group has no rank."""
    rng = np.random.default_rng(7)
    result, tables, sentences = _compared(_trial(rng, 0.0), _trial(rng, 30.0))
    (first, last), (group,) = result.trials, result.groups
    assert first.with_model is not None is not last.with_model
    assert group.with_model is not None
    pooled, table = group.with_model.pooled, tables[OF_CONDITIONS]
    assert pooled is not None
    indices = [row.with_model.index_kg or 0.0 for row in (first, last) if row.with_model is not None]
    assert table.headings == ("trial", "2 N m")
    assert table.rows[:3] == (
        ("1", f"{indices[0]:.4f}"),
        ("2", f"{indices[1]:.4f}"),
        ("mean of trials", f"{sum(indices) / 2.0:.4f}"),
    )
    assert table.rows[4] == ("pooled fit", f"{pooled.index_kg:.4f}")
    assert table.rows[5][1] == f"{pooled.index_low_kg:.2f} to {pooled.index_high_kg:.2f}"
    with_model, without = tables[DRIFT].rows
    assert (with_model[:2], without[1]) == (("leg_ft (SN1)", "with"), "without")
    assert float(with_model[2]) == pytest.approx(indices[1] - indices[0], abs=6e-4)
    for cells in (with_model, without):
        np.testing.assert_allclose([float(value) for value in cells[4].split()], 30.0, atol=0.5)
        assert "centre x, centre y, centre z" in cells[5]
    assert len(tables) == 4
    assert not any(sentence.startswith("rank:") for sentence in sentences)
    # the trial alone has nothing beside or below it
    _, alone, _ = _compared(_trial(rng, 0.0))
    assert list(alone) == ["every trial; errors with the model, index with and without it"]


def test_what_is_not_known_stands_in_brackets() -> None:
    """A cap tells no index without the model: its drift is in brackets, and the mean is of the other trial."""
    rng = np.random.default_rng(5)
    result, tables, _ = _compared(_trial(rng, 1.0), _trial(rng, 2.0, half_deg=15.0))
    known, cap = (row.without_model for row in result.trials)
    table = tables["leg_ft (SN1), prior: index without the model, kg"]
    assert table.rows[0] == ("1", f"{known.index_kg:.4f}")
    assert table.rows[1] == ("2", f"({cap.index_kg:.4f})")
    assert table.rows[2] == ("mean of trials", f"{known.index_kg:.4f}, 1 of 2")
    index, masses, centre, beyond = tables[DRIFT].rows[1][2:]
    assert beyond == "not identifiable"
    assert index == f"({(cap.index_kg or 0.0) - (known.index_kg or 0.0):+.3f})"
    assert all(cells.startswith("(") and cells.endswith(")") for cells in (masses, centre))
    assert not any("(" in cells for cells in tables[DRIFT].rows[0][2:])


def test_a_trial_without_the_model_has_dashes_in_its_place() -> None:
    """One dash for each error and for the index with the model; the index without it is there."""
    force = _trial(np.random.default_rng(9), 3.0).sphere.force
    alone = replace(_trial(np.random.default_rng(9), 3.0), sphere=sphere_of(force, None))
    result, tables, _ = _compared(alone)
    (row,) = tables["every trial; errors with the model, index with and without it"].rows
    assert row == ("leg_ft", "SN1", "-", "-", "-", "-", f"{result.trials[0].without_model.index_kg:.4f}")


def test_conditions_stand_beside_each_other_and_are_ranked() -> None:
    """The less even sensor comes last; a shorter column ends in dashes, and an only trial has no pooled fit."""
    rng = np.random.default_rng(8)
    uneven = _trial(rng, 0.0, condition="loose", stretch=1.3)
    result, tables, sentences = _compared(uneven, _trial(rng, 0.0), _trial(rng, 0.0))
    table = tables[OF_CONDITIONS]
    assert table.headings == ("trial", "loose", "2 N m")
    assert table.rows[1][1] == "-"
    assert table.rows[4][1] == "-"
    ranks = tables["by index of the pooled fit, or of the only trial"]
    assert [(cells[0], cells[1], cells[4], cells[7]) for cells in ranks.rows] == [
        ("leg_ft (SN1), 2 N m", "2", "1", "1"),
        ("leg_ft (SN1), loose", "1", "2", "2"),
    ]
    only, group = result.trials[0].with_model, result.groups[1].with_model
    assert only is not None
    assert group is not None
    assert group.pooled is not None
    for cells, fit in zip(ranks.rows, (group.pooled, only), strict=True):
        assert cells[2:4] == (f"{fit.index_kg:.4f}", f"{fit.index_low_kg:.2f} to {fit.index_high_kg:.2f}")
    assert any(sentence.startswith("rank: one more than the sensors") for sentence in sentences)
    # of a dozen sensors ten have tables of their own
    many = [f"SN{k}" for k in range(12)]
    rows, groups = (
        [row.model_copy(update={"serial": name}) for name in many for row in of_one]
        for of_one in (result.trials, result.groups)
    )
    blocks = list(comparison_blocks(rows, groups))
    assert sum(isinstance(block, Table) and ": index " in block.caption for block in blocks) == 20
    assert "2 more sensors have tables like these; see --format json" in blocks


@pytest.mark.parametrize(
    ("changes", "reason"),
    [({"matrix": 1.1}, "different prior matrices"), ({"mass": 3.0}, "different weights (4.73, 3 kg)")],
)
def test_what_does_not_belong_together_is_not_pooled(changes: dict[str, float], reason: str) -> None:
    """The trials stay in the table, and the reason is told."""
    rng = np.random.default_rng(6)
    group = _group([_trial(rng, 1.0), _trial(rng, 2.0, **changes)])
    assert group.pooled is None
    assert group.not_pooled is not None
    assert reason in group.not_pooled
    assert len(group.identifiable_indices(with_model=True)) == 2


def test_every_trial_has_its_own_gravity() -> None:
    """Masses are by the gravity of their file; trials of different gravity are neither pooled nor said to drift."""
    rng = np.random.default_rng(7)
    here, there = _trial(rng, 1.0), _trial(rng, 2.0)
    strong = replace(
        there, sphere=replace(there.sphere, analysis=replace(there.sphere.analysis, gravity=2.0 * GRAVITY))
    )
    group = _group([here, strong])
    for mode in (True, False):
        fits = [trial.fit(with_model=mode) for trial in (here, strong)]
        mean, _, _ = mean_of_trials(group.identifiable_indices(with_model=mode))
        indices = [fit.index / (k * GRAVITY) for k, fit in enumerate(fits, 1) if fit is not None]
        assert mean == pytest.approx(np.mean(indices), rel=1e-14)
        assert group.drift(with_model=mode) is None
        assert group.index(with_model=mode) is None
    assert (group.pooled, group.not_pooled) == (None, "the files state different gravity (9.81, 19.62 m/s2)")


def test_the_file_says_condition_and_number(arm: Path) -> None:
    """Both are optional; a number is a whole one from 1."""
    path = arm / PARQUET
    plain = load_experiment(path)
    assert (plain.section(TRIAL_SECTION).condition, plain.section(TRIAL_SECTION).number) == (None, None)
    add(path, TRIAL.format(3))
    stated = load_experiment(path)
    assert (stated.section(TRIAL_SECTION).condition, stated.section(TRIAL_SECTION).number) == ("2 N m", 3)
    for bad in ("0", '"first"', "1.5"):
        file = arm / "bad.toml"
        file.write_text(path.read_text().replace("number = 3", f"number = {bad}"))
        with pytest.raises(FormatError, match="trial.number"):
            parse_experiment(file)


def test_a_file_numbers_its_trial_and_not_each_of_several(arm: Path) -> None:
    """Of a file whose intervals are trials the number is that of none of them, but of the only one."""
    path = add(arm / PARQUET, TRIAL.format(3))
    several, failures = read_trials([path], by_interval=True)
    assert failures == []
    assert [trial.number for trial in several] == [None, None]
    (alone,), _ = read_trials([path], intervals=["judge"], by_interval=True)
    assert (alone.number, alone.condition) == (3, "2 N m")


@pytest.mark.long
def test_trials_are_what_the_analysis_gives(arm: Path) -> None:
    """A file is a trial, or each interval is one; both read as `sphere` does."""
    (whole,), failures = read_trials([arm / PARQUET])
    assert failures == []
    experiment = load_experiment(arm / PARQUET)
    (expected,) = spheres(SensorRun(experiment, "arm_ft"), {}).analyses
    np.testing.assert_array_equal(whole.sphere.force, expected.force)
    parts, _ = read_trials([arm / PARQUET], by_interval=True)
    assert [part.sphere.intervals for part in parts] == [("fit",), ("judge",)]
    np.testing.assert_array_equal(np.concatenate([part.sphere.force for part in parts]), expected.force)
    judged, _ = read_trials([arm / PARQUET], intervals=["judge"])
    assert [part.sphere.intervals for part in judged] == [("judge",)]


@pytest.mark.long
def test_a_calibration_goes_where_its_serial_number_is(arm: Path) -> None:
    """To every file with that sensor, to no other sensor of it; one that fits nowhere is a failure."""
    experiment = load_experiment(arm / PARQUET)
    fitted: Calibration = calibrate_sensor(
        SensorRun(experiment, experiment.sensors[0]), code_version="1", created="today"
    )
    trials, failures = read_trials([arm / PARQUET, arm / TWO], calibrations={"new.json": fitted})
    assert failures == []
    assert [(trial.sphere.sensor, trial.sphere.calibration) for trial in trials] == [
        ("arm_ft", "prior"),
        ("arm_ft", "new.json"),
        ("arm_ft", "prior"),
        ("arm_ft", "new.json"),
        ("tool_ft", "prior"),
    ]
    edit(arm / PARQUET, 'serial = "SIM001"', 'serial = "SIM009"')
    trials, (failure,) = read_trials([arm / PARQUET], calibrations={"new.json": fitted})
    assert len(trials) == 1
    assert failure.file == "new.json"
    assert "'arm_ft' with the serial number 'SIM001', which was read from no file" in failure.message


def test_a_bad_file_costs_only_itself(arm: Path) -> None:
    """Files, sensors and intervals that fail are listed with the file; the others are there."""
    bad = arm / "bad.toml"
    bad.write_text((arm / PARQUET).read_text().replace('path = "recording"', 'path = "nowhere"'))
    counts = arm / "counts.toml"
    text = (arm / TWO).read_text()
    assert text.count('prior = "matrix_SIM001.txt"') == 1
    counts.write_text(text.replace('prior = "matrix_SIM001.txt"', 'prior = "identity"'))
    lines: list[str] = []
    trials, failures = read_trials([bad, counts, arm / PARQUET], progress=lines.append)
    assert [(Path(trial.file).name, trial.sphere.sensor) for trial in trials] == [
        ("counts.toml", "tool_ft"),
        (PARQUET, "arm_ft"),
    ]
    assert [(Path(failure.file).name, failure.sensor) for failure in failures] == [
        ("bad.toml", None),
        ("counts.toml", "arm_ft"),
    ]
    for failure in failures:
        assert failure.file in failure.message
        assert "\n" not in failure.message
    assert len(lines) == 3
    assert lines[1].endswith("counts.toml (2 of 3)")


def test_names_are_checked_first(arm: Path) -> None:
    """A file that is not there, or twice, is refused before any is read; a sensor of no file is a failure."""
    lines: list[str] = []
    with pytest.raises(MissingFileError, match=r"none.toml: expected an experiment file, there is none"):
        read_trials([arm / PARQUET, arm / "none.toml"], progress=lines.append)
    with pytest.raises(ExperimentError, match="is named twice"):
        read_trials([arm / PARQUET, arm / ".." / arm.name / PARQUET], progress=lines.append)
    assert lines == []
    trials, (failure,) = read_trials([arm / PARQUET, arm / TWO], sensors=["tool_ft", "arm_tf"])
    assert [trial.sphere.sensor for trial in trials] == ["tool_ft"]
    assert failure.message.startswith("--sensor: no file has a sensor 'arm_tf'; did you mean \"arm_ft\"?")


@pytest.mark.long
def test_the_comparison_shows_itself(arm: Path) -> None:
    """Every number whole in a narrow terminal, tables in a notebook, few words for `repr`; arrays in none."""
    result = compare([arm / PARQUET], by_interval=True)
    text = result.text(60)
    assert [row.intervals for row in result.trials] == [("fit",), ("judge",)]
    (group,) = result.groups
    assert group.with_model is not None
    fits = [row.with_model for row in result.trials] + [group.with_model.pooled]
    for fit in fits:
        assert fit is not None
        assert f"{fit.index_kg:.4f}" in text
    assert group.with_model.drift is not None
    assert " ".join(f"{change:+.2f}" for change in group.with_model.drift.mass_kg) in text
    assert max(map(len, text.splitlines())) <= 60
    assert result._repr_html_().count("<table ") == 4
    assert len(repr(result)) < 600
    assert "analyses" not in result.json_text()
    assert "analyses" not in Comparison.described()["properties"]


@pytest.mark.long
def test_what_failed_and_what_flatters_are_warnings_of_the_result(arm: Path) -> None:
    """A notebook gets both as the terminal does; where nothing is wrong there are none."""
    experiment = load_experiment(arm / PARQUET)
    fitted = calibrate_sensor(SensorRun(experiment, "arm_ft"), code_version="1", created="today")
    result = compare([arm / PARQUET], sensors=["arm_ft", "leg_ft"], calibrations={"new.json": fitted})
    (failure,) = result.failures
    assert result.warnings == (
        f"failed: {failure.message}",
        f"{arm / PARQUET}: new.json was fitted on 'fit', so the verdict on it flatters",
    )
    assert compare([arm / PARQUET]).warnings == ()
