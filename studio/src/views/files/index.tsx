import { t } from "../../text";
import { CopyCommand } from "../../ui";

export default function Files() {
  return (
    <div class="app-plain">
      <h1>{t("files.title")}</h1>
      <p>{t("files.lead")}</p>
      <CopyCommand command="ilmek --help" />
    </div>
  );
}
