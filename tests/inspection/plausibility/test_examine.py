# SPDX-License-Identifier: BSD-3-Clause
"""What the gate says of small made-up data."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError, ShapeError
from forcetorque.experiment.calibration.moments import DataSet, Moments
from forcetorque.inspection.plausibility.compared_wrenches import Movement
from forcetorque.inspection.plausibility.gate import examine
from forcetorque.inspection.plausibility.gravity_sense_gain_and_unit_checks import (
    STILL,
    require_moving_load,
    require_same_sign,
)

RNG = np.random.default_rng(5)
PRIOR = 0.02 * (np.eye(6) + 0.1 * RNG.normal(size=(6, 6)))
STEP_S = 0.02
TIME_S = STEP_S * np.arange(1500)


def _reference(time_s: FloatArray, weight: float = 20.0) -> FloatArray:
    """A tool turned about two axes; its centre of mass moves too, so that moments are no copy of forces."""
    pitch, roll = 1.2 * np.sin(1.3 * time_s), 0.9 * np.sin(0.8 * time_s + 1.0)
    force = -weight * np.column_stack([np.sin(pitch), -np.cos(pitch) * np.sin(roll), np.cos(pitch) * np.cos(roll)])
    arm = np.column_stack([0.02 * np.cos(2.1 * time_s), 0.01 * np.sin(1.7 * time_s), 0.08 + 0.0 * time_s])
    return np.hstack([force, np.cross(arm, force)])


def _data(delay_s: float = 0.0, weight: float = 20.0, noise_counts: float = 3.0) -> DataSet:
    noise = noise_counts * np.random.default_rng(6).normal(size=(len(TIME_S), 6))
    raw = _reference(TIME_S - delay_s, weight) @ np.linalg.inv(PRIOR).T + 500.0 + noise
    return DataSet(label="a", raw=raw, reference=_reference(TIME_S, weight), time_s=TIME_S)


@pytest.mark.parametrize("prior", [None, PRIOR], ids=["no prior", "prior"])
def test_good_data_raise_no_doubt(prior: FloatArray | None) -> None:
    """Alone, and as two data sets with offsets of their own."""
    data = _data()
    assert examine([data], prior) == ()
    assert examine([data, replace(data, raw=data.raw + 3e4)], prior) == ()


@pytest.mark.parametrize("prior", [None, PRIOR], ids=["no prior", "prior"])
@pytest.mark.parametrize(("delay_s", "words"), [(0.1, "100 ms later"), (-0.06, "60 ms earlier"), (0.04, "40 ms later")])
def test_a_delay_is_named_to_the_sample(prior: FloatArray | None, delay_s: float, words: str) -> None:
    """Also over uneven steps; not where the instants are unknown, nor where it is one sample."""
    data = _data(delay_s)
    uneven = np.sort(np.random.default_rng(7).permutation(len(TIME_S))[:1300])
    thinned = DataSet(label="a", raw=data.raw[uneven], reference=data.reference[uneven], time_s=TIME_S[uneven])
    for one in (data, thinned):
        (doubt,) = examine([one], prior)
        assert (doubt.kind, words in doubt.message) == ("delay", True)
        assert "[[clock]]" in doubt.message
    assert examine([replace(data, time_s=None)], prior) == ()
    assert examine([_data(STEP_S)], prior) == ()


def test_a_reading_of_something_else_is_refused_and_doubted_without_a_prior() -> None:
    """Its size in newtons is known with a prior only; the message names what to check."""
    other = replace(_data(), reference=_reference(1.37 * TIME_S + 40.0)[:, [1, 2, 0, 4, 5, 3]])
    with pytest.raises(FitError, match=r"explains \d+%; check the unit of the joints .* stream of \[\[sensor\]\]"):
        examine([other], PRIOR)
    assert [doubt.kind for doubt in examine([other], None)] == ["span"]


def test_a_slow_drift_is_no_wrong_model() -> None:
    """Half a newton under noise, and a drift of several newtons while the sensor warms up."""
    light = _data(weight=0.5, noise_counts=5.0)
    drift = np.outer(-np.expm1(-TIME_S / 40.0), [400.0, -300.0, 500.0, 200.0, 100.0, -100.0])
    assert examine([replace(light, raw=light.raw + drift)], PRIOR) == ()


def test_what_a_variable_explains_is_no_doubt() -> None:
    """A sensor that warms up by more than its load; without the variable the reading does not follow the load."""
    warm = 20.0 + 3.0 * np.sin(0.31 * TIME_S)
    data = _data()
    drifting = replace(data, raw=data.raw + np.outer(warm, [900.0, -700.0, 1200.0, 400.0, -300.0, 500.0]))
    assert examine([replace(drifting, variables=warm[:, None])], PRIOR) == ()
    with pytest.raises(FitError):
        examine([drifting], PRIOR)


def test_one_axis_that_is_reversed_is_named() -> None:
    """A left-handed prior: the other forces run with the reference."""
    with pytest.raises(
        FitError, match=r"fy by the prior matrix is opposite to the expected force, other components are"
    ):
        examine([_data()], np.diag([1.0, -1.0, 1.0, 1.0, 1.0, 1.0]) @ PRIOR)


def test_an_axis_that_rounding_leaves_less_than_nothing_of_is_no_axis_against() -> None:
    """What a drift explains is taken out by subtraction: an axis at rest then has a moment of -1e-17 now and then."""
    moved = np.diag([9.0, 4.0, -1e-17, 0.1, 0.1, 0.1])
    movement = Movement(count=1000, second=np.tile(moved, (2, 2)), lasting=np.zeros((12, 12)), size=np.full(6, 3.0))
    require_same_sign(movement, np.eye(6))
    backwards = np.tile(moved, (2, 2)) * np.kron([[1.0, -1.0], [-1.0, 1.0]], np.ones((6, 6)))
    with pytest.raises(FitError, match="is opposite to the expected force"):
        require_same_sign(replace(movement, second=backwards), np.eye(6))


def test_a_reference_beyond_the_full_scale_is_refused() -> None:
    """The only check of its size without a prior; a load near the full scale passes."""
    full_scale = np.array([25.0, 25.0, 25.0, 3.0, 3.0, 3.0])
    assert examine([_data()], None, full_scale) == ()
    with pytest.raises(FitError, match=r"full scale is .* in grams instead of kg"):
        examine([_data(weight=2e4)], None, full_scale)


@pytest.mark.parametrize("unit", [1e-3, 0.098, 0.113], ids=["N mm", "kgf cm", "lbf in"])
def test_moments_in_another_unit_than_stated_are_refused(unit: float) -> None:
    """N m that are stated as a smaller unit: the gain of the whole wrench is that of its forces, which are right."""
    good = _data()
    stated = np.diag([1.0, 1.0, 1.0, unit, unit, unit]) @ PRIOR
    with pytest.raises(FitError, match=r"the moment of the prior's reading .* units of \[\[recording.stream\]\]"):
        examine([good], stated)
    still = good.reference * np.array([1.0, 1.0, 1.0, 1e-3, 1e-3, 1e-3])
    near_axis = replace(good, reference=still, raw=still @ np.linalg.inv(PRIOR).T)
    # beside a lever of a tenth of a millimetre a unit cannot be seen
    assert {doubt.kind for doubt in examine([near_axis], stated)} <= {"scale"}


def test_eight_channels_are_judged_as_six_are() -> None:
    """Good, half the mass and reversed."""
    wide = 0.02 * np.hstack([np.eye(6), np.random.default_rng(9).normal(size=(6, 2))])
    data = replace(_data(), raw=_data().reference @ np.linalg.pinv(wide).T)
    assert examine([data], wide) == ()
    with pytest.raises(FitError, match="half of the true mass"):
        examine([replace(data, reference=0.5 * data.reference)], wide)
    with pytest.raises(FitError, match="is opposite to the expected force"):
        examine([replace(data, reference=-data.reference)], wide)


@pytest.mark.parametrize("prior", [None, PRIOR], ids=["no prior", "prior"])
def test_few_samples_are_a_doubt_and_one_is_refused(prior: FloatArray | None) -> None:
    """A prior fits them all the same; one sample is a load that stands still, several of a sample each may not be."""
    data = _data()
    (doubt,) = examine([DataSet(label="b", raw=data.raw[:12], reference=-data.reference[:12])], prior)
    assert (doubt.kind, doubt.message[:21]) == ("span", "12 samples are fitted")
    one, other = (DataSet(label="b", raw=data.raw[[k]], reference=data.reference[[k]]) for k in (0, 100))
    with pytest.raises(FitError, match="stands still"):
        examine([one], prior)
    (doubt,) = examine([one, other], prior)
    assert doubt.message.startswith("2 samples are fitted")


def test_no_sample_says_nothing_and_channels_that_differ_are_refused() -> None:
    """That there is none is for the fit to say."""
    data = _data()
    assert examine([], PRIOR) == ()
    with pytest.raises(ShapeError):
        examine([data, replace(data, raw=data.raw[:, :5])], None)
    with pytest.raises(ShapeError):
        examine([data], PRIOR[:, :5])


def _poses(seed: int) -> DataSet:
    """A table of still poses of one tool, a row for each: what neighbours share is chance."""
    rng = np.random.default_rng(seed)
    count = int(rng.choice([20, 24, 30, 40, 60]))
    force = rng.normal(size=(count, 3))
    force *= 13.7 / np.linalg.norm(force, axis=1, keepdims=True)
    reference = np.hstack([force, np.cross([0.02, -0.01, 0.06], force)])
    raw = reference @ np.linalg.inv(PRIOR).T + 500.0 + 3.0 * rng.normal(size=(count, 6))
    return DataSet(label="poses", raw=raw, reference=reference, time_s=np.arange(float(count)))


@pytest.mark.parametrize("prior", [None, PRIOR], ids=["no prior", "prior"])
def test_still_poses_raise_no_doubt(prior: FloatArray | None) -> None:
    """In any order: of independent rows no white noise can be told, and chance made that of some negative."""
    negative = 0
    for seed in range(100):
        data = _poses(seed)
        assert examine([data], prior) == ()
        columns = np.hstack([data.raw, data.reference])
        pairs = 0.5 * (columns[1:] + columns[:-1])
        negative += int((2.0 * pairs.var(axis=0) - columns.var(axis=0))[:3].sum() < 0.0)
    assert negative > 20


def test_still_poses_of_another_load_are_refused() -> None:
    """Rows in another order than the poses' follow them by chance alone."""
    for seed in range(100):
        data = _poses(seed)
        turned = replace(data, reference=np.roll(data.reference, 7, axis=0))
        with pytest.raises(FitError, match=r"explains \d+%|runs? against|times as much"):
            examine([turned], PRIOR)


