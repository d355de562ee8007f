# SPDX-License-Identifier: BSD-3-Clause
"""Patches whose modules are frames of a URDF: the last step from a CAD model to taxels.

A file says what the URDF cannot: which frames are modules, of which link, and how they are turned.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from typing import Literal

import numpy as np
from pydantic import Field

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, SkinError
from forcetorque.base.toml_file import Table, read_toml
from forcetorque.robot.installed_robots import urdf_file
from forcetorque.robot.model import RobotModel
from forcetorque.robot.tree import build_tree
from forcetorque.robot.urdf import read_urdf
from forcetorque.skin.layout.formats.icub_skin_gui import read_plan
from forcetorque.skin.layout.layout import PatchDescription
from forcetorque.skin.layout.normals import rebuilt_normals
from forcetorque.skin.layout.triangular_modules import LARGEST_MESSAGE, MODULE_COLUMNS, modular_patch, module_poses

_SCHEMA = "forcetorque/module_frames/1"
_NUMBER = "{module}"


class ModuleFrames(Table):
    """The modules of a patch as frames of a URDF."""

    schema_name: Literal["forcetorque/module_frames/1"] = Field(alias="schema")
    """Form of the file."""
    patch: str
    """Patch."""
    urdf: Path
    """URDF file; relative to this one."""
    link: str
    """Link that the patch is on."""
    frames: str
    """Names of the links whose origins are the centres of modules, with `{module}` where the number of each stands."""
    columns: int = Field(gt=0, le=LARGEST_MESSAGE)
    """Numbers in one message of counts."""
    plan: Path | None = None
    """Plan of skinGui, which says how modules are turned where the frames are only places; relative to this file."""
    mirrored: tuple[int, ...] = ()
    """Modules whose boards are mirror images, where the frames have axes of their own (x and y in the board, z out)."""


class UrdfFrames:
    """A file of schema `forcetorque/module_frames/1`, beside a URDF with a frame per module."""

    sign = f'a file of schema "{_SCHEMA}"'
    """What it is recognised by."""

    def recognises(self, text: str) -> bool:
        """Whether the file has the schema."""
        return re.search(rf'^schema\s*=\s*"{_SCHEMA}"', text, re.MULTILINE) is not None

    def read(self, path: Path, text: str) -> PatchDescription:
        """Read a file, its URDF and its plan.

        Args:
            path: File.
            text: Its content.

        Returns:
            The patch, with the normals of the smooth surface below its modules.

        Raises:
            FormatError: If the frames are not those of the plan, or not fixed to the link.
            SkinError: If a module has no neighbours that show how it is turned.
        """
        stated = read_toml(path, ModuleFrames, what="module frames")
        frames = _frames(path, stated, read_urdf(urdf_file(stated.urdf, path.parent)))
        modules = sorted(frames)
        poses = np.array([frames[module] for module in modules])
        if stated.plan is not None:
            poses = _by_plan(path, path.parent / stated.plan, modules, poses)
        if max(modules) >= stated.columns // MODULE_COLUMNS:
            raise FormatError(
                f"{path}: columns: expected {MODULE_COLUMNS} for each module up to {max(modules)}, got {stated.columns}"
            )
        patch = modular_patch(
            source=str(path),
            name=stated.patch,
            frame=stated.link,
            modules=modules,
            poses=poses,
            lines=[0] * len(modules),
            mirrored=[module in stated.mirrored for module in modules],
            columns=stated.columns,
        )
        return replace(patch, normals=rebuilt_normals(patch.positions, patch.modules, outward=patch.normals))


def _frames(path: Path, stated: ModuleFrames, robot: RobotModel) -> dict[int, FloatArray]:
    """Pose of every module in the link, by its number."""
    before, sign, after = stated.frames.partition(_NUMBER)
    if not sign:
        raise FormatError(f"{path}: frames: expected a name with {_NUMBER} in it, got {stated.frames!r}")
    names = {
        int(match[1]): name
        for name in robot.links
        if (match := re.fullmatch(rf"{re.escape(before)}(\d+){re.escape(after)}", name))
    }
    if not names:
        raise FormatError(f"{path}: frames: expected links of {stated.urdf} called {stated.frames!r}, got none")
    tree = build_tree(robot, stated.link)
    poses = {}
    for module, name in names.items():
        body, pose = tree.frames[name]
        if body != tree.frames[stated.link][0]:
            raise FormatError(
                f"{path}: link: expected {name!r} to be fixed to {stated.link!r}, got a joint that moves between them; "
                "name the link that carries the skin"
            )
        poses[module] = pose
    return poses


def _by_plan(path: Path, file: Path, modules: list[int], poses: FloatArray) -> FloatArray:
    """Poses of which only the places are kept: how they are turned says the plan."""
    plan = {module.number: module for module in read_plan(file)}
    if set(plan) != set(modules):
        other = sorted(set(plan) ^ set(modules))
        raise FormatError(f"{path}: plan: expected {file} to have the modules that are frames, got only one of {other}")
    try:
        return module_poses([plan[module] for module in modules], poses[:, :3, 3])
    except SkinError as error:
        raise SkinError(f"{path}: {error}") from error
