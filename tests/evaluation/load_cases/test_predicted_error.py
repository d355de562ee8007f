# SPDX-License-Identifier: BSD-3-Clause
"""The predicted error: its mean square by the posterior's own covariance, its quantiles, and an exact posterior."""

from __future__ import annotations

from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FitError
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.evaluation.load_cases.load_case import LoadCase, pushes_around_sensor
from forcetorque.evaluation.load_cases.predicted_error import ErrorMagnitude, predict_from_posterior, predict_prior
from forcetorque.experiment.calibration.posterior import ModelPart, Posterior, RowNoise
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm, TermKind
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from tests.scenes.experiments import PARQUET

DRAWS = 4000
"""Of the unknowns; their quantiles and mean squares are that good."""
EXACT = 1e-9
"""Relative rounding of double precision times the condition of the matrix, below a hundred, with room."""
STATISTICAL = 4.0 * np.sqrt(2.0 / DRAWS)
"""Relative, of a mean square: four standard errors if a single unknown makes all of it."""


def _posterior(variables: tuple[str, ...] = ("temperature",)) -> Posterior:
    """Six coefficients, variables, the offsets of two sessions, all correlated; rows are channels."""
    rng = np.random.default_rng(1)
    scale = np.array([*[1e-3] * 3, *[2e-2] * 3, *(0.04 * (k + 1) for k in range(len(variables))), 0.5, 0.2])
    n = len(scale)
    root = scale[:, None] * (np.eye(n) + 0.3 * rng.normal(size=(6, n, n)))
    covariance = root @ root.transpose(0, 2, 1)
    return Posterior(
        space="channel",
        variables=variables,
        sessions=("first", "second"),
        drift=False,
        mean=rng.normal(size=(6, n)),
        covariance=covariance,
        mean_covariance=covariance[:, :6, :6],
        prior_covariance=None,
        to_wrench=np.diag([1.0, 1.5, 2.0, 0.1, 0.2, 0.1]) + 0.05 * rng.normal(size=(6, 6)),
        noise=tuple(RowNoise(white=0.05 * (k + 1), time_constant_s=0.0, ratio=0.0) for k in range(6)),
        accuracy=np.zeros(6),
        repeatability=0.0,
        load_centre=[5.0, -20.0, 40.0, 1.0, 2.0, -3.0],
    )


def _case(**fields: object) -> LoadCase:
    return LoadCase(name="push", words="", wrench=pushes_around_sensor(30.0, 0.3), **fields)  # type: ignore[arg-type]


def _mean_squares(posterior: Posterior, case: LoadCase, *, fitted: bool) -> np.ndarray:
    """Mean squares of all components by the covariance that the posterior itself predicts, noise included."""
    wrench = case.wrench + posterior.load_centre if fitted else case.wrench
    session = posterior.sessions[-1] if fitted else None
    squares = np.zeros(6)
    changes = [case.changes.get(name, 0.0) for name in posterior.variables]
    senses = list(product(*((-change, change) for change in changes)))
    for sense in senses:  # independently of the load and of each other: the products cancel
        variables = np.tile(sense, (len(wrench), 1))
        covariance = posterior.error_covariance(wrench, variables=variables, session=session)
        squares += np.einsum("nii->i", covariance) / len(wrench) / len(senses)
    return squares + posterior.to_wrench**2 @ np.array([one.white**2 for one in posterior.noise])


@pytest.mark.parametrize("changes", [{}, {"temperature": 8.0}, {"current": 5.0}, {"temperature": 8.0, "current": 5.0}])
@pytest.mark.parametrize("offset", ["fitted", "tared"])
def test_the_mean_square_is_that_of_the_posterior(offset: str, changes: dict[str, float]) -> None:
    """Component by component; the fitted offset is that of the last session, and acts from the fitted loads on."""
    posterior, case = _posterior(("temperature", "current")), _case(offset=offset, changes=changes)
    error = predict_from_posterior(posterior, case)
    squares = _mean_squares(posterior, case, fitted=offset == "fitted")
    np.testing.assert_allclose(np.concatenate([error.force.axes, error.moment.axes]) ** 2, squares, rtol=STATISTICAL)
    # negative control: the other offset is another error
    other = _mean_squares(posterior, case, fitted=offset == "tared")
    assert np.abs(other / squares - 1.0).max() > 2.0 * STATISTICAL


