# SPDX-License-Identifier: BSD-3-Clause
"""Net contact forces against the weight: printed tables, planted errors, offsets by every way, and refusals."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import cast

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError, FitError
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.result import summarise_estimates
from forcetorque.estimation.skin_contacts import clock_stream
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of, still_seconds
from forcetorque.experiment.validation_offset import Offset, OffsetPolicy
from forcetorque.locomotion.commands import coherence
from forcetorque.locomotion.net_force.net_contact_wrench import readers_of
from forcetorque.locomotion.net_force.net_force import force_error, summaries_of
from forcetorque.locomotion.net_force.result import Coherence, PhaseForce
from forcetorque.recording.recording import Interval, Use
from forcetorque.simulation.recordings import write_scenario
from forcetorque.simulation.scenario.scenario import SimulatedRecording, build_scenario, simulate
from tests.locomotion.coherence_truth import net_force_errors, stamps_in
from tests.scenes.switchings import short_switching

EXACT_N = 1e-6
"""Rounding of counts that stand for 500 N, and of wrenches over 40 bodies; no noise, no errors of the robot."""
PRINTED = {
    "5.9": (
        ("-14.0252 -6.8170 342.5232", "-14.0252 -6.8170 17.8122"),
        ("-5.5024 0.4523 324.2421", "-5.5024 0.4523 -0.4689"),
        ("-17.5327 18.1905 342.6850", "-17.5327 18.1905 17.9740"),
        ("-2.4991 -0.6910 325.3190", "-2.4991 -0.6910 0.6080"),
        ("-28.3467 -9.4651 343.5918", "-28.3467 -9.4651 18.8808"),
        ("-8.3183 -0.0448 323.8349", "-8.3183 -0.0448 -0.8761"),
    ),
    "5.10": (
        ("0.0733 0.0390 323.9000", "0.0733 0.0390 -0.8110"),
        ("0.0119 0.0543 324.2001", "0.0119 0.0543 -0.5109"),
        ("-4.3180 -31.3537 324.2382", "-4.3180 -31.3537 -0.4728"),
        ("-8.1497 -5.3398 326.7298", "-8.1497 -5.3398 2.0188"),
        ("-36.9491 -21.6199 343.4446", "-36.9491 -21.6199 18.7336"),
        ("7.6190 -7.2226 321.7694", "7.6190 -7.2226 -2.9416"),
    ),
}
"""Force and error columns of the tables of the thesis."""
WEIGHT_N = 33.1 * 9.81
OFFSETS = ("one-link-imu:hanging", "one-link-imu:l_sole", "one-link-fixed-frame:l_sole")
FEET = {"l_foot_ft": "l_sole", "r_foot_ft": "r_sole"}


@dataclass(frozen=True)
class Switched:
    """One simulated day without noise, read by priors whose error is known."""

    experiment: Experiment
    simulated: SimulatedRecording
    result: Coherence

    @property
    def matrix_errors(self) -> dict[str, FloatArray]:
        errors = {}
        for sensor in self.experiment.sensors:
            assert sensor.prior is not None
            errors[sensor.name] = self.simulated.sensors[sensor.name].matrix_error(sensor.prior)
        return errors

    def interval(self, label: str) -> Interval:
        return next(one for one in self.experiment.recording.intervals if one.label == label)


@pytest.fixture(scope="module")
def switched(tmp_path_factory: pytest.TempPathFactory) -> Switched:
    """The sensors of both feet through all phases."""
    folder = tmp_path_factory.mktemp("switched") / "out"
    content = short_switching(names=tuple(FEET)).exact()
    (entry, _) = content.recording
    motion = entry.motion.model_copy(update={"still_s": 2.0})
    scenario = build_scenario(content.model_copy(update={"recording": (entry.model_copy(update={"motion": motion}),)}))
    write_scenario(scenario, folder)
    (simulated,) = simulate(scenario)
    experiment = load_experiment(folder / "switching_day1.toml")
    return Switched(experiment, simulated, coherence(experiment, offsets=OFFSETS))


def _with(experiment: Experiment, *intervals: Interval) -> Experiment:
    """The experiment with other intervals."""
    return replace(experiment, recording=replace(experiment.recording, intervals=intervals))


def test_the_printed_errors_follow_from_the_printed_forces() -> None:
    """Every cell of Tables 5.9 and 5.10 to its last digit; by the weight of 33.1 kg at standard gravity not."""
    count = 0
    for rows in PRINTED.values():
        for force, error in rows:
            forces = [float(cell) for cell in force.split()]
            assert " ".join(f"{cell:.4f}" for cell in force_error(forces, WEIGHT_N)) == error
            assert f"{force_error(forces, 33.1 * 9.80665)[2]:.4f}" != error.split()[2]  # negative control
            count += 1
    assert count == 12


def _expected(switched: Switched, label: str, offset_label: str, errors: Mapping[str, FloatArray]) -> FloatArray:
    """What the errors of the matrices make of a phase in the mean; (3,)."""
    experiment, movement, start = switched.experiment, switched.simulated.movement, switched.simulated.start_ns
    stamps, phase, gave = clock_stream(experiment).stamp_ns, switched.interval(label), switched.interval(offset_label)
    offset_stamps = stamps_in(stamps, gave.start_ns, gave.end_ns)
    offset_stamps = offset_stamps[still_seconds(experiment.recording, gave).hold(offset_stamps)]
    return net_force_errors(
        movement,
        experiment.model,
        (stamps_in(stamps, phase.start_ns, phase.end_ns) - start) * 1e-9,
        errors,
        (offset_stamps - start) * 1e-9,
        heading="r_sole" if label == "r_sole" else "l_sole",
        feet=FEET,
        weight=switched.result.weight_N,
    ).mean(axis=0)


def test_errors_are_those_of_the_planted_matrices(switched: Switched) -> None:
    """On feet, by every way to take offsets, those of true forces and planted `E`; of `E` transposed they are not."""
    count, errors = 0, switched.matrix_errors
    for row in switched.result.rows:
        if row.phase != "hanging":
            assert row.offset_interval is not None
            expected = _expected(switched, row.phase, row.offset_interval, errors)
            np.testing.assert_allclose(row.force_error_N, expected, rtol=0, atol=EXACT_N)
            count += 1
    assert count == len(OFFSETS) * 5
    # negative control
    other = _expected(switched, row.phase, "l_sole", {name: error.T for name, error in errors.items()})
    assert np.abs(row.force_error_N - other).max() > 0.1


def test_the_phase_that_gave_the_offset_is_no_evidence(switched: Switched) -> None:
    """It alone is marked, and its error is far below that of any other phase, as in the first rows of Table 5.10."""
    for label in OFFSETS:
        policy = OffsetPolicy.of(label)
        rows = [
            row for row in switched.result.rows if (row.offset, row.offset_interval) == (policy.offset, policy.interval)
        ]
        assert [row.phase for row in rows if not row.evidence] == [policy.interval]
        norms = {row.phase: float(np.linalg.norm(row.force_error_N)) for row in rows}
        gave = norms.pop(str(policy.interval))
        assert gave < 0.4 * min(norms.values())
        (summary,) = (
            one
            for one in switched.result.summary
            if (one.offset, one.offset_interval) == (policy.offset, policy.interval)
        )
        assert summary.phases == len(norms) == 5
        assert summary.force_error_largest_N == pytest.approx(max(norms.values()))


@pytest.mark.long
def test_true_matrices_bear_the_weight(switched: Switched) -> None:
    """With nothing wrong but offsets, forces and moments of all phases on still feet add up to the weight."""
    experiment = replace(
        switched.experiment,
        sensors=tuple(
            replace(sensor, prior=switched.simulated.sensors[sensor.name].matrix)
            for sensor in switched.experiment.sensors
        ),
    )
    for row in coherence(experiment, offsets=OFFSETS).rows:
        assert row.moment_error_Nm is not None
        if row.phase.startswith("double"):
            assert np.abs(row.force_error_N).max() < EXACT_N
        # a robot on the move is borne by its weight in the mean alone
        assert np.abs(row.force_error_N).max() < 1.0
        assert np.abs(row.moment_error_Nm).max() < EXACT_N


def test_tables_are_those_of_the_thesis(switched: Switched) -> None:
    """A table of forces and one of moments per offset, with a line for each phase; what is no evidence says so."""
    tables = [block for block in switched.result.blocks() if not isinstance(block, str)]
    assert len(tables) == 3 * len(OFFSETS) + 1
    assert tables[0].headings == ("phase", "read by", "Fx, N", "Fy, N", "Fz, N", "Ex, N", "Ey, N", "Ez, N", "")
    assert [row[0] for row in tables[0].rows] == ["hanging", "double_1", "l_sole", "double_2", "r_sole", "double_3"]
    assert [row[-1] for row in tables[0].rows] == ["not evidence", "", "", "", "", ""]


def test_estimates_take_the_same_offsets_and_say_where_there_is_none(switched: Switched) -> None:
    """The force on a foot is that of `coherence`; with none a warning names every sensor."""
    experiment = _with(switched.experiment, switched.interval("l_sole"), switched.interval("hanging"))
    removed = corrections_of(experiment, {}, offset="one-link-imu:hanging")
    spans = estimate_experiment(experiment, removed)
    assert not summarise_estimates(experiment, removed, spans).warnings
    force = spans[0].estimates.contact("l_sole")[:, :3].mean(axis=0)
    row = next(row for row in switched.result.rows if row.phase == "l_sole")
    np.testing.assert_allclose(force, row.force_N, rtol=0, atol=1e-3)  # the sole is level to 1e-16 rad; no filter
    left = corrections_of(experiment, {}, offset="none")
    warnings = summarise_estimates(experiment, left, estimate_experiment(experiment, left)).warnings
    assert [words.partition(":")[0] for words in warnings if "no offset removed" in words] == list(FEET)


def test_predicted_errors_are_those_of_loads_that_moved(switched: Switched) -> None:
    """The error of the matrix grows with the change of load; a sensor that the net force does not read says nothing."""

    class Twice:
        """Errors of .1 of the force."""

        def error_covariance(self, wrench: FloatArray) -> FloatArray:
            return np.diag([*(0.1 * wrench[:3]) ** 2, 0.0, 0.0, 0.0])

    (reader,) = readers_of(switched.experiment, {}, OffsetPolicy.of(OFFSETS[0]))
    known = cast("Posterior", Twice())
    gains = {"l_foot_ft": np.eye(3, 6), "r_foot_ft": np.zeros((3, 6))}
    moved = np.array([3.0, 0.0, 40.0, 1.0, 0.0, 0.0])
    means = {name: reader.offsets[name].reading + moved for name in gains}
    one = replace(reader, by_prior=(), posteriors={"l_foot_ft": known, "r_foot_ft": None})
    predicted = one.predicted_force(gains, means)
    assert predicted == pytest.approx(0.1 * np.hypot(3.0, 40.0))
    assert one.predicted_force({**gains, "r_foot_ft": np.eye(3, 6)}, means) is None  # nothing is known of it
    both = replace(one, posteriors=dict.fromkeys(gains, known))
    assert both.predicted_force(dict.fromkeys(gains, np.eye(3, 6)), means) == pytest.approx(2**0.5 * 4.011234, rel=1e-6)
    assert reader.predicted_force(gains, means) is None  # no calibration tells how far the priors may be off


@pytest.mark.parametrize(("error_N", "worse"), [(1.04, False), (1.06, True)])
def test_a_calibration_is_worse_than_the_prior_by_a_margin(error_N: float, worse: bool) -> None:
    """More than 5 % over the same phases; the prior itself is neither."""
    common = {"offset": Offset.FITTED, "offset_interval": None, "phase": "double", "evidence": True}
    rows = [
        PhaseForce.model_construct(**common, calibration=name, force_error_N=np.array([0.0, 0.0, error]))
        for name, error in (("prior", 1.0), ("new", error_N))
    ]
    prior, new = summaries_of(rows)
    assert prior.worse_than_prior is None
    assert new.worse_than_prior is worse


@pytest.mark.long
def test_the_first_phase_of_one_link_gives_the_offset_unless_told(switched: Switched) -> None:
    """Hanging with an IMU here; without it the left foot, whose gravity an IMU tells no longer."""
    intervals = switched.experiment.recording.intervals
    assert {row.offset_interval for row in coherence(switched.experiment).rows} == {"hanging"}
    standing = _with(switched.experiment, *(one for one in intervals if one.label != "hanging"))
    rows = coherence(standing).rows
    assert {(row.offset, row.offset_interval) for row in rows} == {(Offset.ONE_LINK_FIXED_FRAME, "l_sole")}


def test_no_phase_is_refused(switched: Switched) -> None:
    """Intervals that are all to be ignored."""
    ignored = (replace(one, use=Use.IGNORE) for one in switched.experiment.recording.intervals)
    with pytest.raises(ExperimentError, match="no phase found"):
        coherence(_with(switched.experiment, *ignored))


def test_a_foot_in_the_air_is_refused(switched: Switched) -> None:
    """Both feet are said to touch while the robot stands on one."""
    double, single = switched.interval("double_1"), switched.interval("l_sole")
    contacts = tuple(
        entry if entry.intervals is None else replace(entry, intervals=frozenset({*entry.intervals, "lifted"}))
        for entry in switched.experiment.contacts
    )
    lifted = replace(double, label="lifted", start_ns=single.start_ns, end_ns=single.end_ns)
    experiment = replace(_with(switched.experiment, switched.interval("hanging"), lifted), contacts=contacts)
    with pytest.raises(ExperimentError, match=r"interval 'lifted': 'r_sole' is in the air"):
        coherence(experiment)


def test_a_foot_that_bears_and_is_not_named_is_refused(switched: Switched) -> None:
    """One foot is said to bear the robot while both do, with a third of the weight on the other."""
    double, single = switched.interval("double_2"), switched.interval("l_sole")
    half = (double.start_ns + double.end_ns) // 2
    hidden = replace(single, label="hidden", start_ns=half - 10**9, end_ns=half + 10**9)
    with pytest.raises(ExperimentError, match=r"interval 'hidden': only l_sole may touch, but .* beyond 'r_foot_ft'"):
        coherence(_with(switched.experiment, switched.interval("hanging"), hidden))


def test_feet_that_move_against_each_other_are_refused(switched: Switched) -> None:
    """A foot is said to touch beside a support at rest while the robot moves on the other."""
    single = switched.interval("l_sole")
    entry = next(one for one in switched.experiment.contacts if one.contact.link == "r_sole")
    contacts = (replace(entry, intervals=frozenset({"l_sole"})),)
    with pytest.raises(ExperimentError, match=r"interval 'l_sole': l_sole and r_sole both touch, but move by \d+ mm"):
        coherence(
            replace(_with(switched.experiment, switched.interval("hanging"), single), contacts=contacts),
            offsets=["one-link-imu:hanging"],
        )


def test_a_phase_without_a_still_second_gives_no_offset(switched: Switched) -> None:
    """Half a second, or one in which the robot moves."""
    single = switched.interval("l_sole")
    short = replace(single, label="short", end_ns=single.start_ns + 500_000_000)
    with pytest.raises(ExperimentError, match=r"interval 'short': expected a second .* it lasts 0\.5 s"):
        coherence(_with(switched.experiment, short), offsets=["one-link-fixed-frame:short"])
    moving = replace(
        single, label="moving", start_ns=single.start_ns + 2_300_000_000, end_ns=single.start_ns + 3_500_000_000
    )
    with pytest.raises(ExperimentError, match=r"interval 'moving': expected a second .* in the stillest"):
        coherence(_with(switched.experiment, moving), offsets=["one-link-fixed-frame:moving"])


def test_a_missing_imu_is_named(switched: Switched) -> None:
    """An offset by an IMU of a recording that has none."""
    recording = switched.experiment.recording
    streams = {name: stream for name, stream in recording.streams.items() if name != "imu"}
    single = switched.interval("l_sole")
    bare = replace(switched.experiment, recording=replace(recording, streams=streams, intervals=(single,)), contacts=())
    with pytest.raises(ExperimentError, match=r"one-link-imu:l_sole: expected an IMU .* one-link-fixed-frame:l_sole"):
        coherence(bare, offsets=["one-link-imu:l_sole"])


@pytest.mark.parametrize(
    ("offset", "words"),
    [
        ("one-link-imu:double_1", "one link alone touches the world, but .*l_sole, r_sole may"),
        ("one-link-fixed-frame:hanging", r"expected \[\[support\]\] 'torso' with gravity_direction"),
        ("one-link-imu:hangin", "no interval is labelled 'hangin'"),
        ("one-link-imu", "expected one-link-imu:LABEL"),
        ("none:hanging", "expected none alone"),
        ("calibStanding", "no way is called 'calibStanding'"),
        ("first-second", "first-second: it comes from every judged phase itself"),
        ("tare:double_1", "nobody knows what the sensor must read"),
    ],
)
def test_offsets_that_cannot_be_told_are_refused(switched: Switched, offset: str, words: str) -> None:
    """One line that says what was expected."""
    with pytest.raises(ExperimentError, match=words):
        coherence(switched.experiment, offsets=[offset])


def test_too_few_samples_give_no_offset(switched: Switched) -> None:
    """A tare over less than ten."""
    hanging = switched.interval("hanging")
    short = replace(hanging, label="short", end_ns=hanging.start_ns + 200_000_000)
    with pytest.raises(FitError, match=r"interval 'short': expected at least 10 samples"):
        coherence(_with(switched.experiment, short), offsets=["tare:short"])
