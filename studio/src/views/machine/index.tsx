import { t } from "../../text";
import { CopyCommand } from "../../ui";

export default function Machine() {
  return (
    <div class="app-plain">
      <h1>{t("machine.title")}</h1>
      <p>{t("machine.lead")}</p>
      <CopyCommand command="ilmek design beat-up" />
    </div>
  );
}
