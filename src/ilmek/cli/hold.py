"""`ilmek hold`: a command to a run, from another terminal."""

from ilmek.cli.run_commands import run_command

command = run_command("hold", "Hold the loom of a run after the knots in work; `ilmek resume` has it go on.")
