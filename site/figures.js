// Live figures at the formulas of the guides: a small arm, a few sliders, the numbers.
// A guide names one in a line of its own, <!-- live: product -->; live.js begins it.
import * as THREE from "three";
import {
  Rz, ONE, apart, axis, chain, cross, dot, fixed, minus, moved, place, pose, rigid, rows3,
  symmetric, times,
} from "./maths.js";
import { Stage, looks } from "./stage.js";
import { Unread, judged, read } from "./typed.js";

const here = (name) => new URL(name, import.meta.url).href;
const made = (tag, className = "", text = "") =>
  Object.assign(document.createElement(tag), { className, textContent: text });
let robot = null; // of all figures of a page, loaded once

async function loaded() {
  const [panda, meshes] = await Promise.all([
    fetch(here("panda.json")).then((answer) => answer.json()),
    fetch(here("panda.bin")).then((answer) => answer.arrayBuffer()),
  ]);
  return { panda, shapes: looks(meshes) };
}

class Figure {
  constructor(element, { panda, shapes }) {
    this.panda = panda;
    this.links = panda.links;
    this.q = [...panda.ready];
    // The numbers of most figures are those of the arm without a hand.
    this.shapes = this.constructor.hand ? shapes : shapes.filter(({ body }) => body !== "ee");
    const picture = element.appendChild(made("div", "picture"));
    this.side = element.appendChild(made("div", "side"));
    this.stage = new Stage(picture, { letters: 0.06, zoom: false });
    picture.setAttribute("role", "img");
    picture.setAttribute("aria-label", this.constructor.says);
    this.arm = this.stage.arm(this.shapes);
    this.told = this.side.appendChild(made("p", "told"));
    this.begin();
    this.numbers = this.side.appendChild(made("pre"));
    this.numbers.tabIndex = 0;
    this.side.append(made("p", "hint", this.constructor.hint));
    element.figure = this;
    this.show();
  }

  slider(name, [low, high], value, act, step = "any") {
    const label = made("label", "", name);
    const input = made("input");
    const output = made("output");
    Object.assign(input, { type: "range", min: low, max: high, step, value });
    const set = () => (output.textContent = step === 1 ? "" : fixed(Number(input.value), 2));
    input.addEventListener("input", () => {
      act(Number(input.value));
      set();
      this.show();
    });
    label.append(input, output);
    this.side.append(label);
    set();
    return input;
  }

  /** Sliders of some joints, counted from 1. */
  joints(...some) {
    for (const n of some)
      this.slider(`q${n}`, this.panda.limits[n - 1], this.q[n - 1], (x) => (this.q[n - 1] = x));
  }

  box(text, act) {
    const label = made("label", "box");
    const input = made("input");
    input.type = "checkbox";
    input.addEventListener("change", () => {
      act(input.checked);
      this.show();
    });
    label.append(input, ` ${text}`);
    this.side.append(label);
  }

  drawn() {
    this.stage.seen();
    this.stage.render();
  }
}

const small = (n) => String.fromCodePoint(0x2080 + n); // an index

const matrixText = (name, T) =>
  `${name}\n${rows3(T).map((row) => row.map((x) => fixed(x, 3).padStart(7)).join("")).join("\n")}`;

/** Words of a formula, of which some are multiplied by now. */
function marked(line, words, from, to) {
  line.replaceChildren(
    ...words.flatMap((word, i) => [made(i >= from && i < to ? "b" : "span", "", word), " "]),
  );
}

/** Day 1: a link's place, a joint's turn, and so on; the product, factor by factor. */
class Product extends Figure {
  static says = "The Panda, and the frame that the factors so far lead to";
  static hint = "Each factor moves the frame one step: L to the next link, J turns it about its z.";
  begin() {
    this.words = [
      `L${small(0)}`,
      ...this.links.slice(0, -1).flatMap((_, i) => [`L${small(i + 1)}`, `J(q${small(i + 1)})`]),
      "L_attachment",
    ];
    this.count = 7;
    this.swapped = false;
    this.red = this.stage.arm(this.shapes, { red: true });
    this.frame = this.stage.frame(0.22);
    this.slider("factors", [1, this.words.length], this.count, (n) => (this.count = n), 1);
    this.joints(2, 4);
    this.box("every J before its L", (on) => (this.swapped = on));
  }

