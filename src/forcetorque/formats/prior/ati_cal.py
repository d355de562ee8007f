# SPDX-License-Identifier: BSD-3-Clause
"""Calibration files of ATI transducers read through a DAQ card, `FT12345.cal`, of version 1.0 and 1.1.

`Axis` holds the matrix times a `scale`, about a point of ATI's own: divided by it, and moved by `BasicTransform`, it
gives force and moment about the transducer's origin per volt. In version 1.1 `UserAxis` has that done, rounded to five
digits; where both are there they are held against each other.
"""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element

import numpy as np

from forcetorque.base.arrays import FloatArray
from forcetorque.base.errors import FormatError, known_names
from forcetorque.base.input_file import read_xml
from forcetorque.base.pose import invert_pose, make_pose
from forcetorque.base.units import parsed_number, si_factor
from forcetorque.base.wrench import wrench_matrix
from forcetorque.formats.prior.prior_file import PriorFile, RawUnit

_AXES = ("Fx", "Fy", "Fz", "Tx", "Ty", "Tz")
_FORCES = {"n": "N", "kn": "kN", "lbf": "lbf", "lb": "lbf", "kg": "kgf", "kgf": "kgf"}
_MOMENTS = {
    "n-m": "N m",
    "nm": "N m",
    "n-mm": "N mm",
    "nmm": "N mm",
    "lbf-in": "lbf in",
    "in-lb": "lbf in",
    "lbf-ft": "lbf ft",
    "ft-lb": "lbf ft",
    "kg-cm": "kgf cm",
    "kgf-cm": "kgf cm",
}
_DISTANCES = {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "in": 0.0254, "ft": 0.3048}
_ROUNDING = 2e-5
"""UserAxis has five digits behind the point, as have the numbers that it was made of; unit of the file per V."""
_LARGEST = 1e9


class AtiCalibration:
    """XML with the root `FTSensor`."""

    sign = "an ATI .cal (XML with FTSensor)"

    def recognises(self, path: Path, text: str) -> bool:
        """Look for the root element."""
        return "<FTSensor" in text

    def read(self, path: Path, text: str) -> PriorFile:
        """Read it."""
        root = read_xml(path)
        try:
            return _read(root)
        except FormatError as error:
            raise FormatError(f"{path}: {error}") from error


def _read(root: Element | None) -> PriorFile:
    if root is None or root.tag != "FTSensor":
        raise FormatError(f"expected the root FTSensor, got {'nothing' if root is None else root.tag[:40]!r}")
    version = _text(root, "CalFileVersion")
    if version not in ("1.0", "1.1"):
        raise FormatError(f"CalFileVersion: expected 1.0 or 1.1, got {version[:40]!r}; other versions are not known")
    calibrations = root.findall("Calibration")
    if len(calibrations) != 1:
        raise FormatError(f"expected one Calibration, got {len(calibrations)}; keep the one in use")
    calibration = calibrations[0]
    _refuse_unknown(calibration)
    gauges = _number(root, "NumGages")
    if not 1 <= gauges <= 64 or gauges != int(gauges):
        raise FormatError(f"NumGages: expected a number from 1 to 64, got {gauges:g}")
    gain = _number(calibration, "GainMultiplier", 1.0)
    if gain != 1.0:
        raise FormatError(f"GainMultiplier: expected 1, got {gain:g}; what another does is not documented")
    factors = _factors(calibration)
    matrix, full_scale = _matrix(calibration, version, int(gauges))
    return PriorFile(
        form=f"ATI calibration {version} of {root.get('BodyStyle', 'a transducer')[:40]} "
        f"{calibration.get('PartNumber', '')[:40]}".strip(),
        matrix=factors[:, None] * matrix,
        raw_unit=RawUnit.VOLTS,
        full_scale=factors * full_scale,
        serial=_text(root, "Serial"),
        date=calibration.get("CalDate"),
        notes=tuple(_notes(calibration)),
    )


def _matrix(calibration: Element, version: str, gauges: int) -> tuple[FloatArray, FloatArray]:
    """Matrix per volt and full scale, in the units of the file."""
    axes = _by_name(calibration, "Axis")
    scaled = np.stack([_values(axis, gauges) / _positive(axis, "scale") for axis in axes])
    transform = calibration.find("BasicTransform")
    rotated = transform is not None and any(_number(transform, name, 0.0) for name in ("Rx", "Ry", "Rz"))
    moved = None if rotated else _moved(scaled, transform, calibration)
    if version == "1.0":
        if moved is None:
            raise FormatError(
                "BasicTransform: expected no rotation, got one; in which order ATI rotates is not documented, so "
                "export the file as version 1.1"
            )
        return moved, np.array([_positive(axis, "max") for axis in axes])
    users = _by_name(calibration, "UserAxis")
    specified = np.stack([_values(axis, gauges) for axis in users])
    if moved is not None and not np.allclose(specified, moved, rtol=1e-4, atol=_ROUNDING):
        row = int(np.abs(specified - moved).max(axis=1).argmax())
        raise FormatError(
            f"UserAxis {_AXES[row]}: expected what Axis and BasicTransform give, got numbers that differ by up to "
            f"{np.abs(specified - moved).max():.3g}; the file was changed, get another copy"
        )
    return specified, np.array([_positive(axis, "max") for axis in users])


