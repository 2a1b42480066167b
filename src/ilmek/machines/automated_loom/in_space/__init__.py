"""The loom in space: its real parts at true size, and how the cyclograms move them."""
