# SPDX-License-Identifier: BSD-3-Clause
"""Draw the force space of a sensor: what the model demands, what it measured with its prior.

Usage: python examples/09_force_space.py [OUTPUT.png [SENSOR EXPERIMENT.toml...]]

The picture in docs/simulation.md is `docs/images/force_space.png l_leg_ft` of grid.toml and bsl_2.toml of
`forcetorque simulate icub-insitu`. Other logs, such as examples/02_icub_yoga_forward.toml, are drawn the same way.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np

from forcetorque.app.python.experiment import load_experiment
from forcetorque.estimation.estimate import estimate_experiment
from forcetorque.evaluation.figures.sphere import force_space_figure
from forcetorque.experiment.offsets import corrections_of
from forcetorque.results.figure_style import png_bytes


def main() -> None:
    """Draw one row per experiment, all its intervals together."""
    parser = argparse.ArgumentParser(description="Draw expected and measured forces of a sensor.")
    parser.add_argument("output", nargs="?", type=Path, default=Path("force_space.png"), help="picture to write (PNG)")
    parser.add_argument(
        "sensor", nargs="?", default="r_leg_ft_sensor", help="name of the sensor (default: %(default)s)"
    )
    parser.add_argument(
        "experiments",
        nargs="*",
        type=Path,
        default=[Path(__file__).with_name("02_icub_yoga_forward.toml")],
        help="experiment files (TOML), one row each (default: that of the iCub on one foot)",
    )
    arguments = parser.parse_args()
    sensor = arguments.sensor
    clouds = {}
    for file in arguments.experiments:
        experiment = load_experiment(file)
        spans = estimate_experiment(experiment, corrections_of(experiment, {}))
        measured = np.concatenate([span.measured.of_name(sensor)[:, :3] for span in spans])
        expected = np.concatenate([span.estimates.expected_of(sensor)[:, :3] for span in spans])
        clouds[experiment.name] = [("prior", measured), ("expected", expected)]
    arguments.output.write_bytes(png_bytes(force_space_figure(clouds)))


if __name__ == "__main__":
    main()
