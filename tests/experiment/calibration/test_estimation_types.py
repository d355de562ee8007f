# SPDX-License-Identifier: BSD-3-Clause
"""The nine estimation types: what they share, where they differ, and theorem 5.1 for every lambda."""

from __future__ import annotations

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.calibration.thesis.calibrate import calibrate, estimation_of, sphere_centre, sphere_labels
from forcetorque.calibration.thesis.regression import solve
from forcetorque.experiment.calibration.estimation_type import (
    ESTIMATION_TYPES,
    Estimation,
    EstimationType,
    OffsetStrategy,
    estimation_type,
)
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.experiment.calibration.sensor_model import LinearVariable, WrenchModel

EXACT = 1e-9
"""Relative: rounding of double precision times the condition of the raw readings, some 1e3, and of the variables."""

LAMBDAS = (0.0, 6.0, 600.0, 6e4, 6e6)
TEMPERATURE = LinearVariable(name="temperature", unit="degC")
TRUTH = WrenchModel(
    matrix=0.02 * (np.eye(6) + 0.2 * np.random.default_rng(1).normal(size=(6, 6))),
    offset=np.array([30.0, -12.0, 5.0, 0.4, -0.3, 0.2]),
    coefficients=np.array([[-0.4], [0.3], [-2.0], [0.02], [0.01], [-0.01]]),
    reference_values=np.array([29.0]),
)
PRIOR = TRUTH.matrix * (1.0 + 0.1 * np.random.default_rng(2).normal(size=(6, 6)))


def _data(label: str, start: float, end: float, *, seed: int, noise: float = 0.3, n: int = 500) -> DataSet:
    rng = np.random.default_rng(seed)
    raw = rng.normal(size=(n, 6)) * [3000, 2500, 2000, 900, 800, 500] + [9000, -4000, 2000, 100, -3000, 5000]
    temperature = np.linspace(start, end, n)[:, None]
    reference = TRUTH.wrench(raw, temperature) + noise * rng.normal(size=(n, 6))
    return DataSet(label=label, raw=raw, reference=reference, variables=temperature)


def _grid(label: str, temperature: float, *, seed: int, n: int = 400) -> DataSet:
    """A rigid limb that turns slowly: gravity of constant size, the moment a linear function of the force."""
    rng = np.random.default_rng(seed)
    direction = rng.normal(size=(n, 3))
    force = 40.0 * direction / np.linalg.norm(direction, axis=1, keepdims=True)
    reference = np.hstack([force, np.cross([0.01, -0.02, -0.2], force)])
    values = np.full((n, 1), temperature)
    drift = (values - TRUTH.reference_values) @ TRUTH.coefficients.T
    raw = np.linalg.solve(TRUTH.matrix, (reference - TRUTH.offset - drift).T).T
    return DataSet(label=label, raw=raw, reference=reference, variables=values)


def _two_sets() -> list[DataSet]:
    return [_data("cold", 29.0, 31.0, seed=3), _data("warm", 42.0, 41.0, seed=4)]


def _settled(name: str, data: list[DataSet], sphere: tuple[str, ...] | None = None) -> Estimation:
    kind = ESTIMATION_TYPES[name]
    centre = None
    if kind.offset is OffsetStrategy.SPHERE:
        drawn = sphere_labels([d.label for d in data], sphere)
        centre = sphere_centre(_moments([d for d in data if d.label in drawn]))
    return estimation_of(data[0], PRIOR, kind=kind, variables=[TEMPERATURE], raw_offset=centre)


def _moments(data: list[DataSet]) -> Moments:
    raw, reference, variables = (
        np.concatenate([getattr(d, part) for d in data]) for part in ("raw", "reference", "variables")
    )
    return Moments.of(raw, reference, variables)


