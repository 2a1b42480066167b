/** Texts of studies. */
export default {
  title: "Study",
  vary: "Vary",
  range: "a range 27deg..33deg, or values with commas",
  result: "Result",
  least: "as small as can be",
  most: "as large as can be",
  shown: "only shown",
  without: "Leave out {name}",
  designs: "Designs",
  run: "Study",
  running: "Designing",
  found:
    "{count} design, {made} made, {feasible} with every check held|{count} designs, {made} made, {feasible} with every check held",
  further: "The same study at a terminal, where it can be larger and go on after a stop:",
  asB: "Open as B",
  take: "Take its values",
} as const;
