"""12.7 `path_dynamics(M, dq_ds, d2q_ds2, coriolis, gravity)`: questions, mistakes."""

import numpy as np

from labkit.judge import Matrix, Row, rounded
from robo47.planning import path_dynamics

row = Row(Matrix((3, None), "N m", rows=("a", "b", "c")))


@row.inputs
def _(rng):
    one = np.ones(1)
    yield 2 * np.eye(1), 3 * one, one, 5 * one, 7 * one
    straight = np.array([[2.0, 0.5], [0.5, 1]]), np.array([1.0, -2]), np.zeros(2)
    yield *straight, np.array([0.3, -0.4]), np.array([0.0, 9])
    for k in (2, 3, 7, 7, 7, 7, 7, 7):
        half = rng.numbers(-1, 1, k, k)
        M = rounded(half @ half.T + 0.5 * np.eye(k))
        yield M, *rng.numbers(-2, 2, 3, k), rng.numbers(-30, 30, k)


def coupled(M, *_):
    """Return whether a mass matrix has entries off its diagonal."""
    return bool((M - np.diag(M.diagonal())).any())


row.cases(
    arms_with_one_joint=lambda M, *_: len(M) == 1,
    arms_with_a_diagonal_mass_matrix=lambda M, *_: len(M) > 1 and not coupled(M),
    arms_with_a_mass_matrix_that_couples_joints=coupled,
)
row.cases(
    straight_paths=lambda M, dq_ds, d2q_ds2, *_: not d2q_ds2.any(),
    curved_paths=lambda M, dq_ds, d2q_ds2, *_: bool(d2q_ds2.any()),
)


@row.rare
def _(rng):
    for k in (1, 3):
        half = rng.numbers(-1, 1, k, k)
        M = rounded(half @ half.T + 0.5 * np.eye(k))
        more = rng.numbers(-2, 2, 4, k)
        yield M, *more
        yield np.diag(M.diagonal()), *more
        yield M, more[0], 0.0 * more[1], *more[2:]


