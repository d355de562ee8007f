# SPDX-License-Identifier: BSD-3-Clause
"""Mesh files found by the names in URDF files, read as triangles, with fewer of them."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np
import numpy.typing as npt

from forcetorque.base.arrays import FloatArray, IntArray
from forcetorque.base.errors import FormatError, MissingExtraError, install_line
from forcetorque.base.input_file import read_xml
from forcetorque.base.run_files import declare_input
from forcetorque.base.units import parsed_number
from forcetorque.robot.installed_robots import package_roots

FORMATS = (".stl", ".obj", ".ply", ".glb", ".dae")
"""Suffixes of the forms that are read."""

_PREFIXES = ("AMENT_PREFIX_PATH", "CMAKE_PREFIX_PATH")
"""Variables with folders whose `share` holds packages."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Triangles:
    """A mesh in the axes of its file."""

    vertices: FloatArray
    """Shape (v, 3); m after scaling."""
    faces: npt.NDArray[np.uint32]
    """Indices of vertices; shape (f, 3)."""


def package_folders(urdf: Path, given: Sequence[Path] = ()) -> tuple[Path, ...]:
    """List the folders in which the packages of `package://` names may lie.

    Args:
        urdf: URDF file.
        given: Folders that are looked at first.

    Returns:
        Folders that exist: those given, those around the file, those of ROS_PACKAGE_PATH, AMENT_PREFIX_PATH and
        CMAKE_PREFIX_PATH, and those of installed robots.
    """
    around = urdf.resolve().parents
    listed = [Path(text) for text in os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep) if text]
    for variable in _PREFIXES:
        listed += [Path(text) / "share" for text in os.environ.get(variable, "").split(os.pathsep) if text]
    candidates = [*given, *around[:4], *listed, *_icub_models(), *package_roots()]
    return tuple(folder for folder in dict.fromkeys(candidates) if folder.is_dir())


def find_mesh(name: str, urdf: Path, folders: Sequence[Path], *, packages: Sequence[Path] = ()) -> Path | None:
    """Find a mesh file.

    Args:
        name: What the URDF calls it: `package://NAME/FILE`, `model://NAME/FILE`, `file://FILE`, or a path.
        urdf: URDF file.
        folders: Folders that hold packages.
        packages: Folders that are the package itself, whatever its name.

    Returns:
        The first file that exists; None if there is none.
    """
    scheme, separator, rest = name.partition("://")
    if not separator:
        rest = name
    path = Path(unquote(rest) if separator else rest)
    if scheme in ("package", "model") and separator:
        candidates = [folder / path for folder in folders]
        candidates += [folder / Path(*path.parts[1:]) for folder in packages]
    elif separator and scheme != "file":
        return None
    else:
        candidates = [urdf.parent / path, *(folder / path for folder in folders if not path.is_absolute())]
    return next((candidate for candidate in candidates if candidate.is_file()), None)


def read_mesh(file: Path, scale: Sequence[float]) -> Triangles:
    """Read a mesh file.

    Args:
        file: STL, OBJ, PLY, GLB or DAE.
        scale: Factors along the axes of the file.

    Returns:
        Its triangles, scaled.

    Raises:
        MissingExtraError: If what reads the form is not installed.
        FormatError: If it cannot be read or holds no triangles.
    """
    if file.suffix.lower() not in FORMATS:
        raise FormatError(f"{file}: expected a mesh that ends in {', '.join(FORMATS)}")
    for module in ("trimesh", *(("collada",) if file.suffix.lower() == ".dae" else ())):
        if importlib.util.find_spec(module) is None:
            raise MissingExtraError(f"meshes in {file.suffix} need {module}: {install_line('viewer')}")
    vertices, faces = _load(file)
    if not len(faces) or not np.isfinite(vertices).all() or faces.min() < 0 or faces.max() >= len(vertices):
        raise FormatError(f"{file}: expected triangles, got none or damaged ones")
    factors = np.asarray(scale, dtype=np.float64)
    if np.prod(factors) < 0.0:
        faces = faces[:, ::-1]  # a mirror image turns triangles inside out
    return Triangles(vertices=vertices * factors, faces=np.ascontiguousarray(faces, dtype=np.uint32))


