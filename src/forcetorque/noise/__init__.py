# SPDX-License-Identifier: BSD-3-Clause
"""What measurements do beside what they measure: fast noise that averages out, and slow noise that does not."""

from forcetorque.noise.means import WINDOW_S, means_over
from forcetorque.noise.slow import CANDIDATES, SlowNoise
from forcetorque.noise.timeline import Timeline

__all__ = ["CANDIDATES", "WINDOW_S", "SlowNoise", "Timeline", "means_over"]