def test_every_source_adds_its_own_mean_square() -> None:
    """Each by a posterior in which the others are exact, so that it is the whole error; noise by hand."""
    posterior = _posterior()
    white = posterior.to_wrench**2 @ [one.white**2 for one in posterior.noise]
    for offset in ("fitted", "tared"):
        case = _case(offset=offset, changes={"temperature": 8.0})
        size = predict_from_posterior(posterior, case).force
        assert size.sources["noise"] == pytest.approx(np.sqrt(white[:3].sum()), rel=1e-12)
        for source, own in (("matrix", range(6)), ("variables", [6]), ("offset", [7, 8])):
            only = np.isin(np.arange(9), own)
            covariance = np.where(only[:, None] & only, posterior.covariance, 0.0)
            alone = posterior.model_copy(update={"covariance": covariance})
            squares = _mean_squares(alone, case, fitted=offset == "fitted") - white
            assert size.sources[source] ** 2 == pytest.approx(squares[:3].sum(), rel=STATISTICAL)  # type: ignore[index]


def test_errors_of_the_robot_model_are_taken_off_the_others() -> None:
    """Of a posterior of which a third is theirs, a third of all but the noise."""
    posterior, case = _posterior(), _case(offset="fitted", changes={"temperature": 8.0})
    errors = tuple(ErrorTerm(name=str(k), kind=TermKind.MASS, deviation=1.0) for k in range(9))
    part = ModelPart(
        terms=errors, term_covariance=np.eye(9) / 3.0, response=np.asarray(np.linalg.cholesky(posterior.covariance))
    )
    of_model = posterior.model_copy(update={"model": part})
    exact, wrong = (predict_from_posterior(one, case).force for one in (posterior, of_model))
    assert exact.sources["model"] == 0.0
    assert (wrong.draws**2).mean() == pytest.approx((exact.draws**2).mean(), rel=STATISTICAL)
    squares = _mean_squares(posterior, case, fitted=True)[:3].sum() - exact.sources["noise"] ** 2
    assert wrong.sources["model"] ** 2 == pytest.approx(squares / 3.0, rel=1e-9)
    for source in ("matrix", "offset", "variables"):
        ratio = (wrong.sources[source] / exact.sources[source]) ** 2  # type: ignore[index]
        assert ratio == pytest.approx(2.0 / 3.0, rel=STATISTICAL)


def test_an_error_of_the_robot_model_is_in_all_rows_at_once() -> None:
    """Alone, it makes errors as of one normal number: a median of .67 and an end of 2.24 of their root mean square."""
    posterior, case = _posterior(), _case(offset="tared")
    response = np.zeros((*posterior.mean.shape, 1))
    response[range(6), range(6), 0] = 1.0
    part = ModelPart(
        terms=(ErrorTerm(name="mass", kind=TermKind.MASS, deviation=0.03),),
        term_covariance=np.array([[0.03**2]]),
        response=response,
    )
    silent = tuple(RowNoise(white=0.0, time_constant_s=0.0, ratio=0.0) for _ in range(6))
    update = {"model": part, "covariance": part.covariance, "noise": silent, "to_wrench": np.eye(6)}
    force = predict_from_posterior(posterior.model_copy(update=update), case).force
    size = 0.03 * np.sqrt((case.wrench[:, :3] ** 2).sum(axis=1).mean())
    assert force.typical == pytest.approx(0.674 * size, rel=STATISTICAL)
    assert force.at_most == pytest.approx(2.241 * size, rel=STATISTICAL)


def test_ends_of_an_interval_are_exceeded_as_often_as_they_say() -> None:
    """By 2.5 % of the draws each, and the median by half; force and moment are within a limit only if both are."""
    error = predict_from_posterior(_posterior(), _case())

    def shares(size: ErrorMagnitude) -> list[float]:
        return [float((size.draws <= end).mean()) for end in (size.at_least, size.typical, size.at_most)]

    for size in (error.force, error.moment):
        # a quantile lies between two draws
        np.testing.assert_allclose(shares(size), [0.025, 0.5, 0.975], atol=2.0 / DRAWS)
    assert error.within(error.force.at_most, np.inf) == pytest.approx(0.975, abs=2.0 / DRAWS)
    assert error.within(np.inf, error.moment.typical) == pytest.approx(0.5, abs=2.0 / DRAWS)
    both = error.within(error.force.typical, error.moment.at_least)
    assert both <= 0.025 + 2.0 / DRAWS
    assert error.within(0.0, np.inf) == 0.0


