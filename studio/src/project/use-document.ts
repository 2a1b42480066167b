import { useEffect } from "preact/hooks";
import type { Document } from "./document";
import { activeDocument, openDocument } from "./project";

/** The document of a text file, in hand for the keys while the component is shown. */
export function useDocument<T extends object = Record<string, unknown>>(path: string): Document<T> {
  const document = openDocument<T>(path);
  useEffect(() => {
    const own = document as unknown as Document<object>;
    activeDocument.value = own;
    return () => {
      if (activeDocument.peek() === own) activeDocument.value = null;
    };
  }, [document]);
  return document;
}
