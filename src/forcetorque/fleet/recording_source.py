# SPDX-License-Identifier: BSD-3-Clause
"""Where a recording comes from: an experiment file, or a log to which an experiment file is applied.

Logs at addresses that fsspec reads, such as `s3://bucket/logs/monday`, are copied while they are read.
"""

from __future__ import annotations

import re
import tempfile
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from types import ModuleType
from typing import Any

from forcetorque.base.errors import ChangingFileError, ExperimentError, MissingFileError, OutputError, needs_extra
from forcetorque.base.output_file import real_path, relative_path
from forcetorque.base.toml_file import toml_content
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment, load_tables
from forcetorque.experiment.named_files import InMemory, Inputs, changed_inputs

_SCHEME = re.compile(r"[A-Za-z][A-Za-z0-9+.-]+://")  # two letters, beside drives


def is_address(text: str) -> bool:
    """Tell addresses from paths.

    Args:
        text: An address, a path, or a pattern of them.

    Returns:
        Whether it begins with a scheme such as `s3://`.
    """
    return _SCHEME.match(text) is not None


def require_path(text: str, where: str) -> None:
    """Refuse an address for what is written, or read in place.

    Args:
        text: What was named.
        where: File and key, and what it is for.

    Raises:
        OutputError: If it is an address.
    """
    found = re.match(r"([A-Za-z][A-Za-z0-9+.-]+:/)/?", text)  # pathlib makes one slash of two
    if found is not None:
        address = f"{found[1]}/{text[found.end() :]}"
        raise OutputError(f"{where}: expected a local or mounted folder, got the address {address!r}; mount it")


def addresses(pattern: str, where: str) -> list[str]:
    """Find the files and folders of a pattern.

    Args:
        pattern: Address with `*` in it, or without.
        where: What it is for, for messages.

    Returns:
        Their addresses, sorted.

    Raises:
        ExperimentError: If it cannot be read, or matches nothing.
    """
    fsspec = _fsspec()
    try:
        system, path = fsspec.core.url_to_fs(pattern)
        found = sorted(system.unstrip_protocol(one) for one in system.glob(path))
    except (OSError, ValueError, ImportError) as error:
        raise ExperimentError(f"{where}: expected an address that fsspec reads, got {pattern!r}: {error}") from error
    if not found:
        raise ExperimentError(f"{where}: expected logs that match {pattern!r}, there is none")
    return found


def sizes(address: str) -> list[tuple[str, int]]:
    """List the files at an address.

    Args:
        address: Address of a file or folder.

    Returns:
        Path and size in bytes of every file, sorted; none where it cannot be read.
    """
    try:
        system, path = _fsspec().core.url_to_fs(address)
        return _sizes(system, path)
    except (OSError, ValueError, ImportError):
        return []


def _sizes(system: Any, path: str) -> list[tuple[str, int]]:
    return sorted((name, int(info["size"] or 0)) for name, info in system.find(path, detail=True).items())


@contextmanager
def copied(address: str) -> Iterator[Path]:
    """Copy a log to this machine, for as long as it is read.

    Args:
        address: Address of a file or folder.

    Yields:
        The copy, in the folder for temporary files.

    Raises:
        MissingFileError: If it cannot be read.
        ChangingFileError: If it changes while it is copied.
    """
    fsspec = _fsspec()
    with tempfile.TemporaryDirectory() as folder:
        try:
            system, path = fsspec.core.url_to_fs(address)
            before = _sizes(system, path)
            local = Path(folder) / path.rstrip("/").rpartition("/")[2]
            system.get(path, str(local), recursive=system.isdir(path))
            after = _sizes(system, path)
        except (OSError, ValueError, ImportError) as error:
            raise MissingFileError(f"{address}: expected a log that fsspec reads, got {error!r}") from error
        if before != after or not before:
            raise ChangingFileError(
                f"{address}: expected a log that does not change while it is copied, its files did; add the recording "
                "when its log is complete"
            )
        yield local


def _fsspec() -> ModuleType:
    with needs_extra("addresses of logs need fsspec", "fleet"):
        import fsspec
    return fsspec


