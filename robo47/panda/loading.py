"""Loading the Panda: which files, which drives, which of its looks."""

import xml.etree.ElementTree as ET
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from robo47.checks import Array
from robo47.errors import Robo47Error
from robo47.kinematics import frame_names
from robo47.panda import files as menagerie
from robo47.paths import TWIN_XML, shown

ARM_JOINTS = tuple(f"joint{i}" for i in range(1, 8))

# The handout's `home_q`: the arm at the ready, every joint within its limits.
READY_Q = np.array([0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785])
READY_Q.flags.writeable = False  # shared by every importer

# Where each entry's arm ends: the same point, turned by 180 degrees about z.
END_FRAME = {
    "panda": "body:hand",
    "panda_nohand": "site:attachment_site",
    "scene": "body:hand",
}
Edit = Callable[[mujoco.MjSpec], None]
_SHAPES = {"geom", "mesh", "material", "texture"}
DRIVES = ("servo", "torque")


def load(
    entry: str = "panda_nohand",
    *,
    meshes: bool = False,
    drive: str = "servo",
    edit: Edit | None = None,
) -> mujoco.MjModel:
    """Return the Panda as a compiled model.

    Args:
        entry: "panda", "panda_nohand" or "scene".
        meshes: False drops the shapes that only look, with materials and textures,
            before compiling, and what touches: nothing touches anything. Masses and
            motion are the same and it takes a hundredth of the time. A shape that
            carries inertia, as a tool without `inertial` has, stays.
        drive: "servo" keeps the Menagerie's position servos, ctrl in rad; "torque"
            makes motors of the arm's seven, ctrl in N m, up to the same 87 and 12
            N m. The hand's own servo stays.
        edit: is given the model to add to before it is compiled.

    Returns:
        The model; a new one at every call.

    Raises:
        ValueError: no such entry, or no such drive.
        Robo47Error: the robot's files are broken, or MENAGERIE_ROOT leads nowhere.
    """
    if entry not in menagerie.ENTRIES:
        raise ValueError(
            f"no entry {entry!r}; the Panda has {', '.join(menagerie.ENTRIES)}"
        )
    if drive not in DRIVES:
        raise ValueError(f"no drive {drive!r}; the Panda has {' and '.join(DRIVES)}")
    edits: list[Edit] = [_make_motors] if drive == "torque" else []
    edits += [edit] if edit else []
    folder = menagerie.panda_folder()
    if folder is None:
        return _build(_twin_xml(entry), {}, edits)
    try:
        model = _compiled(folder, entry, meshes, edits)
    except KeyError:
        problem = "is not there"
    except (ValueError, OSError) as error:
        problem = "cannot be loaded: " + " ".join(str(error).split())
    else:
        if END_FRAME[entry] in frame_names(model):
            return model
        problem = f"has no {END_FRAME[entry]}, where its arm should end"
    raise Robo47Error(f"{shown(folder)}/{entry}.xml {problem}. {menagerie.remedy()}")


def home_q(model: mujoco.MjModel) -> Array:
    """Return the model's own `home` key, which is rounded (1.57079, 0.7853).

    Args:
        model: any entry.

    Returns:
        Configuration, (nq,), a copy.

    Raises:
        Robo47Error: the model has no key of that name.
    """
    try:
        return model.key("home").qpos.copy()
    except KeyError:
        raise Robo47Error("this model has no keyframe `home`; load the Panda") from None


def provenance() -> dict[str, Any]:
    """Return which robot this is and where its files came from.

    Returns:
        "robot", "source", "commit" (None where nobody recorded it), "content" (the
        first digits of panda_nohand.xml's sha256), "edited" (True where that file is
        not as it was fetched) and "folder" (as people read it).
    """
    folder = menagerie.panda_folder()
    record: dict[str, Any] = {"source": "the kit's embedded twin"}
    if folder is not None:
        record = menagerie.read_provenance()
    path = folder / "panda_nohand.xml" if folder else TWIN_XML
    content = menagerie.hash_file(path)[:8] if path.is_file() else "unknown"
    fetched = record.get("files", {}).get("panda_nohand.xml", content)
    return {
        "robot": "Franka Panda",
        "source": record["source"],
        "commit": record.get("commit"),
        "content": content,
        "edited": not fetched.startswith(content),
        "folder": shown(folder or TWIN_XML.parent),
    }


def describe(entry: str = "panda_nohand") -> str:
    """Return one line for the head of a lab: which robot, from where, which version.

    Args:
        entry: as `load`.
    """
    p = provenance()
    version = f"commit {p['commit'][:7]}" if p["commit"] else f"sha256 {p['content']}"
    if p["edited"]:
        version = "edited since it was fetched"
    return f"robot: {p['robot']} ({entry}), {p['source']}, {version}"


