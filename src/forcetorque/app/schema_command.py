# SPDX-License-Identifier: BSD-3-Clause
"""`forcetorque schema`: the form of files and results, as JSON."""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
from typing import Annotated, Any

import typer

from forcetorque.base.errors import ForceTorqueError, require_known


def schema(
    name: Annotated[
        str,
        typer.Argument(
            help="experiment, acceptance, bench, contestants, device_file, torque_loop_file, load_cases, "
            "sensor_catalogue, scenario, fleet_plan, "
            "recording, calibration, joint, moments, taxels or module_frames for a file; a command, with _ for its "
            "space, for its result."
        ),
    ],
) -> None:
    """Print the JSON schema of a file or of a command's result.

    Example: forcetorque schema experiment

    Python: `evaluation.Evaluation.described()`, and so of every answer
    """
    known = _files()
    if name not in known:  # results are found by importing the whole library, which takes longer
        known |= _results()
    _require(name, known)
    sys.stdout.write(json.dumps(known[name](), indent=2) + "\n")


def _require(name: str, known: dict[str, Callable[[], dict[str, Any]]]) -> None:
    require_known(name, known, ForceTorqueError, f"no schema is called {name!r}")


def _files() -> dict[str, Callable[[], dict[str, Any]]]:
    from forcetorque.contests.contest_file import ContestFile
    from forcetorque.device.device_file import DeviceFile
    from forcetorque.evaluation.acceptance.acceptance_file import AcceptanceFile
    from forcetorque.experiment.calibration.calibration_file import Calibration
    from forcetorque.experiment.calibration.joint_posterior_and_robot_correction import JointPosterior
    from forcetorque.experiment.calibration.stored_moments import RecordingMoments
    from forcetorque.experiment.experiment_file import experiment_file
    from forcetorque.experiment.workbench_file import BenchFile
    from forcetorque.fleet.plan_file import PlanFile
    from forcetorque.locomotion.torque_control.torque_loop_file import TorqueLoopFile
    from forcetorque.recording.storage import recording_schema
    from forcetorque.sensor.catalogue import CatalogueFile
    from forcetorque.sensor.choice.load_case import LoadCaseFile
    from forcetorque.simulation.scenario.scenario_file import ScenarioFile
    from forcetorque.skin.layout.formats.urdf_frames import ModuleFrames
    from forcetorque.skin.taxels.patch_calibration_and_pressure_table import PatchCalibration

    return {
        "experiment": experiment_file().model_json_schema,
        "acceptance": AcceptanceFile.model_json_schema,
        "bench": BenchFile.model_json_schema,
        "device_file": DeviceFile.model_json_schema,
        "contestants": ContestFile.model_json_schema,
        "torque_loop_file": TorqueLoopFile.model_json_schema,
        "load_cases": LoadCaseFile.model_json_schema,
        "sensor_catalogue": CatalogueFile.model_json_schema,
        "scenario": ScenarioFile.model_json_schema,
        "fleet_plan": PlanFile.model_json_schema,
        "recording": recording_schema,
        "calibration": Calibration.model_json_schema,
        "joint": JointPosterior.model_json_schema,
        "moments": RecordingMoments.model_json_schema,
        "taxels": PatchCalibration.model_json_schema,
        "module_frames": ModuleFrames.model_json_schema,
    }


def _results() -> dict[str, Callable[[], dict[str, Any]]]:
    import forcetorque
    from forcetorque.results.result import result_classes

    results = result_classes(forcetorque)
    return {name: kind.described for name, kind in results.items()}
