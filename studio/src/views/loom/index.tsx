import { t } from "../../text";
import { CopyCommand } from "../../ui";

export default function Loom() {
  return (
    <div class="app-plain">
      <h1>{t("loom.title")}</h1>
      <p>{t("loom.lead")}</p>
      <CopyCommand command="ilmek weave carpet.toml" />
    </div>
  );
}
