import { type ComponentType, h } from "preact";
import { useEffect, useLayoutEffect, useRef, useState } from "preact/hooks";
import { loadTexts, t } from "../text";
import { Button } from "../ui";
import { Boundary } from "./boundary";
import { ready } from "./ready";
import { route, type View, type ViewProps } from "./routes";

const LOADERS: Record<View, () => Promise<{ default: ComponentType<ViewProps> }>> = {
  carpet: () => import("../views/carpet"),
  machine: () => import("../views/machine"),
  linkage: () => import("../views/linkage"),
  synthesis: () => import("../views/synthesis"),
  cyclogram: () => import("../views/cyclogram"),
  loom: () => import("../views/loom"),
  files: () => import("../views/files"),
};

const loaded = new Map<View, ComponentType<ViewProps>>();

/** The view of the address, loaded when it is first shown. */
export function CurrentView() {
  const { view, name } = route.value;
  const [, redraw] = useState(0);
  const [failed, setFailed] = useState<string | null>(null);
  const main = useRef<HTMLElement>(null);
  const first = useRef(true);
  const load = () => {
    setFailed(null);
    Promise.all([LOADERS[view](), view === "carpet" ? undefined : loadTexts()]).then(
      ([module]) => {
        loaded.set(view, module.default);
        redraw((count) => count + 1);
      },
      (error: unknown) => setFailed(error instanceof Error ? error.message : String(error)),
    );
  };
  useLayoutEffect(() => {
    ready.value = false;
  }, [view]);
  useEffect(() => {
    document.title = `${t(`app.${view}`)} – ${t("app.name")}`;
    if (!loaded.has(view)) load();
    if (!first.current) main.current?.focus();
    first.current = false;
  }, [view]);
  const shown = loaded.get(view);
  return (
    <main class="app-view" id="content" tabIndex={-1} ref={main} data-view={view} data-ready={ready.value}>
      {shown !== undefined ? (
        <Boundary key={view}>{h(shown, { name })}</Boundary>
      ) : failed !== null ? (
        <div class="app-plain" role="alert">
          <h1>{t("app.loadFailed")}</h1>
          <p>{t("app.loadFailedHelp")}</p>
          <pre class="ui-callout bad">{failed}</pre>
          <div class="ui-row">
            <Button kind="primary" onClick={load}>
              {t("app.tryAgain")}
            </Button>
            <Button onClick={() => location.reload()}>{t("app.reload")}</Button>
          </div>
        </div>
      ) : (
        <p class="app-loading" role="status">
          {t("app.loading")}
        </p>
      )}
    </main>
  );
}
