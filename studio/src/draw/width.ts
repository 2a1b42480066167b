import type { RefObject } from "preact";
import { useLayoutEffect, useRef, useState } from "preact/hooks";

/** The width of a box [px], which follows its window: texts in an SVG of that width keep their size. */
export function useWidth(least = 280): [RefObject<HTMLDivElement | null>, number] {
  const box = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(600);
  useLayoutEffect(() => {
    const element = box.current;
    if (element === null) return undefined;
    const observer = new ResizeObserver(() => setWidth(Math.max(Math.round(element.clientWidth), least)));
    observer.observe(element);
    return () => observer.disconnect();
  }, [least]);
  return [box, width];
}
