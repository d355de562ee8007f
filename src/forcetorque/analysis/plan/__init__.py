# SPDX-License-Identifier: BSD-3-Clause
"""What to record next."""
