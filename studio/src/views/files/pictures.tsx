import { post } from "../../api/request";
import { fileAddress, project, refreshProject, uploadPicture } from "../../project";
import { t } from "../../text";
import { Icon, IconButton } from "../../ui";
import { attempt } from "./changes";
import { sizeText } from "./format";

/** The project's pictures: shown small, opened, added by file or by drop, deleted. */
export function Pictures() {
  const pictures = project.value?.pictures ?? [];
  const add = (files: ArrayLike<File> | null | undefined) =>
    void attempt(async () => {
      for (const file of Array.from(files ?? [])) await uploadPicture(file);
    });
  const remove = (path: string) =>
    void attempt(async () => {
      await post("/project/pictures/delete", { path });
      await refreshProject();
    });
  return (
    <div
      class="files-kind"
      role="group"
      aria-label={t("files.pictures")}
      onDragOver={(event) => event.preventDefault()}
      onDrop={(event) => {
        event.preventDefault();
        add(event.dataTransfer?.files);
      }}
    >
      <div class="ui-row">
        <h2 class="ui-grow">
          {t("files.pictures")} <span class="files-folder">pictures/</span>
        </h2>
        <label class="ui-button small files-upload">
          <Icon name="upload" />
          {t("files.upload")}
          <input
            type="file"
            multiple
            onChange={(event) => {
              add(event.currentTarget.files);
              event.currentTarget.value = "";
            }}
          />
        </label>
      </div>
      {pictures.length === 0 && <p class="ui-muted">{t("files.noPictures")}</p>}
      <ul class="files-pictures">
        {pictures.map(({ path, size }) => (
          <li key={path}>
            <a href={fileAddress(path)} target="_blank" rel="noreferrer">
              <img src={fileAddress(path)} alt="" width={56} height={56} loading="lazy" />
              <span>{path.replace("pictures/", "")}</span>
            </a>
            <span class="ui-muted">{sizeText(size)}</span>
            <IconButton
              icon="remove"
              size="small"
              label={t("files.deletePicture", { path })}
              onClick={() => remove(path)}
            />
          </li>
        ))}
      </ul>
    </div>
  );
}
