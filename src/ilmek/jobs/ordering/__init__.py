"""A customer's order: quotation, approval sheet, the folder of each carpet for the workshop, and its record."""
