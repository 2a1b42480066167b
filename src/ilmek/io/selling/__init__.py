"""Papers of an order: quotation, approval sheet, mounting sheet, wages, and the label of a carpet."""
