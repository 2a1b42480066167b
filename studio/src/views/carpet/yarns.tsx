import { useState } from "preact/hooks";
import type { Proposal } from "../../api/messages";
import { ApiError, post } from "../../api/request";
import { formatNumber, t } from "../../text";
import { Button, IconButton, Select, toast } from "../../ui";
import { Assignment } from "./assignment-table";
import { type CarpetModel, namesOf } from "./model";
import { TextSetting } from "./text-setting";

/** The yarns: how many, which are kept and which are never taken, one in the place of another, shades to dye. */
export function Yarns({ model }: { model: CarpetModel }) {
  const chart = model.chart.value;
  if (chart === null) return null;
  const used = chart.about.yarns.filter((yarn) => yarn.knots > 0);
  const listed = chart.about.listed;
  const others = listed.filter((yarn) => !used.some((one) => one.name === yarn.name));
  return (
    <div class="ui-stack">
      <TextSetting model={model} name="colours" label={t("carpet.colours")} help={t("carpet.coloursHelp")} />
      <ul class="carpet-yarns" aria-label={t("carpet.usedYarns")}>
        {used.map((yarn) => (
          <YarnLine key={yarn.name} model={model} name={yarn.name} srgb={yarn.srgb} symbol={yarn.symbol} />
        ))}
      </ul>
      {others.length > 0 && (
        <details class="ui-details">
          <summary>{t("carpet.otherYarns", { count: others.length })}</summary>
          <ul class="carpet-yarns">
            {others.map((yarn) => (
              <YarnLine key={yarn.name} model={model} name={yarn.name} srgb={yarn.srgb} symbol="" />
            ))}
          </ul>
        </details>
      )}
      <details class="ui-details" open>
        <summary>{t("carpet.assignment")}</summary>
        <Assignment model={model} />
      </details>
      <Replace model={model} />
      <Propose model={model} />
    </div>
  );
}

interface YarnProps {
  model: CarpetModel;
  name: string;
  srgb: string;
  symbol: string;
}

function YarnLine({ model, name, srgb, symbol }: YarnProps) {
  const lists = { keep: namesOf(model.recipe.value?.["keep"]), never: namesOf(model.recipe.value?.["never"]) };
  const has = (list: "keep" | "never") => lists[list].some((one) => one.toLowerCase() === name.toLowerCase());
  const toggle = (list: "keep" | "never") => {
    const other = list === "keep" ? "never" : "keep";
    const without = (names: readonly string[]) => names.filter((one) => one.toLowerCase() !== name.toLowerCase());
    const own = has(list) ? without(lists[list]) : [...lists[list], name];
    const rest = without(lists[other]);
    model.set({ [list]: own.length ? own : null, [other]: rest.length ? rest : null });
  };
  const inHand = model.yarn.value === name;
  return (
    <li>
      <button
        type="button"
        class="carpet-yarn"
        aria-pressed={inHand}
        title={t("carpet.takeYarn")}
        onClick={() => {
          model.yarn.value = name;
        }}
      >
        <span class="carpet-swatch" style={{ background: srgb }} aria-hidden="true">
          <span class={isLight(srgb) ? "on-light" : "on-dark"}>{symbol}</span>
        </span>
        <span>{name}</span>
      </button>
      <Button
        size="small"
        kind="quiet"
        pressed={has("keep")}
        aria-label={`${t("carpet.keep")}: ${name}`}
        onClick={() => toggle("keep")}
      >
        {t("carpet.keep")}
      </Button>
      <Button
        size="small"
        kind="quiet"
        pressed={has("never")}
        aria-label={`${t("carpet.never")}: ${name}`}
        onClick={() => toggle("never")}
      >
        {t("carpet.never")}
      </Button>
    </li>
  );
}

/** Whether dark letters stand out on a colour better than light ones. */
export function isLight(srgb: string): boolean {
  const code = Number.parseInt(srgb.slice(1), 16);
  return 0.3 * (code >> 16) + 0.59 * ((code >> 8) & 255) + 0.11 * (code & 255) > 128;
}

/** One yarn in the place of another, as an edit of the recipe. */
function Replace({ model }: { model: CarpetModel }) {
  const chart = model.chart.value;
  const used = chart?.about.yarns.filter((yarn) => yarn.knots > 0) ?? [];
  const [old, setOld] = useState("");
  const [fresh, setFresh] = useState("");
  const from = used.some((yarn) => yarn.name === old) ? old : (used[0]?.name ?? "");
  const choices = chart?.about.listed.filter((yarn) => yarn.name !== from) ?? [];
  const to = choices.some((yarn) => yarn.name === fresh) ? fresh : (choices[0]?.name ?? "");
  const named = (yarns: readonly { name: string }[]) => yarns.map(({ name }) => ({ value: name, label: name }));
  return (
    <details class="ui-details">
      <summary>{t("carpet.replace")}</summary>
      <div class="carpet-pair">
        <Select label={t("carpet.replaceOld")} value={from} choices={named(used)} onChange={setOld} />
        <Select label={t("carpet.replaceNew")} value={to} choices={named(choices)} onChange={setFresh} />
        <Button disabled={!from || !to} onClick={() => model.edit([`replace ${from} by ${to}`])}>
          {t("carpet.replaceDo")}
        </Button>
      </div>
    </details>
  );
}

/** Shades that suit the picture best; taken, they are the yarns of the recipe. */
function Propose({ model }: { model: CarpetModel }) {
  const [proposal, setProposal] = useState<Proposal | null>(null);
  const [busy, setBusy] = useState(false);
  const propose = async () => {
    setBusy(true);
    try {
      const body = { recipe: model.recipe.peek(), count: 8, path: model.path };
      setProposal(await post<Proposal>("/carpet/proposal", body));
    } catch (error) {
      if (error instanceof ApiError) toast(error.message, "bad");
    }
    setBusy(false);
  };
  const take = () => {
    const yarn = proposal?.shades.map((shade) => ({ name: shade.name, srgb: shade.srgb }));
    model.set({ yarn, yarns: "", colours: "", keep: null, never: null, edits: null });
    setProposal(null);
  };
  const own = model.recipe.value?.["yarn"] !== undefined;
  return (
    <details class="ui-details">
      <summary>{t("carpet.propose")}</summary>
      <div class="ui-stack">
        <p class="ui-help">{t("carpet.proposeHelp")}</p>
        <div class="ui-row">
          <Button disabled={busy} onClick={() => void propose()}>
            {busy ? t("carpet.proposing") : t("carpet.proposeDo")}
          </Button>
          {own && <Button onClick={() => model.set({ yarn: null })}>{t("carpet.ownList")}</Button>}
        </div>
        {proposal !== null && (
          <>
            <ul class="carpet-yarns">
              {proposal.shades.map((shade) => (
                <li key={shade.name}>
                  <span class="carpet-swatch" style={{ background: shade.srgb }} aria-hidden="true" />
                  <span>
                    {t("carpet.shade", {
                      name: shade.name,
                      srgb: shade.srgb,
                      share: formatNumber(100 * shade.share, 3),
                      nearest: shade.nearest,
                    })}
                  </span>
                </li>
              ))}
            </ul>
            <div class="ui-row">
              <Button kind="primary" onClick={take}>
                {t("carpet.proposeTake")}
              </Button>
              <IconButton icon="close" label={t("ui.close")} onClick={() => setProposal(null)} />
            </div>
          </>
        )}
      </div>
    </details>
  );
}
