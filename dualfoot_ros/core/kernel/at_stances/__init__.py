"""What acts at a stance, a few times a second: constraints, what they teach, and landings.

Most entries take the workspace ``w`` and an array ``x`` beside it (X_SIZE,), in which they leave
what they have found.
"""
