"""`ilmek stop`: a command to a run, from another terminal."""

from ilmek.cli.run_commands import run_command

command = run_command("stop", "Stop the loom of a run and end its process; `ilmek run` goes on later.")
