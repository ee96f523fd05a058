"""Notes of a group of points: what its files said of themselves."""

import numpy as np

from aadm_workbench.assembly.group_notes import NO_CAMERA, of_the_files
from aadm_workbench.model import Scan

POINTS = np.zeros((4, 3))


def test_a_cloud_that_does_not_know_its_camera_says_that_one_would_help() -> None:
    known = Scan(POINTS, "with.ply", viewpoint=np.zeros(3))
    unknown = Scan(POINTS, "without.ply")
    assert of_the_files((known,)) == ()
    (note,) = of_the_files((known, unknown))
    assert note.startswith("without.ply")
    assert NO_CAMERA in note
