# SPDX-License-Identifier: BSD-3-Clause
"""Frames of a dataset, one episode after the other, with one file's open episodes in memory at a time."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError
from forcetorque.formats.lerobot.dataset import Episode, LeRobotDataset, frame_batches
from forcetorque.formats.lerobot.log_format import frame_numbers


def episode_frames(dataset: LeRobotDataset, labels: tuple[str, ...]) -> Iterator[tuple[Episode, FloatArray]]:
    """Give the frames of all episodes.

    Args:
        dataset: The dataset.
        labels: Elements that are read.

    Yields:
        An episode and its frames; shape (n, k); NaN where a number is missing.

    Raises:
        FormatError: If a file is damaged, or has other frames than the list of episodes.
    """
    for file, episodes in dataset.files():
        yield from file_frames(dataset, file, episodes, labels)


def file_frames(
    dataset: LeRobotDataset, file: Path, episodes: tuple[Episode, ...], labels: tuple[str, ...]
) -> Iterator[tuple[Episode, FloatArray]]:
    """Give the frames of the episodes of one file; as `episode_frames`.

    Args:
        dataset: The dataset.
        file: One of its files.
        episodes: The episodes of the file.
        labels: Elements that are read.

    Yields:
        An episode and its frames; shape (n, k); NaN where a number is missing.

    Raises:
        FormatError: If the file is damaged, or has other frames than the list of episodes.
    """
    open_episodes = EpisodeBlocks(file, episodes)
    for numbers, batch in frame_batches(dataset, file, labels):
        columns = [frame_numbers(batch.column(k)) for k in range(1, 1 + len(labels))]
        yield from open_episodes.add(whole_numbers(numbers), np.stack(columns, axis=1))
    open_episodes.require_complete()


def whole_numbers(column: Any) -> IntArray:
    """Give the numbers of episodes of frames.

    Args:
        column: Column of Arrow.

    Returns:
        The numbers, -1 where there is none; shape (n,).
    """
    numbers = frame_numbers(column)
    return np.where(np.isfinite(numbers) & (np.abs(numbers) < 1 << 40), numbers, -1.0).astype(np.int64)


class EpisodeBlocks:
    """Collects the frames of the episodes of one file, and gives each episode when it is complete."""

    def __init__(self, file: Path, episodes: tuple[Episode, ...]) -> None:
        """Begin a file.

        Args:
            file: The file, for messages.
            episodes: Its episodes.
        """
        self._file = file
        self._missing = {episode.index: episode for episode in episodes}
        self._blocks: dict[int, list[FloatArray]] = {}

    def add(self, numbers: IntArray, values: FloatArray) -> Iterator[tuple[Episode, FloatArray]]:
        """Take the next frames of the file.

        Args:
            numbers: Number of the episode of each; shape (n,).
            values: The frames; shape (n, k).

        Yields:
            Episodes that are complete, with all frames.

        Raises:
            FormatError: If a frame is of no episode of the file, or one too many.
        """
        edges = np.flatnonzero(np.diff(numbers)) + 1
        for block in np.split(np.arange(len(numbers)), edges) if len(numbers) else ():
            number = int(numbers[block[0]])
            episode = self._missing.get(number)
            if episode is None:
                raise FormatError(
                    f"{self._file}: expected frames of the episodes {self._expected()}, as the list of episodes has "
                    f"them, got one of episode {number}"
                )
            blocks = self._blocks.setdefault(number, [])
            blocks.append(values[block])
            count = sum(map(len, blocks))
            if count > episode.frames:
                raise FormatError(f"{self._file}: expected {episode.frames} frames of episode {number}, got more")
            if count == episode.frames:
                yield episode, np.concatenate(self._blocks.pop(number))
                del self._missing[number]

    def require_complete(self) -> None:
        """Refuse a file that ends before its episodes do.

        Raises:
            FormatError: If frames are missing.
        """
        lacking = next((one for one in self._missing.values() if one.frames), None)
        if lacking is not None:
            count = sum(map(len, self._blocks.get(lacking.index, ())))
            raise FormatError(
                f"{self._file}: expected {lacking.frames} frames of episode {lacking.index}, got {count}; copy the "
                "dataset again"
            )

    def _expected(self) -> str:
        numbers = sorted(self._missing)
        return "none" if not numbers else f"{numbers[0]} to {numbers[-1]}"
