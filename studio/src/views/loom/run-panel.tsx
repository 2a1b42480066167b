/** A run of the twin: start, hold, resume, stop; its row, knot, alarms and the time that is left. */
import { useEffect, useRef, useState } from "preact/hooks";
import type { CommandAnswer, TwinRunEnd, RunNews } from "../../api/messages";
import { post } from "../../api/request";
import { runWork } from "../../api/work";
import { formatNumber, formatSpan, t } from "../../text";
import { Button, Progress, Select, toast } from "../../ui";
import { type Live, liveOf } from "./live";
import type { SceneModel } from "./scene";

const SPEEDS = [1, 10, 100, 1000, 10_000, 100_000];

interface RunPanelProps {
  file: string;
  model: SceneModel;
  onLive: (live: Live | null) => void;
}

export function RunPanel({ file, model, onLive }: RunPanelProps) {
  const [news, setNews] = useState<RunNews | null>(null);
  const [running, setRunning] = useState(false);
  const [speed, setSpeed] = useState("100");
  const [said, setSaid] = useState("");
  const control = useRef<AbortController | null>(null);
  const shown = useRef<{ live: Live | null; tied: number }>({ live: null, tied: 0 });
  useEffect(() => () => control.current?.abort(), []);
  const take = (next: RunNews) => {
    if (next.tied < next.due || shown.current.live === null) shown.current.tied = next.time;
    shown.current.live = liveOf(model, next, shown.current.live, shown.current.tied);
    setNews(next);
    onLive(shown.current.live);
  };
  const start = async () => {
    control.current = new AbortController();
    setRunning(true);
    setSaid("");
    setNews(null);
    try {
      const end = await runWork<TwinRunEnd, RunNews>(
        "/loom/run",
        { file, speed: Number(speed) },
        { onNews: take, signal: control.current.signal },
      );
      take(end.last);
      setSaid(t("loom.done", { knots: end.knots, faults: end.faults }));
    } catch (reason) {
      if (!control.current.signal.aborted) setSaid(t("loom.runFailed", { reason: words(reason) }));
    } finally {
      setRunning(false);
    }
  };
  const give = async (command: string) => {
    try {
      const answer = await post<CommandAnswer>("/loom/command", { command });
      if (!answer.ok) toast(t("loom.refused", { reason: answer.reason }), "warn");
    } catch (reason) {
      toast(t("loom.refused", { reason: words(reason) }), "warn");
    }
  };
  if (model.about.chart === null) return <p class="ui-muted">{t("loom.runNeedsRecipe")}</p>;
  const holds = news?.state === "Held" || news?.state === "Suspended";
  return (
    <section class="loom-run" aria-label={t("loom.run")}>
      <h2>{t("loom.run")}</h2>
      {news === null && <p class="ui-muted">{running ? t("loom.starting") : t("loom.runHelp")}</p>}
      <div class="ui-row">
        {running ? (
          <>
            {holds ? (
              <Button kind="primary" onClick={() => give("resume")}>
                {t("loom.resume")}
              </Button>
            ) : (
              <Button onClick={() => give("hold")} disabled={news === null}>
                {t("loom.hold")}
              </Button>
            )}
            <Button onClick={() => (news === null ? control.current?.abort() : give("stop"))}>{t("loom.stop")}</Button>
          </>
        ) : (
          <>
            <Button kind="primary" icon="play" onClick={start}>
              {t("loom.start")}
            </Button>
            <Select
              label={t("loom.runSpeed")}
              value={speed}
              choices={SPEEDS.map((factor) => ({ value: String(factor), label: t("loom.times", { factor }) }))}
              onChange={setSpeed}
            />
          </>
        )}
      </div>
      {news !== null && <State news={news} />}
      <p role="status">{said}</p>
    </section>
  );
}

function State({ news }: { news: RunNews }) {
  const { state, rows, knots, total } = news;
  return (
    <>
      <Progress
        label={t("loom.runState", { state, row: Math.min(news.row + 1, rows), rows, knots, total })}
        share={total > 0 ? knots / total : 0}
      />
      <p class="ui-muted">
        {[t("loom.left", { time: formatSpan(news.left) }), `${formatNumber(news.speed, 3)} /s`, news.stop]
          .filter(Boolean)
          .join("; ")}
      </p>
      {news.alarms.map((alarm) => (
        <p key={alarm.name} class="ui-callout bad" role="alert">
          {`${t("loom.alarm")}: ${alarm.cause}. ${alarm.remedy}`}
        </p>
      ))}
    </>
  );
}

function words(reason: unknown): string {
  return reason instanceof Error ? reason.message : String(reason);
}
