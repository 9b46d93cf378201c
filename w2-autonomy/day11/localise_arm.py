"""Where answers about the arm's joints of Day 11 are right, and where not."""

from typing import Any

import numpy as np

from labkit.judge import Case, Finding
from robo47.checks import Array

from . import localise
from .localise import Group, Sorted, number

KEPT = {
    "joint 1 to the link's own": lambda i, link: i < link,
    "joint 1 to the one before the link's own": lambda i, link: i < link - 1,
    "joint 2 to the link's own": lambda i, link: (i > 0) & (i < link),
    "joint 1 to one behind the link's own": lambda i, link: i < link + 1,
    "the joints behind the link": lambda i, link: i >= link,
    "the link's own joint and those behind it": lambda i, link: i >= link - 1,
    "all joints": lambda i, link: i < 7,
}


def terms(case: Case) -> Finding | None:
    """Return which terms and joints a slope is made of, or which entries are right."""
    all_ = localise.seen(case)
    own = np.array(all_.S)
    parts = np.array([_terms(*call) for call in all_.calls])  # (n, 2, 7)
    d = np.array([np.linalg.norm(p - o) for _, p, o, _ in all_.calls])[:, None]
    link = np.array([call[3] for call in all_.calls])[:, None]
    for joints, kept in KEPT.items():
        mask = np.broadcast_to(kept(np.arange(7), link), own.shape)
        if not np.allclose(own[~mask], 0, 0, 1e-9):
            continue
        for times, factor in (
            ("", 1.0),
            (", all times |p - o|", d),
            (", / |p - o|", 1 / d),
        ):
            columns = np.column_stack([(factor * parts[:, k])[mask] for k in (0, 1)])
            if (found := localise.fitted(columns, own[mask])) is not None:
                says = (
                    f"Your entries are {number(found[0])} n . v and {number(found[1])} "
                    f"n . (omega x p){times}, for {joints}. They are to be 1 of each, "
                    "with n = (p - o) / |p - o|, for joint 1 to the link's own."
                )
                return Finding("other-terms", says)
    return _of_another_normal(all_) or _entries(own, np.array(all_.T), link)


def _of_another_normal(all_: localise.Seen) -> Finding | None:
    """Return which normal gives the entries, where joints enough say so."""
    many = all_.some([call[3] > 3 for call in all_.calls])
    first = None
    for (J, p, o, link), S in zip(many.calls, many.S, strict=True):
        n = (p - o) / np.linalg.norm(p - o)
        velocity = J[3:].T + np.cross(J[:3].T, p)
        own = localise.fitted(velocity[:link], S[:link])
        if own is None or not np.allclose(S[link:], 0, 0, 1e-9):
            return None
        if first is None and not np.allclose(own, n, 0, 1e-6):
            first = own, n, p, o
    if first is None:
        return None
    own, n, p, o = (f"({', '.join(map(number, x))})" for x in first)
    says = (
        f"The velocities are right, the normal is another one: for p = {p}, o = {o} it "
        f"is {own}; (p - o) / |p - o| is {n}."
    )
    return Finding("other-normal", says)


def _terms(J: Array, p: Array, o: Array, link: int) -> Array:
    """Return n . v and n . (omega x p) of all joints, (2, 7)."""
    n = (p - o) / np.linalg.norm(p - o)
    return np.array([n @ J[3:], n @ np.cross(J[:3].T, p).T])


def _entries(own: Array, right: Array, link: Array) -> Finding | None:
    """Return which entries are right: before the link's own joint, it, or behind it."""
    off = np.abs(own - right) > 1e-6
    i = np.arange(7)
    groups = {
        "of the joints before the link's own": np.broadcast_to(i < link - 1, off.shape),
        "of the link's own joint": np.broadcast_to(i == link - 1, off.shape),
        "of the joints behind the link": np.broadcast_to(i >= link, off.shape),
    }
    bad = [name for name, mask in groups.items() if off[mask].any()]
    good = [name for name in groups if name not in bad]
    if good and bad:
        says = f"Right are the entries {localise.listed(good)}; wrong are some {bad[0]}"
        return Finding(
            "some-joints", f"{says}{''.join(f', and {b}' for b in bad[1:])}."
        )
    if np.allclose(np.abs(own), np.abs(right), 0, 1e-8):
        return Finding("some-signs", "All sizes are right, and some signs are not.")
    return None


