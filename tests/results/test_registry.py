# SPDX-License-Identifier: BSD-3-Clause
"""Results are known by being there."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

import forcetorque
from forcetorque.evaluation.evaluation import Evaluation
from forcetorque.results.result import Result, result_classes
from forcetorque.study.result import Studies

MODULE = """
from typing import Literal
from pydantic import Field
from forcetorque.results.result import Result
from forcetorque.results.table import Row
from forcetorque.study.result import Studies

class Wear(Result):
    schema_name: Literal["forcetorque/wear/3"] = Field(default="forcetorque/wear/3", alias="schema")

class Foreign(Result):
    schema_name: Literal["elsewhere/wear/1"] = Field(default="elsewhere/wear/1", alias="schema")

class Part(Result):
    pass
"""


def test_a_result_is_known_without_being_listed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A module in a package is enough; results of other families, and those without a schema, are none."""
    package = tmp_path / "registry_sample"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "wear.py").write_text(MODULE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    import registry_sample  # type: ignore[import-not-found]

    assert "registry_sample.wear" not in sys.modules
    (name, kind), *others = result_classes(registry_sample).items()
    assert (name, kind.__name__, others) == ("wear", "Wear", [])
    assert issubclass(kind, Result)
    assert "wear" not in result_classes(forcetorque), "control: packages that were not asked for"


def test_results_of_questions_are_known() -> None:
    """Each by the command that shows it."""
    known = result_classes(forcetorque)
    assert known["evaluate"] is Evaluation
    assert known["study"] is Studies
    assert all(kind.model_fields["schema_name"].default.split("/")[1] == name for name, kind in known.items())
