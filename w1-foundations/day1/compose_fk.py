"""1.6 `compose_fk(model, q, path)`: its questions and its mistakes.

A mistake in one link or one joint alone is not listed here: `places` finds which one.
"""

from functools import partial

import mujoco
import numpy as np

from labkit.base.exchange import Path
from labkit.judge import HeldOut, Pose, Row
from labkit.judge.argument_mistakes import LEFT_OUT, ONE_OFF
from labkit.judge.matrices import pose, rigid_inverse
from robo47 import se3
from robo47.panda import READY_Q

from . import ends, places, products
from .panda_chain import (
    FLANGE_POS,
    FLANGE_QUAT,
    NEAR,
    PANDA,
    PATH,
    as_written,
    by_mujoco,
    fk,
    link,
    on,
    product,
    steps,
    turn,
)
from .quat_to_R import NOT_NORMALISED, UNNORMALISED, XYZW_AND_NOT_NORMALISED

I = np.eye(4)  # noqa: E741


def _prefixes(rng):
    _, q = on(PANDA, count=1)(rng)[-1]
    return [(PANDA, q, Path(PATH[: k + 1])) for k in range(1, len(PATH))]


def _by_place(model, q, path, first):
    """Return the product with the angles that follow each other from `q[first]`."""
    angles = np.roll(q, -first)
    place = {joint: i for i, (_, joint) in enumerate(path)}
    return product(
        link(model, name)
        @ (pose(se3.Rz(angles[place[joint]]), np.zeros(3)) if joint else I)
        for name, joint in path
    )


def _counted(slug, first):
    """Return the question whose answer shows that angles are taken by their place."""
    return HeldOut(
        slug,
        "Your pose is correct for paths from the base, but your function takes "
        "the angles from `q` by the position of a pair in `path`. For `PATH[2:]`, "
        "joint2 therefore rotates by the angle of another joint. The index of a "
        "joint's angle should be `model.joint(name).qposadr[0]`.",
        on(PANDA, PATH[2:], count=2),
        mistaken=partial(_by_place, first=first),
    )


row = Row(
    Pose(wrong_way="maps world coordinates to end-effector coordinates"),
    truth=by_mujoco,
    near=NEAR,
    alike=[*places.ALIKE, {"stops-at-link7", "stops-early"}],
    held_out=[
        HeldOut(
            "path-ignored",
            "Your pose is correct for the whole arm, but your function ignores `path`. "
            "For the path to link4, your function still returns the pose of the end "
            "effector.",
            on(PANDA, PATH[:5], count=2),
            mistaken=lambda model, q, path: by_mujoco(model, q),
        ),
        HeldOut(
            "path-counted",
            "Your pose is correct for `PATH` and its prefixes, but your function "
            "uses only the number of pairs in `path`. For `PATH[1:]`, your function "
            "returns the pose of link7. Take the body and joint names from the "
            "argument `path`.",
            on(PANDA, PATH[1:], count=2),
            mistaken=lambda model, q, path: fk(model, q, PATH[: len(path)]),
        ),
        _counted("angle-by-place", 0),  # the first joint on the path has `q[0]`
        _counted("angle-by-place", -1),  # pair i has `q[i - 1]`
        places.TYPED_IN,
    ],
    probe=_prefixes,
    unnamed=places.along(PATH),
    near_miss=places.flange,
    measured=places.measured,
    slips=[places.NO_INDEX],
)
row.inputs(on(PANDA))


# The chain is right, but ends somewhere else.

row.wrongs(ends.elsewhere)
row.wrong(ends.fingertip_for_the_end)


def stops_early(row, k, end):
    """Take the chains that end at link k, with its joint's rotation or without."""
    says = f"your code ends the chain at link{k}. The chain should end at {end}"
    row.wrong("stops-early", says)(
        lambda model, q, path=PATH: fk(model, q, path[: k + 1])
    )
    says = f"your code ends the chain at link{k} and omits the rotation of joint{k}. "
    says += f"The chain should end at {end}"
    row.wrong("stops-early", says)(
        lambda model, q, path=PATH: fk(model, q, path[:k]) @ link(model, path[k][0])
    )


for k in range(1, 8):
    stops_early(row, k, "the end effector")


# The joints' angles.


@row.wrongs
def _(model, q, path=PATH):
    """home-whatever-q: your code always returns the pose for the ready configuration.
      Use the joint angles in `q` instead
    ready-subtracted: your pose belongs to `q` minus the angles of the ready
      configuration. Each joint should rotate by its entry in `q`
    """
    angles = {
        "home-whatever-q": READY_Q,
        "ready-subtracted": q - READY_Q,
    }
    return {slug: partial(fk, model, x, path) for slug, x in angles.items()}


row.of_argument("q", LEFT_OUT, ONE_OFF)
row.wrongs(products.in_order)
row.wrong(products.chain_reversed)
row.wrongs(products.on_each_other)
row.wrong(products.offset_turned_too_late)
row.wrong(products.turns_in_reverse)

# The factors themselves, and the finished pose.

IN_LINKS = "in each link's transform, "
# The model has quaternions of length 1, the file has not. Of the file's, turned by 0 or
# 90 degrees, the last two make the same matrix; task 1.4 tells them apart.
OF_THE_FILE = {
    "not-normalised",
    "xyzw-and-not-normalised",
    "factor-two-missing",
    "short-ones-kept",
}
# link0 sits on the world's origin: some leave it out, and these make no difference.
NOT_AT_LINK0 = {
    "move-then-turn", "t-turned-back", "R-transposed", "inverse-returned",
    "T-transposed", "t-in-last-row", "t-lost", "R-lost", "t-negated", "millimetres",
    "whole-numbers", "half-angle", "corner-zero",
}  # fmt: skip
row.reached_by("link_T", IN_LINKS, but=OF_THE_FILE)
row.reached_by(
    "link_T",
    IN_LINKS,
    but=OF_THE_FILE | NOT_AT_LINK0,
    given=lambda model, q, path=PATH: (model, q, path[1:]),
)


