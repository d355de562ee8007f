# SPDX-License-Identifier: BSD-3-Clause
"""Calibrations that a sensor came with: matrices of makers, boards and papers, each form a file."""

from forcetorque.exchange.prior.firmware_updater import FirmwareFile, read_firmware_file, write_firmware_file
from forcetorque.exchange.prior.formats import PRIOR_FORMATS, holds_prior, read_prior_file
from forcetorque.exchange.prior.polynomial_model import PolynomialModel, read_polynomial_model, write_polynomial_model
from forcetorque.exchange.prior.prior_file import PriorFile, RawUnit, StatedUnits

__all__ = [
    "PRIOR_FORMATS",
    "FirmwareFile",
    "PolynomialModel",
    "PriorFile",
    "RawUnit",
    "StatedUnits",
    "holds_prior",
    "read_firmware_file",
    "read_polynomial_model",
    "read_prior_file",
    "write_firmware_file",
    "write_polynomial_model",
]
