# SPDX-License-Identifier: BSD-3-Clause
"""Many recordings in one fit: what each has for itself is eliminated, and the result is that of all at once."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import BoolArray, FloatArray
from forcetorque.base.noise.slow_noise import CANDIDATES
from forcetorque.calibration.generative import design_matrix as design
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import WindowMeans, model_terms
from forcetorque.experiment.calibration.robot_model_error import ErrorTerm, TermKind
from forcetorque.experiment.calibration.sensor_model import LinearVariable
from tests.cases import some_cases

PRIOR = 0.01 * np.diag([1.0, 1.0, 1.0, 0.05, 0.05, 0.05])
SAME = 1e-7
"""Standard errors by which results may differ: rounding of twenty rounds of products of a hundred unknowns."""
SHAPES = (CANDIDATES[0], CANDIDATES[4], CANDIDATES[11])
TEMPERATURE = LinearVariable(name="temperature", unit="degC", reference_value=25.0)


def _recordings(count: int, sessions: int) -> list[WindowMeans]:
    """Recordings of 12 s each, with a mass that all have in common and a delay of their own, the last with another.

    The delay of the first is the first of all terms.
    """
    rng = np.random.default_rng(4)
    truth = (np.eye(6) + 0.03 * rng.normal(size=(6, 6))) @ PRIOR
    means = []
    for number in range(count):
        time = np.arange(12.0)
        wrench = rng.normal(size=(12, 6)) * [20.0, 20.0, 20.0, 2.0, 2.0, 2.0]
        derivatives = np.stack([rng.normal(size=(12, 6)), wrench + 5.0, rng.normal(size=(12, 6))], axis=2)
        loads = wrench + derivatives @ [0.05 * rng.normal(), 0.02, 0.0]
        noise = rng.normal(size=(12, 6)) + np.cumsum(rng.normal(size=(12, 6)), axis=0)
        terms = [(f"delay of {number}", TermKind.DELAY, 0.05), ("mass of hand", TermKind.MASS, 0.03)]
        terms += [(f"x of acceleration of {number}", TermKind.ACCELERATION, 0.05)] if number == count - 1 else []
        means.append(
            WindowMeans(
                label="all",
                session=f"power-up {number % sessions}",
                recording=f"r{number}",
                time_s=time,
                count=np.full(12, 100.0),
                raw=(loads + number % sessions) @ np.linalg.inv(truth).T + noise,
                reference=wrench,
                flattening=0.01 * rng.normal(size=(12, 6)),
                variables=25.0 + rng.normal(size=(12, 1)),
                terms=tuple(ErrorTerm(name=name, kind=kind, deviation=size) for name, kind, size in terms),
                model=derivatives[:, :, : len(terms)],
            )
        )
    return means


def _one_with_two_sessions(count: int) -> list[WindowMeans]:
    """The last recording is switched off and on within: first in the session of all others, then in its own."""
    rng = np.random.default_rng(1)
    truth = (np.eye(6) + 0.03 * rng.normal(size=(6, 6))) @ PRIOR
    means = []
    for number, session in [*((number, "morning") for number in range(count)), (count - 1, "evening")]:
        wrench = rng.normal(size=(12, 6)) * [20.0, 20.0, 20.0, 2.0, 2.0, 2.0] - [0.0, 0.0, 30.0, 0.0, 0.0, 0.0]
        derivatives = np.stack([wrench, 30.0 + rng.normal(size=(12, 6))], axis=2)
        terms = (("mass", TermKind.MASS, 0.03), (f"tilt of {number}", TermKind.ACCELERATION, 0.05))
        means.append(
            WindowMeans(
                label=session,
                session=session,
                recording=f"r{number}",
                time_s=np.arange(12.0) + 100.0 * (session == "evening"),
                count=np.full(12, 100.0),
                raw=(wrench + derivatives @ [0.02, 0.05] + 7.0) @ np.linalg.inv(truth).T + rng.normal(size=(12, 6)),
                reference=wrench,
                flattening=np.zeros((12, 6)),
                variables=25.0 + rng.normal(size=(12, 1)),
                terms=tuple(ErrorTerm(name=name, kind=kind, deviation=size) for name, kind, size in terms),
                model=derivatives,
            )
        )
    return means


def _fitted(means: list[WindowMeans], prior: FloatArray | None, *, drift: bool) -> GenerativeFit:
    assumptions = Assumptions.of_counts(6, 32767.0, accuracy=np.zeros(6))
    return fit_generative(means, prior, assumptions, variables=[TEMPERATURE], drift=drift, shapes=SHAPES)


@some_cases(
    ("sessions", "drift", "prior"),
    [(5, False, PRIOR), (2, True, PRIOR), (1, False, PRIOR), (5, True, None)],
    ids=["a session each", "recordings share sessions that drift", "one session", "no prior"],
)
def test_cells_change_no_number(
    sessions: int, drift: bool, prior: FloatArray | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Means, covariances and evidence are those of all recordings in one cell."""
    means = _recordings(5, sessions)
    together = _fitted(means, prior, drift=drift)
    monkeypatch.setattr(design, "MOST_TOGETHER", 1)
    _assert_same(_fitted(means, prior, drift=drift), together)


