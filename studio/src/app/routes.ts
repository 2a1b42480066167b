/** Views and their addresses: `#linkage` or `#linkage/NAME`. */
import { computed, signal } from "@preact/signals";

export const VIEWS = ["carpet", "machine", "linkage", "synthesis", "cyclogram", "loom", "files"] as const;
export type View = (typeof VIEWS)[number];

/** What a view gets: the rest of the address, "" where there is none. */
export interface ViewProps {
  name: string;
}

export interface Route {
  view: View;
  name: string;
}

/** The route of an address; an unknown one is the first view. */
export function parseRoute(hash: string): Route {
  const [view = "", ...rest] = hash.replace(/^#/, "").split("/");
  const known = VIEWS.find((one) => one === view);
  return known === undefined ? { view: "carpet", name: "" } : { view: known, name: decoded(rest.join("/")) };
}

/** The address of a route. */
export function address(view: View, name = ""): string {
  return name === "" ? `#${view}` : `#${view}/${name.split("/").map(encodeURIComponent).join("/")}`;
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

const hash = signal(location.hash);
addEventListener("hashchange", () => {
  hash.value = location.hash;
});

/** The route shown. */
export const route = computed(() => parseRoute(hash.value));

/** Goes to a view. */
export function goTo(view: View, name = ""): void {
  location.hash = address(view, name);
  hash.value = location.hash;
}

/** Changes the name in the address of the view shown, without a new entry in the browser's history. */
export function rename(name: string): void {
  history.replaceState(null, "", address(route.peek().view, name));
  hash.value = location.hash;
}
