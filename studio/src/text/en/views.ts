/** The English texts of every view but the first one. */
import cyclogram from "./cyclogram";
import files from "./files";
import linkage from "./linkage";
import loom from "./loom";
import machine from "./machine";
import study from "./study";
import synthesis from "./synthesis";

export const views = { cyclogram, files, linkage, loom, machine, study, synthesis };
