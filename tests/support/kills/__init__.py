"""Signals and `kill -9` at random instants of real commands: is ever a result lost, or a message false?

commands  the commands, each with outputs over old ones
child     a command that waits in a chosen call of the write protocol, so that a signal meets it there
case      one command, killed once, and everything that is checked afterwards
table     the summary
"""
