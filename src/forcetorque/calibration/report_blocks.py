# SPDX-License-Identifier: BSD-3-Clause
"""Blocks of a report about its calibrations: how each was chosen, what its data could tell, and how sure it is."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from forcetorque.calibration.summary import learnt_words, session_table
from forcetorque.experiment.calibration.calibration_file import Calibration
from forcetorque.experiment.calibration.posterior import Posterior
from forcetorque.report import record_tables as tables
from forcetorque.report.sensor_assessment import Assessment
from forcetorque.results.document.content import Block, Figure, Picture, Text
from forcetorque.results.table import short_names


def origin_words(name: str, calibration: Calibration) -> str:
    """Say where a calibration comes from.

    Returns:
        When and by what it was made, from which data and which prior.
    """
    origin, prior = calibration.provenance, calibration.prior
    return (
        f"{name}: made {origin.created} by forcetorque {origin.code_version} from {origin.experiment}, "
        f"{origin.samples} samples of {', '.join(repr(interval.label) for interval in origin.intervals)}; "
        f"prior: {prior.source if prior else 'none'}"
    )


def learnt_blocks(sensor: Assessment) -> Iterator[Block]:
    """Show what generative fits learnt, under which assumptions, and what they found of noise and offsets.

    Args:
        sensor: Everything about the sensor.

    Yields:
        Sentences, a figure and tables; nothing for types of the thesis.
    """
    from forcetorque.calibration.figures.information import learnt_figure

    names = short_names(list(sensor.calibrations))
    for file, rows in sensor.information_gain.items():
        yield Text(text=f"{names[file]}: {learnt_words(rows)}.")
    if sensor.information_gain:
        yield Figure(
            picture=Picture(
                lambda: learnt_figure({names[file]: rows for file, rows in sensor.information_gain.items()})
            ),
            caption="Information gained: by how much the uncertainty of a load along each direction became "
            "narrower, and the error that it makes, one standard deviation, before and after. Before is the prior, "
            "after holds what the sensor does not repeat too.",
            description="Per load direction the share that was learnt, and predicted force and moment errors.",
        )
    for file, calibration in sensor.calibrations.items():
        if calibration.posterior is not None:
            yield from _assumed(names[file], calibration, calibration.posterior)


def _assumed(name: str, calibration: Calibration, posterior: Posterior) -> Iterator[Block]:
    accuracy = posterior.accuracy
    alone = "" if posterior.prior_covariance is not None else "; without a prior there is nothing to be narrower than"
    yield Text(
        text=f"{name}: the reference was taken as accurate to {accuracy[:3].max():.3g} N and "
        f"{accuracy[3:].max():.3g} N m, the sensor as repeating itself to {100.0 * posterior.repeatability:.2g} % of "
        f"its response{alone}."
    )
    yield tables.noise_table(name, posterior)
    if calibration.sessions:
        yield session_table(calibration, name)


def lambda_blocks(sensor: Assessment) -> Iterator[Block]:
    """Show how lambda came about.

    Args:
        sensor: Everything about the sensor.

    Yields:
        Sentences and a figure; nothing for the generative model, which has no lambda.
    """
    from forcetorque.calibration.figures.lambda_curves import held_out_figure

    chosen = _of_thesis(sensor)
    curves, ratios = {}, {}
    for name, calibration in chosen.items():
        selection = calibration.selection
        yield Text(text=f"{name}: {_lambda_words(calibration.lambda_counts2)}; {selection.rule}.")
        if selection.lambda_counts2:
            tried = np.array(selection.lambda_counts2)
            curves[name] = (tried, np.array(selection.held_out_rmse), calibration.lambda_counts2)
            ratios[name] = np.array(selection.worst_ratio_to_prior)
    if curves:
        yield Figure(
            picture=Picture(lambda: held_out_figure(curves, worst_ratios=ratios)),
            caption="Error on held-out blocks over lambda; the chosen one is marked.",
            description="Curve of the held-out error over lambda for every calibration.",
        )


def _lambda_words(value: float | None) -> str:
    if value is None:
        return "every row has its own lambda"
    return "lambda infinite, the prior matrix" if math.isinf(value) else f"lambda {value:.4g} counts²"


def excitation_blocks(sensor: Assessment) -> Iterator[Block]:
    """Show how the fitted loads moved the raw directions.

    Args:
        sensor: Everything about the sensor.

    Yields:
        A figure; nothing for the generative model, which says what it learnt of loads instead.
    """
    from forcetorque.calibration.figures.excitation import excitation_figure

    chosen = _of_thesis(sensor)
    if chosen:
        yield Figure(
            picture=Picture(lambda: excitation_figure({name: one.validity for name, one in chosen.items()})),
            caption="How far the loads moved each direction of the raw readings while fitting, and how much of that "
            "motion they explain.",
            description="Bars of the deviation and explained share per raw direction, and what each is made of.",
        )


def uncertainty_blocks(sensor: Assessment) -> Iterator[Block]:
    """Show every matrix with its standard errors.

    Args:
        sensor: Everything about the sensor.

    Yields:
        A table per calibration.
    """
    names = short_names(list(sensor.calibrations))
    for file, calibration in sensor.calibrations.items():
        yield tables.matrix_table(names[file], calibration)


def _of_thesis(sensor: Assessment) -> dict[str, Calibration]:
    """Calibrations of the thesis' types by their short names."""
    names = short_names(list(sensor.calibrations))
    return {names[file]: one for file, one in sensor.calibrations.items() if one.posterior is None}
