"""The inspector's numbers: one configuration seen by two judges.

Nothing here draws. MuJoCo's poses come from `robo47.verify`, the library's from
`robo47.kinematics`; the student's own are in `labkit.inspector.ghost`. Metres, radians.
"""

from collections.abc import Mapping
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from robo47 import panda
from robo47.checks import Array, array
from robo47.kinematics import Chain, Link, chain_to, fk, fk_all, frame_names
from robo47.verify import mujoco_poses, random_q

AGREES = 1e-8  # "the same to 8 decimals"; honest rounding leaves about 1e-15
SOFT = 0.005  # radians by which the simulator's limits give way
END = "ee"  # the name of the end effector's frame in T_world_ee


class Step(NamedTuple):
    """One factor of the chain: after = before @ factor; matrices are (4, 4)."""

    link: str  # the link that the factor leads to or turns; short name
    joint: str  # the joint that turns it; "" for a constant pose of the file
    name: str
    q: float  # the joint's value; 0 for a pose of the file
    before: Array  # T_world_... so far
    factor: Array
    after: Array  # T_world_link once the link's own joint is in
    moves: NDArray[np.bool_]  # the entries of the factor that depend on q
    # the wrong entries, if the factor is a student's
    off: NDArray[np.bool_] | None = None


class Arm:
    """One arm in one configuration, with every frame's pose from both judges."""

    def __init__(self, model: mujoco.MjModel, end_frame: str) -> None:
        """Start at the handout's `home_q`; another robot at its first key.

        It may be any chain of hinges and slides; `ee` is a frame by its full name.
        """
        self.model = model
        self.chain = chain_to(model, end_frame)
        self.names = _short_names(model, self.chain)
        self.joints = [model.joint(j).name for j in range(model.njnt)]
        home = (model.key_qpos if model.nkey else [model.qpos0])[0].copy()
        self.named_q = {"home": home}
        count = len(panda.READY_Q)
        if self.joints[:count] == list(panda.ARM_JOINTS):
            self.named_q["ready"] = np.concatenate([panda.READY_Q, home[count:]])
        self.named_q["zero"] = np.zeros(model.nq)
        self.move(self.named_q.get("ready", home))

    def move(self, q: ArrayLike) -> None:
        """Take a configuration, (nq,), also out of limits; compute every frame twice.

        Raises:
            ValueError: wrong shape, or a number that is not finite.
        """
        self.q = array(q, "q", (self.model.nq,)).copy()
        self.by_mujoco = {
            name: T[0] for name, T in mujoco_poses(self.model, self.q[None]).items()
        }
        by_hand = fk_all(self.model, self.q)
        self.by_library = {name: by_hand[full] for name, full in self.names.items()}

    def pose(self, name: str) -> Array:
        """Return MuJoCo's T_world_NAME, (4, 4); the name is a key of `names`."""
        return self.by_mujoco[self.names[name]]

    def poses_at(self, q: Array) -> dict[str, Array]:
        """Return MuJoCo's poses at a configuration, (nq,), as {short name: (4, 4)}."""
        poses = mujoco_poses(self.model, np.asarray(q)[None])
        return {name: poses[full][0] for name, full in self.names.items()}

    def carried(self, poses: Mapping[str, Array]) -> dict[str, Array]:
        """Return poses of links, and those of the bodies that the last of them carries.

        A hand and its fingers stay where they are on it.
        """
        moved = [link.name for link in self.chain.links if link.joints]
        tip = moved[-1].removeprefix("body:")
        if tip not in poses:
            return dict(poses)
        move = poses[tip] @ np.linalg.inv(self.pose(tip))
        after = {self.model.body(tip).id}
        for body in range(self.model.nbody):
            if self.model.body_parentid[body] in after:
                after.add(body)
        names = [self.model.body(body).name for body in after]
        there = {name: move @ self.by_mujoco[f"body:{name}"] for name in names}
        return there | dict(poses)

    def random_q(self, seed: int) -> Array:
        """Return a configuration within the limits, to the sliders' four decimals."""
        return np.round(random_q(self.model, 1, seed)[0], 4)

    def difference(self, name: str, T: Array) -> float:
        """Return the largest difference of any entry of T, (4, 4), to MuJoCo's pose."""
        return float(np.abs(self.pose(name) - T).max())

    def out_of_limits(self) -> list[str]:
        """Return one sentence for every joint that is outside its range."""
        joints = zip(self.joints, self.q, self.model.jnt_range, strict=True)
        return [
            f"{joint} = {q:.4f} is outside [{low:.4f}, {high:.4f}]"
            for joint, q, (low, high) in joints
            if not low - SOFT <= q <= high + SOFT
        ]

    def steps(self) -> list[Step]:
        """Return the chain's product, factor by factor, from the world to `ee`.

        As the lab has it: one factor per link (what the file says of it) and one per
        joint (what q adds).
        """
        steps = []
        before = np.eye(4)
        previous = "world"
        for link in self.chain.links:
            name = link.name.partition(":")[2]
            T = link.T_parent_link
            if link is self.chain.links[-1]:  # the last body leads on to the frame
                name = END
                T = T @ self.chain.T_link_frame
            factors = [("", f"T_{previous}_{name}", 0.0, T, T)]
            for joint in link.joints:
                one = Link(link.name, np.eye(4), (joint,))
                alone = Chain(self.chain.frame, (one,), nq=self.chain.nq)
                says = f"T(q of {joint.name})"
                at = float(self.q[joint.qpos_adr])
                q = self.q.copy()
                q[joint.qpos_adr] += 0.3
                T = fk(alone, self.q)
                elsewhere = fk(alone, q)
                factors.append((joint.name, says, at, T, elsewhere))
            for joint_name, says, at, T, elsewhere in factors:
                after = before @ T
                moves = elsewhere != T
                steps.append(Step(name, joint_name, says, at, before, T, after, moves))
                before = after
            previous = name
        return steps


def _short_names(model: mujoco.MjModel, chain: Chain) -> dict[str, str]:
    """Return {short name: full frame name}, `ee` first, the world left out.

    A body that is only there to carry the end's site (`attachment`) shares its pose
    with `ee` and would hide it.
    """
    hidden = "body:world", chain.links[-1].name
    return {END: chain.frame} | {
        full.removeprefix("body:"): full
        for full in frame_names(model)
        if full.startswith("body:") and full not in hidden
    }
