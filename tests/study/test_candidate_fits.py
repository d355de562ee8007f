# SPDX-License-Identifier: BSD-3-Clause
"""The candidates of a study: which there are, that each is what it would be alone, and what is left out."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.calibration.thesis.calibrate import calibrate, sphere_centre
from forcetorque.experiment.calibration.estimation_type import ESTIMATION_TYPES
from forcetorque.experiment.calibration.moments import DataSet, Moments, pooled
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.study.candidate_fits import Fits, fit_candidates, run_study
from forcetorque.study.candidate_selection import SWEEP_LAMBDAS, TABLE_FACTOR, TABLE_LAMBDAS, Candidate, relative_lambda
from tests.study.measured import COMBINATIONS, FITTED, JUDGED, PRIOR, TEMPERATURE, TRUTH, grid, moving, study

SAME = 1e-8
"""Relative: rounding of double precision times the condition of the raw readings and of the temperature, some 1e6."""

NAMES = {data.label: data for data in FITTED}
ALL_TYPES = tuple(ESTIMATION_TYPES.values())


def _fits(
    data_sets: Sequence[DataSet],
    combinations: Mapping[str, Collection[str]],
    *,
    prior: FloatArray | None = PRIOR,
    lambdas: Sequence[float] = (0.0, 6000.0),
    sphere: Collection[str] | None = ("grid",),
    types: Sequence[str] = tuple(ESTIMATION_TYPES),
) -> Fits:
    return fit_candidates(
        data_sets,
        combinations,
        prior=prior,
        variables=[TEMPERATURE],
        kinds=[ESTIMATION_TYPES[name] for name in types],
        lambdas=lambdas,
        sphere=sphere,
    )


def _close(one: WrenchModel, other: WrenchModel) -> bool:
    pairs = ((one.matrix, other.matrix), (one.offset, other.offset), (one.coefficients, other.coefficients))
    return all(
        a.shape == b.shape and bool(np.abs(a - b).max(initial=0.0) <= SAME * np.abs(b).max(initial=0.0))
        for a, b in pairs
    )


def _alone(candidate: Candidate, **changes: Any) -> WrenchModel:
    """The same data and settings without a study around them."""
    labels = COMBINATIONS[candidate.data_set]
    options = {"regularisation": candidate.lambda_counts2, "sphere": [x for x in ("grid", "grid_2") if x in labels]}
    options |= changes
    data = [NAMES[label] for label in labels]
    return calibrate(data, PRIOR, kind=candidate.kind, variables=[TEMPERATURE], **options).fit.model


def test_every_combination_type_and_lambda_is_there_once() -> None:
    """The 3 x 9 x 13 = 351 candidates of thesis 5.3, in this order, nothing left out, each with a name of its own."""
    fits = study().fits
    found = [(c.data_set, c.kind.name, c.table_lambda) for c in fits.candidates]
    assert found == [(name, kind, lam) for name in COMBINATIONS for kind in ESTIMATION_TYPES for lam in TABLE_LAMBDAS]
    assert len(found) == 351
    assert fits.left_out == ()
    assert len({candidate.name for candidate in fits.candidates}) == 351
    assert fits.candidates[-1].name == "all OwTrTO lambda 6000000"
    assert [c.labels for c in fits.combinations] == list(COMBINATIONS.values())
    assert [c.moments.count for c in fits.combinations] == [500, 700, 1000]
    assert all(candidate.determined for candidate in fits.candidates)
    assert {c.excitation.excited for c in fits.combinations} == {(True,) * 6}


def test_the_lambdas_are_those_of_the_tables_as_printed() -> None:
    """Thirteen, of which the text of 5.3 lists eleven and drops 500 000; (5.4) has six times each."""
    assert TABLE_LAMBDAS == (0, 1, 5, 10, 50, 100, 1000, 5000, 10000, 50000, 100000, 500000, 1000000)
    assert TABLE_FACTOR == 6.0
    assert tuple(6.0 * value for value in TABLE_LAMBDAS) == SWEEP_LAMBDAS
    for candidate in study().fits.candidates:
        assert candidate.lambda_counts2 == 6.0 * candidate.table_lambda
        raw = np.concatenate([NAMES[label].raw for label in COMBINATIONS[candidate.data_set]])
        assert candidate.relative_lambda == pytest.approx(candidate.lambda_counts2 / raw.var(axis=0).mean(), rel=SAME)


@pytest.mark.parametrize("kind", ESTIMATION_TYPES)
def test_each_is_what_calibrate_gives_on_the_same_data(kind: str) -> None:
    """Matrix, offset, coefficients and reference values, for every combination and lambda; lambda is counted alike."""
    candidates = [candidate for candidate in study().fits.candidates if candidate.kind.name == kind]
    assert len(candidates) == 39
    for candidate in candidates:
        alone = _alone(candidate)
        assert _close(candidate.model, alone), candidate.name
        assert np.array_equal(candidate.model.reference_values, alone.reference_values)
        if candidate.table_lambda == 1000.0:  # negative control: a difference of that size is seen
            assert not _close(candidate.model, _alone(candidate, regularisation=candidate.table_lambda))


def test_reference_values_are_those_of_the_first_data_set_of_the_combination() -> None:
    """Types with rTO count the temperature from its first sample, others from zero."""
    fits = _fits(FITTED, {"late": ("warm", "cold"), "warm": ("warm",)}, types=["OwTdTO", "OwTrTO"], lambdas=[0.0])
    values = {(c.data_set, c.kind.name): c.model.reference_values.tolist() for c in fits.candidates}
    # in the order of the files, not in that of the words
    assert values == {
        ("late", "OwTdTO"): [0.0],
        ("late", "OwTrTO"): [29.5],
        ("warm", "OwTdTO"): [0.0],
        ("warm", "OwTrTO"): [42.0],
    }


def test_the_sphere_is_drawn_by_those_named_that_are_in_the_combination() -> None:
    """With one grid of two in it that one gives the raw offset, with both their pooled samples do."""
    fits = _fits(
        FITTED,
        {"one": ("grid_2", "cold"), "both": ("grid", "grid_2", "cold")},
        types=["SnTdTO"],
        sphere=("grid", "grid_2"),
    )
    grids = {data.label: Moments.of(data.raw, data.reference) for data in FITTED[:2]}
    centres = {"one": sphere_centre(grids["grid_2"]), "both": sphere_centre(pooled(grids.values()))}
    assert len(fits.candidates) == 4
    for candidate in fits.candidates:
        zero = candidate.model.wrench(centres[candidate.data_set])
        assert np.abs(zero).max() < SAME * np.abs(candidate.model.offset).max()
        other = centres["both" if candidate.data_set == "one" else "one"]
        assert np.abs(candidate.model.wrench(other)).max() > 1.0  # N; the drift between the two temperatures


def test_without_a_named_grid_the_sphere_types_are_left_out() -> None:
    """The other types of that combination and the sphere types of the others are fitted; the reason is told."""
    fits = _fits(FITTED, {"moves": ("cold", "warm"), "all": COMBINATIONS["all"]}, sphere=("grid", "grid_2"))
    assert fits.left_out == tuple(
        f"moves {kind}: sphere offset: none of grid, grid_2 is in it" for kind in ("SnTdTO", "SwTdTO", "SwTrTO")
    )
    kinds = [c.kind.name for c in fits.candidates if c.data_set == "moves" and c.table_lambda == 0.0]
    assert kinds == list(ESTIMATION_TYPES)[3:]
    assert len(fits.candidates) == 2 * (6 + 9)
    unnamed = _fits(FITTED, {"all": COMBINATIONS["all"], "grid": ("grid",)}, sphere=None, types=["SnTdTO", "OnTdTO"])
    assert unnamed.left_out == (
        "all SnTdTO: sphere offset: name the data sets that draw the sphere, out of grid, grid_2, cold, warm; "
        "in an experiment file they are sphere_intervals of [calibration]",
    )
    assert [c.kind.name for c in unnamed.candidates if c.data_set == "grid"] == ["SnTdTO"] * 2 + ["OnTdTO"] * 2


def test_without_a_prior_there_is_only_lambda_zero() -> None:
    """Nothing to pull towards and nothing to compare with: one candidate per combination and type."""
    found = run_study(FITTED, COMBINATIONS, JUDGED, prior=None, variables=[TEMPERATURE], sphere=("grid", "grid_2"))
    assert {c.table_lambda for c in found.fits.candidates} == {0.0}
    assert len(found.fits.candidates) == len(found.models) == 27
    assert found.workbench is None
    pulled = {(c.data_set, c.kind.name): c.model for c in study().fits.candidates if c.table_lambda == 0.0}
    for candidate in found.fits.candidates:
        assert _close(candidate.model, pulled[candidate.data_set, candidate.kind.name])
    with_workbench = study()
    assert len(with_workbench.models) == 352
    assert with_workbench.name(351) == "workbench"
    assert all(len(j.pooled().force_mean) == 27 for j in found.errors.values())
    assert {s.workbench_force_mean for c in found.choices.values() for s in c.across_sessions} == {None}


def _with_a_still_direction(label: str, *, seed: int) -> DataSet:
    """Channel 6 moves by noise alone: no load acts on it."""
    data = moving(label, 29.0, 31.0, seed=seed)
    raw = data.raw.copy()
    raw[:, 5] = raw[:, 5].mean()
    reference = TRUTH.wrench(raw, data.variables)
    raw[:, 5] += 5.0 * np.random.default_rng(seed).normal(size=len(raw))
    return replace(data, raw=raw, reference=reference)


def test_what_the_loads_leave_still_is_not_determined_at_lambda_zero() -> None:
    """A candidate at lambda 0 of data that leave a channel to noise is kept for the tables, but is marked."""
    still = _with_a_still_direction("still", seed=11)
    fits = _fits([still, *FITTED], {"still": ("still",), "all": tuple(NAMES)}, types=["OnTdTO", "OwTrTO"])
    determined = {(c.data_set, c.kind.name, c.table_lambda): c.determined for c in fits.candidates}
    assert len(determined) == 8
    assert determined == {key: key[0] == "all" or key[2] > 0.0 for key in determined}
    with pytest.raises(FitError, match="do not excite 1 of 6 directions"):  # as `calibrate` refuses it
        calibrate([still], PRIOR, regularisation=0.0, variables=[TEMPERATURE])


def test_what_is_not_determined_is_never_chosen() -> None:
    """Even where it does best: the choice is made among those that the data or the prior determine."""
    still = _with_a_still_direction("still", seed=11)
    combinations = {"still": ("still",)}
    found = run_study(
        [still],
        combinations,
        JUDGED,
        prior=10.0 * PRIOR,
        variables=[TEMPERATURE],
        kinds=[ESTIMATION_TYPES["OwTrTO"]],
        lambdas=[0.0, 6e12],
    )
    assert [c.determined for c in found.fits.candidates] == [False, True]
    for source, choice in found.choices.items():
        pooled_errors = found.errors[source].pooled()
        assert pooled_errors.force_mean[0] < pooled_errors.force_mean[1]
        assert (pooled_errors.mean_absolute[0] < pooled_errors.mean_absolute[1]).any()
        assert choice.by_magnitude == 1
        assert choice.by_axis == (1,) * 6
        assert [(score.chosen, score.by_axis) for score in choice.across_sessions] == [(1, (1,) * 6)] * 2
    with pytest.raises(FitError, match="lambda is 0, and in every data set the loads leave a direction"):
        run_study([still], combinations, JUDGED, prior=PRIOR, variables=[TEMPERATURE], lambdas=[0.0])


def test_a_constant_temperature_leaves_out_the_types_that_fit_it() -> None:
    """Its coefficients cannot be told from the offset; the types without it are fitted."""
    fits = _fits([grid("grid", 29.0, seed=3), moving("even", 29.0, 29.0, seed=5)], {"even": ("grid", "even")})
    assert [c.kind.name for c in fits.candidates if c.table_lambda == 0.0] == ["SnTdTO", "CnTdTO", "OnTdTO"]
    assert [line.split(":")[0] for line in fits.left_out] == [
        f"even {kind.name}" for kind in ALL_TYPES if kind.with_variables
    ]
    assert len(fits.left_out) == 6
    for line in fits.left_out:
        assert "variable 'temperature': its value is 29 degC throughout the fitted data" in line


def test_names_that_nothing_bears_are_refused() -> None:
    """A label or sphere that is not there, a label that two have, an empty combination; the known ones are listed."""
    with pytest.raises(FitError, match="data set 'a': no calibration interval is called 'gird'; did you mean \"grid\""):
        _fits(FITTED, {"a": ("gird", "cold")})
    with pytest.raises(FitError, match=r"sphere: no calibration interval is called 'grids'.*known: cold, grid, grid_2"):
        _fits(FITTED, COMBINATIONS, sphere=("grid", "grids"))
    with pytest.raises(FitError, match="expected a label of its own for each, 'cold' comes twice"):
        _fits([*FITTED, moving("cold", 29.0, 31.0, seed=20)], COMBINATIONS)
    with pytest.raises(FitError, match="data set 'a': expected at least one calibration interval, got none"):
        _fits(FITTED, {"a": ()})


def test_nothing_to_fit_is_refused() -> None:
    """The first reason is told; without data to judge on nothing is fitted."""
    with pytest.raises(FitError, match="nothing can be fitted; moves SnTdTO: sphere offset: none of grid is in it"):
        _fits(FITTED, {"moves": ("cold", "warm")}, types=["SnTdTO"])
    with pytest.raises(FitError, match="nothing can be fitted; no data set and no estimation type"):
        _fits(FITTED, {"all": COMBINATIONS["all"]}, types=[])
    with pytest.raises(FitError, match='expected at least one interval with use = "validation", got none'):
        run_study(FITTED, COMBINATIONS, [], prior=PRIOR, variables=[TEMPERATURE])


def test_readings_that_never_change_have_no_scale() -> None:
    """A sensor that was not read cannot be fitted, and its lambda has nothing to be compared with."""
    dead = replace(FITTED[2], raw=np.full_like(FITTED[2].raw, 7.0))
    with pytest.raises(FitError, match="all channels hold one value"):
        _fits([dead], {"dead": ("cold",)}, sphere=None, types=["OnTdTO"])
    assert relative_lambda(6.0, Moments.of(FITTED[2].raw, FITTED[2].reference)) > 0.0
