# SPDX-License-Identifier: BSD-3-Clause
"""Options and fixtures that every test may use."""

from __future__ import annotations

import gc
import io
import secrets
from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest
from hypothesis import is_hypothesis_test, settings
from matplotlib.figure import Figure
from PIL import Image

from tests import fuzzing
from tests.app.outcome import Run, typed
from tests.scenes.experiment_folders import (
    arm,
    days,
    intact,
    intact_warm,
    intact_warm_log,
    recorded,
    warm,
    warm_log,
)

__all__ = ["arm", "days", "intact", "intact_warm", "intact_warm_log", "recorded", "warm", "warm_log"]

_HEAVY = (
    "study/test_icub_insitu.py",
    "evaluation/sphere/",
    "report/test_report_command.py",
    "examples/test_examples.py",
    "app/test_snapshots.py",
    "formats/test_damaged_files.py",
)
"""Files and folders that take longest, in the long run or always: begun last, one worker would end after the other."""

_DEFAULT_DATA = Path(__file__).resolve().parents[2] / "shared" / "data"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Let the caller say where the measured data are, and renew pictures of what commands show."""
    parser.addoption("--data", type=Path, default=_DEFAULT_DATA, help="folder of measured data")
    parser.addoption("--all-examples", action="store_true", help="draw all random examples, not a quarter of them")
    parser.addoption("--write-snapshots", action="store_true", help="take what commands show now as the pictures")


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    """Draw other examples in every run, all workers by the seed of the first process, so that a run can be repeated."""
    if config.option.hypothesis_seed is None:
        config.option.hypothesis_seed = str(secrets.randbelow(2**32))
    if config.option.all_examples:
        fuzzing.SHARE[0] = 1
    # a slow machine is no failure
    settings.register_profile("patient", deadline=None, max_examples=fuzzing.examples(100))
    settings.load_profile("patient")


def pytest_itemcollected(item: pytest.Item) -> None:
    """Let the long run draw all examples of every test of Hypothesis."""
    if is_hypothesis_test(getattr(item, "obj", None)):
        item.add_marker("fuzz")


def pytest_report_header(config: pytest.Config) -> str:
    """Say how to repeat this run."""
    return f"examples of Hypothesis: --hypothesis-seed={config.option.hypothesis_seed}"


def heavy_first(paths: Sequence[str]) -> list[int]:
    """Order of tests by the paths of their files: the heavy ones first, all others as they come.

    Args:
        paths: Path of the file of every test, from the folder of the tests, with `/`.

    Returns:
        Indices of the tests in the new order.
    """
    rank = [next((k for k, heavy in enumerate(_HEAVY) if path.startswith(heavy)), len(_HEAVY)) for path in paths]
    return sorted(range(len(paths)), key=rank.__getitem__)


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Begin with the files that take longest; parallel runs keep this order with --no-loadscope-reorder."""
    root = Path(__file__).parent
    paths = [item.path.relative_to(root).as_posix() if root in item.path.parents else "" for item in items]
    items[:] = [items[k] for k in heavy_first(paths)]


def pytest_collection_finish() -> None:
    """Let the garbage collector pass over thousands of tests and modules, which stay: it took 6 % of the time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(50_000, 20, 20)


@pytest.fixture(scope="session")
def data_dir(request: pytest.FixtureRequest) -> Path:
    """Folder of measured data; tests that need it skip where it is absent."""
    folder = Path(request.config.getoption("--data")).resolve()
    if not folder.is_dir():
        pytest.skip(f"no measured data at {folder}; pass --data DIR")
    return folder


@pytest.fixture(scope="session")
def run() -> Run:
    """Run `forcetorque` with words as typed in a shell."""
    return typed


@pytest.fixture
def drawn() -> Iterator[list[Figure]]:
    """Figures that were made so far during the test, not drawn, so that what is in them can be checked."""
    from tests.report.drawing import recorded_figures  # here because few tests draw

    with recorded_figures() as figures:
        yield figures


@pytest.fixture
def blank_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    """Make pictures of a document or study, but leave them blank: drawing takes most of either, and words need none."""
    blank = io.BytesIO()
    Image.new("RGB", (1, 1)).save(blank, format="png")
    for module in ("results.document.content", "study.figures"):
        monkeypatch.setattr(f"forcetorque.{module}.png_bytes", lambda figure: blank.getvalue())