PLACES = ("the last joint", "the last but one", "a joint before these")
LINKS = ("its own link", "the next link", "a link between", "the last link")


def lengths(case: Case) -> Finding | None:
    """Return for which joints, or farthest links, a reach is wrong."""
    all_ = localise.seen(case)
    if any(s.shape != t.shape for s, t in zip(all_.S, all_.T, strict=True)):
        return None
    places: dict[str, list[bool]] = {}
    links: dict[str, list[bool]] = {}
    offs = []
    for (offsets, far), S, T in zip(all_.calls, all_.S, all_.T, strict=True):
        n = len(far)
        for i, off in enumerate((S - T)[:n]):
            ways = [offsets[i:j].sum() + far[j] for j in range(i, n)]
            steps, behind = int(np.argmax(ways)), n - 1 - i
            wrong = not abs(off) <= 1e-6
            places.setdefault(PLACES[min(behind, 2)], []).append(wrong)
            last = 3 if steps == behind and steps else min(steps, 2)
            links.setdefault(LINKS[last], []).append(wrong)
            offs += [off] if wrong else []
    large = " No entry is too small." if min(offs) > 0 else ""
    large = " No entry is too large: it is no bound." if max(offs) < 0 else large
    ways = (
        (links, LINKS, "where the farthest point is on ", "wrong-of-some-links"),
        (places, PLACES, "for ", "wrong-of-some-joints"),
    )
    for found, order, lead, slug in ways:
        good = [name for name in order if not any(found.get(name, [True]))]
        bad = [name for name in order if any(found.get(name, []))]
        if good and bad:
            says = f"An entry is right {lead}{localise.listed(good)}; not always {lead}"
            return Finding(slug, f"{says}{localise.listed(bad)}.{large}")
    says = (
        "Entries of all joints are wrong, also the last one's: it is far[-1], and each "
        f"before it is made of the next one's reach.{large}"
    )
    return Finding("wrong-of-all-joints", says)


def step(case: Case) -> Finding | None:
    """Return where a next look is wrong, or how much each joint counts in it."""
    all_ = localise.seen(case)
    touch = "it touches or overlaps"
    still = "nothing moves"
    end = "the rest of the way is free"
    way = "the next look is on the way"

    slow = "it hardly moves"
    near = "it is nearer than 1 mm"

    def back(s: float, distance: float, dq: Array, reach: Array) -> str:
        any_ = "a joint turns backwards"
        return any_ if np.any(dq < 0) else "no joint turns backwards"

    def which(s: float, distance: float, dq: Array, reach: Array) -> str:
        if distance <= 0:
            return touch
        speed = np.abs(dq) @ reach
        if speed == 0:
            return still
        if speed < 0.01:
            return slow
        if distance <= 1e-3:
            return near
        return end if s + distance / speed >= 1 else way

    says = "It is s + distance / (|dq| . reach) there."
    groups = {
        way: Group("wrong-on-the-way", says),
        end: Group("wrong-at-the-end", "It is 1 there, the end of the way."),
        slow: Group("wrong-where-slow", f"{says} No size is too small for that."),
        near: Group("wrong-where-near", f"{says} No size is too small for that."),
        still: Group("wrong-standing-still", "It is 1 there: nothing can touch."),
        touch: Group("wrong-where-it-touches", "It is s there: it goes no further."),
    }
    says = "Every joint counts, whichever way it turns: |dq_i| reach_i."
    signs = {
        "no joint turns backwards": Group("wrong-forwards", says),
        "a joint turns backwards": Group("wrong-backwards", says),
    }
    ways = Sorted(groups, which, "where "), Sorted(signs, back, "where ")
    some = [
        which(*call) == way and s - call[0] > 1e-9 and s < 1
        for call, s in zip(all_.calls, np.ravel(all_.S), strict=True)
    ]
    counted = _counted(all_.some(some)) if sum(some) > 10 else ""
    found = localise.apart(all_, *ways)
    large = localise.sizes(all_)
    if found:
        return Finding(found.slug, found.message + large + counted)
    if counted:
        return Finding("joints-counted-otherwise", counted.strip() + large)
    small = "It is wrong where it touches, where nothing moves and on the way alike."
    return Finding("wrong-everywhere", small + large) if large else None


