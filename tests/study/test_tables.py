# SPDX-License-Identifier: BSD-3-Clause
"""Tables 5.2 to 5.7 and figure 5.4 against what they say, computed from the samples."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, Offset
from forcetorque.study import thesis_tables as tables
from forcetorque.study.candidate_fits import Study, run_study
from forcetorque.study.candidate_selection import TABLE_LAMBDAS, Candidate
from tests.study.measured import COMBINATIONS, FITTED, JUDGED, PRIOR, TEMPERATURE, errors_by_samples, study

EXACT = 1e-9
"""Relative: squared errors from moments, rounding times readings of 500 N over errors of 0.5 N, squared."""
SAME_FIT = 1e-6
"""Relative: two ways to the same fit differ by rounding times its condition."""

BOTH = pytest.mark.parametrize("source", list(KNOWN_BEFORE))


@cache
def _without_prior() -> Study:
    return run_study(FITTED, COMBINATIONS, JUDGED, prior=None, variables=[TEMPERATURE], sphere=("grid", "grid_2"))


def _numbers(row: tables.Row) -> FloatArray:
    return np.array([row[component] for component in WRENCH_COMPONENTS], dtype=np.float64)


def _candidate(data_set: str, kind: str, table_lambda: float) -> Candidate:
    wanted = (data_set, kind, table_lambda)
    return next(c for c in study().fits.candidates if (c.data_set, c.kind.name, c.table_lambda) == wanted)


def _force_mean(model: WrenchModel, source: Offset) -> float:
    errors = np.concatenate([errors_by_samples(model, one, source) for one in JUDGED])
    return float(np.linalg.norm(errors[:, :3], axis=1).mean())


def test_table_5_2_is_the_mean_squared_error_on_the_fitted_samples() -> None:
    """(5.19) per axis at lambda 0: 27 rows; centralised and one-shot are the same, the temperature helps."""
    rows = tables.squared_errors(study())
    keys = [(row["data_set"], row["type"]) for row in rows]
    assert keys == [(name, kind) for name in COMBINATIONS for kind in ESTIMATION_TYPES]
    for row in rows:
        model = _candidate(str(row["data_set"]), str(row["type"]), 0.0).model
        data = [one for one in FITTED if one.label in COMBINATIONS[str(row["data_set"])]]
        variables = [one.variables if model.coefficients.shape[1] else None for one in data]
        errors = np.concatenate(
            [model.wrench(one.raw, v) - one.reference for one, v in zip(data, variables, strict=True)]
        )
        np.testing.assert_allclose(_numbers(row), (errors**2).mean(axis=0), rtol=EXACT)
    found = {key: _numbers(row) for key, row in zip(keys, rows, strict=True)}
    for name in COMBINATIONS:
        for one, other in (("CnTdTO", "OnTdTO"), ("CwTdTO", "OwTdTO"), ("CwTrTO", "OwTrTO"), ("OwTdTO", "OwTrTO")):
            np.testing.assert_allclose(found[name, one], found[name, other], rtol=SAME_FIT)
        assert (found[name, "OwTrTO"] < found[name, "OnTdTO"]).all()
        assert (found[name, "OwTrTO"] < found[name, "SwTrTO"] * (1.0 + EXACT)).all()


@pytest.mark.parametrize("name", COMBINATIONS)
def test_table_5_3_is_the_mean_absolute_difference_of_matrices(name: str) -> None:
    """Workbench first, then the nine types: symmetric, zero on the diagonal and between C and O; in 1e-4."""
    names, values = tables.matrix_differences(study(), name)
    assert names == ("workbench", *ESTIMATION_TYPES)
    matrices = [PRIOR, *(_candidate(name, kind, 0.0).model.matrix for kind in ESTIMATION_TYPES)]
    for i, one in enumerate(matrices):
        for j, other in enumerate(matrices):
            by_hand = sum(abs(one[a, b] - other[a, b]) for a in range(6) for b in range(6)) / 36 / 1e-4
            assert values[i, j] == pytest.approx(by_hand, rel=EXACT, abs=1e-12)
    assert np.array_equal(values, values.T)
    assert np.array_equal(np.diag(values), np.zeros(10))
    place = {kind: k for k, kind in enumerate(names)}
    same = [("CnTdTO", "OnTdTO"), ("CwTdTO", "OwTdTO"), ("CwTdTO", "CwTrTO"), ("OwTdTO", "OwTrTO")]
    assert max(values[place[a], place[b]] for a, b in same) < SAME_FIT
    assert values[place["CnTdTO"], place["CwTdTO"]] > 1e-3
    assert values[0, 1:].min() > 0.1


def test_table_5_4_offsets_of_the_two_reference_temperatures_differ_by_what_the_temperature_adds() -> None:
    """The offset with rTO is that with dTO plus c t0 for C and O, and C equals O; for S they are other fits."""
    rows = {(row["data_set"], row["type"]): _numbers(row) for row in tables.offsets(study())}
    assert len(rows) == 27
    for name in COMBINATIONS:
        for strategy in "CO":
            zero, first = rows[name, f"{strategy}wTdTO"], rows[name, f"{strategy}wTrTO"]
            model = _candidate(name, f"{strategy}wTrTO", 0.0).model
            assert model.reference_values.tolist() == [29.0]
            np.testing.assert_allclose(first - zero, 29.0 * model.coefficients[:, 0], rtol=SAME_FIT, atol=SAME_FIT)
            assert np.abs(first - zero).max() > 10.0
        for kind in ("nTdTO", "wTdTO", "wTrTO"):
            np.testing.assert_allclose(rows[name, f"C{kind}"], rows[name, f"O{kind}"], rtol=SAME_FIT, atol=SAME_FIT)
        sphere = _candidate(name, "SwTrTO", 0.0).model
        moved = rows[name, "SwTrTO"] - rows[name, "SwTdTO"]
        assert not np.allclose(moved, 29.0 * sphere.coefficients[:, 0], rtol=0.1)


@BOTH
def test_tables_5_5_and_5_6_have_the_form_of_the_thesis(source: Offset) -> None:
    """A row per combination and type, a column per lambda as printed, their mean, and the workbench below."""
    *rows, workbench = tables.mean_forces(study(), source)
    printed = [0, 1, 5, 10, 50, 100, 1000, 5000, 10000, 50000, 100000, 500000, 1000000]
    lambdas = [f"lambda {6 * value} (table {value})" for value in printed]
    assert [(row["data_set"], row["type"]) for row in rows] == [(n, k) for n in COMBINATIONS for k in ESTIMATION_TYPES]
    assert {tuple(row) for row in rows} == {("data_set", "type", *lambdas, "mean")}
    for row in rows[::4]:
        for heading, table_lambda in zip(lambdas, TABLE_LAMBDAS, strict=True):
            model = _candidate(str(row["data_set"]), str(row["type"]), table_lambda).model
            assert row[heading] == pytest.approx(_force_mean(model, source), rel=EXACT)
    for row in rows:
        assert row["mean"] == pytest.approx(np.mean([float(row[heading]) for heading in lambdas]))
    assert workbench == {
        "data_set": "workbench",
        "type": "",
        "mean": pytest.approx(
            _force_mean(WrenchModel(matrix=PRIOR, offset=np.zeros(6)), Offset.FIRST_SECOND), rel=EXACT
        ),
    }


def test_lambdas_that_differ_little_keep_their_columns() -> None:
    """Headings have all the digits that were typed."""
    found = run_study(
        FITTED, {"a": ("cold",)}, JUDGED, prior=PRIOR, variables=[TEMPERATURE],
        kinds=[ESTIMATION_TYPES["OnTdTO"]], lambdas=[0.75, 1234566.0, 1234572.0],
    )  # fmt: skip
    row, _ = tables.mean_forces(found, Offset.FIRST_SECOND)
    assert list(row) == [
        "data_set", "type", "lambda 0.75 (table 0.125)", "lambda 1234566 (table 205761)",
        "lambda 1234572 (table 205762)", "mean",
    ]  # fmt: skip
    # the smallest lambda stands in for 0 in tables 5.2 to 5.4
    assert [c.lambda_counts2 for c in tables.unregularised(found)] == [0.75]


def test_table_5_7_is_the_best_of_every_axis() -> None:
    """In both modes, with the value of the workbench, by a search over all candidates."""
    rows = tables.best_by_axis_table(study())
    assert [row["axis"] for row in rows] == list(WRENCH_COMPONENTS)
    prior = WrenchModel(matrix=PRIOR, offset=np.zeros(6))
    for axis, row in enumerate(rows):
        for source in KNOWN_BEFORE:
            values = study().errors[source].pooled().mean_absolute[:351, axis]
            best = [c.name for c in study().fits.candidates].index(str(row[f"best, offset {source}"]))
            assert (values > (1.0 - SAME_FIT) * values[best]).all()
            model = study().models[best]
            errors = np.concatenate([errors_by_samples(model, one, source) for one in JUDGED])
            assert row[f"value, offset {source}"] == pytest.approx(np.abs(errors[:, axis]).mean(), rel=EXACT)
        errors = np.concatenate([errors_by_samples(prior, one, Offset.FIRST_SECOND) for one in JUDGED])
        assert row["workbench"] == pytest.approx(np.abs(errors[:, axis]).mean(), rel=EXACT)


def test_the_rows_of_all_candidates_say_what_they_are_and_how_they_do() -> None:
    """352 rows; lambda in its three conventions, errors of both modes and their standard error."""
    rows = tables.candidate_rows(study())
    assert len(rows) == 352
    for row, candidate in zip(rows[:-1], study().fits.candidates, strict=True):
        assert (row["data_set"], row["type"]) == (candidate.data_set, candidate.kind.name)
        assert row["determined"] is candidate.determined
        assert row["lambda_counts2"] == 6.0 * float(row["table_lambda_counts2"])
        assert row["relative_lambda"] == candidate.relative_lambda
    assert "table_lambda_counts2" not in rows[-1]
    for index in (0, 100, 350, 351):
        for source, mode in ((Offset.FIRST_SECOND, "first_second"), (Offset.FITTED, "fitted")):
            judged_with = Offset.FIRST_SECOND if index == 351 else source
            errors = np.concatenate([errors_by_samples(study().models[index], one, judged_with) for one in JUDGED])
            force, moment = (np.linalg.norm(errors[:, part], axis=1) for part in (slice(0, 3), slice(3, 6)))
            assert rows[index][f"force_mean_{mode}"] == pytest.approx(force.mean(), rel=EXACT)
            assert rows[index][f"moment_mean_{mode}"] == pytest.approx(moment.mean(), rel=EXACT)
            # of all 30 blocks, by hand
            blocks = np.concatenate(
                [
                    [part.mean() for part in np.array_split(np.linalg.norm(e[:, :3], axis=1), 10)]
                    for e in (errors_by_samples(study().models[index], one, judged_with) for one in JUDGED)
                ]
            )
            assert len(blocks) == 30
            by_hand = blocks.std(ddof=1) / np.sqrt(30)
            assert rows[index][f"force_mean_error_{mode}"] == pytest.approx(by_hand, rel=EXACT)
            for axis, component in enumerate(WRENCH_COMPONENTS):
                assert rows[index][f"{component}_{mode}"] == pytest.approx(np.abs(errors[:, axis]).mean(), rel=EXACT)


def test_figure_5_4_the_difference_to_the_workbench_falls_with_lambda() -> None:
    """To nothing in the end (5.3.1: at 1e8), and from the values of table 5.3."""
    lambdas, curves = tables.differences_to_workbench(study(), "all")
    assert lambdas == tuple(6.0 * value for value in TABLE_LAMBDAS)
    assert list(curves) == list(ESTIMATION_TYPES)
    _, table = tables.matrix_differences(study(), "all")
    for k, kind in enumerate(ESTIMATION_TYPES):
        assert curves[kind].shape == (13,)
        assert curves[kind][0] == pytest.approx(table[0, k + 1], rel=EXACT)
        assert (np.diff(curves[kind]) < 0.0).sum() >= 11
        assert curves[kind][-1] < 0.7 * curves[kind][0]
    heavy = run_study(
        FITTED, {"all": COMBINATIONS["all"]}, JUDGED, prior=PRIOR, variables=[TEMPERATURE],
        kinds=[ESTIMATION_TYPES["OwTrTO"]], lambdas=[0.0, 6e15],
    )  # fmt: skip
    curve = tables.differences_to_workbench(heavy, "all")[1]["OwTrTO"]
    assert curve[1] < 1e-6 * curve[0]


def test_without_a_prior_the_tables_do_without_the_workbench() -> None:
    """Table 5.3 has the nine types, 5.5 no last row, 5.7 no column, and figure 5.4 is refused."""
    found = _without_prior()
    names, values = tables.matrix_differences(found, "all")
    assert names == tuple(ESTIMATION_TYPES)
    assert values.shape == (9, 9)
    rows = tables.mean_forces(found, Offset.FITTED)
    assert len(rows) == 27
    assert {tuple(row) for row in rows} == {("data_set", "type", "lambda 0 (table 0)", "mean")}
    assert all("workbench" not in row for row in tables.best_by_axis_table(found))
    assert len(tables.candidate_rows(found)) == 27
    with pytest.raises(FitError, match="need one; this sensor has no prior"):
        tables.differences_to_workbench(found, "all")


def test_the_relative_lambda_does_not_depend_on_the_unit_of_counts() -> None:
    """Half the amplifier gain: counts halve, lambda is a quarter, matrices double, and all errors stay."""
    half, kinds = 0.5, [ESTIMATION_TYPES[name] for name in ("SnTdTO", "SwTrTO", "OnTdTO", "OwTrTO")]

    def studied(counts: float, lambdas: float) -> Study:
        return run_study(
            [replace(one, raw=counts * one.raw) for one in FITTED],
            COMBINATIONS,
            [replace(one, raw=counts * one.raw) for one in JUDGED],
            prior=PRIOR / counts,
            variables=[TEMPERATURE],
            kinds=kinds,
            lambdas=[lambdas * value for value in (0.0, 600.0, 6e5)],
            sphere=("grid", "grid_2"),
        )

    whole, halved, unscaled = studied(1.0, 1.0), studied(half, half**2), studied(half, 1.0)
    assert len(whole.fits.candidates) == 36
    for one, other in zip(whole.fits.candidates, halved.fits.candidates, strict=True):
        assert one.relative_lambda == pytest.approx(other.relative_lambda, rel=EXACT)
        np.testing.assert_allclose(half * other.model.matrix, one.model.matrix, rtol=SAME_FIT, atol=1e-10)
    for source in KNOWN_BEFORE:
        errors = [each.errors[source].pooled().force_mean for each in (whole, halved, unscaled)]
        np.testing.assert_allclose(errors[1], errors[0], rtol=SAME_FIT)
        assert np.abs(errors[2] / errors[0] - 1.0).max() > 0.01  # negative control: lambda has the unit counts2
