# SPDX-License-Identifier: BSD-3-Clause
"""What hangs on a wrist sensor or on links of a robot: stated, weighed before, or to be estimated."""
