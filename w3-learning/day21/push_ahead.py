"""21.4 `push_ahead(obs, actions, dt, steps, reach)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Vector

row = Row(Vector((4,), "m", names=("pusher x", "pusher y", "puck x", "puck y")))


def scene(rng, distance, k, steps, reach=0.065, speed=0.1):
    """Return a pusher, a puck at a distance from it, and actions towards the puck."""
    way, aside = rng.uniform(-np.pi, np.pi), rng.uniform(-0.6, 0.6)
    pusher = rng.numbers(-0.2, 0.2, 2)
    puck = pusher + distance * np.array([np.cos(way), np.sin(way)])
    angles = way + aside + rng.uniform(-0.3, 0.3, k)
    actions = speed * np.stack([np.cos(angles), np.sin(angles)], axis=1)
    obs = np.concatenate([pusher, puck]).round(4)
    return obs, actions.round(5), 0.1, steps, reach


@row.inputs
def _(rng):
    yield np.array([0, 0, 0.06, 0]), np.array([[0.1, 0]]), 0.1, 5, 0.065
    yield np.array([0, 0, 0.05, 0.04]), np.array([[0.1, 0]] * 4), 0.1, 5, 0.065
    yield np.array([0, 0, 0.2, 0.1]), np.array([[0.1, -0.1]]), 0.1, 3, 0.065  # free
    yield np.array([0.1, 0.2, 0.1, 0.3]), np.zeros((0, 2)), 0.1, 5, 0.065
    yield np.array([0, 0, 0.06, 0]), np.array([[-0.2, 0], [-0.2, 0]]), 0.1, 5, 0.065
    yield scene(rng, 0.07, 3, 1)
    yield scene(rng, 0.07, 2, 7, speed=0.2)
    yield scene(rng, 0.3, 5, 2)
    for _ in range(4):
        k, steps = int(rng.integers(1, 5)), int(rng.integers(2, 6))
        yield scene(rng, float(rng.numbers(0.066, 0.09)), k, steps)


row.cases(
    actions_without_a_contact=lambda obs, actions, dt, steps, reach: bool(
        np.linalg.norm(obs[2:] - obs[:2])
        > reach + dt * np.sum(np.linalg.norm(actions, axis=1))
    ),
    actions_with_a_contact=lambda obs, actions, dt, steps, reach: bool(
        np.linalg.norm(obs[2:] - obs[:2]) < reach and len(actions)
    ),
)


@row.rare
def _(rng):
    yield scene(rng, 0.3, 2, 3)
    yield scene(rng, 0.3, 2, 1)
    yield scene(rng, 0.063, 2, 3)
    size = float(rng.choice([0.2, 0.5, 3.0]))  # the same scene with other bodies
    obs, actions, dt, steps, reach = scene(rng, float(rng.choice([0.3, 0.063])), 2, 3)
    yield (
        (size * obs).round(5),
        (size * actions).round(5),
        dt,
        steps,
        round(size * reach, 4),
    )


def pushed(obs, actions, dt, steps, reach, part):
    """Return the observation after each part's rule for pusher and puck."""
    pusher, puck = obs[:2], obs[2:]
    for action in actions:
        for _ in range(steps):
            pusher, puck = part(pusher, puck, dt / steps * action, reach)
    return np.concatenate([pusher, puck])


def along(pusher, puck, move, reach):
    """Return both after a part in which the puck moves with the pusher."""
    near = np.linalg.norm(puck - pusher - move) < reach
    return pusher + move, puck + move * near


def gives_way(pusher, puck, move, reach):
    """Return both after a part in which the pusher is moved back."""
    pusher = pusher + move
    apart = puck - pusher
    far = np.linalg.norm(apart)
    return (puck - apart * reach / far if far < reach else pusher), puck


def halves(pusher, puck, move, reach):
    """Return both after a part in which each body takes half of the overlap."""
    pusher = pusher + move
    apart = puck - pusher
    far = np.linalg.norm(apart)
    half = max(0, reach / far - 1) / 2 * apart
    return pusher - half, puck + half


def pulls(pusher, puck, move, reach):
    """Return both after a part in which the puck is brought to the distance reach."""
    pusher = pusher + move
    apart = puck - pusher
    return pusher, pusher + apart * reach / np.linalg.norm(apart)


