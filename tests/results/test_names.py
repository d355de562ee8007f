# SPDX-License-Identifier: BSD-3-Clause
"""Short names of candidates are short, and no two candidates ever share one."""

from __future__ import annotations

import pytest

from forcetorque.results.table import short_names


@pytest.mark.parametrize(
    ("given", "shown"),
    [
        (["prior", "made/leg.json", "prior"], ["prior", "leg.json"]),
        (["a/leg.json", "b/leg.json", "c/arm.json"], ["a/leg.json", "b/leg.json", "c/arm.json"]),
        (["x/a/leg.json", "x/b/leg.json", "prior"], ["a/leg.json", "b/leg.json", "prior"]),
        (["prior of x/a/leg.json", "x/a/leg.json"], ["prior of leg.json", "leg.json"]),
        (["leg.json", "old/leg.json"], ["leg.json", "old/leg.json"]),
        (["old/prior", "prior"], ["old/prior", "prior"]),
        (["./leg.json", "leg.json"], ["./leg.json", "leg.json"]),
        (["/a/leg.json", "/leg.json"], ["a/leg.json", "/leg.json"]),
        ([], []),
    ],
)
def test_as_many_folders_as_tell_candidates_apart(given: list[str], shown: list[str]) -> None:
    """Folders that all have in common are left out; where nothing tells two apart, names stay as they were given."""
    names = short_names(given)
    assert names == dict(zip(dict.fromkeys(given), shown, strict=True))
    assert len(set(names.values())) == len(names)
