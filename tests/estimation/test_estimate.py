# SPDX-License-Identifier: BSD-3-Clause
"""Estimates of an experiment: a known push is found, and what the log cannot tell is left out by name."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import EstimationError, ExperimentError, RecordingError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.result import summarise_estimates
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.contacts import contact_in_words
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.recording import Recording, Use
from forcetorque.recording.storage import read_recording, write_recording
from forcetorque.recording.stream import Signal, Stream
from forcetorque.robot.contacts import Wrenches
from tests.results.showing import require_shown
from tests.scenes.experiments import MOUNTED, PARQUET, TWO, add, edit

PUSH = np.array([5.0, -3.0, 8.0, 0.1, 0.2, -0.15])
"""What the environment does to the link beyond the sensor, in the sensor's frame; N, N m."""

CLOSE = np.array([0.1, 0.1, 0.1, 0.01, 0.01, 0.01])
"""Largest error of a mean over 400 samples after calibration: noise of 4 counts is some 0.15 N and 0.003 N m each."""


def _with_stream(folder: Path, stream: Stream) -> None:
    recording = read_recording(folder / "recording")
    write_recording(folder / "recording", Recording(streams={**recording.streams, stream.name: stream}))


def _pushed(folder: Path, *, after_s: float) -> None:
    """Let something push from an instant on; a `child_to_parent` sensor reads what acts on the child."""
    stream = read_recording(folder / "recording").stream("arm_ft")
    late = (stream.stamp_ns - stream.stamp_ns[0]) * 1e-9 >= after_s
    raw = stream.signal("raw").values + late[:, None] * np.linalg.solve(MOUNTED, PUSH)
    _with_stream(folder, replace(stream, signals={"raw": replace(stream.signal("raw"), values=raw)}))


@pytest.fixture(scope="module")
def fitted(intact: Path) -> Calibration:
    """Calibration of the arm's sensor before anything pushed."""
    experiment = load_experiment(intact / PARQUET)
    return calibrate_sensor(
        SensorRun(experiment, experiment.sensors[0]), code_version="1", created="now", regularisation=1.0
    )


def test_a_push_is_found(arm: Path, fitted: Calibration) -> None:
    """The contact at the sensor is the push where there is one, and nothing where there is none."""
    _pushed(arm, after_s=14.2)
    experiment = load_experiment(arm / PARQUET)
    before, after = estimate_experiment(experiment, corrections_of(experiment, {"fitted": fitted}))
    assert (before.interval.label, after.interval.label) == ("fit", "judge")
    assert len(before.estimates) > 400
    assert (np.abs(before.estimates.contact("arm_ft").mean(axis=0)) < CLOSE).all()
    assert (np.abs(after.estimates.contact("arm_ft").mean(axis=0) - PUSH) < CLOSE).all()
    # negative control: the opposite sign would not pass
    assert not (np.abs(after.estimates.contact("arm_ft").mean(axis=0) + PUSH) < CLOSE).any()


def test_progress_counts_the_samples_of_all_intervals(arm: Path, fitted: Calibration) -> None:
    """It rises to all of them, and the second interval goes on where the first ended."""
    experiment = load_experiment(arm / PARQUET)
    said: list[tuple[int, int]] = []
    spans = estimate_experiment(
        experiment, corrections_of(experiment, {"fitted": fitted}), progress=lambda *counts: said.append(counts)
    )
    first, total = len(spans[0].estimates), sum(len(span.estimates) for span in spans)
    done = [count for count, _ in said]
    assert {whole for _, whole in said} == {total}
    assert done == sorted(done)
    assert {first, total} <= set(done)
    assert first < total == done[-1]


def test_the_push_reaches_support_and_joints(arm: Path, fitted: Calibration) -> None:
    """The support's force changes by minus the push's in size, and torques inboard of the sensor change too."""
    still = load_experiment(arm / PARQUET)
    free = estimate_experiment(still, corrections_of(still, {"fitted": fitted}))[1].estimates
    _pushed(arm, after_s=14.2)
    experiment = load_experiment(arm / PARQUET)
    pushed = estimate_experiment(experiment, corrections_of(experiment, {"fitted": fitted}))[1].estimates
    change = np.linalg.norm((pushed.contact("base") - free.contact("base"))[:, :3], axis=1)
    np.testing.assert_allclose(change, np.linalg.norm(PUSH[:3]), rtol=1e-2)
    assert np.abs(pushed.torque("shoulder_pitch") - free.torque("shoulder_pitch")).max() > 0.1


