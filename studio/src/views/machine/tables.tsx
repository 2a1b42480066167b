import { useEffect, useMemo, useState } from "preact/hooks";
import { latest } from "../../api/latest";
import type { MachineTables, TablesRequest } from "../../api/messages";
import { post } from "../../api/request";
import { Tables } from "../../draw";
import { t } from "../../text";
import type { MachineModel } from "./model";

/** The tables of the design, or of the machine in it whose figures are shown. */
export function DesignTables({ model }: { model: MachineModel }) {
  const [found, setFound] = useState<MachineTables | null>(null);
  const load = useMemo(
    () =>
      latest<Omit<TablesRequest, "name"> & { machine: string }, MachineTables>(
        ({ machine, ...body }, abort) => post(`/machines/${encodeURIComponent(machine)}/tables`, body, abort),
        setFound,
      ),
    [],
  );
  const [machine, settings, part] = [model.machine.value, model.settings.value, model.part.value];
  useEffect(() => {
    if (machine !== "") load({ machine, settings: { ...settings }, part });
  }, [machine, settings, part]);
  useEffect(() => load.cancel, []);
  if (found === null) return <p class="ui-muted">{t("app.loading")}</p>;
  return found.tables.length === 0 ? <p class="ui-muted">{t("machine.noTables")}</p> : <Tables tables={found.tables} />;
}
