import type { Same } from "..";
import type en from "../en/cyclogram";

export default {
  title: "Siklogram",
  lead: "Bu görünüm henüz stüdyoda yok. Aynı işi komut satırı yapar:",
} satisfies Same<typeof en>;
