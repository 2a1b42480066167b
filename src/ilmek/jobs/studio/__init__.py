"""The user tasks of the studio: each a function of a request, a record of plain data, and a `Context`."""
