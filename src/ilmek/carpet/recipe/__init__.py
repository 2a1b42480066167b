"""Recipes: a carpet composed of pictures, repeats, borders, stripes and edits; a pure function of recipe and pixels.

recipe       the records of a recipe
layout       where borders and field lie on the grid of knots, and the carpets on which whole repeats fit
mirror       a half or a quarter that is completed by reflection
repeat       a tile over an area
border       a tile round the carpet, with corners that turn the pattern
composition  the design of a recipe, one colour for each knot
edits        changes of single knots, lines and areas
finish       yarns that the recipe names, and edits, on the chart
"""
