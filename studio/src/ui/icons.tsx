/** Icons of 24 by 24, drawn as lines in the colour of the text. They are never the only sign of anything. */

const PATHS = {
  carpet: "M5 4h14v16H5zM8 7h8v10H8zM12 9.500l2 2.500-2 2.500-2-2.500zM7 20v2M12 20v2M17 20v2M7 2v2M12 2v2M17 2v2",
  machine:
    "M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM12 3v3M12 18v3M3 12h3M18 12h3M5.600 5.600l2.200 2.200M16.200 16.200l2.200 2.200M5.600 18.400l2.200-2.200M16.200 7.800l2.200-2.200",
  linkage:
    "M5 19a1.500 1.500 0 1 0 0-.010zM8 8a1.500 1.500 0 1 0 0-.010zM18 6a1.500 1.500 0 1 0 0-.010zM19 19a1.500 1.500 0 1 0 0-.010zM5.700 17.500 7.500 9.500M9.500 7.800l7-1.500M18.200 7.600l.600 9.800M3 21.500h4M17 21.500h4",
  synthesis: "M3 17c2-9 7-13 11-9s1 9 6 7M4 17h.010M9 8.500h.010M14 8.300h.010M19.500 15h.010M12 3v2M12 19v2",
  cyclogram: "M3 4v16h18M5 15l3-6h5l3 6h4M5 9h3M13 9h7",
  loom: "M4 3v18M20 3v18M4 6h16M4 18h16M8 6v12M12 6v12M16 6v12M4 13h16",
  files: "M3 6h6l2 2h10v11H3zM3 11h18",
  settings: "M4 7h9M17 7h3M4 17h3M11 17h9M15 5v4M9 15v4",
  connected: "M5 12l4 4 10-10",
  connecting: "M12 5v4M12 15v4M5 12h4M15 12h4",
  lost: "M12 4 2.500 20h19zM12 10v4M12 17.200v.010",
  warning: "M12 4 2.500 20h19zM12 10v4M12 17.200v.010",
  error: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zM9 9l6 6M15 9l-6 6",
  info: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zM12 11v5M12 8v.010",
  help: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zM9.500 9.500a2.500 2.500 0 1 1 3.500 2.300c-.700.400-1 .900-1 1.700M12 16.800v.010",
  good: "M12 3a9 9 0 1 0 0 18 9 9 0 0 0 0-18zM8 12l3 3 5-6",
  close: "M6 6l12 12M18 6 6 18",
  copy: "M9 9h11v11H9zM5 15H4V4h11v1",
  undo: "M9 7 4 12l5 5M4 12h10a6 6 0 0 1 6 6",
  redo: "M15 7l5 5-5 5M20 12H10a6 6 0 0 0-6 6",
  play: "M7 4.500v15l12-7.500z",
  pause: "M8 5v14M16 5v14",
  plus: "M12 5v14M5 12h14",
  minus: "M5 12h14",
  fit: "M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5",
  download: "M12 4v11M7 11l5 5 5-5M4 20h16",
  upload: "M12 16V4M7 9l5-5 5 5M4 20h16",
  open: "M4 4h7M4 4v16h16v-7M14 4h6v6M20 4l-9 9",
  add: "M12 5v14M5 12h14",
  remove: "M5 7h14M10 7V4h4v3M7 7l1 13h8l1-13",
  search: "M10.500 4a6.500 6.500 0 1 0 0 13 6.500 6.500 0 0 0 0-13zM15.500 15.500 20 20",
  up: "M6 15l6-6 6 6",
  down: "M6 9l6 6 6-6",
  left: "M15 6l-6 6 6 6",
  right: "M9 6l6 6-6 6",
  reset: "M5 5v5h5M5.500 10a7.500 7.500 0 1 1-.800 5",
  keep: "M6 3h12v18l-6-5-6 5z",
  terminal: "M3 5h18v14H3zM7 9l3 3-3 3M12 15h5",
  step: "M6 5v14l9-7zM18 5v14",
  expand: "M4 14v6h6M20 10V4h-6M4 20l7-7M20 4l-7 7",
  pencil: "M4 20l1-4L16 5l3 3L8 19zM14 7l3 3",
  eye: "M2.500 12S6 5.500 12 5.500 21.500 12 21.500 12 18 18.500 12 18.500 2.500 12 2.500 12zM12 9.500a2.500 2.500 0 1 0 0 5 2.500 2.500 0 0 0 0-5z",
} as const;

export type IconName = keyof typeof PATHS;

export function Icon({ name, label }: { name: IconName; label?: string | undefined }) {
  const meaning =
    label === undefined ? { "aria-hidden": "true" as const } : { role: "img" as const, "aria-label": label };
  return (
    <svg class="ui-icon" viewBox="0 0 24 24" {...meaning}>
      <path d={PATHS[name]} />
    </svg>
  );
}
