"""Output files and folders: all of one call are written, or none, and nothing is ever lost.

The write protocol, in the order of its steps:

    1  check     before any work: each target can be written, no two are one, none is an input or foreign (`Outputs`)
    2  repair    what a killed run left beside a target is completed, undone or removed (`staging.repair`)
    3  stage     everything is written into a hidden, locked folder beside its target, `.NAME.0123abcd.part`
    4  seal      a folder gets its manifest; modes of replaced files are copied; every file and folder is synced
    5  stop      the stop flag is read for the last time
    6  commit    each target is exchanged atomically (`renameat2`); on a failure all exchanges are undone
    7  sync      the folders that hold the targets are synced: the new result is now durable
    8  remove    the old result is removed last, and of it only what its manifest lists, byte for byte

A power cut, a signal or `kill -9` at any instant leaves the old result or the new one, each complete. Where the file
system has no atomic exchange, two renames take its part: the names `.NAME.0123abcd.old` (the old result) and `.part`
(the new one, sealed) are the journal by which the next run with this target completes or undoes them.
"""

from ilmek.io.output.manifest import MANIFEST as MANIFEST
from ilmek.io.output.outputs import Outputs as Outputs
from ilmek.io.output.outputs import abandon as abandon
from ilmek.io.output.outputs import account as account
from ilmek.io.output.outputs import joined as joined
from ilmek.io.output.outputs import new_account as new_account
from ilmek.io.output.outputs import results_written as results_written
from ilmek.io.output.outputs import write_file as write_file
