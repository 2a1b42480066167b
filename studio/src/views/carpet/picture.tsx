import { useRef } from "preact/hooks";
import { newFile, project, uploadPicture } from "../../project";
import { t } from "../../text";
import { Button, NumberField, Select, toast } from "../../ui";
import type { CarpetModel, Recipe } from "./model";

/** The picture: one of the project, or a file that is dropped or chosen. */
export function Picture({ model }: { model: CarpetModel }) {
  const chosen = model.text("picture");
  const known = project.value?.pictures.map((one) => one.path) ?? [];
  const choices = [...new Set([chosen, ...known])].map((path) => ({
    value: path,
    label: path || t("carpet.noPicture"),
  }));
  return (
    <div class="ui-stack">
      <Select
        label={t("carpet.picture")}
        value={chosen}
        choices={choices}
        onChange={(picture) => choosePicture(model, picture)}
      />
      {/\.pdf$/i.test(chosen) && (
        <NumberField
          label={t("carpet.pdfPage")}
          value={Number(model.text("page") || 1)}
          min={1}
          max={10000}
          onChange={(page) => Number.isInteger(page) && model.set({ page: page === 1 ? "" : page, ...OF_PAGE })}
        />
      )}
      <ChooseFile model={model} />
    </div>
  );
}

/** A button that takes a file of this computer. */
export function ChooseFile({ model }: { model: CarpetModel }) {
  const input = useRef<HTMLInputElement>(null);
  return (
    <div class="ui-row">
      <Button icon="upload" onClick={() => input.current?.click()}>
        {t("carpet.choosePicture")}
      </Button>
      <span class="ui-muted">{t("carpet.dropHint")}</span>
      <input
        ref={input}
        class="visually-hidden"
        type="file"
        tabIndex={-1}
        aria-label={t("carpet.choosePicture")}
        onChange={(event) => {
          const file = event.currentTarget.files?.[0];
          if (file !== undefined) void takePicture(model, file);
          event.currentTarget.value = "";
        }}
      />
    </div>
  );
}

/** What holds of one page only, and of one picture. */
const OF_PAGE: Recipe = { crop: "", corners: "" };
const OF_PICTURE: Recipe = { ...OF_PAGE, plain: "", repeat: null, turn: "", page: "", edits: null };

/** Another picture: what held of the one before only is taken out. */
function choosePicture(model: CarpetModel, picture: string): void {
  if (picture === "" || picture === model.text("picture")) return;
  const lost = ["crop", "corners", "turn", "edits"].some((key) => model.text(key) !== "");
  model.set({ ...OF_PICTURE, picture });
  if (lost) toast(t("carpet.pictureChanged"));
}

/** Puts a file into the project and makes it the recipe's picture; a recipe that is not there is made. */
export async function takePicture(model: CarpetModel, file: File): Promise<void> {
  const { data, saved } = model.document;
  try {
    if (data.peek() === null && saved.peek() !== "missing") throw new Error(t("carpet.broken", { path: model.path }));
    const { path } = await uploadPicture(file);
    if (data.peek() === null) await newFile(model.path, { text: `picture = ${JSON.stringify(path)}\n` });
    else choosePicture(model, path);
  } catch (error) {
    toast(t("carpet.notTaken", { name: file.name }), "bad", error instanceof Error ? error.message : "");
  }
}
