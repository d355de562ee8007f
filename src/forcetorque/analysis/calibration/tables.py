# SPDX-License-Identifier: BSD-3-Clause
"""What people read of a calibration: matrix and offset, variables, and how the fitted loads moved the readings."""

from __future__ import annotations

import math
from collections.abc import Iterator

from forcetorque.calibration import JOINT, Calibration, SessionOffset
from forcetorque.result import COMPONENTS, Table, number, with_error
from forcetorque.spatial import WRENCH_COMPONENTS, WRENCH_UNITS


def calibration_blocks(calibration: Calibration) -> Iterator[Table | str]:
    """Show a calibration.

    Args:
        calibration: The calibration.

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
    yield _matrix_table(calibration)
    if calibration.variables:
        yield _variable_table(calibration)
    if calibration.nonlinear is not None:
        yield from calibration.nonlinear.successes()
    if len(calibration.sessions) > 1:
        yield session_table(calibration)
    if calibration.posterior is None:
        yield _excitation_table(calibration)


def component_records(calibration: Calibration) -> Iterator[dict[str, object]]:
    """Give a calibration as flat lines.

    Args:
        calibration: The calibration.

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


def _matrix_table(calibration: Calibration) -> Table:
    channels = (f"ch{j}" for j in range(calibration.matrix.shape[1]))
    spread = calibration.offset_standard_error
    return Table(
        caption=f"matrix and offset, ± {_error_words(calibration)}",
        headings=("per 1000 counts", *channels, "offset", "±", "residual RMS"),
        rows=tuple(
            (
                component,
                *(number(1000.0 * value, 3) for value in calibration.matrix[k]),
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
