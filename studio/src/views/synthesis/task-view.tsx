import type { ComponentChildren } from "preact";
import { useEffect, useMemo, useState } from "preact/hooks";
import type { MechanismDocument, ShownFourBar, SynthesisAnswer } from "../../api/messages";
import { post } from "../../api/request";
import { useReady } from "../../app/ready";
import { goTo } from "../../app/routes";
import { type Document, freePath, newFile, useDocument, ViewHead } from "../../project";
import { formatNumber, t } from "../../text";
import { Button, FaultNote, Progress, Segments, toast, VerdictBadge } from "../../ui";
import { playing, setPlaying } from "./clock";
import { Details } from "./details";
import { FunctionCanvas } from "./function-canvas";
import { Gallery } from "./gallery";
import { Limits } from "./limits";
import { PlaneCanvas } from "./plane-canvas";
import { PointsTable } from "./points-table";
import { CandidateSearch } from "./search";
import {
  isMachine,
  missingPoints,
  pointsOf,
  type SynthesisData,
  type TaskPoint,
  withPoints,
  withSetting,
} from "./task";

interface TaskProps {
  path: string;
  stem: string;
  head: ComponentChildren;
}

/** One task: its canvas, its table and limits, and the gallery of what does it. */
export function TaskView({ path, stem, head }: TaskProps) {
  const file = useDocument<SynthesisData>(path);
  const search = useMemo(() => new CandidateSearch(), []);
  const [draft, setDraft] = useState<SynthesisData | null>(null);
  const [point, setPoint] = useState(-1);
  const saved = file.data.value;
  const data = draft ?? saved;
  const missing = data === null ? 0 : missingPoints(data);
  useEffect(() => () => search.close(), []);
  useEffect(() => {
    if (data === null || !isMachine(data.machine)) return;
    if (missing > 0) search.clear();
    else search.follow(withSetting(data, "chosen", undefined), draft === null);
  }, [data, draft === null]);
  /** Shows a change at once; saves it when the drag has ended. */
  const change = (next: SynthesisData, settled: boolean) => {
    if (settled) file.update(() => next);
    setDraft(settled ? null : next);
  };
  const answer = search.answer.value;
  const isUnreadable = data === null ? file.saved.value !== "loading" : !isMachine(data.machine);
  useReady(answer !== null || missing > 0 || search.error.value !== null || isUnreadable);
  const number = Math.min(Math.max(Number(data?.settings?.["chosen"] ?? 1), 1), answer?.candidates.length ?? 1);
  const chosen = answer?.candidates.find((one) => one.number === number) ?? null;
  return (
    <>
      <ViewHead
        title={t("synthesis.title")}
        document={file}
        verdict={answer && <Found answer={answer} isFull={search.state.value === "done"} />}
        command={{ kind: "machine", path }}
      >
        {head}
      </ViewHead>
      {data === null || !isMachine(data.machine) ? (
        <Unreadable file={file} />
      ) : (
        <div class="synthesis-columns">
          <TaskPanel data={data} point={point} onPoint={setPoint} onChange={change} />
          <div class="synthesis-main ui-stack">
            <Editor data={data} answer={answer} chosen={chosen} point={point} onPoint={setPoint} onChange={change} />
            {missing > 0 && (
              <p class="ui-callout" role="status">
                {t(data.machine === "motion-four-bar" ? "synthesis.morePoses" : "synthesis.morePoints", {
                  count: missing,
                })}
              </p>
            )}
            <Status search={search} data={data} isReported={file.error.value !== null} />
            {chosen && <Taken one={chosen} stem={stem} />}
          </div>
          <div class="synthesis-gallery">
            {answer && (
              <Gallery
                answer={answer}
                chosen={number}
                onChoose={(to) => change(withSetting(data, "chosen", to === 1 ? undefined : to), true)}
                onLoosen={(name, value) => change(withSetting(data, name, loosened(value)), true)}
              />
            )}
          </div>
        </div>
      )}
    </>
  );
}

/** How many candidates there are, and how thoroughly they were searched. */
function Found({ answer, isFull }: { answer: SynthesisAnswer; isFull: boolean }) {
  return (
    <VerdictBadge ok={answer.found > 0} about={t(isFull ? "synthesis.fullSearch" : "synthesis.shortSearch")}>
      {t("synthesis.found", { count: answer.found })}
    </VerdictBadge>
  );
}

function loosened(value: string): string | boolean {
  return value === "no" ? false : value;
}

