// The Panda on one page: MuJoCo says where the arm is; ghosts.json, where a mistake puts it.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import load from "@mujoco/mujoco";

const JOINTS = 7;
const here = (name) => new URL(name, import.meta.url).href;
const by = (id) => document.getElementById(id);

// Formulas. A line is an operation on lines before it; labkit/site/formulas.py writes them.

const DO = {
  q: (v, q, i) => q[i],
  "=": (v, q, x) => x,
  "+": (v, q, a, b) => v[a] + v[b],
  "-": (v, q, a, b) => v[a] - v[b],
  "*": (v, q, a, b) => v[a] * v[b],
  sin: (v, q, a) => Math.sin(v[a]),
  cos: (v, q, a) => Math.cos(v[a]),
};

function evaluated(lines, q) {
  const values = [];
  for (const [name, ...of] of lines) values.push(DO[name](values, q, ...of));
  return values;
}

// The robot.

const [mujoco, xml, ghosts] = await Promise.all([
  load({ locateFile: here }),
  fetch(here("panda_twin.xml")).then((answer) => answer.text()),
  fetch(here("ghosts.json")).then((answer) => answer.json()),
]);
const model = mujoco.MjModel.from_xml_string(xml);
const data = new mujoco.MjData(model);
const body = (name) => mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY.value, name);
const LINKS = Array.from({ length: JOINTS }, (_, i) => body(`link${i + 1}`));
const END = body("attachment"); // attachment_site sits right on it
const q = [...ghosts.ready];

/** The first three rows of a body's pose in the world, from MuJoCo. */
function pose(id) {
  const R = data.xmat.slice(9 * id, 9 * id + 9);
  const t = data.xpos.slice(3 * id, 3 * id + 3);
  return [0, 1, 2].flatMap((i) => [R[3 * i], R[3 * i + 1], R[3 * i + 2], t[i]]);
}

/** The mistaken arm: {frame: the first three rows of its pose}. */
function mistaken(mistake) {
  const values = evaluated(ghosts.lines, q);
  const rows = (entries) => entries.map((line) => values[line]);
  return Object.fromEntries(
    Object.entries(mistake.frames).map(([name, entries]) => [name, rows(entries)]),
  );
}

// The picture.

const scene = new THREE.Scene();
const camera = new THREE.PerspectiveCamera(40, 4 / 3, 0.01, 20);
camera.up.set(0, 0, 1);
camera.position.set(1.7, -1.5, 1.2);
const renderer = started();
const orbit = new OrbitControls(camera, renderer?.domElement ?? by("stage"));
orbit.target.set(0.2, 0, 0.4);
orbit.update();
scene.add(new THREE.HemisphereLight(0xffffff, 0x888888, 2.4));
const sun = new THREE.DirectionalLight(0xffffff, 2);
sun.position.set(2, -2, 4);
scene.add(sun, new THREE.GridHelper(2, 20, 0x999999, 0x999999).rotateX(Math.PI / 2));

/** What draws; without WebGL nothing does, and the numbers stand alone. */
function started() {
  try {
    const made = new THREE.WebGLRenderer({ antialias: true, alpha: true });
    by("stage").append(made.domElement);
    return made;
  } catch {
    by("stage").className = "none";
    by("stage").textContent = "This browser draws no 3D (WebGL). The numbers are right.";
    return null;
  }
}

function shape(type, [a, b, c]) {
  const kind = mujoco.mjtGeom;
  if (type === kind.mjGEOM_CAPSULE.value)
    return new THREE.CapsuleGeometry(a, 2 * b, 8, 20).rotateX(Math.PI / 2);
  if (type === kind.mjGEOM_CYLINDER.value)
    return new THREE.CylinderGeometry(a, a, 2 * b, 24).rotateX(Math.PI / 2);
  return new THREE.BoxGeometry(2 * a, 2 * b, 2 * c);
}

function arm(color, opacity) {
  return Array.from({ length: model.ngeom }, (_, i) => {
    const size = model.geom_size.slice(3 * i, 3 * i + 3);
    const paint = { color, opacity, transparent: opacity < 1, roughness: 0.6 };
    const material = new THREE.MeshStandardMaterial(paint);
    const mesh = new THREE.Mesh(shape(model.geom_type[i], size), material);
    mesh.matrixAutoUpdate = false;
    scene.add(mesh);
    return mesh;
  });
}

function axes(length) {
  const made = new THREE.AxesHelper(length);
  made.matrixAutoUpdate = false;
  scene.add(made);
  return made;
}

const matrix = (rows) => new THREE.Matrix4().set(...rows, 0, 0, 0, 1);
const real = arm(0xdfe3e6, 1);
const ghost = arm(0xd03020, 0.5);
const hand = axes(0.2);
const ghostHand = axes(0.2);
const frames = LINKS.map(() => axes(0.12));

function put(thing, T) {
  thing.matrix.copy(T);
  thing.matrixWorldNeedsUpdate = true;
}

/** From a body of the arm to the same body of the ghost, in the world. */
function moved(poses, id) {
  const i = LINKS.indexOf(id);
  if (i < 0 && id < LINKS[0]) return new THREE.Matrix4(); // the base stands still
  const [name, from] = i < 0 ? ["ee", END] : [`link${i + 1}`, id];
  return matrix(poses[name]).multiply(matrix(pose(from)).invert());
}

