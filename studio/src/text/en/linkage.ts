/** Texts of the view "linkage". */
export default {
  title: "Linkage",
  lead: "This view is not part of the studio yet. The command line does its work:",
} as const;
