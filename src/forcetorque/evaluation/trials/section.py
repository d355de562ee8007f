# SPDX-License-Identifier: BSD-3-Clause
"""The `[trial]` section of an experiment file: condition and number of the recording among others of the sensor."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from forcetorque.base.toml_file import Table, Text
from forcetorque.experiment.section import Loading, Section


class Trial(Table):
    """What the recording is to a comparison with others of the same sensor."""

    condition: Text | None = None
    """What was done to the sensor, in any words, such as the torque of its screws."""
    number: Annotated[int, Field(ge=1, strict=True)] | None = None
    """Which trial of its condition it is, from 1; by the order of the files if left out."""


def _as_stated(table: Trial, loading: Loading) -> Trial:
    return table


TRIAL: Section[Trial, Trial] = Section(
    key="trial",
    type=Trial,
    default=Trial(),
    description="Condition and number, for `forcetorque compare`.",
    read=_as_stated,
    empty=Trial(),
    of_robot=False,
)
