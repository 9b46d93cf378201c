"""1.7 `translations_both_orders(T_world_ee, T_extra)`: questions, mistakes."""

import numpy as np

from labkit.judge import HeldOut, Points, Row
from labkit.judge.matrices import split

from .panda_chain import NEAR


def _two_poses(rng):
    return list(zip(rng.poses(6), rng.poses(6), strict=True))


def _odd_bottom_rows(rng):
    """Return poses with 2 in the corner: a 4x4 product would carry it along."""
    pairs = _two_poses(rng)[:2]
    for pair in pairs:
        for T in pair:
            T[3, 3] = 2.0
    return pairs


def by_4x4(T_world_ee, T_extra):
    """Return both translations from the products, which the task asks to do without."""
    return np.array([T_world_ee @ T_extra, T_extra @ T_world_ee])[:, :3, 3]


def right(R_a, t_a, R_b, t_b):
    """Return the translation of a @ b."""
    return R_a @ t_b + t_a


def both(half, other=None):
    """Return the function that predicts each order with a half of its own."""

    def translations_both_orders(T_world_ee, T_extra):
        ee, extra = split(T_world_ee), split(T_extra)
        return np.array([half(*ee, *extra), (other or half)(*extra, *ee)])

    return translations_both_orders


row = Row(
    Points((2, 3)),
    truth=both(right),
    near=NEAR,
    held_out=[
        HeldOut(
            "by-4x4-products",
            "Your result is correct, but your code multiplies by a 4x4 matrix. Compute "
            "the result from R and t alone. Which R acts on which t?",
            _odd_bottom_rows,
            mistaken=by_4x4,
            status="close",
        )
    ],
)
row.inputs(_two_poses)

# What goes wrong in one prediction, or in both.
HALVES = {
    "only-summed": "your code only adds the two translations. First multiply the "
    "right factor's translation by the left factor's R",
    "left-translation-lost": "your code omits the translation of the left factor",
    "right-translation-lost": "your code omits the translation of the right factor",
    "turned-backwards": "your code multiplies the right factor's translation by the "
    "transpose of the left factor's R, as `R.T @ t` and `t @ R` do. Use `R @ t` "
    "instead",
    "wrong-vector-turned": "your code rotates the left factor's own translation "
    "instead of the right factor's translation",
    "wrong-rotation": "your code rotates the right factor's translation by the right "
    "factor's R. Use the left factor's R instead",
    "both-turned": "your code rotates the translations of both factors. Do not rotate "
    "the translation of the left factor",
    "subtracted": "your code subtracts the left factor's translation instead of "
    "adding it",
    "summed-by-columns": "your code multiplies the left factor's R and the right "
    "factor's translation entry by entry (`R * t`) and sums each column of the "
    "products. Use `R @ t` instead, which sums each row of the products",
    "summed-by-entries": "your code multiplies each row of the left factor's R by only "
    "one entry of the right factor's translation t. Use `R @ t` instead, which "
    "computes the dot product of each row and t",
    "diagonal-only": "your code multiplies the right factor's translation only by "
    "the diagonal of the left factor's R. Use `R @ t` instead, which uses all entries "
    "of R",
    "entries-of-4x4": "your translation is the entry-by-entry product of the two "
    "translations, as in `A * B`. Use the translation of the matrix product instead",
}


def halves(R_a, t_a, R_b, t_b):
    """Return the translation of a @ b with each of these mistakes."""
    return {
        "only-summed": t_a + t_b,
        "left-translation-lost": R_a @ t_b,
        "right-translation-lost": t_a,
        "turned-backwards": R_a.T @ t_b + t_a,
        "wrong-vector-turned": R_a @ t_a + t_b,
        "wrong-rotation": R_b @ t_b + t_a,
        "both-turned": R_a @ (t_a + t_b),
        "subtracted": R_a @ t_b - t_a,
        "summed-by-columns": sum(R_a * t_b) + t_a,
        "summed-by-entries": sum(R_a.T * t_b) + t_a,
        "diagonal-only": np.diag(R_a) * t_b + t_a,
        "entries-of-4x4": t_a * t_b,
    }


WHEN_READY = "in the ready configuration, where the lab asks, R is symmetric"
for slug, says in HALVES.items():
    half = lambda *four, slug=slug: halves(*four)[slug]  # noqa: E731
    row.wrong(slug, f"in both results, {says}")(both(half))
    same = WHEN_READY if slug == "turned-backwards" else ""
    # By the product, as two results may be swapped as well.
    first, second = "T_world_ee @ T_extra", "T_extra @ T_world_ee"
    row.wrong(slug, f"for `{first}`, {says}", hidden=same)(both(half, right))
    row.wrong(slug, f"for `{second}`, {says}")(both(right, half))


def _other_order(R_a, t_a, R_b, t_b):
    return right(R_b, t_b, R_a, t_a)


for which, product, two in (
    ("first", "`T_world_ee @ T_extra`", (_other_order, right)),
    ("second", "`T_extra @ T_world_ee`", (right, _other_order)),
):
    says = (
        f"your code computes the {which} translation with the two factors swapped. The "
        f"{which} translation belongs to {product}"
    )
    row.wrong("same-order-twice", says)(both(*two))
row.wrong(
    "orders-swapped",
    "your code swaps the two translations. The first translation belongs to "
    "`T_world_ee @ T_extra`",
)(both(_other_order))


row.close("by-4x4-products")(by_4x4)
