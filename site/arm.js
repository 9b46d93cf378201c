// The Panda on one page: where the arm is, where a mistake puts it, what the checker says.
// The arm stands where Day 1's product puts it; MuJoCo, once it is loaded, is asked too.
import { apart, chain, fixed, largest, pose, rigid } from "./maths.js";
import { Stage, looks } from "./stage.js";
import { Unread, judged, read } from "./typed.js";

const here = (name) => new URL(name, import.meta.url).href;
const by = (id) => document.getElementById(id);
const RIGHT = "Rz(q)";

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

const json = (name) => fetch(here(name)).then((answer) => answer.json());
const [panda, ghosts, meshes] = await Promise.all([
  json("panda.json"),
  json("ghosts.json"),
  fetch(here("panda.bin")).then((answer) => answer.arrayBuffer()),
]);
const LINKS = panda.links.map((link) => link.name);
const q = [...panda.ready];
let oracle = null; // MuJoCo, once it is here

/** The arm of a mistake: {frame: the first three rows of its pose}. */
function mistaken(mistake) {
  const values = evaluated(ghosts.lines, q);
  const rows = (entries) => entries.map((line) => values[line]);
  return Object.fromEntries(
    Object.entries(mistake.frames).map(([name, entries]) => [name, rows(entries)]),
  );
}

/** What is to be seen beside the right arm: {poses, right, says} of a line or a mistake. */
function other() {
  const chosen = ghosts.mistakes.find((one) => one.slug === by("mistake").value);
  if (chosen) return { poses: mistaken(chosen), says: chosen.says, right: false };
  const line = by("line").value;
  if (line.trim() === RIGHT) return { poses: null, says: "", right: true };
  try {
    const turn = read(line);
    const verdict = judged(turn, ghosts.typed);
    const { link0, ...poses } = chain(panda.links, q, (angle) => pose(turn(angle)));
    const drawn = Object.values(poses).flat().every(Number.isFinite);
    return { ...verdict, poses: drawn && !verdict.right ? poses : null };
  } catch (error) {
    if (!(error instanceof Unread)) throw error;
    return { poses: null, says: `Not read: ${error.message}.`, right: false };
  }
}

// The picture.

const stage = new Stage(by("stage"));
const shapes = looks(meshes);
const real = stage.arm(shapes);
const red = stage.arm(shapes, { red: true });
const hand = stage.frame(0.2, "ee");
const redHand = stage.frame(0.2);
const frames = LINKS.slice(0, -1).map((name) => stage.frame(0.11, name, false));

/** Draws; whether all of it is in the picture. */
function draw(truth, poses) {
  const right = { link0: truth.link0, ...truth };
  stage.pose(real, right);
  stage.pose(red, poses && { link0: truth.link0, ...poses }, right);
  stage.put(hand, truth.ee);
  stage.put(redHand, poses && red.bodies.ee.visible ? poses.ee : null);
  frames.forEach((frame, i) => stage.put(frame, by("frames").checked ? truth[LINKS[i]] : null));
  const inside = stage.seen();
  stage.render();
  return inside;
}

// The numbers.

function show() {
  const truth = chain(panda.links, q);
  const { poses, says, right } = other();
  const drawn = poses && Object.values(poses).every(rigid) ? poses : null;
  const inside = draw(truth, drawn);
  const row = (i) => truth.ee.slice(4 * i, 4 * i + 4).map((x) => fixed(x, 6).padStart(9));
  by("pose").textContent = `T_world_ee\n${[0, 1, 2].map((i) => row(i).join(" ")).join("\n")}`;
  by("says").textContent = says;
  by("says").className = says && !right ? "wrong" : "right";
  by("off").textContent = poses ? away(poses.ee, truth.ee, drawn, inside) : "";
  written();
  const asked = oracle ? oracle(q) : null;
  if (asked) by("state").textContent = agreed(asked, truth.ee);
  window.arm = { q: [...q], truth: asked?.ee ?? truth.ee, poses, mujoco: asked?.version };
}

