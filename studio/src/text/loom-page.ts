/** The texts of the loom in space alone, in place of all. */

import appEnglish from "./en/app";
import loomEnglish from "./en/loom";
import uiEnglish from "./en/ui";
import { en as english, tr as turkish } from "./page";
import appTurkish from "./tr/app";
import loomTurkish from "./tr/loom";
import uiTurkish from "./tr/ui";

export const en = { ...english, app: appEnglish, loom: loomEnglish, ui: uiEnglish };
export const tr = { ...turkish, app: appTurkish, loom: loomTurkish, ui: uiTurkish };
