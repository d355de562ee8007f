# SPDX-License-Identifier: BSD-3-Clause
"""Errors on data that were not fitted, verdicts on loads to come, spheres of gravity, acceptance."""

from typing import TYPE_CHECKING

from forcetorque.base.lazy import lazy_names
from forcetorque.results.capability import Capability

if TYPE_CHECKING:
    from forcetorque.evaluation.acceptance.acceptance import accept as accept
    from forcetorque.evaluation.acceptance.acceptance_file import read_acceptance as read_acceptance
    from forcetorque.evaluation.commands import compare as compare, evaluate as evaluate, validate as validate
    from forcetorque.evaluation.evaluation import Evaluation as Evaluation
    from forcetorque.evaluation.load_cases.verdict import use_verdicts as use_verdicts
    from forcetorque.evaluation.sphere.sphere import spheres as spheres, spheres_of_sensors as spheres_of_sensors
    from forcetorque.evaluation.validation.validation import Validation as Validation
    from forcetorque.experiment.calibrations_under_test import wrench_errors as wrench_errors

CAPABILITY = Capability(
    page="evaluation/use.md",
    needs=(
        "sensor",
        "calibration",
    ),
    commands=(
        "forcetorque.evaluation.commands:accept",
        "forcetorque.evaluation.commands:compare",
        "forcetorque.evaluation.commands:evaluate",
        "forcetorque.evaluation.commands:sphere",
        "forcetorque.evaluation.commands:validate",
    ),
    sections=(
        "forcetorque.evaluation.section:LOAD_CASES",
        "forcetorque.evaluation.section:TRIAL",
    ),
)

__all__, __getattr__, __dir__ = lazy_names(
    __name__,
    Evaluation="forcetorque.evaluation.evaluation",
    Validation="forcetorque.evaluation.validation.validation",
    accept="forcetorque.evaluation.acceptance.acceptance",
    compare="forcetorque.evaluation.commands",
    evaluate="forcetorque.evaluation.commands",
    read_acceptance="forcetorque.evaluation.acceptance.acceptance_file",
    spheres="forcetorque.evaluation.sphere.sphere",
    spheres_of_sensors="forcetorque.evaluation.sphere.sphere",
    use_verdicts="forcetorque.evaluation.load_cases.verdict",
    validate="forcetorque.evaluation.commands",
    wrench_errors="forcetorque.experiment.calibrations_under_test",
)
