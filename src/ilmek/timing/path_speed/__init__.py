"""Time-optimal motion along a given path within limits of speed, acceleration and jerk of each axis."""
