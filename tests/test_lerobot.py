"""Demonstrations in LeRobot's format, version 3.0, as its own source describes it."""

import json

import numpy as np
import pytest

from robo47 import push
from robo47.errors import Robo47Error

pq = pytest.importorskip("pyarrow.parquet", reason="the extra lerobot")
FILE = "chunk-000/file-000.parquet"


@pytest.fixture
def written(tmp_path):
    """Return a folder with a dataset, and the rows that it was written from."""
    from robo47 import lerobot

    seen, action, episode = push.demonstrations(3, seed=1).rows()
    episode = np.array([7, 2, 7])[episode]  # a number that comes again
    rows = seen[:150], action[:150], episode[:150]  # the last episode is shorter
    lerobot.write(tmp_path / "push", *rows, fps=10, task="bring the puck home")
    return tmp_path / "push", rows


def test_what_is_written_is_read_again(written):
    from robo47 import lerobot

    folder, (seen, action, _) = written
    again = lerobot.read(folder)
    np.testing.assert_allclose(again[0], seen, atol=1e-7)
    np.testing.assert_allclose(again[1], action, atol=1e-7)
    assert again[2].tolist() == [0] * 60 + [1] * 60 + [2] * 30


def test_the_files_have_the_columns_that_lerobot_reads(written):
    folder, (seen, *_) = written
    data = pq.read_table(folder / "data" / FILE).to_pydict()
    assert data["timestamp"][59:62] == pytest.approx([5.9, 0.0, 0.1])
    assert data["frame_index"][59:62] == [59, 0, 1]
    assert data["index"] == list(range(150))
    assert set(data["task_index"]) == {0}
    episodes = pq.read_table(folder / "meta/episodes" / FILE).to_pydict()
    assert episodes["length"] == [60, 60, 30]
    assert episodes["dataset_from_index"] == [0, 60, 120]
    assert episodes["dataset_to_index"] == [60, 120, 150]
    assert episodes["tasks"] == [["bring the puck home"]] * 3
    info = json.loads((folder / "meta/info.json").read_text("utf-8"))
    path = info["data_path"].format(chunk_index=0, file_index=0)
    assert (folder / path).is_file()
    assert info["features"]["observation.state"]["shape"] == [4]
    stats = json.loads((folder / "meta/stats.json").read_text("utf-8"))
    mean = seen.mean(axis=0)
    assert stats["observation.state"]["mean"] == pytest.approx(mean.tolist())
    assert stats["action"]["count"] == [150]


def test_pandas_takes_the_task_for_the_name_of_its_row(written):
    """As LeRobot needs it; `pandas.read_parquet` of version 3.1.1 did so."""
    schema = pq.read_schema(written[0] / "meta/tasks.parquet")
    assert schema.pandas_metadata["index_columns"] == ["task"]


def test_a_folder_that_is_taken_and_one_without_a_dataset_are_refused(
    written, tmp_path
):
    from robo47 import lerobot

    folder, rows = written
    with pytest.raises(Robo47Error, match="is not empty"):
        lerobot.write(folder, *rows, fps=10, task="it")
    with pytest.raises(Robo47Error, match="has no dataset of LeRobot"):
        lerobot.read(tmp_path / "nothing")
    info = folder / "meta/info.json"
    info.write_text(info.read_text("utf-8").replace("v3.0", "v2.1"), "utf-8")
    with pytest.raises(Robo47Error, match=r"has version v2.1; expected v3.0"):
        lerobot.read(folder)
