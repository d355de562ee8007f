# SPDX-License-Identifier: BSD-3-Clause
"""A contact that nobody stated leaves a single fit, and sound logs lose nothing by the rule that finds it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.calibration import contact_windows
from forcetorque.calibration.contact_windows import (
    Disagreeing,
    _loses_direction,
    _mean_variance,
    _residual,
    agreeing_samples,
)
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.moments_of_samples import _within
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import DataSet, WindowMeans
from forcetorque.study.candidate_errors import push_error
from tests.calibration.push_error import LIMIT_COUNTS, TEMPERATURE, cases
from tests.calibration.synthetic import GRAVITY, MOUNTED, OFFSET, PRIOR, assumptions
from tests.cases import some_cases

RATE_HZ, DURATION_S, MASS_KG = 50.0, 60.0, 5.0
RESPONSE = np.linalg.inv(MOUNTED)
START_S, END_S = 20.4, 23.4
CONTACT = np.array([6.0, -7.0, 4.0, 0.5, 0.3, -0.6])
"""10 N at 0.1 m; N, N m."""


def _time() -> FloatArray:
    return np.arange(0.0, DURATION_S, 1.0 / RATE_HZ)


def _limb(*, moving: tuple[float, float] = (0.0, DURATION_S)) -> FloatArray:
    """Loads of a limb that swings about two axes and bends, in a span of time, and is at rest else; shape (n, 6)."""
    time = np.clip(_time() - moving[0], 0.0, moving[1] - moving[0])
    pitch, roll, bend = (np.sin(rate * time) for rate in (0.9, 0.57, 0.71))
    down = np.stack([np.sin(1.2 * pitch), -np.cos(1.2 * pitch) * np.sin(roll), -np.cos(1.2 * pitch) * np.cos(roll)])
    centre = np.stack([0.05 + 0.08 * bend, 0.02 + 0.03 * roll, -0.2 + 0.04 * bend], axis=1)
    force = MASS_KG * GRAVITY * down.T
    return np.hstack([force, np.cross(centre, force)])


def _data(
    loads: FloatArray, *, contact: FloatArray | None = None, counts: FloatArray | float = 0.0, seed: int = 1
) -> DataSet:
    """Readings of the mounted sensor, with noise of 4 counts and what else is added to them."""
    time, rng = _time(), np.random.default_rng(seed)
    profile = np.clip(np.minimum((time - START_S) / 0.3, (END_S - time) / 0.3), 0.0, 1.0)
    wrench = loads - OFFSET + (0.0 if contact is None else np.outer(profile, contact))
    noise = 4.0 * rng.standard_normal((len(time), 6))
    return DataSet(
        label="swing",
        raw=np.rint(wrench @ RESPONSE.T + noise + counts),
        reference=loads,
        time_s=100.0 + time,
        session="day",
        recording="log",
    )


def _left_out(*data: DataSet) -> tuple[float, Sequence[Disagreeing]]:
    """Seconds that leave, and their spans."""
    agree, spans = agreeing_samples(data, PRIOR, assumptions(accuracy=None))
    return sum(int(np.count_nonzero(~marks)) for marks in agree) / RATE_HZ, spans


def _fitted(data: DataSet) -> FloatArray:
    return fit_generative([WindowMeans.of(data)], PRIOR, assumptions(accuracy=None)).model.matrix


def test_a_contact_of_three_seconds_leaves_with_its_neighbours() -> None:
    """Where it was, how strong, and the fit is that of a log without it; it was half as much again worse with it."""
    touched, clean = _data(_limb(), contact=CONTACT), _data(_limb())
    (marks,), (span,) = agreeing_samples([touched], PRIOR, assumptions(accuracy=None))
    assert span.label == "swing"
    assert START_S - 2.0 <= span.start_s - 100.0 <= START_S
    assert END_S <= span.end_s - 100.0 <= END_S + 2.0
    assert span.force_N == pytest.approx(np.linalg.norm(CONTACT[:3]), rel=0.1)
    assert span.moment_Nm == pytest.approx(np.linalg.norm(CONTACT[3:]), rel=0.1)
    assert 4.0 <= np.count_nonzero(~marks) / RATE_HZ <= 6.0
    before, after, best = (push_error(_fitted(data), MOUNTED).force_N for data in (touched, touched.kept(marks), clean))
    assert after < 1.2 * best
    assert before > 1.5 * best


@pytest.mark.parametrize("contact", [CONTACT, None], ids=["touched", "untouched"])
def test_a_contact_leaves_where_the_fit_to_it_is_refused(
    contact: FloatArray | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A contact may turn the first matrix until a direction is lost; then the prior matrix tells what to suspect."""
    fits = iter([FitError("a direction is lost")])

    def refused_once(*arguments: Any, **options: Any) -> GenerativeFit:
        for error in fits:
            raise error
        return fit_generative(*arguments, **options)

    monkeypatch.setattr(contact_windows, "fit_generative", refused_once)
    seconds, spans = _left_out(_data(_limb(), contact=contact))
    assert next(fits, None) is None
    assert (seconds, len(spans)) == ((0.0, 0) if contact is None else (pytest.approx(5.0, abs=1.0), 1))


