# SPDX-License-Identifier: BSD-3-Clause
"""Files of matrices as the programs of their makers write them."""

from __future__ import annotations

from pathlib import Path
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from forcetorque.formats.prior.firmware_updater import FirmwareFile
from forcetorque.formats.prior.matrix_files import PolynomialModel


def write_firmware_file(path: Path, file: FirmwareFile) -> None:
    """Write a file as FirmwareUpdater saves it."""
    lines = ["File version:", "2" if file.registers is None else "3"]
    if file.registers is not None:
        lines += ["Board type:", "strain2"]
    lines += ["Serial number:", file.serial]
    if file.registers is not None:
        lines += ["Amplifier registers:", *file.registers]
    if file.offsets is not None:
        lines += ["Offsets:", *map(str, file.offsets)]
    lines += ["Calibration matrix:", *(f"{code & 0xFFFF:x}" for code in file.matrix.codes.ravel().tolist())]
    lines += ["Matrix gain:", str(file.matrix.gain), "Tare:", *map(str, file.tare)]
    lines += ["Full scale values:", *map(str, file.matrix.full_scale)]
    path.write_bytes("".join(f"{line}\n" for line in lines).encode("ascii"))


def write_polynomial_model(path: Path, model: PolynomialModel) -> None:
    """Write a model file, in which every number reads back exactly."""
    group = Element("group", {"name": "modelClassParams"})
    counts = {"np": 1, "ny": 6, "nu": model.matrix.shape[1], "na": 0, "nb": 0}
    for name, value in (*counts.items(), ("string", model.name)):
        SubElement(group, "param", {"name": name}).text = str(value)
    for k, row in enumerate([*model.matrix.T.tolist(), model.offset.tolist()], start=1):
        SubElement(group, "param", {"name": f"row{k}"}).text = f"({' '.join(map(repr, row))})"
    indent(group)
    path.write_bytes(b'<?xml version="1.0" encoding="utf-8"?>\n' + tostring(group) + b"\n")