/** A file that is not there, that cannot be read, or that states no task. */
function Unreadable({ file }: { file: Document<SynthesisData> }) {
  const state = file.saved.value;
  if (file.data.value === null && state === "loading") return <p class="ui-muted">{t("app.loading")}</p>;
  const given = t(state === "missing" ? "synthesis.missing" : "synthesis.unreadable");
  return (
    <FaultNote fault={{ given, allowed: "", do: t("synthesis.unreadableHelp") }}>
      {state !== "missing" && <Button onClick={() => goTo("files", file.path)}>{t("ui.toFiles")}</Button>}
    </FaultNote>
  );
}

interface EditorProps {
  data: SynthesisData;
  answer: SynthesisAnswer | null;
  chosen: ShownFourBar | null;
  point: number;
  onPoint: (index: number) => void;
  onChange: (data: SynthesisData, settled: boolean) => void;
}

function Editor(props: EditorProps) {
  const points = useMemo(() => pointsOf(props.data), [props.data]);
  if (points === null) return <p class="ui-callout bad">{t("synthesis.pointsUnreadable")}</p>;
  if (props.data.machine === "function-four-bar") return <FunctionCanvas {...props} points={points} />;
  return <PlaneCanvas {...props} points={points} />;
}

/** A sentence with its whole numbers in groups of digits. */
function grouped(words: string): string {
  return words.replace(/\d+/g, (digits) => formatNumber(Number(digits), 9));
}

interface StatusProps {
  search: CandidateSearch;
  data: SynthesisData;
  /** The error of the file is shown beside its state. */
  isReported: boolean;
}

/** What the search does, and how to have it begin or end. */
function Status({ search, data, isReported }: StatusProps) {
  const state = search.state.value;
  const answer = search.answer.value;
  return (
    <div class="ui-stack">
      <div class="ui-row">
        <Button
          size="small"
          icon={playing.value ? "pause" : "play"}
          pressed={playing.value}
          onClick={() => setPlaying(!playing.peek())}
        >
          {t("synthesis.move")}
        </Button>
        <span class="ui-grow ui-muted synthesis-sieve" role="status">
          {state === "failed" ? t("synthesis.failed") : grouped(answer?.sieve ?? "")}
        </span>
        {(state === "stopped" || state === "failed") && (
          <Button size="small" icon="search" onClick={() => void search.search(withSetting(data, "chosen", undefined))}>
            {t("synthesis.searchAgain")}
          </Button>
        )}
      </div>
      {state === "full" && (
        <Progress label={t("synthesis.searching")} share={search.share.value} onCancel={() => search.stop()} />
      )}
      <FaultNote fault={isReported ? null : search.error.value} />
      {answer !== null &&
        !answer.quick &&
        answer.candidates.length > 0 &&
        answer.warnings.map((words) => (
          <p key={words} class="ui-callout warn">
            {words}
          </p>
        ))}
    </div>
  );
}

/** The chosen candidate, and its transfer to the editor of linkages. */
function Taken({ one, stem }: { one: ShownFourBar; stem: string }) {
  const [busy, setBusy] = useState(false);
  const take = async () => {
    setBusy(true);
    try {
      const made = await post<MechanismDocument>("/synthesis/mechanism", { pins: one.pins });
      const path = freePath("linkages", stem);
      await newFile(path, { text: made.text });
      toast(t("synthesis.taken", { path }), "good");
      goTo("linkage", path.replace(/^linkages\//, "").replace(/\.toml$/, ""));
    } catch (error) {
      toast(t("synthesis.notTaken"), "bad", error instanceof Error ? error.message : String(error));
      setBusy(false);
    }
  };
  return <Details one={one} busy={busy} onTake={take} />;
}

function TaskPanel({ data, point, onPoint, onChange }: Omit<EditorProps, "answer" | "chosen">) {
  const [tab, setTab] = useState<"points" | "limits">("points");
  const points = pointsOf(data) ?? [];
  const machine = data.machine;
  if (!isMachine(machine)) return null;
  const setPoints = (next: TaskPoint[]) => onChange(withPoints(data, next), true);
  return (
    <section class="synthesis-task ui-stack" aria-label={t("synthesis.task")}>
      <Segments
        label={t("synthesis.task")}
        labelHidden
        value={tab}
        choices={[
          { value: "points", label: t(machine === "motion-four-bar" ? "synthesis.poses" : "synthesis.points") },
          { value: "limits", label: t("synthesis.limits") },
        ]}
        onChange={setTab}
      />
      {tab === "points" ? (
        <PointsTable machine={machine} points={points} chosen={point} onChoose={onPoint} onChange={setPoints} />
      ) : (
        <Limits
          machine={machine}
          settings={data.settings ?? {}}
          onChange={(name, value) => onChange(withSetting(data, name, value), true)}
        />
      )}
    </section>
  );
}
