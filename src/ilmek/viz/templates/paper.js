(() => {
  const { yarns, cells, across, view } = JSON.parse(document.getElementById("paper-data").textContent);
  const KEYS = "123456789abcdefghijklmnopqrstuvwxyz", CENTRE = 4;
  const list = document.getElementById("cells"), edits = document.getElementById("edits"), save = document.getElementById("save");
  const chosen = cells.map((cell) => cell.around[CENTRE]);
  let current = 0;

  const paint = (number) => {
    const button = buttons[number], own = yarns[chosen[number]];
    [...button.querySelectorAll(".read i")].forEach((one, at) => {
      const yarn = at === CENTRE ? chosen[number] : cells[number].around[at];
      one.style.background = yarn < 0 ? "transparent" : yarns[yarn].colour;
    });
    button.classList.toggle("corrected", chosen[number] !== cells[number].around[CENTRE]);
    button.querySelector("small").textContent =
      `row ${cells[number].row}, column ${cells[number].column}: ${own ? own.name : "?"}, ${Math.round(100 * cells[number].confidence)} % sure`;
  };
  const write = () => {
    const lines = cells.flatMap((cell, number) =>
      chosen[number] === cell.around[CENTRE] ? [] : [`  ${JSON.stringify(`set ${cell.row},${cell.column} ${yarns[chosen[number]].name}`)},`]);
    edits.value = lines.length ? `edits = [\n${lines.join("\n")}\n]\n` : "";
    save.href = "data:text/plain;charset=utf-8," + encodeURIComponent(edits.value);
  };
  const select = (number) => {
    buttons[current].setAttribute("aria-pressed", "false");
    current = Math.max(0, Math.min(cells.length - 1, number));
    buttons[current].setAttribute("aria-pressed", "true");
    buttons[current].focus();
  };
  const choose = (yarn) => {
    if (yarn < 0 || yarn >= yarns.length) return;
    chosen[current] = yarn;
    paint(current);
    write();
    select(current + 1);
  };

  const buttons = cells.map((cell, number) => {
    const item = document.createElement("li"), button = document.createElement("button");
    button.type = "button";
    button.setAttribute("aria-pressed", "false");
    button.innerHTML = '<span class="pair"><span class="seen"></span><span class="read">' + "<i></i>".repeat(9) + "</span></span><small></small>";
    const seen = button.querySelector(".seen"), lines = Math.ceil(cells.length / across);
    seen.style.backgroundImage = `url(${SPRITE})`;
    seen.style.backgroundSize = `${across * 100}% ${lines * 100}%`;
    seen.style.backgroundPosition =
      `${(100 * (number % across)) / (across - 1)}% ${lines > 1 ? (100 * Math.floor(number / across)) / (lines - 1) : 0}%`;
    button.addEventListener("click", () => select(number));
    item.append(button);
    list.append(item);
    return button;
  });
  yarns.forEach((yarn, number) => {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = `${KEYS[number] ?? ""} ${yarn.name}`;
    button.style.cssText = `background: ${yarn.colour}; color: ${yarn.letters}`;
    button.addEventListener("click", () => choose(number));
    document.getElementById("yarns").append(button);
  });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target === edits) return;
    const columns = Math.max(1, Math.round(list.clientWidth / buttons[0].parentElement.offsetWidth));
    const step = { ArrowLeft: -1, ArrowRight: 1, ArrowUp: -columns, ArrowDown: columns }[event.key];
    if (step) select(current + step);
    else if (event.key.length === 1 && KEYS.includes(event.key)) choose(KEYS.indexOf(event.key));
    else return;
    event.preventDefault();
  });
  document.getElementById("copy").addEventListener("click", () => {
    edits.select();
    navigator.clipboard ? navigator.clipboard.writeText(edits.value) : document.execCommand("copy");
  });
  cells.forEach((_, number) => paint(number));
  write();
})();
