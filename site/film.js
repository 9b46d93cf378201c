// Films in the guides: a click puts one where its picture stands.
const shows = Boolean(document.createElement("canvas").getContext("webgl2"));
for (const line of document.querySelectorAll("p.film")) {
  const link = line.querySelector("a");
  const still = line.previousElementSibling;
  if (!shows) line.remove(); // the picture stays
  link.addEventListener("click", (event) => {
    event.preventDefault();
    const film = document.createElement("iframe");
    Object.assign(film, { src: link.href, title: link.textContent, className: "film" });
    still.replaceWith(film);
    line.textContent = "Drag to turn it; the slider is its time.";
  });
}
