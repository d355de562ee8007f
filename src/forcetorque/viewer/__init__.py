# SPDX-License-Identifier: BSD-3-Clause
"""The viewer: robot pose and force space, linked in time, in the browser."""

from forcetorque.viewer.build import BuiltScene, build_scene
from forcetorque.viewer.experiment_scene import scene_of
from forcetorque.viewer.page import MOST_SAMPLES, page_of, write_page
from forcetorque.viewer.serve import ViewerServer

__all__ = ["MOST_SAMPLES", "BuiltScene", "ViewerServer", "build_scene", "page_of", "scene_of", "write_page"]
