"""What a recording or a live stream is worth: the checks behind ``info`` and the nodes."""