def test_a_known_wrench_explains_the_push(arm: Path, fitted: Calibration) -> None:
    """A stream that knows the push leaves nothing for the sensor's own contact."""
    _pushed(arm, after_s=14.2)
    link = load_experiment(arm / PARQUET).model.joints["arm_ft_joint"].child
    source = read_recording(arm / "recording").stream("arm_ft")
    late = (source.stamp_ns - source.stamp_ns[0]) * 1e-9 >= 14.2
    skin = Signal(
        quantity="wrench",
        values=late[:, None] * PUSH,
        columns=("fx", "fy", "fz", "tx", "ty", "tz"),
        units=("N", "N", "N", "N m", "N m", "N m"),
        frame=link,
    )
    _with_stream(arm, Stream(name="skin", clock=source.clock, stamp_ns=source.stamp_ns, signals={"wrench": skin}))
    known = f'\n[[contact]]\nframe = "{link}"\nname = "skin"\ntype = "known"\nstream = "skin"\n'
    other = f'\n[[contact]]\nframe = "{link}"\nname = "other"\n'
    file = add(arm / PARQUET, known + other)
    experiment = load_experiment(file)
    after = estimate_experiment(experiment, corrections_of(experiment, {"fitted": fitted}))[1].estimates
    assert (np.abs(after.contact("other").mean(axis=0)) < CLOSE).all()


def test_a_contact_may_be_there_in_one_interval_only(arm: Path, fitted: Calibration) -> None:
    """Outside its intervals a contact is no unknown, and what acts there stays a residual."""
    _pushed(arm, after_s=0.0)
    link = load_experiment(arm / PARQUET).model.joints["arm_ft_joint"].child
    file = add(arm / PARQUET, f'\n[[contact]]\nframe = "{link}"\nintervals = ["judge"]\n')
    experiment = load_experiment(file)
    fit, judge = estimate_experiment(experiment, corrections_of(experiment, {"fitted": fitted}))
    assert link not in fit.estimates.layout.contacts
    assert (np.abs(fit.estimates.residual_of("arm_ft").mean(axis=0) - PUSH) < CLOSE).all()
    assert (np.abs(judge.estimates.contact(link).mean(axis=0) - PUSH) < CLOSE).all()
    assert np.abs(judge.estimates.residual_of("arm_ft")).max() < 1e-9


def test_without_a_calibration_the_offset_is_that_of_the_calibration_intervals(arm: Path) -> None:
    """The prior is read with the offset that makes its mean the model's, and the source says so."""
    experiment = load_experiment(arm / PARQUET)
    corrections = corrections_of(experiment, {})
    fit, _ = estimate_experiment(experiment, corrections)
    difference = fit.measured.of_name("arm_ft") - fit.estimates.expected_of("arm_ft")
    np.testing.assert_allclose(np.nanmean(difference, axis=0), 0.0, atol=1e-6)
    assert "offset over 'fit'" in corrections["arm_ft"].source


def test_missing_joints_leave_out_what_needs_them(arm: Path, fitted: Calibration) -> None:
    """Without an inboard joint the support's contact and torque go, by name; the sensor's contact stays."""
    joints = read_recording(arm / "recording").stream("joints")
    position = joints.signal("position")
    kept = [k for k, name in enumerate(position.columns) if name != "wrist"]
    assert len(kept) == len(position.columns) - 1
    thinned = Signal(
        quantity="position",
        values=position.values[:, kept],
        columns=tuple(position.columns[k] for k in kept),
        units=tuple(position.units[k] for k in kept),
    )
    _with_stream(arm, replace(joints, signals={"position": thinned}))
    experiment = load_experiment(arm / PARQUET)
    outboard = estimate_experiment(experiment, corrections_of_nothing(experiment))[1]
    text = " ".join(outboard.left_out)
    assert "wrist" in text
    assert "wrist" not in outboard.estimates.layout.joints


def corrections_of_nothing(experiment: Experiment) -> dict[str, object]:
    """Read the logged counts through the prior, without an offset."""
    recording = experiment.recording
    judged = [interval for interval in recording.intervals if interval.use is Use.VALIDATION]
    return dict(corrections_of(replace(experiment, recording=recording.with_intervals(judged)), {}))


def test_a_named_contact_that_needs_a_missing_joint_is_refused(arm: Path) -> None:
    """What was asked for by name is not left out in silence."""
    joints = read_recording(arm / "recording").stream("joints")
    position = joints.signal("position")
    first = Signal(
        quantity="position", values=position.values[:, :4], columns=position.columns[:4], units=position.units[:4]
    )
    _with_stream(arm, replace(joints, signals={"position": first}))
    experiment = load_experiment(arm / PARQUET)
    hand = contact_in_words("hand", experiment.model)
    with pytest.raises(
        ExperimentError, match=r"contact 'hand': its sub-model 'arm_ft' cannot be solved, no stream holds .*wrist"
    ):
        estimate_experiment(experiment, corrections_of_nothing(experiment), contacts=[hand])


