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
    """M-last: your code either multiplies by M on the right of the exponentials or
      transforms the screws again. Use the given screws unchanged, with M on the left,
      because these screws are expressed in the end-effector frame
    motions-on-the-left: your product contains the exponentials in the reverse order on
      the left of M. Multiply by each exponential on the right instead, because the
      screws are expressed in the end-effector frame
    """
    return {
        "M-last": lambda: space(body_screws, M, q),
        "motions-on-the-left": lambda: space(body_screws[::-1], M, q[::-1]),
    }