def _by_samples(columns: FloatArray, reference: FloatArray, lam: float, *, prior: FloatArray = PRIOR) -> FloatArray:
    """Solve the stacked system of samples and penalty by QR: columns beyond the six channels are not penalised."""
    n, width = columns.shape
    penalty = np.zeros((6, width))
    penalty[:, :6] = np.sqrt(lam) * np.eye(6)
    system = np.vstack([columns / np.sqrt(n), penalty])
    target = np.vstack([reference / np.sqrt(n), np.sqrt(lam) * prior.T])
    scale = np.linalg.norm(system, axis=0)
    return np.linalg.lstsq(system / scale, target, rcond=None)[0].T / scale


def _close(a: FloatArray, b: FloatArray) -> bool:
    return bool(np.allclose(a, b, rtol=EXACT, atol=EXACT * np.abs(b).max(initial=0.0)))


def test_the_nine_names_are_those_of_the_thesis() -> None:
    """Three offset strategies times no temperature, temperature, temperature from its reference value."""
    assert list(ESTIMATION_TYPES) == [
        "SnTdTO", "SwTdTO", "SwTrTO", "CnTdTO", "CwTdTO", "CwTrTO", "OnTdTO", "OwTdTO", "OwTrTO",
    ]  # fmt: skip
    plain = EstimationType(offset=OffsetStrategy.SPHERE, with_variables=True, from_reference=True)
    assert estimation_type("SwTrTO") == plain
    assert all(kind.name == name for name, kind in ESTIMATION_TYPES.items())
    with pytest.raises(FitError, match="no estimation type is called 'OwTr'.*OwTrTO"):
        estimation_type("OwTr")
    with pytest.raises(FitError, match="belongs to a type with variables"):
        EstimationType(with_variables=False, from_reference=True)


@pytest.mark.parametrize("lam", LAMBDAS)
def test_one_shot_is_the_regression_with_a_column_of_ones(lam: float) -> None:
    """The one-shot types equal least squares over all samples with a constant and the temperature as columns."""
    data = _two_sets()
    for name, zero in (("OnTdTO", None), ("OwTdTO", 0.0), ("OwTrTO", 29.0)):
        model = solve(_moments(data), _settled(name, data), lam)
        raw = np.concatenate([d.raw for d in data])
        extra = [] if zero is None else [np.concatenate([d.variables for d in data]) - zero]
        columns = np.hstack([raw, *extra, np.ones((len(raw), 1))])
        solved = _by_samples(columns, np.concatenate([d.reference for d in data]), lam)
        assert _close(model.matrix, solved[:, :6])
        assert _close(model.coefficients, solved[:, 6:-1])
        np.testing.assert_allclose(model.offset, solved[:, -1], rtol=1e-7)


@pytest.mark.parametrize("lam", LAMBDAS)
def test_centralised_equals_one_shot(lam: float) -> None:
    """Theorem 5.1 for every lambda: taking the means off gives the same model as estimating a constant."""
    data = _two_sets()
    for name in ("nTdTO", "wTdTO", "wTrTO"):
        central = solve(_moments(data), _settled(f"C{name}", data), lam)
        shot = solve(_moments(data), _settled(f"O{name}", data), lam)
        assert _close(central.matrix, shot.matrix)
        assert _close(central.coefficients, shot.coefficients)
        np.testing.assert_allclose(central.offset, shot.offset, rtol=1e-8)


@pytest.mark.parametrize("lam", LAMBDAS)
def test_theorem_fails_where_temperature_is_not_centred(lam: float) -> None:
    """Negative control: raw readings and reference centred, temperature not, is another problem."""
    data = _two_sets()
    raw, reference, temperature = (
        np.concatenate([getattr(d, part) for d in data]) for part in ("raw", "reference", "variables")
    )
    half = _by_samples(np.hstack([raw - raw.mean(axis=0), temperature]), reference - reference.mean(axis=0), lam)
    whole = _by_samples(
        np.hstack([raw - raw.mean(axis=0), temperature - temperature.mean()]), reference - reference.mean(axis=0), lam
    )
    model = solve(_moments(data), _settled("CwTdTO", data), lam)
    assert _close(model.matrix, whole[:, :6])
    assert _close(model.coefficients, whole[:, 6:])
    assert not np.allclose(model.coefficients, half[:, 6:], rtol=0.1)


