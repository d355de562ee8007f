# SPDX-License-Identifier: BSD-3-Clause
"""What is shown of the names of candidates, which are `prior` or calibration files."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import PurePath

_PRIOR_OF = "prior of "
"""What comes before the file where a calibration's own prior is the candidate."""


def short_names(candidates: Iterable[str]) -> dict[str, str]:
    """Leave out the folders of calibration files, but for as many as tell them apart.

    Args:
        candidates: Names of calibration files, `prior`, or `prior of` such a name; each as often as it comes.

    Returns:
        What to show by the name, another for each.
    """
    names = dict.fromkeys(candidates)
    deepest = max((len(_path(name).parts) for name in names), default=0)
    for count in range(1, deepest + 1):
        labels = {name: _shortened(name, count) for name in names}
        if len(set(labels.values())) == len(labels):
            return labels
    return {name: name for name in names}


def _shortened(name: str, count: int) -> str:
    return name[: len(name) - len(name.removeprefix(_PRIOR_OF))] + str(PurePath(*_path(name).parts[-count:]))


def _path(name: str) -> PurePath:
    return PurePath(name.removeprefix(_PRIOR_OF))
