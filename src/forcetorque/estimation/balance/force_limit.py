# SPDX-License-Identifier: BSD-3-Clause
"""A force as people state it: newtons, or a share of the body weight."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import Self

from forcetorque.errors import EstimationError

_FORM = re.compile(r"\s*([0-9.eE+-]+)\s*(N|%)\s*")
_PERCENT = 100.0


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceLimit:
    """A force, or a share of the body weight; exactly one of both."""

    force_N: float | None = None
    """The force; N."""
    share: float | None = None
    """The share of the body weight."""

    def __post_init__(self) -> None:
        stated = [value for value in (self.force_N, self.share) if value is not None]
        if len(stated) != 1 or not 0.0 < stated[0] < float("inf"):
            raise EstimationError(
                f"force: expected a positive force in N or a positive share of the body weight, got {self.force_N} N "
                f"and {self.share}"
            )

    @classmethod
    def of(cls, text: str) -> Self:
        """Understand `50N` or `15%`.

        Args:
            text: A number with its unit.

        Returns:
            The force.

        Raises:
            EstimationError: If it is not of that form.
        """
        match = _FORM.fullmatch(text)
        try:
            number = float(match[1]) if match else None
        except ValueError:
            number = None
        if match is None or number is None:
            raise EstimationError(
                f"force: expected newtons such as 50N, or a share of body weight as 15%, got {text!r}"
            )
        return cls(force_N=number) if match[2] == "N" else cls(share=number / _PERCENT)

    def newtons(self, weight_N: float | None) -> float:
        """Give the force.

        Args:
            weight_N: Weight of the robot; None where nobody knows it; N.

        Returns:
            The force; N.

        Raises:
            EstimationError: If it is a share of a weight that nobody knows.
        """
        if self.force_N is not None:
            return self.force_N
        if weight_N is None:
            raise EstimationError(
                f"force: expected newtons, got {self} of a body weight that nobody knows; name the robot in [robot], "
                "or state thresholds such as 50N"
            )
        return (self.share or 0.0) * weight_N

    def __str__(self) -> str:
        return f"{self.force_N:g}N" if self.share is None else f"{_PERCENT * self.share:g}%"
