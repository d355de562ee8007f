# SPDX-License-Identifier: BSD-3-Clause
"""Study a sensor of several experiments, and make calibrations of the best candidates."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from forcetorque.base.errors import ExperimentError, known_names
from forcetorque.experiment.calibration.artefact import Calibration
from forcetorque.experiment.calibration.estimation_type import EstimationType
from forcetorque.experiment.campaign_intervals import CampaignInterval
from forcetorque.experiment.offset_policy import KNOWN_BEFORE
from forcetorque.study.best_calibrations import CalibrationMaker
from forcetorque.study.data import StudyData, generative_fits
from forcetorque.study.one_sensor import Study, run_study

_MOST_KINDS = 6
"""Kinds of data whose combinations are all tried; 63 of them."""


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class SensorStudy:
    """A study and the calibrations that it recommends."""

    data: StudyData
    """What was studied."""
    study: Study
    """The study."""
    calibrations: Mapping[str, Calibration]
    """Best candidates: by magnitude and by axis, with the offset from the first second and with the fitted one."""
    left_out: tuple[str, ...]
    """Types that a combination cannot give, with the reason."""


def study_sensor(
    data: StudyData,
    *,
    data_sets: Mapping[str, Sequence[str]] | None,
    kinds: Sequence[EstimationType],
    lambdas: Sequence[float],
    sphere: Collection[str] | None,
    code_version: str,
    created: str,
    progress: Callable[[str], None] | None = None,
) -> SensorStudy:
    """Fit and judge every candidate, and make calibrations of the best.

    Args:
        data: Samples of the sensor.
        data_sets: Labels or kinds of the intervals that are fitted together, by name; None for every combination of
            kinds.
        kinds: Estimation types; those with variables are left out for a sensor without.
        lambdas: Lambdas of (5.4); counts2.
        sphere: Labels of the intervals that draw the sphere; None for what the files say.
        code_version: Version of this library, for the record.
        created: Date and time, ISO 8601, for the record.
        progress: Called with a line for people at every step.

    Returns:
        The study with its calibrations.

    Raises:
        ExperimentError: If all types need variables that the sensor has not, or combinations cannot be made.
        FitError: If there is nothing to judge on, or nothing can be fitted.
    """
    has_variables = bool(data.sensor.variables)
    chosen_kinds = [kind for kind in kinds if has_variables or not kind.with_variables]
    if kinds and not chosen_kinds:
        raise ExperimentError(
            f"{', '.join(kind.name for kind in kinds)} need a linear variable such as temperature, and the experiment "
            "files state none; give [[sensor.variable]], or ask for a type without"
        )
    drawing = data.sphere if sphere is None else tuple(sphere)
    named = combinations_of(data.calibration) if data_sets is None else _resolved(data.calibration, data_sets)
    generative = generative_fits(data, named, code_version=code_version, created=created)
    study = run_study(
        [interval.data_set for interval in data.calibration],
        named,
        [interval.validation_set for interval in data.validation],
        prior=data.sensor.prior,
        variables=[variable.linear for variable in data.sensor.variables],
        kinds=chosen_kinds,
        lambdas=lambdas,
        sphere=drawing,
        generative=generative.candidates,
        truth=data.truth,
        progress=progress,
    )
    maker = CalibrationMaker(
        data=data,
        study=study,
        generative=generative.calibrations,
        sphere=drawing,
        code_version=code_version,
        created=created,
    )
    calibrations = {}
    for offset in KNOWN_BEFORE:
        calibrations[f"best_offset_{offset.replace('-', '_')}"] = maker.by_magnitude(offset)
        calibrations[f"best_by_axis_offset_{offset.replace('-', '_')}"] = maker.by_axis(offset)
    left_out = (*study.fits.left_out, *generative.left_out)
    return SensorStudy(data=data, study=study, calibrations=calibrations, left_out=left_out)


def combinations_of(intervals: Sequence[CampaignInterval]) -> dict[str, tuple[str, ...]]:
    """Combine the kinds of data in every way.

    Args:
        intervals: Calibration intervals.

    Returns:
        Labels by the name of the combination, fewest kinds first.

    Raises:
        ExperimentError: If there are no intervals, or too many kinds to try every combination.
    """
    kinds = list(dict.fromkeys(interval.kind for interval in intervals))
    if not kinds:
        raise ExperimentError('expected at least one interval with use = "calibration", got none')
    if len(kinds) > _MOST_KINDS:
        raise ExperimentError(
            f"expected at most {_MOST_KINDS} kinds of data to try every combination, got {len(kinds)}: "
            f"{', '.join(kinds)}; name combinations with --data-set, from Python data_sets, or give "
            "intervals a kind"
        )
    return {
        " + ".join(chosen): tuple(interval.label for interval in intervals if interval.kind in chosen)
        for size in range(1, len(kinds) + 1)
        for chosen in combinations(kinds, size)
    }


def _resolved(
    intervals: Sequence[CampaignInterval], data_sets: Mapping[str, Sequence[str]]
) -> dict[str, tuple[str, ...]]:
    """From labels and kinds to labels."""
    labels, kinds = [interval.label for interval in intervals], {interval.kind for interval in intervals}
    for name, words in data_sets.items():
        for word in words:
            if word not in labels and word not in kinds:
                known = known_names(word, [*labels, *sorted(kinds)])
                raise ExperimentError(f"data set {name!r}: no calibration interval or kind is called {word!r}; {known}")
    return {
        name: tuple(interval.label for interval in intervals if interval.label in words or interval.kind in words)
        for name, words in data_sets.items()
    }