def before(pusher, puck, move, reach):
    """Return both after a part in which the puck is moved before the pusher."""
    apart = puck - pusher
    far = np.linalg.norm(apart)
    return pusher + move, pusher + apart * max(1, reach / far)


def ahead(pusher, puck, move, reach):
    """Return both after a part in which the puck is moved along the action."""
    pusher = pusher + move
    apart = puck - pusher
    speed = np.linalg.norm(move)
    overlap = reach - np.linalg.norm(apart)
    return pusher, puck + max(0, overlap) * move / (speed or 1)


def old_line(pusher, puck, move, reach):
    """Return both after a part that uses the line of centres before the move."""
    apart = puck - pusher
    near = np.linalg.norm(apart - move) < reach
    to = pusher + move + apart * reach / np.linalg.norm(apart)
    return pusher + move, to if near else puck


def old_direction(pusher, puck, move, reach):
    """Return both after a part that moves by the overlap along the line before it."""
    apart = puck - pusher
    overlap = max(0, reach - np.linalg.norm(apart - move))
    return pusher + move, puck + overlap * apart / np.linalg.norm(apart)


def squared(pusher, puck, move, reach):
    """Return both after a part that compares the squared distance with reach."""
    pusher = pusher + move
    apart = puck - pusher
    far = np.linalg.norm(apart)
    return pusher, pusher + apart * reach / far if far**2 < reach else puck


def half(pusher, puck, move, reach):
    """Return both after a part in which the puck is moved by half of the overlap."""
    pusher = pusher + move
    apart = puck - pusher
    return pusher, puck + max(0, reach / np.linalg.norm(apart) - 1) / 2 * apart


def component(pusher, puck, move, reach):
    """Return both after a part that moves the puck by the pusher's component."""
    pusher = pusher + move
    apart = puck - pusher
    far = np.linalg.norm(apart)
    forward = max(0, apart @ move) * apart / far**2
    return pusher, puck + forward * (far < reach)


def twice(pusher, puck, move, reach):
    """Return both after a part in which the puck is moved by reach."""
    pusher = pusher + move
    apart = puck - pusher
    far = np.linalg.norm(apart)
    return pusher, puck + apart * reach / far * (far < reach)


def from_the_start(obs, actions, dt, steps, reach):
    """Return the observation if each action begins at the pusher's first position."""
    end = obs
    for action in actions:
        begin = np.concatenate([obs[:2], end[2:]])
        end = pushed(begin, action[None], dt, steps, reach, whole)
    return end


