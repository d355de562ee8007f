# SPDX-License-Identifier: BSD-3-Clause
"""The viewer as a section of a document."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from forcetorque.calibration import Calibration
from forcetorque.errors import ForceTorqueError
from forcetorque.experiment import Experiment
from forcetorque.report.document import Page, Section
from forcetorque.viewer import MOST_SAMPLES, page_of, scene_of


def viewer_section(path: Path, experiment: Experiment, calibrations: Mapping[str, Calibration]) -> Section:
    """Put the viewer of an experiment into a section.

    Args:
        path: Experiment file.
        experiment: What it points to.
        calibrations: Calibrations by their file.

    Returns:
        The section.

    Raises:
        ForceTorqueError: If there are too many samples for one file.
    """
    built = scene_of(path, experiment, calibrations)
    if built.scene.samples > MOST_SAMPLES:
        raise ForceTorqueError(
            f"--viewer: expected at most {MOST_SAMPLES} samples inside a document, got {built.scene.samples}; leave it "
            "out and serve them with `forcetorque view`"
        )
    page = Page(
        html=page_of(built),
        title=f"Viewer of {experiment.name}",
        instead=f"The HTML file has a viewer here; `forcetorque view {path}` opens it too.",
    )
    return Section(title=f"Posture and forces: {experiment.name}", blocks=(page,))
