"""The slips of the papers from which more than one row follows, or that need a text of their own."""

SLIPS = {
    # thesis
    "half in λ": "1/2 for 1 in the terms of λ, which contradicts Eqs 2.38 to 2.42",
    "fraction bar": "what stands below the bar belongs above it",
    "lost 5": "5/384 of Eq 3.4 was taken as 1/384",
    "diameters as radii": "the diameters 140 and 130 mm were taken as radii: 1/16 of the sag",
    "5489 for 5589": "550 kg weigh 5395.5 N; 5489 N are 559.5 kg, and the resultant is that of 5589 N",
    # tufting
    "sign of M4": "+M4 for -M4: the row is clockwise-positive; up to 0.56 N m in M_r",
    "column of zeros": "one column of zeros too many in the matrix",
    # knotting, synthesis
    "sign of ρ²": "f4 = -ρ² lost its sign, as if it were (-ρ)²",
    "f3 of 51.502": "51.49 and 51.499 were typed for 51.502",
    "arms subtracted": "magnitudes of the two arms were subtracted: their links have opposite signs",
    # knotting, accelerations
    "denominator of α2": "r3 sin(θ3-θ2) for r2 sin(θ2-θ3), as derived before; and 65454 written for 67454",
    "G2 at mid-length": "the mass centre of link 2 is 19.31 mm from O2, as section 5 finds, not at mid-length",
    # knotting, forces
    "sign of F2'y": "in the moment of link 2 F2'y has the wrong sign: the products are added, not subtracted",
    "mN as N": "mN were added to N, and N m to N mm",
    "m2 a of G2 left out": "the moment of the inertia force of link 2 about O2 is missing",
    "16.7 for 16.07": "16.7 mm was typed for 16.07 mm",
    "sign of F1'x": "-F2'x + F1'x = 0 gives F1'x = 78.34 N",
    "F2x added twice": "58.23 · 7851.37 is 457185; 4561.7 of the part at rest was added to it",
    "moment of weight lost": "the moment of 1.0 N mm of link 1 is missing in M1",
}
"""Key to what is wrong."""
