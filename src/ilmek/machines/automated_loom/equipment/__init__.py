"""What stands round the loom and watches it: guards with their doors, sensors, safety circuit, creel and yarn path."""
