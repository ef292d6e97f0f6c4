"""Looking at unknown devices: what they send, in which format, and which ones are there."""
