# SPDX-License-Identifier: BSD-3-Clause
"""Packages import their public names when these are first used, and no name is that of a module beside it."""

from __future__ import annotations

import ast
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest

import forcetorque
from forcetorque import payload

ROOT = Path(forcetorque.__file__).parent
PACKAGES = sorted(
    ".".join(path.parent.relative_to(ROOT.parent).parts)
    for path in ROOT.rglob("__init__.py")
    if "lazy_names(" in path.read_text(encoding="utf-8")
)


def _run(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def test_a_name_is_imported_without_the_others() -> None:
    """Identifying a payload imports neither devices nor skin; asking for those does: the negative control."""
    listed = "import sys; print(*(name for name in sys.modules if name.startswith('forcetorque')))"
    code = f"from forcetorque.payload import weigh_load; {listed}; from forcetorque.device import *; "
    one, more = (set(line.split()) for line in _run(f"{code}from forcetorque.skin import *; {listed}").splitlines())
    assert "forcetorque.payload.identify" in one
    others = {"forcetorque.device.design", "forcetorque.skin.taxels.calibrate"}
    assert not others & one
    assert others < more


def _typed_homes(package: str) -> dict[str, str]:
    """Module of every name that a package imports for type checkers."""
    path = ROOT.parent.joinpath(*package.split("."), "__init__.py")
    blocks = [node for node in ast.parse(path.read_text(encoding="utf-8")).body if isinstance(node, ast.If)]
    imports = [node for block in blocks for node in block.body if isinstance(node, ast.ImportFrom)]
    return {alias.name: str(node.module) for node in imports for alias in node.names}


@pytest.mark.parametrize("package", PACKAGES)
def test_public_names_are_there_and_typed(package: str) -> None:
    """Each is listed, is what its module defines, and is the same for type checkers."""
    module = import_module(package)
    homes = _typed_homes(package)
    assert sorted(homes) == sorted(module.__all__)
    assert set(module.__all__) <= set(dir(module))
    foreign = {"TYPE_CHECKING", "lazy_names"} & set(dir(module))
    assert not foreign, "completion offers names that the package only imported"
    for name, home in homes.items():
        assert getattr(module, name) is getattr(import_module(home), name)


@pytest.mark.parametrize("package", PACKAGES)
def test_no_public_name_is_a_module(package: str) -> None:
    """An import of the module would hide the name."""
    folder = ROOT.parent.joinpath(*package.split("."))
    modules = {path.stem for path in folder.glob("*.py")} | {path.parent.name for path in folder.glob("*/__init__.py")}
    assert not modules & set(import_module(package).__all__)


def test_packages_are_looked_at() -> None:
    """The tests above run over something."""
    assert len(PACKAGES) > 12


def test_an_unknown_name_is_an_attribute_error() -> None:
    """As of any module."""
    with pytest.raises(AttributeError, match=r"module 'forcetorque\.payload' has no attribute 'weighed'"):
        payload.weighed  # type: ignore[attr-defined]  # noqa: B018
