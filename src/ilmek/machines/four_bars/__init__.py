"""What all machines share that answer a task with four-bars: what they sieve by, their choice, tables and figures."""
