# SPDX-License-Identifier: BSD-3-Clause
"""Files of the force-torque sensors of iCub: the calibration matrix that the sensor's DSP holds."""

from forcetorque.exchange.icub.matrix_encoding import encode_matrix
from forcetorque.exchange.icub.matrix_file import (
    MatrixFile,
    MatrixLayout,
    read_matrix_file,
    serial_number_in_name,
    write_matrix_file,
)

__all__ = [
    "MatrixFile",
    "MatrixLayout",
    "encode_matrix",
    "read_matrix_file",
    "serial_number_in_name",
    "write_matrix_file",
]
