import { t } from "../../text";
import { CopyCommand } from "../../ui";

export default function Linkage() {
  return (
    <div class="app-plain">
      <h1>{t("linkage.title")}</h1>
      <p>{t("linkage.lead")}</p>
      <CopyCommand command="ilmek mechanism FILE.toml" />
    </div>
  );
}
