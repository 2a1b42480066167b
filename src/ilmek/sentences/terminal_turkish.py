"""The sentences of the terminal in Turkish, and its headings by the English ones."""

TERMINAL = {
    "terminal.note": "not: {text}",
    "terminal.checks": "denetimler: {passed} geçti, {failed} kaldı",
    "terminal.weaves": "dokur: evet",
    "terminal.weaves-not": "dokur: HAYIR, {count} neden",
    "terminal.weaves-not-one": "dokur: HAYIR, {count} neden",
    "terminal.nearest": "dokunabilen en yakın: {text}",
    "terminal.must": "{value}, {source}",
    "terminal.must-be": "{value}, {limit} olmalı",
    "terminal.at-most": "{value}, en çok {limit} olmalı",
    "terminal.at-least": "{value}, en az {limit} olmalı",
    "terminal.also-of": "ayrıca {machines} makinelerinin her parametresi, {first}.AD=DEĞER diye",
    "terminal.with-json": "--json ile ayrıca: {names}",
    "terminal.tests": "hesabın sınamaları: {count} sınamanın hepsi geçti",
    "terminal.tests-one": "hesabın sınamaları: tek sınama geçti",
    "terminal.tests-failed": "hesabın sınamaları: {count} sınamadan {failed} kaldı: {names}",
    "tufted.gun-carpet": "{size}, sıra aralığı {spacing}, {colours} renk",
    "tufted.gun-rows": "{row_length} (en az {row_bound}), {strokes} çizgi",
    "tufted.gun-travel": "{travel} (en az {travel_bound})",
    "tufted.gun-covered": "halının {covered} kadarı, her bölgenin en az {coverage} kadarı",
    "tufted.gun-yarn": "{gun_yarn}, {gun_yarn_mass}",
    "tufted.carpet": "{size}, {cells} ilmek yeri, {colours} renk",
    "tufted.machine": "{needles} iğne, besleme {attachment}, seçim {selection}",
    "tufted.strokes": "{needle_strokes}, {loops} ilmek, {misplaced} yanlış renkte",
    "tufted.yarn": "{tufted_yarn}, {tufted_yarn_mass}, {tufted_mass_per_area}",
    "tufted.time": "{tufting_time}, {tufting_production}",
    "tufted.cost": "{cost}; tezgâhta düğümlü {knotted}",
    "tufted.no-price": "bilinmiyor",
    "tufted.kilim-carpet": "{size}; {columns} gözlü {rows} sıra",
    "tufted.kilim-slits": "en uzunu {slit_length}, {slits_joined} fazla uzun, {joins_woven} birleşme",
    "tufted.kilim-bobbins": "sırada {mean_bobbins}, en çok {bobbins_per_row}",
    "tufted.kilim-weft": "{weft_length}, {weft_mass}; çözgü {warp_mass}; {cloth_mass}",
}

_WORDS = """
pass = geçti | FAIL = KALDI | yes = evet | no = hayır | check = denetim | checks = denetimler | value = değer
limit = sınır | source = kaynak | result = sonuç | meaning = anlam | choice = seçim | chosen = seçilen
decided by = belirleyen | next cheaper = bir ucuzu | fails = kalan | machine = makine | description = açıklama
parameter = parametre | default = varsayılan | unit = birim | allowed = izin verilen | report = rapor
table = çizelge | cyclogram = siklogram | carpet = halı | size = boyut | quality = kalite | knots = düğümler
yarn = iplik | yarns = iplikler | colour = renk | colours = renkler | share = pay | use = kullanım | metres = metre
grams = gram | to buy = satın alınacak | hanks = çile | lots = partiler | pile = hav
colour changes = renk değişimleri | weaving time = dokuma süresi | heads = kafalar | weavers = dokuyucular
cost = maliyet | loom = tezgâh | rows = sıralar | stops = duruşlar | changes of tube = tüp değişimleri
bobbin = masura | changes = değişimler | time of one = birinin süresi | head = kafa | busy = meşgul | ties = bağlar
order = sipariş | start = başlangıç | end = bitiş | due = teslim | late = geç | late order = geç sipariş
any of these saves it = bunlardan biri kurtarır | needed [kg] = gereken [kg] | stock [kg] = stok [kg]
to buy [kg] = satın alınacak [kg] | needed by = gerektiği gün | order by = sipariş günü | carpets = halılar
work [h] = iş [h] | share of its shifts = vardiyalarının payı | pieces = parça | delivery = teslimat | net = net
with tax = vergiyle | papers = belgeler | digest = özet | utilisation = kullanım | bottleneck = darboğaz
state = durum | loom's clock = tezgâhın saati | repairs = onarımlar | journal = günlük | alarm = alarm
verdict = karar | inputs = girdiler | reports = raporlar | proposed = önerilen | nearest wool = en yakın yün
travel = boş yol | covered = kaplanan | slits = yarıklar | bobbins = masuralar | weft = atkı | time = süre
strokes = vuruşlar
mass = kütle | picture = resim | programme = program | motion = hareket | law = yasa | name = ad | kind = tür
reading = okuma | paper = makale | claims = savlar | fitted = uydurulan
binding constraints, in the order of the turn: = bağlayan kısıtlar, dönüş sırasıyla:
"""

WORDS = dict(pair.split(" = ") for line in _WORDS.strip().split("\n") for pair in line.split(" | "))
