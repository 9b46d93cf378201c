"""1.8 `link4_to_world(model, q)`: its questions and its mistakes."""

from labkit.judge import Pose, Row
from labkit.judge.matrices import rigid_inverse

from . import ends, places
from .compose_fk import stops_early
from .panda_chain import NEAR, PANDA, PATH, by_mujoco, fk, link, on, turn

TO_LINK4 = PATH[:5]
AT_READY = "the lab asks in the ready configuration alone"

row = Row(
    Pose(wrong_way="maps world coordinates to link4 coordinates"),
    truth=lambda model, q: by_mujoco(model, q, TO_LINK4),
    near=NEAR,
    alike=[*places.ALIKE, {"whole-numbers", "t-lost"}],  # no step is of a metre
    held_out=[places.TYPED_IN],
    unnamed=places.along(TO_LINK4),
    measured=places.measured,
    slips=[places.NO_INDEX],
)
row.inputs(on(PANDA))

for k in (1, 2, 3):
    stops_early(row, k, "link4")
for k, end in enumerate(("link5", "link6", "link7", "the end effector"), start=5):
    row.wrong(
        "too-long",
        f"your code continues the chain to {end}. The chain should end at link4",
    )(lambda model, q, k=k: fk(model, q, PATH[: k + 1]))

row.reached_by(
    "compose_fk",
    but={*ends.ENDS, "stops-early"},
    called={"the end effector": "link4", "attachment": "link4"},
    hidden={"home-whatever-q": AT_READY},
)


@row.wrong("joint-skipped")  # joint4 turns link4 itself, so it belongs in.
def _(model, q):
    return fk(model, q, PATH[:4]) @ link(model, "link4")


@row.wrong
def last_step_on_the_left_without_joint(model, q):
    """your code puts the transform of link4 on the left of the product and omits the
    rotation of joint4. Put both on the right, the rotation last"""
    return link(model, "link4") @ fk(model, q, PATH[:4])


@row.wrong("pose-off")  # From link3's inverse: an idea without a name.
def _(model, q):
    step = link(model, "link4") @ turn(model, q, "joint4")
    return rigid_inverse(fk(model, q, PATH[:4])) @ step


@row.wrong
def starts_late(model, q):
    """your result is the pose of link4 relative to link2. Start the chain at link0
    instead, because the result should be relative to the world"""
    return fk(model, q, PATH[3:5])
