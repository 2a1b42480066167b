import { useEffect, useState } from "preact/hooks";
import type { OutEntry, Product, ProductList } from "../../api/messages";
import { post } from "../../api/request";
import { t, textIfKnown } from "../../text";
import { Button, CopyCommand, Icon, Progress } from "../../ui";
import { sizeText, timeText } from "./format";
import { Downloads, Preview } from "./out-files";
import { keyOf, out, type Writing, write, writings } from "./work";

/** What can be written of a file: each with what there is of it, how to get it, and how to write it. */
export function Products({ path, digest }: { path: string; digest: string }) {
  const [products, setProducts] = useState<readonly Product[] | null>(null);
  const [all, setAll] = useState<AbortController | null>(null);
  useEffect(() => {
    const abort = new AbortController();
    post<ProductList>("/project/products", { path }, abort.signal).then(
      (found) => setProducts(found.products),
      () => {
        if (!abort.signal.aborted) setProducts([]);
      },
    );
    return () => abort.abort();
  }, [path, digest]);
  if (products === null) return null;
  const entries = new Map(out.value?.entries.map((entry) => [entry.path, entry]));
  const due = products.filter((one) => !isFresh(entries.get(one.target)) && !isRunning(path, one.name));
  const writeAll = async () => {
    const own = new AbortController();
    setAll(own);
    for (const one of due) if (!own.signal.aborted) await write(path, one.name, own.signal);
    setAll(null);
  };
  return (
    <section class="ui-stack" aria-labelledby="files-out">
      <div class="ui-row">
        <h3 id="files-out" class="ui-grow">
          {t("files.out")}
        </h3>
        {(all !== null || due.length > 1) && (
          <Button size="small" onClick={() => (all === null ? void writeAll() : all.abort())}>
            {all === null ? t("files.writeAll", { count: due.length }) : t("ui.cancel")}
          </Button>
        )}
      </div>
      {products.length === 0 && <p class="ui-muted">{t("files.noProducts")}</p>}
      <ul class="files-products">
        {products.map((one) => (
          <ProductRow key={one.name} path={path} product={one} entry={entries.get(one.target)} />
        ))}
      </ul>
    </section>
  );
}

function isFresh(entry: OutEntry | undefined): boolean {
  return entry !== undefined && (entry.changed ?? []).length === 0;
}

function isRunning(path: string, product: string): boolean {
  return writings.value[keyOf(path, product)]?.abort !== undefined;
}

interface RowProps {
  path: string;
  product: Product;
  entry: OutEntry | undefined;
}

function ProductRow({ path, product, entry }: RowProps) {
  const writing = writings.value[keyOf(path, product.name)];
  const title = textIfKnown(`files.product_${product.name}`) ?? product.name;
  return (
    <li class="files-product">
      <div class="files-product-head">
        {entry && <Preview entry={entry} />}
        <div class="ui-grow">
          <h4>{title}</h4>
          <p class="ui-muted">{textIfKnown(`files.product_${product.name}_help`) ?? product.target}</p>
          <Age entry={entry} target={product.target} />
        </div>
        <div class="ui-row files-buttons">
          {entry && <Downloads entry={entry} />}
          {!isRunning(path, product.name) && (
            <Button
              kind={isFresh(entry) ? "plain" : "primary"}
              size="small"
              aria-label={`${entry ? t("files.writeAgain") : t("files.write")}: ${title}`}
              onClick={() => void write(path, product.name)}
            >
              {entry ? t("files.writeAgain") : t("files.write")}
            </Button>
          )}
        </div>
      </div>
      {writing !== undefined && <Outcome writing={writing} title={title} />}
      <details class="files-command">
        <summary>{t("ui.commands")}</summary>
        <CopyCommand command={product.command} python={product.python} />
      </details>
    </li>
  );
}

/** Whether a product is there, since when, and whether it is older than what it was written of. */
function Age({ entry, target }: { entry: OutEntry | undefined; target: string }) {
  return (
    <p class="files-age" role="status">
      {entry === undefined ? (
        <span class="ui-muted">{t("files.notWritten", { target })}</span>
      ) : (
        <>
          <code>{entry.path}</code> · {sizeText(entry.size)} · {timeText(entry.time)} <Stale entry={entry} />
        </>
      )}
    </p>
  );
}

/** Whether something in out/ is up to date; nothing where it is not known of what it was written. */
export function Stale({ entry }: { entry: OutEntry }) {
  if (!entry.source) return null;
  const changed = entry.changed ?? [];
  return changed.length > 0 ? (
    <span class="ui-badge warn">
      <Icon name="warning" />
      {t("files.stale", { names: changed.join(", ") })}
    </span>
  ) : (
    <span class="ui-badge good">
      <Icon name="good" />
      {t("files.fresh")}
    </span>
  );
}

function Outcome({ writing, title }: { writing: Writing; title: string }) {
  if (writing.abort !== undefined) {
    const stage = textIfKnown(`files.stage_${writing.stage.replaceAll(" ", "_")}`) ?? writing.stage;
    return (
      <Progress
        label={stage === "" ? t("files.writing", { title }) : `${title}: ${stage}`}
        share={writing.share}
        onCancel={() => writing.abort?.abort()}
      />
    );
  }
  if (writing.problem !== undefined) {
    return (
      <p class="ui-callout bad" role="alert">
        {writing.problem}
      </p>
    );
  }
  const { failed = [], notes = [] } = writing.done ?? {};
  if (failed.length + notes.length === 0) return null;
  return (
    <div class={`ui-callout ${failed.length > 0 ? "warn" : ""}`}>
      {failed.length > 0 && <p>{t("files.failed", { names: failed.join("; ") })}</p>}
      {notes.length > 0 && (
        <details>
          <summary>{t("files.notes", { count: notes.length })}</summary>
          <ul>
            {notes.map((note) => (
              <li key={note}>{note}</li>
            ))}
          </ul>
        </details>
      )}
    </div>
  );
}
