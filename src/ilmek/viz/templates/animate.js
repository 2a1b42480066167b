for (const figure of document.querySelectorAll("figure.moves")) {
  const svg = figure.querySelector("svg");
  const run = JSON.parse(svg.querySelector("metadata").textContent);
  const frames = run.positions[0].length / 2, span = run.closes ? frames : frames - 1;
  const controls = figure.querySelector(".controls"), button = controls.querySelector("button");
  const slider = controls.querySelector("input"), answers = figure.querySelectorAll("[data-reading]");
  const between = (values, value, width, of) => {
    const frame = Math.min(Math.floor(value), span - 1), share = value - frame;
    const before = values[frame * width + of], after = values[((frame + 1) % frames) * width + of];
    return before + share * (after - before);
  };
  const written = (number, digits, unit) => number.toFixed(digits).replace(/^-(?=0\.?0*$)/, "").replace("-", "−") +
    (unit && unit !== "°" ? " " : "") + unit;
  const parts = [...svg.querySelectorAll("[data-at]")], lines = [...svg.querySelectorAll("[data-line]")]
    .map((line) => [line, line.dataset.line.split(",").map(Number), line.dataset.closed ? "Z" : ""]);
  function show(value) {
    const position = (point) => [0, 1].map((of) => between(run.positions[point], value, 2, of));
    const text = (point) => position(point).map((number) => number.toFixed(2)).join(" ");
    for (const [line, points, end] of lines) line.setAttribute("d", "M" + points.map(text).join("L") + end);
    for (const part of parts) {
      let turned = "";
      if (part.dataset.ahead) {
        const [x, y] = position(part.dataset.at), [ahead, below] = position(part.dataset.ahead);
        turned = ` rotate(${(Math.atan2(below - y, ahead - x) * 180) / Math.PI})`;
      }
      part.setAttribute("transform", `translate(${text(part.dataset.at)})${turned}`);
    }
    const at = written(run.first + run.step * value, run.digits, run.unit);
    slider.value = value;
    slider.setAttribute("aria-valuetext", at);
    controls.querySelector("output").textContent = at;
    answers.forEach((answer, index) => {
      const one = run.readings[index];
      answer.textContent = written(between(one.values, value, 1, 0), one.digits, one.unit);
    });
  }
  let phase = 0, before = 0, request = 0;
  const toPhase = (value) => (run.closes ? value / span : Math.acos(1 - (2 * value) / span) / (2 * Math.PI));
  const toValue = () => span * (run.closes ? phase % 1 : (1 - Math.cos(2 * Math.PI * phase)) / 2);
  function step(now) {
    phase = (phase + Math.min(now - before, 100) / (1000 * run.seconds)) % 1;
    before = now;
    show(toValue());
    request = requestAnimationFrame(step);
  }
  function play(on) {
    cancelAnimationFrame(request);
    request = 0;
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", on);
    before = performance.now();
    if (on) request = requestAnimationFrame(step);
  }
  slider.max = span;
  slider.addEventListener("input", () => {
    play((playing = false));
    phase = toPhase(Number(slider.value));
    show(Number(slider.value));
  });
  let playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  button.addEventListener("click", () => play((playing = !request)));
  addEventListener("beforeprint", () => play(false));
  phase = toPhase(run.start);
  show(run.start);
  controls.hidden = false;
  new IntersectionObserver((seen) => play(playing && seen.at(-1).isIntersecting)).observe(svg);
}
