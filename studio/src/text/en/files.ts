/** Texts of the view "files". */
export default {
  title: "Files",
  lead: "This view is not part of the studio yet. The command line does its work:",
} as const;
