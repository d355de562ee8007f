# SPDX-License-Identifier: BSD-3-Clause
"""Other people's formats: one package or module per format."""
