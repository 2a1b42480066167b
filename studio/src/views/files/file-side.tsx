import { useEffect, useRef, useState } from "preact/hooks";
import type { Product, ProductList } from "../../api/messages";
import { post } from "../../api/request";
import { fileAddress, SaveState, useDocument } from "../../project";
import { t, textIfKnown } from "../../text";
import { Button, CopyCommand, Icon, Progress } from "../../ui";
import { keyOf, type Writing, write, writings } from "./work";

/** A file of the project: its text, its state, and what can be written of it. */
export function FileSide({ path }: { path: string }) {
  const document = useDocument(path);
  const [products, setProducts] = useState<readonly Product[]>([]);
  useEffect(() => {
    const abort = new AbortController();
    post<ProductList>("/project/products", { path }, abort.signal).then(
      (found) => setProducts(found.products),
      () => setProducts([]),
    );
    return () => abort.abort();
  }, [path]);
  return (
    <div class="ui-stack">
      <div class="ui-row files-head">
        <h2 class="ui-grow">{path}</h2>
        <SaveState document={document} />
      </div>
      <h3>{t("files.out")}</h3>
      {products.length === 0 && <p class="ui-muted">{t("files.noProducts")}</p>}
      <div class="files-products">
        {products.map((product) => (
          <ProductCard key={product.name} path={path} product={product} />
        ))}
      </div>
      <Editor key={path} path={path} />
    </div>
  );
}

function ProductCard({ path, product }: { path: string; product: Product }) {
  const writing = writings.value[keyOf(path, product.name)];
  const title = textIfKnown(`files.product_${product.name}`) ?? product.name;
  return (
    <section class="files-product" aria-label={title}>
      <div class="ui-row">
        <h4 class="ui-grow">{title}</h4>
        {writing?.abort === undefined && (
          <Button kind="primary" size="small" icon="download" onClick={() => void write(path, product.name)}>
            {t("files.write")}
          </Button>
        )}
      </div>
      <p class="ui-muted">{textIfKnown(`files.product_${product.name}_help`) ?? product.target}</p>
      {writing !== undefined && <State writing={writing} target={product.target} />}
      <CopyCommand command={product.command} />
    </section>
  );
}

function State({ writing, target }: { writing: Writing; target: string }) {
  if (writing.abort !== undefined) {
    const stage = textIfKnown(`files.stage_${writing.stage.replaceAll(" ", "_")}`) ?? writing.stage;
    return (
      <Progress
        label={stage === "" ? t("files.writing") : stage}
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
  if (writing.done === undefined) return null;
  const { failed = [], notes = [] } = writing.done;
  return (
    <div class={`ui-callout ${failed.length > 0 ? "bad" : "good"}`} role="status">
      <p class="ui-row">
        <Icon name={failed.length > 0 ? "warning" : "good"} />
        <span class="ui-grow">{t("files.written", { target })}</span>
        {/\.\w+$/.test(target) && (
          <a href={fileAddress(target)} target="_blank" rel="noreferrer">
            {t("files.show")}
          </a>
        )}
      </p>
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

/** The text of a file, for what no view edits and for errors. */
function Editor({ path }: { path: string }) {
  const document = useDocument(path);
  const [own, setOwn] = useState<string | null>(null);
  const area = useRef<HTMLTextAreaElement>(null);
  const text = own ?? document.text.value;
  const state = document.saved.value;
  useEffect(() => {
    if (state === "saved") setOwn(null);
  }, [state, document.text.value]);
  const line = document.error.value?.line;
  const goToLine = (number: number) => {
    const begin =
      text
        .split("\n")
        .slice(0, number - 1)
        .join("\n").length + (number > 1 ? 1 : 0);
    const end = text.indexOf("\n", begin);
    area.current?.focus();
    area.current?.setSelectionRange(begin, end < 0 ? text.length : end);
  };
  return (
    <details class="files-editor" open={document.error.value !== null}>
      <summary>{t("files.text")}</summary>
      {typeof line === "number" && (
        <Button size="small" onClick={() => goToLine(line)}>
          {t("files.goToLine", { line })}
        </Button>
      )}
      <textarea
        ref={area}
        aria-label={t("files.textOf", { path })}
        spellcheck={false}
        rows={Math.min(30, text.split("\n").length + 1)}
        value={text}
        disabled={state === "loading" || state === "missing"}
        onInput={(event) => {
          setOwn(event.currentTarget.value);
          document.setText(event.currentTarget.value);
        }}
      />
    </details>
  );
}
