import { t } from "../../text";
import { CopyCommand } from "../../ui";

export default function Synthesis() {
  return (
    <div class="app-plain">
      <h1>{t("synthesis.title")}</h1>
      <p>{t("synthesis.lead")}</p>
      <CopyCommand command="ilmek design motion-four-bar" />
    </div>
  );
}
