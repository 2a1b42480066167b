import type { ComponentChildren } from "preact";
import { useRef, useState } from "preact/hooks";
import { remember, remembered } from "../app/settings";
import { t } from "../text";

interface SplitProps {
  /** Under this name the browser remembers the width. */
  name: string;
  first: ComponentChildren;
  second: ComponentChildren;
  /** Width of the first side at first [px]. */
  width?: number;
}

const LEAST = 220;
const STEP = 24;

/** Factor of the side columns in a window of this width. */
function unit(): number {
  return parseFloat(getComputedStyle(document.documentElement).getPropertyValue("--unit")) || 1;
}

/** Two sides and a bar between them that is dragged, or moved by arrow keys; on a phone one below the other. */
export function Split({ name, first, second, width = 380 }: SplitProps) {
  const box = useRef<HTMLDivElement>(null);
  const [wide, setWide] = useState(() => Number(remembered(`split.${name}`)) || Math.round(width * unit()));
  const most = () => Math.max(LEAST, (box.current?.clientWidth ?? 2000) - LEAST);
  const move = (to: number) => {
    const held = Math.round(Math.min(Math.max(to, LEAST), most()));
    setWide(held);
    remember(`split.${name}`, String(held));
  };
  const drag = (event: PointerEvent) => {
    if (!(event.currentTarget as HTMLElement).hasPointerCapture(event.pointerId)) return;
    move(event.clientX - (box.current?.getBoundingClientRect().left ?? 0));
  };
  const press = (event: KeyboardEvent) => {
    const by = { ArrowLeft: -STEP, ArrowRight: STEP, Home: -1e6, End: 1e6 }[event.key];
    if (by === undefined) return;
    event.preventDefault();
    move(wide + by);
  };
  return (
    <div class="ui-split" ref={box} style={{ "--first": `${wide}px` }}>
      <div class="ui-side">{first}</div>
      <div
        class="ui-splitter"
        role="separator"
        tabIndex={0}
        aria-orientation="vertical"
        aria-label={t("ui.splitter")}
        aria-valuenow={wide}
        aria-valuemin={LEAST}
        aria-valuemax={most()}
        onPointerDown={(event) => event.currentTarget.setPointerCapture(event.pointerId)}
        onPointerMove={drag}
        onKeyDown={press}
      />
      <div class="ui-side">{second}</div>
    </div>
  );
}
