# SPDX-License-Identifier: BSD-3-Clause
"""The result of `forcetorque dataset compensate`: the tool that was taken off, and the features that were added."""

from __future__ import annotations

from collections.abc import Iterator
from typing import ClassVar, Literal

from pydantic import Field

from forcetorque.payload.identification.load_estimates import BiasRow, Three
from forcetorque.payload.result import LoadRow, load_words
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.number_text import amount
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Table, WrenchValues, table_of

_CONTACTS = 0.2
"""Share of windows that disagree with the tool from which on the identification is doubtful (heuristic)."""


class CompensatedDataset(DrawnResult):
    """A dataset with the wrench that the tool's weight and bias were taken off."""

    schema_name: Literal["forcetorque/compensate_dataset/1"] = Field(
        default="forcetorque/compensate_dataset/1", alias="schema"
    )
    """Form of the result."""
    source: str
    """Folder of the dataset."""
    output: str
    """Folder of the copy."""
    version: str
    """Version of the layout of both."""
    episodes: int
    """Number of episodes."""
    frames: int
    """Number of frames."""
    measured: str
    """Field that was measured."""
    orientation: str
    """Feature with the orientation."""
    feature: str
    """Feature that was added: the wrench in N and N m, in the direction of the measurement."""
    standard_deviation_feature: str
    """Feature that was added: standard deviation of each component, noise of a frame included."""
    frame: str
    """`sensor`, `world` (its axes, about the sensor's origin) or `pose`, the frame that was given."""
    measure_direction: str
    """Who acts on whom in measurement and result; the tool is the child."""
    calibrated_by: str | None
    """Serial number of the sensor whose calibration was applied; None for none."""
    loads: tuple[LoadRow, ...]
    """The tool, in the frame of the sensor."""
    load_from: Literal["dataset", "result"]
    """Whether it was identified from the dataset, or given as a result of `forcetorque payload`."""
    sessions: tuple[BiasRow, ...]
    """The bias; of some episodes where every one has its own."""
    bias_of: Literal["dataset", "episode"]
    """Whether one bias was taken off all episodes, or one of each."""
    mount_rad: Three | None
    """Rotation vector of `sensor_R_motion`; rad; None where it was not asked for."""
    windows: int
    """Number of means that were fitted."""
    contact_share: float
    """Share of them that disagree with weight and bias, as contacts do."""
    left_out_frames: int
    """Frames that are stuck or lack a value, which were not fitted."""
    residual_rms: WrenchValues
    """Root mean square residual of the means; N, N m."""
    noise: WrenchValues
    """Standard deviation of the noise of a frame; N, N m."""
    mean_standard_deviation: WrenchValues
    """Mean of the second feature; N, N m, in the frame of the result."""
    contradicted: bool
    """Whether another account of axes, signs or units explains the dataset clearly better."""
    resumed_files: int
    """Files of frames that an earlier run had written."""

    answered_by: ClassVar[str | None] = "forcetorque.dataset.compensation_result:compensation_answer"

    drawn_by: ClassVar[str] = "forcetorque.payload.figure:load_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("loads",)
    outlives_figure = True

    def blocks(self) -> Iterator[Table | str]:
        """Give the load and the biases.

        Yields:
            Tables.
        """
        yield table_of(self.loads, f"{self.source}: tool")
        yield table_of(self.sessions, f"{self.source}: bias, N, N m")


def compensation_answer(result: CompensatedDataset) -> Answer:
    """Give the answer of a compensation.

    Args:
        result: The result.

    Returns:
        What was added, what was taken off, and what that assumed.
    """
    origin = "identified from the dataset" if result.load_from == "dataset" else "as `payload` identified it"
    deviation = result.mean_standard_deviation
    sizes = f"{amount(float(max(deviation[:3])), 'N')}, {amount(float(max(deviation[3:])), 'N m')}"
    touched = f"{100 * result.contact_share:.0f} % of {result.windows} windows disagree, as contacts do, and count less"
    of = "each episode" if result.bias_of == "episode" else "all episodes"
    doubtful = result.contradicted or result.contact_share > _CONTACTS or bool(result.left_out_frames)
    stuck = (
        f"; {result.left_out_frames} frames of stuck components were not fitted, but are written"
        if result.left_out_frames
        else ""
    )
    return Answer(
        subject=f"{result.output}: {result.episodes} episodes, {result.frames} frames",
        verdict=f"{result.feature} ADDED",
        why=(
            f"taken off: {load_words(result.loads[0])}, {origin}; one bias for {of}",
            f"in the frame {result.frame!r}, {result.measure_direction}; standard deviation of a frame up to {sizes}, "
            f"in {result.standard_deviation_feature}",
            f"{touched}{stuck}",
        ),
        step="check the copy before a policy is trained on it",
        command=typed("dataset", "check", result.output),
        concern=Concern.BAD if result.contradicted else Concern.UNCERTAIN if doubtful else Concern.NONE,
    )
