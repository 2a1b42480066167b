"""From a task to link lengths: closed-form synthesis of linkages."""
