"""Briefs of carpets: charts, looms by deadline, price and time, weavers, tufting machines and guns."""

from typing import Any

from briefs.brief import Brief, called, designed

SMALL: dict[str, Any] = {"size": "30x40cm", "quality": "10x10/dm"}
COARSE = {"least_detail": "40%"}
"""A small rug has a part of the picture's detail."""


def woven(kind: str, wanted: str, settings: dict[str, Any] = COARSE, **wishes: Any) -> Brief:
    """A small carpet of the medallion and its loom."""
    out = kind.replace(" ", "-")
    return called(kind, wanted, "weave", picture="medallion.png", out=out, **{**SMALL, **wishes}, settings=settings)


CARPETS = (
    woven("small rug", "A rug of 1,200 knots and its loom."),
    woven("deadline", "The rug in thirty hours.", deadline="30h"),
    woven("quickest loom", "The loom of the least time.", aim="time"),
    woven("round rug", "A round rug.", {**COARSE, "shape": "round"}, size="40x40cm"),
    woven("flat ends", "Four centimetres of kilim at each end.", {**COARSE, "kilim_ends": "4cm"}),
    woven("asymmetric rug", "With Persian knots.", knot="asymmetric"),
    woven("loom for weavers", "For weavers at a loom without drives.", loom={"knotting": "hand"}),
    called("proved programme", "Is the programme of the rug right?", "check",
           ("weave", {"picture": "medallion.png", "out": "proved", **SMALL, "settings": COARSE}),
           path="proved/programme.ilmek"),
    called("statistics", "How long does this programme weave, with what stops?", "inspect",
           ("check", {"path": "small_programme.txt"}), path="small_programme.txt"),
    called("text of a programme", "Is this text a programme without faults?", "check", path="small_programme.txt"),
)  # fmt: skip

TUFTED = (
    called("tufting gun", "A gun tufts 1.2 by 1.8 m.", "tuft", picture="medallion.png", out="gun", size="120x180cm",
           technique="gun"),
    called("tufted by needles", "A tufting machine for 1.2 by 1.8 m.", "tuft", picture="medallion.png", out="needles",
           size="120x180cm", machine={"pattern.creel": "12"}),
    designed("wide tufting", "A tufting machine 2 m wide, a pile of 8 mm.", "tufting-machine", width="2m", drives="5",
             pile_height="8mm"),
)  # fmt: skip

LOOMS = (
    designed("loom of a carpet", "A loom for 1.2 by 1.8 m.", "automated-loom"),
    designed("loom in time", "A loom that weaves it in 12 hours.", "automated-loom", deadline="12h"),
    designed("loom of 2 m", "A loom for 2 by 3 m.", "automated-loom", width="2m", length="3m"),
    designed("comb of a loom", "Its rows are beaten by a comb.", "automated-loom", beat="comb"),
    designed("loom and weavers", "Weavers tie, the loom beats.", "automated-loom", knotting="hand", beat="comb"),
    called("widths of a loom", "1 m or 1.5 m?", "study", target="automated-loom", vary={"width": "1m, 1.5m"},
           goals=["price"]),
)  # fmt: skip
