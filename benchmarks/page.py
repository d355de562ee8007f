# SPDX-License-Identifier: BSD-3-Clause
"""A page of 30 min of six sensors at 100 Hz, without and with a calibration of each: processor, size, time to open."""

from __future__ import annotations

import statistics
import tempfile
import time
from collections import Counter
from pathlib import Path

from benchmarks.harness import arguments, write_result
from benchmarks.viewer import FLAGS, PATIENCE_MS, humanoid_experiment, in_browser
from forcetorque.calibration.calibrate import calibrate_sensor
from forcetorque.experiment.sensor_run import SensorRun
from forcetorque.simulation.robots import named_robot
from forcetorque.viewer.page import write_page
from forcetorque.viewer.scene_builder import build_scene
from forcetorque.viewer.video import find_browser

SAMPLES, QUICK_SAMPLES = 180_000, 10_000
SENSORS = 6
ROUNDS = 3


def main() -> None:
    """Build both pages, open them and write what it took."""
    options = arguments(__doc__ or "")
    browser = find_browser()
    urdf = named_robot(["iCubGazeboV2_7", "biped"])
    seconds: dict[str, list[float]] = {}
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        samples = QUICK_SAMPLES if options.quick else SAMPLES
        experiment = humanoid_experiment(folder / "log", urdf, samples, sensors=SENSORS)
        fitted = {
            f"{sensor.name}.json": calibrate_sensor(
                SensorRun(experiment, sensor), code_version="benchmark", created="2026-01-01"
            )
            for sensor in experiment.sensors
        }
        build_scene(experiment, {}, urdf=urdf)  # compiles and fills caches
        for case, calibrations in {"prior": {}, "calibrated": fitted}.items():
            processor = time.process_time()
            built = build_scene(experiment, calibrations, urdf=urdf)
            scene = time.process_time() - processor
            size = write_page(folder / f"{case}.html", built)
            figures |= {
                f"scene {case}, processor s": scene,
                f"scene and page {case}, processor s": time.process_time() - processor,
                f"page {case}, MB": size / 1e6,
            }
            seconds[f"ready {case}"], _ = in_browser(built, folder, browser, rounds=ROUNDS)
            figures[f"ready {case}, s"] = statistics.median(seconds[f"ready {case}"])
            opened = [processor_to_open(folder / f"{case}.html", browser) for _ in range(ROUNDS)]
            for kind in ("renderer", "all processes"):
                figures[f"open {case}, {kind}, processor s"] = statistics.median(one[kind] for one in opened)
    for text, value in figures.items():
        print(f"{text}: {value:.3g}")
    write_result(
        options.json,
        ratios={},
        seconds=seconds,
        accuracy={"sensors": SENSORS, "samples": samples},
        rounds=ROUNDS,
        packages=("numpy", "scipy", "trimesh"),
        figures=figures,
    )


def processor_to_open(page: Path, browser: Path) -> dict[str, float]:
    """Open a page in a new browser, until it says that all is drawn.

    Args:
        page: File of the page.
        browser: The browser.

    Returns:
        Seconds of the processor by kind of process, and of all of them, which includes drawing without a graphics card.
    """
    from playwright.sync_api import sync_playwright

    with sync_playwright() as driver:
        program = driver.chromium.launch(executable_path=str(browser), args=list(FLAGS))
        session = program.new_browser_cdp_session()
        window = program.new_context(viewport={"width": 1280, "height": 720}).new_page()
        window.set_default_timeout(PATIENCE_MS)

        def spent() -> Counter[str]:
            used: Counter[str] = Counter()
            for process in session.send("SystemInfo.getProcessInfo")["processInfo"]:
                used[process["type"]] += process["cpuTime"]
                used["all processes"] += process["cpuTime"]
            return used

        before = spent()
        window.goto(page.as_uri())
        window.evaluate("window.ft.ready")
        after = spent()
        program.close()
    return {kind: after[kind] - before[kind] for kind in after}


if __name__ == "__main__":
    main()
