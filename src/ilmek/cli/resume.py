"""`ilmek resume`: a command to a run, from another terminal."""

from ilmek.cli.run_commands import run_command

command = run_command("resume", "Have the loom of a run go on: its alarms are acknowledged.")
