# SPDX-License-Identifier: BSD-3-Clause
"""What people read of a calibration: matrix, offset, variables, and the information gained per load direction."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Annotated

import numpy as np

from forcetorque.base.errors import FitError
from forcetorque.base.lazy import named
from forcetorque.base.wrench import FORCE_AND_MOMENT, WRENCH_COMPONENTS, WRENCH_UNITS
from forcetorque.experiment.calibration.calibration_file import JOINT, Calibration, SessionOffset
from forcetorque.experiment.calibration.sensor_model import measured_components
from forcetorque.results.number_text import number, with_error
from forcetorque.results.table import COMPONENTS, Row, Shown, Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def calibration_blocks(calibration: Calibration, channels: Sequence[str] = ()) -> Iterator[Table | str]:
    """Show a calibration.

    Args:
        calibration: The calibration.
        channels: Names of its channels; numbers if empty.

    Yields:
        A sentence and tables.
    """
    sensor, source = calibration.sensor, calibration.provenance
    yield (
        f"{sensor.name} ({sensor.serial}): {source.samples} samples of "
        f"{', '.join(interval.label for interval in source.intervals)}, {source.dropped} left out"
        f"{f' ({source.unusable})' if source.unusable else ''}; "
        f"{_estimator_text(calibration)}"
    )
    if calibration.mount is not None:
        yield calibration.mount.text
    yield _matrix_table(calibration, channels)
    if calibration.variables:
        yield _variable_table(calibration)
    if calibration.linearity is not None:
        yield calibration.linearity.message
    if calibration.nonlinear is not None:
        yield from calibration.nonlinear.successes()
    if len(calibration.sessions) > 1:
        yield session_table(calibration)
    if calibration.posterior is None:
        yield _excitation_table(calibration)


def component_records(calibration: Calibration) -> Iterator[dict[str, object]]:
    """Give a calibration as flat lines.

    Yields:
        A line per component, with the numbers in full precision.
    """
    for k, (component, unit) in enumerate(zip(WRENCH_COMPONENTS, WRENCH_UNITS, strict=True)):
        line: dict[str, object] = {
            "sensor": calibration.sensor.name,
            "serial": calibration.sensor.serial,
            "component": component,
            "unit": unit,
        }
        line |= {f"c{j}_per_count": float(value) for j, value in enumerate(calibration.matrix[k])}
        for variable in calibration.variables:
            line[f"{variable.name}_per_{variable.unit}"] = float(variable.coefficients[k])
            line[f"{variable.name}_reference_{variable.unit}"] = variable.reference_value
        line |= {"offset": float(calibration.offset[k]), "residual_rms": float(calibration.residual_rms[k])}
        yield line | {"lambda_counts2": calibration.lambda_counts2, "samples": calibration.provenance.samples}


def _estimator_text(calibration: Calibration) -> str:
    posterior = calibration.posterior
    if posterior is None:
        return f"{calibration.estimation_type}, lambda {_lambda_text(calibration)}"
    if calibration.estimation_type == JOINT:
        return f"joint calibration, repeatability {posterior.repeatability:g}"
    accuracy = posterior.accuracy
    if not accuracy.any():  # of known loads: what they are off by is in the noise
        return f"generative model, repeatability {posterior.repeatability:g}"
    return (
        f"generative model, accuracy of the reference {accuracy[:3].max():.3g} N and {accuracy[3:].max():.3g} N m, "
        f"repeatability {posterior.repeatability:g}"
    )


def _error_words(calibration: Calibration) -> str:
    return "one standard error" if calibration.posterior is not None else "one standard error, by blocks"


def session_table(calibration: Calibration, name: str = "") -> Table:
    """Show the offset of every session, and its drift where it was fitted.

    Args:
        calibration: The calibration.
        name: Name of the calibration, for the caption; left out if empty.

    Returns:
        A row per session, and one per drift.
    """
    start = f"{name}: " if name else ""
    return Table(
        caption=f"{start}offset of every session, ± {_error_words(calibration)}",
        headings=("session", *COMPONENTS),
        rows=tuple(row for session in calibration.sessions for row in _session_rows(session)),
    )


def _session_rows(session: SessionOffset) -> Iterator[tuple[str, ...]]:
    errors = [None] * len(COMPONENTS) if session.standard_error is None else session.standard_error.tolist()
    yield (
        session.name,
        *(with_error(value, error, digits=3) for value, error in zip(session.offset, errors, strict=True)),
    )
    if session.drift_per_s is not None:
        yield f"{session.name}, added per hour", *(number(3600.0 * value, 3) for value in session.drift_per_s)


def _lambda_text(calibration: Calibration) -> str:
    value = calibration.lambda_counts2
    if value is None:
        return "by row"
    text = "infinite: the prior matrix was kept" if math.isinf(value) else f"{value:.4g} counts2"
    return f"{text} ({'given' if calibration.selection.rule == 'given' else 'chosen on held-out blocks'})"


def _matrix_table(calibration: Calibration, channels: Sequence[str]) -> Table:
    names = channels or [f"ch{j}" for j in range(calibration.matrix.shape[1])]
    spread = calibration.offset_standard_error
    return Table(
        caption=f"matrix and offset, ± {_error_words(calibration)}",
        headings=("per 1000 counts", *names, "offset", "±", "residual RMS"),
        rows=tuple(
            (
                component,
                *(f"{1000.0 * value:.4g}" for value in calibration.matrix[k]),
                number(calibration.offset[k], 3),
                number(None if spread is None else spread[k], 3),
                number(calibration.residual_rms[k], 3),
            )
            for k, component in enumerate(COMPONENTS)
        ),
    )


def _variable_table(calibration: Calibration) -> Table:
    lines = []
    for variable in calibration.variables:
        errors = [None] * len(COMPONENTS) if variable.standard_error is None else variable.standard_error.tolist()
        coefficients = zip(variable.coefficients, errors, strict=True)
        lines.append(
            (
                f"{variable.name}, {variable.unit}",
                f"{variable.reference_value:.2f}",
                f"{variable.minimum:.2f} to {variable.maximum:.2f}",
                *(with_error(value, error, digits=4) for value, error in coefficients),
            )
        )
    return Table(
        caption=f"what one unit of a variable adds, ± {_error_words(calibration)}",
        headings=("variable", "from", "fitted range", *COMPONENTS),
        rows=tuple(lines),
    )


def _excitation_table(calibration: Calibration) -> Table:
    """Show each raw direction as the wrench that one standard deviation of it means."""
    validity = calibration.validity
    condition = "infinite" if validity.condition is None else f"{validity.condition:.3g}"
    lines = []
    for direction, variance, explained, excited in zip(
        validity.directions, validity.variance_counts2, validity.explained, validity.excited, strict=True
    ):
        deviation = math.sqrt(variance)
        wrench = calibration.matrix @ direction * deviation
        lines.append(
            (
                "yes" if excited else "NO",
                f"{100 * explained:.0f} %",
                f"{deviation:.1f}",
                *(f"{value:+.3f}" for value in wrench),
            )
        )
    return Table(
        caption=f"motion along each raw direction, one deviation: rank {validity.rank} of {len(validity.explained)}, "
        f"condition {condition}",
        headings=("excited", "explained by loads", "counts", *COMPONENTS),
        rows=tuple(lines),
    )


LITTLE_LEARNT = 0.5
"""Share below which more should be recorded along a direction."""


class InformationGain(Row):
    """One load direction: what a push along it would read wrong, before the recordings and after."""

    direction: Annotated[str, Shown("load")]
    """Component of the load: fx to tz in the sensor's frame."""
    force_error_before_N: Annotated[float, Shown("force before", "N/unit", digits=4)]
    """Predicted standard deviation of the force error that one newton, or newton metre, makes with the prior."""
    force_error_after_N: Annotated[float, Shown("after", "N/unit", digits=4)]
    """The same with the calibration, of its matrix alone: without what the sensor does not repeat, and without the
    cross-talk of loads that it does not measure, which no recording makes narrower."""
    moment_error_before_Nm: Annotated[float, Shown("moment before", "N m/unit", digits=5)]
    """Predicted standard deviation of the moment error that one newton, or newton metre, makes with the prior."""
    moment_error_after_Nm: Annotated[float, Shown("after", "N m/unit", digits=5)]
    """The same with the calibration."""
    uncertainty_reduction: Annotated[float, Shown("narrower by", digits=2)]
    """One less the uncertainty after over that before: 0 where the recordings said nothing, 1 where they said all."""
    measured: bool = True
    """Whether the sensor measures this load; of another the row is about its cross-talk."""


