import { useEffect, useMemo, useState } from "preact/hooks";
import { latest } from "../../api/latest";
import type { ShownCommand } from "../../api/messages";
import { post } from "../../api/request";
import { t } from "../../text";
import { CopyCommand } from "../../ui";
import type { MachineModel } from "./model";
import type { Settings } from "./settings";

interface State {
  machine: string;
  settings: Settings;
}

/** The state as its command line and as Python, with every setting; and the same by the project's file. */
export function Command({ model }: { model: MachineModel }) {
  const [shown, setShown] = useState<ShownCommand | null>(null);
  const ask = useMemo(
    () =>
      latest<State, ShownCommand>((state, abort) => post("/commands", { kind: "machine", ...state }, abort), setShown),
    [],
  );
  const [machine, settings] = [model.machine.value, model.settings.value];
  useEffect(() => {
    ask({ machine, settings });
    return ask.cancel;
  }, [machine, settings]);
  return (
    <div class="ui-stack">
      {shown !== null && <CopyCommand command={shown.command} python={shown.python} />}
      <p class="ui-muted">{t("machine.orByFile", { path: model.document.path })}</p>
    </div>
  );
}
