"""Figures of merit of a track."""
