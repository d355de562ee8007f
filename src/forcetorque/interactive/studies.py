# SPDX-License-Identifier: BSD-3-Clause
"""Studies of all ways to fit, for scripts and notebooks."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path

from forcetorque import analysis
from forcetorque.calibration import ESTIMATION_TYPES, estimation_type
from forcetorque.created import created_now
from forcetorque.new_folder import refuse_existing
from forcetorque.study import SWEEP_LAMBDAS


def study(
    *experiments: Path | str,
    sensors: Sequence[str] | None = None,
    data_sets: Mapping[str, Sequence[str]] | None = None,
    kinds: Sequence[str] = tuple(ESTIMATION_TYPES),
    lambdas: Sequence[float] = SWEEP_LAMBDAS,
    sphere: Collection[str] | None = None,
    folder: Path | str | None = None,
    progress: Callable[[str], None] | None = None,
) -> analysis.Studies:
    """Fit every estimation type, lambda and data set, and choose: `study("a.toml", "b.toml", progress=print)`.

    Args:
        experiments: Experiment files with the same sensors.
        sensors: Names of the sensors; all of the first file if left out.
        data_sets: Labels or kinds of the intervals that are fitted together, by name; every combination of kinds if
            left out.
        kinds: Estimation types, SnTdTO to OwTrTO; all nine if left out.
        lambdas: Lambdas of the thesis' equation (5.4); counts2; the thirteen of its tables if left out.
        sphere: Intervals whose motion draws a sphere, for the types S...; what the files say if left out.
        folder: Folder to make for tables, figures and calibrations of the best; nothing is written if left out.
        progress: Called with a line for people at every step, such as `print`.

    Returns:
        The choice for every sensor; `records()` has every candidate.

    Raises:
        ForceTorqueError: If there is nothing to study, or the folder is there already.
    """
    if folder is not None:
        refuse_existing(Path(folder))
    types = [estimation_type(name) for name in kinds]
    created = created_now()
    studied = analysis.read_study_data([Path(file) for file in experiments], sensors, progress=progress)
    answers = (
        analysis.study_sensor(
            data,
            data_sets=data_sets,
            kinds=types,
            lambdas=tuple(sorted(set(lambdas))),
            sphere=sphere,
            code_version=version("forcetorque"),
            created=created,
            progress=progress,
        )
        for data in studied
    )
    names = tuple(map(str, experiments))
    if folder is not None:
        from forcetorque.report import write_study_folder

        return write_study_folder(folder, answers, experiments=names, progress=progress)
    studies = list(answers)
    return analysis.Studies(
        experiments=names,
        folder=None,
        sensors=tuple(analysis.studied_sensor(one) for one in studies),
        warnings=tuple(sentence for one in studies for sentence in analysis.study_warnings(one)),
    )
