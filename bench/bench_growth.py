"""How the time per configuration grows with their number, and with the joints."""

import time

import mujoco
import numpy as np

from robo47 import kinematics, panda, verify

COUNTS = [10**k for k in range(8)]
JOINTS = [1, 2, 3, 5, 7, 10, 20, 30, 40, 50]
PER_ROBOT = 20_000


def run(largest: int = COUNTS[-1]) -> dict:
    """Time fk from one configuration to ten million, and from 1 to 50 joints.

    Args:
        largest: the most configurations at once.

    Returns:
        {"by_count": {n: us each}, "by_joints": {joints: us each},
        "memory_mb": most memory beyond input and output at the largest count}.
    """
    chain = kinematics.chain_to(panda.load("panda_nohand"), "attachment_site")
    counts = [n for n in COUNTS if n <= largest]
    q = verify.random_q(panda.load("panda_nohand"), counts[-1], seed=47)
    return {
        "by_count": {str(n): _us(chain, q[:n]) for n in counts},
        "by_joints": {str(n): _us(_snake(n), _angles(n)) for n in JOINTS},
        "memory_mb": _extra_memory(chain, q) / 1e6,
    }


def _us(chain: kinematics.Chain, q: np.ndarray) -> float:
    """Return the fastest of some runs, microseconds per configuration."""
    kinematics.fk(chain, q[:1])  # works the chain's plan out, once
    best = np.inf
    for _ in range(max(3, min(50, 200_000 // len(q)))):
        start = time.perf_counter()
        kinematics.fk(chain, q)
        best = min(best, time.perf_counter() - start)
    return best / len(q) * 1e6


def _snake(joints: int) -> kinematics.Chain:
    """Return a chain of links that turn about x, y and z in turn."""
    axes = ["1 0 0", "0 1 0", "0 0 1"]
    bodies = "".join(
        f'<body name="b{i}" pos="0 0 0.1"><joint axis="{axes[i % 3]}"/><geom size="1"/>'
        for i in range(joints)
    )
    xml = f"<mujoco><worldbody>{bodies}{'</body>' * joints}</worldbody></mujoco>"
    return kinematics.chain_to(mujoco.MjModel.from_xml_string(xml), f"b{joints - 1}")


def _angles(joints: int) -> np.ndarray:
    return np.random.default_rng(47).uniform(-3, 3, (PER_ROBOT, joints))


def _extra_memory(chain: kinematics.Chain, q: np.ndarray) -> float:
    """Return the peak number of bytes beyond what is returned."""
    import tracemalloc

    tracemalloc.start()
    T = kinematics.fk(chain, q)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    return peak - T.nbytes
