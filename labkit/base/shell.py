"""Variables of a person's shell that are meant for another Python than the kit's.

ROS sets PYTHONPATH for everybody who sources it, and a cluster sets pip's options for
its own packages. The kit's Python inherits neither. `make doctor` names what is set.
"""

# An old Python reads this first, before the kit's own: no f-strings, no annotations,
# and no module beside os, sys and re, since a foreign PYTHONPATH may hold others.
import os
import re
import sys

# Makefile has the same list after "unexport".
NAMES = (
    "PYTHONPATH",
    "PYTHONHOME",
    "PYTHONPLATLIBDIR",
    "PYTHONEXECUTABLE",
    "PYTHONSAFEPATH",
    "PYTHONINSPECT",
    "PYTHONSTARTUP",
    "PYTEST_PLUGINS",
    "PYTEST_ADDOPTS",
)
FOUND = "ROBO47_SHELL"  # the variable that lists the removed ones
# How an installer reaches its packages is the machine's business; all else is ours.
_REACHES = re.compile(
    "(PIP|UV)_.*(INDEX|FIND_LINKS|HOST|PROXY|CERT|TLS|KEYRING|HTTP|OFFLINE|CACHE"
    "|TIMEOUT|RETRIES|CONCURRENT|LINK_MODE|COMPILE|USE_FEATURE|USE_DEPRECATED)"
)
_SETTING = re.compile(r"(?:global|install)\.([a-z-]+)=(['\"].*)")


def foreign(environment, root):
    """Return the names of set variables that belong to another Python.

    The clone's own folder on PYTHONPATH is ours: the kit's children are told it.
    """
    path = environment.get("PYTHONPATH")
    ours = bool(path) and all(_same(p, root) for p in path.split(os.pathsep))
    return [
        name
        for name in NAMES
        if environment.get(name) and not (name == "PYTHONPATH" and ours)
    ]


def without(environment, root):
    """Return an environment without what belongs to another Python."""
    left_out = foreign(environment, root)
    kept = {name: environment[name] for name in environment if name not in left_out}
    if "PYTHONPATH" in left_out:
        paths = environment["PYTHONPATH"].split(os.pathsep)
        if any(_same(path, root) for path in paths):
            kept["PYTHONPATH"] = root
    if left_out:
        kept[FOUND] = " ".join(left_out)
    return kept


def leave(root):
    """Start the script again without those variables, where one is set."""
    main = getattr(sys.modules.get("__main__"), "__file__", None)
    beside = os.path.join(os.path.dirname(os.path.abspath(main or "")), "kit.py")
    if not main or not os.path.isfile(beside) or not foreign(os.environ, root):
        return  # a script of the kit alone can start again
    command = list(getattr(sys, "orig_argv", [""] + sys.argv))  # noqa: RUF005 (old)
    command[0] = sys.executable
    go_on(command, without(os.environ, root))


def go_on(command, environment):
    """Go on as another program, in this process where the system can do it."""
    sys.stdout.flush()
    if os.name == "nt":  # execve there returns to the shell before the script has ended
        import subprocess

        sys.exit(subprocess.call(command, env=environment))
    os.execve(command[0], command, environment)


def for_installer(environment, listed=""):
    """Return an environment in which pip or uv obeys set-up alone.

    Index, proxy, certificates and cache stay: people need these. Constraints, targets
    and hashes were set for other work.

    Args:
        environment: variables.
        listed: what `pip config list` prints, "global.index-url='https://...'".
    """
    configured = {}
    for line in listed.splitlines():  # a command's own line follows the global one
        found = _SETTING.match(line)
        if found:
            name = "PIP_" + found.group(1).upper().replace("-", "_")
            configured[name] = " ".join(_unquoted(found.group(2)).split())
    configured = {k: v for k, v in configured.items() if _REACHES.match(k)}
    ours = {
        name: value
        for name, value in environment.items()
        if not name.startswith(("PIP_", "UV_")) or _REACHES.match(name)
    }
    if listed:  # all that counts of it is said in variables
        configured["PIP_CONFIG_FILE"] = os.devnull
    elif "PIP_CONFIG_FILE" in environment:  # pip says what is wrong with it
        configured["PIP_CONFIG_FILE"] = environment["PIP_CONFIG_FILE"]
    configured.update(ours)
    return configured


def for_pip(python):
    """Return the environment in which a Python's pip obeys us alone.

    Args:
        python: a path; its pip is asked for its settings.
    """
    import subprocess

    command = [str(python), "-m", "pip", "config", "list"]
    asked = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False
    )
    return for_installer(os.environ, asked.stdout.decode("utf-8", "replace"))


def _unquoted(text):
    import ast

    try:
        return str(ast.literal_eval(text))
    except (SyntaxError, ValueError):
        return text


def _same(path, root):
    return os.path.realpath(path) == os.path.realpath(root)
