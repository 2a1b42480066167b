/** A run of the twin: start, hold, resume, stop; its row, knot, alarms and the time that is left. */
import { useState } from "preact/hooks";
import type { RunNews } from "../../api/messages";
import { formatSpan, t } from "../../text";
import { Button, Progress, Select } from "../../ui";
import { cancelRun, give, type Run, run, startRun } from "./run";

const SPEEDS = [1, 10, 100, 1000, 10_000, 100_000];

/** Of a recipe's loom; only it has a carpet to weave. */
export function RunPanel({ file, weaves }: { file: string; weaves: boolean }) {
  const [speed, setSpeed] = useState("100");
  const shown = run.value;
  const going = shown?.going ?? false;
  if (!weaves && !going) return <p class="ui-muted">{t("loom.runNeedsRecipe")}</p>;
  return (
    <section class="loom-run" aria-label={t("loom.run")}>
      <div class="ui-row">
        {shown?.going ? (
          <Commands news={shown.news} />
        ) : (
          <>
            <Button kind="primary" icon="play" onClick={() => void startRun({ file, speed: Number(speed) })}>
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
      {shown?.news ? (
        <State run={shown} news={shown.news} />
      ) : (
        <p class="ui-muted">{going ? t("loom.starting") : t("loom.runHelp")}</p>
      )}
      <p role="status">{shown?.ended}</p>
    </section>
  );
}

function Commands({ news }: { news: RunNews | null }) {
  const holds = news?.state === "Held" || news?.state === "Suspended";
  return (
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
      <Button onClick={() => (news === null ? cancelRun() : give("stop"))}>{t("loom.stop")}</Button>
    </>
  );
}

function State({ run: { file, speed }, news }: { run: Run; news: RunNews }) {
  const { rows, knots, total } = news;
  const facts = [
    [t("loom.file"), file],
    [t("loom.state"), news.state],
    [t("loom.rowNow"), t("loom.rowsText", { rows: Math.min(news.row + 1, rows), all: rows })],
    [t("loom.knotNow"), t("loom.rowsText", { rows: knots, all: total })],
    [t("loom.left"), formatSpan(news.left)],
    [t("loom.leftHere"), formatSpan(news.left / speed)],
    ...(news.stop === "" ? [] : [[t("loom.waits"), news.stop]]),
  ];
  return (
    <>
      <Progress label={t("loom.woven")} share={total > 0 ? knots / total : 0} />
      <dl class="loom-facts">
        {facts.map(([name, value]) => (
          <div key={name}>
            <dt>{name}</dt>
            <dd>{value}</dd>
          </div>
        ))}
      </dl>
      {news.alarms.map((alarm) => (
        <p key={alarm.name} class="ui-callout bad" role="alert">
          {`${t("loom.alarm")}: ${alarm.cause}. ${alarm.remedy}`}
        </p>
      ))}
    </>
  );
}
