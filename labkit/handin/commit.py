"""The day's files in git: all that the day uses, as it is now."""

from labkit.base.git import History
from labkit.base.text import visible
from labkit.handin.handin import Handin
from labkit.handin.item import Item
from labkit.lesson.day import Day


def wanted_names(day: Day, handin: Handin) -> list[str]:
    """Return the files to commit: what the day asks for, helpers and drawings."""
    own = [name for name, is_kits in handin.pictures.items() if not is_kits]
    return list(dict.fromkeys([*day.files.values(), *handin.files, *own]))


def check_commit(day: Day, handin: Handin, history: History) -> Item:
    """Check that a fresh clone of the last commit holds what the folder holds.

    Args:
        day: from the kit's manifest.
        handin: what is in the folder.
        history: the last commit, with the hashes of `wanted_names`.
    """
    if not history.readable:
        return Item("commit", "todo", "This folder is no git repository: git init")
    there = {*handin.files, *handin.unread, *handin.pictures}
    wanted = wanted_names(day, handin)
    left = [
        name
        for name in wanted
        if name in there and not history.holds(name, handin.files.get(name))
    ]
    says = []
    if left:
        says.append(f"Not committed as they are now: {visible(', '.join(left), 600)}.")
    if absent := [name for name in wanted if name not in there]:
        says.append(f"Not there yet: {', '.join(absent)}.")
    if not says:
        return Item("commit")
    command = f'git add -A && git commit -m "Day {day.number}"'
    return Item("commit", "todo", "\n".join([*says, command]))
