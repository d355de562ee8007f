# SPDX-License-Identifier: BSD-3-Clause
"""The form of everything in a file of ours that holds a calibration."""

from __future__ import annotations

from pydantic import BaseModel, ConfigDict


class Part(BaseModel):
    """A frozen table of a file; unknown keys are errors."""

    model_config = ConfigDict(defer_build=True, extra="forbid", frozen=True, arbitrary_types_allowed=True)
