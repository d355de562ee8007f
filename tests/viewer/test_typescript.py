# SPDX-License-Identifier: BSD-3-Clause
"""The page and the library know the same scene."""

from __future__ import annotations

import dataclasses
from pathlib import Path
from typing import Any

import pytest

from forcetorque.viewer import scene
from forcetorque.viewer.typescript import SHARED, scene_types, typescript_of

SOURCES = Path(__file__).parents[2] / "web" / "src"


@pytest.mark.parametrize("name", SHARED)
def test_the_page_has_the_classes_and_colours_of_the_library(name: str) -> None:
    """The committed files are what the library gives; `make web-types` writes them."""
    assert (SOURCES / name).read_text(encoding="utf-8") == SHARED[name]()


def test_every_class_and_every_field_is_there() -> None:
    """Every dataclass of the module becomes an interface with all its fields, each with its docstring."""
    text = scene_types()
    classes = [item for item in vars(scene).values() if dataclasses.is_dataclass(item)]
    assert len(classes) == 20
    for cls in classes:
        body = text.split(f"export interface {cls.__name__} {{\n")[1].split("\n}")[0].splitlines()
        assert [line.split(":")[0].removeprefix("  readonly ") for line in body[1::2]] == [
            field.name for field in dataclasses.fields(cls)
        ]
        assert all(line.startswith("  /** ") and line.endswith(" */") for line in body[::2])


@pytest.mark.parametrize(
    ("hint", "text"),
    [
        (str, "string"),
        (float | None, "number | null"),
        (tuple[int, ...], "readonly number[]"),
        (tuple[scene.Mesh, ...], "readonly Mesh[]"),
        (scene.Sphere | None, "Sphere | null"),
    ],
)
def test_types(hint: Any, text: str) -> None:
    """Numbers, texts, classes, absence and lists are what JSON makes of them."""
    assert typescript_of(hint) == text


@pytest.mark.parametrize("hint", [bytes, dict[str, int], list[int], tuple[int, int]])
def test_a_type_that_json_has_not_is_refused(hint: Any) -> None:
    """A field that the page could not read is noticed when the types are written."""
    with pytest.raises(TypeError, match="expected text, a number, a class of the scene"):
        typescript_of(hint)
