"""A picture of the arm to hand in: from the left, with its configuration written in."""

import numpy as np
from numpy.typing import ArrayLike
from PIL import Image, ImageDraw, ImageFont

from labkit.figures import portrait
from labkit.figures.overlay import INK
from labkit.figures.scene import Camera, Scene

SIZE = (1200, 800)  # pixels
# The lessons' own picture shows the arm from its right.
FROM_THE_LEFT = Camera(azimuth=np.radians(58.0), elevation=np.radians(-18.0))


def screenshot(qpos: ArrayLike, title: str) -> Image.Image:
    """Return the Panda at q (7,) with its frames, its titled q in the corner."""
    q = portrait.with_fingers(qpos)
    poses = portrait.link_frames(q)
    camera = FROM_THE_LEFT.stepped_back(portrait.corners(poses), SIZE)
    picture = portrait.draw(Scene(q, SIZE, camera), poses)
    joints = " ".join(f"{angle:.3f}" for angle in q[:7])
    ImageDraw.Draw(picture).text(
        (36, 24), f"{title}: q = {joints} rad", INK, ImageFont.load_default(24)
    )
    return picture
