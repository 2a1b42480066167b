"""The loom's controller, without hardware, files and clock: state model, interlocks, alarms, sequence, journal."""
