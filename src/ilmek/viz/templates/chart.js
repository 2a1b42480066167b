// A cursor over the curves of a chart. Its ordinates are read off the curves as drawn.
for (const figure of document.querySelectorAll("figure.read")) {
  const svg = figure.querySelector("svg"), run = JSON.parse(svg.querySelector("metadata").textContent);
  const drive = driveOf(figure, run), chart = figure.querySelector(".scroll"), values = figure.querySelector(".readings");
  const [named, ...answers] = values.querySelectorAll("dd");
  const cursor = svg.querySelector("[data-cursor]"), dots = [...svg.querySelectorAll("[data-dot]")];
  const curves = answers.map((_, index) => {
    const path = svg.querySelector(`[data-series="${index}"]`);
    const pieces = path ? path.getAttribute("d").split("M").slice(1) : [];
    return pieces.map((piece) => piece.split("L").map((point) => point.split(" ").map(Number)));
  });
  const width = run.right - run.left, span = run.to - run.from;
  const toX = (at) => run.left + ((at - run.from) / span) * width;
  const toY = (y) => run.low[1] + ((y - run.low[0]) / (run.high[0] - run.low[0])) * (run.high[1] - run.low[1]);
  // The ordinate of the first line of a curve that passes x [pt]; null where none does.
  function ordinate(pieces, x) {
    for (const piece of pieces) {
      for (let k = 1; k < piece.length; k++) {
        const [x0, y0] = piece[k - 1], [x1, y1] = piece[k];
        if (x < Math.min(x0, x1) - 0.006 || x > Math.max(x0, x1) + 0.006) continue;
        return x1 === x0 ? y1 : y0 + Math.min(Math.max((x - x0) / (x1 - x0), 0), 1) * (y1 - y0);
      }
    }
    return null;
  }
  let shown = run.from;
  function show(value) {
    let at = within(run, value);
    if (at !== null && run.whole) at = Math.round(at);
    cursor.setAttribute("visibility", at === null ? "hidden" : "visible");
    if (at === null) {
      for (const one of dots) one.setAttribute("visibility", "hidden");
      for (const one of answers) one.textContent = "–";
      named.textContent = "–";
      return;
    }
    shown = at;
    const x = toX(at);
    cursor.setAttribute("transform", `translate(${x.toFixed(2)} 0)`);
    named.textContent = written(at, run.whole ? 0 : run.digits, run.unit);
    curves.forEach((pieces, index) => {
      const y = ordinate(pieces, x);
      dots[index].setAttribute("visibility", y === null ? "hidden" : "visible");
      if (y !== null) dots[index].setAttribute("transform", `translate(${x.toFixed(2)} ${y.toFixed(2)})`);
      answers[index].textContent = y === null ? "–" : written(toY(y), run.decimals, run.measure);
    });
    chart.setAttribute("aria-valuenow", at);
    if (document.activeElement === chart) {
      const said = [...values.querySelectorAll("dt")].map((one, k) => `${one.textContent} ${[named, ...answers][k].textContent}`);
      chart.setAttribute("aria-valuetext", said.join("; "));
    }
  }
  function point(event) {
    const box = svg.getBoundingClientRect();
    const x = ((event.clientX - box.left) / box.width) * svg.viewBox.baseVal.width;
    const at = run.from + ((x - run.left) / width) * span;
    drive.pause();
    drive.show(Math.min(Math.max(at, run.from), run.to) * run.factor);
  }
  svg.addEventListener("pointermove", (event) => (event.pointerType === "mouse" || event.buttons) && point(event));
  svg.addEventListener("pointerdown", point);
  chart.addEventListener("keydown", (event) => {
    const at = keyed(event, run, shown);
    if (at === null) return;
    drive.pause();
    drive.show(at * run.factor);
  });
  for (const [name, value] of [["role", "slider"], ["tabindex", "0"], ["aria-valuemin", run.from], ["aria-valuemax", run.to],
    ["aria-label", `${svg.getAttribute("aria-label")}: ${run.drive}`]]) chart.setAttribute(name, value);
  drive.figures.push(show);
  values.hidden = false;
}
// Charts of which nothing moves begin at their first mark, or in the middle of their range.
for (const known of drives.values()) {
  for (const [, drive] of known) if (drive.value !== null) drive.show(drive.value);
}
for (const figure of document.querySelectorAll("figure.read")) {
  const run = JSON.parse(figure.querySelector("metadata").textContent), drive = driveOf(figure, run);
  if (drive.value === null) drive.show(run.start * run.factor);
}
