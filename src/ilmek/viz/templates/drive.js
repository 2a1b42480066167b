// One position for all figures of a machine over the same quantity: the slider, the mechanism, the cursors of the charts.
const drives = new Map();
function driveOf(figure, run) {
  const machine = figure.closest(".machine") || document.body;
  if (!drives.has(machine)) drives.set(machine, new Map());
  const known = drives.get(machine);
  if (!known.has(run.drive)) known.set(run.drive, { figures: [], value: null, queued: 0, player: null });
  const drive = known.get(run.drive);
  drive.show = (value) => {
    if (!Number.isFinite(value)) return;
    drive.value = value;
    drive.queued ||= requestAnimationFrame(() => {
      drive.queued = 0;
      for (const one of drive.figures) one(drive.value);
    });
  };
  // What a person sets stays: nothing begins to move by itself.
  drive.pause = () => {
    drive.still = true;
    if (drive.player) drive.player(false);
  };
  return drive;
}
// A value [SI] in the unit and within the range of a figure; null outside. An angle is the same a turn later.
function within(run, value) {
  const slack = 1e-6 * (run.to - run.from);
  let at = value / run.factor;
  if (run.turn && (at < run.from - slack || at > run.to + slack)) {
    at -= run.turn * Math.floor((at - run.from + slack) / run.turn);
  }
  if (!(at >= run.from - slack && at <= run.to + slack)) return null;
  return Math.min(Math.max(at, run.from), run.to);
}
function written(number, digits, unit) {
  if (!Number.isFinite(number)) return "–";
  const large = Math.abs(number) >= 1e7, text = large ? number.toPrecision(4) : number.toFixed(digits);
  return text.replace(/^-(?=0\.?0*$)/, "").replaceAll("-", "−") + (unit && unit !== "°" && unit !== "%" ? " " : "") + unit;
}
// Steps of the arrow keys in a range: whole degrees, or about a hundredth of the range.
function keyStep(run) {
  const span = run.to - run.from;
  if (run.turn && span * run.factor > 0.35) return 1;
  return Number((10 ** Math.floor(Math.log10(span / 50))).toPrecision(1));
}
function keyed(event, run, at) {
  const step = keyStep(run), steps = { ArrowLeft: -step, ArrowDown: -step, ArrowRight: step, ArrowUp: step,
    PageDown: -10 * step, PageUp: 10 * step, Home: run.from - at, End: run.to - at };
  if (!(event.key in steps)) return null;
  event.preventDefault();
  return Math.min(Math.max(at + steps[event.key], run.from), run.to);
}