def _load(file: Path) -> tuple[FloatArray, npt.NDArray[np.int64]]:
    import trimesh

    declare_input(file)
    unit_m = _collada_unit(file) if file.suffix.lower() == ".dae" else 1.0
    try:
        with file.open("rb") as stream:
            # without a resolver nothing beside the file, such as a texture, is read
            loaded: Any = trimesh.load(stream, file_type=file.suffix[1:].lower(), force="mesh", skip_materials=True)
    except Exception as error:
        raise FormatError(f"{file}: expected a mesh, got {type(error).__name__}: {error}") from error
    vertices = np.asarray(getattr(loaded, "vertices", np.empty((0, 3))), dtype=np.float64)
    faces = np.asarray(getattr(loaded, "faces", np.empty((0, 3))), dtype=np.int64)
    return unit_m * vertices.reshape(-1, 3), faces.reshape(-1, 3)


def _collada_unit(file: Path) -> float:
    """Length of the unit of a COLLADA file; m. Entities, which pycollada expands, are refused."""
    root = read_xml(file)
    unit = None if root is None else root.find("{*}asset/{*}unit")
    text = "1" if unit is None else unit.get("meter", "1")
    length = parsed_number(text)
    if not (np.isfinite(length) and length > 0.0):
        raise FormatError(f"{file}: unit: expected meter to be a number above 0, got {text!r}")
    return length


def _icub_models() -> list[Path]:
    """Share folder of the package icub-models, without importing it."""
    package = importlib.util.find_spec("icub_models")
    places = [Path(place) for place in (package.submodule_search_locations or ())] if package else []
    candidates = [place / "share" for place in places] + [place.parent / "share" for place in places]
    return [*candidates, *([Path(sys.prefix) / "share"] if package else [])]


MOST_TRIANGLES = 100_000
"""Triangles of a whole robot that are left as they are: 3 MB."""

_FIRST, _GROWTH = 0.8, 1.25
"""First size of a cell, relative to one that gives two triangles for each square of surface, and the factor from one
to the next."""

_SMALLEST_M = 1e-6
"""Smallest first size of a cell, for triangles without area."""
_MOST_NUMBERS = 9e18
"""Largest whole number of 64 bits."""


def simplified(meshes: Sequence[Triangles]) -> tuple[Triangles, ...]:
    """Reduce meshes together, with one size of cell, until they have few enough triangles.

    Args:
        meshes: Meshes in m.

    Returns:
        Meshes in the same order; the same ones where they have few enough.
    """
    cell = max(_FIRST * float(np.sqrt(2.0 * sum(_area(mesh) for mesh in meshes) / MOST_TRIANGLES)), _SMALLEST_M)
    reduced = tuple(meshes)
    while sum(len(mesh.faces) for mesh in reduced) > MOST_TRIANGLES:
        reduced = tuple(clustered(mesh, cell) for mesh in meshes)
        cell *= _GROWTH
    return reduced


def _area(mesh: Triangles) -> float:
    a, b, c = (mesh.vertices[mesh.faces[:, k]] for k in range(3))
    return float(0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum())


def clustered(mesh: Triangles, cell: float) -> Triangles:
    """Join the vertices of each cell at their mean, and drop the triangles that thereby vanish.

    Args:
        mesh: The mesh.
        cell: Edge of a cell; m.

    Returns:
        The reduced mesh; no vertex moves by more than the diagonal of a cell.
    """
    cells = np.floor((mesh.vertices - mesh.vertices.min(axis=0)) / cell).astype(np.int64)
    _, joined = np.unique(_numbered(cells), return_inverse=True)
    faces = joined[mesh.faces]
    solid = (faces[:, 0] != faces[:, 1]) & (faces[:, 1] != faces[:, 2]) & (faces[:, 2] != faces[:, 0])
    faces = faces[solid]
    # the two sides of a thin wall fall together
    _, first = np.unique(_numbered(np.sort(faces, axis=1)), return_index=True)
    kept, faces = np.unique(faces[np.sort(first)], return_inverse=True)
    return Triangles(vertices=_means(mesh.vertices, joined)[kept], faces=faces.reshape(-1, 3).astype(np.uint32))


def _numbered(triples: IntArray) -> IntArray:
    """One number for each triple of whole numbers from 0: much faster to sort than rows are."""
    sizes = triples.max(axis=0, initial=0) + 1
    if float(np.prod(sizes.astype(np.float64))) > _MOST_NUMBERS:
        return np.unique(triples, axis=0, return_inverse=True)[1].reshape(-1)
    return (triples[:, 0] * sizes[1] + triples[:, 1]) * sizes[2] + triples[:, 2]


def _means(values: FloatArray, group: IntArray) -> FloatArray:
    counts = np.bincount(group)
    sums = np.stack([np.bincount(group, weights=values[:, k]) for k in range(3)], axis=1)
    return sums / counts[:, None]
