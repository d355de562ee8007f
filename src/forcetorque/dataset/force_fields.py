# SPDX-License-Identifier: BSD-3-Clause
"""Forces, moments and orientations in the features of a dataset, found by the names of features and elements."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from os.path import commonprefix

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, known_names
from forcetorque.base.units import STANDARD_GRAVITY
from forcetorque.base.wrench import WRENCH_COMPONENTS
from forcetorque.formats.headings import read_heading
from forcetorque.formats.lerobot.dataset import INFO, Feature, LeRobotDataset
from forcetorque.inspection.draft.column_matches import FORMS_OF_THREE, array_words, column_matches
from forcetorque.recording.orientation import OrientationForm, OrientationLayout, OrientationSense, orientation_signals

_WORDS = {"wrench", "force", "forces", "torque", "torques", "moment", "moments", "effort", "ft", "tau"}
_OF_ERRORS = {"std", "stddev", "sigma", "covariance"}
"""Words of features that are errors of forces."""
_COMMANDED = "action"
"""What the names of features begin with that were commanded, not measured."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ForceField:
    """Elements of a dataset that are one force, wrench or set of joint torques."""

    name: str
    """Name, such as `observation.wrench`."""
    labels: tuple[str, ...]
    """Its elements in the dataset, of a wrench force, then moment."""
    is_wrench: bool
    """Whether the names say that it is a force and a moment."""

    @property
    def components(self) -> tuple[str, ...]:
        """Short names of its elements."""
        return WRENCH_COMPONENTS if self.is_wrench else tuple(label.rpartition(".")[2] for label in self.labels)

    @property
    def units(self) -> tuple[str | None, ...]:
        """Unit that the name of each element states; None for none."""
        return tuple(read_heading(label).unit for label in self.labels)


def force_fields(dataset: LeRobotDataset, names: Sequence[str] = ()) -> tuple[ForceField, ...]:
    """Find the forces that a dataset measured.

    Args:
        dataset: The dataset.
        names: Features to take in place of those whose names say so.

    Returns:
        Wrenches first, then other features.

    Raises:
        FormatError: If a name is of no feature, or no feature is a force.
    """
    for name in names:
        dataset.feature(name)
    wrenches = [one for one in _wrenches(dataset) if not names or _feature_of(dataset, one).name in names]
    covered = {label for one in wrenches for label in one.labels}
    others = [
        ForceField(name=feature.name, labels=feature.labels, is_wrench=False)
        for feature in dataset.numeric_features
        if not covered & set(feature.labels) and (feature.name in names if names else _is_force(feature))
    ]
    if not wrenches and not others:
        known = ", ".join(feature.name for feature in dataset.numeric_features)
        raise FormatError(
            f"{dataset.root / INFO}: expected a feature whose name, or those of its elements, say that it is a force, "
            f"got {known or 'no numbers'}; name it with --feature"
        )
    return (*wrenches, *others)


def wrench_field(dataset: LeRobotDataset, name: str | None) -> ForceField:
    """Find the one wrench to compensate.

    Args:
        dataset: The dataset.
        name: Name of its feature; the only wrench of the dataset if None.

    Returns:
        The wrench.

    Raises:
        FormatError: If there is none, or several and no name.
    """
    wrenches = {one.name: one for one in _wrenches(dataset)}
    if name is None and len(wrenches) == 1:
        return next(iter(wrenches.values()))
    if name in wrenches:
        return wrenches[str(name)]
    if name is not None and (feature := dataset.feature(name)).elements == len(WRENCH_COMPONENTS) and not feature.names:
        return ForceField(name=name, labels=feature.labels, is_wrench=True)
    raise FormatError(
        f"{dataset.root / INFO}: expected one wrench, whose elements are named fx fy fz tx ty tz, got "
        f"{known_names(name or '', wrenches)}; name it with --feature"
    )


def any_field(dataset: LeRobotDataset, name: str | None) -> ForceField:
    """Find the raw measurement that a calibration reads.

    Args:
        dataset: The dataset.
        name: Name of its feature; the only wrench of the dataset if None.

    Returns:
        The field.
    """
    if name is None:
        return wrench_field(dataset, None)
    return ForceField(name=name, labels=dataset.feature(name).labels, is_wrench=False)


def _wrenches(dataset: LeRobotDataset) -> Iterator[ForceField]:
    labels = [label for label, (feature, _) in dataset.labels.items() if not feature.name.startswith(_COMMANDED)]
    for match in column_matches([read_heading(label) for label in labels], ()):
        if match.quantity != "wrench":
            continue
        chosen = tuple(labels[k] for k in match.columns)
        features = {dataset.labels[label][0].name for label in chosen}
        whole = len(features) == 1 and dataset.features[next(iter(features))].elements == len(chosen)
        prefix = commonprefix([read_heading(label).name.lower() for label in chosen])
        name = next(iter(features)) if whole else chosen[0][: len(prefix)].rstrip("._")
        yield ForceField(name=name, labels=chosen, is_wrench=True)


