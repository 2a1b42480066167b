/** Shape of the texts: other languages have the keys of the English ones. */
import type { en } from "./en";
import type { views } from "./en/views";

export type Catalogue = typeof en & typeof views;
export type Group = keyof Catalogue;

/** A group of texts in another language: the same keys. */
export type Same<T> = { readonly [K in keyof T]: string };
export type Translation = { readonly [G in Group]: Same<Catalogue[G]> };
