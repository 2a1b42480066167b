// A link to what is folded opens it, and printing opens the sections. On narrow screens the contents are folded.
function unfold() {
  const target = location.hash.length > 1 && document.getElementById(decodeURIComponent(location.hash.slice(1)));
  const section = target && (target.closest("details") || target.querySelector("details"));
  if (!section) return;
  section.open = true;
  target.scrollIntoView();
}
let folded = [];
addEventListener("hashchange", unfold);
addEventListener("beforeprint", () => {
  folded = [...document.querySelectorAll("details.section:not([open]), details.more:not([open]), .answer details:not([open])")];
  for (const details of folded) details.open = true;
});
addEventListener("afterprint", () => folded.forEach((details) => (details.open = false)));
unfold();
const listed = document.querySelector(".contents details"), narrow = matchMedia("(max-width: 760px)");
if (listed) {
  const fold = () => (listed.open = !narrow.matches);
  narrow.addEventListener("change", fold);
  listed.addEventListener("click", (event) => event.target.closest("a") && narrow.matches && (listed.open = false));
  fold();
}