@some_cases("together", [1, 5], ids=["cells", "one cell"])
def test_blocks_change_no_number(together: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """Columns of 9 means at a time, which divide recordings of 12, give what those of all give."""
    means = _recordings(5, 2)
    monkeypatch.setattr(design, "MOST_TOGETHER", together)
    at_once = _fitted(means, PRIOR, drift=True)
    monkeypatch.setattr(design, "MOST_IN_BLOCK", 9)
    _assert_same(_fitted(means, PRIOR, drift=True), at_once)


def _assert_same(fit: GenerativeFit, other: GenerativeFit, *, terms: int = 7) -> None:
    spread = np.sqrt(np.einsum("kpp->kp", other.posterior.covariance))
    assert fit.posterior.noise[0].time_constant_s == other.posterior.noise[0].time_constant_s
    np.testing.assert_allclose((fit.posterior.mean - other.posterior.mean) / spread, 0.0, atol=SAME)
    of_spread = spread[:, :, None] * spread[:, None, :]
    np.testing.assert_allclose(fit.posterior.covariance / of_spread, other.posterior.covariance / of_spread, atol=SAME)
    np.testing.assert_allclose(fit.deviance, other.deviance, atol=1e-6)
    assert (fit.noise_rms is None) == (other.noise_rms is None) == (not fit.model_errors)
    if fit.noise_rms is not None and other.noise_rms is not None:
        np.testing.assert_allclose(fit.noise_rms, other.noise_rms, rtol=SAME)
    assert len(fit.model_errors) == len(other.model_errors) in (0, terms)
    for one, same in zip(fit.model_errors, other.model_errors, strict=True):
        assert one.name == same.name
        np.testing.assert_allclose(one.value, same.value, atol=SAME * same.standard_error)
        np.testing.assert_allclose(one.standard_error, same.standard_error, rtol=SAME)


@some_cases("drift", [False, True])
def test_offsets_of_a_recording_with_a_shared_session_and_its_own(drift: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    """Each session has the offset that it has in one cell; derivatives have means far from zero."""
    means = _one_with_two_sessions(4)
    together = _fitted(means, PRIOR, drift=drift)
    monkeypatch.setattr(design, "MOST_TOGETHER", 1)
    apart = _fitted(means, PRIOR, drift=drift)
    spread = np.sqrt(np.einsum("kpp->kp", together.posterior.covariance))
    np.testing.assert_allclose((apart.posterior.mean - together.posterior.mean) / spread, 0.0, atol=SAME)
    assert apart.noise_rms is not None
    assert together.noise_rms is not None
    np.testing.assert_allclose(apart.noise_rms, together.noise_rms, rtol=SAME)
    np.testing.assert_allclose(apart.residual, together.residual, rtol=1e-6)


def test_terms_of_one_recording_are_kept_beside_it() -> None:
    """The derivatives of five recordings have two columns of their own, not eleven."""
    means = _recordings(5, 5)
    columns = model_terms(means, range(5))
    assert columns.columns.shape[2] == 1
    assert columns.local_columns.shape[2] == 2
    assert [columns.terms[place].name for place in columns.local[4]] == ["delay of 4", "x of acceleration of 4"]
    assert columns.local[0, 1] == -1
    assert model_terms(means, [0] * 5).columns.shape[2] == 7
    none = model_terms([replace(one, terms=(), model=None) for one in means], range(5))
    assert none.columns.shape[2] == none.local_columns.shape[2] == 0


def _with_pulls(means: list[WindowMeans], axes: str) -> list[WindowMeans]:
    """Beside the terms of each recording pulls of a joint that moves, along axes, and of one that stays at zero."""
    rng = np.random.default_rng(8)
    pulled = []
    for one in means:
        assert one.model is not None
        names = [*(f"{axis} pull of cables at knee" for axis in axes), "z pull of cables at hip"]
        columns = np.zeros((len(one), 6, len(names)))
        position = rng.normal(size=len(one))
        for k, axis in enumerate(axes):
            columns[:, "xyz".index(axis), k] = position
        terms = (*one.terms, *(ErrorTerm(name=name, kind=TermKind.PULL, deviation=1.0) for name in names))
        raw = one.raw + np.outer(position, [0.0, 3.0, 0.0, 0.0, 0.0, 0.0]) @ np.linalg.inv(PRIOR).T
        pulled.append(replace(one, terms=terms, model=np.concatenate([one.model, columns], axis=2), raw=raw))
    return pulled


@some_cases("together", [1, 5], ids=["cells", "one cell"])
def test_terms_are_left_out_of_rows_that_they_do_not_act_on(together: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """That changes no number; a pull is found along its axis, and one that acts on no row keeps its tolerance."""
    monkeypatch.setattr(design, "MOST_TOGETHER", together)
    means = _with_pulls(_recordings(5, 2), "xy")
    few = _fitted(means, PRIOR, drift=False)
    errors = {error.name: error for error in few.model_errors}
    pull, none = errors["y pull of cables at knee"], errors["z pull of cables at hip"]
    assert pull.value == pytest.approx(3.0, abs=1.0)
    assert pull.standard_error < 0.5
    assert none.value == 0.0
    assert none.standard_error > 1.0
    centred = design._centred_terms

    def on_all_rows(*arguments: Any) -> tuple[FloatArray, FloatArray, BoolArray]:
        local, of_sessions, acting = centred(*arguments)
        assert not acting.all()
        return local, of_sessions, np.ones_like(acting)

    monkeypatch.setattr(design, "_centred_terms", on_all_rows)
    _assert_same(few, _fitted(means, PRIOR, drift=False), terms=10)
