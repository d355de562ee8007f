# SPDX-License-Identifier: BSD-3-Clause
"""Spheres of real sensors: arms and legs that determine little, wrists that determine much."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from forcetorque.base.errors import FitError
from forcetorque.evaluation.sphere.ellipsoid import CloudForm
from forcetorque.evaluation.sphere.sensor_sphere import SensorSphere
from forcetorque.evaluation.sphere.sphere import spheres
from forcetorque.experiment.experiment import Experiment
from forcetorque.experiment.loading import load_experiment
from forcetorque.experiment.sensor_run import SensorRun
from tests.cases import some_cases
from tests.scenes.axia import write_axia

pytestmark = pytest.mark.real_data

EXAMPLES = Path(__file__).parents[3] / "examples"
GRAVITY = 9.81
ARM_KG, LEG_KG = 1.92, 4.73
"""What the robot model has beyond the sensors."""
ARMS = ("l_arm_ft_sensor", "r_arm_ft_sensor")
SCATTER_KG = (1.3, 3.5)
"""Masses that fits of one radius to these arms give, depending on window and method."""

Yoga = Callable[[str, float, float, str], SensorSphere]
"""Analyses by log, start, end and sensor."""


def _experiment(data_dir: Path, folder: Path, *, run: str, start_s: float, end_s: float) -> Experiment:
    """The yoga example with another log and one interval."""
    text = (EXAMPLES / "12_icub_yoga_sphere.toml").read_text(encoding="utf-8")
    text = text.replace("../../shared/data", data_dir.as_posix()).replace("dumperLeftLegNoIMU", run)
    head, first, _ = text.split("[[interval]]")
    del first
    if run == "dumperRightLegNoIMU":  # it stands on the other foot and lacks the log of the left leg
        head = head.replace('frame = "l_sole"', 'frame = "r_sole"')
        before, _, after = head.partition('[[recording.stream]]\nkind = "state_ext"\nname = "left_leg"')
        head = before + after[after.index("[[") :]
    support = "r_sole" if run == "dumperRightLegNoIMU" else "l_sole"
    interval = f'label = "w"\nstart_s = {start_s}\nend_s = {end_s}\nuse = "validation"\nsupport = "{support}"\n'
    path = folder / f"{run}_{start_s}_{end_s}.toml"
    path.write_text(f"{head}[[interval]]\n{interval}")
    return load_experiment(path)


def _analysed(experiment: Experiment, sensor: str) -> SensorSphere:
    (sphere,) = spheres(SensorRun(experiment, sensor), {}).analyses
    return sphere


@pytest.fixture(scope="module")
def yoga(data_dir: Path, tmp_path_factory: pytest.TempPathFactory) -> Yoga:
    """The logs of a robot on one foot, every window analysed once."""
    folder = tmp_path_factory.mktemp("yoga")
    of_window = cache(lambda run, start_s, end_s: _experiment(data_dir, folder, run=run, start_s=start_s, end_s=end_s))
    return cache(lambda run, start_s, end_s, sensor: _analysed(of_window(run, start_s, end_s), sensor))


WINDOWS = [(25.0, 58.0), (25.0, 41.5), (15.0, 62.0), (0.0, 70.0)]


@some_cases("run", ["dumperLeftLegNoIMU", "dumperRightLegNoIMU"])
@some_cases(("start_s", "end_s"), WINDOWS)
def test_arms_are_caps_and_not_identifiable(yoga: Yoga, run: str, start_s: float, end_s: float) -> None:
    """Whatever the window, the mass of the model lies in the interval, and neither radius nor ellipsoid is believed."""
    for name in ARMS:
        sphere = yoga(run, start_s, end_s, name)
        analysis, one = sphere.analysis, sphere.analysis.radius
        assert sphere.no_model is not None
        assert analysis.mass == pytest.approx(ARM_KG, abs=0.01)
        assert analysis.form is not CloudForm.SURFACE
        assert not one.identifiable
        assert one.low / GRAVITY <= ARM_KG <= one.high / GRAVITY
        assert not analysis.free.identifiable
        # all the more unknown: whatever one radius may be, each of three may be
        assert (analysis.free.low <= one.low).all()
        assert (analysis.free.high >= one.high).all()
        assert np.isinf(analysis.free.index_high)
        assert analysis.free.index_low == 0.0


@some_cases("run", ["dumperLeftLegNoIMU", "dumperRightLegNoIMU"])
def test_the_interval_of_the_arms_holds_the_scatter(yoga: Yoga, run: str) -> None:
    """Over the contact-free window: all that windows and methods give for one radius, 1.3 to 3.5 kg."""
    for name in ARMS:
        one = yoga(run, 25.0, 58.0, name).analysis.radius
        assert one.low / GRAVITY <= SCATTER_KG[0]
        assert one.high / GRAVITY >= SCATTER_KG[1]


WINDOWS_APART = [(25.0, 58.0), (25.0, 36.0), (36.0, 47.0)]


@pytest.mark.long
def test_windows_and_methods_do_scatter(yoga: Yoga) -> None:
    """Negative control: single fits over windows that move range from below 1.2 to above 3.5 kg."""
    masses = []
    for run, (start_s, end_s) in product(("dumperLeftLegNoIMU", "dumperRightLegNoIMU"), WINDOWS_APART):
        for name in ARMS:
            one = yoga(run, start_s, end_s, name).analysis.radius
            masses += [one.algebraic / GRAVITY, one.geometric / GRAVITY]
    assert len(masses) == 24
    assert min(masses) < 1.2
    assert max(masses) > 3.5


@pytest.mark.parametrize(("start_s", "end_s"), WINDOWS[:2])
def test_the_free_leg_is_nearly_a_plane(yoga: Yoga, start_s: float, end_s: float) -> None:
    """Its radius has no upper end; the weight of the model is not excluded; with the model it is not known either."""
    sphere = yoga("dumperLeftLegNoIMU", start_s, end_s, "r_leg_ft_sensor")
    analysis = sphere.analysis
    assert sphere.no_model is None
    assert analysis.mass == pytest.approx(LEG_KG, abs=0.01)
    assert analysis.form is CloudForm.PLANE
    assert not analysis.radius.identifiable
    assert not analysis.free.identifiable
    assert np.isinf(analysis.radius.high)
    assert np.isinf(analysis.free.high).all()
    assert analysis.radius.low / GRAVITY < LEG_KG
    assert analysis.directions is not None
    assert analysis.directions < 0.05
    assert analysis.mapped is not None
    assert not analysis.mapped.fit.identifiable
    assert analysis.mapped.fit.why


def test_the_wrist_of_24_poses(data_dir: Path, tmp_path: Path) -> None:
    """A new ATI Gamma reads one mass along all axes to a percent; poses along the axes tell nothing in between."""
    text = (EXAMPLES / "07_wrist_payload.toml").read_text(encoding="utf-8")
    path = tmp_path / "wrist.toml"
    path.write_text(text.replace("../../shared/data", data_dir.as_posix()))
    analysis = _analysed(load_experiment(path), "wrist").analysis
    assert analysis.mapped is not None
    assert analysis.mass == pytest.approx(0.932, abs=0.002)
    assert analysis.radius.identifiable
    for fit in (analysis.free, analysis.mapped.fit):
        assert fit.identifiable
        masses = analysis.masses(fit)
        np.testing.assert_allclose(masses, 0.932, atol=0.01)
        assert fit.index / 9.80665 < 0.005
    assert analysis.mapped.fit.tilt_identifiable
    assert not analysis.free.tilt_identifiable
    assert analysis.moment is not None
    assert analysis.moment.identifiable
    np.testing.assert_allclose(analysis.moment.error_Nm, 0.0, atol=0.005)


@pytest.mark.long
def test_the_wrist_of_100_poses(data_dir: Path, tmp_path: Path) -> None:
    """All on one side and drifting by 2 N: one mass is known to 5 %, and three are only with the model."""
    analysis = _analysed(load_experiment(write_axia(data_dir, tmp_path, "_100")), "wrist").analysis
    assert analysis.samples == 100
    assert analysis.radius.identifiable
    assert analysis.radius.low / 9.80665 < 1.239 < analysis.radius.high / 9.80665
    assert not analysis.free.identifiable
    assert analysis.mapped is not None
    assert analysis.mapped.fit.identifiable
    assert (analysis.free.low <= analysis.mapped.fit.low).all()
    assert (analysis.free.high >= analysis.mapped.fit.high).all()


@pytest.mark.long
def test_seven_poses_are_too_few(data_dir: Path, tmp_path: Path) -> None:
    """An ellipsoid has nine unknowns."""
    experiment = load_experiment(write_axia(data_dir, tmp_path, ""))
    with pytest.raises(FitError, match="sensor 'wrist', prior: force: expected at least 10 points, got 7"):
        _analysed(experiment, "wrist")
