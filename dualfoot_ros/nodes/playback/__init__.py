"""Playback of recordings into topics, and recording of topics."""
