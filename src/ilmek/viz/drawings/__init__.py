"""Drawing sheets of made parts: views, dimensions from features, title blocks; see `report.sheet`."""
