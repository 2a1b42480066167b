/** Texts of the view "carpet". */
export default {
  title: "Carpet",
  lead: "This view is not part of the studio yet. The command line does its work:",
} as const;