@dataclass(frozen=True, slots=True, kw_only=True)
class RecordingSource:
    """One recording."""

    experiment: Path
    """Experiment file."""
    log: Path | None = None
    """Log that takes the place of `path` of its [recording]; None where the file has its own."""
    address: str | None = None
    """Address that fsspec reads the log from, in place of `log`."""

    @property
    def path(self) -> Path | str:
        """What tells it from others: the log, else the experiment file."""
        return self.address or self.log or self.experiment

    def absolute(self) -> RecordingSource:
        """Give the same from any working folder.

        Returns:
            The source with absolute paths.
        """
        return replace(
            self, experiment=real_path(self.experiment), log=None if self.log is None else real_path(self.log)
        )

    def logs(self) -> list[Path]:
        """List the logs.

        Returns:
            Files and folders of this machine, there or not; none where the experiment file cannot be read.
        """
        if self.address is not None:
            return []
        try:
            recording = toml_content(self.experiment)[1].get("recording")
        except (OSError, ValueError):
            recording = None
        if not isinstance(recording, dict):
            return [] if self.log is None else [self.log]
        named = [recording.get("path") if self.log is None else self.log, *recording.get("continued_in", ())]
        folder = real_path(self.experiment).parent
        return [folder / name for name in named if name is not None]

    def log_folders(self) -> list[Path]:
        """List the folders that the log consists of.

        Returns:
            The log and the folders in it; none where it is a file.
        """
        logs = [path for path in self.logs() if path.is_dir()]
        return [one for log in logs for one in (log, *(path for path in log.rglob("*") if path.is_dir()))]

    def log_state(self) -> list[tuple[str, int, int]]:
        """Tell the state of the log without reading it.

        Returns:
            Path, size in bytes and instant of the last change in ns of every file of it, sorted; of an address 0 in
            place of the instant.
        """
        if self.address is not None:
            return [(name, size, 0) for name, size in sizes(self.address)]
        files = [one for log in self.logs() for one in (log.rglob("*") if log.is_dir() else (log,)) if one.is_file()]
        return sorted((str(file), file.stat().st_size, file.stat().st_mtime_ns) for file in files)

    def load(self) -> Experiment:
        """Read the recording.

        Returns:
            The experiment; of a log its name has that of the log, and its file is the log.

        Raises:
            ExperimentError: If the experiment file has no [recording] with a path.
        """
        if self.address is not None:
            with copied(self.address) as copy:
                return self._load(copy, self.address)
        return load_experiment(self.experiment) if self.log is None else self._load(self.log, None)

    def changed(self, inputs_sha256: Mapping[str, str]) -> list[str]:
        """Name the inputs that are not what they were.

        Args:
            inputs_sha256: SHA-256 by name, of the experiment.

        Returns:
            Those that changed or are gone, of files on this machine.
        """
        own = {name: digest for name, digest in inputs_sha256.items() if not is_address(name)}
        return changed_inputs(real_path(self.experiment).parent, own)

    def _load(self, log: Path, address: str | None) -> Experiment:
        """Read a log by the experiment file; of an address it is a copy."""
        tables = toml_content(self.experiment)[1]
        recording = tables.get("recording")
        if not isinstance(recording, dict) or "path" not in recording:
            raise ExperimentError(
                f"{self.experiment}: expected [recording] with path, in whose place logs are read, got none"
            )
        folder = real_path(self.experiment).parent
        path = relative_path(log, folder)
        named = tables | {"recording": recording | {"path": path}}
        if "name" in tables:
            named["name"] = f"{tables['name']}, {log.stem}"
        experiment = load_tables(named, InMemory(), folder=folder)
        template = Inputs(folder)
        template.file(Path(self.experiment.name))
        inputs = experiment.inputs_sha256 | template.sha256()
        if address is not None:
            inputs = {
                f"{address}{name.removeprefix(path)}" if name == path or name.startswith(f"{path}/") else name: digest
                for name, digest in inputs.items()
            }
        return replace(
            experiment, file=log if address is None else self.experiment, inputs_sha256=dict(sorted(inputs.items()))
        )
