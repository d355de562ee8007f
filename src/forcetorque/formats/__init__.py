# SPDX-License-Identifier: BSD-3-Clause
"""Other people's formats of logs and calibrations: one module or folder per format, one registry."""
