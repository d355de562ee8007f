# SPDX-License-Identifier: BSD-3-Clause
"""Payloads as controllers of arms and simulators take them, each with what it cannot hold, and read back from there.

Universal Robots [1], Franka [2], KUKA [3], ABB [4], Fanuc [5], UFACTORY xArm [6], URDF, and MJCF of MuJoCo [7].

References:
[1] URScript manual, set_target_payload: kg, m, and inertia xx, yy, zz, xy, xz, yz about the centre of mass.
[2] libfranka, Robot::setLoad: kg, m, and inertia column by column, without the end effector.
[3] KUKA System Software, LOAD_DATA: kg, mm, deg; CM is the frame of the principal axes, turned by Z, Y', X''.
[4] ABB, Technical reference RAPID, loaddata: kg, mm, a quaternion with the scalar first, kg m2.
[5] Fanuc, PAYLOAD SET screen: kg, cm, and kgf cm s2 about the centre of mass, without products.
[6] xArm-Python-SDK, set_tcp_load: kg, mm, without inertia.
[7] MuJoCo, XML reference, inertial: fullinertia xx, yy, zz, xy, xz, yz.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError
from forcetorque.base.input_file import read_text
from forcetorque.base.pose import rotation_from_rpy, rpy_from_rotation
from forcetorque.base.units import DECIMAL_NUMBER, STANDARD_GRAVITY
from forcetorque.formats.arm_log import FLANGE
from forcetorque.payload.export.formats import LoadFormat
from forcetorque.payload.export.load_parameters import FlangeLoad, number
from forcetorque.payload.identification.parameter_vector import six_of
from forcetorque.results.number_text import amount

_MOST_UR = 133.0
"""Largest component of an inertia that set_target_payload takes; kg m2."""
_ALUMINIUM = 2700.0
"""Density of the ball whose inertia stands for an unknown one where zero is refused; kg/m3."""


def _number(value: float) -> str:
    """Nine digits that count, which controllers of single precision do not keep all."""
    return number(float(f"{value:.9g}"))


def _commas(values: Iterable[float], separator: str = ", ") -> str:
    return separator.join(_number(value) for value in values)


def _ur(load: FlangeLoad) -> str:
    if np.abs(load.inertia).max() > _MOST_UR:
        raise FormatError(
            f"ur: expected an inertia of at most {_MOST_UR:g} kg m2, which the controller takes, got "
            f"{np.abs(load.inertia).max():.4g} kg m2; check units of the moments"
        )
    centre, inertia = _commas(load.centre_of_mass), _commas(six_of(load.inertia))
    return f"set_target_payload({_number(load.mass)}, [{centre}], [{inertia}])\n"


def _franka(load: FlangeLoad) -> str:
    centre, inertia = _commas(load.centre_of_mass), _commas(load.inertia.T.ravel())
    return f"robot.set_load({_number(load.mass)}, [{centre}], [{inertia}])\n"


def _kuka(load: FlangeLoad) -> str:
    moments, turn = load.principal
    roll, pitch, yaw = np.rad2deg(rpy_from_rotation(turn))
    names = zip("XYZABC", (*(1e3 * load.centre_of_mass), yaw, pitch, roll), strict=True)
    centre = ",".join(f"{name} {_number(value)}" for name, value in names)
    inertia = ",".join(f"{name} {_number(value)}" for name, value in zip("XYZ", moments, strict=True))
    return f"LOAD_DATA[1]={{M {_number(load.mass)},CM {{{centre}}},J {{{inertia}}}}}\n"


def _abb(load: FlangeLoad) -> str:
    from scipy.spatial.transform import Rotation  # here because importing it takes longer than most commands

    moments, turn = load.principal
    x, y, z, w = Rotation.from_matrix(turn).as_quat(canonical=True)
    centre, axes = _commas(1e3 * load.centre_of_mass, ","), _commas((w, x, y, z), ",")
    return f"PERS loaddata payload:=[{_number(load.mass)},[{centre}],[{axes}],{_commas(moments, ',')}];\n"


def _fanuc(load: FlangeLoad) -> str:
    lines = [f"PAYLOAD [kg] {_number(load.mass)}"]
    numbers = zip("XYZ", 1e2 * load.centre_of_mass, strict=True)
    lines += [f"PAYLOAD CENTER {axis} [cm] {_number(value)}" for axis, value in numbers]
    inertia = 1e2 / STANDARD_GRAVITY * np.diag(load.inertia)
    numbers = zip("XYZ", inertia, strict=True)
    lines += [f"PAYLOAD INERTIA {axis} [kgfcms^2] {_number(value)}" for axis, value in numbers]
    return "\n".join([*lines, ""])


def _xarm(load: FlangeLoad) -> str:
    return f"arm.set_tcp_load({_number(load.mass)}, [{_commas(1e3 * load.centre_of_mass)}])\narm.save_conf()\n"


def _rigid(load: FlangeLoad) -> FloatArray:
    """The inertia; that of a ball of aluminium where it is unknown, since simulators refuse zero."""
    if load.has_inertia or not load.mass:
        return load.inertia
    radius = (3.0 * load.mass / (4.0 * np.pi * _ALUMINIUM)) ** (1.0 / 3.0)
    return 0.4 * load.mass * radius**2 * np.eye(3)


def _urdf(load: FlangeLoad) -> str:
    names = ("ixx", "iyy", "izz", "ixy", "ixz", "iyz")
    inertia = " ".join(f'{name}="{_number(value)}"' for name, value in zip(names, six_of(_rigid(load)), strict=True))
    return (
        '<robot name="payload">\n  <link name="payload">\n    <inertial>\n'
        f'      <origin xyz="{_commas(load.centre_of_mass, " ")}" rpy="0 0 0"/>\n'
        f'      <mass value="{_number(load.mass)}"/>\n      <inertia {inertia}/>\n    </inertial>\n  </link>\n'
        f'  <joint name="{FLANGE}-payload" type="fixed">\n    <parent link="{FLANGE}"/>\n    <child link="payload"/>\n'
        "  </joint>\n</robot>\n"
    )


def _mjcf(load: FlangeLoad) -> str:
    position, inertia = _commas(load.centre_of_mass, " "), _commas(six_of(_rigid(load)), " ")
    return (
        '<mujocoinclude>\n  <body name="payload">\n'
        f'    <inertial pos="{position}" mass="{_number(load.mass)}" fullinertia="{inertia}"/>\n'
        "  </body>\n</mujocoinclude>\n"
    )


_TEXTS: dict[LoadFormat, Callable[[FlangeLoad], str]] = {
    LoadFormat.UR: _ur,
    LoadFormat.FRANKA: _franka,
    LoadFormat.KUKA: _kuka,
    LoadFormat.ABB: _abb,
    LoadFormat.FANUC: _fanuc,
    LoadFormat.XARM: _xarm,
    LoadFormat.URDF: _urdf,
    LoadFormat.MJCF: _mjcf,
}
ARMS = tuple(_TEXTS)
"""Forms of arms and simulators, which have a load in the flange and no bias."""


def arm_text(load: FlangeLoad, form: LoadFormat) -> str:
    """Write a load for an arm or a simulator.

    Args:
        load: The load.
        form: One of `ARMS`.

    Returns:
        Content of the file, without a remark.

    Raises:
        FormatError: If the controller does not take it.
    """
    if form in (LoadFormat.URDF, LoadFormat.MJCF) and not load.mass:
        raise FormatError(f"{form}: expected a mass above 0 kg, which simulators need of a body, got 0 kg")
    return _TEXTS[form](load)


def not_held(load: FlangeLoad, form: LoadFormat, bias: FloatArray) -> Iterator[str]:
    """Name what a form cannot hold, with the error that it causes.

    Args:
        load: The load.
        form: One of `ARMS`.
        bias: Measurement without load; shape (6,); N, N m.

    Yields:
        A text for each.
    """
    if bias.any():
        force, moment = (float(np.abs(part).max()) for part in (bias[:3], bias[3:]))
        size = f"{amount(force, 'N')} and {amount(moment, 'N m')}"
        yield f"it holds no bias: up to {size} stay in the measurement until it is zeroed"
    if form is LoadFormat.XARM:
        missed = "each 0.001 kg m2 of the load makes 0.001 N m"
        if load.has_inertia:
            missed = f"up to {amount(float(np.linalg.eigvalsh(load.inertia)[-1]), 'N m')} are missed"
        yield f"it holds no inertia: {missed} for each rad/s2"
    elif not load.has_inertia:
        written = "written as 0"
        if form in (LoadFormat.URDF, LoadFormat.MJCF):
            written = f"written as {amount(float(_rigid(load)[0, 0]), 'kg m2')}, that of a ball of aluminium"
        yield f"the inertia is not known and {written}: each 0.001 kg m2 that it is off makes 0.001 N m for each rad/s2"
    elif form is LoadFormat.FANUC:
        product = float(np.abs(load.inertia - np.diag(np.diag(load.inertia))).max())
        if product > 0.0:
            yield f"it holds no products of inertia: up to {amount(product, 'N m')} are missed for each rad/s2"


_SYMMETRIC = np.array([[0, 3, 4], [3, 1, 5], [4, 5, 2]])
"""Places of xx, yy, zz, xy, xz, yz in a tensor."""


def _read_ur(values: FloatArray) -> FlangeLoad:
    return _load(values[0], values[1:4], values[4:][_SYMMETRIC])


def _read_franka(values: FloatArray) -> FlangeLoad:
    return _load(values[0], values[1:4], values[4:].reshape(3, 3).T)


def _read_kuka(values: FloatArray) -> FlangeLoad:
    # Z, Y', X'' in that order are yaw, pitch, roll
    turn = rotation_from_rpy(np.deg2rad(values[[6, 5, 4]]))
    return _load(values[0], 1e-3 * values[1:4], turn @ np.diag(values[7:]) @ turn.T)


def _load(mass: float, centre: FloatArray, inertia: FloatArray) -> FlangeLoad:
    return FlangeLoad(mass=float(mass), centre_of_mass=centre, inertia=inertia, has_inertia=bool(inertia.any()))


def _call(*counts: int) -> str:
    """A mass and lists of so many numbers."""
    return "(" + ", ".join(["#", *("[" + ", ".join("#" * count) + "]" for count in counts)]) + ")"


_FORMS: dict[LoadFormat, tuple[str, Callable[[FloatArray], FlangeLoad]]] = {
    LoadFormat.UR: ("set_target_payload" + _call(3, 6), _read_ur),
    LoadFormat.FRANKA: ("robot.set_load" + _call(3, 9), _read_franka),
    LoadFormat.KUKA: ("LOAD_DATA[1]={M #, CM {X #, Y #, Z #, A #, B #, C #}, J {X #, Y #, Z #}}", _read_kuka),
}
"""Line of a load, with # for numbers, and what makes the load of them."""
READABLE_ARMS = tuple(_FORMS)
"""Forms of arms that are read back."""


def read_arm_load(path: Path | str, form: LoadFormat) -> FlangeLoad:
    """Read the load that a controller is given.

    Args:
        path: The file.
        form: One of `READABLE_ARMS`.

    Returns:
        The load in the flange.

    Raises:
        FormatError: If there is no such line, or several, or its numbers are none.
    """
    line, load_of = _FORMS[form]
    pattern = re.escape(line).replace(r"\#", f"({DECIMAL_NUMBER.pattern})").replace(r",\ ", r",\s*")
    loads = re.findall(rf"^\s*{pattern}\s*$", read_text(Path(path), f"a load for {form}"), re.MULTILINE)
    if len(loads) != 1:
        raise FormatError(f"{path}: expected one line as {line} with numbers for #, got {len(loads)}")
    values = np.array([float(number) for number in loads[0]])
    if not np.isfinite(values).all() or values[0] < 0.0:
        raise FormatError(f"{path}: expected finite numbers and a mass of 0 kg or more, got {loads[0]}")
    return load_of(values)