def _make_motors(spec: mujoco.MjSpec) -> None:
    """Turn the servos of the seven joints into motors: force = ctrl."""
    for actuator in spec.actuators:
        if actuator.target in ARM_JOINTS:
            actuator.gainprm[0] = 1.0
            actuator.biastype = mujoco.mjtBias.mjBIAS_NONE
            actuator.biasprm[:] = 0.0
            actuator.ctrlrange = actuator.forcerange
    for key in spec.keys:  # its ctrl are angles, which motors would take for torques
        hand = list(key.ctrl)[len(ARM_JOINTS) :]
        key.ctrl = [0.0] * len(ARM_JOINTS) + hand


def _build(xml: str, files: dict[str, bytes], edits: list[Edit]) -> mujoco.MjModel:
    """Compile from memory: MuJoCo on Windows opens no file in a folder like Größe."""
    if not edits:  # the faster way
        return mujoco.MjModel.from_xml_string(xml, files)
    spec = mujoco.MjSpec.from_string(xml, include=files, assets=files)
    for edit in edits:
        edit(spec)
    return spec.compile()


def _compiled(
    folder: Path, entry: str, meshes: bool, edits: list[Edit]
) -> mujoco.MjModel:
    """Return the model of the robot's files, without what only looks unless `meshes`.

    Where a shape that stays needs what was dropped (a mesh, a material), all stays.
    """
    if not meshes:
        files, kept = _without_looks(folder, entry)
        first = [_make_untouchable] if kept else []
        try:
            return _build(files[f"{entry}.xml"].decode(), files, [*first, *edits])
        except ValueError:  # the whole message, if the file is wrong
            edits = [_make_untouchable, *edits]
    files = {p.name: p.read_bytes() for p in folder.rglob("*") if p.is_file()}
    return _build(files[f"{entry}.xml"].decode(), files, edits)


def _make_untouchable(spec: mujoco.MjSpec) -> None:
    """Let no shape touch another."""
    for geom in spec.geoms:
        geom.contype = geom.conaffinity = 0
    for pair in list(spec.pairs):
        spec.delete(pair)


def _without_looks(folder: Path, entry: str) -> tuple[dict[str, bytes], bool]:
    """Return the model's files by name without looks, and whether a shape stayed."""
    roots: dict[str, ET.Element] = {}
    wanted = [f"{entry}.xml"] if (folder / f"{entry}.xml").exists() else []
    while wanted:
        name = wanted.pop()
        try:
            roots[name] = root = ET.fromstring((folder / name).read_bytes())
        except ET.ParseError as error:
            raise ValueError(f"{name}: {error}") from None
        wanted += [part.get("file", "") for part in root.iter("include")]
    compilers = [one for root in roots.values() for one in root.iter("compiler")]
    by_shape = any(one.get("inertiafromgeom") == "true" for one in compilers)
    kept = [_remove_looks(root, by_shape) for root in roots.values()]
    return {name: ET.tostring(root) for name, root in roots.items()}, any(kept)


def _remove_looks(root: ET.Element, by_shape: bool) -> bool:
    """Remove a file's shapes and assets; return whether a shape carries inertia.

    Args:
        root: of the file.
        by_shape: every shape does; else those of a body without `inertial`.
    """
    kept = False
    # an included file's parts go into a body that it does not show
    waiting = [(root, root.tag == "mujocoinclude")]
    while waiting:
        parent, carries = waiting.pop()
        for part in list(parent):
            if part.tag in ("default", "tendon", "contact", "sensor"):
                continue  # a geom there is a name or a setting
            if part.tag == "geom" and carries:
                kept = True
            elif part.tag in _SHAPES and parent.tag != "deformable":
                parent.remove(part)
            elif part.tag == "body":
                waiting.append((part, by_shape or part.find("inertial") is None))
            else:  # a frame's shapes are its body's
                waiting.append((part, carries and part.tag != "worldbody"))
    return kept


def _twin_xml(entry: str) -> str:
    """Return the embedded twin, which has both ends, with the end of the entry."""
    root = ET.fromstring(TWIN_XML.read_bytes())
    if entry == "panda_nohand":  # nor what drives, couples or counts the fingers
        names = {"hand", "actuator8"}
        tags = {"tendon", "equality"}
        _remove(root, lambda part: part.get("name") in names or part.tag in tags)
        for key in root.iter("key"):
            for name in ("qpos", "ctrl"):
                key.set(name, " ".join(key.get(name, "").split()[: len(READY_Q)]))
    else:
        _remove(root, lambda part: part.get("name") == "attachment")
        root.find("option").set("impratio", "1")  # type: ignore[union-attr]
    return ET.tostring(root, encoding="unicode")


def _remove(root: ET.Element, unwanted: Callable[[ET.Element], bool]) -> None:
    for parent in list(root.iter()):
        for child in filter(unwanted, list(parent)):
            parent.remove(child)
