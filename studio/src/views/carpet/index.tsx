import { t } from "../../text";
import { CopyCommand } from "../../ui";

export default function Carpet() {
  return (
    <div class="app-plain">
      <h1>{t("carpet.title")}</h1>
      <p>{t("carpet.lead")}</p>
      <CopyCommand command="ilmek weave carpet.toml" />
    </div>
  );
}