def _burst(counts: float) -> FloatArray:
    """Noise of 0.1 s in the span of the contact; counts."""
    time, rng = _time(), np.random.default_rng(8)
    noise = rng.standard_normal((len(time), 6))
    for k in range(1, len(noise)):
        noise[k] = 0.8 * noise[k - 1] + 0.6 * noise[k]
    return counts * noise * ((time > START_S) & (time < END_S))[:, None]


SOUND = {
    "a limb that moves": _data(_limb()),
    "a burst of noise": _data(_limb(), counts=_burst(150.0)),
    "one move in a log at rest": _data(_limb(moving=(25.0, 31.0))),
    "a slow drift": _data(_limb(), counts=40.0 * np.exp(-_time() / 10.0)[:, None] * np.ones(6)),
    "a log at rest": _data(_limb(moving=(0.0, 0.0))),
    "no noise": replace(_data(_limb()), raw=(_limb() - OFFSET) @ RESPONSE.T),
    "coarse counts": replace(_data(_limb()), raw=20.0 * np.rint(_data(_limb()).raw / 20.0)),
}


def test_what_derivatives_flatten_is_no_contact() -> None:
    """A reference that lacks a third of its flattening agrees; control: one that lacks the same and does not say so."""
    profile = np.clip(np.minimum((_time() - START_S) / 0.3, (END_S - _time()) / 0.3), 0.0, 1.0)
    lacking = np.outer(profile, CONTACT)
    unstated = replace(_data(_limb()), reference=_limb() - lacking)
    assert _left_out(replace(unstated, flattening=3.0 * lacking)) == (0.0, ())
    assert len(_left_out(unstated)[1]) == 1


@pytest.mark.parametrize("name", SOUND)
def test_sound_logs_lose_nothing(name: str) -> None:
    """Control: no sample of any of these leaves."""
    assert _left_out(SOUND[name]) == (0.0, ())


def test_a_second_interval_tells_that_the_first_was_touched() -> None:
    """Intervals of one recording are held against each other, and both count their own samples."""
    data = _data(_limb(), contact=CONTACT)
    first = data.time_s < 145.0
    one, other = data.kept(first), replace(data.kept(~first), label="other")
    seconds, (span,) = _left_out(one, other)
    assert 4.0 <= seconds <= 6.0
    assert span.label == "swing"


@some_cases(("moving", "times"), [((20.0, 28.0), -1.0), ((40.0, 60.0), 4.0)])
def test_a_motion_that_the_prior_does_not_read_is_no_contact(moving: tuple[float, float], times: float) -> None:
    """Where sense or masses are wrong the fit is refused; without the only motion there would be one."""
    loads = _limb(moving=moving)
    wrong = replace(_data(loads), reference=times * loads)
    with pytest.raises(FitError, match="of what its prior says"):
        fit_generative([WindowMeans.of(wrong)], PRIOR, assumptions(accuracy=None))
    loads[:, 5] = 0.25  # a component at rest is no direction, nor is the fit refused for every wrong reference
    for data in (wrong, replace(_data(loads), reference=times * loads)):
        (agree,), spans = agreeing_samples([data], PRIOR, assumptions(accuracy=None))
        assert agree.all()
        assert not spans


