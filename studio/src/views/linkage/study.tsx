import { Study } from "../../study";
import { t } from "../../text";
import type { Editor } from "./editor";

/** A study of the mechanism over its named values; a design's values are taken into the file, which undo brings back. */
export function LinkageStudy({ editor }: { editor: Editor }) {
  const data = editor.document.data.value;
  if (data === null) return null;
  const { over, speed } = editor.drive.value;
  const take = (values: Record<string, string>) =>
    editor.edit((copy) => {
      copy["values"] = { ...(copy["values"] as object), ...values };
    });
  return (
    <Study
      subject={{ mechanism: data, path: editor.document.path, over, speed }}
      uses={[{ label: t("study.take"), use: take }]}
    />
  );
}
