/** Texts of the view "machine". */
export default {
  title: "Machine",
  lead: "This view is not part of the studio yet. The command line does its work:",
} as const;
