# SPDX-License-Identifier: BSD-3-Clause
"""The order in which tests begin: the heavy files, then the others as they were."""

from __future__ import annotations

from pathlib import Path

from tests import conftest


def test_heavy_files_begin_and_the_others_keep_their_order() -> None:
    """The tests of a file stay together and in order."""
    heavy = conftest._HEAVY[0]
    paths = ["viewer/test_view_command.py", heavy, "base/test_units.py", heavy, "viewer/test_view_command.py"]
    assert conftest.heavy_first(paths) == [1, 3, 0, 2, 4]


def test_every_heavy_file_is_there() -> None:
    """A file that is renamed would silently begin late."""
    assert all((Path(conftest.__file__).parent / name).exists() for name in conftest._HEAVY)
