// node meshes.mjs FOLDER FILE: triangles of arm.raw (listed in arm.json) made few, in FILE:
// the length of a list, the list as JSON, then per shape corners (int16) and faces (uint16).
import { readFileSync, writeFileSync } from "node:fs";
import { MeshoptSimplifier as simplifier } from "meshoptimizer";

const SHARE = 0.15; // of the triangles
const ERROR = 0.0006; // metres; stops earlier where this much would be lost
const STEP = 0.00005; // metres: what a corner is rounded to

const [folder, out] = process.argv.slice(2);
const listed = JSON.parse(readFileSync(`${folder}/arm.json`, "utf8"));
const raw = readFileSync(`${folder}/arm.raw`);
await simplifier.ready;

/** A copy of n numbers; a file's bytes need not lie where numbers may. */
function numbers(Kind, at, n) {
  return new Kind(raw.buffer.slice(raw.byteOffset + at, raw.byteOffset + at + 4 * n));
}

function fewer(corners, faces) {
  const target = 3 * Math.ceil(SHARE * (faces.length / 3));
  const [left] = simplifier.simplify(faces, corners, 3, target, ERROR, ["ErrorAbsolute"]);
  const [at, count] = simplifier.compactMesh(left);
  const used = new Int16Array(3 * count);
  at.forEach((to, from) => {
    if (to === 0xffffffff) return; // no face has it any more
    for (let k = 0; k < 3; k++) used[3 * to + k] = Math.round(corners[3 * from + k] / STEP);
  });
  return [used, Uint16Array.from(left)];
}

let at = 0;
const parts = [];
for (const one of listed) {
  const corners = numbers(Float32Array, at, 3 * one.vertices);
  at += 4 * corners.length;
  const faces = numbers(Uint32Array, at, 3 * one.faces);
  at += 4 * faces.length;
  const [used, left] = fewer(corners, faces);
  if (used.length > 3 * 65536) throw new Error(`${one.body}: ${used.length / 3} corners`);
  Object.assign(one, { vertices: used.length / 3, faces: left.length / 3 });
  parts.push(used, left);
}
const head = new TextEncoder().encode(JSON.stringify({ step: STEP, shapes: listed }));
const padded = new Uint8Array(head.length + (head.length % 2)).fill(32);
padded.set(head);
const bytes = [new Uint8Array(new Uint32Array([padded.length]).buffer), padded];
for (const part of parts) bytes.push(new Uint8Array(part.buffer));
writeFileSync(out, Buffer.concat(bytes));
