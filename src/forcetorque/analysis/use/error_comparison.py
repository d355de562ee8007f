# SPDX-License-Identifier: BSD-3-Clause
"""What a test of two candidates on the same samples says, as a row, and in the one form of words that all share."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from forcetorque.evaluation import ErrorRatio, Judgement, Offset
from forcetorque.result import Row, Shown, finite_or_none

Quantity = Literal["force", "moment"]

OFFSET_WORDS = {
    Offset.FITTED: "its own offset",
    Offset.FIRST_SECOND: "the offset of the first second",
    Offset.JUDGED_MEAN: "the mean of the judged samples taken off",
    Offset.NONE: "no offset removed",
}
"""The offsets in sentences."""

_WIDEST = 10.0
"""Upper over lower end of an interval beyond which it is said in words."""


class ErrorComparison(Row):
    """Errors of a candidate over those of another on the same samples, as norms."""

    candidate: Annotated[str, Shown("candidate", file=True)]
    """The calibration file, or the prior."""
    offset: Annotated[Offset, Shown("offset")]
    """Which offset they are judged with."""
    quantity: Annotated[Quantity, Shown("error of")]
    """What the errors are of."""
    unit: Annotated[Literal["N", "N m"], Shown("unit")]
    """Unit of the errors."""
    samples: int
    """Number of judged samples."""
    mean: Annotated[float, Shown("mean", digits=3)]
    """Mean norm of the error with the candidate."""
    ratio: Annotated[float, Shown("ratio", digits=2)]
    """Root mean square error of the candidate over that of the other, geometric mean over the stretches."""
    ratio_low: Annotated[float | None, Shown("at least", digits=2)]
    """Lower end of its 95 % interval; none where too few stretches do not give one."""
    ratio_high: Annotated[float | None, Shown("at most", digits=2)]
    """Upper end."""
    stretches: Annotated[int, Shown("stretches")]
    """Independent stretches of time that the interval comes from."""
    judgement: Annotated[Judgement, Shown("judgement")]
    """What the interval says of the candidate."""

    def against(self, other_mean: float, other: str) -> str:
        """Say what the test says.

        Args:
            other_mean: Mean norm of the error with the other; N or N m.
            other: The other, in words.

        Returns:
            Both means, the judgement, and its interval where it says something.
        """
        digits = 2 if self.quantity == "force" else 3
        means = f"{self.mean:.{digits}f} {self.unit} against {other_mean:.{digits}f} {self.unit} with {other}"
        return f"{means} ({self.judgement}: {self._interval()})"

    def _interval(self) -> str:
        stretches = f"{self.stretches} stretch{'' if self.stretches == 1 else 'es'}"
        if self.ratio_low == self.ratio_high == 1.0:
            return "the same in every sample"
        if self.ratio_low is None or self.ratio_high is None:
            return f"the errors repeat themselves, and are worth {stretches} only"
        if self.judgement == "not told apart" and self.ratio_high > _WIDEST * self.ratio_low:
            return f"{stretches} are too few, or too unlike"
        return f"{self.ratio:.2f} of it, {self.ratio_low:.2f} to {self.ratio_high:.2f} over {stretches}"


def ratio_fields(ratio: ErrorRatio) -> dict[str, Any]:
    """Give a ratio as fields of a row.

    Args:
        ratio: The ratio.

    Returns:
        Fields of `ErrorComparison`.
    """
    known = finite_or_none(ratio.high) is not None
    return {
        "ratio": ratio.ratio,
        "ratio_low": ratio.low if known else None,
        "ratio_high": ratio.high if known else None,
        "stretches": ratio.stretches,
        "judgement": ratio.judgement,
    }