def _feature_of(dataset: LeRobotDataset, field: ForceField) -> Feature:
    return dataset.labels[field.labels[0]][0]


def _is_force(feature: Feature) -> bool:
    words = set(array_words(feature.name))
    return not feature.name.startswith(_COMMANDED) and bool(_WORDS & words) and not _OF_ERRORS & words


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class OrientationField:
    """Elements of a dataset that are the orientation of the sensor."""

    name: str
    """Name of the feature."""
    labels: tuple[str, ...]
    """Its elements, in the order of the layout."""
    layout: OrientationLayout
    """What they mean."""

    def turned(self, values: FloatArray, place: str) -> tuple[FloatArray, FloatArray]:
        """Give orientations and gravity.

        Args:
            values: Orientations; shape (n, k); a row with a gap is none.
            place: What is named in front of errors.

        Returns:
            `world_R_sensor`, shape (n, 3, 3); and gravity along the axes of the sensor, shape (n, 3), m/s2; NaN where
            there is no orientation.

        Raises:
            FormatError: If a row is no orientation.
        """
        signals, _ = orientation_signals(
            np.where(np.isfinite(values).all(axis=1, keepdims=True), values, np.nan),
            self.layout,
            unit="1",
            frame="sensor",
            stream=self.name,
            place=lambda row: f"{place}: frame {row}",
        )
        turned = np.asarray(signals["orientation"].values).reshape(-1, 3, 3)
        return turned, np.asarray(signals["gravity"].values)


def orientation_candidates(dataset: LeRobotDataset) -> dict[str, tuple[tuple[str, ...], OrientationForm]]:
    """Find the orientations that a dataset has by the names of its elements.

    Args:
        dataset: The dataset.

    Returns:
        Elements and form, by the name of the feature or group.
    """
    labels = [label for label, (feature, _) in dataset.labels.items() if not feature.name.startswith(_COMMANDED)]
    found: dict[str, tuple[tuple[str, ...], OrientationForm]] = {}
    for match in column_matches([read_heading(label) for label in labels], ()):
        if match.quantity == "orientation" and match.form not in (None, *FORMS_OF_THREE):
            chosen = tuple(labels[k] for k in match.columns)
            found[dataset.labels[chosen[0]][0].name] = (chosen, OrientationForm(match.form))
    return found


def orientation_field(
    dataset: LeRobotDataset,
    name: str | None,
    sense: OrientationSense | str | None,
    form: OrientationForm | str | None = None,
    *,
    gravity: float = STANDARD_GRAVITY,
) -> OrientationField:
    """Find the orientation of the sensor.

    Args:
        dataset: The dataset.
        name: Name of the feature; the only one whose elements are named as those of an orientation if None.
        sense: What its rotation does; never inferred.
        form: How it is written; by the names of its elements if None.
        gravity: Magnitude of gravity; m/s2.

    Returns:
        The orientation; things fall along -z of its world.

    Raises:
        FormatError: If it is not there, or its form or sense is not known.
    """
    known = orientation_candidates(dataset)
    where = f"{dataset.root / INFO}"
    if name is None and len(known) != 1:
        raise FormatError(
            f"{where}: expected one orientation, by elements such as qx qy qz qw, {known_names('', known)}; name the "
            "feature with --orientation"
        )
    chosen = name if name is not None else next(iter(known))
    if sense is None:
        raise FormatError(
            f"{where}: {chosen}: expected --sense, sensor_to_world if it turns vectors along the sensor's axes to the "
            "world's, else world_to_sensor; the format does not say"
        )
    if chosen in known and form is None:
        labels, written = known[chosen]
    elif form is not None:
        forms = [one for one in OrientationForm if one not in FORMS_OF_THREE]
        if form not in forms:
            raise FormatError(
                f"{where}: {chosen}: expected the form {', '.join(forms)}, got {form}; of angles and rotation vectors "
                "the dataset states no unit: write quaternions"
            )
        labels, written = dataset.feature(chosen).labels, OrientationForm(form)
    else:
        dataset.feature(chosen)
        raise FormatError(
            f"{where}: {chosen}: expected --form, such as quat_xyzw or quat_wxyz, for its elements are not named qx qy "
            "qz qw; the format does not say"
        )
    layout = OrientationLayout(form=written, sense=OrientationSense(sense), gravity=gravity)
    if layout.count != len(labels):
        raise FormatError(f"{where}: {chosen}: expected {layout.count} numbers of {written}, got {len(labels)}")
    return OrientationField(name=chosen, labels=labels, layout=layout)
