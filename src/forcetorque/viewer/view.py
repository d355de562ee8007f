# SPDX-License-Identifier: BSD-3-Clause
"""What is shown of an experiment, and where."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal, Self

from pydantic import Field

from forcetorque.result import Result, Table
from forcetorque.viewer.build import BuiltScene


class View(Result):
    """An experiment as the viewer shows it."""

    schema_name: Literal["forcetorque/view/1"] = Field(default="forcetorque/view/1", alias="schema")
    """Form of the result."""
    experiment: str
    """Name of the experiment."""
    sensors: tuple[str, ...]
    """Sensors that are shown."""
    skin: tuple[str, ...] = ()
    """Patches of skin, and streams of contacts that a skinManager saw, that are shown."""
    samples: int
    """Number of samples."""
    url: str | None
    """Address of the page while it is served; null otherwise."""
    file: str | None
    """File of the page, where one was written."""
    file_bytes: int | None
    """Its size."""
    video: str | None
    """File of the video, where one was written."""
    video_frames: int | None
    """Its number of frames."""
    notes: tuple[str, ...]
    """What is absent, and why."""

    @classmethod
    def of(cls, built: BuiltScene) -> Self:
        """Say what a scene shows, before it is shown anywhere.

        Args:
            built: The scene.

        Returns:
            The view, without address and files.
        """
        return cls(
            experiment=built.scene.title,
            sensors=tuple(sensor.name for sensor in built.scene.sensors if sensor.acting is not None),
            skin=(*(one.name for one in built.scene.skin), *(one.name for one in built.scene.skin_events)),
            samples=built.scene.samples,
            url=None,
            file=None,
            file_bytes=None,
            video=None,
            video_frames=None,
            notes=tuple(built.scene.notes),
        )

    def blocks(self) -> Iterator[Table | str]:
        """Say what is shown, and where.

        Yields:
            Sentences.
        """
        yield f"{self.experiment}: {self.samples} samples of {', '.join((*self.sensors, *self.skin))}"
        if self.file is not None and self.file_bytes is not None:
            yield f"page of {self.file_bytes / 1e6:.1f} MB written to {self.file}"
        if self.video is not None:
            yield f"video of {self.video_frames} frames written to {self.video}"
        if self.url is not None:
            yield f"open {self.url}"

    def records(self) -> list[dict[str, object]]:
        """Give one line.

        Returns:
            What is single.
        """
        several = ("schema", "sensors", "skin", "notes")
        return [{name: value for name, value in self.flat().items() if name not in several}]
