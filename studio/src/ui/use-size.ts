import type { RefObject } from "preact";
import { useLayoutEffect, useState } from "preact/hooks";

export interface Size {
  width: number;
  height: number;
}

/** The size of an element [px], followed as it changes. */
export function useSize(element: RefObject<Element | null>, first: Size = { width: 600, height: 420 }): Size {
  const [size, setSize] = useState<Size>(first);
  useLayoutEffect(() => {
    const own = element.current;
    if (own === null) return undefined;
    const take = () => {
      const { width, height } = own.getBoundingClientRect();
      if (width > 0 && height > 0)
        setSize((now) => (now.width === width && now.height === height ? now : { width, height }));
    };
    take();
    const observer = new ResizeObserver(take);
    observer.observe(own);
    return () => observer.disconnect();
  }, []);
  return size;
}