def test_a_reading_of_noise_alone_is_refused() -> None:
    """Whether chance makes what neighbours share positive or negative."""
    for seed in range(40):
        noise = 500.0 + 3.0 * np.random.default_rng(seed).normal(size=(len(TIME_S), 6))
        with pytest.raises(FitError, match=r"explains \d+%|times as much|against"):
            examine([replace(_data(), raw=noise)], PRIOR)


@pytest.mark.parametrize(("delay_s", "words"), [(0.5, "500 ms later"), (-0.5, "500 ms earlier")])
def test_the_largest_delay_is_still_looked_for(delay_s: float, words: str) -> None:
    """Half a second, a whole number of steps, either way."""
    (doubt,) = examine([_data(delay_s)], None)
    assert words in doubt.message


def _reference_of(force_n: float, lever_m: float, swing_nm: float) -> Moments:
    """A force that stays, and a moment whose root mean square swings about what the lever makes of it."""
    swing = swing_nm * np.tile([1.0, -1.0], 50)
    wrench = np.zeros((100, 6))
    wrench[:, 2], wrench[:, 3] = force_n, force_n * lever_m + swing
    return Moments.of(RNG.normal(size=(100, 6)), wrench)


@pytest.mark.parametrize(("force_n", "lever_m", "size_nm"), [(20.0, 0.25, 5.0), (400.0, 0.25, 100.0), (20.0, 0.0, 0.2)])
def test_a_moment_moves_from_a_thousandth_of_its_size_on(force_n: float, lever_m: float, size_nm: float) -> None:
    """Of its root mean square, or of what a lever of a centimetre makes of the force where the load hangs below."""
    require_moving_load(_reference_of(force_n, lever_m, 1.1 * STILL * size_nm))
    with pytest.raises(FitError, match="the reference stays within"):
        require_moving_load(_reference_of(force_n, lever_m, 0.9 * STILL * size_nm))
