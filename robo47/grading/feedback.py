"""One short file per student: what `make check` would have told them."""

import hashlib
from pathlib import Path

from robo47.grading.sheet import Graded, printable, write

LONGEST = 200  # bytes of a file's name; systems allow 255


def feedback_path(folder: Path, student: str) -> Path:
    """Return where a student's feedback goes.

    Args:
        folder: of all feedback.
        student: name of the student's folder.
    """
    name = printable(student).replace("\\", "_")
    if len(name.encode()) > LONGEST:
        digest = hashlib.sha256(name.encode()).hexdigest()[:12]
        name = f"{name.encode()[: LONGEST - 20].decode('utf-8', 'ignore')}-{digest}"
    return folder / f"{name}.txt"


def write_feedback(folder: Path, graded: Graded) -> None:
    """Write a student's feedback.

    Raises:
        Robo47Error: it cannot be written.
    """
    text = f"{graded.student.name}\n\n{graded.result.text}"
    path = feedback_path(folder, graded.student.folder)
    write(path, printable(text).encode("utf-8"))
