"""What the inspector shows, as numbers: one configuration seen by two judges.

Nothing here draws. MuJoCo's poses come from `robo47.verify`, those by hand from
`robo47.kinematics`; metres and radians.
"""

from dataclasses import replace
from typing import NamedTuple

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from robo47 import panda, se3
from robo47.checks import Array, array
from robo47.kinematics import Chain, chain_to, fk, fk_all, frame_names
from robo47.verify import mujoco_poses, random_q

AGREES = 1e-8  # "the same to 8 decimals"; honest rounding leaves about 1e-15
END = "ee"  # what the end effector's frame is called in T_world_ee


class Step(NamedTuple):
    """One factor of the chain: T_world_link = T_world_previous @ T_previous_link."""

    link: str
    previous: str
    T_world_previous: Array
    T_previous_link: Array
    T_world_link: Array


class TwoOrders(NamedTuple):
    """The same two factors multiplied both ways, and how far apart they end."""

    right: Array
    left: Array
    metres: float


class Arm:
    """One arm in one configuration, with every frame's pose from both judges."""

    def __init__(self, model: mujoco.MjModel, end_frame: str) -> None:
        """Start at the handout's `home_q`.

        Args:
            model: a Panda, see `robo47.panda.load`.
            end_frame: full name of the frame that is called `ee`.
        """
        self.model = model
        self.chain = chain_to(model, end_frame)
        self.names = _short_names(model, self.chain)
        home = panda.home_q(model)
        ready = np.concatenate([panda.READY_Q, home[len(panda.READY_Q) :]])
        self.named_q = {"home": home, "ready": ready, "zero": np.zeros(model.nq)}
        self.joints = [model.joint(j).name for j in range(model.njnt)]
        self.move(ready)

    def move(self, q: ArrayLike) -> None:
        """Take a configuration and compute every frame twice.

        Args:
            q: radians and metres, (nq,); it may be out of limits.

        Raises:
            ValueError: wrong shape, or a number that is not finite.
        """
        self.q = array(q, "q", (self.model.nq,)).copy()
        self.by_mujoco = {
            name: T[0] for name, T in mujoco_poses(self.model, self.q[None]).items()
        }
        self.by_hand = fk_all(self.model, self.q)

    def random_q(self, seed: int) -> Array:
        """Return a configuration within the limits, to the sliders' four decimals.

        Args:
            seed: the same seed gives the same configuration.
        """
        return np.round(random_q(self.model, 1, seed)[0], 4)

    def difference(self, name: str, T: Array | None = None) -> float:
        """Return the largest difference of any entry between MuJoCo's pose and ours.

        Args:
            name: short name of the frame, a key of `names`.
            T: our pose, (4, 4); `by_hand` unless given.
        """
        full = self.names[name]
        ours = self.by_hand[full] if T is None else T
        return float(np.abs(self.by_mujoco[full] - ours).max())

    def limits(self, joint: str) -> tuple[float, float]:
        """Return a joint's lowest and highest value.

        Args:
            joint: its name.
        """
        low, high = self.model.joint(joint).range
        return float(low), float(high)

    def out_of_limits(self) -> list[str]:
        """Return one sentence for every joint that is outside its range."""
        return [
            f"{joint} = {q:.4f} is outside [{low:.4f}, {high:.4f}]"
            for joint, q in zip(self.joints, self.q, strict=True)
            for low, high in [self.limits(joint)]
            if not low <= q <= high
        ]

    def steps(self) -> list[Step]:
        """Return the chain's product, link by link, from the world to `ee`.

        Every factor is composed by hand from that link alone: what the file says of
        it and its joints' q.
        """
        done, steps = Step("world", "", np.eye(4), np.eye(4), np.eye(4)), []
        for i, link in enumerate(self.chain.links):
            one = replace(self.chain, links=(link,), T_link_frame=np.eye(4))
            name = link.name.partition(":")[2]
            if i == len(self.chain.links) - 1:  # the last body leads on to the frame
                one, name = replace(one, T_link_frame=self.chain.T_link_frame), END
            T_previous_link = fk(one, self.q)
            before = done.T_world_link
            done = Step(
                name, done.link, before, T_previous_link, before @ T_previous_link
            )
            steps.append(done)
        return steps

    def both_orders(self, angle: float, x: float) -> TwoOrders:
        """Return T_world_ee @ T_extra (right) and T_extra @ T_world_ee (left).

        Args:
            angle: T_extra's turn about z, radians.
            x: T_extra's shift along x, metres.
        """
        T_world_ee = self.by_hand[self.names[END]]
        T_extra = extra(angle, x)
        right, left = T_world_ee @ T_extra, T_extra @ T_world_ee
        return TwoOrders(right, left, float(se3.pose_error(right, left)[0]))


def extra(angle: float, x: float) -> Array:
    """Return the lab's T_extra: turn about z, moved along x, (4, 4).

    Args:
        angle: radians.
        x: metres.
    """
    return se3.make_T(se3.Rz(angle), [x, 0.0, 0.0])


def _short_names(model: mujoco.MjModel, chain: Chain) -> dict[str, str]:
    """Return {short name: full frame name}, `ee` first, the world left out.

    A body that is only there to carry the end's site (`attachment`) shares its pose
    with `ee` and would hide it.
    """
    carrier = chain.links[-1].name
    bodies = [
        full
        for full in frame_names(model)
        if full.startswith("body:") and full not in ("body:world", carrier)
    ]
    names = {END: chain.frame}
    return names | {full.partition(":")[2]: full for full in bodies}
