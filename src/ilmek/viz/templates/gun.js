// Moves the drawing of the gun's path: its strokes up to a moment, the gun, and its travels.
(() => {
  const element = (name) => document.getElementById(`gun-${name}`);
  const svg = element("path"), slider = element("time"), play = element("play"), gun = element("mark");
  const strokes = [...svg.querySelectorAll("[data-from]")].map((path) => {
    return { path, from: Number(path.dataset.from), to: Number(path.dataset.to), share: 1 };
  });
  const end = strokes.at(-1)?.to ?? 0, SECONDS = 40;
  let now = end, last = 0, running = false;

  const endOf = ({ path }, share) => path.getPointAtLength(share * path.getTotalLength());
  const draw = () => {
    for (const stroke of strokes) {
      const share = Math.min(1, Math.max(0, (now - stroke.from) / Math.max(0.1, stroke.to - stroke.from)));
      if (share === stroke.share) continue;
      stroke.share = share;
      stroke.path.setAttribute("stroke-dasharray", share < 1 ? `${share} 1` : "none");
      stroke.path.setAttribute("visibility", share > 0 ? "visible" : "hidden");
    }
    const begun = strokes.filter((stroke) => stroke.from <= now);
    const at = begun.length ? endOf(begun.at(-1), begun.at(-1).share) : { x: 0, y: 0 };
    gun.setAttribute("transform", `translate(${at.x} ${at.y})`);
    gun.setAttribute("visibility", now < end ? "visible" : "hidden");
    const points = element("travel").checked ? begun.map((stroke) => [endOf(stroke, 0), endOf(stroke, 1)]) : [];
    element("travels").setAttribute("d", points.reduce((d, [from, to]) => `${d}L${from.x} ${from.y}M${to.x} ${to.y}`, "M0 0"));
    svg.style.transform = element("back").checked ? "scaleX(-1)" : "";
    const minutes = Math.floor(now / 60);
    element("moment").textContent = `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min`;
    slider.value = (1000 * now) / end;
  };
  const step = (time) => {
    if (!running) return;
    now = Math.min(end, now + ((time - last) / 1000 / SECONDS) * end);
    last = time;
    if (now >= end) run(false);
    draw();
    requestAnimationFrame(step);
  };
  const run = (on) => {
    running = on;
    play.textContent = on ? "Pause" : "Play";
    if (!on) return;
    if (now >= end) now = 0;
    last = performance.now();
    requestAnimationFrame(step);
  };
  play.addEventListener("click", () => run(!running));
  slider.addEventListener("input", () => {
    run(false);
    now = (slider.value / 1000) * end;
    draw();
  });
  for (const name of ["back", "travel"]) element(name).addEventListener("change", draw);
  addEventListener("beforeprint", () => {
    run(false);
    now = end;
    draw();
  });
  element("bar").hidden = false;
  draw();
})();
