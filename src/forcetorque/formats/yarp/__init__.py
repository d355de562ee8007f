# SPDX-License-Identifier: BSD-3-Clause
"""Logs of yarpdatadumper: one folder per port."""
