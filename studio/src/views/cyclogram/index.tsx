import { t } from "../../text";
import { CopyCommand } from "../../ui";

export default function Cyclogram() {
  return (
    <div class="app-plain">
      <h1>{t("cyclogram.title")}</h1>
      <p>{t("cyclogram.lead")}</p>
      <CopyCommand command="ilmek cyclogram FILE.toml" />
    </div>
  );
}