def _typed(formula, first=0):
    """Return compose_fk with the file's quaternions, and a formula for R."""

    def compose_fk(model, q, path=PATH):
        T = np.eye(4)
        for name, joint in path[first:]:
            body = model.body(name)
            L = pose(formula(as_written(body.quat)), body.pos)
            T = T @ L @ turn(model, q, joint)
        return T

    return compose_fk


for formula in UNNORMALISED:
    rolled = lambda quat, formula=formula: formula(np.roll(quat, 1))  # noqa: E731
    row.wrong("not-normalised", IN_LINKS + NOT_NORMALISED)(_typed(formula))
    for code in (_typed(rolled), _typed(rolled, 1)):
        says = IN_LINKS + XYZW_AND_NOT_NORMALISED
        row.wrong("xyzw-and-not-normalised", says, both=True)(code)

row.reached_by("joint_T", "in each joint's transform, ")


# Right and nearly right.


@row.right  # Asks each body for its parent until the world is reached; no path.
def _(model, q):
    def at(body):
        if body == 0:
            return np.eye(4)
        T = at(model.body_parentid[body])
        L = pose(se3.quat_to_R(model.body_quat[body]), model.body_pos[body])
        joint = model.body_jntadr[body]
        return T @ L @ (np.eye(4) if joint < 0 else turn(model, q, joint))

    return at(model.site("attachment_site").bodyid[0])


@row.close("flange-turned-exactly")  # By 135 degrees; the file has seven digits.
def _(model, q):
    flange = pose(se3.Rz(0.75 * np.pi), FLANGE_POS)
    return fk(model, q, PATH[:-1]) @ flange


for formula in UNNORMALISED:  # Typed off the file: of length 1 to seven digits only.
    row.close("flange-not-normalised")(
        lambda model, q, formula=formula: (
            fk(model, q, PATH[:-1]) @ pose(formula(FLANGE_QUAT), FLANGE_POS)
        )
    )


@row.close("float32")  # Right to seven digits, which is what it can hold.
def _(model, q):
    T = np.eye(4, dtype=np.float32)
    for L, J in steps(model, q, PATH):
        T = T @ L.astype(np.float32) @ J.astype(np.float32)
    return T


# What the hooks and the further questions name.


@row.wrong("path-ignored")
def _(model, q, path=PATH):
    return fk(model, q)


FROM_THE_BASE = "each path in the lab begins at the base"


@row.wrong("angle-by-place", hidden=FROM_THE_BASE)
def _(model, q, path=PATH):
    angle = iter(q)
    return product(
        link(model, name) @ (pose(se3.Rz(next(angle)), np.zeros(3)) if joint else I)
        for name, joint in path
    )


@row.wrong("angle-by-place", hidden=FROM_THE_BASE)
def _(model, q, path=PATH):
    return product(
        link(model, name) @ (pose(se3.Rz(q[i - 1]), np.zeros(3)) if joint else I)
        for i, (name, joint) in enumerate(path)
    )


@row.wrong("typed-in", hidden="the lab has one Panda, and the numbers are its")
def _(model, q, path=PATH):
    return fk(PANDA.model, q, path)


@row.wrong("typed-in", hidden="link0 of this Panda sits on the origin")
def _(model, q, path=PATH):
    return fk(model, q, path[1:])


@row.wrong("all-zeros")  # Read from MuJoCo's data before anything was computed.
def _(model, q, path=PATH):
    site = mujoco.MjData(model).site("attachment_site")
    T = np.zeros((4, 4))
    T[:3, :3] = site.xmat.reshape(3, 3)
    T[:3, 3] = site.xpos
    return T


ONE_JOINT = (
    ("joint-skipped", lambda q: np.r_[q[:3], 0.0, q[4:]]),
    ("joint-fed-another", lambda q: np.r_[q[:4], q[3], q[5:]]),
    ("turns-backwards", lambda q: np.r_[q[:5], -q[5], q[6:]]),
    ("joint-angle-off", lambda q: np.r_[q[:2], q[2] ** 2, q[3:]]),
    ("pose-off", lambda q: np.r_[q[:2], q[2:] ** 2]),  # told by the probes: from link3
)
for slug, angles in ONE_JOINT:
    row.wrong(slug)(
        lambda model, q, path=PATH, angles=angles: fk(model, angles(q), path)
    )


def _links(**instead):
    """Return compose_fk without a path, other factors for some links."""

    def compose_fk(model, q):
        return product(
            instead.get(name, lambda L: L)(L) @ J
            for (name, _), (L, J) in zip(PATH, steps(model, q, PATH), strict=True)
        )

    return compose_fk


row.wrong("link-skipped")(_links(link5=lambda L: np.eye(4)))
row.wrong("link-twice")(_links(link5=lambda L: L @ L))
row.wrong("R-transposed")(_links(link3=lambda L: pose(L[:3, :3].T, L[:3, 3])))
row.wrong("one-link-off")(_links(link5=lambda L: L + 0.01 * np.eye(4, k=3)))
row.wrong("pose-off")(
    _links(link3=lambda L: pose(L[:3, :3], -L[:3, 3]), link5=rigid_inverse)
)


@row.wrong("joint-before-link+stops-at-link7")
def _(model, q):
    return product(J @ L for L, J in steps(model, q, PATH[:-1]))
