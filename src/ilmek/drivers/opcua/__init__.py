"""The loom as an OPC UA server: what it shows, what it is commanded to do, and who may.

It needs the extra `control` (asyncua); import it only where a server is started. The loom is seen through
`loom.control.view.ControllerView` alone.
"""
