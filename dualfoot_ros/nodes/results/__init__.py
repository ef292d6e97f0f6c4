"""What the fusion node publishes."""
