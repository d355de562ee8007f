# SPDX-License-Identifier: BSD-3-Clause
"""The figures of acceptance and validation, of random data."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np
from matplotlib.figure import Figure

from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.evaluation.acceptance.acceptance import Acceptance
from forcetorque.evaluation.acceptance.criteria import Bound, Criterion
from forcetorque.evaluation.figures.acceptance_and_contact_forces import acceptance_figure, validation_figure
from forcetorque.evaluation.validation.contact_force_errors import BestCalibration, ContactForceErrors
from forcetorque.evaluation.validation.validation import JointTorqueErrors, Validation
from forcetorque.experiment.validation_offset import Offset

SENSOR = {"sensor": "_left $leg$", "serial": "FT1", "offset_source": "its own"}


def draw_acceptance(rng: np.random.Generator) -> Figure:
    """Criteria of two sensors, some beyond what the axis shows, a limit of zero among them."""
    measured = [*np.exp(rng.normal(0.0, 1.5, 10)), np.inf, 0.0, -1.0]
    bounds = [*[Bound.AT_MOST] * 6, *[Bound.AT_LEAST] * 4, Bound.AT_MOST, Bound.AT_LEAST, Bound.AT_MOST]
    criteria = tuple(
        criterion_of(
            f"evaluate.rmse.{WRENCH_COMPONENTS[k % 6]}",
            float(value),
            0.0 if k == 12 else 1.5,
            bound=bound,
            sensor="left" if k < 7 else "_right $",
            unit="N" if k < 6 else "",
        )
        for k, (value, bound) in enumerate(zip(measured, bounds, strict=True))
    )
    return acceptance_figure(acceptance_of(*criteria))


def criterion_of(
    name: str,
    measured: float,
    limit: float,
    *,
    bound: Bound = Bound.AT_MOST,
    sensor: str = "left",
    unit: str = "N",
) -> Criterion:
    """A criterion of a sensor."""
    return Criterion(
        sensor=sensor,
        serial="FT1",
        calibration="leg.json",
        criterion=name,
        measured=measured,
        bound=bound,
        limit=limit,
        unit=unit,
        count=100,
        note="",
    )


def acceptance_of(*criteria: Criterion) -> Acceptance:
    """An acceptance by these criteria."""
    return Acceptance(experiment="leg", specification="limits of $all$", criteria=criteria, measured=())


def contact_force(
    calibration: str,
    offset: Offset,
    force_N: float,
    *,
    sensor: str = SENSOR["sensor"],
    half_width_N: float | None = 0.3,
) -> ContactForceErrors:
    """Contact force of so much."""
    return ContactForceErrors(
        **SENSOR | {"sensor": sensor},
        sub_model="left leg",
        calibration=calibration,
        offset=offset,
        prior=None,
        samples=1000,
        force_mean_N=force_N,
        force_mean_error_N=0.1,
        force_mean_half_width_95_N=half_width_N,
        moment_mean_Nm=0.1,
        mean_absolute=(1.0,) * 6,
        bias=(0.0,) * 6,
        independent=20.0,
        excitation_N=10.0,
        excitation_Nm=1.0,
    )


def draw_validation(rng: np.random.Generator) -> Figure:
    """A prior and two calibrations of one sensor, an interval that is not known, and five joints."""
    names = ("prior", "leg.json", "another $leg$ of a long name.json")
    forces = tuple(
        contact_force(name, offset, float(size), half_width_N=None if k == 1 else 0.3)
        for offset in (Offset.FIRST_SECOND, Offset.NONE)
        for k, (name, size) in enumerate(zip(names, rng.uniform(1.0, 8.0, 3), strict=True))
    )
    torques = tuple(
        JointTorqueErrors(
            **SENSOR,
            calibration=name,
            offset=Offset.FIRST_SECOND,
            prior=None,
            joint=f"l_joint_{joint}",
            unit="N m",
            samples=1000,
            rmse=float(rng.uniform(0.1, 1.0)),
            rmse_error=0.02,
            rmse_half_width_95=0.05,
            mean=0.0,
            mean_error=0.01,
            mean_half_width_95=0.02,
            largest=2.0,
            logged_samples=None,
            logged_rmse=None,
            logged_rmse_error=None,
            logged_rmse_half_width_95=None,
        )
        for name in names
        for joint in range(5)
    )
    return validation_figure(validation_of(forces, "inconclusive").model_copy(update={"joint_torques": torques}))


def validation_of(
    forces: Sequence[ContactForceErrors], conclusion: Literal["better", "no difference", "inconclusive"] | None
) -> Validation:
    """A validation of contact forces, by one conclusion for every sensor and offset."""
    least: dict[tuple[str, Offset], ContactForceErrors] = {}
    for row in sorted(forces, key=lambda row: row.force_mean_N):
        least.setdefault((row.sensor, row.offset), row)
    best = tuple(
        BestCalibration(
            sensor=sensor,
            offset=offset,
            by_magnitude=row.calibration,
            by_axis=(row.calibration,) * 6,
            conclusion=conclusion,
            comparisons=(),
        )
        for (sensor, offset), row in least.items()
    )
    return Validation(
        experiment="leg", other_sensors="model", contact_forces=tuple(forces), best=best, joint_torques=(), left_out=()
    )
