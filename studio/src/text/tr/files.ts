import type { Same } from "..";
import type en from "../en/files";

export default {
  title: "Dosyalar",
  lead: "Bu görünüm henüz stüdyoda yok. Aynı işi komut satırı yapar:",
} satisfies Same<typeof en>;
