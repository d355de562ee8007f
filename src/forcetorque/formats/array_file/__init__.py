# SPDX-License-Identifier: BSD-3-Clause
"""Logs that were kept as files of named arrays: MATLAB, HDF5, NumPy."""