@row.wrongs
def _(M, dq_ds, d2q_ds2, coriolis, gravity):
    """ddq-forgotten: your code omits `M @ d2q_ds2` from `b`. Add this term, because the
      joints accelerate on a curved path even if sd is constant
    bias-for-coriolis: your code also adds gravity to `b`. Add gravity only to `c`,
      because the gravity torque does not depend on sd
    gravity-off-coriolis: your code subtracts gravity from the Coriolis torque in `b`.
      Use `coriolis` unchanged, because it does not contain gravity
    m-forgotten: your code omits the mass matrix from `a`. Multiply `dq_ds` by the mass
      matrix
    m-forgotten 2: your code omits the mass matrix from `b`. Multiply `d2q_ds2` by the
      mass matrix
    m-forgotten 3: your code omits the mass matrix from both `a` and `b`. Multiply
      `dq_ds` and `d2q_ds2` by the mass matrix
    diagonal-only: your code uses only the diagonal of the mass matrix. Use the whole
      matrix, because the joints are coupled
    diagonal-only 2: your code uses only the diagonal of the mass matrix in `a`. Use the
      whole matrix, because the joints are coupled
    diagonal-only 3: your code uses only the diagonal of the mass matrix in `b`. Use the
      whole matrix, because the joints are coupled
    a-and-b-exchanged: your code swaps `a` and `b`. The coefficient of sdd contains
      `dq_ds`, and the coefficient of sd^2 contains `d2q_ds2`
    g-first: your code returns `c` in the first row. Return the rows in the order `a`,
      `b`, `c`
    ddq-in-a: your code swaps `M @ dq_ds` and `M @ d2q_ds2`. The coefficient of sdd is
      `M @ dq_ds`, because `qdd = dq_ds * sdd + d2q_ds2 * sd**2`
    m-dq-twice: your code uses `M @ dq_ds` in `b`. Use `M @ d2q_ds2` instead
    both-in-a: your code adds `M @ d2q_ds2` to `a`. Add this term to `b` instead,
      because `b` is multiplied by sd^2
    gravity-sign: your code returns `-gravity` as `c`. Return `gravity` itself, which is
      the torque that holds the arm
    gravity-forgotten: your code omits gravity, so the third row is 0. Return `gravity`
      as the third row, `c`
    coriolis-times-dq: your code multiplies the Coriolis torque by `dq_ds`. Use
      `coriolis` unchanged, because it is already the torque at the velocity `dq_ds`
    dq-squared: your code uses `dq_ds**2` in `b`. Use `d2q_ds2` instead
    solved: your code multiplies by the inverse of M. Multiply by M itself, because M
      maps accelerations to torques
    coriolis-in-g: your code adds the Coriolis torque to `c`. Add it to `b` instead,
      because `b` is multiplied by sd^2
    coriolis-in-a: your code adds the Coriolis torque to `a`. Add it to `b` instead,
      because `b` is multiplied by sd^2
    rows-summed: your code multiplies the sum of each row of M by the entry of `dq_ds`
      or `d2q_ds2` for that joint. Use the matrix product with M instead
    trace: your code multiplies by the trace of M. Use the matrix product with M instead
    first-row: your code multiplies `dq_ds` and `d2q_ds2` by only the first row of M,
      entry by entry. Use the matrix product with M instead
    """
    right = path_dynamics(M, dq_ds, d2q_ds2, coriolis, gravity)
    a, b, g = right
    return {
        "ddq-forgotten": np.array([a, coriolis, g]),
        "bias-for-coriolis": np.array([a, b + gravity, g]),
        "gravity-off-coriolis": np.array([a, b - gravity, g]),
        "m-forgotten": np.array([dq_ds, b, g]),
        "m-forgotten 2": np.array([a, d2q_ds2 + coriolis, g]),
        "m-forgotten 3": np.array([dq_ds, d2q_ds2 + coriolis, g]),
        "diagonal-only": np.array(
            [M.diagonal() * dq_ds, M.diagonal() * d2q_ds2 + coriolis, g]
        ),
        "diagonal-only 2": np.array([M.diagonal() * dq_ds, b, g]),
        "diagonal-only 3": np.array([a, M.diagonal() * d2q_ds2 + coriolis, g]),
        "a-and-b-exchanged": right[[1, 0, 2]],
        "g-first": right[[2, 0, 1]],
        "ddq-in-a": np.array([M @ d2q_ds2, M @ dq_ds + coriolis, g]),
        "m-dq-twice": np.array([a, a + coriolis, g]),
        "both-in-a": np.array([a + M @ d2q_ds2, coriolis, g]),
        "gravity-sign": np.array([a, b, -g]),
        "gravity-forgotten": np.array([a, b, 0 * g]),
        "coriolis-times-dq": np.array([a, M @ d2q_ds2 + coriolis * dq_ds, g]),
        "dq-squared": np.array([a, M @ dq_ds**2 + coriolis, g]),
        "solved": np.array(
            [np.linalg.solve(M, dq_ds), np.linalg.solve(M, d2q_ds2) + coriolis, g]
        ),
        "coriolis-in-g": np.array([a, M @ d2q_ds2, g + coriolis]),
        "coriolis-in-a": np.array([a + coriolis, M @ d2q_ds2, g]),
        **{
            slug: np.array([of(dq_ds), of(d2q_ds2) + coriolis, g])
            for slug, of in {
                "rows-summed": lambda x: M.sum(axis=1) * x,
                "trace": lambda x: np.trace(M) * x,
                "first-row": lambda x: M[0] * x,
            }.items()
        },
    }


@row.right  # Row by row, with M turned over: it is symmetric.
def _(M, dq_ds, d2q_ds2, coriolis, gravity):
    return np.vstack([dq_ds @ M, d2q_ds2 @ M + coriolis, gravity])


row.spans(  # as small, or as large, as in the lab
    dq_ds=(lambda dq_ds: 0.2 * dq_ds,),
    coriolis=(lambda coriolis: 0.04 * coriolis,),
)
