import { effect } from "@preact/signals";
import { useEffect, useState } from "preact/hooks";
import { connection } from "../api/connection";
import { Conflicts } from "../project";
import { t } from "../text";
import { Icon, IconButton, later, toast } from "../ui";
import { Toasts } from "../ui/toast";
import icon from "./icon.svg";
import { address, route, VIEWS } from "./routes";
import { CurrentView } from "./view";

const HelpDialog = later(async () => (await import("./help-dialog")).HelpDialog);
const SettingsDialog = later(async () => (await import("./settings-dialog")).SettingsDialog);

/** The frame: navigation, connection, messages, and the view of the address. */
export function App() {
  const [settings, setSettings] = useState(false);
  const [help, setHelp] = useState(false);
  useEffect(reportReturn, []);
  useEffect(() => listenForHelp(() => setHelp(true)), []);
  return (
    <div class="app">
      <a class="app-skip" href="#content" onClick={skip}>
        {t("app.skip")}
      </a>
      <header class="app-rail">
        <a class="app-brand" href={address("carpet")}>
          <img src={icon} alt="" width={30} height={30} />
          {t("app.name")}
        </a>
        <Navigation />
        <div class="app-foot">
          <State />
          <IconButton class="app-help" icon="help" label={`${t("app.help")} (?)`} onClick={() => setHelp(true)} />
          <IconButton icon="settings" label={t("app.settings")} onClick={() => setSettings(true)} />
        </div>
      </header>
      <div class="app-main">
        <div role="status">{connection.value === "lost" && <Lost />}</div>
        <CurrentView />
      </div>
      <Toasts />
      <Conflicts />
      {settings && (
        <SettingsDialog
          onClose={() => setSettings(false)}
          onHelp={() => {
            setSettings(false);
            setHelp(true);
          }}
        />
      )}
      {help && <HelpDialog view={route.value.view} onClose={() => setHelp(false)} />}
    </div>
  );
}

function skip(event: Event): void {
  event.preventDefault();
  document.getElementById("content")?.focus();
}

/** Reports that the server is back after it was lost. */
function reportReturn(): () => void {
  let before = connection.peek();
  return effect(() => {
    const now = connection.value;
    if (before === "lost" && now === "connected") toast(t("app.back"), "good");
    before = now;
  });
}

function Navigation() {
  const { view } = route.value;
  return (
    <nav class="app-nav" aria-label={t("app.views")}>
      <ul>
        {VIEWS.map((one) => (
          <li key={one}>
            <a href={address(one)} aria-current={one === view ? "page" : undefined} title={t(`app.${one}Hint`)}>
              <Icon name={one} />
              <span>{t(`app.${one}`)}</span>
            </a>
          </li>
        ))}
      </ul>
    </nav>
  );
}

function State() {
  const state = connection.value;
  return (
    <div class={`app-state ${state}`}>
      <Icon name={state} />
      <span>{state === "lost" ? t("app.lost") : state === "connected" ? t("app.connected") : t("app.connecting")}</span>
    </div>
  );
}

function Lost() {
  return (
    <div class="app-lost">
      <Icon name="lost" />
      <p>{t("app.lostHelp")}</p>
    </div>
  );
}

/** Opens the help by "?", where no text is typed; returns what ends it. */
function listenForHelp(show: () => void): () => void {
  const pressed = (event: KeyboardEvent) => {
    const typing = (event.target as HTMLElement).matches("input:not([type=range]), textarea, select");
    if (event.key !== "?" || typing || event.defaultPrevented || document.querySelector("dialog[open]")) return;
    event.preventDefault();
    show();
  };
  addEventListener("keydown", pressed);
  return () => removeEventListener("keydown", pressed);
}
