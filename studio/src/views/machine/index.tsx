import { useEffect, useMemo, useState } from "preact/hooks";
import { useReady } from "../../app/ready";
import { goTo, type ViewProps } from "../../app/routes";
import { remember, remembered } from "../../app/settings";
import { filesOf, project, useDocument, ViewHead } from "../../project";
import { t } from "../../text";
import { Segments, Split } from "../../ui";
import { Chooser, NoFile } from "./chooser";
import { FormSide } from "./form-side";
import { MachineModel } from "./model";
import { Outcome } from "./outcome";
import type { MachineFile } from "./settings";
import { MachineVerdict } from "./verdict";
import "./machine.css";

/** The file shown where the address names none: the last one, or the first of the project. */
function usual(): string {
  const names = filesOf("machine").map((file) => nameOf(file.path));
  const last = remembered("machine.last");
  return last !== null && names.includes(last) ? last : names.includes("beat-up") ? "beat-up" : (names[0] ?? "");
}

function nameOf(path: string): string {
  return path.replace(/^machines\//, "").replace(/\.toml$/, "");
}

export default function Machine({ name }: ViewProps) {
  const shown = name === "" ? usual() : name;
  useReady(project.value !== null && shown === "");
  if (project.value === null) return <p class="app-loading">{t("app.loading")}</p>;
  if (shown === "") {
    return (
      <div class="app-plain">
        <h1>{t("machine.title")}</h1>
        <Chooser name="" onChoose={(to) => goTo("machine", to)} />
      </div>
    );
  }
  return <OneMachine key={shown} name={shown} />;
}

function OneMachine({ name }: { name: string }) {
  const document = useDocument<MachineFile>(`machines/${name}.toml`);
  const model = useMemo(() => new MachineModel(document), [document]);
  const [tab, setTab] = useState("results");
  const [side, setSide] = useState<"outcome" | "form">("outcome");
  useEffect(() => {
    remember("machine.last", name);
    return () => model.close();
  }, [model]);
  const missing = document.saved.value === "missing";
  useReady(model.view.value !== null);
  return (
    <div class={`machine show-${side}`}>
      <ViewHead
        title={t("machine.title")}
        document={document}
        verdict={<MachineVerdict model={model} />}
        command={{ kind: "machine", machine: model.machine.value, settings: model.settings.value }}
      >
        <Chooser name={name} onChoose={(to) => goTo("machine", to)} />
        <div class="machine-sides">
          <Segments
            label={t("machine.title")}
            labelHidden
            value={side}
            choices={[
              { value: "outcome", label: t("machine.outcome") },
              { value: "form", label: t("machine.parameters") },
            ]}
            onChange={setSide}
          />
        </div>
      </ViewHead>
      {missing ? (
        <NoFile name={name} />
      ) : (
        <Split
          name="machine"
          width={420}
          first={<FormSide model={model} />}
          second={<Outcome model={model} tab={tab} onTab={setTab} />}
        />
      )}
    </div>
  );
}
