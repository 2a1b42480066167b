/** Texts of the view "loom". */
export default {
  title: "Loom",
  lead: "This view is not part of the studio yet. The command line does its work:",
} as const;
