# SPDX-License-Identifier: BSD-3-Clause
"""Samples that a result leaves out because they say nothing of the load."""

from __future__ import annotations

from typing import Annotated

from forcetorque.results.row import Row, Shown


class UnusableSamples(Row):
    """What is left out of one interval of one sensor."""

    sensor: Annotated[str, Shown("sensor")]
    """Sensor."""
    recording: Annotated[str, Shown("recording")]
    """Name of the experiment."""
    interval: Annotated[str, Shown("interval")]
    """Label of the interval."""
    use: Annotated[str, Shown("use")]
    """Use of the interval."""
    samples: Annotated[int, Shown("of samples")]
    """Number of its samples."""
    frozen: Annotated[int, Shown("frozen")]
    """Samples in which all channels repeat one reading although the log is noisy, or the expected wrench moves."""
    saturated: Annotated[int, Shown("saturated")]
    """Samples at the limit of the converter, or held by a board that says so."""
    repeated: Annotated[int, Shown("stamp repeated")]
    """Messages whose stamp does not step forward."""
