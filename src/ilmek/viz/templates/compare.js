// The pictures lie over each other; two borders wipe from the source to the chart and from the chart to the carpet.
const compare = document.querySelector(".compare");
const layers = compare.querySelector(".layers"), dividers = compare.querySelector(".dividers");
const borders = [dividers.querySelector("[data-first]"), dividers.querySelector("[data-second]")];
const buttons = [...compare.querySelectorAll("[data-show]")];
const at = borders[0] ? [0.33, 0.67] : [0, 0.5];
function show(which, share) {
  if (which !== null) at[which] = Math.min(1, Math.max(0, share));
  if (which === 0) at[1] = Math.max(at[1], at[0]);
  if (which === 1) at[0] = Math.min(at[0], at[1]);
  borders.forEach((border, index) => {
    const percent = 100 * at[index];
    layers.style.setProperty(index ? "--second" : "--first", percent + "%");
    if (!border) return;
    border.setAttribute("aria-valuenow", Math.round(percent));
    border.style.left = percent + "%";
  });
  for (const button of buttons) button.setAttribute("aria-pressed", button.dataset.show === at.join(" "));
}
borders.forEach((border, index) => {
  if (!border) return;
  const drag = (event) => {
    const box = dividers.getBoundingClientRect();
    show(index, (event.clientX - box.left) / box.width);
  };
  border.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    event.stopPropagation();
    border.focus();
    border.setPointerCapture(event.pointerId);
  });
  border.addEventListener("pointermove", (event) => border.hasPointerCapture(event.pointerId) && drag(event));
  border.addEventListener("keydown", (event) => {
    const steps = { ArrowLeft: -0.02, ArrowDown: -0.02, ArrowRight: 0.02, ArrowUp: 0.02, PageDown: -0.1, PageUp: 0.1 };
    const to = event.key === "Home" ? 0 : event.key === "End" ? 1 : at[index] + (steps[event.key] || NaN);
    if (Number.isNaN(to)) return;
    event.preventDefault();
    event.stopPropagation();
    show(index, to);
  });
});
for (const button of buttons) {
  button.addEventListener("click", () => {
    [at[0], at[1]] = button.dataset.show.split(" ").map(Number);
    show(null);
  });
}
if (layers.querySelectorAll(".layer").length > 1) {
  document.querySelector("section.carpet").classList.add("wiping");
  dividers.hidden = compare.querySelector(".controls").hidden = false;
  show(null);
}
