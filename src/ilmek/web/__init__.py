"""The studio's server: HTTP and WebSocket over the user tasks of `jobs`; no engineering, no file formats."""