def _moved(matrix: FloatArray, transform: Element | None, calibration: Element) -> FloatArray:
    """Moments about the point that BasicTransform leads to."""
    if transform is None:
        return matrix
    unit = calibration.get("DistUnits", "").lower()
    if unit not in _DISTANCES:
        raise FormatError(f"DistUnits: {known_names(unit, _DISTANCES)}; got {unit[:40]!r}")
    position = np.array([_number(transform, name, 0.0) for name in ("Dx", "Dy", "Dz")]) * _DISTANCES[unit]
    force, moment = (factor for _, factor in (_force(calibration), _moment(calibration)))
    # m per force over moments in the units of the file
    old_H_new = make_pose(np.eye(3), position * force / moment)
    return wrench_matrix(invert_pose(old_H_new)) @ matrix


def _refuse_unknown(calibration: Element) -> None:
    for child in calibration:
        if child.tag not in ("Axis", "BasicTransform", "UserAxis"):
            raise FormatError(
                f"expected Axis, UserAxis and BasicTransform, got {str(child.tag)[:40]!r}; what it does to the "
                "readings is not known, so nothing is read"
            )
    for tag in ("BasicTransform",):
        if len(calibration.findall(tag)) > 1:
            raise FormatError(f"expected one {tag}, got several")


def _notes(calibration: Element) -> list[str]:
    notes = ["per volt of the gauges, their bias taken off"]
    if calibration.get("HWTempComp", "").lower() == "false":
        notes.append("without temperature compensation in hardware: readings move with temperature")
    span = calibration.get("OutputRange")
    if span:
        polarity = "both signs" if calibration.get("OutputBipolar", "").lower() == "true" else "one sign"
        notes.append(f"outputs span {span[:20]} V of {polarity}")
    return notes


def _by_name(calibration: Element, tag: str) -> list[Element]:
    named = {element.get("Name"): element for element in calibration.findall(tag)}
    if set(named) != set(_AXES) or len(calibration.findall(tag)) != len(_AXES):
        raise FormatError(f"expected {tag} of {', '.join(_AXES)}, each once, got {', '.join(map(str, named))[:80]}")
    return [named[name] for name in _AXES]


def _values(axis: Element, gauges: int) -> FloatArray:
    cells = _text(axis, "values").split()
    if len(cells) != gauges:
        raise FormatError(
            f"{axis.tag} {axis.get('Name')}: expected a value for each of {gauges} gauges, got {len(cells)}"
        )
    return np.array([_float(axis, "values", text) for text in cells])


def _factors(calibration: Element) -> FloatArray:
    force, moment = _force(calibration), _moment(calibration)
    return np.repeat([force[1], moment[1]], 3)


def _force(calibration: Element) -> tuple[str, float]:
    return _unit(calibration, "ForceUnits", _FORCES)


def _moment(calibration: Element) -> tuple[str, float]:
    return _unit(calibration, "TorqueUnits", _MOMENTS)


def _unit(calibration: Element, key: str, known: dict[str, str]) -> tuple[str, float]:
    text = _text(calibration, key)
    if text.lower() not in known:
        raise FormatError(f"{key}: {known_names(text, known)}; got {text[:40]!r}")
    return si_factor(known[text.lower()])


def _text(element: Element, key: str) -> str:
    value = element.get(key)
    if not value:
        raise FormatError(f"{str(element.tag)[:40]}: expected the attribute {key}, got none")
    return value


def _number(element: Element, key: str, default: float | None = None) -> float:
    value = element.get(key)
    if value is None and default is not None:
        return default
    return _float(element, key, _text(element, key))


def _positive(element: Element, key: str) -> float:
    value = _number(element, key)
    if not value > 0.0:
        raise FormatError(f"{element.tag} {element.get('Name')}: {key}: expected more than 0, got {value:g}")
    return value


def _float(element: Element, key: str, text: str) -> float:
    value = parsed_number(text)
    if not abs(value) < _LARGEST:
        raise FormatError(f"{str(element.tag)[:40]}: {key}: expected a number, got {text[:40]!r}")
    return value
