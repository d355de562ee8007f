# SPDX-License-Identifier: BSD-3-Clause
"""Draw pictures of the documentation, of simulated data alone: `python docs/pictures.py [FOLDER]`.

They are what the commands of the pages draw, in fewer colours. `tests/test_pictures.py` draws them again and compares.
"""

from __future__ import annotations

import io
import subprocess
import sys
import tempfile
from itertools import product
from pathlib import Path

from PIL import Image

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
BENCH, SKIN, PLATES, CONTEST = (
    [str(ROOT / "examples" / f"{name}.py"), "."] for name in ("29_bench", "30_skin", "31_plates", "19_contest")
)
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
BEFORE = {"skin_contacts": "skin calibrate fit.toml -o shank.json"}
"""Commands that come first."""


def draw(folder: Path) -> None:
    """Draw all pictures.

    Args:
        folder: Folder for the files.
    """
    with tempfile.TemporaryDirectory() as name:
        for picture, (data, command) in PICTURES.items():
            place = Path(name) / "_".join(Path(word).stem for word in data)
            if not place.exists():
                place.mkdir()
                (place / "limits.toml").write_text(LIMITS, encoding="utf-8")
                _run(data, place)
            if picture in BEFORE:
                _run(["-m", "forcetorque", *BEFORE[picture].split()], place)
            if command.endswith(".png"):
                drawn = place / command
            else:
                drawn = place / f"{picture}.png"
                _run(["-m", "forcetorque", *command.format(drawn.name).split()], place)
            (folder / f"{picture}.png").write_bytes(_small(drawn.read_bytes()))


def draw_signs(folder: Path) -> None:
    """Draw the sign of a sensor between two links, of which the outer one hangs.

    Args:
        folder: Folder for the file.
    """
    from matplotlib.patches import Rectangle

    from forcetorque.results.figures import MUTED, in_figure_style, new_figure, png_bytes
    from forcetorque.results.visual_roles import CALIBRATIONS, EXPECTED, SURFACES

    @in_figure_style
    def drawn() -> bytes:
        figure = new_figure(3.2)
        for panel, direction, other, sign, tail in zip(
            figure.subplots(1, 2),
            ("child_to_parent", "parent_to_child"),
            ("the child on the parent", "the parent on the child"),
            ("-", "+"),
            (1.0, -0.2),
            strict=True,
        ):
            links = {"parent, towards the known frame": (1.1, 0.5), "child, mass m beyond the sensor": (-0.9, 0.5)}
            for name, (bottom, height) in links.items():
                panel.add_patch(Rectangle((-1.5, bottom), 3.0, height, facecolor=SURFACES["line"][0]))
                panel.text(0.0, bottom + 0.5 * height, name, ha="center", va="center")
            panel.add_patch(Rectangle((-0.5, 0.2), 1.0, 0.3, facecolor=MUTED))
            panel.text(0.6, 0.35, "sensor", va="center")
            for x in (-0.3, 0.3):
                panel.plot([x, x], [-0.4, 1.1], color=MUTED, linewidth=2.0, zorder=0)
            for x, start, end, style in (
                (-1.8, tail, tail + (-0.8 if sign == "-" else 0.8), CALIBRATIONS[0]),
                (1.8, -0.3, -1.1, EXPECTED),
            ):
                arrow = {"arrowstyle": "-|>", "color": style.colour, "linewidth": 2.5, "mutation_scale": 18.0}
                panel.annotate("", (x, end), (x, start), arrowprops=arrow)
            panel.text(
                -1.95, 0.5 * tail + 0.05, f"reading\n(0, 0, {sign}m g)", ha="right", color=CALIBRATIONS[0].colour
            )
            panel.text(1.95, -0.8, "weight\n(0, 0, -m g)", va="center")
            panel.set_title(f"{direction}: {other}", fontweight="bold")
            panel.set_xlim(-3.2, 3.2)
            panel.set_ylim(-1.2, 1.8)
            panel.set_axis_off()
        return png_bytes(figure)

    (folder / "signs.png").write_bytes(_small(drawn()))


def draw_viewer(folder: Path) -> None:
    """Draw the page of the viewer on an iCub that balances, by a calibration from other motions.

    The meshes are those of icub-models, whose licence (CC BY-SA 4.0) holds for the picture too.

    Args:
        folder: Folder for the file.
    """
    from playwright.sync_api import sync_playwright

    from forcetorque.simulation.scenario.file import bundled_scenario
    from forcetorque.viewer.video import find_browser

    head, *recordings = bundled_scenario("icub-insitu").read_text(encoding="utf-8").split("[[recording]]")
    kept = [text for text in recordings if text.split('"')[1] in {"bsl_day2", "grid", "grid_2", "tz", "bsl"}]
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        (place / "scenario.toml").write_text("[[recording]]".join([head, *kept]), encoding="utf-8")
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
    draw(FOLDER)
    draw_signs(FOLDER)
    draw_viewer(FOLDER)
