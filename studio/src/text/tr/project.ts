import type { Same } from "../catalogue";
import type en from "../en/project";

export default {
  undo: "Geri al (Ctrl+Z)",
  redo: "Yinele (Ctrl+Shift+Z)",
  loading: "Açılıyor",
  saved: "Kaydedildi",
  changed: "Değişti",
  saving: "Kaydediliyor",
  lost: "Bu tarayıcıda tutuluyor",
  refused: "Kaydedilmedi",
  conflict: "İki yerden değişti",
  missing: "Bulunamadı",
  editText: "Metnini düzenle",
  decide: "Karar ver",
  conflictTitle: "{path} iki kez değiştirildi",
  conflictHelp:
    "Siz açtıktan sonra başka bir program ya da sekme bu dosyayı değiştirdi. Hiçbir şeyin üzerine yazılmadı. Hangi durumun kalacağını seçin; geri alma ötekini getirir.",
  conflictGone:
    "Başka bir program bu dosyayı sildi ya da adını değiştirdi. Dosyayı yeniden yazmak için kendi durumunuzu tutun.",
  takeTheirs: "Ötekini al",
  keepMine: "Benimkini tut",
  difference: "Fark",
  value: "Değer",
  line: "Satır",
  mine: "Benimki",
  theirs: "Diskteki",
} as const satisfies Same<typeof en>;
