# SPDX-License-Identifier: BSD-3-Clause
"""Which components of a wrench are force and which are moment, against their names and units."""

from __future__ import annotations

from forcetorque.base.wrench import FORCE, FORCE_AND_MOMENT, MOMENT, WRENCH_COMPONENTS, WRENCH_UNITS


def test_force_stands_before_moment() -> None:
    """The two slices take all components once, in their order, and each takes those of its unit."""
    assert [name[0] for name in WRENCH_COMPONENTS[FORCE]] == ["f", "f", "f"]
    assert [name[0] for name in WRENCH_COMPONENTS[MOMENT]] == ["t", "t", "t"]
    assert (*WRENCH_COMPONENTS[FORCE], *WRENCH_COMPONENTS[MOMENT]) == WRENCH_COMPONENTS
    assert [set(WRENCH_UNITS[half]) for half in FORCE_AND_MOMENT] == [{"N"}, {"N m"}]
