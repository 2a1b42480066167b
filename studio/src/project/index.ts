/** The project in the browser. */
export { type FileContent, type FileError, type FileSummary, fileAddress, type PictureSummary } from "./api";
export { Conflicts } from "./conflicts";
export { type AnyDocument, Document, type SaveState as DocumentState } from "./document";
export { follow } from "./follow";
export {
  activeDocument,
  deleteFile,
  filesChanged,
  filesOf,
  freePath,
  newFile,
  openDocument,
  openDocuments,
  project,
  projectProblem,
  refreshProject,
  renameFile,
  saveAll,
  undoDelete,
  uploadPicture,
} from "./project";
export { SaveState } from "./save-state";
export { useDocument } from "./use-document";
export { ViewHead } from "./view-head";
