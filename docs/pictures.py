# SPDX-License-Identifier: BSD-3-Clause
"""Draw pictures of the documentation, of simulated data alone: `python -m docs.pictures [FOLDER [NAME ...]]`.

They are what the commands of the pages draw, in fewer colours. `tests/test_pictures.py` draws them again and compares.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
from collections.abc import Collection, Iterable
from itertools import product
from pathlib import Path

import numpy as np
from PIL import Image

from docs.sketches import SKETCHES
from forcetorque.app import motion_of_arrays
from forcetorque.dataset import check_dataset
from forcetorque.estimation.figures import torque_figure
from forcetorque.estimation.torque.covariance_fusion import fuse
from forcetorque.estimation.torque.torque_source import TorqueSource
from forcetorque.results.figure_style import headline, in_figure_style, new_figure, png_bytes
from forcetorque.results.visual_roles import CALIBRATIONS, EXPECTED, PRIOR
from forcetorque.simulation.scenario.scenario_file import bundled_scenario
from forcetorque.skin.layout.layout import SkinLayout
from forcetorque.skin.simulation.recordings import TaxelResponses
from forcetorque.skin.simulation.temperature import HeatResponses, Warmth, warm_recording
from forcetorque.skin.temperature.taxel_temperature_drift import HeatGains
from forcetorque.skin.temperature.warm_up_calibration import fit_warm_up
from tests.formats.lerobot.datasets import tool_episodes, write_dataset

ROOT = Path(__file__).resolve().parents[1]
IMAGES = ROOT / "docs" / "images"
SHOWN = 2900
"""Sample of the picture of the viewer, in which the robot stands on one leg."""
FLAGS = ("--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader")
"""The processor draws, as in the tests."""
COLOURS, SHARES = (40, 32, 24, 16), (1.0, 0.8)
"""Colours and size of a picture: the first by which it has at most `MOST_BYTES`."""
VIEWER_COLOURS = (120,)
"""The same of the viewer, whose grounds take other colours with fewer."""
MOST_BYTES = 60_000
DEMO = ["-m", "forcetorque", "demo", "-o", "."]
BENCH, SKIN, PLATES, CONTEST, CELLS, TOOLS = (
    [str(ROOT / "examples" / f"{name}.py"), "."]
    for name in ("29_bench", "30_skin", "31_plates", "19_contest", "34_cell_grid", "27_arm_and_tools")
)
DAYS = ["-m", "forcetorque", "simulate", "days.toml", "-o", "days"]
SWAY = ["-m", "forcetorque", "simulate", "sway.toml", "-o", "sway"]
TUTORIAL = ["-m", "forcetorque", "calibrate", "tutorial.toml", "-o", "new.json"]
DEVICE = ["-m", "forcetorque", "bench", "device", "--figures", "device"]
SWITCHING = ["-m", "forcetorque", "simulate", "switching", "-o", "switching"]
POLE = "--serial FP2 --measure-direction parent_to_child --tip pole_tip --head pole_head --load-cell load_cell"
LIMITS = """schema = "forcetorque/acceptance/1"
name = "arm sensor"
[evaluate]
force_error_mean_N = 1.0
moment_error_mean_Nm = 0.05
rmse = [0.15, 0.15, 0.05, 0.05, 0.05, 0.01]
[validate]
force_mean_N = 0.5
"""
FLEET = """schema = "forcetorque/fleet_plan/1"
dataset = "fleet"
calibrations = "calibrations"
[[recordings]]
experiments = "days/*.toml"
"""
TUTORIAL_LOG = f"""schema = "forcetorque/experiment/1"
name = "tutorial"
[robot]
urdf = "{ROOT / "docs/tutorial/robot.urdf"}"
[recording]
format = "tabular"
path = "{ROOT / "docs/tutorial"}"
[[recording.stream]]
name = "log"
file = "log.csv"
stamp = {{ column = "time_s", unit = "s" }}
[[recording.stream.signal]]
quantity = "position"
columns = ["shoulder_yaw_rad", "shoulder_pitch_rad", "shoulder_roll_rad", "elbow_rad", "wrist_rad"]
units = ["rad", "rad", "rad", "rad", "rad"]
names = ["shoulder_yaw", "shoulder_pitch", "shoulder_roll", "elbow", "wrist"]
[[recording.stream.signal]]
quantity = "wrench"
columns = ["fx_N", "fy_N", "fz_N", "tx_Nm", "ty_Nm", "tz_Nm"]
units = ["N", "N", "N", "N m", "N m", "N m"]
frame = "ft_sensor"
[[sensor]]
name = "ft_sensor"
stream = "log"
serial = "FT-28"
prior = "identity"
full_scale = [200, 200, 200, 20, 20, 20]
joint = "arm_ft_joint"
measure_direction = "child_to_parent"
[[support]]
frame = "base"
gravity_direction = [0.0, 0.0, -1.0]
"""
PICTURES = {
    "before_and_after": (DEMO, "before_and_after.png"),
    "learnt": (DEMO, "calibrate experiment.toml -o again.json --figure {}"),
    "joint_torques": (DEMO, "estimate experiment.toml -c calibration.json -o samples.parquet --figure {}"),
    "sphere": (DEMO, "study sphere experiment.toml -c calibration.json --figure {}"),
    "gains": (DEMO, "bench gains experiment.toml --figure {}"),
    "use": (DEMO, "evaluate experiment.toml -c calibration.json --figure {}"),
    "plan": (DEMO, "plan experiment.toml --clearance-deg 5 --figure {}"),
    "acceptance": (DEMO, "accept experiment.toml -c calibration.json --spec limits.toml --figure {}"),
    "choice": (DEMO, "bench sensor --force 0,0,500 --lever 0,0.01,0 --figure {}"),
    "payload": (DEMO, f"payload {ROOT / 'docs/tutorial/ur_recording.csv'} --figure {{}}"),
    "device_motion": (DEVICE, "device/motion.png"),
    "device_options": (DEVICE, "device/options.png"),
    "device_envelope": (DEVICE, "device/envelope.png"),
    "coherence": (SWITCHING, "robot coherence switching/switching_day1.toml --figure {}"),
    "balance": (SWITCHING, "robot balance switching/switching_day1.toml --figure {}"),
    "sessions": (
        SWITCHING,
        "bench drift switching/switching_day1.toml switching/switching_day2.toml --sensor l_leg_ft --figure {}",
    ),
    "live": (
        DAYS,
        "live calibrations/l_leg_ft_SIM003.json --replay days/switching_day3.toml --speed 0 --rate 100 --lines none "
        "--offset tracked --figure {}",
    ),
    "fleet": (DAYS, "fleet run fleet.toml --workers 1 --figure {}"),
    "fleet_over_time": (DAYS, "fleet report fleet -c calibrations --figure {}"),
    "joint": (SWAY, "calibrate sway/sway_day1.toml sway/stepping_day1.toml --jointly -o joint --figure {}"),
    "findings": (TUTORIAL, "inspect tutorial.toml --figure {}"),
    "push": (TUTORIAL, "evaluate tutorial.toml -c new.json --figure {}"),
    "collisions": (TUTORIAL, "robot collisions pushed.toml -c new.json --figure {}"),
    "tools": (TOOLS, "payload gripper.toml weight.toml --figure {}"),
    "cells": (CELLS, "skin wrench weights.toml --table palm.json --figure {}"),
    "contest": (CONTEST, "bench contest contest.toml --figure {}"),
    "plates": (PLATES, f"bench fit-plate pole.c3d {POLE} -o FP2.json --figure {{}}"),
    "response": (BENCH, "bench response taps.toml --excitation impact --force log --figure {}"),
    "workbench": (BENCH, "bench workbench weights.toml --figure {}"),
    "temperature": (BENCH, "bench thermal warm.toml --figure {}"),
    "skin_layout": (SKIN, "skin check shank.csv --figure {}"),
    "taxels": (SKIN, "skin calibrate fit.toml -o taxels.json --figure {}"),
    "skin_contacts": (SKIN, "skin wrench touched.toml --table shank.json --figure {}"),
}
"""By name what makes the data, and the command that draws it, or the file where that is drawn too."""
BEFORE = {
    "skin_contacts": "skin calibrate fit.toml -o shank.json",
    "cells": "skin calibrate plate.toml again.toml -o palm.json",
    "live": "fleet run fleet.toml --workers 1",
    "fleet_over_time": "fleet run fleet.toml --workers 1",
}
"""Commands that come first."""


def draw(folder: Path, pictures: Collection[str] = PICTURES.keys()) -> None:
    """Draw pictures of commands.

    Args:
        folder: Folder for the files.
        pictures: Names of those to draw.
    """
    with tempfile.TemporaryDirectory() as name:
        for picture in pictures:
            data, command = PICTURES[picture]
            place = Path(name) / "_".join(Path(word).stem for word in data)
            if not place.exists():
                place.mkdir()
                for file, text in _files().items():
                    (place / file).write_text(text, encoding="utf-8")
                _run(data, place)
            if picture in BEFORE:
                _run(["-m", "forcetorque", *BEFORE[picture].split()], place)
            if command.endswith(".png"):
                drawn = place / command
            else:
                drawn = place / f"{picture}.png"
                _run(["-m", "forcetorque", *command.format(drawn.name).split()], place)
            (folder / f"{picture}.png").write_bytes(_small(drawn.read_bytes()))


def _files() -> dict[str, str]:
    """Files that commands read beside what the data hold."""
    calibration = _intervals("calibration", (0.1, 23.6), (31.3, 45.1))
    free, pushed = (45.2, 63.8), (23.6, 31.3)
    day_2 = _recordings("switching")["switching_day2"]
    days = [_recordings("switching")["switching_day1"], *(day_2.replace("2", str(day)) for day in (2, 3, 4))]
    sway = [_recordings("stance")[name] for name in ("sway_day1", "stepping_day1")]
    return {
        "limits.toml": LIMITS,
        "fleet.toml": FLEET,
        "tutorial.toml": TUTORIAL_LOG + calibration + _intervals("validation", free),
        "pushed.toml": TUTORIAL_LOG + calibration + _intervals("validation", pushed, free),
        "days.toml": _scenario("switching", days),
        "sway.toml": _scenario("stance", sway).replace('"iCubGazeboV2_7", ', ""),
    }


def _intervals(use: str, *spans: tuple[float, float]) -> str:
    """Intervals of the log of the tutorial."""
    text = '[[interval]]\nlabel = "{0} s"\nstart_s = {0}\nend_s = {1}\nuse = "{2}"\nsupport = "base"\n'
    return "".join(text.format(start, end, use) for start, end in spans)


def _recordings(scenario: str) -> dict[str, str]:
    """Recordings of a bundled scenario by name."""
    _, *recordings = bundled_scenario(scenario).read_text(encoding="utf-8").split("[[recording]]")
    return {text.split('"')[1]: text for text in recordings}


def _scenario(name: str, recordings: Iterable[str]) -> str:
    """A bundled scenario with other recordings."""
    head = bundled_scenario(name).read_text(encoding="utf-8").split("[[recording]]")[0]
    return "[[recording]]".join([head, *recordings])


def draw_arrays(folder: Path) -> None:
    """Draw what follows from arrays: a sway in noise, sources of a torque of which one is wrong, and a dataset.

    Args:
        folder: Folder for the files.
    """
    rng = np.random.default_rng(1)
    time_s = np.arange(3000) / 100.0
    sway = 0.004 * np.sin(2.0 * np.pi * 1.3 * time_s) + 0.002 * rng.normal(size=3000)
    (folder / "motion.png").write_bytes(
        _small(png_bytes(motion_of_arrays(time_s, {"sway": sway}, {"sway": "m"}).figure()))
    )

    time_s, truth = time_s[:1000], np.sin(time_s[:1000])[:, None]
    torques = {}
    sources = []
    for name, noise, lasting, error in (("ft", 0.05, 0.02, 0.0), ("skin", 0.1, 0.1, 1.0), ("current", 0.2, 0.05, 0.0)):
        torques[name] = truth + noise * rng.normal(size=truth.shape) + lasting * rng.normal() + error
        covariance, shift = np.full((1000, 1, 1), noise**2), np.full((1000, 1, 1), lasting)
        stamp_ns = np.rint(time_s * 1e9).astype(np.int64)
        sources.append(
            TorqueSource(
                name=name,
                joints=("knee",),
                stamp_ns=stamp_ns,
                torque=torques[name],
                noise=covariance,
                lasting=shift,
            )
        )
    torques["fused"] = fuse(sources).torque
    drawn = torque_figure(time_s, ["knee"], torques, reference=("truth", truth))
    (folder / "fusion.png").write_bytes(_small(png_bytes(drawn)))

    (folder / "heat.png").write_bytes(_small(_heat()))
    with tempfile.TemporaryDirectory() as name:
        checked = check_dataset(_dataset(Path(name) / "pick_and_place"), sense="sensor_to_world")
        checked = checked.model_copy(update={"source": "pick_and_place"})
        (folder / "dataset.png").write_bytes(_small(png_bytes(checked.figure())))


def _dataset(root: Path) -> Path:
    """Write episodes of an arm with a tool of 0.8 kg, later of 1.2 kg, and faults of its sensor in some."""
    episodes = [*tool_episodes([70] * 20, seed=5), *tool_episodes([70] * 10, seed=6, mass=1.2)]
    wrench = "observation.wrench"
    episodes[3][wrench][:] = 0.0
    episodes[11][wrench][30:60, 4] = episodes[11][wrench][30, 4]
    for k in (6, 7, 16):
        episodes[k][wrench][20:40, 2] = 25.0
    return write_dataset(root, episodes, per_file=10)


@in_figure_style
def _heat() -> bytes:
    """Draw taxels and thermal pads of a simulated patch that warms, and what rules leave of it on another day."""
    row, column = np.divmod(np.arange(100), 10)
    layout = SkinLayout(
        name="shank",
        frame="lower_leg",
        columns=120,
        taxels=np.arange(100),
        modules=row,
        positions=0.0065 * np.stack([column, row, 0 * row], axis=1),
        normals=np.tile([0.0, 0.0, 1.0], (100, 1)),
        thermal_pads=100 + np.arange(20),
        thermal_modules=np.arange(20) // 2,
    )
    rng = np.random.default_rng(1)
    taxels, heat = TaxelResponses.drawn(100, rng), HeatResponses.drawn(layout, rng)
    days = []
    for warmth in (Warmth(hold_s=600.0), Warmth(hold_s=400.0, inside_s=90.0)):
        stream = warm_recording(layout, taxels, heat, rng, warmth=warmth).stream("counts")
        days.append((1e-9 * (stream.stamp_ns - stream.stamp_ns[0]), stream.signal("taxel_counts").values))
    gains = {
        "by the rule of the boards": HeatGains.of_firmware(layout),
        "by gains from the warm-up": HeatGains.learned(fit_warm_up("warm", *days[0], layout).taxels),
    }
    figure = new_figure(3.0)
    warm, left = figure.subplots(1, 2)
    falls = [(time, counts[:100].mean(axis=0) - counts) for time, counts in days]
    blocks = len(falls[0][0]) // 50
    time, fall = (values[: 50 * blocks].reshape(blocks, 50, -1).mean(axis=1) for values in falls[0])
    warm.plot(time, fall[:, :10], color=CALIBRATIONS[0].colour, linewidth=0.8)
    warm.plot(time, fall[:, 100], color=EXPECTED.colour, linewidth=1.6)
    warm.set_title("warm-up: ten taxels of a module (blue) and a thermal pad (black)", loc="left")
    warm.set_ylabel("fall of the counts")
    time, fall = (values[::20] for values in falls[1])
    rest = {"none taken out": fall[:, :100]}
    for name, gain in gains.items():
        rest[name] = fall[:, :100] - [gain.fall(pads)[0] for pads in fall[:, gain.pads]]
    for (name, counts), style in zip(rest.items(), (PRIOR, CALIBRATIONS[1], CALIBRATIONS[0]), strict=True):
        size = np.abs(counts).mean(axis=1)
        left.plot(time, size, color=style.colour, linewidth=1.4)
        left.text(time[-1], size[-5:].mean() + 0.35, name, ha="right")
    left.set_ylim(0.0, 14.0)
    left.set_title("another day: counts that would be read as pressure, mean of all taxels", loc="left")
    for panel in (warm, left):
        panel.set_xlabel("time, s")
    headline(figure, "Heat moves every taxel by another amount, which a warm-up shows")
    return png_bytes(figure)


def draw_sketches(folder: Path) -> None:
    """Draw sketches of the geometry that several pages explain.

    Args:
        folder: Folder for the files.
    """
    for name, sketch in SKETCHES.items():
        (folder / f"{name}.png").write_bytes(_small(sketch()))


def draw_viewer(folder: Path) -> None:
    """Draw the page of the viewer on an iCub that balances, by a calibration from other motions.

    The meshes are those of icub-models, whose licence (CC BY-SA 4.0) holds for the picture too.

    Args:
        folder: Folder for the file.
    """
    from playwright.sync_api import sync_playwright

    from forcetorque.viewer.video import find_browser

    kept = {"bsl_day2", "grid", "grid_2", "tz", "bsl"}
    recordings = [text for name, text in _recordings("icub-insitu").items() if name in kept]
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        (place / "scenario.toml").write_text(_scenario("icub-insitu", recordings), encoding="utf-8")
        for words in (
            "simulate scenario.toml -o icub",
            "calibrate icub/grid.toml icub/grid_2.toml icub/tz.toml --sensor l_leg_ft -o l_leg.json",
            "view icub/bsl.toml -c l_leg.json -o page.html",
        ):
            _run(["-m", "forcetorque", *words.split()], place)
        with sync_playwright() as driver:
            browser = driver.chromium.launch(executable_path=str(find_browser()), args=list(FLAGS))
            page = browser.new_page(viewport={"width": 1280, "height": 760})
            page.goto((place / "page.html").as_uri())
            page.evaluate("window.ft.ready")
            page.evaluate(f"window.ft.show({SHOWN})")
            picture = page.screenshot()
            browser.close()
    (folder / "viewer.png").write_bytes(_small(picture, VIEWER_COLOURS))


def _run(arguments: list[str], folder: Path) -> None:
    run = subprocess.run([sys.executable, *arguments], cwd=folder, capture_output=True, check=False)
    if run.returncode not in (0, 1):  # 1: a sensor is not accepted
        run.check_returncode()


def _small(png: bytes, most: tuple[int, ...] = COLOURS) -> bytes:
    whole = Image.open(io.BytesIO(png)).convert("RGB")
    for share, colours in product(SHARES, most):
        small = io.BytesIO()
        picture = whole.resize((round(share * whole.width), round(share * whole.height)), Image.Resampling.LANCZOS)
        picture.quantize(colours, Image.Quantize.MAXCOVERAGE, dither=0).save(small, "PNG", optimize=True)
        if small.tell() <= MOST_BYTES or most == VIEWER_COLOURS:
            break
    return small.getvalue()


if __name__ == "__main__":
    FOLDER = Path(sys.argv[1]) if len(sys.argv) > 1 else IMAGES
    if NAMES := sys.argv[2:]:
        draw(FOLDER, NAMES)
    else:
        draw(FOLDER)
        draw_arrays(FOLDER)
        draw_sketches(FOLDER)
        draw_viewer(FOLDER)
