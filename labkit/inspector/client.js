/* What viser's page has no part for: tabs that the server opens, the pose in the address,
   copying. The server's word is the JSON in [data-r47-state]. Ours are numbered: what was
   said here last is not taken back by a state that does not know of it yet. */
(() => {
  const base = location.pathname.replace(/\/?$/, "/");
  let waiting = 0, said = 0, lastChange = 0, scheduled = false;

  async function go(query) {
    waiting++;
    try {
      said = Number(await (await fetch(`${base}go${query}`, { cache: "no-store" })).text());
    } catch { /* the server is gone; viser's own sign says so */ }
    waiting--;
    later();
  }
  function show() {
    scheduled = false;
    name();
    const node = document.querySelector("[data-r47-state]");
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

  if (location.search.length > 1) back();
  // viser's own word for a dark page; it is read once, when the page starts.
  if (matchMedia("(prefers-color-scheme: dark)").matches)
    history.replaceState(null, "", `${location.search || "?"}&darkMode`);
  addEventListener("popstate", back);
  addEventListener("DOMContentLoaded", () => {
    new MutationObserver(later).observe(document.body, { childList: true, subtree: true });
    // viser turns its camera with the keys that move a slider.
    document.body.addEventListener("keydown", (event) => {
      if (event.target.role === "slider") event.stopPropagation();
    });
  });
})();
