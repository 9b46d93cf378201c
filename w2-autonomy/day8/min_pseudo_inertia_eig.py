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
    asked = [*bodies(rng, 4), *real_bodies(rng, 4)]  # else a clamp is not seen
    return [(case,), (POINT,), *((phi,) for phi in asked)]


def pseudo(phi, spread=lambda I: np.trace(I) / 2 * np.eye(3) - I, h=1.0):  # noqa: E741
    """Return the pseudo-inertia with another upper left block, or h times a factor."""
    first = h * phi[1:4, None]
    corner = spread(spatial_inertia_from_params(phi)[:3, :3])
    return np.block([[corner, first], [first.T, phi[0]]])


def moved(phi, I):  # noqa: E741
    """Return the upper left block for I about the centre of mass."""
    C = skew(phi[1:4])
    about = I - C @ C.T / phi[0]
    return np.trace(about) / 2 * np.eye(3) - about


def mirrored(I):  # noqa: E741
    """Return tr(I)/2 1 - I with the other sign beside the diagonal."""
    S = np.trace(I) / 2 * np.eye(3) - I
    return 2 * np.diag(np.diag(S)) - S


def doubled(I):  # noqa: E741
    """Return tr(I)/2 1 - I with twice the diagonal."""
    S = np.trace(I) / 2 * np.eye(3) - I
    return S + np.diag(np.diag(S))


for slug, says, code in (
    ("only-the-inertia",
     "your code returns the smallest eigenvalue of I. Use the pseudo-inertia "
     "[[Sigma, h], [h^T, m]] instead, where Sigma is (tr(I)/2) E - I and E is the "
     "identity matrix",
     lambda phi: np.linalg.eigvalsh(spatial_inertia_from_params(phi)[:3, :3])[0]),
    ("inertia-not-turned-round",
     "your code uses I as the upper left block. Use (tr(I)/2) E - I instead, where E "
     "is the identity matrix",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, lambda I: I))[0]),  # noqa: E741
    ("products-not-negated",
     "your code uses Ixy, Ixz and Iyz as the off-diagonal entries of Sigma. Negate "
     "these three entries, because Sigma is (tr(I)/2) E - I with the identity matrix E",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, mirrored))[0]),
    ("not-halved",
     "your code omits the factor of 1/2 on the diagonal of Sigma. For example, the "
     "first entry of Sigma should be (Iyy + Izz - Ixx) / 2",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, doubled))[0]),
    ("centre-for-first-moment",
     "your code uses the centre of mass c in the pseudo-inertia. Use the first moment "
     "h = m c instead, because phi already contains it",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, h=1.0 / phi[0]))[0]),
    ("determinant",
     "your code returns the determinant of the pseudo-inertia, which is the product of "
     "all eigenvalues. Return the smallest eigenvalue instead",
     lambda phi: np.linalg.det(pseudo(phi))),
    ("singular-value",
     "your code returns the smallest singular value, which is never negative. Return "
     "the smallest eigenvalue instead, because a negative eigenvalue shows that the "
     "body cannot exist",
     lambda phi: np.linalg.svd(pseudo(phi), compute_uv=False)[-1]),
    ("nearest-to-zero",
     "your code returns the eigenvalue with the smallest absolute value. Return the "
     "smallest eigenvalue instead, even if it is negative",
     lambda phi: min(np.linalg.eigvalsh(pseudo(phi)), key=abs)),
    ("clipped", "your code returns 0 if the smallest eigenvalue is positive. Return "
                "the eigenvalue itself instead",
     lambda phi: min(np.linalg.eigvalsh(pseudo(phi))[0], 0.0)),
    ("never-above-zero",
     "your code returns minus the absolute value of the smallest eigenvalue. Return "
     "the eigenvalue itself instead, because it is not negative for a body that can "
     "exist",
     lambda phi: -abs(np.linalg.eigvalsh(pseudo(phi))[0])),
    ("first-moment-once",
     "your result does not depend on h. The pseudo-inertia should contain h both to "
     "the right of Sigma and below it. For example, numpy.linalg.eigvalsh reads only "
     "the lower triangle",
     lambda phi: np.linalg.eigvalsh(
         np.triu(pseudo(phi)) + np.triu(pseudo(phi, h=0.0), 1).T)[0]),
    ("about-the-centre",
     "your result uses the inertia about the centre of mass. Use I unchanged, because "
     "the pseudo-inertia also refers to the origin",
     lambda phi: np.linalg.eigvalsh(pseudo(phi, lambda I: moved(phi, I)))[0]),  # noqa: E741
    ("of-the-inertia",
     "your code returns the smallest eigenvalue of the 6x6 spatial inertia. Use the "
     "pseudo-inertia [[Sigma, h], [h^T, m]] instead, where Sigma is (tr(I)/2) E - I "
     "and E is the identity matrix",
     lambda phi: np.linalg.eigvalsh(spatial_inertia_from_params(phi))[0]),
    ("unsorted",
     "your code does not always return the smallest eigenvalue. The results of "
     "numpy.linalg.eigvals, for example, are not sorted",
     lambda phi: np.linalg.eigvals(pseudo(phi))[0].real),
):  # fmt: skip
    row.wrong(slug, says)(code)


@row.right  # Entry by entry, from the general eigenvalues.
def _(phi):
    m, x, y, z, xx, yy, zz, xy, xz, yz = phi
    P = [
        [(yy + zz - xx) / 2, -xy, -xz, x],
        [-xy, (xx + zz - yy) / 2, -yz, y],
        [-xz, -yz, (xx + yy - zz) / 2, z],
        [x, y, z, m],
    ]
    return np.linalg.eigvals(np.array(P)).real.min()


row.spans(  # as small, or as large, as in the lab
    phi=(lambda phi: 0.006 * phi,),
)
