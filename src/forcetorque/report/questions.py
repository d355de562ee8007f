# SPDX-License-Identifier: BSD-3-Clause
"""What is asked of every sensor below the page to decide by, in the order in which people ask, and the answers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Final

from forcetorque.calibration.report_blocks import excitation_blocks, lambda_blocks, learnt_blocks, uncertainty_blocks
from forcetorque.evaluation.acceptance.acceptance import criteria_table
from forcetorque.evaluation.evaluation import ERROR_WORDS, error_tables
from forcetorque.evaluation.sphere.sphere import interval_table, mass_table, moment_table
from forcetorque.evaluation.validation.contact_forces import WORTH, mean_contact_table
from forcetorque.report import record_tables as tables
from forcetorque.report.assessment.assessment import Assessment
from forcetorque.results.document.content import Block, Figure, List, Text
from forcetorque.results.document.picture import Picture
from forcetorque.results.table import short_names, table_of, without_vague

Question = tuple[str, Callable[[Assessment], Iterator[Block]]]
"""Title of a section, and what makes its blocks."""


def _errors(sensor: Assessment) -> Iterator[Block]:
    from forcetorque.evaluation.figures.errors import comparison_figure, residual_figure

    if sensor.evaluation:
        yield from error_tables(sensor.evaluation, f"Errors of {sensor.evaluation[0].samples} samples")
        words = "; ".join((ERROR_WORDS, *sensor.smoothing))
        yield Text(text=f"Numbers of these tables: {words}. The verdict goes by root mean squares.")
    if sensor.independence:
        yield table_of(sensor.independence, "How many independent samples the errors are worth")
    judged = sensor.judged
    if judged is None:
        return
    names = short_names([name for name, _ in judged.measured])
    shown = {names[name]: wrench for name, wrench in judged.measured}
    yield Figure(
        picture=Picture(lambda: comparison_figure(judged.time_s, judged.reference, shown)),
        caption="Measured wrenches against what the model demands (dashed), on data that was not fitted.",
        description=f"Six plots over time, one per component, of the reference and of {', '.join(shown)}.",
    )
    yield Figure(
        picture=Picture(
            lambda: residual_figure(judged.time_s, {name: wrench - judged.reference for name, wrench in shown.items()})
        ),
        caption="Errors: their distribution, and how long they repeat themselves.",
        description=f"Histograms and autocorrelations of the six error components of {', '.join(shown)}.",
    )


def _space(sensor: Assessment) -> Iterator[Block]:
    from forcetorque.evaluation.figures.sphere import force_space_figure, sphere_figure

    if sensor.spheres:
        yield mass_table(
            sensor.spheres,
            "Apparent mass per axis, its error as a force, and the performance index; what is not known cannot be "
            "compared",
        )
        yield interval_table(sensor.spheres)
        moments = moment_table(sensor.spheres)
        if moments is not None:
            yield moments
        names = short_names([row.candidate for row in sensor.spheres])
        reasons = {
            f"{names[row.candidate]}, {label}: not identifiable: {'; '.join(fit.why)}"
            for row in sensor.spheres
            for label, fit in (("with the model", row.with_reference), ("without", row.without_reference))
            if fit is not None and fit.why
        }
        if reasons:
            yield List(points=tuple(sorted(reasons)))
        yield Figure(
            picture=Picture(lambda: sphere_figure(sensor.clouds)),
            caption="Forces, the ellipsoid through them and the sphere of the weight; dotted: not identifiable.",
            description="Clouds of forces seen along the three axes, with ellipsoids and a circle of the weight.",
        )
    if sensor.judged is not None:
        judged = sensor.judged
        names = short_names([name for name, _ in judged.measured])
        read = [*((names[name], wrench) for name, wrench in judged.measured), ("reference", judged.reference)]
        clouds = [(name, wrench[:, 3:]) for name, wrench in read]
        yield Figure(
            picture=Picture(lambda: force_space_figure({sensor.sensor: clouds}, quantity="moment")),
            caption="Moments on data that was not fitted, and what the model demands.",
            description="Clouds of moments seen along the three axes, measured and expected.",
        )


def _contacts(sensor: Assessment) -> Iterator[Block]:
    if not sensor.contact_forces:
        return
    contacts = table_of(
        sensor.contact_forces,
        "Mean absolute contact wrench of the free sub-model, and mean norm of its force ± half its 95 % interval; it "
        "should be zero",
        leave_out=WORTH,
    )
    yield without_vague(contacts)
    yield mean_contact_table(sensor.contact_forces)
    names = short_names([row.candidate for row in sensor.contact_forces])
    if len(names) > 1:
        yield List(points=tuple(best.sentence for best in sensor.best))


def _torques(sensor: Assessment) -> Iterator[Block]:
    if sensor.joint_torques:
        joints = list(dict.fromkeys(row.joint for row in sensor.joint_torques))
        rows = sorted(sensor.joint_torques, key=lambda row: (joints.index(row.joint), row.offset))
        yield table_of(rows, "Torque of each joint as estimated from the sensor, less that of the rigid-body model")


def _static(sensor: Assessment) -> Iterator[Block]:
    if sensor.static:
        yield tables.static_table(sensor.static)


def _acceptance(sensor: Assessment) -> Iterator[Block]:
    if sensor.criteria:
        names = short_names([criterion.candidate for criterion in sensor.criteria])
        for candidate, name in names.items():
            criteria = [criterion for criterion in sensor.criteria if criterion.candidate == candidate]
            yield criteria_table(criteria, f"Criteria of the acceptance file: {name}")


ERRORS: Final[Question] = ("Errors on data that was not fitted", _errors)
"""The first question."""
QUESTIONS: Final[tuple[Question, ...]] = (
    ("What the recordings taught", learnt_blocks),
    ("Uncertainty", uncertainty_blocks),
    ("Choice of lambda", lambda_blocks),
    ("Excitation", excitation_blocks),
    ("Force and moment space", _space),
    ("Contact force where nothing touches", _contacts),
    ("Joint torques", _torques),
    ("What the sensor can do", _static),
    ("Acceptance", _acceptance),
)
"""The questions after whether it is better than the prior."""
