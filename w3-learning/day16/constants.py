"""The sensitivity of Day 16's numbers: each constant doubled, measured, explained."""

from types import SimpleNamespace
from unittest.mock import patch

import numpy as np

from labkit.lesson.constants import Numbers, between, same, times
from labkit.lesson.day import find_day
from labkit.lesson.lab_module import lab_of

LAB = lab_of(find_day(16))
DAY = LAB.day15_mujoco
SILENT = SimpleNamespace(training=lambda title, steps: range(1, steps + 1))

numbers = Numbers(
    wait="pause: {} steps",
    chunk="entries of a chunk: {}",
    demos="demonstrations: {}",
    seed="seed: {}",
    updates="steps of Adam: {}",
    beta="beta: {}",
    plans="plans: {}",
    decay="decay: {}",
)


@numbers.add(
    "padding of the chunks of 20 demonstrations", "{:.0f} %",
    chunk=between(2.0, 2.2, "K (K - 1) / 2 of the K n entries of an episode: (K - 1) / (2 n)"),
    wait=between(0.85, 0.92, "(K - 1) / (2 n), and n grows from 68 to 76 rows"),
    demos=same("each episode has the same padding"),
    seed=same("each episode has the same length"),
)  # fmt: skip
def padding(chunk=LAB.PAUSE_K, wait=LAB.WAIT, demos=20, seed=LAB.SEED):
    """Return the percentage of the entries that are padding."""
    episodes = DAY.dock_demonstrations(demos, seed, coin=False, wait=wait)
    return 100 * (1 - LAB.Data(episodes, chunk).mask.mean())


@numbers.add(
    "squared error: speed of the third entry", "{:.2f}",
    wait=between(0.5, 0.65, "3 of 17 rows instead of 3 of 9"),
    updates=between(0.9, 1.02, "the network is closer to the mean"),
    seed=between(0.95, 1.05, "other demonstrations of the same kind", to=2),
)  # fmt: skip
def third(wait=LAB.WAIT, updates=LAB.UPDATES, seed=LAB.SEED):
    """Return the speed of the third entry at the dock."""
    with patch.multiple(LAB, WAIT=wait, UPDATES=updates, SEED=seed):
        episodes = DAY.dock_demonstrations(LAB.DEMOS, seed, coin=False, wait=wait)
        data = LAB.Data(episodes, LAB.PAUSE_K)
        net = LAB.train_chunks(SILENT, "", data, LAB.masked_l2)
        return LAB.speeds(data, net, episodes)[2]


@numbers.add(
    "KL divergence at the dock, nats", "{:.1f}",
    beta=between(0.0, 0.5, "each nat adds twice as much to the loss, so z collapses"),
    chunk=between(0.4, 0.7, "the early entries show the side, and each has half the weight"),
    seed=between(0.8, 1.2, "other coin tosses", to=2),
)  # fmt: skip
def dock(beta=LAB.BETA, chunk=LAB.K, seed=LAB.SEED):
    """Return the mean KL divergence of the rows at the dock."""
    episodes = DAY.dock_demonstrations(LAB.DEMOS, seed)
    with patch.multiple(LAB, BETA=beta, SEED=seed):
        model = LAB.Latent(SILENT, LAB.Data(episodes, chunk))
    kl = LAB.kl_to_prior(*model.encode())
    return kl[model.data.first].mean()


@numbers.add(
    "noise of the mean of equally wrong plans", "{:.3f}",
    plans=times(1 / np.sqrt(2), "1 / sqrt(k) for almost equal weights"),
    decay=same("the weights are still almost equal"),
)  # fmt: skip
def noise(plans=LAB.K, decay=LAB.DECAY):
    """Return the standard deviation of the mean of independent errors."""
    return LAB.ensemble_noise(plans, decay)
