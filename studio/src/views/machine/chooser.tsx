import { useEffect, useState } from "preact/hooks";
import type { MachineList, MachineSummary } from "../../api/messages";
import { ApiError, get } from "../../api/request";
import { goTo } from "../../app/routes";
import { filesOf, freePath, newFile } from "../../project";
import { t } from "../../text";
import { Button, toast } from "../../ui";

let catalogue: Promise<MachineList> | null = null;

function useCatalogue(): readonly MachineSummary[] {
  const [machines, setMachines] = useState<readonly MachineSummary[]>([]);
  useEffect(() => {
    catalogue ??= get<MachineList>("/machines");
    catalogue.then(
      (list) => setMachines(list.machines),
      () => {
        catalogue = null;
      },
    );
  }, []);
  return machines;
}

/** Chooses a machine file of the project, or makes one of a machine of the catalogue. */
export function Chooser({ name, onChoose }: { name: string; onChoose: (name: string) => void }) {
  const machines = useCatalogue();
  const files = filesOf("machine").map((file) => file.path.replace(/^machines\//, "").replace(/\.toml$/, ""));
  const choose = (value: string) => {
    const [kind, chosen = ""] = value.split(":");
    if (kind === "file") onChoose(chosen);
    else void create(chosen);
  };
  return (
    <select
      class="ui-input machine-chooser"
      aria-label={t("machine.choose")}
      value={`file:${name}`}
      onChange={(event) => choose(event.currentTarget.value)}
    >
      {!files.includes(name) && (
        <option value={`file:${name}`} selected>
          {name}
        </option>
      )}
      <optgroup label={t("machine.inProject")}>
        {files.map((one) => (
          <option key={one} value={`file:${one}`} selected={one === name}>
            {one}
          </option>
        ))}
      </optgroup>
      <optgroup label={t("machine.fromCatalogue")}>
        {machines.map((one) => (
          <option key={one.name} value={`new:${one.name}`} title={one.summary}>
            {one.name}: {one.summary}
          </option>
        ))}
      </optgroup>
    </select>
  );
}

/** Makes a file for a machine under a free name, and opens it. */
async function create(machine: string): Promise<void> {
  const path = freePath("machines", machine);
  try {
    await newFile(path, { text: `machine = "${machine}"\n\n[settings]\n` });
    goTo("machine", path.replace(/^machines\//, "").replace(/\.toml$/, ""));
  } catch (error) {
    toast(error instanceof ApiError ? error.message : t("app.lostHelp"), "bad");
  }
}

/** The project has no file of this name: it can be made, where a machine has the name. */
export function NoFile({ name }: { name: string }) {
  const machines = useCatalogue();
  const known = machines.some((one) => one.name === name);
  return (
    <div class="app-plain">
      <p class="ui-callout warn">{t("machine.noFile")}</p>
      {known && (
        <div>
          <Button kind="primary" icon="plus" onClick={() => void create(name)}>
            {t("machine.create", { name })}
          </Button>
        </div>
      )}
    </div>
  );
}
