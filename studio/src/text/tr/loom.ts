import type { Same } from "..";
import type en from "../en/loom";

export default {
  title: "Tezgâh",
  lead: "Bu görünüm henüz stüdyoda yok. Aynı işi komut satırı yapar:",
} satisfies Same<typeof en>;
