/** Joins the project to the server's events, the page's life and the keys; called once by the page. */
import { effect } from "@preact/signals";
import { connection } from "../api/connection";
import { onEvent } from "../api/events";
import { listenToKeys } from "./keys";
import { filesChanged, refreshProject, saveAll, serverIsBack } from "./project";

/** Follows changes of other programs and tabs, saves when the page is hidden, listens to the keys. */
export function follow(): void {
  void refreshProject().catch(() => undefined);
  onEvent((event) => {
    if (event.type === "changed") filesChanged(event.paths);
  });
  let before = connection.peek();
  effect(() => {
    const now = connection.value;
    if (before === "lost" && now === "connected") serverIsBack();
    before = now;
  });
  const hidden = () => {
    if (document.visibilityState === "hidden") void saveAll();
  };
  document.addEventListener("visibilitychange", hidden);
  addEventListener("pagehide", () => void saveAll());
  listenToKeys();
}
