"""Crank-rockers by their dead centres: a given swing of the rocker and a given crank angle between dead centres."""