def test_poses_and_short_logs_are_left_as_they_are() -> None:
    """A table has one sample a second, whose neighbours are other poses; of 19 seconds nobody can tell."""
    data = _data(_limb(), contact=CONTACT)
    assert _left_out(data.kept(np.arange(len(data.raw)) % int(RATE_HZ) == 0)) == (0.0, ())
    assert _left_out(data.kept(np.abs(data.time_s - 121.0) < 9.4)) == (0.0, ())


def test_where_most_is_touched_nobody_knows_which_is_right() -> None:
    """A contact of half of the log stays."""
    data = _data(_limb())
    touched = data.time_s > 129.0
    assert _left_out(replace(data, raw=data.raw + np.outer(touched, RESPONSE @ CONTACT))) == (0.0, ())


MOTIONS = {"grid": ["grid"], "bsl": ["bsl"], "bnsl": ["bnsl"], "tz": ["tz"]}
MOVED = {
    "l_leg_ft": ["grid", "tz", "bnsl"],
    "r_leg_ft": ["bsl"],
    "l_foot_ft": ["grid", "bnsl"],
    "l_arm_ft": ["bsl"],
    "r_foot_ft": ["bsl"],
}


@pytest.mark.long
def test_limbs_that_were_touched_come_out_as_if_they_were_not() -> None:
    """24 sensors, priors 2 % off, 5 to 20 N for 3 s: 15 became worse than their prior; sound logs lose nothing."""
    worse, ratios = {"touched": 0, "left out": 0}, []
    for number, case in enumerate(cases(MOTIONS, MOVED, range(700, 703))):
        (data,) = case.data
        rng = np.random.default_rng(900 + number)
        spread = np.random.default_rng(case.seed).standard_normal(case.truth.shape)
        prior = case.truth + 0.02 * spread * np.sqrt((case.truth**2).mean(axis=1, keepdims=True))
        force = rng.standard_normal(3)
        force *= rng.uniform(5.0, 20.0) / np.linalg.norm(force)
        wrench = np.concatenate([force, np.cross(rng.uniform(-0.2, 0.2, 3), force)])
        time = data.time_s - data.time_s[0]
        start_s = rng.uniform(2.0, time[-1] - 6.0)
        profile = np.clip(np.minimum((time - start_s) / 0.3, (start_s + 3.0 - time) / 0.3), 0.0, 1.0)
        touched = replace(data, raw=data.raw + np.outer(profile, np.linalg.pinv(case.truth) @ wrench))
        assumed = replace(assumptions(accuracy=None, repeatability=0.003), full_scale=np.full(6, LIMIT_COUNTS))

        (clean,), none = agreeing_samples([data], prior, assumed, variables=[TEMPERATURE])
        assert clean.all()
        assert none == ()
        (agree,), _ = agreeing_samples([touched], prior, assumed, variables=[TEMPERATURE])
        worse["touched"] += _push_ratio(touched, prior, case.truth, assumed) > 1.05
        ratios.append(_push_ratio(touched.kept(agree), prior, case.truth, assumed))
        worse["left out"] += ratios[-1] > 1.05
    assert len(ratios) == 24
    assert worse["touched"] >= 10
    assert worse["left out"] == 0


def _push_ratio(data: DataSet, prior: FloatArray, truth: FloatArray, assumed: Assumptions) -> float:
    """Error of pushes after a fit over that before, of force or moment, whichever is larger."""
    fit = fit_generative([WindowMeans.of(data)], prior, assumed, variables=[TEMPERATURE])
    after, before = push_error(fit.model.matrix, truth), push_error(prior, truth)
    return max(after.force_N / before.force_N, after.moment_Nm / before.moment_Nm)


def test_a_constant_load_does_not_hide_a_direction_that_is_lost() -> None:
    """All windows in which two forces differ are marked; weight that is always there changes nothing."""
    common, difference = np.random.default_rng(3).normal(size=(2, 80)) * [[5.0], [2.0]]
    marks = np.arange(80) < 40
    for is_lost in (True, False):
        change = np.where(marks | (not is_lost), difference, 0.0)
        loads = np.zeros((80, 6))
        loads[:, 0], loads[:, 2] = common + change, common - change
        for shift in (0.0, np.array([300.0, 0.0, -100.0, 0.0, 20.0, 0.0])):
            assert _loses_direction(loads + shift, marks) is is_lost


