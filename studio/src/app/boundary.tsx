import { Component, type ComponentChildren } from "preact";
import { t } from "../text";
import { Button } from "../ui";

interface State {
  error: Error | null;
}

/** Shows the error of a view in its place; documents live outside the views, so nothing is lost. */
export class Boundary extends Component<{ children: ComponentChildren }, State> {
  override state: State = { error: null };

  static override getDerivedStateFromError(error: unknown): State {
    return { error: error instanceof Error ? error : new Error(String(error)) };
  }

  override render() {
    const { error } = this.state;
    if (error === null) return this.props.children;
    return (
      <div class="app-plain" role="alert">
        <h1>{t("app.broken")}</h1>
        <p>{t("app.brokenHelp")}</p>
        <pre class="ui-callout bad">{error.message}</pre>
        <div class="ui-row">
          <Button kind="primary" onClick={() => this.setState({ error: null })}>
            {t("app.tryAgain")}
          </Button>
          <Button onClick={() => location.reload()}>{t("app.reload")}</Button>
        </div>
      </div>
    );
  }
}
