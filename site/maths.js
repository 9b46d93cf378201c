// Poses as twelve numbers, the first three rows of a 4x4; rotations as nine.
export const ONE = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0];

/** A @ B of two poses. */
export function times(A, B) {
  const made = [];
  for (let i = 0; i < 12; i += 4)
    for (let k = 0; k < 4; k++)
      made.push(
        A[i] * B[k] + A[i + 1] * B[4 + k] + A[i + 2] * B[8 + k] + (k === 3 ? A[i + 3] : 0),
      );
  return made;
}

/** The pose with a rotation and a translation. */
export function pose(R, [x, y, z] = [0, 0, 0]) {
  return [R[0], R[1], R[2], x, R[3], R[4], R[5], y, R[6], R[7], R[8], z];
}

export function Rz(angle) {
  const c = Math.cos(angle);
  const s = Math.sin(angle);
  return [c, -s, 0, s, c, 0, 0, 0, 1];
}

export const place = (T) => [T[3], T[7], T[11]];
export const axis = (T, k) => [T[k], T[4 + k], T[8 + k]]; // its x, y or z, in the world
export const minus = (a, b) => a.map((x, i) => x - b[i]);
export const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
export const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];

/** Where a point of a body is in the world. */
export function moved(T, p) {
  return [0, 4, 8].map((i) => dot(T.slice(i, i + 3), p) + T[i + 3]);
}

/**
 * Day 1's product: where each link is, and the end, {name: pose}.
 * `joint` gives what a joint at an angle adds; another one makes another arm.
 */
export function chain(links, q, joint = (angle) => pose(Rz(angle))) {
  const found = { link0: ONE };
  let T = ONE;
  links.forEach(({ name, T: on }, i) => {
    T = times(T, on);
    if (i < q.length) T = times(T, joint(q[i], i));
    found[name] = T;
  });
  return found;
}

/** The largest difference of an entry. */
export const largest = (A, B) => Math.max(...A.map((x, i) => Math.abs(x - B[i])));

/** A number with so many decimals; a zero has no sign. */
export function fixed(x, decimals) {
  return x.toFixed(decimals).replace(/^-(?=[0.]*$)/, "");
}

/** How far a pose is from another: millimetres and degrees. */
export function apart(T, truth) {
  const metres = Math.hypot(...minus(place(T), place(truth)));
  // R = T's rotation, seen from the truth's
  const R = [0, 1, 2].map((i) => [0, 1, 2].map((k) => dot(axis(truth, i), axis(T, k))));
  const sine = Math.hypot(R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]) / 2;
  const cosine = (R[0][0] + R[1][1] + R[2][2] - 1) / 2;
  return [1000 * metres, (Math.atan2(sine, cosine) * 180) / Math.PI];
}

/** Whether a pose's axes have length 1 and stand at right angles, right-handed. */
export function rigid(T) {
  const [x, y, z] = [0, 1, 2].map((k) => axis(T, k));
  return largest(cross(x, y), z) < 1e-9 && Math.abs(dot(x, x) - 1) < 1e-9;
}

/** The three rows of a pose. */
export const rows3 = (T) => [0, 4, 8].map((i) => T.slice(i, i + 4));

/** Eigenvalues of a symmetric 3x3, largest first, and their unit vectors (Jacobi's turns). */
export function symmetric(given) {
  const A = given.map((row) => [...row]);
  const V = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]; // rows become the vectors
  for (let sweep = 0; sweep < 12; sweep++)
    for (const [p, r] of [[0, 1], [0, 2], [1, 2]]) {
      if (Math.abs(A[p][r]) < 1e-300) continue;
      const angle = Math.atan2(2 * A[p][r], A[p][p] - A[r][r]) / 2;
      const [c, s] = [Math.cos(angle), Math.sin(angle)];
      for (const M of [A, V]) {
        const [a, b] = [M[p], M[r]];
        M[p] = a.map((x, i) => c * x + s * b[i]);
        M[r] = a.map((x, i) => c * b[i] - s * x);
      }
      for (const row of A) {
        const [a, b] = [row[p], row[r]];
        row[p] = c * a + s * b;
        row[r] = c * b - s * a;
      }
    }
  const order = [0, 1, 2].sort((a, b) => A[b][b] - A[a][a]);
  return { values: order.map((i) => A[i][i]), vectors: order.map((i) => V[i]) };
}
