# SPDX-License-Identifier: BSD-3-Clause
"""Take a picture of the first page of a report, of simulated recordings.

Usage: python examples/13_report_page_one.py [OUTPUT.png FOLDER]

Simulates a humanoid into FOLDER, calibrates the sensor of its left leg from three motions and from one, writes the
report on another day's recording, and opens it in the browser of the system (chromium or chrome). The picture in
docs/report.md is `docs/images/report_page_one.png build/report_page_one`.
"""

from __future__ import annotations

import argparse
import shutil
import subprocess
import sys
from pathlib import Path

BROWSERS = ("chromium", "chromium-browser", "google-chrome")
SIZE = "1180,1600"
"""Width and height of the page, in pixels: down to the first headings of what is folded."""
SENSOR = "l_leg_ft"
USE = """schema = "forcetorque/acceptance/1"
name = "standing on one leg"

[[load_case]]
name = "one leg"
weight_on = "l_sole"
radius_m = 0.05
offset = "tared"
"""
"""What the sensor is to be used for."""


def main() -> None:
    """Simulate, calibrate, report, and take the picture."""
    parser = argparse.ArgumentParser(description="Take a picture of the first page of a report.")
    parser.add_argument("output", nargs="?", type=Path, default=Path("page_one.png"), help="picture to write (PNG)")
    parser.add_argument(
        "folder",
        nargs="?",
        type=Path,
        default=Path("page_one"),
        help="folder to make for recordings, calibrations and report",
    )
    arguments = parser.parse_args()
    output, folder = arguments.output.resolve(), arguments.folder.resolve()
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        sys.exit(f"no browser to take the picture with: none of {', '.join(BROWSERS)} is installed")
    forcetorque(folder.parent, "simulate", "icub-insitu", "-o", folder.name)
    three = ("grid.toml", "tz.toml", "bsl.toml")
    forcetorque(folder, "calibrate", *three, "--sensor", SENSOR, "-o", "three_motions.json")
    forcetorque(folder, "calibrate", "bsl.toml", "--sensor", SENSOR, "-o", "one_motion.json")
    (folder / "use.toml").write_text(USE, encoding="utf-8")
    files = ("bsl_day2.toml", "use.toml", "three_motions.json", "one_motion.json")
    forcetorque(folder, "report", *files, "--title", "Left leg of a simulated humanoid", "-o", "report.html")
    # the page is the only thing that it opens, and it has no script
    flags = ("--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars", f"--window-size={SIZE}")
    page = (folder / "report.html").as_uri()
    subprocess.run([browser, *flags, f"--screenshot={output}", page], check=True, capture_output=True)


def forcetorque(folder: Path, *words: str) -> None:
    """Run a command of the library in a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, "-m", "forcetorque", *words], cwd=folder, check=True)


if __name__ == "__main__":
    main()
