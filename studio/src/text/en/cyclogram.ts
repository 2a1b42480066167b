/** Texts of the view "cyclogram". */
export default {
  title: "Cyclogram",
  lead: "This view is not part of the studio yet. The command line does its work:",
} as const;
