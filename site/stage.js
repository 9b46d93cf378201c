// The picture: the Panda with its own looks, a red arm where another one differs, frames.
import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import { largest } from "./maths.js";

const RED = 0xdf2f22;
const AXES = [0xcc2222, 0x1e8e2e, 0x2255dd]; // x, y, z
const SHARP = 0.6; // radians: where an edge stays one
const SAME = 1e-6; // an arm's link that is off by less is not painted red
const FARTHEST = 5; // metres that the camera goes back to see a red arm

/** The arm's looks, as meshes.mjs wrote them: [{body, rgba, geometry}]. */
export function looks(buffer) {
  const size = new Uint32Array(buffer, 0, 1)[0];
  const head = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, size)));
  let at = 4 + size;
  return head.shapes.map(({ body, rgba, vertices, faces }) => {
    const corners = Float32Array.from(new Int16Array(buffer, at, 3 * vertices), (x) => x * head.step);
    at += 6 * vertices;
    const plain = new THREE.BufferGeometry();
    plain.setAttribute("position", new THREE.BufferAttribute(corners, 3));
    plain.setIndex(new THREE.BufferAttribute(new Uint16Array(buffer, at, 3 * faces), 1));
    at += 6 * faces;
    const geometry = toCreasedNormals(plain, SHARP);
    geometry.computeBoundingSphere();
    return { body, rgba, geometry };
  });
}

const matrix = (T) => new THREE.Matrix4().set(...T, 0, 0, 0, 1);

function put(thing, T) {
  thing.matrix.copy(matrix(T));
  thing.matrixWorldNeedsUpdate = true;
}

/** A word in the picture, of one size wherever it stands. */
function label(text, colour, height) {
  const canvas = document.createElement("canvas");
  const pen = canvas.getContext("2d");
  const font = "600 44px system-ui, sans-serif";
  pen.font = font;
  canvas.width = Math.ceil(pen.measureText(text).width) + 16;
  canvas.height = 60;
  pen.font = font;
  pen.lineWidth = 8;
  pen.strokeStyle = "#fffd";
  pen.textBaseline = "middle";
  pen.strokeText(text, 8, 32);
  pen.fillStyle = colour;
  pen.fillText(text, 8, 32);
  const map = new THREE.CanvasTexture(canvas);
  map.colorSpace = THREE.SRGBColorSpace;
  const made = new THREE.Sprite(
    new THREE.SpriteMaterial({ map, depthTest: false, sizeAttenuation: false }),
  );
  made.scale.set((height * canvas.width) / canvas.height, height, 1);
  made.renderOrder = 9;
  return made;
}

const NO_3D = "This browser draws no 3D (WebGL is off), so the arm is not shown. All numbers"
  + " are still computed.";

export class Stage {
  /** What draws into an element; without WebGL nothing does, and `draws` is false. */
  constructor(element, { letters = 0.045, zoom = true } = {}) {
    this.element = element;
    this.letters = letters;
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(36, 4 / 3, 0.02, 60);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(1.75, -1.65, 1.15);
    this.skins = [];
    this.marks = [];
    this.byHand = false; // whether somebody chose how near the camera is
    this.renderer = this.started();
    this.orbit = new OrbitControls(this.camera, this.renderer?.domElement ?? element);
    this.orbit.enableZoom = zoom; // a small one leaves the wheel to the page
    // A finger that goes up or down scrolls the page past it.
    if (this.renderer) this.renderer.domElement.style.touchAction = "pan-y";
    this.orbit.target.set(0.15, 0, 0.45);
    this.orbit.update();
    this.orbit.addEventListener("start", () => (this.byHand = true));
    this.orbit.addEventListener("change", () => this.render());
    this.lit();
    new ResizeObserver(() => this.resized()).observe(element);
  }

  get draws() {
    return this.renderer !== null;
  }

  started() {
    try {
      const made = new THREE.WebGLRenderer({ antialias: true, alpha: true });
      this.element.append(made.domElement);
      return made;
    } catch {
      this.element.classList.add("none");
      this.element.textContent = NO_3D;
      return null;
    }
  }

  lit() {
    const sun = new THREE.DirectionalLight(0xffffff, 1.9);
    sun.position.set(1.5, -2.5, 3.5);
    const back = new THREE.DirectionalLight(0xffffff, 0.7);
    back.position.set(-2, 2, 1);
    const grid = new THREE.GridHelper(2, 20, 0x8a8a8a, 0x8a8a8a).rotateX(Math.PI / 2);
    grid.material.transparent = true;
    grid.material.opacity = 0.45;
    this.scene.add(new THREE.HemisphereLight(0xffffff, 0x77777f, 1.7), sun, back, grid);
  }

  /** One more arm: the real one, or a red one that shows where it differs. */
  arm(shapes, { red = false, faint = false } = {}) {
    const bodies = {};
    for (const { body, rgba, geometry } of shapes) {
      bodies[body] ??= this.moving(new THREE.Group());
      const [r, g, b] = rgba;
      const paint = red ? new THREE.Color(RED) : new THREE.Color().setRGB(r, g, b, THREE.SRGBColorSpace);
      if (!red && r + g + b > 2.9) paint.multiplyScalar(0.86);
      const material = new THREE.MeshStandardMaterial({ color: paint, roughness: 0.55 });
      if (red || faint) see(material, red ? 0.75 : 0.35);
      const mesh = new THREE.Mesh(geometry, material);
      mesh.renderOrder = red ? 3 : 0;
      if (red || faint) bodies[body].add(this.depth(geometry, mesh.renderOrder - 1, red));
      bodies[body].add(mesh);
    }
    const skin = { bodies, shapes, poses: null };
    this.skins.push(skin);
    return skin;
  }

