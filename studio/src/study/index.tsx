/** A study of what is open: designs over ranges of some of its numbers, each of which opens beside the present one. */
import type { ComponentChildren } from "preact";
import { useEffect, useRef, useState } from "preact/hooks";
import { type Fault, faultOf } from "../api/fault";
import type { StudyAnswer, StudyNumbers, StudyRequest } from "../api/messages";
import { post } from "../api/request";
import { runWork } from "../api/work";
import { aboutOf, Designs, Figure } from "../draw";
import { t } from "../text";
import { Button, CopyCommand, FaultNote, IconButton, NumberField, Progress, Select, TextField } from "../ui";
import { type Wish, wanted } from "./wish";

const DESIGNS = 64;
const MOST_DESIGNS = 4096;

interface StudyProps {
  /** Whether it is seen; what it found stays while it is not. */
  shown?: boolean;
  /** What is open, as a study takes it. */
  subject: StudyRequest;
  /** What can be done with the numbers of a design. */
  uses: readonly { label: string; use: (settings: Record<string, string>) => void }[];
}

export function Study({ shown = true, subject, uses }: StudyProps) {
  const [numbers, setNumbers] = useState<StudyNumbers>({ varied: [], results: [] });
  const [ranges, setRanges] = useState<ReadonlyMap<string, string>>(new Map());
  const [wishes, setWishes] = useState<ReadonlyMap<string, Wish>>(new Map());
  const [count, setCount] = useState(DESIGNS);
  const [share, setShare] = useState<number | null>(null);
  const [found, setFound] = useState<StudyAnswer | null>(null);
  const [fault, setFault] = useState<Fault | null>(null);
  const work = useRef(new AbortController());
  const fail = (error: unknown) => setFault(faultOf(error));
  const state = JSON.stringify(subject);
  useEffect(() => {
    if (!shown) return undefined;
    const asked = new AbortController();
    post<StudyNumbers>("/study/numbers", subject, asked.signal).then((known) => {
      setNumbers(known);
      setFault(null);
    }, fail);
    return () => asked.abort();
  }, [shown, state]);
  useEffect(() => () => work.current.abort(), []);
  const run = () => {
    work.current = new AbortController();
    setShare(0);
    setFault(null);
    const body = { ...subject, vary: Object.fromEntries(ranges), ...wanted(wishes), samples: count };
    runWork<StudyAnswer>("/study", body, { onStep: (_, done) => setShare(done), signal: work.current.signal })
      .then(setFound, fail)
      .finally(() => setShare(null));
  };
  return (
    <div class="ui-stack">
      <Chosen
        label={t("study.vary")}
        names={numbers.varied.map((one) => one.name)}
        chosen={ranges}
        first={(name) => numbers.varied.find((one) => one.name === name)?.range ?? ""}
        onChange={setRanges}
      >
        {(name, range, set) => <TextField label={name} help={t("study.range")} value={range} onChange={set} />}
      </Chosen>
      <Chosen
        label={t("study.result")}
        names={numbers.results}
        chosen={wishes}
        first={() => "least" as Wish}
        onChange={setWishes}
      >
        {(name, wish, set) => (
          <Select
            label={name}
            value={wish}
            choices={(["least", "most", "shown"] as const).map((value) => ({ value, label: t(`study.${value}`) }))}
            onChange={set}
          />
        )}
      </Chosen>
      <div class="ui-row">
        <NumberField label={t("study.designs")} value={count} min={1} max={MOST_DESIGNS} onChange={setCount} />
        <Button kind="primary" disabled={ranges.size * wishes.size === 0 || share !== null} onClick={run}>
          {t("study.run")}
        </Button>
      </div>
      {share !== null && <Progress label={t("study.running")} share={share} onCancel={() => work.current.abort()} />}
      <FaultNote fault={fault} />
      {found !== null && <Found found={found} uses={uses} />}
    </div>
  );
}

interface ChosenProps<T> {
  label: string;
  names: readonly string[];
  chosen: ReadonlyMap<string, T>;
  first: (name: string) => T;
  onChange: (chosen: ReadonlyMap<string, T>) => void;
  children: (name: string, value: T, set: (value: T) => void) => ComponentChildren;
}

/** Names chosen from many, each with what is asked of it. */
function Chosen<T>({ label, names, chosen, first, onChange, children }: ChosenProps<T>) {
  const left = names.filter((one) => !chosen.has(one)).map((name) => ({ value: name, label: name }));
  return (
    <div class="ui-stack">
      {[...chosen].map(([name, value]) => (
        <div class="ui-row" key={name}>
          <div class="ui-grow">{children(name, value, (to) => onChange(new Map(chosen).set(name, to)))}</div>
          <IconButton
            icon="remove"
            label={t("study.without", { name })}
            onClick={() => onChange(new Map([...chosen].filter(([other]) => other !== name)))}
          />
        </div>
      ))}
      <Select
        key={chosen.size}
        label={label}
        value=""
        choices={[{ value: "", label: "–" }, ...left]}
        onChange={(name) => name !== "" && onChange(new Map(chosen).set(name, first(name)))}
      />
    </div>
  );
}

function Found({ found, uses }: { found: StudyAnswer; uses: StudyProps["uses"] }) {
  const { samples, made, feasible } = found;
  return (
    <div class="ui-stack">
      <p>{t("study.found", { count: samples, made, feasible })}</p>
      {found.warnings.map((text) => (
        <p key={text} class="ui-callout warn">
          {text}
        </p>
      ))}
      {found.figures.map((figure) =>
        figure.cloud ? (
          <Designs key={found.command} cloud={figure.cloud} title={figure.cloud.title}>
            {(design) => (
              <div class="ui-row">
                {uses.map(({ label, use }) => (
                  <Button key={label} onClick={() => use(found.designs[design] ?? {})}>
                    {label}
                  </Button>
                ))}
              </div>
            )}
          </Designs>
        ) : (
          <Figure key={aboutOf(figure).name} figure={figure} />
        ),
      )}
      <p class="ui-help">{t("study.further")}</p>
      <CopyCommand command={found.command} />
    </div>
  );
}
