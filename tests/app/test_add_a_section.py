# SPDX-License-Identifier: BSD-3-Clause
"""A section of the experiment file is a file of its capability and a name: then loader and schema know it.

This is the recipe of docs/architecture.md, followed with `tests/toys/section`.
"""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest

from forcetorque.base.errors import ExperimentError, FormatError
from forcetorque.experiment.experiment_file import experiment_file
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.section import sections
from tests.app.added_command import added_folder
from tests.app.outcome import Run
from tests.scenes.experiments import PARQUET, add

TOY = Path(__file__).parents[1] / "toys" / "section"
ROOM = '\n[weather]\ntemperature_degC = 21.5\nsensor = "arm_ft"\n'


@pytest.fixture
def added() -> Iterator[None]:
    """The recipe; what is made of all sections is made once, so here once more."""
    with added_folder(TOY, "weather"):
        _forget()
        yield
    _forget()


def _forget() -> None:
    sections.cache_clear()
    experiment_file.cache_clear()


@pytest.mark.usefixtures("added")
def test_the_loader_reads_it(arm: Path) -> None:
    """The experiment has its content; a file without it has the empty one."""
    weather = import_module("forcetorque.weather.section").WEATHER
    assert load_experiment(arm / PARQUET).section(weather) is None
    add(arm / PARQUET, ROOM)
    assert load_experiment(arm / PARQUET).section(weather).temperature_degC == 21.5


@pytest.mark.usefixtures("added")
def test_it_is_checked(arm: Path) -> None:
    """Against its own form, and by the capability against the robot."""
    add(arm / PARQUET, ROOM.replace("arm_ft", "other_ft"))
    with pytest.raises(ExperimentError, match="weather: expected a sensor of the file, got 'other_ft'"):
        load_experiment(arm / PARQUET)


@pytest.mark.usefixtures("added")
def test_its_form_is_in_the_schema(run: Run) -> None:
    """With its description."""
    assert run("schema", "experiment").result()["properties"]["weather"]["description"] == "The room."


def test_without_the_capability_it_is_an_unknown_table(arm: Path) -> None:
    """Negative control."""
    add(arm / PARQUET, ROOM)
    with pytest.raises(FormatError, match="weather"):
        load_experiment(arm / PARQUET)
