/* The inspector's own controls: says to the server what a person did, and shows what
   the server says. The server's word is the JSON in [data-r47-state]. Ours are numbered:
   what was said here last is not taken back by a state that does not know of it yet. */
(() => {
  const base = location.pathname.replace(/\/?$/, "/");
  const waiting = new Map(); // control -> value: the newest of each is sent
  let sending = "", said = 0, held = null, lastChange = 0, scheduled = false;

  async function pump() {
    if (sending) return;
    while (waiting.size) {
      const [control, value] = waiting.entries().next().value;
      waiting.delete(control);
      sending = control;
      const query = new URLSearchParams({ control, value });
      try {
        const answer = await fetch(`${base}do?${query}`, { cache: "no-store" });
        const number = Number(await answer.text());
        if (control !== "hover") said = number;
      } catch { /* the server is gone; viser's own sign says so */ }
    }
    sending = "";
    later();
  }
  function send(control, value) {
    waiting.delete(control);
    waiting.set(control, String(value));
    pump();
  }

  function read() {
    const node = document.querySelector("[data-r47-state]");
    try { return node && JSON.parse(node.dataset.r47State); } catch { return null; }
  }
  function show() {
    scheduled = false;
    const state = read();
    if (!state) return;
    const late = state.heard < said;
    for (const field of document.querySelectorAll("[data-r47]")) {
      const name = field.dataset.r47, shown = state.values[name];
      const busy = field === held || name === sending || waiting.has(name) ||
        "typing" in field.dataset || (late && field.type !== "text");
      if (shown === undefined || busy) continue;
      if (field.type === "checkbox") field.checked = shown === "true";
      else if (field.value !== shown) field.value = field.type === "range" ? Number(shown) : shown;
    }
    if (late || sending || waiting.size) return;
    const now = Date.now();
    if (state.address !== location.search) {
      const way = lastChange && now - lastChange > 1500 ? "pushState" : "replaceState";
      history[way](null, "", base + state.address);
      lastChange = now;
    }
    lastChange ||= now;
  }
  function later() {
    if (!scheduled) { scheduled = true; setTimeout(show, 10); }
  }

  const dialOf = (event) => event.target.closest?.("[data-r47]");
  const decimals = (field) => Number(field.dataset.decimals || 4);
  const clipped = (field, value) =>
    Math.min(Math.max(value, Number(field.min)), Number(field.max)).toFixed(decimals(field));

  addEventListener("input", (event) => {
    const field = dialOf(event);
    if (!field) return;
    if (field.type === "range") send(field.dataset.r47, clipped(field, Number(field.value)));
    else if (field.type === "text") field.dataset.typing = "";
  }, true);
  addEventListener("change", (event) => {
    const field = dialOf(event);
    if (!field || field.type === "range") return;
    delete field.dataset.typing;
    send(field.dataset.r47, field.type === "checkbox" ? field.checked : field.value);
  }, true);
  addEventListener("focusout", (event) => {
    const field = dialOf(event);
    if (field) { delete field.dataset.typing; later(); }
  }, true);
  addEventListener("pointerdown", (event) => {
    const field = dialOf(event);
    if (field?.type === "range") held = field;
  }, true);
  addEventListener("pointerup", () => { held = null; later(); }, true);

  // Keys: 0.01, with Shift ten times as much, with Alt a tenth.
  const STEPS = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };
  addEventListener("keydown", (event) => {
    const field = dialOf(event);
    if (!field) return;
    event.stopPropagation(); // viser moves the camera with the same keys
    if (field.type === "text" && event.key === "Enter") field.blur();
    if (field.type !== "range" || !(event.key in STEPS)) return;
    event.preventDefault();
    const size = event.shiftKey ? 10 : event.altKey ? 0.1 : 1;
    const step = STEPS[event.key] * size * Number(field.dataset.step);
    field.value = clipped(field, Number(field.value) + step);
    send(field.dataset.r47, field.value);
  }, true);

  // A button is known by what it says, not as an element: it may be drawn anew between
  // press and release, and then the browser sends no click. Keys still send one.
  const buttonOf = (event) => event.target.closest?.("[data-r47-click], [data-r47-copy]");
  const nameOf = (button) => button && `${button.dataset.r47Click} ${button.textContent}`;
  let pressed = null, done = false;
  async function act(button) {
    if (button.dataset.r47Click) return send(button.dataset.r47Click, button.value);
    await navigator.clipboard.writeText(button.dataset.r47Copy);
    const label = button.textContent;
    if (label === "copied") return;
    button.textContent = "copied";
    setTimeout(() => { button.textContent = label; }, 1200);
  }
  addEventListener("pointerdown", (event) => {
    pressed = event.button ? null : nameOf(buttonOf(event));
    done = false;
  }, true);
  addEventListener("pointercancel", () => { pressed = held = null; }, true);
  addEventListener("pointerup", (event) => {
    const at = document.elementFromPoint(event.clientX, event.clientY);
    const button = at && buttonOf({ target: at });
    if (pressed && pressed === nameOf(button)) { done = true; act(button); }
    pressed = null;
  }, true);
  addEventListener("keydown", () => { done = false; }, true);
  addEventListener("click", (event) => {
    const button = buttonOf(event);
    if (button && !done) act(button);
    done = false;
  }, true);

  // Which link is under the pointer: the server knows the arm.
  let at = "", asked = "";
  addEventListener("pointermove", (event) => {
    const over = event.target.tagName === "CANVAS" && !event.buttons;
    at = over ? [event.clientX / innerWidth, event.clientY / innerHeight,
      innerWidth / innerHeight].map((x) => x.toFixed(4)).join(",") : "";
  }, true);
  setInterval(() => { if (at !== asked) { asked = at; send("hover", at); } }, 120);

  function go() {
    send("address", location.search);
    lastChange = 0; // the same address as the server writes it is no step of its own
  }
  if (location.search.length > 1) go();
  // viser's own word for a dark page; it is read once, when the page starts.
  if (matchMedia("(prefers-color-scheme: dark)").matches)
    history.replaceState(null, "", `${location.search || "?"}&darkMode`);
  addEventListener("popstate", go);
  addEventListener("DOMContentLoaded", () => {
    new MutationObserver(later).observe(document.body, { childList: true, subtree: true });
  });
})();
