/* What viser's page has no part for: tabs that the server opens, the pose in the address,
   copying; a page for a browser without WebGL; a word when the server has ended. The server's word is the JSON in [data-r47-state]. Ours are numbered: what was
   said here last is not taken back by a state that does not know of it yet. */
(() => {
  const base = location.pathname.replace(/\/?$/, "/");
  const plain = !document.createElement("canvas").getContext("webgl2");
  let waiting = 0, said = 0, lastChange = 0, scheduled = false;

  async function go(query) {
    waiting++;
    try {
      said = Number(await (await fetch(`${base}go${query}`, { cache: "no-store" })).text());
    } catch { /* the server is gone; `look` says so */ }
    waiting--;
    later();
  }
  function show() {
    scheduled = false;
    name();
    const node = !plain && document.querySelector("[data-r47-state]");
    const state = node && JSON.parse(node.dataset.r47State);
    if (state) document.getElementById("r47-first")?.remove();
    if (!state || waiting || state.heard < said) return;
    const now = Date.now();
    if (state.address !== location.search) {
      const way = lastChange && now - lastChange > 1500 ? "pushState" : "replaceState";
      history[way](null, "", base + state.address);
      lastChange = now;
    }
    lastChange ||= now;
  }
  // viser's buttons that are a picture alone have no name.
  function name() {
    for (const button of document.querySelectorAll("button:not([aria-label], [role])"))
      if (!button.textContent.trim())
        button.ariaLabel = button.className.includes("CloseButton") ? "close" : "settings";
  }
  function later() {
    if (!scheduled) { scheduled = true; setTimeout(show, 10); }
  }
  function back() {
    go(location.search);
    lastChange = 0; // the same address as the server writes it is no step of its own
  }

  addEventListener("click", async ({ target }) => {
    const tab = target.closest?.("[data-r47-go]"), copy = target.closest?.("[data-r47-copy]");
    if (tab) go(tab.dataset.r47Go);
    if (!copy || copy.textContent === "copied") return;
    await navigator.clipboard.writeText(copy.dataset.r47Copy);
    const label = copy.textContent;
    copy.textContent = "copied";
    setTimeout(() => { copy.textContent = label; }, 1200);
  });

  // A server that has ended is asked for in vain twice: a computer may have slept.
  const LOOKS = 2000, channel = new BroadcastChannel("robo47 inspector");
  let missed = 0, next = "";
  async function look() {
    const found = document.hidden ? null
      : await fetch(`${base}here`, { cache: "no-store" }).then((it) => it.ok, () => false);
    if (found !== null) missed = found ? 0 : missed + 1;
    if (found) channel.postMessage(base);
    over();
    setTimeout(look, LOOKS);
  }
  function over() {
    const there = document.getElementById("r47-over");
    document.documentElement.classList.toggle("r47-ended", missed >= 2);
    if (missed < 2) { there?.remove(); return; }
    const card = there ?? document.body.appendChild(make("div", { id: "r47-over", role: "alert" }));
    const words = next ? `A new one runs: <a href="${next}">open its page</a>.`
      : "Start it again with <code>make view</code>, and open the address that it prints.";
    const html = `<p><b>The inspector's server has ended.</b> What you see here is from before,`
      + ` and nothing is asked again.</p><p>${words}</p>`;
    if (card.dataset.html !== html) card.innerHTML = card.dataset.html = html;
  }
  // Only a page of this very host and port hears it, so it is the same student's.
  channel.onmessage = ({ data }) => {
    if (data !== base && /^\/[\w-]+\/$/.test(data)) { next = data + location.search; over(); }
  };
  function make(tag, options) { return Object.assign(document.createElement(tag), options); }

  // The page without 3D: numbers as the server writes them, sliders as the browser has them.
  const NO_3D = "This browser draws no 3D (WebGL is off), so the arm is not shown. The numbers"
    + " below are live. A picture of the arm: <code>make view ARGS=--screenshot</code>.";
  let q = [], sliders = [], sending = false, unsent = false;
  async function send() {
    if (sending) { unsent = true; return; }
    sending = true;
    do { unsent = false; await go(`?q=${q.join(",")}`); } while (unsent);
    sending = false;
    refresh();
  }
  function controls(told, panel) {
    const row = panel.appendChild(make("div", { className: "r47-row" }));
    for (const [name, there] of Object.entries(told.named))
      row.appendChild(make("button", { className: "r47-copy", textContent: name,
        onclick: () => { q = there; send(); } }));
    const frame = row.appendChild(make("select", { ariaLabel: "frame" }));
    for (const name of told.frames) frame.add(new Option(name));
    frame.onchange = async () => { await go(`?frame=${frame.value}`); refresh(); };
    sliders = told.joints.map(({ name, unit, low, high }, i) => {
      const label = panel.appendChild(make("label", { className: "r47-joint" }));
      label.append(`${name} (${unit})`);
      const slider = label.appendChild(make("input",
        { type: "range", min: low, max: high, step: 0.001, ariaLabel: name }));
      const shown = label.appendChild(make("output"));
      slider.oninput = () => { q = q.slice(); q[i] = Number(slider.value); send(); };
      return { slider, shown };
    });
    return frame;
  }
  let frame = null;
  async function refresh() {
    const told = await fetch(`${base}plain`, { cache: "no-store" })
      .then((it) => it.ok ? it.json() : null, () => null);
    const first = document.getElementById("r47-first");
    if (!told || !first || sending) return;
    if (!frame) {
      first.innerHTML = `<p class="r47">${NO_3D}</p><div></div><div></div>`;
      frame = controls(told, first.children[1]);
    }
    q = told.q;
    frame.value = told.frame;
    sliders.forEach(({ slider, shown }, i) => {
      slider.value = q[i];
      shown.textContent = q[i].toFixed(3);
    });
    const numbers = first.children[2];
    if (numbers.dataset.html !== told.html) numbers.innerHTML = numbers.dataset.html = told.html;
    history.replaceState(null, "", `${base}?q=${q.join(",")}&frame=${told.frame}`);
  }

  if (location.search.length > 1) back();
  // viser's own word for a dark page; it is read once, when the page starts.
  if (matchMedia("(prefers-color-scheme: dark)").matches)
    history.replaceState(null, "", `${location.search || "?"}&darkMode`);
  addEventListener("popstate", back);
  addEventListener("DOMContentLoaded", () => {
    setTimeout(look, LOOKS);
    if (plain) {
      document.documentElement.classList.add("r47-plain");
      refresh();
      setInterval(refresh, 500);
      return;
    }
    new MutationObserver(later).observe(document.body, { childList: true, subtree: true });
    // viser turns its camera with the keys that move a slider.
    document.body.addEventListener("keydown", (event) => {
      if (event.target.role === "slider") event.stopPropagation();
    });
  });
})();
