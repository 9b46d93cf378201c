// Live figures in the guides: what draws one is loaded when the page is scrolled near it.
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
