# SPDX-License-Identifier: BSD-3-Clause
"""Logs that were kept as files of named arrays: MATLAB, HDF5, NumPy."""

from forcetorque.exchange.array_file.log_format import Hdf5Format, MatlabFormat, NpzFormat
from forcetorque.exchange.array_file.statement import Hdf5Log, MatlabLog, NpzLog

__all__ = ["Hdf5Format", "Hdf5Log", "MatlabFormat", "MatlabLog", "NpzFormat", "NpzLog"]