def test_two_sensors_make_three_sub_models(arm: Path) -> None:
    """Every sensor has its own contact, and the ranks say that all are determined."""
    experiment = load_experiment(arm / TWO)
    _, judge = estimate_experiment(experiment, corrections_of(experiment, {}))
    assert judge.estimates.layout.parts == ("base", "arm_ft", "tool_ft")
    assert (judge.estimates.rank == 6).all()
    assert not judge.ambiguous


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("hnad", r"no link 'hnad'; did you mean \"hand\""),
        ("hand:push", r"no type is called 'push'; known: force, force_along, wrench"),
        ("hand:known", r"no type is called 'known'"),
        ("hand:force_along", r"expected a direction with type force_along"),
        ("hand:force_along:up", r"expected a direction x,y,z, got 'up'"),
        ("hand:force_along:0,0,2", r"expected a unit direction"),
        ("hand:force_along:0,0,1:1", r"expected FRAME, FRAME:TYPE or"),
        ("hand:force:0,0,1", r"expected no direction with type force"),
    ],
)
def test_words_that_are_no_contact(intact: Path, words: str, message: str) -> None:
    """The message says what was expected."""
    model = load_experiment(intact / PARQUET).model
    with pytest.raises((ExperimentError, ValueError), match=message):
        contact_in_words(words, model)


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ('frame = "hnad"', r"contact\[0\]: robot .* has no link 'hnad'"),
        ('frame = "hand"\nintervals = ["jugde"]', r"contact\[0\]: no interval is labelled 'jugde'; did you mean"),
        ('frame = "hand"\ntype = "known"', r"contact\[0\]: stream is for type known"),
        ('frame = "hand"\nstream = "arm_ft"', r"contact\[0\]: stream is for type known"),
        ('frame = "hand"\ndirection = [0, 0, 1]', r"contact\[0\]: direction is for type force_along"),
        ('frame = "hand"\ntype = "known"\nstream = "arm_ft"', r"contact\[0\]: stream 'arm_ft' has no wrench"),
        ('frame = "hand"\n[[contact]]\nframe = "hand"', r"contact\[1\]: the contact 'hand' is listed twice"),
    ],
)
def test_contacts_of_a_file_that_are_refused(arm: Path, entry: str, message: str) -> None:
    """The message names the table."""
    file = add(arm / PARQUET, f"\n[[contact]]\n{entry}\n")
    with pytest.raises(ValueError, match=message):
        load_experiment(file)


def test_more_than_six_unknowns_need_a_length_scale(arm: Path, fitted: Calibration) -> None:
    """Without it the error says so; with it the groups that trade off are named."""
    file = add(arm / PARQUET, '\n[[contact]]\nframe = "hand"\n[[contact]]\nframe = "forearm"\ntype = "force"\n')
    experiment = load_experiment(file)
    links = set(experiment.model.links)
    assert {"hand", "forearm"} <= links
    corrections = corrections_of(experiment, {"fitted": fitted})
    with pytest.raises(EstimationError, match=r"unknowns in .* and six equations.*length_scale"):
        estimate_experiment(experiment, corrections)
    again = load_experiment(
        edit(file, 'name = "small arm"\n', 'name = "small arm"\n\n[estimation]\nlength_scale_m = 0.2\n')
    )
    _, judge = estimate_experiment(again, corrections)
    assert judge.ambiguous


def test_sensors_on_another_clock_are_not_combined(arm: Path) -> None:
    """Readings that another clock stamped cannot be brought to these instants, so they are refused by name."""
    second = read_recording(arm / "recording").stream("tool_ft")
    _with_stream(arm, replace(second, clock="another machine"))
    experiment = load_experiment(arm / TWO)
    corrections = corrections_of_nothing(load_experiment(arm / PARQUET))
    corrections["tool_ft"] = corrections["arm_ft"]
    with pytest.raises(RecordingError, match=r"'arm_ft' and 'tool_ft' were stamped by the clocks .*'another machine'"):
        estimate_experiment(experiment, corrections)


