# SPDX-License-Identifier: BSD-3-Clause
"""Packages import what they offer when it is first asked for, and give functions where modules have their names."""

from __future__ import annotations

import subprocess
import sys

import pytest

from forcetorque import analysis


def _run(code: str) -> str:
    return subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout


def test_a_question_is_imported_without_the_others() -> None:
    """Weighing a load imports neither devices nor skin; asking for all of them does: the negative control."""
    listed = "import sys; print(*(name for name in sys.modules if name.startswith('forcetorque.analysis')))"
    imported = _run(
        f"from forcetorque.analysis import weigh_load; {listed}; from forcetorque.analysis import *; {listed}"
    )
    one, every = (set(line.split()) for line in imported.splitlines())
    assert "forcetorque.analysis.payload.payload" in one
    assert not {"forcetorque.analysis.device.device", "forcetorque.analysis.skin.wrench"} & one
    assert {"forcetorque.analysis.device.device", "forcetorque.analysis.skin.wrench"} < every
    assert len(one) < 0.5 * len(every)


@pytest.mark.parametrize("before", ["", "import forcetorque.analysis.evaluate.evaluate; "])
def test_a_function_wins_over_the_module_of_its_name(before: str) -> None:
    """Whether the module was imported before or was not."""
    code = f"{before}from forcetorque.analysis import evaluate; import forcetorque.analysis.evaluate.evaluate; "
    assert _run(
        code + "from forcetorque.analysis import evaluate as again; print(callable(evaluate), again is evaluate)"
    ) == ("True True\n")


def test_what_is_offered_is_listed_and_there() -> None:
    """Every name, as completion in a notebook lists it."""
    assert len(analysis.__all__) > 150
    assert set(analysis.__all__) <= set(dir(analysis))
    assert all(getattr(analysis, name) is not None for name in analysis.__all__)


def test_an_unknown_name_is_an_attribute_error() -> None:
    """As of any module."""
    with pytest.raises(AttributeError, match=r"module 'forcetorque\.analysis' has no attribute 'evaluated'"):
        analysis.evaluated  # noqa: B018
