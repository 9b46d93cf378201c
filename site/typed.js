// The line that is typed: an expression in q that gives a rotation. It is read here, piece
// by piece, and only what stands in this file can be called: nothing is run as a script.
import { Rz } from "./maths.js";

const LONGEST = 200; // characters
const isMatrix = (x) => Array.isArray(x);

export class Unread extends Error {}

const turns = {
  Rx: (a) => [1, 0, 0, 0, Math.cos(a), -Math.sin(a), 0, Math.sin(a), Math.cos(a)],
  Ry: (a) => [Math.cos(a), 0, Math.sin(a), 0, 1, 0, -Math.sin(a), 0, Math.cos(a)],
  Rz,
};
const numbers = {
  sin: Math.sin,
  cos: Math.cos,
  tan: Math.tan,
  sqrt: Math.sqrt,
  abs: Math.abs,
  exp: Math.exp,
  floor: Math.floor,
  deg2rad: (x) => (x * Math.PI) / 180,
  rad2deg: (x) => (x * 180) / Math.PI,
  round: roundedToEven,
};
numbers.radians = numbers.deg2rad;
numbers.degrees = numbers.rad2deg;
const WHOLE = /^make_T\((.*),\s*(?:np\.)?zeros\(3\)\)$/; // the lab's line, as it is
const KNOWN = "q, pi, Rx, Ry, Rz, sin, cos, tan, sqrt, eye(3), .T";

function roundedToEven(x) {
  const below = Math.floor(x);
  if (x - below !== 0.5) return Math.round(x);
  return below % 2 ? below + 1 : below;
}

const transposed = (R) => [0, 3, 6, 1, 4, 7, 2, 5, 8].map((i) => R[i]);

function product(A, B) {
  return A.map((_, n) => {
    const i = n - (n % 3);
    return A[i] * B[n % 3] + A[i + 1] * B[3 + (n % 3)] + A[i + 2] * B[6 + (n % 3)];
  });
}

/** Entry by entry, as NumPy does it; a number goes with every entry. */
function each(a, b, act) {
  if (!isMatrix(a) && !isMatrix(b)) return act(a, b);
  const long = isMatrix(a) ? a : b;
  return long.map((_, i) => act(isMatrix(a) ? a[i] : a, isMatrix(b) ? b[i] : b));
}

const ACTS = {
  "+": (a, b) => each(a, b, (x, y) => x + y),
  "-": (a, b) => each(a, b, (x, y) => x - y),
  "*": (a, b) => each(a, b, (x, y) => x * y),
  "/": (a, b) => each(a, b, (x, y) => x / y),
  "**": (a, b) => each(a, b, (x, y) => x ** y),
  "@": (a, b) => {
    if (!isMatrix(a) || !isMatrix(b)) throw new Unread("@ stands between two matrices");
    return product(a, b);
  },
};

function pieces(text) {
  const found = text.match(/\d+\.?\d*(?:e[+-]?\d+)?|\.\d+|[A-Za-z_]\w*|\*\*|\S/g) ?? [];
  return found.filter((piece, i) => {
    const named = /^(np|numpy|math|se3)$/.test(piece) && found[i + 1] === ".";
    const after = piece === "." && /^(np|numpy|math|se3)$/.test(found[i - 1] ?? "");
    return !named && !after;
  });
}

/** Reads pieces into a function of q; each method is a rule of the grammar. */
class Reader {
  constructor(text) {
    this.rest = pieces(text);
  }

  next(...wanted) {
    return wanted.includes(this.rest[0]) ? this.rest.shift() : null;
  }

  need(piece) {
    if (this.next(piece)) return;
    const there = this.rest.length ? `stands before "${this.rest[0]}"` : "is missing at the end";
    throw new Unread(`a ${piece} ${there}`);
  }

  sum() {
    return this.joined(() => this.term(), "+", "-");
  }

  term() {
    return this.joined(() => this.signed(), "*", "/", "@");
  }

  joined(part, ...signs) {
    let made = part();
    for (let sign = this.next(...signs); sign; sign = this.next(...signs)) {
      const [a, b, act] = [made, part(), ACTS[sign]];
      made = (q) => act(a(q), b(q));
    }
    return made;
  }

  signed() {
    if (this.next("+")) return this.signed();
    if (!this.next("-")) return this.power();
    const of = this.signed();
    return (q) => each(of(q), 0, (x) => -x);
  }

  power() {
    const base = this.turned();
    if (!this.next("**")) return base;
    const exponent = this.signed();
    return (q) => ACTS["**"](base(q), exponent(q));
  }

  /** What may have a .T behind it. */
  turned() {
    let made = this.one();
    while (this.next(".")) {
      if (!this.next("T")) throw new Unread("of a matrix, .T is all that is known here");
      const of = made;
      made = (q) => {
        const value = of(q);
        if (!isMatrix(value)) throw new Unread(".T stands behind a matrix");
        return transposed(value);
      };
    }
    return made;
  }

