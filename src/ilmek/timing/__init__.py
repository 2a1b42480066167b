"""The cyclogram."""
