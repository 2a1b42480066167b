/** Every text in English; a view has a file of its own. */
import app from "./app";
import carpet from "./carpet";
import cyclogram from "./cyclogram";
import figure from "./figure";
import files from "./files";
import linkage from "./linkage";
import loom from "./loom";
import machine from "./machine";
import project from "./project";
import synthesis from "./synthesis";
import ui from "./ui";

export const en = { app, carpet, cyclogram, figure, files, linkage, loom, machine, project, synthesis, ui };
