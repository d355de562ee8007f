# SPDX-License-Identifier: BSD-3-Clause
"""The results of `forcetorque dataset check`, findings and a record for each episode and field, and of `compensate`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import StrEnum
from typing import Annotated, ClassVar, Literal

from pydantic import Field

from forcetorque.payload.identification.load_estimates import BiasRow, Three
from forcetorque.payload.result import LoadRow, load_words
from forcetorque.results.answer import Answer, Concern, typed
from forcetorque.results.number_text import amount
from forcetorque.results.result import DrawnResult
from forcetorque.results.table import Row, Shown, Table, WrenchValues, table_of

_MOST_SHOWN = 40
"""Records of episodes in the table, the worst first; JSON and CSV have all."""
_MOST_RANGES = 6
"""Ranges of episode numbers that a text names."""


class Kind(StrEnum):
    """What a finding is about."""

    DEAD = "dead"
    """One value in all frames of an episode."""
    STUCK = "stuck"
    """One value for longer than noise or motion allow."""
    SATURATED = "saturated"
    """Frames at an end of the range."""
    MISSING = "missing"
    """Frames without a finite value."""
    UNITS = "units"
    """Sizes that no arm measures in the units that they would have."""
    LATE = "late"
    """The force follows another logged signal."""
    TOOL_CHANGE = "tool_change"
    """The weight along gravity changes between episodes."""
    BIASED = "biased"
    """The bias of an episode is not that of the others."""
    DRIFTING = "drifting"
    """Bias or level at rest move over the dataset."""
    NOISY = "noisy"
    """More noise than in other episodes, or along other axes."""


class DatasetFinding(Row):
    """What is wrong with a force field in some episodes."""

    field: Annotated[str, Shown("field")]
    """The field."""
    component: Annotated[str | None, Shown("component")]
    """Its component; None for several or all."""
    kind: Annotated[Kind, Shown("kind")]
    """What it is about."""
    harm: Annotated[bool, Shown("harm")]
    """Whether a policy that is trained on it learns something false; else it is a remark."""
    episodes: tuple[int, ...]
    """Numbers of the episodes."""
    frames: Annotated[int, Shown("frames")]
    """Number of frames that it is counted in; 0 where it is not of single frames."""
    size: float | None
    """Its size, in `unit`; None where it has none."""
    unit: str | None
    """Unit of the size; None where it has none, or the dataset does not name it."""
    message: Annotated[str, Shown("finding")]
    """The finding as text."""

    @property
    def text(self) -> str:
        """Field, finding and episodes in one line."""
        return f"{self.field}: {self.message} ({episodes_text(self.episodes)})"


class EpisodeFieldRow(Row):
    """A force field in one episode."""

    episode: Annotated[int, Shown("episode")]
    """Number of the episode."""
    field: Annotated[str, Shown("field")]
    """The field."""
    frames: Annotated[int, Shown("frames")]
    """Number of its frames."""
    missing: Annotated[int, Shown("missing")]
    """Numbers that are missing."""
    dead: Annotated[tuple[str, ...], Shown("dead")]
    """Components with one value."""
    stuck_frames: Annotated[int, Shown("stuck, frames")]
    """Frames in which a component repeats one value for longer than by chance, over all components."""
    clipped_frames: Annotated[int, Shown("clipped, frames")]
    """Frames in which a component stays at an end of its range that it jumped to, over all components."""
    noise_over_usual: Annotated[float | None, Shown("noise over usual", digits=1)]
    """Noise of the worst component over its median in all episodes; None where too few frames tell."""
    weight: Annotated[float | None, Shown("weight", digits=3, error="weight_error")]
    """Weight along gravity, in the unit of the field; None where it is not separable from the bias, or not logged."""
    weight_error: float | None
    """Its standard error."""

    @property
    def concern(self) -> tuple[int, float]:
        """How much is wrong, for sorting."""
        wrong = self.missing + self.stuck_frames + self.clipped_frames + self.frames * len(self.dead)
        return wrong, self.noise_over_usual or 0.0


_WORDS = {Kind.TOOL_CHANGE: "change of tool", Kind.UNITS: "implausible units"}


class DatasetCheck(DrawnResult):
    """What is wrong with the forces of a dataset."""

    schema_name: Literal["forcetorque/check_dataset/1"] = Field(default="forcetorque/check_dataset/1", alias="schema")
    """Form of the result."""
    source: str
    """Folder of the dataset."""
    version: str
    """Version of its layout."""
    fps: float
    """Frames per second."""
    episodes: int
    """Number of episodes."""
    frames: int
    """Number of frames."""
    fields: tuple[str, ...]
    """Fields that were examined."""
    findings: tuple[DatasetFinding, ...]
    """Findings, harm first."""
    not_checked: tuple[str, ...]
    """What was not examined, and what it needs."""
    records_of_episodes: tuple[EpisodeFieldRow, ...]
    """A record for each episode and field."""

    drawn_by: ClassVar[str] = "forcetorque.dataset.figures:episodes_figure"

    @property
    def passed(self) -> bool:
        """Whether no finding is one of harm."""
        return not any(finding.harm for finding in self.findings)

    def answers(self) -> Iterator[Answer]:
        """Give the answer of a check.

        Yields:
            One answer, with the worst findings first.
        """
        harm = [finding for finding in self.findings if finding.harm]
        remarks = [finding for finding in self.findings if not finding.harm]
        kinds = list(dict.fromkeys(_WORDS.get(finding.kind, finding.kind.value) for finding in harm))
        harmless = f"NO HARM, {len(remarks)} remark(s)" if remarks else "NO HARM FOUND"
        shown = [finding.text for finding in (harm or remarks)[:2]]
        rest = len(self.findings) - len(shown)
        if rest > 0:
            shown[-1] += f"; {rest} more finding(s)"
        lacking = (f"not checked: {self.not_checked[0]}",) if self.not_checked else ()
        named = sorted({number for finding in harm for number in finding.episodes})
        some = bool(named) and len(named) < self.episodes
        step = "leave out or repair these episodes; see them all with --details" if some else ""
        if harm and not some:
            step = "repair the log of the field, or do not train on it; see all findings with --details"
        yield Answer(
            subject=f"{self.source}: {self.episodes} episodes, {self.frames} frames of {', '.join(self.fields)}",
            verdict=f"HARM: {', '.join(kinds)}" if harm else harmless,
            why=(*shown, *lacking)[:3],
            step=step,
            concern=Concern.BAD if harm else Concern.UNCERTAIN if self.findings else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Give findings, then records of episodes.

        Yields:
            Tables and messages.
        """
        if self.findings:
            table = table_of(self.findings, f"{self.source}: findings")
            where = [episodes_text(finding.episodes) for finding in self.findings]
            rows = tuple((*row[:-1], text, row[-1]) for row, text in zip(table.rows, where, strict=True))
            headings = (*table.headings[:-1], "episodes", table.headings[-1])
            yield Table(caption=table.caption, headings=headings, rows=rows)
        worst = sorted(self.records_of_episodes, key=lambda row: row.concern, reverse=True)[:_MOST_SHOWN]
        if worst:
            shown = sorted(worst, key=lambda row: (row.episode, row.field))
            rest = len(self.records_of_episodes) - len(shown)
            of_all = f", the {len(shown)} worst of {rest + len(shown)}" if rest else ""
            yield table_of(shown, f"{self.source}: episodes{of_all}")
        yield from (f"not checked: {text}" for text in self.not_checked)

    def records(self) -> list[dict[str, object]]:
        """Make flat records, for CSV.

        Returns:
            A record per finding.
        """
        named = [(row, episodes_text(row.episodes)) for row in self.findings]
        return [row.model_copy(update={"episodes": ()}).flat() | {"episodes": text} for row, text in named]

    def columns(self) -> list[str]:
        """Name the columns of the CSV.

        Returns:
            Keys of a finding.
        """
        return list(DatasetFinding.model_fields)


