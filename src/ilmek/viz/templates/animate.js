for (const figure of document.querySelectorAll("figure.moves")) {
  const svg = figure.querySelector("svg"), run = JSON.parse(svg.querySelector("metadata").textContent);
  const drive = driveOf(figure, run), frames = run.frames, span = run.closes ? frames : frames - 1;
  const controls = figure.querySelector(".controls"), button = controls.querySelector("button");
  const slider = controls.querySelector("input"), answers = figure.querySelectorAll("[data-reading]");
  const output = controls.querySelector("output"), step = (run.to - run.from) / span;
  const between = (values, value, width, of) => {
    const frame = Math.min(Math.max(Math.floor(value), 0), span - 1), share = value - frame;
    const before = values[frame * width + of], after = values[((frame + 1) % frames) * width + of];
    return before + share * (after - before);
  };
  const parts = [...svg.querySelectorAll("[data-at]")], lines = [...svg.querySelectorAll("[data-line]")]
    .map((line) => [line, line.dataset.line.split(",").map(Number), line.dataset.closed ? "Z" : ""]);
  function draw(value) {
    const position = (point) => [0, 1].map((of) => between(run.positions[point], value, 2, of));
    const text = (point) => position(point).map((number) => number.toFixed(2)).join(" ");
    for (const [line, points, end] of lines) line.setAttribute("d", "M" + points.map(text).join("L") + end);
    for (const part of parts) {
      let turned = "";
      if (part.dataset.ahead) {
        const [x, y] = position(part.dataset.at), [ahead, below] = position(part.dataset.ahead);
        turned = ` rotate(${((Math.atan2(below - y, ahead - x) * 180) / Math.PI).toFixed(3)})`;
      }
      part.setAttribute("transform", `translate(${text(part.dataset.at)})${turned}`);
    }
    answers.forEach((answer, index) => {
      const one = run.readings[index];
      answer.textContent = written(between(one.values, value, 1, 0), one.decimals, one.measure);
    });
  }
  // Beyond its range the mechanism stays at the nearer end.
  drive.figures.push((value) => {
    const inside = within(run, value), shown = value / run.factor;
    const at = inside === null ? Math.min(Math.max(shown, run.from), run.to) : inside;
    draw(Math.min(Math.max((at - run.from) / step, 0), span));
    slider.value = at;
    output.textContent = written(at, run.digits, run.unit);
    slider.setAttribute("aria-valuetext", output.textContent);
  });
  // The phase of a run lies in [0, 1): over a turn, or forth and back. The first frame's time may lie before that of play.
  let phase = 0, before = 0, request = 0, playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  const toPhase = (share) => (run.closes ? share % 1 : Math.acos(1 - 2 * Math.min(Math.max(share, 0), 1)) / (2 * Math.PI));
  const toShare = () => (run.closes ? phase : (1 - Math.cos(2 * Math.PI * phase)) / 2);
  function tick(now) {
    phase = (phase + Math.min(Math.max(now - before, 0), 100) / (1000 * run.seconds)) % 1;
    before = now;
    drive.show((run.from + (run.to - run.from) * toShare()) * run.factor);
    request = requestAnimationFrame(tick);
  }
  function play(on) {
    cancelAnimationFrame(request);
    request = 0;
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", on);
    if (!on) return;
    if (drive.player && drive.player !== halt) drive.player(false);
    drive.player = halt;
    const at = drive.value === null ? null : within(run, drive.value);
    if (at !== null) phase = toPhase((at - run.from) / (run.to - run.from));
    before = performance.now();
    request = requestAnimationFrame(tick);
  }
  const halt = () => play((playing = false));
  slider.min = run.from;
  slider.max = run.to;
  slider.step = keyStep(run);
  slider.addEventListener("input", () => {
    drive.pause();
    drive.show(Number(slider.value) * run.factor);
  });
  button.addEventListener("click", () => {
    drive.still = false;
    play((playing = !request));
  });
  addEventListener("beforeprint", halt);
  if (drive.value === null) drive.value = (run.from + step * run.start) * run.factor;
  controls.hidden = false;
  new IntersectionObserver((seen) => play(playing && !drive.still && seen.at(-1).isIntersecting)).observe(svg);
}