def _counted(some: localise.Seen) -> str:
    """Return how much the joints count in the speed that steps were made with."""
    if not some.wrong.any():
        return ""
    given = zip(some.calls, some.S, strict=True)
    speed = np.array([call[1] / float(s - call[0]) for call, s in given])
    parts = np.array([np.abs(call[2]) * call[3] for call in some.calls])
    found = localise.fitted(parts, speed)
    if found is None:
        return ""
    if np.ptp(found) < 1e-6:
        return f" The step is {number(1 / found[0])} times distance / (|dq| . reach)."
    off = [
        f"joint {i + 1} {number(k)} times"
        for i, k in enumerate(found)
        if abs(k - 1) > 1e-6
    ]
    return f" In the sum |dq| . reach counts {localise.listed(off)}."


def kept(case: Case) -> Finding | None:
    """Return where slowed speeds are wrong, and what of them is as it is to be."""
    all_ = localise.seen(case)
    free = "the speeds are allowed"
    fast = "they are too fast, and nothing overlaps"
    inside = "they are too fast, and it overlaps"
    none = "the slope is 0"

    def which(qd: Array, slope: Array, distance: float, gain: float) -> str:
        if not slope.any():
            return none
        if slope @ qd >= -gain * distance:
            return free
        return inside if distance <= 0 else fast

    told = "There it is qd + k slope, with slope . (qd + k slope) = -gain distance."
    groups = {
        free: Group("wrong-where-allowed", "They are to stay as they are there."),
        fast: Group("wrong-where-too-fast", told),
        inside: Group("wrong-where-it-overlaps", told),
        none: Group("wrong-without-slope", "They are to stay as they are there."),
    }
    ways = [Sorted(groups, which, "where ")]
    late = [which(*call) in (fast, inside) for call in all_.calls]
    how = _change(all_.some(np.array(late) & all_.wrong))
    if found := localise.apart(all_, *ways):
        return Finding(found.slug, f"{found.message} {how}".strip())
    return Finding("wrong-change", how) if how else None


def _change(bad: localise.Seen) -> str:
    """Return what is true of all changes of speeds that were too fast."""
    if not bad.calls:
        return ""
    along, kept, ratio, moved = [], [], [], set()
    for (qd, slope, distance, gain), S in zip(bad.calls, bad.S, strict=True):
        change = S - qd
        share = change @ slope / (slope @ slope)
        lack = -gain * distance - slope @ qd
        along.append(np.allclose(change, share * slope, 0, 1e-8))
        kept.append(abs(slope @ S + gain * distance) < 1e-8)
        ratio.append(share * (slope @ slope) / lack)
        moved |= set(np.flatnonzero(np.abs(change) > 1e-9) + 1)
    joints = "" if len(moved) == 7 or not moved else _only(moved)
    if not moved:
        return "Speeds that are too fast are not changed at all where they are wrong."
    if all(along):
        much = (
            f"{number(ratio[0])} times as large as"
            if np.ptp(ratio) < 1e-6
            else "not as large as"
        )
        return (
            f"The change is along the slope, as it is to be, and {much} it has to be."
        )
    if all(kept):
        return (
            "slope . qd comes out as -gain distance, as it is to be, but the change is "
            f"not along the slope: other speeds are nearer to qd.{joints}"
        )
    return (
        "The change is not along the slope, and slope . qd does not come out as -gain "
        f"distance.{joints}"
    )


def _only(moved: Any) -> str:
    names = [f"joint{i}" for i in sorted(moved)]
    return (
        f" Only {localise.listed(names)} {'is' if len(names) == 1 else 'are'} changed."
    )