  /** The product of so many factors. */
  partly(count) {
    let T = ONE;
    for (let n = 1; n < count; n++) {
      const i = Math.floor((n - 1) / 2);
      const turn = n % 2 === (this.swapped ? 1 : 0) && n < this.words.length - 1;
      T = times(T, turn ? pose(Rz(this.q[i])) : this.links[i].T);
    }
    return T;
  }

  show() {
    const right = chain(this.links, this.q);
    const names = this.swapped ? this.words.map((_, n) => this.words[swap(n, this.words.length)]) : this.words;
    marked(this.told, names, 0, this.count);
    const poses = this.swapped ? this.wrong() : null;
    this.stage.pose(this.arm, right);
    this.stage.pose(this.red, poses, right);
    const T = this.partly(this.count);
    this.stage.put(this.frame, T);
    this.numbers.textContent = matrixText("the product so far", T);
    this.value = T;
    this.drawn();
  }

  wrong() {
    const poses = { link0: ONE };
    for (let i = 1; i <= 7; i++) poses[`link${i}`] = this.partly(2 * i + 1);
    return poses;
  }
}

/** Where a factor goes when each J changes places with its L; the first and last stay. */
function swap(n, many) {
  if (n === 0 || n === many - 1) return n;
  return n % 2 ? n + 1 : n - 1;
}

/** Day 2: seven lines that stand still; turned about from the last one to the first. */
class Screws extends Figure {
  static says = "The Panda, and the seven axes of its joints as they lie at zero";
  static hint = "The lines never move: the last joint turns first, and everything beyond it goes along.";
  begin() {
    this.from = 4;
    this.zero = chain(this.links, this.q.map(() => 0));
    this.screws = this.links.slice(0, -1).map(({ name }) => {
      const omega = axis(this.zero[name], 2);
      return { omega, v: cross(place(this.zero[name]), omega), through: place(this.zero[name]) };
    });
    this.lines = this.screws.map(({ omega, through }) => this.line(omega, through));
    this.hand = this.stage.frame(0.2);
    this.words = [...this.screws.map((_, i) => `e^[S${small(i + 1)}]q${small(i + 1)}`), "M"];
    this.slider("back to joint", [1, 8], this.from, (n) => (this.from = n), 1);
    this.joints(2, 4, 6);
  }

  line(omega, through) {
    const stick = new THREE.Mesh(
      new THREE.CylinderGeometry(0.006, 0.006, 0.5, 10),
      new THREE.MeshBasicMaterial({ color: 0x777777, depthTest: false, transparent: true }),
    );
    stick.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), new THREE.Vector3(...omega));
    stick.position.set(...through);
    stick.renderOrder = 7;
    this.stage.scene.add(this.stage.mark(stick, 0.25));
    stick.updateMatrix();
    return stick;
  }

  show() {
    const last = this.screws.length;
    const poses = { link0: ONE };
    for (let i = 1; i <= last + 1; i++) {
      let T = this.zero[this.links[i - 1].name];
      for (let k = Math.min(i, last); k >= this.from; k--) T = times(this.turned(k - 1), T);
      poses[this.links[i - 1].name] = T;
    }
    this.stage.pose(this.arm, poses);
    this.stage.put(this.hand, poses.ee);
    this.lines.forEach((line, i) => line.material.color.set(i + 1 === this.from ? 0xd9480f : 0x777777));
    marked(this.told, this.words, this.from - 1, last + 1);
    this.numbers.textContent = `${this.screwText()}${matrixText("the product so far", poses.ee)}`;
    this.value = poses.ee;
    this.drawn();
  }

  screwText() {
    if (this.from > this.screws.length) return "";
    const { omega, v } = this.screws[this.from - 1];
    const text = (some) => some.map((x) => fixed(x, 3)).join(", ");
    return `S${this.from} = (${text(omega)};\n      ${text(v)})\n`;
  }

  /** The exponential of a joint's screw: a turn about its line. */
  turned(i) {
    const { omega: w, through: p } = this.screws[i];
    const [s, c] = [Math.sin(this.q[i]), Math.cos(this.q[i])];
    const skew = [0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0];
    const R = skew.map((x, n) => {
      const [row, column] = [Math.floor(n / 3), n % 3];
      return (row === column ? c : 0) + s * x + (1 - c) * w[row] * w[column];
    });
    return pose(R, minus(p, moved(pose(R), p))); // p stays where it is
  }
}

