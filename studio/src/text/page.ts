/** The texts of figures alone, in place of all: a page that stands by itself has the client's figures and no more. */
import english from "./en/figure";
import turkish from "./tr/figure";

export const en = { figure: english };
export const tr = { figure: turkish };
