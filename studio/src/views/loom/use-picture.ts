/** A stage on a canvas: made when the canvas is there, as large as it, in the colours of the theme. */
import type { RefObject } from "preact";
import { useEffect, useRef } from "preact/hooks";
import { failures, type SceneModel } from "./scene";
import { Stage } from "./stage";

interface PictureOptions {
  names: boolean;
  onPick: (name: string) => void;
}

const STILL = 4;
const MOST_NAMES = 24;

export function usePicture(
  model: SceneModel,
  canvas: RefObject<HTMLCanvasElement | null>,
  labels: RefObject<HTMLDivElement | null>,
  options: PictureOptions,
): RefObject<Stage | null> {
  const stage = useRef<Stage | null>(null);
  const wanted = useRef(options);
  wanted.current = options;
  useEffect(() => {
    const element = canvas.current;
    if (element === null) return;
    const made = new Stage(model, element);
    stage.current = made;
    made.drawn = () => {
      if (labels.current) drawLabels(made, labels.current, wanted.current.names, element);
    };
    made.weave(Math.round(0.6 * model.about.carpet.rows));
    const root = document.documentElement;
    const paint = () => made.setTheme(root.dataset["theme"] ?? null);
    const sized = () => made.resize(element.clientWidth, element.clientHeight);
    const [watch, size] = [new MutationObserver(paint), new ResizeObserver(sized)];
    watch.observe(root, { attributes: true, attributeFilter: ["data-theme"] });
    size.observe(element);
    paint();
    sized();
    made.show("iso");
    const end = clicks(element, (x, y) => (made.measures ? made.mark(x, y) : wanted.current.onPick(made.pick(x, y))));
    return () => {
      end();
      watch.disconnect();
      size.disconnect();
      made.dispose();
      stage.current = null;
    };
  }, [model]);
  useEffect(() => stage.current?.invalidate(), [options.names]);
  return stage;
}

/** Calls back with the position, from -1 to 1, of a press that is not a drag. */
function clicks(element: HTMLElement, chosen: (x: number, y: number) => void): () => void {
  let at: [number, number] = [0, 0];
  const down = (event: PointerEvent) => {
    at = [event.clientX, event.clientY];
  };
  const up = (event: PointerEvent) => {
    if (event.button !== 0 || Math.hypot(event.clientX - at[0], event.clientY - at[1]) > STILL) return;
    const box = element.getBoundingClientRect();
    chosen((2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height);
  };
  element.addEventListener("pointerdown", down);
  element.addEventListener("pointerup", up);
  return () => {
    element.removeEventListener("pointerdown", down);
    element.removeEventListener("pointerup", up);
  };
}

function drawLabels(stage: Stage, into: HTMLElement, shown: boolean, canvas: HTMLElement): void {
  const distance = stage.distance();
  const found = [
    ...(distance === null ? [] : [{ ...distance, name: "" }]),
    ...(shown || stage.looksInside ? stage.labels().map((one) => ({ ...one, text: nameOf(stage, one.name) })) : []),
  ];
  const kept = spaced(found, canvas);
  while (into.children.length > kept.length) into.lastElementChild?.remove();
  while (into.children.length < kept.length) into.append(document.createElement("span"));
  kept.forEach((one, k) => {
    const label = into.children[k] as HTMLElement;
    label.textContent = one.text;
    const left = Math.min(one.left, canvas.clientWidth - label.offsetWidth - 8);
    label.style.transform = `translate(${Math.round(left)}px, ${Math.round(one.top)}px)`;
  });
}

function nameOf(stage: Stage, name: string): string {
  const part = stage.model.about.parts.find((each) => each.name === name);
  return (part && failures(part).length > 0 ? "⚠ " : "") + (part?.title ?? name).split(/[:,]/)[0];
}

/** Texts that do not lie upon each other. */
function spaced(found: { text: string; x: number; y: number }[], canvas: HTMLElement) {
  const kept: { text: string; left: number; top: number }[] = [];
  for (const { text, x, y } of found) {
    const [left, top] = [((x + 1) / 2) * canvas.clientWidth, ((1 - y) / 2) * canvas.clientHeight];
    const free = kept.every((one) => Math.abs(one.top - top) > 18 || Math.abs(one.left - left) > 130);
    if (free && kept.length < MOST_NAMES) kept.push({ text, left, top });
  }
  return kept;
}
