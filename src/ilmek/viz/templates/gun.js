(() => {
  const { strokes, size: [width, length, row], end } = JSON.parse(document.getElementById("gun-data").textContent);
  const element = (name) => document.getElementById(`gun-${name}`);
  const canvas = element("path"), pen = canvas.getContext("2d"), slider = element("time"), play = element("play");
  const scale = Math.min(1600 / width, 1600 / length), SECONDS = 40;
  canvas.width = Math.ceil(scale * width);
  canvas.height = Math.ceil(scale * length);
  let now = end, last = 0, running = false;

  const lay = (points, share) => {
    pen.beginPath();
    pen.moveTo(points[0], points[1]);
    let left = Infinity;
    if (share < 1) {
      left = 0;
      for (let i = 2; i < points.length; i += 2) left += Math.hypot(points[i] - points[i - 2], points[i + 1] - points[i - 1]);
      left *= share;
    }
    let x = points[0], y = points[1];
    for (let i = 2; i < points.length && left > 0; i += 2) {
      const piece = Math.hypot(points[i] - x, points[i + 1] - y), part = piece > left ? left / piece : 1;
      x += part * (points[i] - x);
      y += part * (points[i + 1] - y);
      left -= piece;
      pen.lineTo(x, y);
    }
    pen.stroke();
    return [x, y];
  };
  const draw = () => {
    const back = element("back").checked, travels = element("travel").checked;
    pen.setTransform(1, 0, 0, 1, 0, 0);
    pen.clearRect(0, 0, canvas.width, canvas.height);
    pen.setTransform(back ? -scale : scale, 0, 0, -scale, back ? scale * width : 0, scale * length);
    pen.lineJoin = "round";
    let gun = [0, 0];
    for (const [colour, begin, finish, points] of strokes) {
      if (begin > now) break;
      if (travels) {
        pen.strokeStyle = "#c0f";
        pen.lineWidth = row / 4;
        pen.beginPath();
        pen.moveTo(...gun);
        pen.lineTo(points[0], points[1]);
        pen.stroke();
      }
      pen.strokeStyle = colour;
      pen.lineWidth = 0.85 * row;
      gun = lay(points, Math.min(1, (now - begin) / Math.max(0.1, finish - begin)));
    }
    if (now < end) {
      pen.fillStyle = "#e00";
      pen.strokeStyle = "#fff";
      pen.lineWidth = row / 2;
      pen.beginPath();
      pen.arc(...gun, Math.max(2 * row, width / 100), 0, 2 * Math.PI);
      pen.fill();
      pen.stroke();
    }
    const minutes = Math.floor(now / 60);
    element("moment").textContent = `${Math.floor(minutes / 60)} h ${String(minutes % 60).padStart(2, "0")} min`;
    slider.value = (1000 * now) / end;
  };
  const step = (time) => {
    if (!running) return;
    now = Math.min(end, now + ((time - last) / 1000 / SECONDS) * end);
    last = time;
    if (now >= end) stop();
    draw();
    requestAnimationFrame(step);
  };
  const stop = () => {
    running = false;
    play.textContent = "Play";
  };
  play.addEventListener("click", () => {
    if (running) return stop();
    if (now >= end) now = 0;
    running = true;
    play.textContent = "Pause";
    last = performance.now();
    requestAnimationFrame(step);
  });
  slider.addEventListener("input", () => {
    stop();
    now = (slider.value / 1000) * end;
    draw();
  });
  for (const name of ["back", "travel"]) element(name).addEventListener("change", draw);
  draw();
})();