@pytest.mark.parametrize("strategy", ["C", "O"])
@pytest.mark.parametrize("lam", LAMBDAS)
def test_the_reference_temperature_only_moves_the_offset(strategy: str, lam: float) -> None:
    """DTO and rTO of the centralised and one-shot types differ by c t0 in the offset and in nothing else."""
    data = _two_sets()
    zero = solve(_moments(data), _settled(f"{strategy}wTdTO", data), lam)
    first = solve(_moments(data), _settled(f"{strategy}wTrTO", data), lam)
    assert first.reference_values.tolist() == [29.0]
    assert zero.reference_values.tolist() == [0.0]
    assert _close(zero.matrix, first.matrix)
    assert _close(zero.coefficients, first.coefficients)
    np.testing.assert_allclose(first.offset - zero.offset, 29.0 * first.coefficients[:, 0], rtol=1e-6)
    raw, values = data[1].raw, data[1].variables
    np.testing.assert_allclose(zero.wrench(raw, values), first.wrench(raw, values), rtol=1e-7, atol=1e-7)


SHIFTS = {"kelvin": 273.15, "a clock of 1970": 1e9}


def _shifted(shift: float) -> DataSet:
    """Two stretches at 29 to 42 units, in steps that doubles hold also beyond the shift: the shift alone is new."""
    raw, reference, variables = (
        np.concatenate([getattr(d, part) for d in _two_sets()]) for part in ("raw", "reference", "variables")
    )
    return DataSet(label="all", raw=raw, reference=reference, variables=np.round(variables * 2**16) / 2**16 + shift)


@pytest.mark.parametrize("name", ["OwTdTO", "OwTrTO", "CwTdTO", "CwTrTO"])
@pytest.mark.parametrize("shift", SHIFTS.values(), ids=SHIFTS)
def test_where_a_variable_counts_from_costs_no_digits(name: str, shift: float) -> None:
    """Matrix and coefficients are those of QR on centred samples, also in parts; uncentred products have others."""
    data, lam = _shifted(shift), 600.0
    centred = [values - values.mean(axis=0) for values in (data.raw, data.variables - shift, data.reference)]
    columns, reference = np.hstack(centred[:2]), centred[2]
    solved = _by_samples(columns, reference, lam)
    estimation = estimation_of(data, PRIOR, kind=ESTIMATION_TYPES[name], variables=[TEMPERATURE])
    halves = [Moments.of(data.raw[half], data.reference[half], data.variables[half]) for half in _halves(data)]
    for moments in (Moments.of(data.raw, data.reference, data.variables), halves[0] + halves[1]):
        model = solve(moments, estimation, lam)
        np.testing.assert_allclose(model.matrix, solved[:, :6], rtol=0.0, atol=1e-10 * np.abs(solved[:, :6]).max())
        np.testing.assert_allclose(model.coefficients, solved[:, 6:], rtol=0.0, atol=1e-10 * np.abs(solved[:, 6]).max())
        felt = model.wrench(data.raw.mean(axis=0), data.variables.mean(axis=0))
        rounding = 1e-9 + 1e-15 * shift  # of offset and coefficient times the variable, whose sum is the wrench
        np.testing.assert_allclose(felt, data.reference.mean(axis=0), rtol=0.0, atol=rounding)
    plain = np.hstack([data.raw, data.variables, np.ones((len(data.raw), 1))])
    penalty = np.diag([lam * len(plain)] * 6 + [0.0, 0.0])
    wanted = data.reference.T @ plain
    wanted[:, :6] += lam * len(plain) * PRIOR
    uncentred = np.linalg.solve(plain.T @ plain + penalty, wanted.T).T
    if shift > 1e6:  # negative control: there the products of such values have no digits left for the rest
        assert np.abs(uncentred[:, 6] - solved[:, 6]).max() > 1e-3 * np.abs(solved[:, 6]).max()


