// Row, knot and yarn under the pointer, read from the pixels of the chart's picture; and the knots about it, enlarged.
const picture = document.querySelector(".layer.chart img"), panel = document.querySelector(".pointed");
async function point() {
  const chart = JSON.parse(document.getElementById("chart-data").textContent);
  await picture.decode();
  const wide = picture.naturalWidth, high = picture.naturalHeight;
  const sheet = document.createElement("canvas");
  [sheet.width, sheet.height] = [wide, high];
  const reading = sheet.getContext("2d", { willReadFrequently: true });
  reading.drawImage(picture, 0, 0);
  const pixels = reading.getImageData(0, 0, wide, high).data;
  const numbers = new Map(chart.codes.map((code, yarn) => [code, yarn]));
  const parts = (code) => [code >> 16, (code >> 8) & 255, code & 255];
  function yarnAt(column, row) {
    const start = 4 * (row * wide + column), seen = [...pixels.slice(start, start + 3)];
    const code = (seen[0] << 16) | (seen[1] << 8) | seen[2];
    if (!numbers.has(code)) {  // a browser that alters colours: the nearest one
      const away = chart.codes.map((one) => parts(one).reduce((sum, value, index) => sum + (value - seen[index]) ** 2, 0));
      numbers.set(code, away.indexOf(Math.min(...away)));
    }
    return numbers.get(code);
  }
  const markAt = (column, row) => chart.marks[`${row * chart.step},${column * chart.step}`];
  const css = (yarn) => `rgb(${parts(chart.codes[yarn]).join(" ")})`;
  const canvas = panel.querySelector("canvas"), pen = canvas.getContext("2d"), cells = 15, cell = canvas.width / cells;
  const answers = ["row", "knot", "yarn"].map((name) => panel.querySelector(`[data-${name}]`));
  const mark = document.querySelector(".knot"), wiping = document.querySelector(".wiping") !== null;
  let here = [Math.floor(wide / 2), Math.floor(high / 2)];
  function enlarge(column, row) {
    pen.clearRect(0, 0, canvas.width, canvas.height);
    pen.font = "13px 'DejaVu Sans Mono', ui-monospace, Menlo, Consolas, monospace";
    pen.textAlign = "center";
    pen.textBaseline = "middle";
    for (let y = 0; y < cells; y++) {
      for (let x = 0; x < cells; x++) {
        const [i, j] = [column + x - (cells - 1) / 2, row + y - (cells - 1) / 2];
        if (i < 0 || j < 0 || i >= wide || j >= high) continue;
        const yarn = yarnAt(i, j);
        pen.fillStyle = css(yarn);
        pen.fillRect(x * cell, y * cell, cell - 0.5, cell - 0.5);
        pen.fillStyle = chart.letters[yarn];
        pen.fillText(chart.symbols[yarn] || "", (x + 0.5) * cell, (y + 0.55) * cell);
        const second = markAt(i, j);
        if (second === undefined) continue;
        pen.fillStyle = second < 0 ? chart.letters[yarn] : css(second);
        if (second < 0) pen.fillRect((x + (second === -1 ? 0.15 : 0)) * cell, (y + 0.88) * cell, 0.85 * cell, 0.08 * cell);
        else pen.fillRect((x + 0.5) * cell, y * cell, 0.5 * cell - 0.5, cell - 0.5);
      }
    }
    pen.lineWidth = 3;
    pen.strokeStyle = "#ffffff";
    pen.strokeRect((cell * (cells - 1)) / 2 - 1, (cell * (cells - 1)) / 2 - 1, cell + 1.5, cell + 1.5);
    pen.lineWidth = 1.5;
    pen.strokeStyle = "#000000";
    pen.strokeRect((cell * (cells - 1)) / 2 - 1, (cell * (cells - 1)) / 2 - 1, cell + 1.5, cell + 1.5);
  }
  function tell(column, row) {
    here = [Math.min(wide - 1, Math.max(0, column)), Math.min(high - 1, Math.max(0, row))];
    const yarn = yarnAt(...here), second = markAt(...here);
    const named = (one) => {
      const swatch = document.createElement("span");
      swatch.className = "swatch";
      swatch.textContent = chart.symbols[one] || "";
      swatch.style.cssText = `background: ${css(one)}; color: ${chart.letters[one]}`;
      return [swatch, " ", chart.names[one]];
    };
    answers[0].textContent = `${chart.rows - here[1] * chart.step} of ${chart.rows}`;
    answers[1].textContent = `${here[0] * chart.step + 1} of ${chart.columns}`;
    answers[2].replaceChildren(...named(yarn));
    if (second < 0) answers[2].append(", jufti knot");
    else if (second !== undefined) answers[2].append(" and ", ...named(second), ", half knots");
    enlarge(...here);
    if (!wiping) return;
    mark.hidden = false;
    mark.style.cssText = `left: ${(100 * here[0]) / wide}%; top: ${(100 * here[1]) / high}%; width: ${100 / wide}%; height: ${100 / high}%`;
  }
  const stage = document.querySelector(".layers");
  function follow(event) {
    const box = picture.getBoundingClientRect();
    const [x, y] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    if (x >= 0 && y >= 0 && x < 1 && y < 1) tell(Math.floor(x * wide), Math.floor(y * high));
  }
  stage.addEventListener("pointerdown", follow);
  stage.addEventListener("pointermove", follow);
  stage.addEventListener("keydown", (event) => {
    const move = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (!move || event.target !== stage) return;
    event.preventDefault();
    tell(here[0] + move[0], here[1] + move[1]);
  });
  stage.tabIndex = 0;
  stage.setAttribute("role", "group");
  stage.setAttribute("aria-label", "Pictures of the carpet: arrow keys move from knot to knot");
  panel.hidden = false;
  tell(...here);
}
if (picture) point();
