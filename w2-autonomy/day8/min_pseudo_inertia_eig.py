"""8.9 `min_pseudo_inertia_eig(phi)`: its questions and its mistakes."""

import numpy as np

from labkit.judge import Row, Scalar
from robo47.identification import spatial_inertia_from_params
from robo47.screws import skew

from .states import bodies, real_bodies

row = Row(Scalar(called="the eigenvalue"))
POINT = np.array([2.0, 2, 4, 6, 26, 20, 10, -4, -6, -12])  # 2 kg at (1, 2, 3)


@row.inputs
def _(rng):
    case = np.array([1.0, 0, 0, 0, 1, 1, 3, 0, 0, 0])
    asked = [*bodies(rng, 4), *real_bodies(rng, 4)]  # else a clip at 0 shows nowhere
    return [(case,), (POINT,), *((phi,) for phi in asked)]


def pseudo(phi, spread=lambda I: np.trace(I) / 2 * np.eye(3) - I, h=1.0):  # noqa: E741
    """Return the matrix, with another upper left, or h times a factor."""
    first = h * phi[1:4, None]
    corner = spread(spatial_inertia_from_params(phi)[:3, :3])
    return np.block([[corner, first], [first.T, phi[0]]])


def moved(phi, I):  # noqa: E741
    """Return the upper left of I about the centre of mass."""
    C = skew(phi[1:4])
    about = I - C @ C.T / phi[0]
    return np.trace(about) / 2 * np.eye(3) - about


for slug, says, redone, code in (
    ("only-the-inertia", "this is the least eigenvalue of I; a body also needs Ixx + "
     "Iyy >= Izz, and m c", "that of I",
     lambda phi: np.linalg.eigvalsh(spatial_inertia_from_params(phi)[:3, :3])[0]),
    ("inertia-not-turned-round", "I stands at the upper left itself; the sum of m r "
     "r^T is tr(I)/2 1 - I", "with I there",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, lambda I: I))[0]),  # noqa: E741
    ("trace-not-halved", "the trace is not halved: r.r is counted twice in it",
     "with tr(I) 1 - I", lambda phi: np.linalg.eigvalsh(
         pseudo(phi, lambda I: np.trace(I) * np.eye(3) - I))[0]),  # noqa: E741
    ("centre-for-first-moment", "c stands there for h = m c", "with h / m",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, h=1.0 / phi[0]))[0]),
    ("determinant", "this is the determinant, the product of all eigenvalues",
     "the determinant", lambda phi: np.linalg.det(pseudo(phi))),
    ("singular-value", "this is the least singular value, which is never below 0; the "
     "sign is what is asked for", "the least singular value",
     lambda phi: np.linalg.svd(pseudo(phi), compute_uv=False)[-1]),
    ("nearest-to-zero", "this is the eigenvalue of the least size; the least is the "
     "most negative one", "the one of the least size",
     lambda phi: min(np.linalg.eigvalsh(pseudo(phi)), key=abs)),
    ("clipped", "what is above 0 has become 0; of a body it is above 0, and says how "
     "far it is from none", "0 where it is above",
     lambda phi: min(np.linalg.eigvalsh(pseudo(phi))[0], 0.0)),
    ("never-above-zero", "minus its size; of a body it is above 0", "minus its size",
     lambda phi: -abs(np.linalg.eigvalsh(pseudo(phi))[0])),
    ("never-below-zero", "what is below 0 has become 0; the sign is what is asked for",
     "0 where it is below", lambda phi: max(np.linalg.eigvalsh(pseudo(phi))[0], 0.0)),
    ("trace-in-thirds", "the trace is divided by 3; r.r is counted twice in it, so by "
     "2", "with tr(I) / 3", lambda phi: np.linalg.eigvalsh(
         pseudo(phi, lambda I: np.trace(I) / 3 * np.eye(3) - I))[0]),  # noqa: E741
    ("first-moment-once", "h counts for nothing: it is missing, or stands in the upper "
     "half only, and what asks for a symmetric matrix reads the lower one", "without h",
     lambda phi: np.linalg.eigvalsh(
         np.triu(pseudo(phi)) + np.triu(pseudo(phi, h=0.0), 1).T)[0]),
    ("about-the-centre", "I is moved to the centre of mass first; m r r^T is summed "
     "about the origin, where I is", "with I about the centre",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, lambda I: moved(phi, I)))[0]),  # noqa: E741
    ("of-the-inertia", "this is the least eigenvalue of the 6x6 inertia; the 4x4 "
     "matrix has tr(I)/2 1 - I and h", "that of the 6x6 inertia",
     lambda phi: np.linalg.eigvalsh(spatial_inertia_from_params(phi))[0]),
    ("unsorted", "numpy.linalg.eigvals returns the eigenvalues in no order, so its "
     "first is any of them", "the first of numpy.linalg.eigvals",
     lambda phi: np.linalg.eigvals(pseudo(phi))[0].real),
    ("largest", "this is the largest eigenvalue", "the largest",
     lambda phi: np.linalg.eigvalsh(pseudo(phi))[-1]),
):  # fmt: skip
    row.wrong(slug, says, redone)(code)


@row.right  # From the general eigenvalues.
def _(phi):
    return np.linalg.eigvals(pseudo(phi)).real.min()


row.spans(  # as small, or as large, as in the lab
    phi=(lambda phi: 0.006 * phi,),
)