def episodes_text(numbers: Sequence[int]) -> str:
    """Name episodes.

    Args:
        numbers: Their numbers, rising.

    Returns:
        Such as `episode 3` or `episodes 0-4, 7`, of many ranges the first.
    """
    ranges: list[list[int]] = []
    for number in numbers:
        if ranges and number == ranges[-1][1] + 1:
            ranges[-1][1] = number
        else:
            ranges.append([number, number])
    shown = [str(first) if first == last else f"{first}-{last}" for first, last in ranges[:_MOST_RANGES]]
    rest = sum(last - first + 1 for first, last in ranges[_MOST_RANGES:])
    more = f" and {rest} more" if rest else ""
    return f"episode{'s' if len(numbers) > 1 else ''} {', '.join(shown)}{more}"


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

    drawn_by: ClassVar[str] = "forcetorque.payload.figures:load_figure"
    drawn_fields: ClassVar[tuple[str, ...]] = ("loads",)
    outlives_figure = True

    def answers(self) -> Iterator[Answer]:
        """Give the answer of a compensation.

        Yields:
            One answer: what was added, what was taken off, and what that assumed.
        """
        origin = "identified from the dataset" if self.load_from == "dataset" else "as `payload` identified it"
        deviation = self.mean_standard_deviation
        sizes = f"{amount(float(max(deviation[:3])), 'N')}, {amount(float(max(deviation[3:])), 'N m')}"
        touched = f"{100 * self.contact_share:.0f} % of {self.windows} windows disagree, as contacts do, and count less"
        of = "each episode" if self.bias_of == "episode" else "all episodes"
        doubtful = self.contradicted or self.contact_share > _CONTACTS or bool(self.left_out_frames)
        stuck = (
            f"; {self.left_out_frames} frames of stuck components were not fitted, but are written"
            if self.left_out_frames
            else ""
        )
        yield Answer(
            subject=f"{self.output}: {self.episodes} episodes, {self.frames} frames",
            verdict=f"{self.feature} ADDED",
            why=(
                f"taken off: {load_words(self.loads[0])}, {origin}; one bias for {of}",
                f"in the frame {self.frame!r}, {self.measure_direction}; standard deviation of a frame up to {sizes}, "
                f"in {self.standard_deviation_feature}",
                f"{touched}{stuck}",
            ),
            step="check the copy before a policy is trained on it",
            command=typed("dataset", "check", self.output),
            concern=Concern.BAD if self.contradicted else Concern.UNCERTAIN if doubtful else Concern.NONE,
        )

    def blocks(self) -> Iterator[Table | str]:
        """Give the load and the biases.

        Yields:
            Tables.
        """
        yield table_of(self.loads, f"{self.source}: tool")
        yield table_of(self.sessions, f"{self.source}: bias, N, N m")
