"""Demonstrations in LeRobot's dataset format, version 3.0, and back.

    seen, action, episode = push.demonstrations(40, seed=1).rows()
    lerobot.write("push", seen, action, episode, fps=10, task="bring the puck home")
    seen, action, episode = lerobot.read("push")

In LeRobot, `LeRobotDataset("me/push", root="push")` opens such a folder. The tests
compare the files with the documented format; the package `lerobot` itself, which needs
PyTorch, is not part of them. Numbers are kept as float32, as LeRobot's policies expect
them. Only vectors are written, no images. An extra: `python3 scripts/setup_env.py
lerobot` installs pyarrow.
"""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
from numpy.typing import ArrayLike, NDArray

from robo47 import checks
from robo47.checks import Array
from robo47.errors import Robo47Error

VERSION = "v3.0"
PATTERN = "chunk-{chunk_index:03d}/file-{file_index:03d}.parquet"
FIRST = PATTERN.format(chunk_index=0, file_index=0)  # the only file: data are small
STATE, ACTION = "observation.state", "action"
COUNTED = ("frame_index", "episode_index", "index", "task_index")  # whole numbers


def write(
    folder: str | Path,
    observation: ArrayLike,
    action: ArrayLike,
    episode: ArrayLike,
    fps: int,
    task: str,
) -> None:
    """Write demonstrations as a dataset of LeRobot.

    Args:
        folder: new, or empty.
        observation: rows in the order of time, (n, d).
        action: (n, m).
        episode: number of each row's episode, (n,); a change begins a new episode.
        fps: rows per second.
        task: what is demonstrated, one sentence.

    Raises:
        Robo47Error: the folder is not empty.
        ValueError: a wrong shape, or a number that is not finite.
    """
    folder = Path(folder)
    if folder.is_dir() and any(folder.iterdir()):
        raise Robo47Error(f"{folder} is not empty; name a new folder for the dataset")
    seen = checks.array(observation, "observation", ("n", "d"))
    done = checks.array(action, "action", (len(seen), "m"))
    numbers = checks.array(episode, "episode", (len(seen),))
    begins = np.flatnonzero(np.append(True, np.diff(numbers) != 0))
    lengths = np.diff(np.append(begins, len(seen)))
    columns = {STATE: seen, ACTION: done, **_counted(begins, lengths, fps)}
    _save(folder / "data" / FIRST, {k: _column(v) for k, v in columns.items()})
    _save(folder / "meta/episodes" / FIRST, _episodes(begins, lengths, task))
    _save(folder / "meta/tasks.parquet", {"task_index": [0], "task": [task]}, "task")
    info = _info(columns, len(lengths), fps)
    stats = {name: _stats(value) for name, value in columns.items()}
    for name, content in (("info", info), ("stats", stats)):
        text = json.dumps(content, indent=4)
        (folder / f"meta/{name}.json").write_text(text, "utf-8")


def read(folder: str | Path) -> tuple[Array, Array, NDArray[np.int64]]:
    """Return the rows of a dataset of LeRobot, those of `write` among them.

    Args:
        folder: with data/ and meta/.

    Returns:
        observation (n, d), action (n, m) and episode (n,), in the order of time.

    Raises:
        Robo47Error: the folder has no such dataset, or one of another version.
    """
    folder = Path(folder)
    try:
        info = json.loads((folder / "meta/info.json").read_text("utf-8"))
    except (OSError, ValueError) as error:
        raise Robo47Error(f"{folder} has no dataset of LeRobot: {error}") from None
    if info.get("codebase_version") != VERSION:
        found = info.get("codebase_version")
        raise Robo47Error(f"{folder} has version {found}; expected {VERSION}")
    names = [STATE, ACTION, "episode_index", "index"]
    files = sorted((folder / "data").glob("*/*.parquet"))
    table = pa.concat_tables([pq.read_table(file, columns=names) for file in files])
    table = table.sort_by("index")
    seen, done = (np.array(table[name].to_pylist(), float) for name in (STATE, ACTION))
    return seen, done, table["episode_index"].to_numpy()


def _counted(
    begins: NDArray[Any], lengths: NDArray[Any], fps: int
) -> dict[str, NDArray[Any]]:
    """Return the columns that every dataset has."""
    index = np.arange(lengths.sum())
    frame = index - np.repeat(begins, lengths)
    episode = np.repeat(np.arange(len(lengths)), lengths)
    whole = zip(COUNTED, (frame, episode, index, 0 * index), strict=True)
    return {"timestamp": (frame / fps).astype(np.float32), **dict(whole)}


def _episodes(begins: NDArray[Any], lengths: NDArray[Any], task: str) -> dict[str, Any]:
    """Return the columns of the table of episodes."""
    n = len(lengths)
    first = ("data/chunk_index", "data/file_index",
             "meta/episodes/chunk_index", "meta/episodes/file_index")  # fmt: skip
    return {
        "episode_index": np.arange(n),
        "tasks": [[task]] * n,
        "length": lengths,
        "dataset_from_index": begins,
        "dataset_to_index": begins + lengths,
        **{name: np.zeros(n, int) for name in first},
    }


def _info(columns: dict[str, NDArray[Any]], episodes: int, fps: int) -> dict[str, Any]:
    """Return what meta/info.json says."""
    return {
        "codebase_version": VERSION,
        "robot_type": "robo47_push",
        "total_episodes": episodes,
        "total_frames": len(columns["index"]),
        "total_tasks": 1,
        "chunks_size": 1000,
        "data_files_size_in_mb": 100,
        "video_files_size_in_mb": 500,
        "fps": fps,
        "splits": {"train": f"0:{episodes}"},
        "data_path": f"data/{PATTERN}",
        "video_path": None,
        "features": {
            name: {
                "dtype": "int64" if name in COUNTED else "float32",
                "shape": [value.shape[1] if value.ndim > 1 else 1],
                "names": None,
            }
            for name, value in columns.items()
        },
    }


def _stats(value: NDArray[Any]) -> dict[str, list[Any]]:
    """Return the statistics of a column, a list of one entry per component."""
    table = value.reshape(len(value), -1)
    kinds = ("min", "max", "mean", "std")
    found = {kind: getattr(table, kind)(axis=0).tolist() for kind in kinds}
    return {**found, "count": [len(table)]}


def _column(value: NDArray[Any]) -> pa.Array:
    """Return a column: numbers, or lists of a fixed size of float32."""
    if value.ndim == 1:
        return pa.array(value)
    plain = pa.array(value.astype(np.float32).ravel())
    return pa.FixedSizeListArray.from_arrays(plain, value.shape[1])


def _save(path: Path, columns: dict[str, Any], index: str = "") -> None:
    """Write a table; `index` is the column that pandas takes for the rows' names."""
    table = pa.table(columns)
    if index:
        about = {"index_columns": [index], "column_indexes": [], "columns": [
            {"name": name, "field_name": name, "metadata": None,
             "pandas_type": "unicode" if name == index else "int64",
             "numpy_type": "object" if name == index else "int64"}
            for name in columns
        ]}  # fmt: skip
        table = table.replace_schema_metadata({"pandas": json.dumps(about)})
    path.parent.mkdir(parents=True, exist_ok=True)
    pq.write_table(table, path)