/** Day 3: all velocities of the hand that joint speeds of length 1 can give. */
class Ellipse extends Figure {
  static says = "The Panda, and at its end the ellipsoid of velocities";
  static hint = "Stretch the arm (q4 to the right, q2 and q6 with it): it grows flat, and forces grow long.";
  begin() {
    this.forces = false;
    this.ball = new THREE.Mesh(
      new THREE.SphereGeometry(1, 40, 24),
      new THREE.MeshStandardMaterial({ color: 0x1971c2, transparent: true, opacity: 0.5, depthWrite: false }),
    );
    this.ball.renderOrder = 4;
    this.stage.mark(this.stage.moving(this.ball), 0.3);
    this.joints(2, 4, 6);
    this.box("forces instead of velocities", (on) => (this.forces = on));
  }

  show() {
    const poses = chain(this.links, this.q);
    const J = this.links.slice(0, -1).map(({ name }) => {
      const T = poses[name];
      return cross(axis(T, 2), minus(place(poses.ee), place(T))); // a column: metres
    });
    const JJ = [0, 1, 2].map((i) => [0, 1, 2].map((k) => J.reduce((sum, c) => sum + c[i] * c[k], 0)));
    const { values, vectors } = symmetric(JJ);
    const half = values.map((x) => Math.sqrt(Math.max(x, 0)));
    this.stage.pose(this.arm, poses);
    const long = half.map((x) => (this.forces ? Math.min(0.08 / Math.max(x, 1e-9), 3) : 0.3 * x));
    const columns = vectors.map((v, k) => v.map((x) => x * Math.max(long[k], 0.002)));
    this.stage.put(this.ball, pose([0, 1, 2].flatMap((i) => columns.map((c) => c[i])), place(poses.ee)));
    this.ball.userData.radius = Math.min(Math.max(...long), 0.6);
    this.ball.material.color.set(this.forces ? 0xd9480f : 0x1971c2);
    this.told.textContent = this.forces ? "half-lengths: 1 / singular values" : "half-lengths: singular values";
    const [unit, shown] = this.forces ? ["N", half.map((x) => 1 / x)] : ["m/s", half];
    this.numbers.textContent = shown.map((x) => `${fixed(x, 3).padStart(9)} ${unit}`).join("\n");
    this.value = half;
    this.drawn();
  }
}

/** Day 4: what holds the arm still, joint by joint. */
class Gravity extends Figure {
  static says = "The Panda, and at each link's centre of mass its weight as an arrow";
  static hint = "Each arrow is a link's weight. Its torque about a joint: weight times lever arm.";
  begin() {
    this.arrows = this.links.slice(0, -1).map(({ mass }) => {
      const down = new THREE.Vector3(0, 0, -1);
      const arrow = new THREE.ArrowHelper(down, down, 0.05 * mass, 0xd9480f, 0.05, 0.04);
      arrow.traverse((part) => part.material && Object.assign(part.material, { depthTest: false, transparent: true }));
      arrow.traverse((part) => (part.renderOrder = 6));
      this.stage.scene.add(arrow);
      return arrow;
    });
    this.joints(2, 4, 6);
  }

