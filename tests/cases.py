# SPDX-License-Identifier: BSD-3-Clause
"""Cases of a parametrised test: some in `make test`, the others, which repeat them, in `make test-long`."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import pytest


def some_cases(
    names: str | Sequence[str],
    cases: Iterable[Any],
    *,
    quick: int = 1,
    ids: Sequence[str] | Callable[[Any], str] | None = None,
) -> pytest.MarkDecorator:
    """Parametrise a test of which the first cases are quick enough to run always.

    Args:
        names: Name of the argument, or names of several, of which every case then has a value each.
        cases: All cases; those after the first ones are marked `long`.
        quick: Number of the first cases that are not.
        ids: Names of the cases, or what gives the name of a value, as in `pytest.mark.parametrize`.

    Returns:
        Decorator of the test.
    """
    values = [(case,) if isinstance(names, str) else case for case in cases]
    marks = [() if k < quick else (pytest.mark.long,) for k in range(len(values))]
    marked = [pytest.param(*value, marks=mark) for value, mark in zip(values, marks, strict=True)]
    return pytest.mark.parametrize(names, marked, ids=ids)