  one() {
    if (!this.rest.length) throw new Unread("the line ends too early");
    const piece = this.rest.shift();
    if (/^[\d.]+/.test(piece) && piece !== ".") return () => Number(piece);
    if (piece === "(") return this.closed(() => this.sum(), ")");
    if (piece === "[") return this.rows();
    if (/^\w/.test(piece)) return this.named(piece);
    throw new Unread(`"${piece}" cannot stand here`);
  }

  closed(part, end) {
    const made = part();
    this.need(end);
    return made;
  }

  list(part) {
    const made = [part()];
    while (this.next(",") && this.rest[0] !== "]") made.push(part());
    this.need("]");
    return made;
  }

  /** Three rows of three numbers, behind the first bracket. */
  rows() {
    const made = this.list(() => {
      this.need("[");
      return this.list(() => this.sum());
    });
    if (made.length !== 3 || made.some((row) => row.length !== 3))
      throw new Unread("a rotation has three rows of three numbers");
    return (q) =>
      made.flat().map((entry) => {
        const value = entry(q);
        if (isMatrix(value)) throw new Unread("a matrix cannot be an entry of one");
        return value;
      });
  }

  named(name) {
    if (name === "q" || name === "theta") return (q) => q;
    if (name === "pi") return () => Math.PI;
    const known = Object.hasOwn(turns, name) || Object.hasOwn(numbers, name);
    if (!known && !["eye", "array", "transpose", "round"].includes(name))
      throw new Unread(`"${name}" is no name here; known are ${KNOWN}`);
    this.need("(");
    const of = this.sum();
    if (name === "round" && this.next(",")) return this.decimals(of);
    this.need(")");
    return this.applied(name, of);
  }

  decimals(of) {
    const places = this.closed(() => this.sum(), ")");
    return (q) => {
      const shift = 10 ** places(q);
      return each(of(q), 0, (x) => roundedToEven(x * shift) / shift);
    };
  }

  applied(name, of) {
    return (q) => {
      const value = of(q);
      if (name === "array") return value;
      if (name === "eye" && value === 3) return [1, 0, 0, 0, 1, 0, 0, 0, 1];
      if (name === "eye") throw new Unread("the identity of this size is eye(3)");
      if (name === "transpose" && isMatrix(value)) return transposed(value);
      if (Object.hasOwn(numbers, name)) return each(value, 0, numbers[name]);
      if (isMatrix(value)) throw new Unread(`${name} takes an angle, and this is a matrix`);
      if (name === "transpose") throw new Unread("transpose takes a matrix");
      return turns[name](value);
    };
  }
}

/**
 * The function of q that a line is: to nine numbers, a rotation.
 * Throws an Unread with a sentence where it is none; so does the function.
 */
export function read(line) {
  if (line.length > LONGEST) throw new Unread(`a line has at most ${LONGEST} characters here`);
  const plain = line.trim().replace(/^return\b/, "").trim();
  const reader = new Reader(plain.replace(WHOLE, "$1"));
  const made = reader.sum();
  if (reader.rest.length) throw new Unread(`"${reader.rest[0]}" cannot stand here`);
  return (q) => {
    const value = made(q);
    if (!isMatrix(value))
      throw new Unread("this is a number; a rotation is a 3x3 matrix, such as Rz(q)");
    return value;
  };
}

/**
 * What the checker says of a line at its own questions: {right, says, slug}.
 * `table` is typed.py's.
 */
export function judged(turn, table) {
  const values = table.questions.map(turn);
  if (values.flat().some((x) => !Number.isFinite(x)))
    return { right: false, says: "NaN or infinity comes out.", slug: "" };
  const off = (others) =>
    values.map((R, i) => Math.max(...R.map((x, k) => Math.abs(x - others[i][k]))));
  const same = (others) => off(others).every((x) => x <= table.within);
  const many = table.questions.length;
  if (same(table.right))
    return { right: true, says: `Right, at all ${many} angles that the checker asks.`, slug: "" };
  const known = table.named.find((one) => same(one.values));
  if (known) return { right: false, ...known };
  return { right: false, says: unnamed(off(table.right), table), slug: "" };
}

function unnamed(off, table) {
  const worst = off.indexOf(Math.max(...off));
  const right = off.filter((x) => x <= table.within).length;
  return (
    `None of the ${table.named.length} mistakes that this page knows gives these numbers. ` +
    `At q = ${Number(table.questions[worst].toFixed(3))} an entry is off by ` +
    `${off[worst].toPrecision(2)}; right at ${right} of ${off.length} angles. ` +
    "(The checker looks further, for two mistakes at once.)"
  );
}
