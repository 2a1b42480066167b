import { useEffect, useState } from "preact/hooks";
import { useReady } from "../../app/ready";
import { goTo, type ViewProps } from "../../app/routes";
import { remember } from "../../app/settings";
import { project, useDocument, ViewHead } from "../../project";
import { t } from "../../text";
import { Button, later, Select, Split, Tabs, Verdict } from "../../ui";
import { ChartCanvas } from "./chart-canvas";
import { type CarpetModel, modelOf, type Recipe } from "./model";
import { ChooseFile, takePicture } from "./picture";
import { recipesOf, Settings } from "./settings";
import { Tools } from "./tools";
import "./carpet.css";
import "./assignment.css";
import "./shelf.css";

const Bill = later(async () => (await import("./bill")).Bill);
const Edits = later(async () => (await import("./edits")).Edits);
const Shelf = later(async () => (await import("./shelf")).Shelf);
const Weaver = later(async () => (await import("./weaver")).Weaver);
const Yarns = later(async () => (await import("./yarns")).Yarns);

/** The carpet: from a picture to the chart, its yarns and its rows. */
export default function Carpet({ name }: ViewProps) {
  const path = name === "" ? "carpet.toml" : `${name}.toml`;
  return <RecipeView key={path} path={path} />;
}

function RecipeView({ path }: { path: string }) {
  // A file that is made or deleted is another document.
  project.value;
  const model = modelOf(path);
  const document = useDocument<Recipe>(path);
  const [dragging, setDragging] = useState(false);
  const isMissing = document.saved.value === "missing";
  const isRead = document.data.value !== null || document.saved.value === "loading";
  useReady(model.chart.value !== null || model.problem.value !== null || document.error.value !== null || isMissing);
  useEffect(() => model.follow(), [model]);
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setDragging(false);
    const file = event.dataTransfer?.files[0];
    if (file !== undefined) void takePicture(model, file);
  };
  const over = (event: DragEvent) => {
    event.preventDefault();
    setDragging(true);
  };
  const onWeave = (row: number) => {
    remember(`weaver.${path}`, `${row} 0 alternate`);
    model.weaving.value = true;
  };
  return (
    <section
      class={`carpet-view${dragging ? " dragging" : ""}`}
      aria-label={t("carpet.title")}
      onDragOver={over}
      onDragLeave={() => setDragging(false)}
      onDrop={drop}
    >
      <ViewHead
        title={t("carpet.title")}
        document={document}
        verdict={<Verdict checks={model.chart.value?.about.checks ?? []} />}
        command={{ kind: "carpet", path }}
      >
        <RecipeChoice path={path} />
        <Size model={model} />
        <Button
          icon="loom"
          disabled={!isRead}
          pressed={model.weaving.value}
          onClick={() => {
            model.weaving.value = !model.weaving.peek();
          }}
        >
          {t("carpet.weaver")}
        </Button>
      </ViewHead>
      <Problem model={model} />
      {!isRead ? (
        <NoRecipe model={model} isMissing={isMissing} />
      ) : model.weaving.value ? (
        <Weaver
          model={model}
          onClose={() => {
            model.weaving.value = false;
          }}
        />
      ) : (
        <Split
          name="carpet"
          width={400}
          first={<Side model={model} onWeave={onWeave} />}
          second={<Sheet model={model} />}
        />
      )}
    </section>
  );
}

function Sheet({ model }: { model: CarpetModel }) {
  return (
    <div class="carpet-main">
      <Tools model={model} />
      <ChartCanvas model={model} />
    </div>
  );
}

/** A recipe that is not there yet, which a picture makes, or cannot be read. */
function NoRecipe({ model, isMissing }: { model: CarpetModel; isMissing: boolean }) {
  const { path } = model;
  return (
    <div class="ui-callout carpet-missing">
      <p>{isMissing ? t("carpet.missing", { path }) : t("carpet.broken", { path })}</p>
      {isMissing ? (
        <ChooseFile model={model} />
      ) : (
        <Button onClick={() => goTo("files", path)}>{t("carpet.toFiles")}</Button>
      )}
    </div>
  );
}

type SideTab = "settings" | "yarns" | "motifs" | "edits" | "bill";

function Side({ model, onWeave }: { model: CarpetModel; onWeave: (row: number) => void }) {
  const [tab, setTab] = useState<SideTab>("settings");
  return (
    <div class="carpet-side">
      <Tabs
        label={t("carpet.title")}
        value={tab}
        tabs={[
          { value: "settings", label: t("carpet.settings") },
          { value: "yarns", label: t("carpet.yarns") },
          { value: "motifs", label: t("carpet.motifs") },
          { value: "edits", label: t("carpet.editTab", { count: model.edits().length }) },
          { value: "bill", label: t("carpet.result") },
        ]}
        onChange={setTab}
      >
        {tab === "settings" && <Settings model={model} />}
        {tab === "yarns" && <Yarns model={model} />}
        {tab === "motifs" && <Shelf model={model} />}
        {tab === "edits" && <Edits model={model} />}
        {tab === "bill" && <Bill model={model} onWeave={onWeave} />}
      </Tabs>
    </div>
  );
}

function RecipeChoice({ path }: { path: string }) {
  const paths = recipesOf();
  if (paths.length < 2) return <p>{path}</p>;
  const choices = [...new Set([path, ...paths])].map((one) => ({ value: one, label: one }));
  return (
    <Select
      label={t("carpet.recipe")}
      value={path}
      choices={choices}
      onChange={(chosen) => goTo("carpet", chosen === "carpet.toml" ? "" : chosen.replace(/\.toml$/, ""))}
    />
  );
}

/** Knots of the chart; whether it is a draft. */
function Size({ model }: { model: CarpetModel }) {
  const chart = model.chart.value;
  if (chart === null) return null;
  const { rows, columns, draft } = chart.about;
  return (
    <p class="carpet-timing" aria-live="off">
      {model.busy.value ? t("carpet.making") : t(draft ? "carpet.draft" : "carpet.charted", { rows, columns })}
    </p>
  );
}

function Problem({ model }: { model: CarpetModel }) {
  const problem = model.problem.value ?? model.document.error.value;
  // What the file's reader reports already is not reported twice.
  const reported = model.document.error.value?.given.replace(/, line \d+/, "");
  const edit = /edits\.(\d+)/.exec(problem?.given ?? "")?.[1];
  if (problem === null || (reported === problem.given.replace(/, line \d+/, "") && edit === undefined)) return null;
  return (
    <div class="ui-callout bad carpet-problem" role="alert">
      <strong>{problem.given}</strong>
      {problem.allowed && <p>{t("carpet.allowed", { allowed: problem.allowed })}</p>}
      {problem.do && <p>{problem.do}</p>}
      {edit !== undefined && (
        <Button size="small" onClick={() => model.dropEdit(Number(edit))}>
          {t("carpet.dropEdit", { number: Number(edit) + 1 })}
        </Button>
      )}
    </div>
  );
}
