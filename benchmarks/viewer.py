# SPDX-License-Identifier: BSD-3-Clause
"""The viewer on 20 000, 200 000 and 1 000 000 samples: seconds to build, to be ready, to jump; and sizes."""

from __future__ import annotations

import statistics
import tempfile
import time
from contextlib import ExitStack
from pathlib import Path

import numpy as np

from benchmarks.harness import arguments, write_result
from forcetorque.base.errors import ForceTorqueError, MissingFileError
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.formats.icub_matrix import encode_matrix, write_matrix_file
from forcetorque.recording.storage import write_recording
from forcetorque.robot.urdf import read_urdf
from forcetorque.simulation.motions.held_robot import Stand
from forcetorque.simulation.motions.joint_motions import random_movement
from forcetorque.simulation.robots import named_robot
from forcetorque.simulation.sensor_family import FAMILIES
from forcetorque.simulation.simulated_sensor import SimulatedSensor
from forcetorque.simulation.trace import record
from forcetorque.viewer.packing import packed
from forcetorque.viewer.page import ASSETS, BUNDLE, DATA_URL, MOST_SAMPLES, ViewerServer, page_of, write_page
from forcetorque.viewer.scene import scene_json
from forcetorque.viewer.scene_builder import BuiltScene, build_scene
from forcetorque.viewer.video import find_browser, require_playwright

