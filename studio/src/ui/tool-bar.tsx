import { useEffect, useRef } from "preact/hooks";

/** A tool: its word, its letter, and its icon as a path of 24 by 24. */
export interface ShownTool<T extends string> {
  value: T;
  label: string;
  letter: string;
  shape: string;
}

interface ToolBarProps<T extends string> {
  label: string;
  tools: readonly ShownTool<T>[];
  value: T;
  upright?: boolean;
  onChoose: (tool: T) => void;
}

const TURNS: Record<string, number | undefined> = { ArrowDown: 1, ArrowRight: 1, ArrowUp: -1, ArrowLeft: -1 };

/** Tools, each with icon, word and letter. The letter chooses it wherever nothing is typed; arrow keys go along the bar. */
export function ToolBar<T extends string>({ label, tools, value, upright = false, onChoose }: ToolBarProps<T>) {
  const box = useRef<HTMLDivElement>(null);
  useEffect(() => {
    const pressed = (event: KeyboardEvent) => {
      const isTyping = (event.target as Element).matches?.("input:not([type=range]), select, textarea");
      const isOurs = !(event.defaultPrevented || isTyping || event.ctrlKey || event.metaKey || event.altKey);
      const tool = tools.find((one) => one.letter === event.key.toUpperCase());
      if (tool === undefined || !isOurs || document.querySelector("dialog[open]")) return;
      event.preventDefault();
      onChoose(tool.value);
    };
    addEventListener("keydown", pressed);
    return () => removeEventListener("keydown", pressed);
  });
  return (
    <div
      ref={box}
      class={`ui-tools${upright ? " upright" : ""}`}
      role="toolbar"
      aria-label={label}
      aria-orientation={upright ? "vertical" : "horizontal"}
      onKeyDown={(event) => {
        const turn = TURNS[event.key];
        const buttons = [...(box.current?.querySelectorAll("button") ?? [])];
        const at = buttons.indexOf(document.activeElement as HTMLButtonElement);
        if (turn === undefined || at < 0) return;
        event.preventDefault();
        buttons[(at + turn + buttons.length) % buttons.length]?.focus();
      }}
    >
      {tools.map((tool) => (
        <button
          key={tool.value}
          type="button"
          class="ui-button quiet"
          aria-pressed={tool.value === value}
          aria-keyshortcuts={tool.letter}
          title={`${tool.label} (${tool.letter})`}
          tabIndex={tool.value === value ? 0 : -1}
          data-tool={tool.value}
          onClick={() => onChoose(tool.value)}
        >
          <svg class="ui-icon" viewBox="0 0 24 24" aria-hidden="true">
            <path d={tool.shape} />
          </svg>
          <span class="name">{tool.label}</span>
          <span class="key" aria-hidden="true">
            {tool.letter}
          </span>
        </button>
      ))}
    </div>
  );
}
