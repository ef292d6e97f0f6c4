"""What is told of an epoch: all that can be asked for live, and what a trajectory keeps."""