def test_the_summary_shows_itself(arm: Path, fitted: Calibration) -> None:
    """Without a file none is named; with one it holds every sample."""
    experiment = load_experiment(arm / TWO)
    corrections = corrections_of(experiment, {"fitted": fitted})
    spans = estimate_experiment(experiment, corrections)
    summary = summarise_estimates(experiment, corrections, spans)
    assert summary.samples == sum(len(span.stamp_ns) for span in spans)
    require_shown(summary)
    assert "written" not in summary.text()
    assert not (arm / "out.csv").exists()
    written = summarise_estimates(experiment, corrections, spans, file=arm / "out.csv")
    assert (arm / "out.csv").read_bytes().count(b"\n") == written.samples + 1
    assert f"{written.samples} rows written to" in written.text()


def test_rows_of_the_summary_are_statistics_of_the_samples(arm: Path, fitted: Calibration) -> None:
    """By hand from what was estimated: norms of forces and moments of contacts, and what sub-models leave."""
    experiment = load_experiment(add(arm / TWO, '\n[[contact]]\nframe = "hand"\ntype = "force"\n'))
    corrections = corrections_of(experiment, {"fitted": fitted})
    spans = estimate_experiment(experiment, corrections)
    summary = summarise_estimates(experiment, corrections, spans)
    rows, parts = iter(summary.contacts), iter(summary.sub_models)
    for span in spans:
        estimates = span.estimates
        for name in estimates.layout.contacts:
            row, wrench = next(rows), estimates.contact(name)
            force, moment = (np.linalg.norm(wrench[:, part], axis=1) for part in (slice(3), slice(3, 6)))
            assert (row.interval, row.contact, row.samples) == (span.interval.label, name, len(force))
            shown = (row.force_mean_N, row.force_deviation_N, row.force_smallest_N, row.force_largest_N)
            by_hand = (force.mean(), force.std(ddof=1), force.min(), force.max())
            assert (*shown, row.moment_mean_Nm) == pytest.approx((*by_hand, moment.mean()))
            if row.force_half_width_95_N is not None:
                assert row.force_half_width_95_N > 1.95 * (row.force_standard_error_N or np.inf)
        for k, name in enumerate(estimates.layout.parts):
            part, left = next(parts), estimates.residual[:, k]
            assert (part.sub_model, part.rank) == (name, estimates.rank[:, k].min())
            largest = np.fmax.reduce(estimates.condition[:, k])
            assert part.condition_largest == (pytest.approx(largest) if np.isfinite(largest) else None)
            by_hand = [np.linalg.norm(left[:, half], axis=1).mean() for half in (slice(3), slice(3, 6))]
            assert [part.residual_force_mean_N, part.residual_moment_mean_Nm] == pytest.approx(by_hand)
    assert any((row.residual_moment_mean_Nm or 0.0) > 1e-6 for row in summary.sub_models)
    assert next(rows, None) is next(parts, None) is None


def test_what_cannot_be_estimated_is_a_warning_of_the_summary(arm: Path) -> None:
    """Who asks from Python is told, as who asks from a terminal is."""
    joints = read_recording(arm / "recording").stream("joints")
    position = joints.signal("position")
    kept = [k for k, name in enumerate(position.columns) if name != "wrist"]
    thinned = Signal(
        quantity="position",
        values=position.values[:, kept],
        columns=tuple(position.columns[k] for k in kept),
        units=tuple(position.units[k] for k in kept),
    )
    _with_stream(arm, replace(joints, signals={"position": thinned}))
    experiment = load_experiment(arm / PARQUET)
    corrections = corrections_of_nothing(experiment)
    summary = summarise_estimates(experiment, corrections, estimate_experiment(experiment, corrections))
    assert len(summary.left_out) > 0
    offset, *left_out = summary.warnings
    assert offset.startswith("arm_ft: no offset removed")
    assert left_out == [f"left out: {sentence}" for sentence in summary.left_out]
    assert "warnings" not in summary.json_text()


def test_a_data_set_names_the_sensors_of_what_was_measured(intact: Path) -> None:
    """One axis of sensors where all are expected, and one of their own where the model expects fewer."""
    pytest.importorskip("xarray")
    experiment = load_experiment(intact / TWO)
    span = estimate_experiment(experiment, corrections_of(experiment, {}))[0]
    for names, dim in ((("arm_ft", "tool_ft"), "sensor"), (("tool_ft",), "measured_sensor")):
        measured = Wrenches.of({name: span.measured.of_name(name) for name in names})
        labelled = replace(span, measured=measured).to_xarray()
        assert (labelled.expected.dims[1], labelled.measured.dims[1]) == ("sensor", dim)
        assert labelled[dim].values.tolist() == list(names)
        assert labelled.sensor.values.tolist() == ["arm_ft", "tool_ft"]
        np.testing.assert_array_equal(labelled.measured.values, measured.values)
        np.testing.assert_array_equal(labelled.expected.values, span.estimates.expected)
