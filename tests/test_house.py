"""The house: who may import whom, and how far a reader follows a check through it."""

import ast
import graphlib
import re

import pytest

from conftest import ROOT
from labkit.lesson.day import find_task

# From the ground up: a room may import its own, and rooms that stand before it.
FLOORS = [
    "robo47",  # the course's library: it knows no machine
    "labkit.base",
    "labkit.log",
    "labkit.lesson",
    "labkit.judge",
    "labkit.sandbox",
    "labkit.handin",
    "labkit.check",
    "labkit.hunt",
    "labkit.report",
    "labkit.figures",
    "labkit.notebook",
    "labkit.inspector",
    "labkit.site",
    "labkit.fresh",
    "labkit.grade",
    "labkit.update",
    "labkit.proof",
    "labkit.author",
    "labkit.commands",
]
# Names that labs and handouts have typed: three lines each. `was` has a line for each.
FACES = {f"robo47/{name}.py" for name in ("cli", "metrics", "lesson/lab", "was")}
TAUGHT = [
    *("se3", "kinematics", "screws", "jacobian", "dynamics", "control", "task_space"),
    *("trajectory", "lifting", "identification", "rotation_log", "orientation", "dh"),
]
# They answer, whatever they are given.
NEVER_RAISE = {"is_rotation", "is_pose", "frame_names", "small_pose_error"}
MODULES = sorted([*ROOT.glob("robo47/**/*.py"), *ROOT.glob("labkit/*/**/*.py")])


def room(name):
    """Return "labkit.log" of labkit.log.rows, and "robo47" of robo47.se3."""
    parts = name.split(".")
    return parts[0] if parts[0] != "labkit" else ".".join(parts[:2])


def imported(path):
    """Yield what a module imports: when it loads, for hints, in its functions."""
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield from (f"{node.module}.{alias.name}" for alias in node.names)
        elif isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)


def named(path):
    """Yield modules that a file may import by their names, in strings.

    The room of `f"labkit.check.{name}"` is known without the name. A name that begins
    with `labkit.` alone can mean any room, so the highest one is assumed.
    """
    text = path.read_text("utf-8")
    if re.search(r"\b(import_module|__import__)\(", text):
        for node in ast.walk(ast.parse(text)):
            if isinstance(node, ast.Constant) and isinstance(node.value, str):
                for name in re.findall(r"^(?:robo47|labkit)\.[\w.]*$", node.value):
                    yield FLOORS[-1] if name == "labkit." else name.rstrip(".")


def test_one_file_knows_where_the_memory_is():
    paths = [*ROOT.glob("labkit/**/*.py"), *ROOT.glob("scripts/*.py")]
    knows = {path.name for path in paths if '".robo47"' in path.read_text("utf-8")}
    assert knows == {"store.py"}


def test_one_file_knows_what_the_students_folder_is_called():
    paths = ROOT.glob("labkit/**/*.py")
    knows = {path.name for path in paths if '"work"' in path.read_text("utf-8")}
    assert knows == {"week.py"}


def test_the_pages_have_one_head():
    heads = [p.name for p in MODULES if "<!doctype" in p.read_text("utf-8").lower()]
    assert heads == ["html.py"]


def test_every_arrow_points_down():
    up = []
    for path in MODULES:
        name = path.relative_to(ROOT).as_posix()
        here = FLOORS.index(room(name.removesuffix(".py").replace("/", ".")))
        for other in (*imported(path), *named(path)):
            there = room(other)
            if there in FLOORS and FLOORS.index(there) > here and name not in FACES:
                up.append(f"{name}: {other}")
    assert up == []


def test_the_machine_imports_nothing_that_only_a_clone_has():
    above = {"bench", "scripts", "tests", "conftest", "kit"}
    found = {
        f"{path.relative_to(ROOT).as_posix()}: {other}"
        for path in MODULES
        for other in imported(path)
        if other.partition(".")[0] in above
    }
    assert found == set()


