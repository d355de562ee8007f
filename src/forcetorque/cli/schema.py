# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque schema`: the form of files and results, as JSON."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import Any

from forcetorque.errors import ForceTorqueError, known_names


def run(name: str) -> None:
    """Print the schema of a file or a result.

    Args:
        name: What to describe.

    Raises:
        ForceTorqueError: If nothing is called so.
    """
    known: dict[str, Callable[[], dict[str, Any]]] = {
        "experiment": _experiment,
        "acceptance": _acceptance,
        "recording": _recording,
        "calibration": _calibration,
        "accept": _accept,
        "calibrate": _calibrate,
        "compare": _compare,
        "estimate": _estimate,
        "evaluate": _evaluate,
        "export": _export,
        "gains": _gains,
        "inspect": _inspect,
        "payload": _payload,
        "report": _report,
        "scenario": _scenario,
        "simulate": _simulate,
        "sphere": _sphere,
        "study": _study,
        "validate": _validate,
        "view": _view,
    }
    if name not in known:
        raise ForceTorqueError(f"no schema is called {name!r}; {known_names(name, known)}")
    sys.stdout.write(json.dumps(known[name](), indent=2) + "\n")


def _experiment() -> dict[str, Any]:
    from forcetorque.experiment import ExperimentFile

    return ExperimentFile.model_json_schema()


def _acceptance() -> dict[str, Any]:
    from forcetorque.analysis import AcceptanceFile

    return AcceptanceFile.model_json_schema()


def _recording() -> dict[str, Any]:
    from forcetorque.recording import recording_schema

    return recording_schema()


def _calibration() -> dict[str, Any]:
    from forcetorque.calibration import Calibration

    return Calibration.model_json_schema()


def _accept() -> dict[str, Any]:
    from forcetorque.analysis import Acceptance

    return Acceptance.described()


def _calibrate() -> dict[str, Any]:
    from forcetorque.analysis import SensorCalibrations

    return SensorCalibrations.described()


def _compare() -> dict[str, Any]:
    from forcetorque.analysis import Comparison

    return Comparison.described()


def _estimate() -> dict[str, Any]:
    from forcetorque.analysis import EstimateSummary

    return EstimateSummary.described()


def _evaluate() -> dict[str, Any]:
    from forcetorque.analysis import Evaluation

    return Evaluation.described()


def _export() -> dict[str, Any]:
    from forcetorque.analysis import Export

    return Export.described()


def _gains() -> dict[str, Any]:
    from forcetorque.analysis import Gains

    return Gains.described()


def _inspect() -> dict[str, Any]:
    from forcetorque.analysis import Inspection

    return Inspection.described()


def _payload() -> dict[str, Any]:
    from forcetorque.analysis import WeighedLoad

    return WeighedLoad.described()


def _report() -> dict[str, Any]:
    from forcetorque.cli.report.result import ReportResult

    return ReportResult.model_json_schema()


def _scenario() -> dict[str, Any]:
    from forcetorque.simulation.scenario import ScenarioFile

    return ScenarioFile.model_json_schema()


def _simulate() -> dict[str, Any]:
    from forcetorque.experiment.simulated import WrittenScenario

    return WrittenScenario.described()


def _sphere() -> dict[str, Any]:
    from forcetorque.analysis import Spheres

    return Spheres.described()


def _study() -> dict[str, Any]:
    from forcetorque.analysis import Studies

    return Studies.described()


def _validate() -> dict[str, Any]:
    from forcetorque.analysis import Validation

    return Validation.described()


def _view() -> dict[str, Any]:
    from forcetorque.viewer import View

    return View.described()