function draw(poses) {
  for (let i = 0; i < model.ngeom; i++) {
    const R = data.geom_xmat.slice(9 * i, 9 * i + 9);
    const t = data.geom_xpos.slice(3 * i, 3 * i + 3);
    const rows = [0, 1, 2].flatMap((k) => [R[3 * k], R[3 * k + 1], R[3 * k + 2], t[k]]);
    put(real[i], matrix(rows));
    ghost[i].visible = poses !== null;
    if (poses) put(ghost[i], moved(poses, model.geom_bodyid[i]).multiply(matrix(rows)));
  }
  put(hand, matrix(pose(END)));
  ghostHand.visible = poses !== null;
  if (poses) put(ghostHand, matrix(poses.ee));
  frames.forEach((frame, i) => {
    frame.visible = by("frames").checked;
    put(frame, matrix(pose(LINKS[i])));
  });
  renderer?.render(scene, camera);
}

function fit() {
  if (!renderer) return;
  const { clientWidth, clientHeight } = by("stage");
  renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
  renderer.setSize(clientWidth, clientHeight, false);
  renderer.domElement.style.width = renderer.domElement.style.height = "100%";
  camera.aspect = clientWidth / clientHeight;
  camera.updateProjectionMatrix();
  renderer.render(scene, camera);
}

// The numbers.

/** How far the hand is off: millimetres and degrees. */
function apart(T, truth) {
  const metres = Math.hypot(...[3, 7, 11].map((i) => T[i] - truth[i]));
  const of = [0, 1, 2].map((i) => [0, 1, 2].map((k) => i + 4 * k)); // columns
  const R = of.map((a) => of.map((b) => a.reduce((sum, x, k) => sum + T[x] * truth[b[k]], 0)));
  const sine = Math.hypot(R[2][1] - R[1][2], R[0][2] - R[2][0], R[1][0] - R[0][1]) / 2;
  const cosine = (R[0][0] + R[1][1] + R[2][2] - 1) / 2;
  return [1000 * metres, (Math.atan2(sine, cosine) * 180) / Math.PI];
}

/** A number with so many decimals; a zero has no sign. */
function fixed(x, decimals) {
  return x.toFixed(decimals).replace(/^-(?=[0.]*$)/, "");
}

function show() {
  data.qpos.set(q);
  mujoco.mj_kinematics(model, data); // fills xpos, xmat, geom_xpos and geom_xmat
  const mistake = ghosts.mistakes.find((one) => one.slug === by("mistake").value);
  const poses = mistake ? mistaken(mistake) : null;
  const truth = pose(END);
  draw(poses);
  const row = (i) => truth.slice(4 * i, 4 * i + 4).map((x) => fixed(x, 6).padStart(10));
  by("pose").textContent = `T_world_ee\n${[0, 1, 2].map((i) => row(i).join(" ")).join("\n")}`;
  by("says").textContent = mistake ? mistake.says : "";
  const [mm, degrees] = poses ? apart(poses.ee, truth) : [0, 0];
  by("off").textContent = poses
    ? `Here the hand is off by ${mm.toFixed(0)} mm and ${degrees.toFixed(1)} degrees.`
    : "";
  const where = `#q=${q.join(",")}${mistake ? `&mistake=${mistake.slug}` : ""}`;
  history.replaceState(null, "", where);
  window.arm = { q: [...q], truth, poses }; // what the page's test reads
}

// The controls.

const sliders = q.map((_, i) => {
  const slider = document.createElement("input");
  const [min, max] = model.jnt_range.slice(2 * i, 2 * i + 2);
  Object.assign(slider, { type: "range", min, max, step: "any" });
  const label = document.createElement("label");
  label.append(`joint${i + 1}`, slider, document.createElement("output"));
  by("sliders").append(label);
  slider.addEventListener("input", () => turn(i, Number(slider.value)));
  return slider;
});

function turn(i, angle) {
  q[i] = angle;
  read();
}

/** Show what q holds, on the sliders as well. */
function read() {
  sliders.forEach((slider, i) => {
    slider.value = q[i];
    slider.nextSibling.textContent = fixed(q[i], 3);
  });
  show();
}

function go(angles) {
  angles.forEach((angle, i) => (q[i] = angle));
  read();
}

function followAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const angles = (asked.get("q") ?? "").split(",").map(Number);
  by("mistake").value = asked.get("mistake") ?? "";
  const whole = angles.length === JOINTS && angles.every(Number.isFinite);
  go(whole ? angles : ghosts.ready);
}

for (const day of [1, 2]) {
  const group = document.createElement("optgroup");
  group.label = `Day ${day}`;
  for (const one of ghosts.mistakes.filter((each) => each.day === day))
    group.append(new Option(`${one.function}: ${one.slug.replaceAll("-", " ")}`, one.slug));
  by("mistake").append(group);
}
by("mistake").addEventListener("change", show);
by("frames").addEventListener("change", show);
by("ready").addEventListener("click", () => go(ghosts.ready));
by("zero").addEventListener("click", () => go(Array(JOINTS).fill(0)));
orbit.addEventListener("change", () => renderer?.render(scene, camera));
addEventListener("hashchange", followAddress);
followAddress();
new ResizeObserver(fit).observe(by("stage"));
by("state").textContent = `MuJoCo ${mujoco.mj_versionString()} in your browser.`;
