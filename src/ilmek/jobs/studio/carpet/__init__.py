"""The carpet: recipes, charts and rows."""