@pytest.mark.parametrize("offset", ["fitted", "tared"])
def test_a_prior_errs_by_what_an_exact_posterior_says(arm: Path, offset: str) -> None:
    """By hand: counts of a load by the calibration, read by the prior, less the load; noise is that of the rows.

    Whether rows are wrenches by the prior, as they were fitted, or channels, whose response is the inverse matrix.
    """
    run = SensorRun(load_experiment(arm / PARQUET), "arm_ft")
    fitted = calibrate_sensor(run, code_version="test", created="2026-01-01T00:00:00+00:00")
    posterior, prior = fitted.posterior, fitted.prior
    assert posterior is not None
    assert prior is not None
    place = 6 + len(posterior.sessions) - 1
    inverse = np.linalg.inv(fitted.matrix)
    response = np.zeros_like(posterior.mean)
    response[:, :6], response[:, place] = inverse, -inverse @ fitted.offset
    common = {"covariance": np.zeros_like(posterior.covariance)}
    channel = {"space": "channel", "mean": response, "to_wrench": fitted.matrix}
    # another offset than none, so that its sign counts
    stated = prior.model_copy(update={"offset": np.array([3.0, -2.0, 5.0, 0.1, 0.2, -0.3])})
    case = _case(offset=offset)
    load = case.wrench + (posterior.load_centre if offset == "fitted" else 0.0)
    counts = (load - (fitted.offset if offset == "fitted" else 0.0)) @ inverse.T
    error = counts @ stated.matrix.T + (stated.offset if offset == "fitted" else 0.0) - load
    white = np.array([one.white**2 for one in posterior.noise])
    for known, noise in (
        (posterior.model_copy(update=common), white),
        (posterior.model_copy(update=common | channel), stated.matrix**2 @ white),
    ):
        before = predict_prior(fitted.model_copy(update={"posterior": known, "prior": stated}), case)
        assert before is not None
        squares = (error**2).mean(axis=0) + noise
        for size, part in ((before.force, slice(3)), (before.moment, slice(3, 6))):
            expected = np.sqrt(squares[part].sum())
            assert (size.at_least, size.typical, size.at_most) == pytest.approx((expected,) * 3, rel=EXACT)
            np.testing.assert_allclose(size.axes, np.sqrt(squares[part]), rtol=EXACT)
            assert size.typical > 3.0 * size.sources["noise"]
        after = predict_from_posterior(known, case)
        np.testing.assert_allclose(after.force.axes**2, (known.to_wrench**2 @ white)[:3], rtol=EXACT)
    assert predict_prior(fitted.model_copy(update={"prior": None}), case) is None


def test_a_variable_that_was_not_fitted_is_refused() -> None:
    """By its name, with those that there are."""
    with pytest.raises(FitError, match="which are temperature, got humidity"):
        predict_from_posterior(_posterior(), _case(changes={"humidity": 1.0}))


@pytest.mark.parametrize("offset", ["fitted", "tared"])
@pytest.mark.parametrize(("unit", "factor"), [("force", 2.0), ("load", 1.0)])
def test_predicted_errors_change_with_the_unit_of_force_alone(unit: str, factor: float, offset: str) -> None:
    """All are twice as large where the matrix makes twice the force; loads in another unit leave them as they are."""
    posterior, case = _posterior(), _case(offset=offset, changes={"temperature": 3.0})
    if unit == "force":
        changed, loads = posterior.model_copy(update={"to_wrench": 2.0 * posterior.to_wrench}), case
    else:
        by = np.array([*[0.5] * 6, 1.0, 1.0, 1.0])
        covariance = posterior.covariance * np.outer(by, by)
        changed = posterior.model_copy(
            update={
                "mean": posterior.mean * by,
                "covariance": covariance,
                "mean_covariance": covariance[:, :6, :6],
                "load_centre": 2.0 * np.asarray(posterior.load_centre),
            }
        )
        loads = replace(case, wrench=2.0 * case.wrench)
    before, after = predict_from_posterior(posterior, case), predict_from_posterior(changed, loads)
    rtol = 1e-9 if unit == "force" else 0.02  # draws along other axes of the same covariance differ by chance
    for one, other in ((before.force, after.force), (before.moment, after.moment)):
        for name in ("axes", "typical", "at_least", "at_most"):
            wanted = factor * np.asarray(getattr(one, name))
            np.testing.assert_allclose(getattr(other, name), wanted, rtol=rtol, err_msg=name)
        assert one.sources
        assert other.sources == pytest.approx({source: factor * size for source, size in one.sources.items()}, rel=rtol)
        # by what each adds: no source is more than all together, and the axes add up to the expected square
        assert 0.0 < one.at_least < one.typical < one.at_most
        np.testing.assert_allclose((one.axes**2).sum(), (one.draws**2).mean(), rtol=0.1)
