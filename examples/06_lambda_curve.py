# SPDX-License-Identifier: BSD-3-Clause
"""Judge every lambda on the validation intervals of an experiment, beside what the held-out rule saw.

Usage: python examples/06_lambda_curve.py [EXPERIMENT.toml]

The rule chooses lambda from the fitted data alone; this table shows afterwards what the choice was worth.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from forcetorque.calibration.thesis.calibrate import calibrate
from forcetorque.experiment.calibrations_under_test import wrench_errors
from forcetorque.experiment.evaluated_wrenches import offset_removed
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.recording.alignment import seconds_since
from forcetorque.recording.recording import Use


def show_curve(run: SensorRun) -> None:
    """Print the held-out and the judged error of every candidate lambda of one sensor."""
    sensor, judged = run.sensor, run.samples(Use.VALIDATION)
    fitted = [interval.data_set for interval in run.samples(Use.CALIBRATION)]
    raw = np.concatenate([interval.raw for interval in judged])
    reference = np.concatenate([interval.samples.reference for interval in judged])
    stamps = np.concatenate([interval.samples.stamp_ns for interval in judged])
    time = seconds_since(stamps, int(stamps[0]))
    curve = calibrate(fitted, sensor.prior).curve
    if curve is None:
        raise SystemExit(f"{sensor.name}: no prior, so there is no lambda to choose")
    print(f"{run.experiment.name}: {sensor.name} ({sensor.serial}), {len(raw)} judged samples")
    print("    lambda  held-out   worst /     judged force error, N  judged moment error, N m")
    print("   counts2      RMSE     prior    offset as fitted, mean of the judged samples off")
    for regularisation, held_out, ratio in zip(
        curve.regularisations, curve.held_out_error, curve.worst_ratio, strict=True
    ):
        fit = calibrate(fitted, sensor.prior, regularisation=float(regularisation)).fit
        measured = raw @ fit.matrix.T + fit.offset
        own = wrench_errors(measured, reference, time)
        moved = wrench_errors(offset_removed(measured, reference), reference, time)
        mark = "  <- chosen" if regularisation == curve.chosen else ""
        judged_errors = (own.force_mean, moved.force_mean, own.moment_mean, moved.moment_mean)
        columns = "".join(f"{value:10.3f}" for value in (held_out, ratio, *judged_errors))
        print(f"{regularisation:10.3g}{columns}{mark}")


def main(path: Path) -> None:
    """Show the curve of every sensor of an experiment."""
    experiment = load_experiment(path)
    for sensor in experiment.sensors:
        show_curve(SensorRun(experiment, sensor))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Evaluate every lambda on the validation intervals of an experiment.")
    parser.add_argument(
        "experiment",
        nargs="?",
        type=Path,
        default=Path(__file__).with_name("02_icub_yoga_forward.toml"),
        help="experiment file (TOML) with a validation interval (default: %(default)s)",
    )
    main(parser.parse_args().experiment)
