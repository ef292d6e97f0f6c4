"""Playing bags into topics, and recording topics."""
