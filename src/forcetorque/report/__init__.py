# SPDX-License-Identifier: BSD-3-Clause
"""The report on sensors as one document."""