@row.wrongs(
    hidden={
        "old-line 2": "in parts so short both lines are nearly the same",
        "interleaved": "the actions of its exact push are equal",
    }
)
def _(obs, actions, dt, steps, reach):
    """one-part: your code moves the pusher by a whole action before it moves the puck.
      Divide each action into `steps` parts, because the direction of the push changes
      as the puck moves
    puck-moves-along: your code moves a puck in contact by the same displacement as the
      pusher. Move the puck along the line of centres instead, because the contact has
      no friction
    along-the-action: your code moves the puck in the direction of the action. Move the
      puck along the line of centres instead, because the contact has no friction
    pusher-stops: your code moves the pusher away from the puck if the distance is below
      `reach`. Move the puck instead, because the pusher moves as commanded
    half-each: your code moves each body by half of the overlap. Move only the puck,
      because the pusher moves as commanded
    pulls: your code moves the puck to the distance `reach` even if the puck is farther
      away. Move the puck only if it is nearer than `reach`, because the pusher cannot
      pull
    puck-first: your code moves the puck before the pusher. Move the pusher first in
      each part, because the motion of the pusher causes the overlap
    by-the-reach: your code moves the puck by the distance `reach`. Move the puck to the
      distance `reach` from the pusher instead
    one-action: your code uses only the first action. Apply all actions, one after the
      other
    parts-not-shorter: your code moves the pusher by a whole action in each part. Divide
      the displacement of each action by `steps`
    old-line: your code uses the line of centres before the pusher's motion. Use the
      line of centres after the motion instead, because the overlap is along that line
    old-line 2: your code uses the line of centres before the pusher's motion. Use the
      line of centres after the motion instead, because the overlap is along that line
    half-overlap: your code moves the puck by half of the overlap. Move the puck by the
      whole overlap instead, so that the distance is `reach`
    component: your code moves the puck by the component of the pusher's motion along
      the line of centres. Move the puck until the distance is `reach` instead
    each-from-the-start: your code begins each action at the initial position of the
      pusher. Begin each action where the previous action ended
    relative: your function returns the position of the puck relative to the pusher.
      Return the position of the puck in the plane instead
    squared: your code compares the squared distance with `reach`. Compare the distance
      itself with `reach` instead
    puck-first-in-obs: your code treats the first two entries of `obs` as the puck.
      These entries are the position of the pusher
    puck-first-in-obs 2: your code treats the first two entries of `obs` as the puck.
      These entries are the position of the pusher
    interleaved: your code executes one part of every action before the next part of the
      first action. Finish all parts of an action before you begin the next action
    last-contact: your code does not move the puck after the last motion of the pusher.
      Move the puck in every part, including the last part
    puck-only: your function returns the initial position of the pusher. Return the
      position of the pusher after all actions. The position of the puck is correct
    """
    given = obs, actions, dt, steps, reach
    other = np.roll(obs, 2), actions, dt, steps, reach
    moves = np.tile(actions, (steps, 1))
    pushes = np.repeat(actions, steps, axis=0)
    start = pushed(obs, pushes[:-1], dt / steps, 1, reach, whole)
    last = np.append(dt / steps * pushes[-1], (0, 0)) if len(pushes) else 0
    right = pushed(*given, whole)
    return {
        "one-part": pushed(obs, actions, dt, 1, reach, whole),
        "puck-moves-along": pushed(*given, along),
        "along-the-action": pushed(*given, ahead),
        "pusher-stops": pushed(*given, gives_way),
        "half-each": pushed(*given, halves),
        "pulls": pushed(*given, pulls),
        "puck-first": pushed(*given, before),
        "by-the-reach": pushed(*given, twice),
        "one-action": pushed(obs, actions[:1], dt, steps, reach, whole),
        "parts-not-shorter": pushed(obs, actions, dt * steps, steps, reach, whole),
        "old-line": pushed(*given, old_line),
        "old-line 2": pushed(*given, old_direction),
        "half-overlap": pushed(*given, half),
        "component": pushed(*given, component),
        "each-from-the-start": from_the_start(*given),
        "relative": right - np.append((0, 0), right[:2]),
        "squared": pushed(*given, squared),
        "puck-first-in-obs": np.roll(pushed(*other, whole), 2),
        "puck-first-in-obs 2": pushed(*other, whole),
        "interleaved": pushed(obs, moves, dt / steps, 1, reach, whole),
        "last-contact": start + last,
        "puck-only": np.concatenate([obs[:2], right[2:]]),
    }


def whole(pusher, puck, move, reach):
    """Return both after a part: the right rule."""
    pusher = pusher + move
    apart = puck - pusher
    return pusher, pusher + apart * max(1, reach / np.linalg.norm(apart))


@row.right  # In complex numbers.
def _(obs, actions, dt, steps, reach):
    pusher, puck = complex(*obs[:2]), complex(*obs[2:])
    for vx, vy in actions:
        for _ in range(steps):
            pusher += (vx + 1j * vy) * dt / steps
            apart = puck - pusher
            puck = pusher + apart * max(1, reach / abs(apart))
    return np.array([pusher.real, pusher.imag, puck.real, puck.imag])


@row.right  # By the overlap.
def _(obs, actions, dt, steps, reach):
    x, y, u, v = obs
    for a, b in np.repeat(actions, steps, axis=0):
        x, y = x + a * dt / steps, y + b * dt / steps
        far = np.hypot(u - x, v - y)
        overlap = max(0.0, reach - far)
        u, v = u + overlap * (u - x) / far, v + overlap * (v - y) / far
    return np.array([x, y, u, v])


@row.spans
def _(rng):
    yield scene(rng, 0.066, 15, 20)
    yield scene(rng, 0.0651, 1, 200)
    yield scene(rng, 0.065, 3, 5, speed=8e-4)


row.at_least_0(dt="a duration", steps="a number of parts", reach="a distance")
