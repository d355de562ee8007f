# SPDX-License-Identifier: BSD-3-Clause
"""What is said of contacts on skin over an interval: rows, warnings, and estimates that hold them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pyarrow.parquet as pq
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import ExperimentError
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.estimation.estimates_file import write_estimates
from forcetorque.estimation.result import skin_rows, skin_warnings
from forcetorque.estimation.skin_contacts import SkinSource, clock_stream, uncertainty_of, with_skin
from forcetorque.estimation.uncertain.estimate_with_covariance import UncertainEstimates
from forcetorque.estimation.uncertain.input_errors import Tangents
from forcetorque.estimation.uncertain.sub_model_posterior import Undetermined
from forcetorque.experiment.calibration.calibration_file import read_calibration
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.offsets import corrections_of
from forcetorque.recording.recording import Use
from forcetorque.robot.contacts import Contact, ContactType, Wrenches
from tests.scenes.experiments import PARQUET, TWO


def _on_skin(name: str, there: list[bool], force: list[list[float]], **fields: Any) -> SkinSource:
    """A contact at the origin of the hand where it is there; moments of 100 N m, which no force counts."""
    touches = np.array(there)
    return SkinSource(
        contact=Contact(link="hand", name=name, type=ContactType.KNOWN),
        wrench=np.hstack([force, np.full((len(there), 3), 100.0)]),
        tangents=None,
        centre=np.where(touches[:, None], np.zeros((len(there), 3)), np.nan),
        **{
            "covariance": np.zeros((len(there), 6, 6)),
            "beyond_range": np.zeros(len(there), dtype=np.bool_),
            "identity": touches.astype(np.int64),
            **fields,
        },
    )


def _uncertain(names: tuple[str, ...], force: FloatArray, sd: FloatArray) -> UncertainEstimates:
    """Forces of contacts and their standard deviations, moments of 100 N m; one joint and its torque."""
    n, count = force.shape[:2]
    deviations = np.concatenate([sd, np.full((n, count, 3), 100.0)], axis=2)
    return UncertainEstimates(
        contacts=names,
        contact_wrenches=np.concatenate([force, np.full((n, count, 3), 100.0)], axis=2),
        contact_covariance=deviations[:, :, :, None] ** 2 * np.eye(6),
        joints=("shoulder_yaw",),
        torques=np.arange(float(n))[:, None],
        torque_covariance=np.ones((n, 1, 1)),
        torque_lasting=np.zeros((n, 1, 0)),
        parts=(),
        residual=np.zeros((n, 0, 6)),
        rank=np.zeros(n, dtype=np.int64),
        condition=np.full(n, np.nan),
        undetermined=(Undetermined(contacts=names, samples=np.arange(n) == 1, directions=("1 N at 'palm'",)),),
    )


def _span(skin: tuple[SkinSource, ...], uncertain: UncertainEstimates | None, use: Use = Use.CALIBRATION) -> Any:
    n = 4
    return SimpleNamespace(
        interval=SimpleNamespace(label="push", use=use), stamp_ns=np.arange(n), skin=skin, uncertain=uncertain
    )


def test_the_row_of_a_contact_on_skin_by_hand() -> None:
    """Norms of 5, 2 and 10 N where it touches, of which the second is not determined with its tangential part."""
    beyond, identity = np.array([True, False, True, True]), np.array([7, 7, 0, 3])
    force = [[3.0, 4.0, 0.0], [0.0, 0.0, 2.0], [0.0, 0.0, 0.0], [0.0, 6.0, 8.0]]
    palm = _on_skin("palm", [True, True, False, True], force, beyond_range=beyond, identity=identity)
    told = np.array([[6.0, 8.0, 0.0], [np.nan] * 3, [1.0, 1.0, 1.0], [0.0, 0.0, 20.0]])[:, None]
    sd = np.array([[1.0, 2.0, 2.0], [np.nan] * 3, [9.0, 9.0, 9.0], [3.0, 4.0, 0.0]])[:, None]
    (row,) = skin_rows(_span((palm,), _uncertain(("palm",), told, sd)))
    assert (row.interval, row.contact, row.identities, row.samples) == ("push", "palm", (3, 7), 3)
    assert row.beyond_range == 2
    assert row.push_mean_N == pytest.approx(17.0 / 3.0)
    assert (row.force_mean_N, row.force_sd_N) == (pytest.approx(15.0), pytest.approx(np.sqrt((9.0 + 25.0) / 2.0)))
    (row,) = skin_rows(_span((palm,), _uncertain(("palm",), np.nan * told, np.nan * sd)))
    assert (row.push_mean_N, row.force_mean_N, row.force_sd_N) == (pytest.approx(17.0 / 3.0), None, None)
    # one that never touches has no row, nor has any without covariances
    away = _on_skin("shin", 4 * [False], 4 * [[0.0, 0.0, 0.0]])
    both = _uncertain(("shin", "palm"), np.repeat(told, 2, axis=1), np.repeat(sd, 2, axis=1))
    assert [row.contact for row in skin_rows(_span((away, palm), both))] == ["palm"]
    assert list(skin_rows(_span((palm,), None))) == []


def test_warnings_about_skin_count_samples_of_any_contact() -> None:
    """By hand: of four samples one contact touches in two, another in one of them and in a third."""
    force = 4 * [[0.0, 0.0, 1.0]]
    palm = _on_skin("palm", [True, True, False, False], force)
    back = _on_skin("back", [False, True, True, False], force, beyond_range=np.array([False, True, False, False]))
    uncertain = _uncertain(("palm", "back"), np.ones((4, 2, 3)), np.ones((4, 2, 3)))
    hidden, beyond, rest, exact = skin_warnings(_span((palm, back), uncertain), ("tool_ft",), ("arm",))
    assert hidden.startswith("push: not determined in 1 of 4 samples: no reading changes with 1 N at 'palm'")
    assert beyond.startswith("push: 'back' presses a taxel beyond what it was calibrated for in 1 of 4 samples")
    assert rest.startswith("push: skin is touched in 3 of 4 samples of a calibration interval, and the offset of arm")
    assert exact.startswith("push: readings of tool_ft count as exact")
    judged = skin_warnings(_span((palm, back), uncertain, Use.VALIDATION), (), ("arm",))
    assert list(judged) == [hidden, beyond]
    assert list(skin_warnings(_span((palm, back), None), ("tool_ft",), ("arm",))) == []


def test_skin_takes_the_place_of_contacts_and_torques_by_name(intact: Path) -> None:
    """In the order of the plain estimates, and nothing else changes."""
    experiment = load_experiment(intact / TWO)
    plain = estimate_experiment(experiment, corrections_of(experiment, {}))[0].estimates
    names, n = plain.layout.contacts, len(plain)
    assert len(names) > 1
    order = (*names[::-1], "palm")
    force = np.random.default_rng(3).normal(size=(n, len(order), 3))
    uncertain = replace(_uncertain(order, force, force), joints=plain.layout.joints, torques=plain.torques + 1.0)
    together = with_skin(plain, uncertain)
    for name in names:
        np.testing.assert_array_equal(together.contact(name), uncertain.contact(name))
    np.testing.assert_array_equal(together.torques, plain.torques + 1.0)
    for name in ("expected", "residual", "rank"):
        np.testing.assert_array_equal(getattr(together, name), getattr(plain, name))


def test_the_first_patch_with_a_table_keeps_time_where_there_is_no_sensor() -> None:
    """Its taxels are the stream at whose instants is estimated; a patch without a table feels no force."""

    def stream(sensors: list[str], **tables: str | None) -> Any:
        patches = [SimpleNamespace(counts=f"taxels of {name}", table=table) for name, table in tables.items()]
        experiment: Any = SimpleNamespace(
            name="leg",
            sensors=[SimpleNamespace(stream=name) for name in sensors],
            recording=SimpleNamespace(stream=str.upper),
            section=lambda key: SimpleNamespace(patches=patches),
        )
        return clock_stream(experiment)

    assert stream([], shin=None, calf="calf.json", foot="foot.json") == "TAXELS OF CALF"
    assert stream(["foot_ft", "hip_ft"], calf="calf.json") == "FOOT_FT"
    with pytest.raises(ExperimentError, match=r"'leg': expected \[\[sensor\]\], or a \[\[patch\]\] with a table"):
        stream([], shin=None)


def test_columns_of_a_contact_on_skin(intact: Path, tmp_path: Path) -> None:
    """Wrench, place and number where it touches, and every standard deviation but those of zero."""
    experiment = load_experiment(intact / PARQUET)
    span = estimate_experiment(experiment, corrections_of(experiment, {}))[0]
    n, names = len(span.stamp_ns), ("palm", "base")
    touches, number = np.arange(n) % 3 > 0, np.arange(n, dtype=np.int64) + 5
    force, sd = np.random.default_rng(4).normal(size=(2, n, 2, 3))
    palm = _on_skin("palm", touches.tolist(), force[:, 0].tolist(), identity=touches * number)
    variances = np.where(np.arange(n) < 2, 0.0, 4.0)[:, None, None]
    uncertain = replace(_uncertain(names, force, np.abs(sd)), torque_covariance=variances)
    write_estimates(tmp_path / "out.parquet", experiment, [replace(span, skin=(palm,), uncertain=uncertain)])
    table = pq.read_table(tmp_path / "out.parquet")
    for k, axis in enumerate("xyz"):
        np.testing.assert_array_equal(table.column(f"contact.palm.f{axis}").to_numpy(), force[:, 0, k])
        np.testing.assert_array_equal(np.isnan(table.column(f"centre.palm.{axis}").to_numpy()), ~touches)
        for contact, name in enumerate(names):
            column = table.column(f"sd.contact.{name}.f{axis}").to_numpy()
            np.testing.assert_allclose(column, np.abs(sd[:, contact, k]), rtol=1e-12)
    assert table.column("identity.palm").to_pylist() == [5 + k if k % 3 else None for k in range(n)]
    assert table.column("sd.torque.shoulder_yaw").to_pylist() == [None, None, *(n - 2) * [2.0]]
    assert table.column("determined").to_pylist() == [k != 1 for k in range(n)]


def test_readings_are_as_uncertain_as_the_calibration_predicts_for_them(intact: Path) -> None:
    """Sample by sample with the offset of their session, a gap for a gap; a sensor without a posterior is exact."""
    experiment = load_experiment(intact / TWO)
    fitted = read_calibration(intact / "fitted.json")
    corrections = corrections_of(experiment, {"fitted.json": fitted})
    posterior = fitted.posterior
    assert posterior is not None
    readings = 10.0 * np.random.default_rng(5).normal(size=(4, 2, 6))
    readings[1, 0, 2] = np.nan
    measured = Wrenches(names=("arm_ft", "tool_ft"), values=readings)
    palm = _on_skin("palm", 4 * [True], 4 * [[0.0, 0.0, 1.0]], covariance=np.arange(4.0)[:, None, None] * np.eye(6))
    slipping = replace(palm, contact=Contact(link="hand", name="back"), tangents=Tangents(maps=np.ones((4, 6, 2))))
    uncertainty = uncertainty_of(experiment, corrections, (palm, slipping), measured, label="fit")
    (name,) = uncertainty.measured
    assert name == "arm_ft"
    (session,) = posterior.sessions
    for k in (0, 2, 3):
        predicted = posterior.error_covariance(readings[k, 0], session=session)
        np.testing.assert_allclose(uncertainty.measured[name][k], predicted, rtol=1e-12)
        # negative control: a session that the calibration does not know has no error of its offset
        unknown = posterior.error_covariance(readings[k, 0])
        assert np.trace(predicted - unknown) > 1e-6 * np.trace(predicted)
    assert np.isnan(uncertainty.measured[name][1]).all()
    assert list(uncertainty.known) == ["palm", "back"]
    np.testing.assert_array_equal(uncertainty.known["palm"], palm.covariance)
    assert list(uncertainty.tangents) == ["back"]
