# SPDX-License-Identifier: BSD-3-Clause
"""Linear sensors of six and more channels under loads in all directions, with push errors over those of least squares.

`python -m tests.calibration.generative.linear_sensors FIRST LAST` prints the figures of these seeds.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.calibration.generative.fit import GenerativeFit, fit_generative
from forcetorque.calibration.generative.generative_calibration import linear_if_evident
from forcetorque.experiment.calibration.expected_sensor_errors import Assumptions
from forcetorque.experiment.calibration.moments import WindowMeans
from forcetorque.experiment.calibration.quadratic_correction import LinearityTest
from forcetorque.simulation.simulated_sensor import distorted_by_mounting
from forcetorque.study.candidate_errors import push_error
from tests.calibration.synthetic import LIMIT_COUNTS, PRIOR, anyhow, hanging, read_by

CHANNELS, KINDS = (6, 8, 12), ("white", "bodies", "slow")
NOISE_COUNTS, SLOW_COUNTS, SLOW_S = 5.0, 12.0, 40.0
_BODIES = ((2.0, (0.05, 0.0, -0.1)), (5.0, (0.0, 0.06, -0.15)), (3.0, (-0.08, 0.03, 0.1)), (6.0, (0.02, -0.1, 0.05)))


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class LinearCase:
    """One sensor without quadratic terms, or with some, and its means."""

    means: WindowMeans
    """Means of a second each."""
    truth: FloatArray
    """True matrix; shape (6, c)."""

    @classmethod
    def of(cls, seed: int, channels: int, kind: str, *, quadratic_share: float = 0.0) -> LinearCase:
        """Draw a sensor.

        Args:
            seed: Seed.
            channels: Number of channels; those beyond six see mixtures of what the six see.
            kind: `white` noise, four `bodies` turned all ways, or `slow` noise beside the white one.
            quadratic_share: What a quadratic term adds, as a share of the response.

        Returns:
            The sensor.
        """
        rng = np.random.default_rng([seed, channels, KINDS.index(kind)])
        mixture = np.vstack([np.eye(6), rng.normal(size=(channels - 6, 6)) / np.sqrt(6.0)])
        response = mixture @ np.linalg.inv(distorted_by_mounting(PRIOR, relative=0.05, rng=rng))
        loads = anyhow(n=80, seed=seed)
        if kind == "bodies":
            loads = np.vstack([hanging(*body, n=25, seed=seed + k) for k, body in enumerate(_BODIES)])
        means = read_by(loads, response=response, noise_counts=NOISE_COUNTS, seed=seed)
        added = np.zeros_like(means.raw)
        if kind == "slow":
            kept = np.exp(-1.0 / SLOW_S)
            added = SLOW_COUNTS * rng.normal(size=means.raw.shape)
            for k in range(1, len(added)):
                added[k] = kept * added[k - 1] + np.sqrt(1.0 - kept**2) * added[k]
        shares = loads @ response.T
        added = added + quadratic_share * shares * np.roll(shares, 1, axis=1) / np.abs(shares).max()
        return cls(means=replace(means, raw=means.raw + added), truth=np.linalg.pinv(response))

    def fits(self) -> tuple[GenerativeFit, GenerativeFit, LinearityTest | None]:
        """Give the default fit, the one that is kept, and the evidence."""
        assumed = Assumptions.of_counts(self.truth.shape[1], LIMIT_COUNTS)
        fit = fit_generative([self.means], None, assumed)
        refit = partial(fit_generative, prior=None, assumptions=assumed)
        return fit, *linear_if_evident(fit, [self.means], refit, noise_floor=assumed.states_accuracy)

    def ratio(self, fit: GenerativeFit) -> FloatArray:
        """Push error over that of least squares of loads on readings, force and moment; shape (2,)."""
        design = np.c_[self.means.raw, np.ones(len(self.means))]
        least_squares = np.linalg.lstsq(design, self.means.reference, rcond=None)[0][: self.truth.shape[1]].T
        after, before = (push_error(matrix, self.truth) for matrix in (fit.model.matrix, least_squares))
        return np.array([after.force_N / before.force_N, after.moment_Nm / before.moment_Nm])


def _figures(first: int, last: int) -> None:
    for channels in CHANNELS:
        for kind in KINDS:
            ratios, linear = [], []
            for seed in range(first, last):
                case = LinearCase.of(seed, channels, kind)
                fit, kept, test = case.fits()
                ratios.append([case.ratio(fit), case.ratio(kept)])
                linear.append(test is not None and test.is_linear)
            default, chosen = np.swapaxes(ratios, 0, 1)
            texts = [
                f"{name} median {np.median(ratio, axis=0).round(2)} worst {ratio.max(axis=0).round(2)} "
                f"above 1.05 {(ratio > 1.05).mean(axis=0).round(2)}"
                for name, ratio in (("default", default), ("kept", chosen))
            ]
            sys.stdout.write(f"{channels} {kind} n={len(ratios)} linear {np.mean(linear):.2f}; {'; '.join(texts)}\n")
            sys.stdout.flush()


if __name__ == "__main__":
    _figures(int(sys.argv[1]), int(sys.argv[2]))