def module_of(path):
    """Return the dotted name of a module."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts).removesuffix(".__init__")


def needs_of(paths):
    """Return what modules import of each other, in functions and by name as well."""
    names = {module_of(path): path for path in paths}
    found = {}
    for name, path in names.items():
        face = path.relative_to(ROOT).as_posix() in FACES
        some = {*imported(path), *(() if face else named(path))}
        found[name] = {x if x in names else x.rpartition(".")[0] for x in some} - {name}
    return found


def test_no_files_import_each_other_in_a_circle_nor_in_functions_nor_by_name():
    needs = needs_of(MODULES)
    graphlib.TopologicalSorter(needs).prepare()  # a CycleError says which
    needs["robo47.se3"].add("labkit.check.tasks")
    with pytest.raises(graphlib.CycleError):
        graphlib.TopologicalSorter(needs).prepare()


@pytest.mark.parametrize(
    ("code", "other"),
    [
        ("import labkit.check.tasks\n", "labkit.check.tasks"),
        ("def f():\n    from labkit.check import tasks\n", "labkit.check.tasks"),
        ("import_module('labkit.check.tasks')\n", "labkit.check.tasks"),
        ("OLD = {'a': 'robo47.se3'}\nimport_module(OLD[x])\n", "robo47.se3"),
        ("import_module(f'labkit.check.{x}')\n", "labkit.check"),
        ("import_module('labkit.' + x)\n", "labkit.commands"),
    ],
)
def test_an_import_is_seen_in_a_function_and_by_name(tmp_path, code, other):
    file = tmp_path / "file.py"
    file.write_text(code)
    assert other in {*imported(file), *named(file)}


# Walls of the sandbox that not every kernel has.
OF_SOME_KERNELS = {f"labkit/sandbox/inside/{x}.py" for x in ("landlock", "seccomp")}


@pytest.mark.kit
def test_the_guide_tells_the_way_of_a_check_file_by_file(run, student):
    source = find_task("1.4")[0].source
    wrong = ("w, x, y, z = quat", "x, y, z, w = quat")
    file = student(source.read_text("utf-8").replace(*wrong, 1), source.name)
    script = ROOT / "scripts" / "check_day.py"
    done = run("tests/switches.py", script, "--task", "1.4", "--file", file)
    assert "WRONG" in done.stdout
    guide = (ROOT / "docs" / "architecture.md").read_text("utf-8")
    steps = guide.partition("## How `make check")[2].partition("\n## ")[0]
    told = set(re.findall(r"`(\S+\.py)`", steps))
    ran = set(re.findall(r"^(\S+\.py)$", done.stderr, re.M))
    assert told == ran - OF_SOME_KERNELS


@pytest.mark.parametrize("name", TAUGHT)
def test_a_taught_function_says_in_one_form_what_it_raises(name):
    tree = ast.parse((ROOT / "robo47" / f"{name}.py").read_text("utf-8"))
    for function in tree.body:
        if not isinstance(function, ast.FunctionDef) or function.name[0] == "_":
            continue
        says = ast.get_docstring(function) or ""
        if function.name not in NEVER_RAISE:
            form = r"\n\nRaises:\n    (ValueError|Robo47Error): .+(\n {8}.+)*\.(\n|$)"
            assert re.search(form, says), function.name
    assert "Error" not in (ast.get_docstring(tree) or "")


@pytest.mark.parametrize(
    "where", ["robo47", "labkit", "scripts", "bench", "w*/src", "w*/day*"]
)
def test_one_statement_has_one_subject(where):
    packed = assigned = 0
    for path in ROOT.glob(f"{where}/**/*.py"):
        if "submissions" in path.parts:
            continue
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Assign):
                assigned += 1
                both = [*node.targets, node.value]
                packed += all(isinstance(side, ast.Tuple) for side in both)
    # Swaps and pairs that belong together remain.
    assert packed <= 0.04 * assigned, f"{packed} of {assigned} assign several values"
