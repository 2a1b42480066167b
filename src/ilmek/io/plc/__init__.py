"""The loom's control for programmable controllers: IEC 61131-3 structured text, PLCopen XML, the list of I/O."""
