# SPDX-License-Identifier: BSD-3-Clause
"""A reference without load, or one that stands still, is refused before it spoils a matrix."""

from __future__ import annotations

import math

import numpy as np
import pytest

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FitError
from forcetorque.calibration.thesis.calibrate import calibrate
from forcetorque.experiment.calibration.excitation import excitation_of
from forcetorque.experiment.calibration.moments import DataSet, Moments

PRIOR = 0.02 * (np.eye(6) + 0.1 * np.random.default_rng(1).normal(size=(6, 6)))
WEIGHT = np.array([3.0, -4.0, -40.0, 1.5, 0.8, 0.1])
"""What a limb at rest weighs; N, N m."""
SAMPLES = 400


def _data(reference: FloatArray) -> list[DataSet]:
    noise = 3.0 * np.random.default_rng(2).normal(size=(len(reference), 6))
    return [DataSet(label="a", raw=reference @ np.linalg.inv(PRIOR).T + noise, reference=reference)]


def _turned(degrees: float) -> FloatArray:
    """The weight of a limb that turns to and fro about its x axis; shape (n, 6)."""
    angle = np.radians(degrees) * np.sin(np.linspace(0.0, 20.0, SAMPLES))
    cosine, sine = np.cos(angle), np.sin(angle)
    turned = np.tile(WEIGHT, (SAMPLES, 1))
    for y, z in ((1, 2), (4, 5)):
        turned[:, y], turned[:, z] = WEIGHT[y] * cosine - WEIGHT[z] * sine, WEIGHT[y] * sine + WEIGHT[z] * cosine
    return turned


@pytest.mark.parametrize("regularisation", [None, 1e3])
def test_a_model_without_mass_is_refused(regularisation: float | None) -> None:
    """Exact zeros and what rounding leaves of them name the mass and where it is given; 1 g is a load."""
    for scale in (0.0, 1e-16):
        with pytest.raises(FitError, match=r"no mass beyond the sensor; give .* \[robot\].* mass_kg of \[load\]"):
            calibrate(_data(scale * _turned(60.0)), PRIOR, regularisation=regularisation)
    calibrate(_data(0.01 / 40.0 * _turned(60.0)), PRIOR, regularisation=regularisation)


@pytest.mark.parametrize("regularisation", [None, 1e3])
@pytest.mark.parametrize("degrees", [0.0, 1e-12, 0.02])
def test_a_limb_that_stands_still_is_refused(regularisation: float | None, degrees: float) -> None:
    """Rounding and the scatter of encoders are no motion; the message says what to change."""
    with pytest.raises(FitError, match=r"stands still; .* start_s and end_s of every \[\[interval\]\] with use"):
        calibrate(_data(_turned(degrees)), PRIOR, regularisation=regularisation)


def test_a_motion_of_half_a_degree_is_fitted() -> None:
    """Weak data are not refused: the prior is there for them."""
    assert calibrate(_data(_turned(0.5)), PRIOR).fit.matrix.shape == (6, 6)


def test_a_moment_that_moves_alone_is_a_motion() -> None:
    """A mass that is shifted along a limb at rest changes no force; no moment at rest hides it."""
    reference = np.tile([0.0, 0.0, -40.0, 0.0, 0.0, 0.0], (SAMPLES, 1))
    reference[:, 3] = 0.01 * np.sin(np.linspace(0.0, 20.0, SAMPLES))
    assert calibrate(_data(reference), PRIOR).fit.matrix.shape == (6, 6)
    reference[:, 3] *= 1e-6
    with pytest.raises(FitError, match="stands still"):
        calibrate(_data(reference), PRIOR)


def test_an_offset_alone_needs_no_motion() -> None:
    """With infinite lambda the prior is kept, and a limb at rest tells the offset."""
    fit = calibrate(_data(_turned(0.0)), PRIOR, regularisation=math.inf).fit
    assert np.abs(fit.offset).max() < 0.05
    assert np.abs(fit.excitation.expected_wrench_sd).max() < 1e-9


def test_a_deviation_that_is_rounded_below_zero_is_zero() -> None:
    """Constant columns far from zero leave a second moment of either sign; its root is a number nevertheless."""
    second = np.diag([4.0] * 6 + [0.0, -1e-32, 0.0, -1e-30, 0.0, 0.0])
    still = Moments(count=100, channels=6, variables=0, origin=np.zeros(12), step=np.zeros(12), second=second)
    assert excitation_of(still).expected_wrench_sd.tolist() == [0.0] * 6
