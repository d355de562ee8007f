# SPDX-License-Identifier: BSD-3-Clause
"""What makes a calibration doubtful, by what the fit itself came to."""

from __future__ import annotations

from collections.abc import Collection, Iterator

from forcetorque.calibration import CalibratedVariable, Calibration
from forcetorque.spatial import WRENCH_COMPONENTS


def fit_doubts(calibration: Calibration, *, said: Collection[str] = ()) -> Iterator[str]:
    """Say what makes a calibration doubtful.

    Args:
        calibration: The calibration.
        said: Doubts about its data that were said already.

    Yields:
        A sentence per doubt, with the name of the sensor.
    """
    sensor = calibration.sensor.name
    own = (*_turned(calibration), *_unmoved(calibration), *_left_prior(calibration), *_refused(calibration))
    for sentence in (*(doubt for doubt in calibration.doubts if doubt not in said), *own):
        yield f"{sensor}: {sentence}"


def _turned(calibration: Calibration) -> Iterator[str]:
    secondary = calibration.secondary_matrix()
    if secondary is None:
        return
    turned = [c for c, own in zip(WRENCH_COMPONENTS, secondary.diagonal(), strict=True) if own < 0.0]
    if turned:
        yield (
            f"{', '.join(turned)} come(s) out with the sign of the prior reversed; "
            "is gravity_direction or measure_direction the right way round?"
        )


def _unmoved(calibration: Calibration) -> Iterator[str]:
    """Variables that say nothing because they did not move."""
    if calibration.posterior is None:
        return
    for variable in calibration.variables:
        if variable.maximum == variable.minimum:
            yield (
                f"{variable.name} is {variable.minimum:g} {_unit(variable)}throughout the fitted data, so that what it "
                "does is not known: its coefficients are those that were expected"
            )


def _left_prior(calibration: Calibration) -> Iterator[str]:
    """A type of the thesis shrinks the matrix where no load speaks; the generative model keeps the prior there."""
    excited = calibration.validity.excited
    if calibration.posterior is not None or not (unexcited := excited.count(False)):
        return
    yield (
        f"the loads leave {unexcited} of {len(excited)} raw directions unexcited; along them "
        f"{calibration.estimation_type} leaves the prior for noise, and a load that was not recorded may read worse "
        "than before; the default estimator keeps the prior there"
    )


def _refused(calibration: Calibration) -> Iterator[str]:
    """A correction that was asked for and lost."""
    if calibration.nonlinear is not None:
        yield from calibration.nonlinear.refusals()


def _unit(variable: CalibratedVariable) -> str:
    return f"{variable.unit} " if variable.unit else ""
