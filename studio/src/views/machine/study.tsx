import { Study } from "../../study";
import { t } from "../../text";
import type { MachineModel } from "./model";

/** A study of the machine; a design of it is kept as B, or becomes the present one. */
export function MachineStudy({ model, shown }: { model: MachineModel; shown: boolean }) {
  const [machine, settings] = [model.machine.value, model.settings.value];
  const keep = (design: Record<string, string>) => {
    model.b.value = { ...settings, ...design };
  };
  return (
    <Study
      key={machine}
      shown={shown}
      subject={{ machine, settings }}
      uses={[
        { label: t("study.asB"), use: keep },
        { label: t("study.take"), use: (design) => model.set(design) },
      ]}
    />
  );
}
