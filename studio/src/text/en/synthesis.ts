/** Texts of the view "synthesis". */
export default {
  title: "Synthesis",
  lead: "This view is not part of the studio yet. The command line does its work:",
} as const;
