"""What stands round the loom and watches it: guards, sensors, circuit; creel and yarn path, or weavers' station."""
