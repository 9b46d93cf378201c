"""2.8 `fk_body(body_screws, M, q)`: its questions and its mistakes."""

from robo47 import screws

from .arms import arms
from .products import body, either_form, product_row, space


def seen_by_the_hand(rng):
    """Return the arms of `fk_space`, with screws in the end-effector frame."""
    return [(screws.body_screws(S, M), M, q) for S, M, q in arms(rng)]


row = product_row(screws.fk_body, seen_by_the_hand)
either_form(row, body)


@row.wrongs
def _(body_screws, M, q):
    """M-last: your code multiplies by M on the right of the exponentials, or transforms
      the screws a second time. For screws expressed in the end-effector frame, M
      belongs on the left
    motions-on-the-left: your code multiplies by each exponential on the left. The
      screws are expressed in the end-effector frame, so each exponential belongs on the
      right
    """
    return {
        "M-last": lambda: space(body_screws, M, q),
        "motions-on-the-left": lambda: space(body_screws[::-1], M, q[::-1]),
    }
