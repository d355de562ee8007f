# SPDX-License-Identifier: BSD-3-Clause
"""Robots of installed packages, by name: a name stands where the path of a URDF file may stand."""

from __future__ import annotations

import os
import re
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from importlib.metadata import Distribution, PackageNotFoundError, distribution, version
from pathlib import Path

from forcetorque.base.errors import MissingExtraError, RobotError, install_line, known_names

_ICUB_MODELS = "icub-models"
_EXAMPLES = "cmeel.prefix/share/example-robot-data/robots"
"""Folder of the descriptions in the package example-robot-data, which holds no module to import."""
_CACHE = "~/.cache/robot_descriptions"
"""Folder in which the package robot_descriptions keeps repositories, unless ROBOT_DESCRIPTIONS_CACHE names another."""
_FILE_SUFFIXES = (".urdf", ".xml", ".xacro", ".sdf")
_DESCRIPTION = re.compile("_(description|data)$")


@dataclass(frozen=True, slots=True, kw_only=True)
class InstalledRobot:
    """A robot of an installed package."""

    name: str
    """Stem of its file without `_robot`; where several descriptions have that, the name of the description."""
    urdf: Path
    """Its file."""
    package: str
    """The package, or the repository in the cache of robot_descriptions."""
    version: str
    """Version of the package, or the commit of the repository."""

    @property
    def source(self) -> str:
        """Name, package and version, for the list of inputs."""
        return f"{self.name} ({self.package} {self.version})"


def installed_robots() -> dict[str, InstalledRobot]:
    """List the robots of example-robot-data, of icub-models and of the cache of robot_descriptions.

    Nothing is downloaded.

    Returns:
        Robots by name; of two with the same name that of the package which is named first.
    """
    robots: dict[str, InstalledRobot] = {}
    for robot in (*_example_robots(), *_icub_robots(), *_cached_robots()):
        robots.setdefault(robot.name, robot)
    return robots


def installed_robot(name: str, *, others: Iterable[str] = ()) -> InstalledRobot:
    """Find a robot of an installed package.

    Args:
        name: Name of the robot.
        others: Further names that the caller knows, for the message.

    Returns:
        The robot.

    Raises:
        RobotError: If no package has it.
        MissingExtraError: If no installed package has it, and a package with robots is not installed.
    """
    robots = installed_robots()
    if name in robots:
        return robots[name]
    text = f"no robot is called {name!r}; {known_names(name, [*others, *robots])}"
    lines = {install_line("robots"): _examples() is not None, install_line("icub"): _has_icub_models()}
    extras = [line for line, is_there in lines.items() if not is_there]
    if extras:
        raise MissingExtraError(f"{text}; more robots: {', '.join(extras)}")
    raise RobotError(f"{text}; or name a URDF file")


def is_robot_name(urdf: Path | str, folder: Path) -> bool:
    """Whether a text names a robot and not a file: it has no folder and no suffix of a file, and no such file exists.

    Args:
        urdf: Path of a URDF file, or a name.
        folder: Folder that paths are relative to.

    Returns:
        Whether it is a name.
    """
    path = Path(urdf)
    is_word = path.name == str(urdf) and path.name != "" and path.suffix.lower() not in _FILE_SUFFIXES
    return is_word and not (folder / path).exists()


def urdf_file(urdf: Path | str, folder: Path | str = ".") -> Path:
    """Find the URDF file that a path or the name of an installed robot stands for.

    Args:
        urdf: Path of a URDF file, or the name of an installed robot; a file that exists is never a name.
        folder: Folder that paths are relative to.

    Returns:
        The file, which need not exist where a path was given.
    """
    if is_robot_name(urdf, Path(folder)):
        return installed_robot(str(urdf)).urdf
    return Path(folder) / urdf


def package_roots() -> tuple[Path, ...]:
    """List the folders that hold the packages of `package://` names in files of installed robots.

    Returns:
        Folders of example-robot-data and of the cache of robot_descriptions.
    """
    package = _examples()
    share = () if package is None else (Path(str(package.locate_file(_EXAMPLES))).parents[1],)
    return (*share, *_cache_folders())


def _examples() -> Distribution | None:
    try:
        return distribution("example-robot-data")
    except PackageNotFoundError:
        return None


def _example_robots() -> Iterator[InstalledRobot]:
    package = _examples()
    if package is not None:
        yield from _robots_below(Path(str(package.locate_file(_EXAMPLES))), package.name, package.version)


def _has_icub_models() -> bool:
    try:
        import icub_models  # noqa: F401
    except ImportError:
        return False
    return True


def _icub_robots() -> Iterator[InstalledRobot]:
    if not _has_icub_models():
        return
    import icub_models

    for name in icub_models.get_robot_names():
        file = Path(icub_models.get_model_file(name))
        yield InstalledRobot(name=name, urdf=file, package=_ICUB_MODELS, version=version(_ICUB_MODELS))


def _cache_folders() -> tuple[Path, ...]:
    """The cache, and the folders that it has for a repository at another commit."""
    cache = Path(os.environ.get("ROBOT_DESCRIPTIONS_CACHE", _CACHE)).expanduser()
    if not cache.is_dir():
        return ()
    others = (entry for entry in sorted(cache.iterdir()) if entry.is_dir() and not (entry / ".git").exists())
    return (cache, *others)


def _cached_robots() -> Iterator[InstalledRobot]:
    for folder in _cache_folders():
        for repository in sorted(folder.iterdir()):
            if (repository / ".git").is_dir():
                yield from _robots_below(repository, repository.name, _commit(repository))


def _commit(repository: Path) -> str:
    """Commit that is checked out; a branch where the head is one."""
    head = (repository / ".git" / "HEAD").read_text(encoding="utf-8").strip()
    return head.removeprefix("ref: refs/heads/")


def _robots_below(folder: Path, package: str, release: str) -> Iterator[InstalledRobot]:
    by_name: dict[str, dict[str, Path]] = defaultdict(dict)
    for file in _urdf_files(folder):
        # of ur3.urdf and ur3_robot.urdf in one description the second is the robot
        name, description = file.stem.removesuffix("_robot"), _description(file, folder)
        if name == file.stem:
            by_name[name].setdefault(description, file)
        else:
            by_name[name][description] = file
    for name, files in by_name.items():
        for description, file in files.items():
            chosen = name if len(files) == 1 else description
            yield InstalledRobot(name=chosen, urdf=file, package=package, version=release)


def _urdf_files(folder: Path) -> Iterable[Path]:
    files = []
    for place, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if name != ".git"]
        files += [Path(place) / name for name in names if name.lower().endswith(".urdf")]
    return sorted(files)


def _description(file: Path, folder: Path) -> str:
    parts = file.relative_to(folder).parts
    named = next((part for part in parts[:-1] if _DESCRIPTION.search(part)), parts[0])
    return _DESCRIPTION.sub("", named)
