"""Parts of a mechanism file: named values, points, joints, masses, loads, motions and tasks."""
