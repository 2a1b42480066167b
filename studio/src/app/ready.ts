import { signal } from "@preact/signals";
import { useEffect } from "preact/hooks";

/** Whether the view that is open shows its first content; the frame states it as `data-ready` of the page's main part. */
export const ready = signal(false);

/** For a view: state that its first content is shown, from the first time that `shown` is true. */
export function useReady(shown: boolean): void {
  useEffect(() => {
    if (shown) ready.value = true;
  }, [shown]);
}
