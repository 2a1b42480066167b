import { t } from "../text";
import { Dialog } from "../ui";
import type { View } from "./routes";

/** What one does in a view, its keys, and the keys that work everywhere. */
export function HelpDialog({ view, onClose }: { view: View; onClose: () => void }) {
  const everywhere = [
    ["Ctrl+Z", t("app.keyUndo")],
    ["Ctrl+Shift+Z", t("app.keyRedo")],
    ["Ctrl+S", t("app.keySave")],
    ["Tab", t("app.keyNext")],
    ["Escape", t("app.keyEscape")],
    ["?", t("app.keyHelp")],
  ] as const;
  return (
    <Dialog title={`${t("app.help")}: ${t(`app.${view}`)}`} open onClose={onClose}>
      <p>{t(`app.${view}Help`)}</p>
      <h3>{t("app.keysHere")}</h3>
      {keysOf(view).map((text) => (
        <p key={text}>{text}</p>
      ))}
      <h3>{t("app.keysEverywhere")}</h3>
      <dl class="app-keys">
        {everywhere.map(([key, does]) => (
          <div key={key}>
            <dt>
              <kbd>{key}</kbd>
            </dt>
            <dd>{does}</dd>
          </div>
        ))}
      </dl>
    </Dialog>
  );
}

function keysOf(view: View): string[] {
  const own: Record<View, string[]> = {
    carpet: [t("carpet.keys"), t("carpet.weaverKeys")],
    machine: [t("app.keysSlider"), t("figure.plotKeys"), t("figure.drawingKeys")],
    linkage: [t("linkage.keys")],
    synthesis: [t("synthesis.pointsHint")],
    cyclogram: [t("app.keysSlider"), t("app.keysMotion")],
    loom: [t("loom.pictureHelp")],
    files: [t("app.keysFiles")],
  };
  return own[view];
}