def information_gains(calibration: Calibration) -> tuple[InformationGain, ...] | None:
    """Tell what the recordings taught of every load direction.

    Returns:
        One row per component of the load; None for a type of the thesis, or without a prior.
    """
    posterior = calibration.posterior
    shares = None if posterior is None else posterior.learnt_shares()
    before = None if posterior is None else posterior.prior_error_covariance(np.eye(6))
    if posterior is None or shares is None or before is None:
        return None
    after, measured = posterior.learnt_error_covariance(np.eye(6)), measured_components(calibration.matrix)
    sizes = [
        [np.sqrt(np.trace(covariance[k][part, part])) for part in FORCE_AND_MOMENT]
        for covariance in (before, after)
        for k in range(6)
    ]
    return tuple(
        InformationGain(
            direction=name,
            force_error_before_N=sizes[k][0],
            force_error_after_N=sizes[6 + k][0],
            moment_error_before_Nm=sizes[k][1],
            moment_error_after_Nm=sizes[6 + k][1],
            uncertainty_reduction=float(shares[k]),
            measured=bool(measured[k]),
        )
        for k, name in enumerate(WRENCH_COMPONENTS)
    )


def information_figure(calibrations: Sequence[Calibration]) -> Figure:
    """Draw what `information_gains` gives of every calibration.

    Returns:
        The figure of `learnt_figure`, of those that have any.

    Raises:
        FitError: If none has any.
    """
    learnt = {
        f"{calibration.sensor.name} ({calibration.sensor.serial})": directions
        for calibration in calibrations
        if (directions := information_gains(calibration)) is not None
    }
    if not learnt:
        raise FitError(
            "expected a generative fit towards a prior matrix, which has predicted errors before and after, to draw; "
            "got none"
        )
    figure: Figure = named("forcetorque.calibration.figures.information:learnt_figure")(learnt)
    return figure