@pytest.mark.parametrize(("share", "counts"), [(0.095, False), (0.105, True)])
def test_a_direction_is_lost_that_has_a_tenth_of_the_largest_spread(share: float, counts: bool) -> None:
    """Of two forces with a common part and a difference that is independent of it; in any unit."""
    rng = np.random.default_rng(3)
    common, difference, marks = rng.normal(size=80), np.zeros(80), np.arange(80) < 40
    common -= common.mean()
    beside = np.column_stack([np.ones(40), common[:40]])
    drawn = rng.normal(size=40)
    difference[:40] = drawn - beside @ np.linalg.lstsq(beside, drawn)[0]
    difference *= share * common.std() / difference.std()
    loads = np.zeros((80, 6))
    loads[:, 0], loads[:, 2] = common + difference, common - difference
    for unit in (1.0, 1e3):
        assert _loses_direction(unit * loads, marks) is counts


@pytest.mark.parametrize("start_s", [0.0, 100.1, 1e6 + 0.3])
def test_noise_of_a_window_is_that_of_its_quarters_on_any_clock(start_s: float) -> None:
    """By hand: the variance of four means over four, of quarters of a second from the first sample on."""
    quarters = np.random.default_rng(5).normal(size=(4, 6))
    time_s = start_s + np.arange(round(30.0 * RATE_HZ)) / RATE_HZ
    inside_s = (np.arange(len(time_s)) / RATE_HZ) % 1.0
    error = quarters[(inside_s / 0.25 + 1e-9).astype(int)]
    data = DataSet(label="log", raw=error, reference=error, time_s=time_s, session="day", recording="log")
    variance = _mean_variance(data, error, data.window)
    np.testing.assert_allclose(variance, np.tile(quarters.var(axis=0, ddof=1) / 4.0, (30, 1)), rtol=1e-9)


def test_what_a_window_may_leave_for_errors_of_the_model_by_hand() -> None:
    """A quarter of a degree of force and moment, and a millimetre of lever; what is left is about 21 windows around."""
    time_s, force, moment = np.arange(40.0 * 4) / 4.0, np.array([3.0, 4.0, 12.0]), np.array([0.6, 0.0, 0.8])
    size = 1.0 + np.floor(time_s)[:, None] / 10.0
    loads, slope = size * np.concatenate([force, moment]), np.arange(1.0, 7.0)
    flattening = np.tile([0.3, 0.0, 0.0, 0.0, 0.0, 0.6], (len(time_s), 1))
    error = np.floor(time_s)[:, None] * slope
    data = DataSet(
        label="log",
        raw=(loads + flattening / 3.0 + error) @ np.linalg.inv(PRIOR).T,
        reference=loads,
        flattening=flattening,
        time_s=time_s,
        session="day",
        recording="log",
    )
    left, least = _residual(data, WindowMeans.of(data), None, PRIOR)
    # the medians of 21 windows of a ramp are those of its middle, and at the ends those of the first and last 21
    middle = np.clip(np.arange(40), 10, 29)
    np.testing.assert_allclose(left, (np.arange(40) - middle)[:, None] * slope, atol=1e-9)
    turned = np.radians(0.25)
    of_window = size[::4] * np.repeat([13.0 * turned, 1.0 * turned + 13.0 * 0.001], 3)
    np.testing.assert_allclose(least, of_window, rtol=1e-9)


def test_spans_end_where_the_samples_of_their_interval_do() -> None:
    """Of another interval they are not cut; a span without any of its samples is none."""
    short, long = (
        DataSet(label=label, raw=np.zeros((11, 6)), reference=np.zeros((11, 6)), time_s=np.linspace(*ends, 11))
        for label, ends in (("short", (10.0, 20.0)), ("long", (0.0, 90.0)))
    )
    spans = [
        Disagreeing(label=label, start_s=start_s, end_s=end_s, force_N=1.0, moment_Nm=0.1)
        for label, start_s, end_s in (
            ("short", 8.0, 12.0),
            ("short", 14.0, 15.0),
            ("short", 20.0, 22.0),
            ("short", 20.5, 22.0),
            ("short", 8.0, 9.5),
            ("long", 8.0, 95.0),
        )
    ]
    cut = [(span.label, span.start_s, span.end_s) for span in _within([short, long], spans)]
    assert cut == [("short", 10.0, 12.0), ("short", 14.0, 15.0), ("short", 20.0, 20.0), ("long", 8.0, 90.0)]
