# SPDX-License-Identifier: BSD-3-Clause
"""Examine the forces of a dataset, episode by episode and over all of them; the check as one HTML page."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import accept_input
from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.progress import Progress, TimeLeft
from forcetorque.dataset.checks_over_episodes import set_findings, usual_noise
from forcetorque.dataset.episode_checks import EpisodeField, examined
from forcetorque.dataset.episode_frames import episode_frames
from forcetorque.dataset.force_fields import (
    ForceField,
    OrientationField,
    force_fields,
    orientation_candidates,
    orientation_field,
)
from forcetorque.dataset.result import DatasetCheck, DatasetFinding, EpisodeFieldRow
from forcetorque.formats.lerobot.dataset import LeRobotDataset, read_dataset
from forcetorque.recording.orientation import OrientationForm, OrientationSense
from forcetorque.results.answer import Concern
from forcetorque.results.document.content import Document, List, Section, Text, Tone, Verdict, html_bytes
from forcetorque.results.result import created_now
from forcetorque.results.table import Table


def checked(
    folder: Path,
    *,
    features: Sequence[str] = (),
    orientation: str | None = None,
    sense: OrientationSense | str | None = None,
    form: OrientationForm | str | None = None,
    mass_kg: float | None = None,
    progress: Progress = lambda _: None,
) -> DatasetCheck:
    """Examine the forces of a dataset.

    Args:
        folder: Folder of the dataset.
        features: Features to examine in place of those whose names say that they are forces.
        orientation: Feature with the orientation of the sensor.
        sense: What its rotation does; without, nothing is held against gravity.
        form: How it is written; by the names of its elements if None.
        mass_kg: Known mass of the tool; kg.
        progress: Called with lines for people.

    Returns:
        Findings and records.

    Raises:
        FormatError: If the dataset is damaged, or has no force.
    """
    accept_input(folder)
    dataset = read_dataset(folder)
    fields = force_fields(dataset, features)
    turned, not_checked = _orientation(dataset, fields, orientation, sense, form)
    labels = tuple(
        dict.fromkeys((*(one for field in fields for one in field.labels), *(turned.labels if turned else ())))
    )
    found: dict[str, list[EpisodeField]] = {field.name: [] for field in fields}
    frames, total = 0, sum(episode.frames for episode in dataset.episodes)
    left = TimeLeft(progress, "examining episodes", total)
    for episode, values in episode_frames(dataset, labels):
        gravity, reason = _gravity(turned, values, labels, f"{episode.file}: episode {episode.index}")
        if reason and reason not in not_checked:
            not_checked.append(reason)
        for field in fields:
            own = values[:, [labels.index(label) for label in field.labels]]
            entry = examined(episode.index, own, dataset.fps, is_wrench=field.is_wrench, gravity=gravity)
            found[field.name].append(entry)
        frames += len(values)
        left.at(frames)
    findings: list[DatasetFinding] = []
    rows: list[EpisodeFieldRow] = []
    for field in fields:
        episodes = sorted(found[field.name], key=lambda one: one.episode)
        if not episodes:
            continue
        name = None if turned is None else turned.name
        findings += set_findings(field, episodes, orientation=name, rate_hz=dataset.fps, mass_kg=mass_kg)
        rows += _rows(field, episodes)
    return DatasetCheck(
        source=str(folder),
        version=dataset.version,
        fps=dataset.fps,
        episodes=len(dataset.episodes),
        frames=frames,
        fields=tuple(field.name for field in fields),
        findings=tuple(sorted(findings, key=lambda finding: not finding.harm)),
        not_checked=tuple(not_checked),
        records_of_episodes=tuple(sorted(rows, key=lambda row: (row.episode, row.field))),
    )


def _orientation(
    dataset: LeRobotDataset,
    fields: Sequence[ForceField],
    name: str | None,
    sense: OrientationSense | str | None,
    form: OrientationForm | str | None,
) -> tuple[OrientationField | None, list[str]]:
    """The orientation, and what cannot be examined without one."""
    if name is not None or sense is not None:
        return orientation_field(dataset, name, sense, form), []
    if not any(field.is_wrench for field in fields):
        return None, []
    known = orientation_candidates(dataset)
    what = "weight, bias and delay against gravity"
    if known:
        name = next(iter(known))
        text = f"{what}: {name} may be the sensor's orientation; add --sense sensor_to_world or world_to_sensor"
    else:
        text = f"{what}: no feature is named as an orientation; name one with --orientation, --form and --sense"
    return None, [text]


def _gravity(
    turned: OrientationField | None, values: FloatArray, labels: tuple[str, ...], place: str
) -> tuple[FloatArray | None, str]:
    """Gravity in the sensor, or why there is none in an episode."""
    if turned is None:
        return None, ""
    own = values[:, [labels.index(label) for label in turned.labels]]
    try:
        return turned.turned(own, place)[1], ""
    except FormatError as error:
        return None, f"weight and bias of an episode: {error}"


def _rows(field: ForceField, episodes: Sequence[EpisodeField]) -> list[EpisodeFieldRow]:
    usual = usual_noise(episodes)
    rows = []
    for one in episodes:
        ratio = one.noise / usual
        rows.append(
            EpisodeFieldRow(
                episode=one.episode,
                field=field.name,
                frames=one.frames,
                missing=int(one.missing.sum()),
                dead=tuple(
                    name for name, value in zip(field.components, one.constant, strict=True) if not np.isnan(value)
                ),
                stuck_frames=sum(run.frames for run in one.runs),
                clipped_frames=int(one.clipped.sum()),
                noise_over_usual=float(np.nanmax(ratio)) if np.isfinite(ratio).any() else None,
                weight=None if one.weight is None else one.weight.weight,
                weight_error=None if one.weight is None else one.weight.error,
            )
        )
    return rows


_TONES = {Concern.NONE: Tone.GOOD, Concern.UNCERTAIN: Tone.CAUTION, Concern.BAD: Tone.BAD}


def write_page(check: DatasetCheck, path: Path) -> None:
    """Write a check for a browser.

    Args:
        check: The check.
        path: HTML file to write or to replace.

    Raises:
        MissingExtraError: If the extra `report` is not installed.
    """
    (answer,) = check.answers()
    blocks = [block if isinstance(block, Table) else Text(text=block) for block in check.blocks()]
    summary = Section(
        title="Result",
        blocks=(Verdict(tone=_TONES[answer.concern], text=answer.verdict), List(points=answer.why)),
    )
    document = Document(
        title="Forces of a dataset",
        subtitle=answer.subject,
        created=created_now(),
        sections=(summary, Section(title="Findings and episodes", blocks=tuple(blocks))),
    )
    write_bytes_atomically(path, html_bytes(document))
