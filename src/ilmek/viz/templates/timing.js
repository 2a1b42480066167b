for (const figure of document.querySelectorAll("figure.timed")) {
  const svg = figure.querySelector("svg");
  const run = JSON.parse(svg.querySelector("metadata").textContent);
  const drive = driveOf(figure, run), controls = figure.querySelector(".controls"), button = controls.querySelector("button");
  const slider = controls.querySelector("input"), answer = controls.querySelector("output");
  const values = figure.querySelector(".timed-values"), rows = [...values.querySelectorAll("tbody tr")];
  const cursor = svg.querySelector("[data-cursor]"), orders = [...controls.querySelectorAll("[data-order]")];
  const moving = run.lanes.filter((lane) => lane.moves.length), curves = [...svg.querySelectorAll("[data-lane]")];
  const speed = 360 / run.period, last = run.laws.length ? run.laws[0][0].length - 1 : 0;
  // A law between two points of its table: the cubic through both with their slopes; the acceleration from the cubic of v.
  function lawAt(law, order, u) {
    const x = u * last, k = Math.min(Math.floor(x), last - 1), t = x - k, h = 1 / last, r = 1 - t;
    const y = law[Math.min(order, 1)], d = law[Math.min(order, 1) + 1];
    if (order === 2) return (6 * t * r * (y[k + 1] - y[k])) / h + d[k] * r * (1 - 3 * t) + d[k + 1] * t * (3 * t - 2);
    return y[k] * (1 + 2 * t) * r * r + y[k + 1] * t * t * (3 - 2 * t) + h * (d[k] * t * r * r - d[k + 1] * t * t * r);
  }
  // Position, velocity or acceleration of a lane at a master angle [deg].
  function at(lane, angle, order) {
    let value = order ? 0 : lane.moves.length ? lane.moves[0][2] : 0;
    for (const [start, end, begin, finish, law] of lane.moves) {
      if (angle < start) break;
      const beta = end - start, h = finish - begin;
      if (angle > end) value = order ? 0 : finish;
      else value = (order ? 0 : begin) + (h / beta ** order) * lawAt(run.laws[law], order, (angle - start) / beta);
    }
    return value * speed ** order;
  }
  const motion = (lane, angle) => lane.moves.findIndex(([start, end]) => angle >= start && angle < end);
  const measured = (value, unit) => (Math.abs(value) < 1e-9 ? "0" : Number(value.toPrecision(4)).toString().replace("-", "−")) +
    (unit && unit !== "°" ? " " : "") + unit;
  const angles = (lane) => [...new Set([...Array(361).keys(), ...lane.moves.flatMap(([start, end]) =>
    [...Array(25).keys()].map((k) => start + (k / 24) * (end - start)))])]
    .filter((angle) => angle >= 0 && angle <= 360).sort((a, b) => a - b);
  const original = curves.map((curve) => curve.getAttribute("d"));
  function draw(order) {
    moving.forEach((lane, number) => {
      if (!order) return curves[number].setAttribute("d", original[number]);
      const over = angles(lane), values = over.map((angle) => at(lane, angle, order));
      const most = Math.max(...values.map(Math.abs)) || 1, middle = lane.floor - run.stroke / 2;
      const points = over.map((angle, k) => `${(run.left + (angle / 360) * run.width).toFixed(1)} ` +
        (middle - (values[k] / most) * (run.stroke / 2)).toFixed(2));
      curves[number].setAttribute("d", "M" + points.join("L"));
    });
    orders.forEach((one, index) => one.setAttribute("aria-pressed", index === order));
  }
  let angle = 0, before = 0, request = 0;
  function show(value) {
    angle = within(run, value);
    if (angle === null) return;
    cursor.setAttribute("transform", `translate(${(run.left + (angle / 360) * run.width).toFixed(2)} 0)`);
    slider.value = angle;
    answer.textContent = `${angle.toFixed(1)}°`;
    slider.setAttribute("aria-valuetext", answer.textContent);
    rows.forEach((row, number) => {
      const lane = run.lanes[number], [named, ...cells] = row.querySelectorAll("td"), now = motion(lane, angle);
      named.textContent = now < 0 ? "dwell" : named.dataset.names.split("|")[now];
      cells.forEach((cell, order) => (cell.textContent = lane.moves.length
        ? measured(at(lane, angle, order), lane.unit + ["", "/s", "/s²"][order]) : ""));
    });
  }
  const turn = (to) => drive.show(to * run.factor);
  function step(now) {
    const from = drive.value === null ? 0 : drive.value / run.factor;
    turn((from + (Math.min(Math.max(now - before, 0), 100) / 8000) * 360) % 360);
    before = now;
    request = requestAnimationFrame(step);
  }
  function play(on) {
    cancelAnimationFrame(request);
    request = 0;
    button.textContent = on ? "Pause" : "Play";
    button.setAttribute("aria-pressed", on);
    if (on && drive.player && drive.player !== halt) drive.player(false);
    if (on) drive.player = halt;
    before = performance.now();
    if (on) request = requestAnimationFrame(step);
  }
  const halt = () => play(false);
  function point(event) {
    const box = svg.getBoundingClientRect(), view = svg.viewBox.baseVal;
    const x = ((event.clientX - box.left) / box.width) * view.width;
    drive.pause();
    turn(Math.min(Math.max(((x - run.left) / run.width) * 360, 0), 360));
  }
  svg.addEventListener("pointerdown", point);
  svg.addEventListener("pointermove", (event) => event.buttons && point(event));
  svg.style.touchAction = "pan-y";
  slider.addEventListener("input", () => { drive.pause(); turn(Number(slider.value)); });
  button.addEventListener("click", () => play(!request));
  orders.forEach((one, order) => one.addEventListener("click", () => draw(order)));
  addEventListener("beforeprint", () => { halt(); draw(0); });
  cursor.setAttribute("visibility", "visible");
  controls.hidden = values.hidden = false;
  const hash = /^#at=([\d.]+)(?:,([012]))?$/.exec(location.hash);
  if (hash) { drive.still = true; turn(Math.min(Number(hash[1]), 360)); draw(Number(hash[2] || 0)); }
  else if (drive.value === null) turn(0);
  drive.figures.push(show);
}
