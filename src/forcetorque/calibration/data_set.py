# SPDX-License-Identifier: BSD-3-Clause
"""Data to fit: raw readings, reference wrenches and linear variables at the same instants."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from forcetorque.arrays import BoolArray, FloatArray, read_only


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class DataSet:
    """Readings and reference of one stretch of time."""

    label: str
    """Label of the interval."""
    raw: FloatArray
    """Raw readings in the order of time; shape (n, c); counts."""
    reference: FloatArray
    """Reference wrenches; shape (n, 6); N, N m."""
    variables: Any = None
    """Linear variables; shape (n, v), an array also where None was given: v is then 0."""
    time_s: Any = None
    """Instants on the clock of the recording; shape (n,); s; None where they are not known."""
    flattening: Any = None
    """What a derivative window of twice the length takes from the reference; shape (n, 6); N, N m; None for nothing."""
    session: str = ""
    """Power-up: data sets of one session share an offset."""
    recording: str = ""
    """Recording whose clock and slow noise it shares with others."""

    def __post_init__(self) -> None:
        raw = read_only(self.raw, name="raw", shape=(None, None))
        variables = np.empty((len(raw), 0)) if self.variables is None else self.variables
        object.__setattr__(self, "raw", raw)
        object.__setattr__(self, "reference", read_only(self.reference, name="reference", shape=(len(raw), 6)))
        object.__setattr__(self, "variables", read_only(variables, name="variables", shape=(len(raw), None)))
        for field, shape in (("time_s", (len(raw),)), ("flattening", (len(raw), 6))):
            if getattr(self, field) is not None:
                object.__setattr__(self, field, read_only(getattr(self, field), name=field, shape=shape))

    def kept(self, marks: BoolArray) -> DataSet:
        """Keep some of the samples.

        Args:
            marks: Which; shape (n,).

        Returns:
            The others left out.
        """
        return replace(
            self,
            raw=self.raw[marks],
            reference=self.reference[marks],
            variables=self.variables[marks],
            time_s=None if self.time_s is None else self.time_s[marks],
            flattening=None if self.flattening is None else self.flattening[marks],
        )
