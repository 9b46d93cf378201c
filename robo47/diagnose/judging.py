"""The judge: from answers to a verdict."""

from robo47.diagnose.verdict import Answer, Verdict


def judge(task: str, answers: list[Answer]) -> Verdict:
    """Return what the answers to `calls(task)` show.

    Args:
        task: "1.1" to "1.8".
        answers: one per call, in order.
    """
    if any((a.error or "").startswith("NotImplementedError") for a in answers):
        return Verdict("todo", "unwritten", "Not written yet.")
    raise NotImplementedError(task)
