"""The sentences of a machine's papers in Turkish."""

PAPERS = {
    "paper.index": "Klasörün dizini",
    "paper.pages": "Belgeler",
    "paper.lists": "Listeler",
    "paper.drawings": "Çizimler ve katı modeller",
    "paper.motions": "Denetleyiciler için hareketler",
    "paper.rows": "{count} satır",
    "paper.measured": "ölçülen",
    "paper.not-released": "ONAYLANMADI",
    "paper.not-released-why": "Bu tasarımın bazı denetimleri sağlanmıyor. Parça yapmayın; nedenler dizindedir.",
    "paper.made-by": "ilmek {version} ile yapıldı. Bütün sayılar tasarımdan hesaplanmıştır; birimleri yanlarındadır.",
}
