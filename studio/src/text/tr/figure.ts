import type { Same } from "../catalogue";
import type en from "../en/figure";

export default {
  sortBy: "{column} sütununa göre sırala",
  play: "Oynat",
  pause: "Duraklat",
  speed: "Hız",
  perRun: "çevrim {seconds} s",
  realSpeed: "gerçek hız",
  zoomIn: "Yakınlaştır",
  zoomOut: "Uzaklaştır",
  zoomFit: "Tümünü göster",
  plotKeys: "Ok tuşları imleci oynatır; Shift: on adım; Home, End: uçlar; Escape: imleç yok.",
  drawingKeys: "Ok tuşları görünümü kaydırır; artı ve eksi yakınlaştırır; 0 tümünü gösterir.",
  at: "{at} için",
  values: "Değerler",
  total: "toplam",
  yes: "evet",
  no: "hayır",
  track: "Hat",
  motion: "Hareket",
  dwell: "bekleme",
  position: "Konum",
  velocity: "Hız",
  acceleration: "İvme",
  curves: "Eğriler",
} satisfies Same<typeof en>;
