// What a page of the site does besides being read.

// A film takes the place of its picture at a click.
const dark = () =>
  document.body.dataset.theme === "dark" ||
  (document.body.dataset.theme !== "light" && matchMedia("(prefers-color-scheme: dark)").matches);
const shows = Boolean(document.createElement("canvas").getContext("webgl2"));
for (const line of document.querySelectorAll("p.film")) {
  const link = line.querySelector("a");
  const still = line.previousElementSibling;
  if (!shows) line.remove(); // the picture stays
  link.addEventListener("click", (event) => {
    event.preventDefault();
    const film = document.createElement("iframe");
    const src = link.href + (dark() ? "?darkMode" : ""); // viser's own word
    Object.assign(film, { src, title: link.textContent, className: "film" });
    still.replaceWith(film);
    line.textContent = "Drag to turn it; the slider is its time.";
  });
}

// A live figure is loaded when the page is scrolled near it.
const near = new IntersectionObserver(
  (seen) => {
    for (const { target } of seen.filter((one) => one.isIntersecting)) {
      near.unobserve(target);
      import("./figures.js").then((figures) => figures.begin(target));
    }
  },
  { rootMargin: "200px" },
);
for (const figure of document.querySelectorAll("figure.live")) near.observe(figure);

// A formula that is somewhat wider than a phone has smaller letters there, and is whole.
const SMALLEST = 0.76; // of its size
function fit(formula) {
  formula.style.fontSize = "";
  const share = formula.clientWidth / formula.scrollWidth;
  if (share < 1 && share >= SMALLEST) formula.style.fontSize = `${Math.floor(99 * share)}%`;
}

// Code and tables that are wider than the page are scrolled, by keys, too.
const sized = new ResizeObserver((all) => {
  for (const { target } of all) {
    if (target.matches(".math-wrapper")) fit(target);
    if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    else target.removeAttribute("tabindex");
  }
});
for (const wide of document.querySelectorAll("pre, .table-wrapper, .math-wrapper, .long")) sized.observe(wide);