def learnt_words(directions: Sequence[InformationGain]) -> str:
    """Say what was learnt, and what to record for the rest.

    Args:
        directions: What the recordings taught.

    Returns:
        Words such as `fz 97 %, tz 4 %: add a load off the axis`.
    """
    own, others = (_shares(row for row in directions if row.measured is measured) for measured in (True, False))
    shares = f"{own}; of the cross-talk of others: {others}" if others else own
    little = [row.direction for row in directions if row.uncertainty_reduction < LITTLE_LEARNT]
    if not little:
        return f"information gained: {shares}"
    return f"information gained: {shares}; for {', '.join(little)} the prior decides: {to_learn(directions)}"


def _shares(rows: Iterable[InformationGain]) -> str:
    return ", ".join(f"{row.direction} {100.0 * row.uncertainty_reduction:.0f} %" for row in rows)


def to_learn(directions: Sequence[InformationGain]) -> str | None:
    """Say what to record for the directions of which little was learnt.

    Args:
        directions: What the recordings taught.

    Returns:
        Words such as `add a load off the axis`; None where enough is known of all.
    """
    little = [row.direction for row in directions if row.uncertainty_reduction < LITTLE_LEARNT]
    advice = []
    if any(name.startswith("t") for name in little):
        advice.append("add a load off the axis, or another tool or posture with its centre of mass elsewhere")
    if any(name.startswith("f") for name in little):
        advice.append("turn the sensor so that the weight acts along it, or add weight")
    return "; ".join(advice) or None
