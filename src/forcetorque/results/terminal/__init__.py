# SPDX-License-Identifier: BSD-3-Clause
"""What all commands share: options, input files, and where results and messages go."""
