# SPDX-License-Identifier: BSD-3-Clause
"""What docs/skin/taxels.md states of an experiment file is one."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from forcetorque.experiment.experiment_file import experiment_file
from forcetorque.skin.taxels.taxel_curve import CurveKind

PAGE = (Path(__file__).resolve().parents[2] / "docs" / "skin" / "taxels.md").read_text(encoding="utf-8")


def test_the_file_of_the_page_is_valid() -> None:
    """Its block of TOML has the form of an experiment file with a patch alone."""
    (block,) = re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    stated = experiment_file().model_validate(tomllib.loads(block))
    assert (len(stated.patch), stated.sensor, stated.robot) == (1, (), None)


def test_every_curve_is_on_the_page() -> None:
    """In the order of the library."""
    table = PAGE.partition("| curve | what it is |")[2].partition("\n\n")[0]
    assert re.findall(r"^\| `(\w+)` \|", table, re.MULTILINE) == [kind.value for kind in CurveKind]