  show() {
    const poses = chain(this.links, this.q);
    const links = this.links.slice(0, -1);
    const centres = links.map(({ name, centre }) => moved(poses[name], centre));
    centres.forEach((centre, i) => this.arrows[i].position.set(...centre));
    const torques = links.map(({ name }, i) => {
      const [z, p] = [axis(poses[name], 2), place(poses[name])];
      return centres.slice(i).reduce((sum, c, k) => {
        const up = [0, 0, links[i + k].mass * this.panda.gravity]; // what holds it
        return sum + dot(z, cross(minus(c, p), up));
      }, 0);
    });
    this.stage.pose(this.arm, poses);
    this.told.textContent = "g(q), N m";
    this.numbers.textContent = torques
      .map((x, i) => `joint${i + 1} ${fixed(x, 2).padStart(7)} ${"█".repeat(Math.round(Math.abs(x) / 3))}`)
      .join("\n");
    this.value = torques;
    this.drawn();
  }
}

const MISTAKES = ["Rz(-q)", "Rx(q)", "Rz(2*q)", "Rz(q)"]; // to try; the last one is right

/** The home page: a line of Day 1's joint_T, its arm in red, and the checker's sentence. */
class Mistake extends Figure {
  static hand = true;
  static says = "The Panda, and in red the arm of the typed mistake";
  static hint = "Drag the picture to rotate it. The red arm is drawn where it differs.";
  begin() {
    this.told.remove();
    this.q = [0, 0.5, 0, -1.4, 0, 1.9, 0.785]; // with all signs changed it bends to the back
    this.red = this.stage.arm(this.shapes, { red: true });
    this.code();
    const tries = this.side.appendChild(made("p", "tries"));
    for (const line of MISTAKES) {
      const button = tries.appendChild(made("button", "", line));
      button.addEventListener("click", () => this.typed(line));
    }
    this.verdict = this.side.appendChild(made("p", "verdict"));
    this.verdict.setAttribute("aria-live", "polite");
    this.joints(2, 4);
    this.input.value = MISTAKES[0];
  }

  /** Writes the function, with a field in the place of its line. */
  code() {
    const code = this.side.appendChild(made("div", "code"));
    this.input = Object.assign(made("input"), { maxLength: 200, spellcheck: false });
    this.input.setAttribute("aria-label", "R, the rotation that joint_T gives to make_T");
    this.input.setAttribute("autocapitalize", "off");
    this.input.addEventListener("input", () => this.show());
    code.append("def joint_T(q):", made("br"), "  R = ", this.input);
    code.append(made("br"), "  return make_T(R, np.zeros(3))");
  }

  typed(line) {
    this.input.value = line;
    this.show();
  }

  /** The red arm and the sentence: {poses, says, right}. */
  other() {
    try {
      const turn = read(this.input.value);
      const { says, right } = judged(turn, this.table);
      const poses = chain(this.links, this.q, (angle) => pose(turn(angle)));
      return { says: right ? "Right, at all angles that the checker asks." : says, right, poses };
    } catch (error) {
      if (!(error instanceof Unread)) throw error;
      return { poses: null, says: `Not read: ${error.message}.`, right: false };
    }
  }

  show() {
    if (!this.table) return this.asked();
    const truth = chain(this.links, this.q);
    const { poses, says, right } = this.other();
    const drawn = poses && !right && Object.values(poses).every(rigid) ? poses : null;
    this.stage.pose(this.arm, truth);
    this.stage.pose(this.red, drawn, truth);
    this.verdict.className = `verdict ${right ? "right" : "wrong"}`;
    this.verdict.textContent = says;
    this.numbers.textContent = poses ? `The hand is off by ${apart(poses.ee, truth.ee)[0].toFixed(0)} mm.` : "";
    this.value = { says, drawn };
    this.drawn();
  }

  /** Loads the table of mistakes once, then shows. */
  async asked() {
    this.table = (await fetch(here("ghosts.json")).then((answer) => answer.json())).typed;
    this.show();
  }
}

const FIGURES = { mistake: Mistake, product: Product, screws: Screws, ellipse: Ellipse, gravity: Gravity };

/** Begins a figure of a guide in its place. */
export async function begin(element) {
  robot ??= loaded();
  new FIGURES[element.dataset.figure](element, await robot);
}
