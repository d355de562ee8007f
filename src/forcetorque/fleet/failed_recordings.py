# SPDX-License-Identifier: BSD-3-Clause
"""Recordings that could not be added to a dataset, kept beside it, so that a later run does not try them in vain."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import Field

from forcetorque.base.output_file import write_bytes_atomically
from forcetorque.base.stored_table import StoredTable, read_stored_table
from forcetorque.fleet.recording_source import RecordingSource
from forcetorque.fleet.sensor_record import AddOptions, path_digest


class StoredFailure(StoredTable):
    """Why a recording could not be added."""

    schema_name: Literal["forcetorque/failure/1"] = Field(default="forcetorque/failure/1", alias="schema")
    """Form of the file."""
    file: str
    """Experiment file, or log that one was applied to."""
    error: str
    """The error in one line."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Failures:
    """The failures of a dataset."""

    dataset: Path
    """Folder of the dataset."""
    options: AddOptions
    """What is kept of every recording."""
    code_version: str
    """Version of this library: another one tries again."""

    def _path(self, source: RecordingSource) -> Path:
        try:
            content = source.experiment.read_bytes()
        except OSError:
            content = b""
        # a log that was cut off may be whole in a later run
        digest = hashlib.sha256(content + repr(source.log_state()).encode()).hexdigest()[:20]
        name = f"{path_digest(source.path)}-{digest}-{self.options.digest(self.code_version)}.json"
        return self.dataset / "failures" / name

    def of(self, source: RecordingSource) -> StoredFailure | None:
        """Find the failure of an earlier run, of the same experiment file, log, options and version.

        Args:
            source: The recording.

        Returns:
            The failure; None where there is none.
        """
        path = self._path(source)
        return read_stored_table(path, StoredFailure, expected="a failure") if path.is_file() else None

    def keep(self, source: RecordingSource, error: str) -> None:
        """Keep a failure.

        Args:
            source: The recording.
            error: The error in one line.
        """
        path = self._path(source)
        path.parent.mkdir(parents=True, exist_ok=True)
        stored = StoredFailure.model_validate({"file": str(source.path), "error": error})
        write_bytes_atomically(path, (stored.model_dump_json(by_alias=True) + "\n").encode())


def forget_failures(dataset: Path, source: RecordingSource) -> None:
    """Remove what is kept of a recording that was added.

    Args:
        dataset: Folder of the dataset.
        source: The recording.
    """
    for path in dataset.glob(f"failures/{path_digest(source.path)}-*.json"):
        path.unlink(missing_ok=True)


def stored_failures(dataset: Path) -> list[StoredFailure]:
    """List the failures of a dataset.

    Args:
        dataset: Its folder.

    Returns:
        The failures, sorted by file.
    """
    failures = [
        read_stored_table(path, StoredFailure, expected="a failure") for path in dataset.glob("failures/*.json")
    ]
    return sorted(failures, key=lambda failure: (failure.file, failure.error))