  /** Of a thing that is seen through, its far side is not: first its depth alone. */
  depth(geometry, order, red) {
    const material = new THREE.MeshBasicMaterial({ colorWrite: false });
    if (red) forward(material);
    const made = new THREE.Mesh(geometry, material);
    made.renderOrder = order;
    return made;
  }

  /** Moves an arm to {body: pose}; `beside` hides what is where that arm is. */
  pose(skin, poses, beside = null) {
    skin.poses = poses;
    for (const [name, group] of Object.entries(skin.bodies)) {
      const T = poses?.[name];
      group.visible = Boolean(T) && !(beside && largest(T, beside[name]) < SAME);
      if (group.visible) put(group, T);
    }
  }

  moving(thing) {
    thing.matrixAutoUpdate = false;
    this.scene.add(thing);
    return thing;
  }

  /** A frame: three arrows with their letters, and a name. */
  frame(length, name = "", letters = true) {
    const made = this.mark(this.moving(new THREE.Group()), 1.25 * length);
    AXES.forEach((color, k) => {
      const material = new THREE.MeshBasicMaterial({ color, depthTest: false, transparent: true });
      const stick = new THREE.Mesh(new THREE.CylinderGeometry(0.0045, 0.0045, length, 10), material);
      stick.position.setComponent(k, length / 2);
      if (k === 0) stick.rotateZ(-Math.PI / 2);
      if (k === 2) stick.rotateX(Math.PI / 2);
      stick.renderOrder = 8;
      made.add(stick);
      if (!letters) return;
      const letter = label("xyz"[k], `#${color.toString(16).padStart(6, "0")}`, this.letters);
      letter.position.setComponent(k, length * 1.16);
      made.add(letter);
    });
    if (name) {
      const word = label(name, "#222", this.letters);
      word.position.set(-0.035, -0.035, -0.035);
      made.add(word);
    }
    return made;
  }

  /** A thing with a radius, which the picture has to hold beside the arms. */
  mark(thing, radius) {
    thing.userData.radius = radius;
    this.marks.push(thing);
    return thing;
  }

  put(thing, T) {
    thing.visible = Boolean(T);
    if (T) put(thing, T);
  }

  /** Balls around all that is seen, in the world. */
  balls() {
    const marks = this.marks.filter((thing) => thing.visible);
    const around = ({ matrix, userData }) =>
      new THREE.Sphere(new THREE.Vector3().setFromMatrixPosition(matrix), userData.radius);
    return [...marks.map(around), ...this.links()];
  }

  links() {
    return this.skins.flatMap((skin) =>
      skin.shapes
        .filter(({ body }) => skin.bodies[body].visible)
        .map(({ body, geometry }) =>
          geometry.boundingSphere.clone().applyMatrix4(skin.bodies[body].matrix),
        ),
    );
  }

  /** Whether the arms are in the picture: goes back to see them, where nobody chose. */
  seen() {
    const balls = this.balls();
    if (!balls.length) return true;
    const box = new THREE.Box3();
    for (const ball of balls) box.union(ball.getBoundingBox(new THREE.Box3()));
    const middle = box.getCenter(new THREE.Vector3());
    const away = this.camera.position.clone().sub(this.orbit.target);
    const needed = this.distance(balls, middle, away.clone().normalize());
    const inside = this.inside(balls);
    const tooFar = !this.byHand && away.length() > 1.35 * Math.min(needed, FARTHEST);
    if (!inside || tooFar) {
      const back = Math.min(needed, FARTHEST);
      this.orbit.target.copy(middle);
      if (needed > FARTHEST) this.orbit.target.set(0, 0, 0.5);
      this.camera.position.copy(this.orbit.target).addScaledVector(away.normalize(), back);
      this.orbit.update();
    }
    return this.inside(balls);
  }

  /** How far from a point, in a direction, the camera sees all balls. */
  distance(balls, middle, back) {
    const right = new THREE.Vector3().crossVectors(this.camera.up, back).normalize();
    const up = new THREE.Vector3().crossVectors(back, right);
    const [wide, high] = this.slopes();
    const needs = balls.map(({ center, radius }) => {
      const at = center.clone().sub(middle);
      const a = (Math.abs(at.dot(right)) + radius) / wide;
      const b = (Math.abs(at.dot(up)) + radius) / high;
      return at.dot(back) + Math.max(a, b);
    });
    return 1.04 * Math.max(...needs);
  }

  slopes() {
    const high = Math.tan((this.camera.fov * Math.PI) / 360);
    return [high * this.camera.aspect, high];
  }

  inside(balls) {
    this.camera.updateMatrixWorld();
    const [wide, high] = this.slopes();
    return balls.every(({ center, radius }) => {
      const at = center.clone().applyMatrix4(this.camera.matrixWorldInverse);
      const less = 0.8 * radius; // a ball is larger than what is in it
      return at.z < 0 && Math.abs(at.x) + less < -at.z * wide && Math.abs(at.y) + less < -at.z * high;
    });
  }

  resized() {
    const { clientWidth, clientHeight } = this.element;
    if (!this.renderer || !clientWidth || !clientHeight) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    this.seen();
    this.render();
  }

  /** Draws, once before the next picture of the screen. */
  render() {
    if (!this.renderer || this.asked) return;
    this.asked = requestAnimationFrame(() => {
      this.asked = 0;
      this.renderer.render(this.scene, this.camera);
    });
  }
}

function see(material, opacity) {
  Object.assign(material, { opacity, transparent: true, depthWrite: false });
  forward(material);
}

/** What lies on another thing is drawn over it, without stripes. */
function forward(material) {
  Object.assign(material, { polygonOffset: true, polygonOffsetFactor: -1, polygonOffsetUnits: -4 });
}
