"""What all machines share that synthesise four-bars for a task: parameters, selection, results, tables and figures."""
