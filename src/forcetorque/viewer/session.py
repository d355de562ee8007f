# SPDX-License-Identifier: BSD-3-Clause
"""What a served page saves, while it is served."""

from __future__ import annotations

import threading
from collections.abc import Callable
from pathlib import Path

from forcetorque.atomic import write_bytes_atomically
from forcetorque.viewer.annotations import Annotations, save_annotations, saved_files
from forcetorque.viewer.build import BuiltScene


class Session:
    """Writes what the page saves; files of an earlier session are kept once under another name."""

    def __init__(self, experiment: Path, built: BuiltScene, say: Callable[[str], None]) -> None:
        """Start a session.

        Args:
            experiment: The experiment file, beside which is saved.
            built: Its scene.
            say: Called with a line for people at every file.
        """
        self._experiment, self._built, self._say = experiment, built, say
        self._is_first, self._lock = True, threading.Lock()

    def save(self, annotations: Annotations) -> list[str]:
        """Save what was annotated, in place of what this session saved before.

        Args:
            annotations: Samples and intervals.

        Returns:
            Names of the files.
        """
        with self._lock:  # two windows may save at once
            files = [file for file in saved_files(self._experiment) if self._is_first and file.is_file()]
            earlier = {file: file.read_bytes() for file in files}
            written = save_annotations(annotations, self._built, self._experiment)
            self._is_first = False
            for file, content in earlier.items():
                kept = file.with_name(f"{file.stem}.previous{file.suffix}")
                write_bytes_atomically(kept, content)
                self._say(f"{file} of an earlier session is now {kept}")
        self._say(f"saved {len(annotations.samples)} sample(s) to {written[0]} and {written[1]}")
        return [file.name for file in written]