SIZES, QUICK_SIZES = (20_000, 200_000, 1_000_000), (2_000, 20_000)
SHARE = {"calibration": (0.02, 0.5), "validation": (0.5, 0.98)}
"""Parts of the log in the two intervals."""
SENSORS = 2
"""Sensors that are shown."""
JUMPS = 20
"""Samples that are jumped to in each window."""
PATIENCE_MS = 300_000
"""A browser reads a file of 90 MB before it answers."""
FLAGS = ("--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
"""The processor draws, as in the tests."""
JUMP = """samples => samples.map(sample => {
    const start = performance.now();
    window.ft.show(sample);
    for (const canvas of document.querySelectorAll(".robot canvas, .space canvas")) {
        const drawn = canvas.getContext("webgl2"); // a pixel can be read when all is drawn
        drawn?.readPixels(0, 0, 1, 1, drawn.RGBA, drawn.UNSIGNED_BYTE, new Uint8Array(4));
    }
    return (performance.now() - start) / 1000;
})"""
"""Seconds of each jump."""


def main() -> None:
    """Build the scenes and write seconds and sizes."""
    options = arguments(__doc__ or "")
    rounds = 2  # minutes each
    browser = _browser()
    urdf = named_robot(["iCubGazeboV2_7", "biped"])
    seconds: dict[str, list[float]] = {}
    figures: dict[str, float] = {}
    with tempfile.TemporaryDirectory() as name:
        for samples in QUICK_SIZES if options.quick else SIZES:
            experiment = humanoid_experiment(Path(name) / str(samples), urdf, samples)
            warm = not seconds  # the first scene compiles and fills caches
            for number in range(rounds + warm):
                start, processor = time.perf_counter(), time.process_time()
                built = build_scene(experiment, {}, urdf=urdf)
                done, processor = time.perf_counter(), time.process_time() - processor
                size = _page_size(built, Path(name))
                if number or not warm:
                    seconds.setdefault(f"build {samples}", []).append(done - start)
                    seconds.setdefault(f"page {samples}", []).append(time.perf_counter() - done)
            figures |= {
                f"build {samples}, processor s": processor,
                f"block {samples}, MB": len(built.block) / 1e6,
                f"header {samples}, MB": len(scene_json(built.scene)) / 1e6,
                f"page {samples}, MB": size / 1e6,
            }
            if browser is not None:
                ready, jumps = in_browser(built, Path(name), browser, rounds=rounds)
                seconds |= {f"ready {samples}": ready, f"jump {samples}": jumps}
                figures |= {
                    f"ready {samples}, s": statistics.median(ready),
                    f"jump {samples}, ms": 1e3 * statistics.median(jumps),
                    f"slowest jump {samples}, ms": 1e3 * max(jumps),
                }
            print(f"{samples}: {seconds[f'build {samples}']} s, {figures}")
    write_result(
        options.json,
        ratios={},
        seconds=seconds,
        accuracy={"joints": len(built.scene.coordinates), "sensors": len(built.scene.sensors)},
        rounds=rounds,
        packages=("numpy", "scipy", "trimesh"),
        figures=figures,
    )


def _browser() -> Path | None:
    """What is driven; None, and the reason is said, where nothing can be."""
    try:
        require_playwright()
        if any(not (ASSETS / name).is_file() for name in BUNDLE):
            raise MissingFileError("the viewer's bundle is not built")
        return find_browser()
    except ForceTorqueError as error:
        print(f"no times in a browser: {error}")
        return None


def in_browser(built: BuiltScene, folder: Path, browser: Path, *, rounds: int) -> tuple[list[float], list[float]]:
    """Open a page from disk, or from the server where it has too many samples for a file, and jump about in it.

    Args:
        built: The scene.
        folder: Takes the file.
        browser: The browser; a processor draws in place of a graphics card.
        rounds: Times it is opened, each in a new window.

    Returns:
        Seconds until the page says that all is drawn; and of each jump, until every view is drawn.
    """
    from playwright.sync_api import sync_playwright

    ready: list[float] = []
    jumps: list[float] = []
    samples = np.random.default_rng(3).integers(0, built.scene.samples, JUMPS).tolist()
    with ExitStack() as stack:
        if built.scene.samples <= MOST_SAMPLES:
            write_page(folder / "view.html", built)
            url = (folder / "view.html").as_uri()
        else:
            served = packed(built)
            server = ViewerServer(page_of(served, data_url=DATA_URL), served.block, None)
            url = stack.enter_context(server).url
        driver = stack.enter_context(sync_playwright())
        program = stack.enter_context(driver.chromium.launch(executable_path=str(browser), args=list(FLAGS)))
        for _ in range(rounds):
            window = program.new_context(viewport={"width": 1280, "height": 720})
            page = window.new_page()
            page.set_default_timeout(PATIENCE_MS)
            start = time.perf_counter()
            page.goto(url)
            page.evaluate("window.ft.ready")
            ready.append(time.perf_counter() - start)
            jumps += page.evaluate(JUMP, samples)
            window.close()
    return ready, jumps


def _page_size(built: BuiltScene, folder: Path) -> int:
    """Bytes of the file, or of the page that is served where there are too many samples for one."""
    if all((ASSETS / name).is_file() for name in BUNDLE):
        assets = None
    else:  # without the bundle its size is missing
        assets = folder
        (folder / "page.html").write_bytes((ASSETS / "page.html").read_bytes())
        for name in BUNDLE:
            (folder / name).write_text("", encoding="utf-8")
    served = None if built.scene.samples <= MOST_SAMPLES else "data.bin"
    return len(page_of(packed(built), data_url=served, assets=assets))


def humanoid_experiment(
    folder: Path, urdf: Path, samples: int, *, rate_hz: float = 100.0, sensors: int = SENSORS
) -> Experiment:
    """Simulate a humanoid that moves all joints, on its root link.

    Args:
        folder: Folder to make.
        urdf: File of the robot.
        samples: Number of samples.
        rate_hz: Their rate; Hz.
        sensors: Number of sensors.

    Returns:
        The experiment, with one interval for calibration and one for validation.
    """
    folder.mkdir()
    model = read_urdf(urdf)
    stand = Stand(model=model, support=model.root_link, gravity_direction=np.array([0.0, 0.0, -1.0]))
    movement = random_movement(stand, rng=np.random.default_rng(1), duration_s=samples / rate_hz)
    matrix = encode_matrix(np.linalg.inv(FAMILIES["standard"].nominal()))
    write_matrix_file(folder / "matrix_S1.txt", matrix)
    sensor = SimulatedSensor(matrix=matrix.matrix, offset=np.zeros(6), noise_counts=3.0, noise_corner_hz=0.5)
    names = list(model.sensors)[:sensors]
    recording = record(movement, dict.fromkeys(names, sensor), rate_hz=rate_hz, rng=np.random.default_rng(2))
    write_recording(folder / "recording", recording)
    start, end = ((stamp - recording.start_ns) * 1e-9 for stamp in recording.span_ns)
    tables = [
        'schema = "forcetorque/experiment/1"\nname = "benchmark"',
        f'[robot]\nurdf = "{urdf.as_posix()}"',
        '[recording]\nformat = "parquet"\npath = "recording"',
        *(f'[[sensor]]\nname = "{n}"\nstream = "{n}"\nserial = "S1"\nprior = "matrix_S1.txt"' for n in names),
        f'[[support]]\nframe = "{model.root_link}"\ngravity_direction = [0.0, 0.0, -1.0]',
        *(
            f'[[interval]]\nlabel = "{use}"\nstart_s = {start + first * (end - start)}\n'
            f'end_s = {start + last * (end - start)}\nuse = "{use}"\nsupport = "{model.root_link}"'
            for use, (first, last) in SHARE.items()
        ),
    ]
    (folder / "experiment.toml").write_text("\n\n".join(tables) + "\n", encoding="utf-8")
    return load_experiment(folder / "experiment.toml")


if __name__ == "__main__":
    main()
