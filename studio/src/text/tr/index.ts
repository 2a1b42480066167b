/** Every text in Turkish. */

import type { Translation } from "../catalogue";
import app from "./app";
import carpet from "./carpet";
import cyclogram from "./cyclogram";
import figure from "./figure";
import files from "./files";
import linkage from "./linkage";
import loom from "./loom";
import machine from "./machine";
import project from "./project";
import study from "./study";
import synthesis from "./synthesis";
import ui from "./ui";

export const tr: Translation = {
  app,
  carpet,
  cyclogram,
  figure,
  files,
  linkage,
  loom,
  machine,
  project,
  study,
  synthesis,
  ui,
};
