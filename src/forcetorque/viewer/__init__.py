# SPDX-License-Identifier: BSD-3-Clause
"""The viewer: robot pose and force space, linked in time, in the browser."""

from forcetorque.viewer.build import BuiltScene, build_scene
from forcetorque.viewer.experiment_scene import scene_of
from forcetorque.viewer.filming import film_between, frame_count, write_video
from forcetorque.viewer.page import MOST_SAMPLES, page_of, write_page
from forcetorque.viewer.serve import ViewerServer
from forcetorque.viewer.session import Session
from forcetorque.viewer.source import view_source
from forcetorque.viewer.video import Film, find_browser, require_playwright
from forcetorque.viewer.view import View

__all__ = [
    "MOST_SAMPLES",
    "BuiltScene",
    "Film",
    "Session",
    "View",
    "ViewerServer",
    "build_scene",
    "film_between",
    "find_browser",
    "frame_count",
    "page_of",
    "require_playwright",
    "scene_of",
    "view_source",
    "write_page",
    "write_video",
]
