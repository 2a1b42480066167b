import { signal } from "@preact/signals";
import { type ComponentType, h, type VNode } from "preact";
import { useEffect } from "preact/hooks";
import { t } from "../text";
import { toast } from "./toast";

/** A component that is loaded when it is first shown. */
export function later<P extends object>(load: () => Promise<ComponentType<P>>): (props: P) => VNode<P> | null {
  const found = signal<{ one: ComponentType<P> } | null>(null);
  return function Later(props: P) {
    useEffect(() => {
      load().then(
        (one) => {
          found.value = { one };
        },
        () => toast(t("app.loadFailed"), "bad"),
      );
    }, []);
    return found.value && (h(found.value.one, props) as VNode<P>);
  };
}
