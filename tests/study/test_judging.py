# SPDX-License-Identifier: BSD-3-Clause
"""How candidates are judged: as sample by sample, with the offset of the first second or with that of the fit."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.experiment.calibration.sensor_model import WrenchModel
from forcetorque.experiment.validation_offset import KNOWN_BEFORE, OFFSET_S, Offset, ValidationSet
from forcetorque.study.candidate_errors import BlockErrors, PooledErrors
from forcetorque.study.candidate_selection import evaluate_models, with_offset
from tests.study import measured
from tests.study.measured import JUDGED, NOISE, TRUTH, errors_by_samples, judged, study

EXACT = 1e-10
"""N, N m: rounding of double precision times the readings of some 500 N, over which the errors are taken."""
SAME_FIT = 1e-6
"""N, N m: two ways to the same fit differ by rounding times its condition; the errors are some 1 N."""

RE_ESTIMATED, FITTED_OFFSET = Offset.FIRST_SECOND, Offset.FITTED
BOTH = pytest.mark.parametrize("source", list(KNOWN_BEFORE))


def _by_samples(models: Sequence[WrenchModel], sets: Sequence[ValidationSet], source: Offset) -> PooledErrors:
    errors = np.array([np.concatenate([errors_by_samples(model, one, source) for one in sets]) for model in models])
    return PooledErrors(
        mean_absolute=np.abs(errors).mean(axis=1),
        force_mean=np.linalg.norm(errors[..., :3], axis=2).mean(axis=1),
        moment_mean=np.linalg.norm(errors[..., 3:], axis=2).mean(axis=1),
    )


def _difference(one: PooledErrors, other: PooledErrors) -> float:
    fields = ("mean_absolute", "force_mean", "moment_mean")
    return max(float(np.abs(getattr(one, field) - getattr(other, field)).max()) for field in fields)


def _judge(models: Sequence[WrenchModel], sets: Sequence[ValidationSet], source: Offset) -> BlockErrors:
    return evaluate_models(models, [source] * len(models), sets)


@BOTH
def test_the_errors_are_those_of_the_samples_after_the_first_second(source: Offset) -> None:
    """All 351 candidates, over everything, over one day and over one set; other samples give other numbers."""
    conclusion, models = study().errors[source], study().models[:-1]
    part = slice(None, None, 7)
    assert len(models[part]) == 51
    assert conclusion.count.sum() == sum(len(one.time_s) - 100 for one in JUDGED)
    parts = {
        "all": (conclusion.pooled(), JUDGED),
        "day 1": (conclusion.pooled(["day 1"]), JUDGED[:2]),
        "days": (conclusion.pooled(["day 2", "day 1"]), JUDGED),
    }
    for name, (pooled, sets) in parts.items():
        found = PooledErrors(
            mean_absolute=pooled.mean_absolute[:-1][part],
            force_mean=pooled.force_mean[:-1][part],
            moment_mean=pooled.moment_mean[:-1][part],
        )
        assert _difference(found, _by_samples(models[part], sets, source)) < EXACT, name
    assert _difference(conclusion.pooled(["day 1"]), conclusion.pooled()) > 1e-3


def test_a_study_of_much_work_is_compiled(monkeypatch: pytest.MonkeyPatch) -> None:
    """However little there is in each set: all candidates meet all samples in both modes."""
    module = sys.modules["forcetorque.study.candidate_errors"]
    work = 2 * len(study().models) * sum(len(one.time_s) for one in JUDGED)
    monkeypatch.setattr(module, "_FEW", work)
    monkeypatch.setattr(module, "_run_readable", None)
    compiled = measured.study.__wrapped__()
    assert _difference(compiled.errors[RE_ESTIMATED].pooled(), study().errors[RE_ESTIMATED].pooled()) < EXACT
    monkeypatch.setattr(module, "_FEW", work + 1)  # negative control
    with pytest.raises(TypeError):
        measured.study.__wrapped__()


@BOTH
def test_the_first_second_itself_is_not_judged(source: Offset) -> None:
    """A blow in the first second changes the offset that is taken from it, and no error of a fitted offset."""
    blow = JUDGED[0].reference.copy()
    blow[3] += [500.0, 0, 0, 0, 0, 0]
    plain, struck = (_judge([TRUTH], [one], source) for one in (JUDGED[0], replace(JUDGED[0], reference=blow)))
    change = _difference(plain.pooled(), struck.pooled())
    assert change == 0.0 if source is FITTED_OFFSET else change > 1.0
    later = JUDGED[0].reference.copy()
    later[103] += [500.0, 0, 0, 0, 0, 0]
    assert _difference(plain.pooled(), _judge([TRUTH], [replace(JUDGED[0], reference=later)], source).pooled()) > 0.5


@BOTH
def test_centralised_equals_one_shot_and_its_reference_temperature_does_not_matter(source: Offset) -> None:
    """Theorem 5.1 as Tables 5.5 and 5.6 show it: four types with temperature judge alike, two without; S does not."""
    pooled = study().errors[source].pooled()
    by_type: dict[str, list[int]] = {}
    for index, candidate in enumerate(study().fits.candidates):
        by_type.setdefault(candidate.kind.name, []).append(index)

    def errors(kind: str) -> PooledErrors:
        rows = by_type[kind]
        return PooledErrors(
            mean_absolute=pooled.mean_absolute[rows],
            force_mean=pooled.force_mean[rows],
            moment_mean=pooled.moment_mean[rows],
        )

    for kind in ("OwTdTO", "CwTrTO", "CwTdTO"):
        assert _difference(errors("OwTrTO"), errors(kind)) < SAME_FIT
    assert _difference(errors("OnTdTO"), errors("CnTdTO")) < SAME_FIT
    assert _difference(errors("OwTrTO"), errors("OnTdTO")) > 0.1
    assert _difference(errors("SwTrTO"), errors("SwTdTO")) > 1e-3


def test_the_workbench_is_judged_alike_in_both_modes() -> None:
    """It has no offset of a fit; its errors are those of its matrix with the offset of the first second."""
    both = [study().errors[source].pooled() for source in KNOWN_BEFORE]
    assert np.array_equal(both[0].mean_absolute[-1], both[1].mean_absolute[-1])
    assert both[0].force_mean[-1] == both[1].force_mean[-1]
    assert both[0].moment_mean[-1] == both[1].moment_mean[-1]
    alone = _by_samples([study().models[-1]], JUDGED, RE_ESTIMATED)
    assert abs(alone.force_mean[0] - both[0].force_mean[-1]) < EXACT
    assert np.abs(both[0].force_mean[:-1] - both[1].force_mean[:-1]).max() > 0.1


def test_the_true_model_leaves_noise_only() -> None:
    """Its errors have the mean size of the noise; without its coefficients they are larger, without noise zero.

    The size of three equal normal errors has the mean 2 sqrt(2 / pi) of a standard deviation.
    """
    long = judged("long", "day", 27.0, 40.0, seed=30, n=20_000)
    for source in KNOWN_BEFORE:
        pooled = _judge([TRUTH], [long], source).pooled()
        # the offset of 100 samples is off by a tenth of the noise, or three, whose square half counts
        slack = 0.05 if source is RE_ESTIMATED else 0.02
        assert pooled.force_mean[0] == pytest.approx(2.0 * np.sqrt(2.0 / np.pi) * NOISE[0], rel=slack)
        assert pooled.moment_mean[0] == pytest.approx(2.0 * np.sqrt(2.0 / np.pi) * NOISE[3], rel=slack)
        np.testing.assert_allclose(pooled.mean_absolute[0], np.sqrt(2.0 / np.pi) * NOISE, rtol=slack)
    exact = judged("exact", "day", 27.0, 40.0, seed=30, noise=0.0)
    for source in KNOWN_BEFORE:
        assert _judge([TRUTH], [exact], source).pooled().force_mean[0] < EXACT
        without = replace(TRUTH, coefficients=np.zeros((6, 1)))
        assert _judge([without], [exact], source).pooled().force_mean[0] > 1.0


def _shifted(one: ValidationSet, counts: FloatArray) -> ValidationSet:
    return replace(one, raw=one.raw + counts)


def test_an_offset_of_the_counts_matters_to_the_fitted_offset_alone() -> None:
    """Another power-up in one set: the re-estimated offset takes it up, the fitted one is off by its wrench."""
    power_up = np.array([60.0, -40, 80, 20, -100, 50])
    sets = [JUDGED[0], _shifted(JUDGED[1], power_up), JUDGED[2]]
    models = study().models[:351:50]
    assert len(models) == 8
    for source in KNOWN_BEFORE:
        plain, shifted = ([_judge(models, [one], source).pooled() for one in judged] for judged in (JUDGED, sets))
        elsewhere, there, after = (_difference(*pair) for pair in zip(plain, shifted, strict=True))
        assert (elsewhere, after) == (0.0, 0.0)
        assert there < EXACT if source is RE_ESTIMATED else there > 0.1
    # control the other way: a change of slope is no offset, and both modes see it
    bent = replace(JUDGED[1], raw=1.05 * JUDGED[1].raw)
    for source in KNOWN_BEFORE:
        changed = _judge(models, [bent], source)
        assert _difference(_judge(models, [JUDGED[1]], source).pooled(), changed.pooled()) > 0.1


def test_a_mixture_of_offsets_keeps_every_model_its_own() -> None:
    """Sources are given model by model, as for the workbench beside the candidates."""
    models = study().models[:2]
    mixed = evaluate_models(models, [RE_ESTIMATED, FITTED_OFFSET], JUDGED).pooled()
    for index, source in enumerate((RE_ESTIMATED, FITTED_OFFSET)):
        alone = _judge([models[index]], JUDGED, source).pooled()
        assert abs(alone.force_mean[0] - mixed.force_mean[index]) < EXACT
    with pytest.raises(ValueError, match="zip"):
        evaluate_models(models, [RE_ESTIMATED], JUDGED)


@BOTH
def test_the_wrenches_of_figures_are_those_that_were_judged(source: Offset) -> None:
    """`with_offset` gives all samples; those after the first second have the errors of the conclusion."""
    assert JUDGED
    for model in study().models[:351:70]:
        for one in JUDGED:
            error = with_offset(model, one, source) - one.reference
            first = one.for_offset()
            assert len(error) == len(one.time_s)
            assert np.abs(error[~first] - errors_by_samples(model, one, source)).max() < EXACT
            if source is RE_ESTIMATED:
                assert np.abs(error[first].mean(axis=0)).max() < EXACT


def test_a_sensor_without_variables_is_judged_too() -> None:
    """Sets without columns of variables, models without coefficients."""
    bare = [replace(one, variables=np.empty((len(one.time_s), 0))) for one in JUDGED]
    model = WrenchModel(matrix=TRUTH.matrix, offset=TRUTH.offset)
    for source in KNOWN_BEFORE:
        assert _difference(_judge([model], bare, source).pooled(), _by_samples([model], bare, source)) < EXACT


def test_progress_counts_every_set_once() -> None:
    """From none on."""
    done: list[int] = []
    evaluate_models([TRUTH], [RE_ESTIMATED], JUDGED, progress=done.append)
    assert done == [0, 1, 2]


def _of_length(samples: int, *, rate_hz: float = 100.0) -> ValidationSet:
    one = judged("short", "day", 27.0, 28.0, seed=31, n=samples)
    return replace(one, time_s=7.0 + np.arange(samples) / rate_hz)


def test_an_interval_that_is_too_short_is_refused() -> None:
    """Ten samples for the offset and ten to judge are the least, wherever on the clock the interval starts."""
    assert OFFSET_S == 1.0
    for short, counts in ((_of_length(109), "100 and 9"), (_of_length(40, rate_hz=9.0), "9 and 31")):
        with pytest.raises(FitError, match=f"validation interval 'short': expected at least 10 .*, got {counts}"):
            evaluate_models([TRUTH], [RE_ESTIMATED], [JUDGED[0], short])
    assert _judge([TRUTH], [_of_length(110)], RE_ESTIMATED).count.sum() == 10
    assert _of_length(40, rate_hz=10.0).for_offset().sum() == 10


def test_arrays_of_a_set_fit_each_other() -> None:
    """Numbers of samples that differ are refused, and nobody changes what is held."""
    one = JUDGED[0]
    with pytest.raises(ShapeError, match="reference: expected an array of shape"):
        replace(one, reference=one.reference[:-1])
    with pytest.raises(ShapeError, match="variables: expected an array of shape"):
        replace(one, variables=one.variables[:, 0])
    assert not one.raw.flags.writeable