function away(T, truth, drawn, inside) {
  const [mm, degrees] = apart(T, truth);
  const turned = drawn ? ` and ${degrees.toFixed(1)} degrees` : "";
  const shape = " Not drawn: R is no rotation, so the arm would change its shape.";
  const where = drawn ? (inside ? "" : " It is outside the picture.") : shape;
  return `Here the hand is off by ${mm.toFixed(0)} mm${turned}.${where}`;
}

/** The address holds what is seen. */
function written() {
  const parts = [`q=${q.join(",")}`];
  const line = by("line").value;
  if (by("mistake").value) parts.push(`mistake=${by("mistake").value}`);
  else if (line.trim() !== RIGHT) parts.push(`line=${encodeURIComponent(line)}`);
  history.replaceState(null, "", `#${parts.join("&")}`);
}

function agreed({ version, ee }, mine) {
  const off = largest(ee, mine);
  const far = off < 1e-8 ? `agrees: ${off.toExponential(1)} apart at most` : `disagrees by ${off}`;
  return `MuJoCo ${version}, in your browser, ${far}.`;
}

/** Loads MuJoCo: a function of q to what it says. */
async function loaded() {
  const [{ default: load }, xml] = await Promise.all([
    import("@mujoco/mujoco"),
    fetch(here("panda_twin.xml")).then((answer) => answer.text()),
  ]);
  const mujoco = await load({ locateFile: here });
  const model = mujoco.MjModel.from_xml_string(xml);
  const data = new mujoco.MjData(model);
  const version = mujoco.mj_versionString();
  // attachment_site sits right on it
  const end = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY.value, "attachment");
  return (angles) => {
    data.qpos.set(angles);
    mujoco.mj_kinematics(model, data); // fills xpos and xmat
    const R = data.xmat.slice(9 * end, 9 * end + 9);
    return { version, ee: pose([...R], data.xpos.slice(3 * end, 3 * end + 3)) };
  };
}

// The controls.

const within = (x, [low, high]) => Math.min(Math.max(x, low), high);

const sliders = q.map((_, i) => {
  const slider = document.createElement("input");
  const [min, max] = panda.limits[i];
  Object.assign(slider, { type: "range", min, max, step: "any" });
  const label = document.createElement("label");
  label.append(`joint${i + 1}`, slider, document.createElement("output"));
  by("sliders").append(label);
  slider.addEventListener("input", () => {
    q[i] = Number(slider.value);
    go(q);
  });
  return slider;
});

/** Goes to some angles, each within its joint's limits. */
function go(angles) {
  sliders.forEach((slider, i) => {
    q[i] = within(angles[i], panda.limits[i]);
    slider.value = q[i];
    slider.nextSibling.textContent = fixed(q[i], 3);
  });
  show();
}

function followAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const angles = (asked.get("q") ?? "").split(",").map(Number);
  by("mistake").value = asked.get("mistake") ?? "";
  by("line").value = asked.get("line") ?? RIGHT;
  const whole = angles.length === q.length && angles.every(Number.isFinite);
  go(whole ? angles : panda.ready);
}

for (const day of [1, 2]) {
  const group = document.createElement("optgroup");
  group.label = `Day ${day}`;
  for (const one of ghosts.mistakes.filter((each) => each.day === day))
    group.append(new Option(`${one.function}: ${one.slug.replaceAll("-", " ")}`, one.slug));
  by("mistake").append(group);
}

/** One mistake at a time: a line, or one from the list. */
function typed() {
  by("mistake").value = "";
  show();
}

by("mistake").addEventListener("change", () => {
  by("line").value = RIGHT;
  show();
});
by("line").addEventListener("input", typed);
for (const button of document.querySelectorAll("#tries button"))
  button.addEventListener("click", () => {
    by("line").value = button.textContent;
    typed();
  });
by("frames").addEventListener("change", show);
by("ready").addEventListener("click", () => go(panda.ready));
by("zero").addEventListener("click", () => go(q.map(() => 0)));
addEventListener("hashchange", followAddress);
by("arm").classList.add("here");
by("state").textContent = "The product of Day 1, in this page. MuJoCo is loading ...";
followAddress();
performance.mark("arm ready");
try {
  oracle = await loaded();
  show();
} catch (error) {
  by("state").textContent = `The product of Day 1, in this page. MuJoCo did not load: ${error.message}`;
}