def _halves(data: DataSet) -> tuple[slice, slice]:
    return slice(0, len(data.raw) // 3), slice(len(data.raw) // 3, len(data.raw))


def test_sphere_finds_the_raw_offset_where_gravity_alone_loads() -> None:
    """On a rigid grid at one temperature the centre is the raw reading without load, exactly."""
    grid = _grid("grid", 29.0, seed=5)
    centre = sphere_centre(Moments.of(grid.raw, grid.reference, grid.variables))
    unloaded = np.linalg.solve(TRUTH.matrix, -TRUTH.offset)
    np.testing.assert_allclose(centre, unloaded, rtol=1e-9)
    loaded = grid.raw.mean(axis=0)
    assert not np.allclose(centre, loaded, atol=1.0)  # the mean itself is not the answer: postures are not even


@pytest.mark.parametrize("lam", LAMBDAS)
def test_sphere_types_are_regressions_without_intercept(lam: float) -> None:
    """They fit (r - r0, f) with no constant; the offset is -C r0, temperature from zero or from its first value."""
    data = [_grid("grid", 29.0, seed=5), *_two_sets()]
    raw, reference, temperature = (
        np.concatenate([getattr(d, part) for d in data]) for part in ("raw", "reference", "variables")
    )
    for name, zero in (("SnTdTO", None), ("SwTdTO", 0.0), ("SwTrTO", 29.0)):
        estimation = _settled(name, data, ("grid",))
        model = solve(_moments(data), estimation, lam)
        assert estimation.raw_offset is not None
        extra = [] if zero is None else [temperature - zero]
        solved = _by_samples(np.hstack([raw - estimation.raw_offset, *extra]), reference, lam)
        assert _close(model.matrix, solved[:, :6])
        assert _close(model.coefficients, solved[:, 6:])
        np.testing.assert_allclose(model.offset, -model.matrix @ estimation.raw_offset, rtol=1e-12)


def test_sphere_of_several_grids_is_named() -> None:
    """With several data sets nobody guesses which one drew the sphere."""
    data = [_grid("grid", 29.0, seed=5), _grid("grid_2", 42.0, seed=6)]
    with pytest.raises(FitError, match="name the data sets that draw the sphere, out of grid, grid_2"):
        _settled("SnTdTO", data)
    with pytest.raises(FitError, match="no data set is called 'gird'.*grid"):
        _settled("SnTdTO", data, ("gird",))
    assert not np.allclose(
        _settled("SnTdTO", data, ("grid",)).raw_offset, _settled("SnTdTO", data, ("grid_2",)).raw_offset
    )


def test_a_plane_draws_no_sphere() -> None:
    """A limb that turns about one axis leaves the offset across unknown: refused, not extrapolated."""
    grid = _grid("grid", 29.0, seed=7)
    reference = np.array(grid.reference)
    reference[:, 2] = 10.0
    with pytest.raises(FitError, match="turns in space"):
        sphere_centre(Moments.of(grid.raw, reference))


def test_exact_data_give_the_truth_with_any_number_of_variables() -> None:
    """Two variables, of which one has its own reference value, come out with matrix and offset."""
    rng = np.random.default_rng(8)
    raw, values = 1000 * rng.normal(size=(300, 6)), rng.normal(size=(300, 2)) * [5.0, 0.2] + [30.0, 12.0]
    coefficients = rng.normal(size=(6, 2))
    truth = WrenchModel(
        matrix=TRUTH.matrix, offset=TRUTH.offset, coefficients=coefficients, reference_values=np.array([25.0, 12.0])
    )
    variables = [
        LinearVariable(name="temperature", unit="degC", reference_value=25.0),
        LinearVariable(name="supply", unit="V", reference_value=12.0),
    ]
    data = DataSet(label="a", raw=raw, reference=truth.wrench(raw, values), variables=values)
    fit = calibrate([data], None, regularisation=0.0, variables=variables).fit
    assert _close(fit.model.matrix, truth.matrix)
    np.testing.assert_allclose(fit.model.coefficients, coefficients, rtol=1e-8)
    np.testing.assert_allclose(fit.model.offset, truth.offset, rtol=1e-8)
    np.testing.assert_array_equal(fit.model.reference_values, [25.0, 12.0])


def test_coefficients_with_a_prior_are_pulled_and_those_without_are_not() -> None:
    """(5.10): a known coefficient is penalised by its own squared norm, an unknown one by nothing."""
    data = _two_sets()
    wrong = TRUTH.coefficients[:, 0] + 1.0
    pulled = LinearVariable(name="temperature", unit="degC", prior=wrong)
    moments, large = _moments(data), 1e12

    def solved(variable: LinearVariable) -> WrenchModel:
        estimation = estimation_of(data[0], PRIOR, kind=ESTIMATION_TYPES["OwTrTO"], variables=[variable])
        return solve(moments, estimation, large)

    np.testing.assert_allclose(solved(pulled).coefficients[:, 0], wrong, rtol=1e-6)
    free = solved(TEMPERATURE)
    np.testing.assert_allclose(free.matrix, PRIOR, rtol=1e-3)
    assert not np.allclose(free.coefficients[:, 0], wrong, rtol=0.1)


def test_lambda_is_chosen_with_temperature_too() -> None:
    """The held-out choice recovers the truth although a block alone hardly sees the temperature move."""
    data = _two_sets()
    result = calibrate(data, PRIOR, variables=[TEMPERATURE])
    assert result.estimation.kind.name == "OwTrTO"
    assert result.curve is not None
    assert np.isfinite(result.curve.chosen)
    assert np.linalg.norm(result.fit.matrix - TRUTH.matrix) < 0.05 * np.linalg.norm(
        PRIOR - TRUTH.matrix
    )  # noise leaves 1.4 %
    assert result.standard_errors is not None
    error = np.abs(result.fit.model.coefficients - TRUTH.coefficients)
    assert (error < 5.0 * result.standard_errors.coefficients).all()


def test_what_cannot_be_told_apart_is_refused() -> None:
    """A constant temperature, a type that needs one, fewer samples than unknowns, and shapes that do not fit."""
    still = [_data("still", 30.0, 30.0, seed=9)]
    with pytest.raises(FitError, match="its value is 30 degC throughout.*cannot be told from the offset"):
        calibrate(still, PRIOR, regularisation=6.0, variables=[TEMPERATURE])
    bare = DataSet(label="bare", raw=still[0].raw, reference=still[0].reference)
    with pytest.raises(FitError, match="OwTdTO: expected a linear variable such as temperature, the data have none"):
        calibrate([bare], PRIOR, kind=estimation_type("OwTdTO"))
    with pytest.raises(ShapeError, match="1 are described, the data sets have 0"):
        calibrate([bare], PRIOR, variables=[TEMPERATURE])
    with pytest.raises(ShapeError, match="one number of raw channels and of variables"):
        calibrate([*still, bare], PRIOR, variables=[TEMPERATURE])
    few = DataSet(
        label="few", raw=still[0].raw[:7], reference=still[0].reference[:7], variables=[[k] for k in range(7)]
    )
    with pytest.raises(FitError, match="at least 8 samples for 8 unknowns of every axis, got 7"):
        calibrate([few], PRIOR, regularisation=6.0, variables=[TEMPERATURE])
    with pytest.raises(ShapeError, match=r"prior: expected shape \(6, 6\), got \(6, 5\)"):
        calibrate(_two_sets(), PRIOR[:, :5], regularisation=6.0, variables=[TEMPERATURE])
    with pytest.raises(FitError, match="six finite prior coefficients"):
        LinearVariable(name="temperature", unit="degC", prior=np.full(6, np.nan))
