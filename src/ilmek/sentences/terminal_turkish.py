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
mass = kütle | picture = resim | programme = program | motion = hareket | law = yasa | name = ad | kind = tür
reading = okuma | paper = makale | claims = savlar | fitted = uydurulan
binding constraints, in the order of the turn: = bağlayan kısıtlar, dönüş sırasıyla:
"""

WORDS = dict(pair.split(" = ") for line in _WORDS.strip().split("\n") for pair in line.split(" | "))
